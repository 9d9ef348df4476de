#pragma once
#include <cstddef>
#include <span>
#include <vector>

/// Dense linear algebra: the one door of this folder to LAPACK (OpenBLAS, one thread, kernel pinned; see
/// dense_lapack.cpp). Same input, same processor family: same bytes.
namespace aerogram::planner::dense {

/// Column-major.
struct Matrix {
    std::size_t rows = 0, columns = 0;
    std::vector<double> values;

    Matrix() = default;
    Matrix(std::size_t r, std::size_t c) : rows(r), columns(c), values(r * c, 0.0) {}
    [[nodiscard]] double operator()(std::size_t row, std::size_t column) const { return values[column * rows + row]; }
    [[nodiscard]] double& operator()(std::size_t row, std::size_t column) { return values[column * rows + row]; }
    [[nodiscard]] std::span<const double> column(std::size_t j) const { return {values.data() + j * rows, rows}; }
    [[nodiscard]] std::span<double> column(std::size_t j) { return {values.data() + j * rows, rows}; }
};

enum class Op { plain, transposed };

/// op(a) b. @param b  as many rows as op(a) has columns.
[[nodiscard]] Matrix product(const Matrix& a, Op op, const Matrix& b);
/// out = op(a) b for a few columns in plain storage. @param b, out  column-major; `columns` columns each.
void multiply(const Matrix& a, Op op, std::span<const double> b, std::size_t columns, std::span<double> out);

/// a = vectors diag(values) vectorsᵀ.
struct SymmetricEigen {
    std::vector<double> values;  ///< ascending
    Matrix vectors;              ///< orthonormal columns
};
/// Divide and conquer (dsyevd): eigenvectors orthonormal to rounding error whatever the spectrum.
/// @param a  symmetric; the lower triangle is read.
[[nodiscard]] SymmetricEigen symmetric_eigen(Matrix a);

/// a = u diag(values) vt.
struct SingularValues {
    Matrix u;
    std::vector<double> values;  ///< descending
    Matrix vt;
};
[[nodiscard]] SingularValues singular_values(Matrix square);

/// a = z t zᵀ, t upper triangular but for 2x2 blocks with equal diagonal values.
struct RealSchur {
    Matrix t, z;
};
[[nodiscard]] RealSchur real_schur(Matrix square);

/// The sign of the determinant: +1.0 or -1.0; 0.0 when a pivot is exactly 0.
[[nodiscard]] double determinant_sign(Matrix square);

/// The kernel OpenBLAS runs, e.g. "Haswell".
[[nodiscard]] const char* kernel_name();

}  // namespace aerogram::planner::dense
