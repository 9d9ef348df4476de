#include "planner/transition/lanczos.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "geo/contract.hpp"
#include "geo/random.hpp"
#include "planner/transition/sparse.hpp"

namespace aerogram::planner {
namespace {

using dense::Matrix;
using dense::Op;

constexpr std::size_t kBlock = 8;          // also the multiplicity that is found without starting again
constexpr double kConverged = 1e-11;       // residual of a Ritz pair over its value,
constexpr double kRounding = 1e-13;        // or over the largest: a long chain's values span seven decades
constexpr double kDependent = 1e-10;       // a rest below this share of a column is rounding
constexpr std::uint64_t kStartSeed = 101;  // the result does not depend on it but for rounding
constexpr int kPowerSteps = 60;

/// L - shift I. @param n  as many leading individuals as are kept (all, or all but the last).
sparse::Symmetric laplacian_less(const AdjacencyGraph& graph, double shift, std::size_t n) {
    std::vector<double> degree(graph.n, 0.0);
    std::vector<std::vector<std::pair<int, double>>> above(n);
    for (const Edge& e : graph.edges) {
        degree[e.a] += e.weight;
        degree[e.b] += e.weight;
        if (e.b < n) above[e.b].emplace_back(static_cast<int>(e.a), -e.weight);
    }
    sparse::Symmetric m{n, {0}, {}, {}};
    for (std::size_t j = 0; j < n; ++j) {
        std::sort(above[j].begin(), above[j].end());
        for (const auto& [row, value] : above[j]) {
            m.rows.push_back(row);
            m.values.push_back(value);
        }
        m.rows.push_back(static_cast<int>(j));
        m.values.push_back(degree[j] - shift);
        m.starts.push_back(static_cast<int>(m.rows.size()));
    }
    return m;
}

void make_sum_zero(std::span<double> x) {
    double sum = 0.0;
    for (const double v : x) sum += v;
    sum /= static_cast<double>(x.size());
    for (double& v : x) v -= sum;
}

double length(std::span<const double> x) {
    double sum = 0.0;
    for (const double v : x) sum += v * v;
    return std::sqrt(sum);
}

/// A growing orthonormal basis of a block Krylov space of the inverse Laplacian, and the inverse seen inside it.
class Krylov {
  public:
    explicit Krylov(const AdjacencyGraph& graph)
        : n_(graph.n), inverse_(laplacian_less(graph, 0.0, graph.n - 1)), basis_(graph.n, 0), random_(kStartSeed) {
        AEROGRAM_REQUIRE(inverse_.complete(), graph.n);  // else it was not connected
        append_random_block();
    }

    [[nodiscard]] std::size_t size() const { return basis_.columns; }

    /// @param widened  the block becomes wider by a random one.
    void grow(bool widened) {
        const std::size_t old = size() - last_;
        Matrix next(n_, last_);
        std::copy(basis_.values.begin() + static_cast<std::ptrdiff_t>(old * n_), basis_.values.end(),
                  next.values.begin());
        apply_inverse(next);
        const Matrix along = dense::product(basis_, Op::transposed, next);
        for (std::size_t j = 0; j < last_; ++j) inside_.emplace_back(along.column(j).begin(), along.column(j).end());
        rest_ = orthonormalise(next);
        append(next);
        const std::size_t width = last_;
        if (widened) {
            append_random_block();
            last_ += width;
        }
    }

    /// The spectrum of the inverse inside the space of all blocks but the last, by descending value.
    struct Ritz {
        dense::SymmetricEigen eigen;  ///< ascending
        std::vector<double> residuals;
    };
    [[nodiscard]] Ritz ritz() const {
        const std::size_t m = inside_.size();
        Matrix h(m, m);
        for (std::size_t j = 0; j < m; ++j) {
            for (std::size_t i = 0; i < std::min(inside_[j].size(), m); ++i) {
                const bool known_twice = j < inside_[i].size();
                h(i, j) = known_twice ? 0.5 * (inside_[j][i] + inside_[i][j]) : inside_[j][i];
                h(j, i) = h(i, j);
            }
        }
        Ritz out{dense::symmetric_eigen(std::move(h)), std::vector<double>(m)};
        for (std::size_t k = 0; k < m; ++k) {
            double sum = 0.0;
            for (std::size_t r = 0; r < rest_.rows; ++r) {
                double x = 0.0;
                for (std::size_t c = 0; c < rest_.columns; ++c) {
                    x += rest_(r, c) * out.eigen.vectors(m - rest_.columns + c, k);
                }
                sum += x * x;
            }
            out.residuals[k] = std::sqrt(sum);
        }
        return out;
    }

    /// The Ritz vectors of the `count` largest values of the inverse, largest first.
    [[nodiscard]] Matrix vectors(const dense::SymmetricEigen& eigen, std::size_t count) const {
        const std::size_t m = eigen.values.size();
        Matrix space(n_, m), turn(m, count);
        std::copy_n(basis_.values.begin(), space.values.size(), space.values.begin());
        for (std::size_t k = 0; k < count; ++k) {
            for (std::size_t i = 0; i < m; ++i) turn(i, k) = eigen.vectors(i, m - 1 - k);
        }
        Matrix out = dense::product(space, Op::plain, turn);
        for (std::size_t k = 0; k < count; ++k) make_sum_zero(out.column(k));
        return out;
    }

  private:
    void append_random_block() {
        Matrix block(n_, kBlock);
        (void)orthonormalise(block);
        append(block);
    }

    void append(const Matrix& block) {
        basis_.values.insert(basis_.values.end(), block.values.begin(), block.values.end());
        basis_.columns += block.columns;
        last_ = block.columns;
    }

    void apply_inverse(Matrix& block) {
        std::vector<double> held((n_ - 1) * block.columns);
        const auto at = [&](std::size_t j) { return held.begin() + static_cast<std::ptrdiff_t>(j * (n_ - 1)); };
        for (std::size_t j = 0; j < block.columns; ++j) {
            make_sum_zero(block.column(j));
            std::copy_n(block.column(j).begin(), n_ - 1, at(j));
        }
        inverse_.solve(held, block.columns);
        for (std::size_t j = 0; j < block.columns; ++j) {
            std::copy_n(at(j), n_ - 1, block.column(j).begin());
            block(n_ - 1, j) = 0.0;
            make_sum_zero(block.column(j));
        }
    }

    void fill_at_random(std::span<double> x) {
        for (double& v : x) v = random_.between(-1.0, 1.0);
    }

    void take_out_basis(Matrix& block) const {
        if (basis_.columns == 0) return;
        const Matrix along = dense::product(basis_, Op::transposed, block);
        const Matrix inside = dense::product(basis_, Op::plain, along);
        for (std::size_t i = 0; i < block.values.size(); ++i) block.values[i] -= inside.values[i];
    }

    /// Makes a block orthonormal, to the basis too. @returns r: old = basis part + new r; columns that had nothing left
    /// become random ones.
    Matrix orthonormalise(Matrix& block) {
        Matrix r(block.columns, block.columns);
        std::vector<double> before(block.columns);
        for (std::size_t j = 0; j < block.columns; ++j) before[j] = length(block.column(j));
        take_out_basis(block);
        take_out_basis(block);
        for (std::size_t j = 0; j < block.columns; ++j) {
            const auto x = block.column(j);
            double left = take_out_columns(block, j, &r);
            const bool fresh = left <= kDependent * before[j];
            if (fresh) left = 0.0;
            r(j, j) = left;
            while (left <= kDependent && fresh) {
                fill_at_random(x);
                make_sum_zero(x);
                const double size = length(x);
                for (double& v : x) v /= size;
                Matrix one(n_, 1);
                std::ranges::copy(x, one.values.begin());
                take_out_basis(one);
                take_out_basis(one);
                std::ranges::copy(one.values, x.begin());
                left = take_out_columns(block, j, nullptr);
            }
            for (double& v : x) v /= left;
        }
        return r;
    }

    /// Takes the first j columns out of column j, twice. @returns the length left.
    static double take_out_columns(Matrix& block, std::size_t j, Matrix* r) {
        const auto x = block.column(j);
        for (int pass = 0; pass < 2; ++pass) {
            for (std::size_t k = 0; k < j; ++k) {
                const auto q = block.column(k);
                double along = 0.0;
                for (std::size_t i = 0; i < x.size(); ++i) along += q[i] * x[i];
                for (std::size_t i = 0; i < x.size(); ++i) x[i] -= along * q[i];
                if (r != nullptr) (*r)(k, j) += along;
            }
        }
        return length(x);
    }

    std::size_t n_, last_ = 0;
    sparse::Factor inverse_;
    Matrix basis_;
    std::vector<std::vector<double>> inside_;  // column j: the inverse's image of basis vector j, along the basis then
    Matrix rest_;
    Random random_;
};

/// How many eigenvalues of the Laplacian are below `level`; nothing when rounding gets in the way.
std::optional<std::size_t> count_below(const AdjacencyGraph& graph, double level) {
    const sparse::Factor factor(laplacian_less(graph, level, graph.n));
    if (!factor.complete()) return std::nullopt;
    return factor.negative_pivots();
}

/// Where to cut an ascending list of which `known` values are right: the first gap from `count` on, up to 2 count; else
/// the last before. Nothing: more values are needed.
std::optional<std::size_t> cut_of(const std::vector<double>& values, std::size_t known, std::size_t count, double gap) {
    if (known <= count) return std::nullopt;
    const auto is_gap = [&](std::size_t k) { return k == 0 || values[k] - values[k - 1] > gap; };
    for (std::size_t k = count; k < std::min(known, 2 * count + 1); ++k) {
        if (is_gap(k)) return k;
    }
    if (known <= 2 * count) return std::nullopt;
    std::size_t before = count;
    while (!is_gap(before)) --before;
    return before;
}

}  // namespace

Result<LowModes> lanczos_low_modes(const AdjacencyGraph& graph, std::size_t count, double gap, const Run& run) {
    Krylov krylov(graph);
    std::size_t next_check = count + 4 * kBlock;
    bool widened = false;
    while (true) {
        if (run.stopped()) return stopped_error();
        AEROGRAM_REQUIRE(krylov.size() + 2 * kBlock < graph.n, krylov.size(), graph.n, count);
        krylov.grow(widened);
        widened = false;
        if (krylov.size() < next_check) continue;
        next_check = krylov.size() + std::max(2 * kBlock, krylov.size() / 8);
        const Krylov::Ritz ritz = krylov.ritz();
        const std::size_t m = ritz.residuals.size();
        std::size_t known = 0;
        std::vector<double> values;
        for (std::size_t k = m; k-- > 0; ++known) {
            const double enough = std::max(kConverged * ritz.eigen.values[k], kRounding * ritz.eigen.values.back());
            if (!(ritz.residuals[k] <= enough)) break;
            values.push_back(1.0 / ritz.eigen.values[k]);
        }
        const std::optional<std::size_t> cut = cut_of(values, known, count, gap);
        if (!cut) continue;
        const double above = values[*cut], below = *cut == 0 ? 0.0 : values[*cut - 1];
        const auto counted = count_below(graph, below + 0.5 * (above - below));
        if (counted && *counted == *cut + 1) {
            Matrix vectors = krylov.vectors(ritz.eigen, *cut);
            values.resize(*cut);
            return LowModes{std::move(values), std::move(vectors), above};
        }
        widened = true;  // an eigenvalue of higher multiplicity than the block: its rest is in no Krylov space yet
    }
}

double largest_eigenvalue(const AdjacencyGraph& graph) {
    Random random(kStartSeed);
    std::vector<double> x(graph.n), y(graph.n);
    for (double& v : x) v = random.between(-1.0, 1.0);
    double value = 0.0;
    for (int step = 0; step < kPowerSteps; ++step) {
        make_sum_zero(x);
        const double size = length(x);
        if (size == 0.0) return 0.0;
        for (double& v : x) v /= size;
        std::ranges::fill(y, 0.0);
        for (const Edge& e : graph.edges) {
            const double pull = e.weight * (x[e.a] - x[e.b]);
            y[e.a] += pull;
            y[e.b] -= pull;
        }
        value = length(y);
        std::swap(x, y);
    }
    return value;
}

}  // namespace aerogram::planner
