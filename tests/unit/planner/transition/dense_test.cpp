#include "planner/transition/dense.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "tests/unit/planner/transition/shapes.hpp"

namespace aerogram::planner {
namespace {

using namespace testing;

dense::Matrix random_matrix(Random& random, std::size_t n) {
    dense::Matrix out(n, n);
    for (double& x : out.values) x = random.between(-1.0, 1.0);
    return out;
}

#if defined(__x86_64__)
TEST(Dense, KernelIsPinnedWhereTheProcessorHasIt) {
    const bool has_it = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    EXPECT_EQ(std::string(dense::kernel_name()) == "Haswell", has_it) << dense::kernel_name();
}
#endif

TEST(Dense, ProductIsThePlainTripleLoop) {
    Random random(11);
    const dense::Matrix a = random_matrix(random, 23), b = random_matrix(random, 23);
    EXPECT_LT(largest_difference(dense::product(a, dense::Op::plain, b), times(a, b)), 1e-13);
    EXPECT_LT(largest_difference(dense::product(a, dense::Op::transposed, b), times(transposed(a), b)), 1e-13);
}

TEST(Dense, SymmetricEigenRebuildsTheMatrix) {
    Random random(12);
    dense::Matrix a = random_matrix(random, 40);
    for (std::size_t j = 0; j < 40; ++j) {
        for (std::size_t i = 0; i < j; ++i) a(i, j) = a(j, i);
    }
    const dense::SymmetricEigen eigen = dense::symmetric_eigen(a);
    dense::Matrix scaled = eigen.vectors;
    for (std::size_t j = 0; j < 40; ++j) {
        for (double& x : scaled.column(j)) x *= eigen.values[j];
    }
    EXPECT_LT(largest_difference(times(scaled, transposed(eigen.vectors)), a), 1e-12);
    EXPECT_TRUE(std::is_sorted(eigen.values.begin(), eigen.values.end()));
}

TEST(Dense, SingularValuesRebuildTheMatrix) {
    Random random(13);
    const dense::Matrix a = random_matrix(random, 17);
    const dense::SingularValues svd = dense::singular_values(a);
    dense::Matrix scaled = svd.u;
    for (std::size_t j = 0; j < 17; ++j) {
        for (double& x : scaled.column(j)) x *= svd.values[j];
    }
    EXPECT_LT(largest_difference(times(scaled, svd.vt), a), 1e-13);
}

TEST(Dense, SchurFormRebuildsTheMatrix) {
    Random random(14);
    const dense::Matrix a = random_matrix(random, 19);
    const dense::RealSchur schur = dense::real_schur(a);
    EXPECT_LT(largest_difference(times(times(schur.z, schur.t), transposed(schur.z)), a), 1e-13);
}

TEST(Dense, DeterminantSignFollowsSwapsAndSigns) {
    dense::Matrix a = identity(5);
    EXPECT_EQ(dense::determinant_sign(a), 1.0);
    std::swap(a.values[0], a.values[1]);
    std::swap(a.values[5], a.values[6]);
    EXPECT_EQ(dense::determinant_sign(a), -1.0);
    a(4, 4) = -1.0;
    EXPECT_EQ(dense::determinant_sign(a), 1.0);
    a(4, 4) = 0.0;
    EXPECT_EQ(dense::determinant_sign(a), 0.0);
    EXPECT_EQ(dense::determinant_sign(dense::Matrix{}), 1.0);
}

// Debian's OpenBLAS without threads failed here in one run of ten on a loaded machine: two callers got one buffer.
TEST(Dense, ManyThreadsGiveTheSameBytes) {
    Random random(15);
    const dense::Matrix a = random_matrix(random, 60), b = random_matrix(random, 60);
    const dense::Matrix expected = dense::product(a, dense::Op::plain, b);
    std::vector<char> same(4, 0);
    std::vector<std::thread> threads;
    for (char& mine : same) {
        threads.emplace_back([&] {
            bool all = true;
            for (int i = 0; i < 2000; ++i)
                all = all && dense::product(a, dense::Op::plain, b).values == expected.values;
            mine = all ? 1 : 0;
        });
    }
    for (std::thread& t : threads) t.join();
    EXPECT_EQ(same, std::vector<char>(4, 1));
}

}  // namespace
}  // namespace aerogram::planner
