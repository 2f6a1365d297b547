// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#if __cplusplus < 201709L // what GCC 10 says for C++20
#error "Calotte's headers need C++20: compile with -std=c++20"
#endif

/// The shared library exports the declarations between these two macros in a public header. All
/// else is compiled with hidden visibility.
#ifdef __GNUC__
#define CALOTTE_API_BEGIN _Pragma("GCC visibility push(default)")
#define CALOTTE_API_END _Pragma("GCC visibility pop")
#else
#define CALOTTE_API_BEGIN
#define CALOTTE_API_END
#endif
