#include "planner/transition/eigenbasis.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geo/contract.hpp"

namespace aerogram::planner {
namespace {

using dense::Matrix;

Matrix laplacian(const AdjacencyGraph& graph) {
    Matrix l(graph.n, graph.n);
    for (const Edge& e : graph.edges) {
        AEROGRAM_REQUIRE(e.a < e.b && e.b < graph.n, e.a, e.b, graph.n);
        AEROGRAM_REQUIRE(e.weight > 0.0 && std::isfinite(e.weight), e.weight);
        l(e.a, e.a) += e.weight;
        l(e.b, e.b) += e.weight;
        l(e.a, e.b) -= e.weight;
        l(e.b, e.a) -= e.weight;
    }
    return l;
}

/// The reflection I - beta v vᵀ that takes the first coordinate vector to -(1, ..., 1)/√n.
struct Reflection {
    std::vector<double> v;
    double beta = 0.0;
};
Reflection to_constant(std::size_t n) {
    const double w = 1.0 / std::sqrt(static_cast<double>(n));
    Reflection h{std::vector<double>(n, w), 0.0};
    h.v[0] += 1.0;
    double length2 = 0.0;
    for (const double x : h.v) length2 += x * x;
    h.beta = 2.0 / length2;
    return h;
}

/// H L H without its first row and column: L on the complement of the constant vector.
Matrix deflated(const Matrix& l, const Reflection& h) {
    const std::size_t n = l.rows;
    std::vector<double> q(n, 0.0);
    dense::multiply(l, dense::Op::plain, h.v, 1, q);
    double vp = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        q[i] *= h.beta;
        vp += h.v[i] * q[i];
    }
    for (std::size_t i = 0; i < n; ++i) q[i] -= 0.5 * h.beta * vp * h.v[i];
    Matrix out(n - 1, n - 1);
    for (std::size_t j = 1; j < n; ++j) {
        for (std::size_t i = 1; i < n; ++i) out(i - 1, j - 1) = l(i, j) - h.v[i] * q[j] - q[i] * h.v[j];
    }
    return out;
}

/// H applied to columns that have a 0 put on top.
Matrix lifted(const Matrix& columns, const Reflection& h) {
    Matrix out(columns.rows + 1, columns.columns);
    for (std::size_t j = 0; j < columns.columns; ++j) {
        double along = 0.0;
        for (std::size_t i = 0; i < columns.rows; ++i) along += h.v[i + 1] * columns(i, j);
        out(0, j) = -h.beta * along * h.v[0];
        for (std::size_t i = 0; i < columns.rows; ++i) out(i + 1, j) = columns(i, j) - h.beta * along * h.v[i + 1];
    }
    return out;
}

double dot(std::span<const double> a, std::span<const double> b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}

/// The longest column; of those within 1e-6 the first.
std::size_t longest_column(const Matrix& m) {
    double most = 0.0;
    for (std::size_t j = 0; j < m.columns; ++j) most = std::max(most, dot(m.column(j), m.column(j)));
    for (std::size_t j = 0; j < m.columns; ++j) {
        if (dot(m.column(j), m.column(j)) >= (1.0 - 1e-6) * most) return j;
    }
    return 0;
}

/// Takes the parts along the first `count` columns of q out of x.
void make_square_to(std::span<double> x, const Matrix& q, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) {
        const double along = dot(q.column(k), x);
        for (std::size_t i = 0; i < x.size(); ++i) x[i] -= along * q(i, k);
    }
}

}  // namespace

std::vector<Eigenspace> eigenspaces(const std::vector<double>& ascending, double gap) {
    std::vector<Eigenspace> spaces;
    for (std::size_t k = 0; k < ascending.size(); ++k) {
        if (k == 0 || ascending[k] - ascending[k - 1] > gap) spaces.push_back({k, k});
        spaces.back().last = k + 1;
    }
    return spaces;
}

Matrix column_block(const Matrix& m, std::size_t first, std::size_t last) {
    Matrix out(m.rows, last - first);
    std::copy(m.values.begin() + static_cast<std::ptrdiff_t>(first * m.rows),
              m.values.begin() + static_cast<std::ptrdiff_t>(last * m.rows), out.values.begin());
    return out;
}

void set_column_block(Matrix& m, std::size_t first, const Matrix& block) {
    AEROGRAM_REQUIRE(m.rows == block.rows && first + block.columns <= m.columns);
    std::copy(block.values.begin(), block.values.end(), m.values.begin() + static_cast<std::ptrdiff_t>(first * m.rows));
}

Matrix canonical_basis(const Matrix& columns) {
    const std::size_t m = columns.columns;
    // Row i of `columns` holds the coordinates, in this basis, of coordinate vector i's projection on the span.
    Matrix rest(m, columns.rows);
    for (std::size_t i = 0; i < columns.rows; ++i) {
        for (std::size_t k = 0; k < m; ++k) rest(k, i) = columns(i, k);
    }
    Matrix turn(m, m);
    for (std::size_t k = 0; k < m; ++k) {
        const auto pivot = rest.column(longest_column(rest));
        const auto axis = turn.column(k);
        std::copy(pivot.begin(), pivot.end(), axis.begin());
        make_square_to(axis, turn, k);  // once more: the rest may be short
        const double length = std::sqrt(dot(axis, axis));
        AEROGRAM_REQUIRE(length > 0.0, k, m);
        for (double& x : axis) x /= length;
        for (std::size_t i = 0; i < rest.columns; ++i) {
            const auto r = rest.column(i);
            const double along = dot(axis, r);
            for (std::size_t c = 0; c < m; ++c) r[c] -= along * axis[c];
        }
    }
    return dense::product(columns, dense::Op::plain, turn);
}

Eigenbasis laplacian_eigenbasis(const AdjacencyGraph& graph) {
    AEROGRAM_REQUIRE(graph.n >= 1, graph.n);
    const Reflection h = to_constant(graph.n);
    dense::SymmetricEigen eigen = dense::symmetric_eigen(deflated(laplacian(graph), h));
    Eigenbasis out{lifted(eigen.vectors, h), std::move(eigen.values), {}};
    const double largest = out.values.empty() ? 0.0 : std::abs(out.values.back());
    out.spaces = eigenspaces(out.values, kEigenspaceTolerance * largest);
    for (const Eigenspace& space : out.spaces) {
        set_column_block(out.modes, space.first, canonical_basis(column_block(out.modes, space.first, space.last)));
    }
    return out;
}

}  // namespace aerogram::planner
