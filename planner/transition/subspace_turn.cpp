#include "planner/transition/subspace_turn.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geo/contract.hpp"

namespace aerogram::planner {
namespace {

using dense::Matrix;
using dense::Op;

constexpr double kSameDirection = 1e-6;  // sine
constexpr double kSquare = 1e-9;         // cosine

Matrix transposed(const Matrix& m) {
    Matrix out(m.columns, m.rows);
    for (std::size_t j = 0; j < m.columns; ++j) {
        for (std::size_t i = 0; i < m.rows; ++i) out(j, i) = m(i, j);
    }
    return out;
}

/// Principal pairs: overlap = u diag(cosines) vᵀ, cosines descending.
struct Pairs {
    Matrix u, v;
    std::vector<double> cosines;
    std::size_t alike = 0;  ///< pairs that count as one direction
};
Pairs principal_pairs(const Matrix& overlap) {
    dense::SingularValues svd = dense::singular_values(overlap);
    Pairs out{std::move(svd.u), transposed(svd.vt), std::move(svd.values), 0};
    const std::size_t k = out.cosines.size();
    for (double& c : out.cosines) {
        c = std::min(c, 1.0);
        if (1.0 - c * c < kSameDirection * kSameDirection) {
            c = 1.0;
            ++out.alike;
        }
    }
    std::size_t square = 0;
    while (square < k && out.cosines[k - 1 - square] < kSquare) ++square;
    if (square > 0) {
        const Matrix mine = column_block(out.u, k - square, k), theirs = column_block(out.v, k - square, k);
        const dense::SingularValues nearest = dense::singular_values(dense::product(mine, Op::transposed, theirs));
        set_column_block(out.u, k - square,
                         dense::product(mine, Op::plain, dense::product(nearest.u, Op::plain, nearest.vt)));
    }
    return out;
}

/// Orthonormal parts of T v square to S, for the pairs that differ.
Matrix parts_beside(const Matrix& source, const Matrix& target, const Pairs& pairs) {
    const std::size_t k = pairs.cosines.size();
    Matrix parts = dense::product(target, Op::plain, column_block(pairs.v, pairs.alike, k));
    for (int pass = 0; pass < 2; ++pass) {
        const Matrix inside = dense::product(source, Op::plain, dense::product(source, Op::transposed, parts));
        for (std::size_t i = 0; i < parts.values.size(); ++i) parts.values[i] -= inside.values[i];
        for (std::size_t j = 0; j < parts.columns; ++j) {
            const auto x = parts.column(j);
            for (std::size_t q = 0; q < j; ++q) {
                double along = 0.0;
                for (std::size_t i = 0; i < x.size(); ++i) along += parts(i, q) * x[i];
                for (std::size_t i = 0; i < x.size(); ++i) x[i] -= along * parts(i, q);
            }
            double length = 0.0;
            for (const double v : x) length += v * v;
            AEROGRAM_REQUIRE(length > 0.0, j);
            for (double& v : x) v /= std::sqrt(length);
        }
    }
    return parts;
}

Matrix turn_of_pairs(const Pairs& pairs) {
    const std::size_t k = pairs.cosines.size(), beside = k - pairs.alike;
    Matrix scaled = pairs.u;
    for (std::size_t p = 0; p < k; ++p) {
        for (double& x : scaled.column(p)) x *= pairs.cosines[p];
    }
    const Matrix inside = dense::product(scaled, Op::plain, transposed(pairs.v));
    Matrix turn(k + beside, k + beside);
    for (std::size_t j = 0; j < k; ++j) std::ranges::copy(inside.column(j), turn.column(j).begin());
    for (std::size_t b = 0; b < beside; ++b) {
        const std::size_t p = pairs.alike + b;
        const double cosine = pairs.cosines[p], sine = std::sqrt(1.0 - cosine * cosine);
        for (std::size_t j = 0; j < k; ++j) {
            turn(k + b, j) = sine * pairs.v(j, p);
            turn(j, k + b) = -sine * pairs.u(j, p);
        }
        turn(k + b, k + b) = cosine;
    }
    return turn;
}

}  // namespace

SubspaceTurn subspace_turn(const Matrix& source, const Matrix& target, const Matrix& overlap) {
    AEROGRAM_REQUIRE(source.columns == target.columns && overlap.rows == source.columns, source.columns, overlap.rows);
    if (source.columns == 0) return {source, overlap};
    Pairs pairs = principal_pairs(overlap);
    if (pairs.alike == source.columns) return {source, overlap};
    Matrix turn = turn_of_pairs(pairs);
    if (dense::determinant_sign(turn) < 0.0) {  // only where a pair is square: its sign is free
        for (double& x : pairs.v.column(pairs.cosines.size() - 1)) x = -x;
        turn = turn_of_pairs(pairs);
    }
    const Matrix beside = parts_beside(source, target, pairs);
    Matrix basis = source;
    basis.values.insert(basis.values.end(), beside.values.begin(), beside.values.end());
    basis.columns += beside.columns;
    return {std::move(basis), std::move(turn)};
}

Eigenbasis reduced_basis(const Eigenbasis& basis, std::size_t count, const Eigenbasis& other) {
    AEROGRAM_REQUIRE(count <= basis.modes.columns, count, basis.modes.columns);
    Eigenbasis out{column_block(basis.modes, 0, count), basis.values, {}};
    out.values.resize(count);
    for (const Eigenspace& space : basis.spaces) {
        if (space.first >= count) break;
        out.spaces.push_back({space.first, std::min(space.last, count)});
        if (space.last <= count) continue;
        const Matrix whole = column_block(basis.modes, space.first, space.last);
        const Matrix seen = dense::product(other.modes, Op::transposed, whole);
        const dense::SymmetricEigen nearness = dense::symmetric_eigen(dense::product(seen, Op::transposed, seen));
        const std::size_t m = space.dimension(), kept = count - space.first;
        Matrix nearest(m, kept);
        for (std::size_t j = 0; j < kept; ++j) {
            std::ranges::copy(nearness.vectors.column(m - 1 - j), nearest.column(j).begin());
        }
        set_column_block(out.modes, space.first, canonical_basis(dense::product(whole, Op::plain, nearest)));
    }
    return out;
}

}  // namespace aerogram::planner
