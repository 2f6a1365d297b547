// SPDX-License-Identifier: GPL-3.0-or-later
// The start of every test program, compiled once. Both names, for builds that have precompiled the
// header before.
#define DOCTEST_CONFIG_IMPLEMENT
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>
