#include "planner/transition/plane_rotation.hpp"

#include <algorithm>
#include <cmath>

#include "geo/contract.hpp"
#include "geo/units.hpp"
#include "planner/transition/eigenbasis.hpp"

namespace aerogram::planner {
namespace {

using dense::Matrix;
using dense::Op;

constexpr double kClusterGap = 1e-3;
constexpr double kHalfTurn = 1e-11;  // rad

/// Columns sorted by what the rotation does to them.
struct Parts {
    std::vector<double> planes, fixed, reversed;  // columns one after another; planes: two a plane
    std::vector<double> angles_rad;
};

void append(std::vector<double>& columns, std::span<const double> column) {
    columns.insert(columns.end(), column.begin(), column.end());
}

Matrix symmetric_part(const Matrix& r) {
    Matrix out(r.rows, r.rows);
    for (std::size_t j = 0; j < r.rows; ++j) {
        for (std::size_t i = 0; i < r.rows; ++i) out(i, j) = 0.5 * (r(i, j) + r(j, i));
    }
    return out;
}

/// Takes one invariant subspace apart. @param space  orthonormal columns.
void take_apart(const Matrix& rotation, const Matrix& space, Parts& parts) {
    const Matrix inside = dense::product(space, Op::transposed, dense::product(rotation, Op::plain, space));
    const dense::RealSchur schur = dense::real_schur(inside);
    const Matrix axes = dense::product(space, Op::plain, schur.z);
    const Matrix& t = schur.t;
    for (std::size_t k = 0; k < t.columns;) {
        if (k + 1 == t.columns || t(k + 1, k) == 0.0) {
            append(t(k, k) > 0.0 ? parts.fixed : parts.reversed, axes.column(k));
            ++k;
            continue;
        }
        const double angle = std::atan2(0.5 * (t(k + 1, k) - t(k, k + 1)), 0.5 * (t(k, k) + t(k + 1, k + 1)));
        auto first = axes.column(k), second = axes.column(k + 1);
        if (angle < 0.0) std::swap(first, second);
        const bool half_turn = kPi - std::abs(angle) < kHalfTurn;
        append(half_turn ? parts.reversed : parts.planes, first);
        append(half_turn ? parts.reversed : parts.planes, second);
        if (!half_turn) parts.angles_rad.push_back(std::abs(angle));
        k += 2;
    }
}

}  // namespace

PlaneRotation::PlaneRotation(const Matrix& rotation) : axes_(rotation.rows, rotation.rows) {
    AEROGRAM_REQUIRE(rotation.rows == rotation.columns, rotation.rows, rotation.columns);
    const std::size_t n = rotation.rows;
    if (n == 0) return;
    const dense::SymmetricEigen eigen = dense::symmetric_eigen(symmetric_part(rotation));
    const double gap = std::min(kClusterGap, 0.25 / static_cast<double>(n));
    Parts parts;
    for (std::size_t first = 0; first < n;) {
        std::size_t last = first + 1;
        while (last < n && eigen.values[last] - eigen.values[last - 1] <= gap) ++last;
        take_apart(rotation, column_block(eigen.vectors, first, last), parts);
        first = last;
    }
    Matrix reversed(n, parts.reversed.size() / n);
    AEROGRAM_REQUIRE(reversed.columns % 2 == 0, reversed.columns);  // else the determinant was -1
    reversed.values = parts.reversed;
    if (reversed.columns != 0) reversed = canonical_basis(reversed);
    append(parts.planes, reversed.values);
    parts.angles_rad.insert(parts.angles_rad.end(), reversed.columns / 2, kPi);
    append(parts.planes, parts.fixed);
    axes_.values = std::move(parts.planes);
    angles_rad_ = std::move(parts.angles_rad);
}

void PlaneRotation::turn_coordinates(double exponent, std::span<double> y, std::size_t columns) const {
    const std::size_t n = dimension();
    AEROGRAM_REQUIRE(y.size() == n * columns, y.size(), n, columns);
    for (std::size_t p = 0; p < angles_rad_.size(); ++p) {
        const double cosine = std::cos(exponent * angles_rad_[p]), sine = std::sin(exponent * angles_rad_[p]);
        for (std::size_t c = 0; c < columns; ++c) {
            double &u = y[c * n + 2 * p], &v = y[c * n + 2 * p + 1];
            const double old = u;
            u = cosine * old - sine * v;
            v = sine * old + cosine * v;
        }
    }
}

Matrix PlaneRotation::power(double exponent) const {
    Matrix coordinates(dimension(), dimension());
    for (std::size_t j = 0; j < dimension(); ++j) {
        for (std::size_t i = 0; i < dimension(); ++i) coordinates(i, j) = axes_(j, i);
    }
    turn_coordinates(exponent, coordinates.values, dimension());
    return dense::product(axes_, Op::plain, coordinates);
}

}  // namespace aerogram::planner
