#pragma once

/// Marks a free function whose loops the compiler vectorises once for every processor of this family and once with
/// AVX2; which one runs is chosen when the program starts (GCC and clang function multiversioning). Fused multiply-add
/// is never used (-ffp-contract=off), so both give the same bits. Sanitizers do not know such functions.
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__SANITIZE_ADDRESS__)
#define AEROGRAM_VECTORIZED __attribute__((target_clones("avx2", "default")))
#else
#define AEROGRAM_VECTORIZED
#endif
