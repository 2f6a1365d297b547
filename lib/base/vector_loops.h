// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// Attributes and pragmas for loops that must compile to vector code.

/// Compiles a function for several vector widths; the program selects the widest that the machine
/// supports at its start. Disabled under sanitizers, whose runtime is not ready at that time.
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__SANITIZE_ADDRESS__) &&             \
    !defined(__SANITIZE_THREAD__) && !defined(__clang__)
#define CALOTTE_VECTOR_WIDTHS __attribute__((target_clones("default", "avx2", "avx512f")))
#else
#define CALOTTE_VECTOR_WIDTHS
#endif

/// The same for a whole stage of scalar code, with all that it calls: the encoding of AVX needs
/// fewer instructions.
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__SANITIZE_ADDRESS__) &&             \
    !defined(__SANITIZE_THREAD__) && !defined(__clang__) && defined(__OPTIMIZE__)
#define CALOTTE_ALL_INSTRUCTIONS __attribute__((flatten, target_clones("default", "avx2")))
#else
#define CALOTTE_ALL_INSTRUCTIONS
#endif

/// Forces inlining: a call would prevent vector code in the loop around it.
#ifdef __GNUC__
#define CALOTTE_INLINE inline __attribute__((always_inline))
#else
#define CALOTTE_INLINE inline
#endif

/// Stands before a loop: no iteration reads what another one writes, which the compiler cannot
/// prove.
#if defined(__clang__)
#define CALOTTE_VECTOR_LOOP _Pragma("clang loop vectorize(assume_safety)")
#elif defined(__GNUC__)
#define CALOTTE_VECTOR_LOOP _Pragma("GCC ivdep")
#else
#define CALOTTE_VECTOR_LOOP
#endif
