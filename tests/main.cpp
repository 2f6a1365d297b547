// SPDX-License-Identifier: GPL-3.0-or-later
// The main program of every test, compiled once. Both names are defined, for builds that have
// precompiled the header before.
#define DOCTEST_CONFIG_IMPLEMENT
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>
