// The seam to CHOLMOD for symmetric matrices in general.
#include <cholmod.h>

#include <algorithm>
#include <new>

#include "geo/contract.hpp"
#include "planner/transition/sparse.hpp"

namespace aerogram::planner::sparse {
namespace {

constexpr std::size_t kColumnsAtOnce = 8;

void check(const cholmod_common& common) {
    if (common.status == CHOLMOD_OUT_OF_MEMORY || common.status == CHOLMOD_TOO_LARGE) throw std::bad_alloc();
    AEROGRAM_REQUIRE(common.status >= CHOLMOD_OK, common.status);  // warnings (a pivot of 0) are positive
}

}  // namespace

struct Factor::Impl {
    cholmod_common common{};
    cholmod_factor* factor = nullptr;
    cholmod_dense *solution = nullptr, *work_y = nullptr, *work_e = nullptr;

    explicit Impl(const Symmetric& m) {
        cholmod_start(&common);
        common.print = 0;
        common.supernodal = CHOLMOD_SIMPLICIAL;
        common.final_ll = 0;
        common.nmethods = 1;  // approximate minimum degree: no random choices
        common.method[0].ordering = CHOLMOD_AMD;
        common.postorder = 1;
        cholmod_sparse* matrix = cholmod_allocate_sparse(m.n, m.n, m.values.size(), 1, 1, 1, CHOLMOD_REAL, &common);
        check(common);
        std::ranges::copy(m.starts, static_cast<int*>(matrix->p));
        std::ranges::copy(m.rows, static_cast<int*>(matrix->i));
        std::ranges::copy(m.values, static_cast<double*>(matrix->x));
        factor = cholmod_analyze(matrix, &common);
        if (common.status == CHOLMOD_OK) cholmod_factorize(matrix, factor, &common);
        cholmod_free_sparse(&matrix, &common);
        check(common);
    }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;
    ~Impl() {
        cholmod_free_factor(&factor, &common);
        for (cholmod_dense** dense : {&solution, &work_y, &work_e}) cholmod_free_dense(dense, &common);
        cholmod_finish(&common);
    }
};

Factor::Factor(const Symmetric& matrix) {
    AEROGRAM_REQUIRE(matrix.n >= 1 && matrix.starts.size() == matrix.n + 1, matrix.n, matrix.starts.size());
    AEROGRAM_REQUIRE(matrix.rows.size() == matrix.values.size(), matrix.rows.size(), matrix.values.size());
    impl_ = std::make_unique<Impl>(matrix);
}
Factor::Factor(Factor&&) noexcept = default;
Factor& Factor::operator=(Factor&&) noexcept = default;
Factor::~Factor() = default;

bool Factor::complete() const {
    return impl_->factor->minor == impl_->factor->n;
}

std::size_t Factor::negative_pivots() const {
    const cholmod_factor& f = *impl_->factor;
    AEROGRAM_REQUIRE(complete() && f.is_ll == 0 && f.is_super == 0);
    const int* starts = static_cast<const int*>(f.p);  // D is the first entry of every column
    const double* values = static_cast<const double*>(f.x);
    std::size_t count = 0;
    for (std::size_t j = 0; j < f.n; ++j) count += values[starts[j]] < 0.0 ? 1U : 0U;
    return count;
}

void Factor::solve(std::span<double> b_to_x, std::size_t columns) {
    Impl& s = *impl_;
    const std::size_t n = s.factor->n;
    AEROGRAM_REQUIRE(complete() && b_to_x.size() == n * columns, b_to_x.size(), n, columns);
    for (std::size_t first = 0; first < columns; first += kColumnsAtOnce) {
        const std::span<double> block = b_to_x.subspan(first * n, std::min(kColumnsAtOnce, columns - first) * n);
        cholmod_dense right{};
        right.nrow = right.d = n;
        right.ncol = block.size() / n;
        right.nzmax = block.size();
        right.x = block.data();
        right.xtype = CHOLMOD_REAL;
        right.dtype = CHOLMOD_DOUBLE;
        cholmod_solve2(CHOLMOD_A, s.factor, &right, nullptr, &s.solution, nullptr, &s.work_y, &s.work_e, &s.common);
        check(s.common);
        std::copy_n(static_cast<const double*>(s.solution->x), block.size(), block.data());
    }
}

}  // namespace aerogram::planner::sparse
