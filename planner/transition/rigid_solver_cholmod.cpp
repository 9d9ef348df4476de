// The seam to CHOLMOD: sparse Cholesky of one graph Laplacian.
#include <cholmod.h>

#include <algorithm>
#include <mutex>
#include <new>
#include <optional>

#include "geo/contract.hpp"
#include "planner/transition/rigid_gradients.hpp"
#include "planner/transition/rigid_solver.hpp"

namespace aerogram::planner {
namespace {

constexpr double kMostWork = 4e9;  ///< multiplications and additions of a factorisation: some seconds

/// METIS draws its random choices from the C library's one generator, which it seeds itself at every call: the same
/// ordering every time, unless two threads draw at once.
std::mutex ordering_turn;

/// Whatever CHOLMOD reports: the matrix is well-formed and positive definite by construction, so it is short of memory.
void check(const cholmod_common& common) {
    if (common.status == CHOLMOD_OUT_OF_MEMORY || common.status == CHOLMOD_TOO_LARGE) throw std::bad_alloc();
    AEROGRAM_REQUIRE(common.status == CHOLMOD_OK, common.status);
}

}  // namespace

struct LaplacianSolver::Impl {
    cholmod_common common{};
    cholmod_sparse* matrix = nullptr;
    cholmod_factor* factor = nullptr;
    cholmod_dense *right = nullptr, *solution = nullptr, *work_y = nullptr, *work_e = nullptr;

    std::optional<RingGraph> rings;  ///< of a graph too dense to factor

    explicit Impl(const RingGraph& graph) {
        cholmod_start(&common);
        common.print = 0;
        common.supernodal = CHOLMOD_SIMPLICIAL;
        common.nmethods = 1;  // solid formations: a third of the work of approximate minimum degree
        common.method[0].ordering = CHOLMOD_METIS;
        common.postorder = 1;
        fill(graph);
        {
            const std::lock_guard lock(ordering_turn);
            factor = cholmod_analyze(matrix, &common);
        }
        check(common);
        if (common.fl > kMostWork) {
            rings = graph;
            return;
        }
        cholmod_factorize(matrix, factor, &common);
        check(common);
        cholmod_free_sparse(&matrix, &common);
        right = cholmod_allocate_dense(graph.n, 3, graph.n, CHOLMOD_REAL, &common);
        check(common);
    }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;
    ~Impl() {
        cholmod_free_sparse(&matrix, &common);
        cholmod_free_factor(&factor, &common);
        for (cholmod_dense** dense : {&right, &solution, &work_y, &work_e}) cholmod_free_dense(dense, &common);
        cholmod_finish(&common);
    }

    /// The upper triangle, column by column; the lowest individual of a component is held by doubling its diagonal.
    void fill(const RingGraph& graph) {
        matrix = cholmod_allocate_sparse(graph.n, graph.n, graph.n + graph.weights.size() / 2, 1, 1, 1, CHOLMOD_REAL,
                                         &common);
        check(common);
        int* starts = static_cast<int*>(matrix->p);
        int* rows = static_cast<int*>(matrix->i);
        double* values = static_cast<double*>(matrix->x);
        int count = 0;
        for (std::uint32_t i = 0; i < graph.n; ++i) {
            starts[i] = count;
            double diagonal = 0.0;
            for (std::uint32_t k = graph.starts[i]; k < graph.starts[i + 1]; ++k) {
                diagonal += graph.weights[k];
                if (graph.neighbours[k] >= i) continue;
                rows[count] = static_cast<int>(graph.neighbours[k]);
                values[count++] = -graph.weights[k];
            }
            if (diagonal == 0.0) diagonal = 1.0;
            if (graph.first_of[graph.component[i]] == i) diagonal *= 2.0;
            rows[count] = static_cast<int>(i);
            values[count++] = diagonal;
        }
        starts[graph.n] = count;
    }
};

LaplacianSolver::LaplacianSolver(const RingGraph& graph) : impl_(std::make_unique<Impl>(graph)) {
}
LaplacianSolver::LaplacianSolver(LaplacianSolver&&) noexcept = default;
LaplacianSolver& LaplacianSolver::operator=(LaplacianSolver&&) noexcept = default;
LaplacianSolver::~LaplacianSolver() = default;

void LaplacianSolver::solve(std::span<Vec3> b_to_x) {
    Impl& s = *impl_;
    if (s.rings) {
        std::ranges::copy(laplacian_gradients(*s.rings, b_to_x), b_to_x.begin());
        return;
    }
    const std::size_t n = s.right->nrow;
    AEROGRAM_REQUIRE(b_to_x.size() == n, b_to_x.size(), n);
    double* right = static_cast<double*>(s.right->x);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t c = 0; c < 3; ++c) right[c * n + i] = b_to_x[i][static_cast<int>(c)];
    }
    cholmod_solve2(CHOLMOD_A, s.factor, s.right, nullptr, &s.solution, nullptr, &s.work_y, &s.work_e, &s.common);
    check(s.common);
    const double* x = static_cast<const double*>(s.solution->x);
    for (std::size_t i = 0; i < n; ++i) b_to_x[i] = {x[i], x[n + i], x[2 * n + i]};
}

}  // namespace aerogram::planner
