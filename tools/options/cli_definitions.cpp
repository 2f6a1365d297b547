// SPDX-License-Identifier: GPL-3.0-or-later
// The other files include <CLI/App.hpp>, which compiles in half the time of <CLI/CLI.hpp>.
// The virtual functions that it declares are compiled here.
#include <CLI/CLI.hpp>

namespace {

[[gnu::used]] void compile_virtual_functions() { const CLI::App app; }

} // namespace
