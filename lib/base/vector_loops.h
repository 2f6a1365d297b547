// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// How the loops are compiled that vector code is wanted of.

/// Compiled for several vector widths, of which the widest that the machine has is chosen when the
/// program starts. Not under sanitizers, whose runtime is not ready by then.
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__SANITIZE_ADDRESS__) &&             \
    !defined(__SANITIZE_THREAD__) && !defined(__clang__)
#define CALOTTE_VECTOR_WIDTHS __attribute__((target_clones("default", "avx2", "avx512f")))
#else
#define CALOTTE_VECTOR_WIDTHS
#endif

/// A call would end the vector code of the loop around it.
#ifdef __GNUC__
#define CALOTTE_INLINE inline __attribute__((always_inline))
#else
#define CALOTTE_INLINE inline
#endif

/// Before a loop: no iteration reads what another one writes, though the compiler cannot know.
#if defined(__clang__)
#define CALOTTE_VECTOR_LOOP _Pragma("clang loop vectorize(assume_safety)")
#elif defined(__GNUC__)
#define CALOTTE_VECTOR_LOOP _Pragma("GCC ivdep")
#else
#define CALOTTE_VECTOR_LOOP
#endif
