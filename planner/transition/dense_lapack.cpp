// The seam to OpenBLAS. The Fortran symbols are declared here, so no header of the library is needed.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

#include "geo/contract.hpp"
#include "planner/transition/dense.hpp"

extern "C" {
// Fortran passes everything by address; the lengths of the character arguments come last, by value.
void dgemm_(const char* op_a, const char* op_b, const int* m, const int* n, const int* k, const double* alpha,
            const double* a, const int* lda, const double* b, const int* ldb, const double* beta, double* c,
            const int* ldc, std::size_t, std::size_t);
void dsyevd_(const char* job, const char* uplo, const int* n, double* a, const int* lda, double* w, double* work,
             const int* lwork, int* iwork, const int* liwork, int* info, std::size_t, std::size_t);
void dgesdd_(const char* job, const int* m, const int* n, double* a, const int* lda, double* s, double* u,
             const int* ldu, double* vt, const int* ldvt, double* work, const int* lwork, int* iwork, int* info,
             std::size_t);
void dgees_(const char* job, const char* sort, int (*select)(const double*, const double*), const int* n, double* a,
            const int* lda, int* sdim, double* wr, double* wi, double* z, const int* ldz, double* work,
            const int* lwork, int* bwork, int* info, std::size_t, std::size_t);
void dgetrf_(const int* m, const int* n, double* a, const int* lda, int* pivots, int* info);
char* openblas_get_corename(void);
}

namespace aerogram::planner::dense {
namespace {

// OpenBLAS reads its environment in a constructor of the default priority, which runs after this one (101).
// One thread: results must not depend on the count, and callers run transitions side by side. (The build without
// threads would do, were it safe to call from several: Dense.ManyThreadsGiveTheSameBytes caught it handing one buffer
// to two.) One kernel: the library picks one for the processor it wakes up on, and kernels differ in their last bits;
// every processor with AVX2 and FMA runs the same.
__attribute__((constructor(101))) void pin_openblas() {
    setenv("OPENBLAS_NUM_THREADS", "1", 1);
#if defined(__x86_64__)
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) setenv("OPENBLAS_CORETYPE", "Haswell", 1);
#endif
}

int as_int(std::size_t n) {
    AEROGRAM_REQUIRE(n <= static_cast<std::size_t>(std::numeric_limits<int>::max()), n);
    return static_cast<int>(n);
}

/// The workspace size a query left in its first place.
int workspace(double answer) {
    return std::max(1, static_cast<int>(std::ceil(answer)));
}

}  // namespace

void multiply(const Matrix& a, Op op, std::span<const double> b, std::size_t columns, std::span<double> out) {
    const std::size_t rows = op == Op::plain ? a.rows : a.columns, inner = op == Op::plain ? a.columns : a.rows;
    AEROGRAM_REQUIRE(b.size() == inner * columns && out.size() == rows * columns, b.size(), out.size());
    if (out.empty()) return;
    const char op_a = op == Op::plain ? 'N' : 'T', op_b = 'N';
    const int m = as_int(rows), n = as_int(columns), k = as_int(inner);
    const int lda = std::max(1, as_int(a.rows)), ldb = std::max(1, k);
    const double one = 1.0, zero = 0.0;
    dgemm_(&op_a, &op_b, &m, &n, &k, &one, a.values.data(), &lda, b.data(), &ldb, &zero, out.data(), &m, 1, 1);
}

Matrix product(const Matrix& a, Op op, const Matrix& b) {
    Matrix out(op == Op::plain ? a.rows : a.columns, b.columns);
    multiply(a, op, b.values, b.columns, out.values);
    return out;
}

SymmetricEigen symmetric_eigen(Matrix a) {
    AEROGRAM_REQUIRE(a.rows == a.columns, a.rows, a.columns);
    SymmetricEigen out;
    out.values.resize(a.rows);
    if (a.rows != 0) {
        const char job = 'V', uplo = 'L';
        const int n = as_int(a.rows), query = -1;
        double work_size = 0.0;
        int iwork_size = 0, info = 0;
        dsyevd_(&job, &uplo, &n, a.values.data(), &n, out.values.data(), &work_size, &query, &iwork_size, &query, &info,
                1, 1);
        AEROGRAM_REQUIRE(info == 0, info);
        const int lwork = workspace(work_size), liwork = std::max(1, iwork_size);
        std::vector<double> work(static_cast<std::size_t>(lwork));
        std::vector<int> iwork(static_cast<std::size_t>(liwork));
        dsyevd_(&job, &uplo, &n, a.values.data(), &n, out.values.data(), work.data(), &lwork, iwork.data(), &liwork,
                &info, 1, 1);
        AEROGRAM_REQUIRE(info == 0, info, n);
    }
    out.vectors = std::move(a);
    return out;
}

SingularValues singular_values(Matrix a) {
    AEROGRAM_REQUIRE(a.rows == a.columns, a.rows, a.columns);
    SingularValues out{Matrix(a.rows, a.rows), std::vector<double>(a.rows), Matrix(a.rows, a.rows)};
    if (a.rows == 0) return out;
    const char job = 'A';
    const int n = as_int(a.rows), query = -1;
    double work_size = 0.0;
    int info = 0;
    std::vector<int> iwork(8 * a.rows);
    dgesdd_(&job, &n, &n, a.values.data(), &n, out.values.data(), out.u.values.data(), &n, out.vt.values.data(), &n,
            &work_size, &query, iwork.data(), &info, 1);
    AEROGRAM_REQUIRE(info == 0, info);
    const int lwork = workspace(work_size);
    std::vector<double> work(static_cast<std::size_t>(lwork));
    dgesdd_(&job, &n, &n, a.values.data(), &n, out.values.data(), out.u.values.data(), &n, out.vt.values.data(), &n,
            work.data(), &lwork, iwork.data(), &info, 1);
    AEROGRAM_REQUIRE(info == 0, info, n);
    return out;
}

RealSchur real_schur(Matrix a) {
    AEROGRAM_REQUIRE(a.rows == a.columns, a.rows, a.columns);
    RealSchur out{std::move(a), {}};
    out.z = Matrix(out.t.rows, out.t.rows);
    if (out.t.rows == 0) return out;
    const char job = 'V', sort = 'N';
    const int n = as_int(out.t.rows), query = -1;
    int info = 0, selected = 0;
    double work_size = 0.0;
    std::vector<double> real(out.t.rows), imaginary(out.t.rows);
    dgees_(&job, &sort, nullptr, &n, out.t.values.data(), &n, &selected, real.data(), imaginary.data(),
           out.z.values.data(), &n, &work_size, &query, nullptr, &info, 1, 1);
    AEROGRAM_REQUIRE(info == 0, info);
    const int lwork = workspace(work_size);
    std::vector<double> work(static_cast<std::size_t>(lwork));
    dgees_(&job, &sort, nullptr, &n, out.t.values.data(), &n, &selected, real.data(), imaginary.data(),
           out.z.values.data(), &n, work.data(), &lwork, nullptr, &info, 1, 1);
    AEROGRAM_REQUIRE(info == 0, info, n);
    return out;
}

double determinant_sign(Matrix a) {
    AEROGRAM_REQUIRE(a.rows == a.columns, a.rows, a.columns);
    if (a.rows == 0) return 1.0;
    const int n = as_int(a.rows);
    int info = 0;
    std::vector<int> pivots(a.rows);
    dgetrf_(&n, &n, a.values.data(), &n, pivots.data(), &info);
    AEROGRAM_REQUIRE(info >= 0, info);
    if (info > 0) return 0.0;
    double sign = 1.0;
    for (std::size_t i = 0; i < a.rows; ++i) {
        if (pivots[i] != as_int(i + 1)) sign = -sign;
        if (a(i, i) < 0.0) sign = -sign;
    }
    return sign;
}

const char* kernel_name() {
    return openblas_get_corename();
}

}  // namespace aerogram::planner::dense
