#include "planner/transition/matching.hpp"

#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include "geo/contract.hpp"
#include "planner/transition/hungarian.hpp"
#include "planner/transition/max_min.hpp"

namespace aerogram::planner {
namespace {

using dense::Matrix;
using dense::Op;
using Matching = std::vector<std::size_t>;  // source column -> target column

constexpr double kScoreSteps = 1073741824.0;  // 2^30
// Where parts of two spaces are nearly square to one another (a singular value below kOpen) Procrustes leaves their
// turn open or to rounding: this much of "stay" decides it.
constexpr double kOpen = 1e-4, kStay = 1e-6;
constexpr double kZeroProduct = 1e-9;

std::int64_t in_steps(double score) {
    return std::llround(score * kScoreSteps);
}

std::vector<Eigenspace> single_columns(std::size_t count) {
    std::vector<Eigenspace> out(count);
    for (std::size_t k = 0; k < count; ++k) out[k] = {k, k + 1};
    return out;
}

/// |<s, t>| where eigenspaces are lines; else the root mean square part of source space h that lies in target space g,
/// which no choice of bases changes. Row-major by source column.
std::vector<std::int64_t> subspace_scores(const Matrix& products, const std::vector<Eigenspace>& source,
                                          const std::vector<Eigenspace>& target) {
    const std::size_t n = products.rows;
    std::vector<std::int64_t> scores(n * n);
    for (const Eigenspace& h : source) {
        for (const Eigenspace& g : target) {
            double sum = 0.0;
            for (std::size_t j = g.first; j < g.last; ++j) {
                for (std::size_t k = h.first; k < h.last; ++k) sum += products(k, j) * products(k, j);
            }
            const std::int64_t score = in_steps(std::sqrt(sum / static_cast<double>(h.dimension())));
            for (std::size_t k = h.first; k < h.last; ++k) {
                for (std::size_t j = g.first; j < g.last; ++j) scores[k * n + j] = score;
            }
        }
    }
    return scores;
}

Matching greedy_matching(const std::vector<std::int64_t>& scores, std::size_t n) {
    Matching out(n);
    std::vector<char> taken(n, 0);
    for (std::size_t k = 0; k < n; ++k) {
        std::size_t best = n;
        for (std::size_t j = 0; j < n; ++j) {
            if (!taken[j] && (best == n || scores[k * n + j] > scores[k * n + best])) best = j;
        }
        taken[best] = 1;
        out[k] = best;
    }
    return out;
}

Matching matching_by(const std::vector<std::int64_t>& scores, std::size_t n, Reorder reorder) {
    if (reorder == Reorder::optimal) return best_matching(scores, n);
    if (reorder == Reorder::max_min) return max_min_matching(scores, n);
    if (reorder == Reorder::greedy) return greedy_matching(scores, n);
    Matching same(n);
    std::iota(same.begin(), same.end(), std::size_t{0});
    return same;
}

Matching inverse(const Matching& m) {
    Matching out(m.size());
    for (std::size_t k = 0; k < m.size(); ++k) out[m[k]] = k;
    return out;
}

/// Turns each eigenspace of `basis` of dimension > 1 onto its partners: column k's partner is other's column
/// partner[k].
void turn_spaces_onto(Matrix& basis, const std::vector<Eigenspace>& spaces, const Matrix& other,
                      const Matching& partner) {
    for (const Eigenspace& space : spaces) {
        const std::size_t m = space.dimension();
        if (m < 2) continue;
        const Matrix mine = column_block(basis, space.first, space.last);
        Matrix theirs(other.rows, m);
        for (std::size_t k = 0; k < m; ++k) {
            set_column_block(theirs, k, column_block(other, partner[space.first + k], partner[space.first + k] + 1));
        }
        Matrix overlap = dense::product(mine, Op::transposed, theirs);
        dense::SingularValues svd = dense::singular_values(overlap);
        if (svd.values.back() < kOpen) {
            for (std::size_t k = 0; k < m; ++k) overlap(k, k) += kStay;
            svd = dense::singular_values(std::move(overlap));
        }
        set_column_block(basis, space.first, dense::product(mine, Op::plain, dense::product(svd.u, Op::plain, svd.vt)));
    }
}

void negate_column(Matrix& m, std::size_t j) {
    for (double& x : m.column(j)) x = -x;
}

/// The sign rule; keeps turn = sourceᵀ target up to date.
void choose_signs(Matrix& target, Matrix& turn) {
    std::size_t weakest = 0;
    for (std::size_t k = 0; k < turn.columns; ++k) {
        if (turn(k, k) < -kZeroProduct) {
            negate_column(target, k);
            negate_column(turn, k);
        }
        if (in_steps(std::abs(turn(k, k))) < in_steps(std::abs(turn(weakest, weakest)))) weakest = k;
    }
    if (dense::determinant_sign(turn) < 0.0) {
        negate_column(target, weakest);
        negate_column(turn, weakest);
    }
}

}  // namespace

MatchedBases matched_bases(Matrix source, const std::vector<Eigenspace>& source_spaces, const Eigenbasis& target,
                           Reorder reorder) {
    const std::size_t n = source.columns;
    AEROGRAM_REQUIRE(target.modes.columns == n, n, target.modes.columns);
    MatchedBases out{std::move(source), target.modes, {}};
    const auto& free_spaces = source_spaces.empty() ? single_columns(n) : source_spaces;
    const Matrix products = dense::product(out.source, Op::transposed, out.target);
    Matching match = matching_by(subspace_scores(products, free_spaces, target.spaces), n, reorder);
    turn_spaces_onto(out.target, target.spaces, out.source, inverse(match));
    turn_spaces_onto(out.source, free_spaces, out.target, match);
    if (reorder != Reorder::none) {
        const auto lines = single_columns(n);
        const Matrix turned = dense::product(out.source, Op::transposed, out.target);
        match = matching_by(subspace_scores(turned, lines, lines), n, reorder);
        turn_spaces_onto(out.target, target.spaces, out.source, inverse(match));
    }
    Matrix ordered(out.target.rows, n);
    for (std::size_t k = 0; k < n; ++k) set_column_block(ordered, k, column_block(out.target, match[k], match[k] + 1));
    out.target = std::move(ordered);
    out.turn = dense::product(out.source, Op::transposed, out.target);
    choose_signs(out.target, out.turn);
    return out;
}

}  // namespace aerogram::planner
