// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "help/cli_forward.h"

/// The command's parts. A subcommand throws calotte::Error, which main turns into one line and an
/// exit code.
namespace calotte::tools {

// Each registers one subcommand with its options and a callback that does the work.

void add_delaunay(CLI::App& app);
void add_cvt(CLI::App& app);
void add_plan(CLI::App& app);
void add_points(CLI::App& app);
void add_check(CLI::App& app);
void add_info(CLI::App& app);
void add_draw(CLI::App& app);
void add_view(CLI::App& app);
void add_convert(CLI::App& app);
void add_cut(CLI::App& app);
void add_cull(CLI::App& app);
void add_coast(CLI::App& app);
void add_refine(CLI::App& app);
void add_coarsen(CLI::App& app);
void add_rotate(CLI::App& app);
void add_interpolate(CLI::App& app);
void add_partition(CLI::App& app);
void add_jigsaw(CLI::App& app);
void add_marche(CLI::App& app);
void add_version(CLI::App& app);
void add_help(CLI::App& app); ///< last: it shows the help of the others

} // namespace calotte::tools
