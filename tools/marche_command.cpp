// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"
#include "help/help.h"
#include "io/command.h"
#include "options/delaunay_options.h"
#include "options/jig_file.h"
#include "run/interruption.h"
#include "run/progress.h"
#include "text/text.h"

#include <CLI/App.hpp>

#include <iostream>
#include <memory>
#include <optional>
#include <string>

namespace calotte::tools {
namespace {

void run_marche(const std::string& path) {
  const JigFile jig(path);
  const std::string widths = jig.file("HFUN_FILE");
  const double radius =
      jig.text("GEOM_FILE") ? read_jigsaw_geometry(jig.file("GEOM_FILE")).radius : 1;
  const std::optional<int> threads = jig.threads();
  Progress progress;
  progress.stage("limiting the gradient of " + widths);
  announce_files();
  const double seconds =
      seconds_of([&] { with_threads(threads, [&] { limit_jigsaw_values(widths, radius); }); });
  std::cout << message("{}: gradient limited, {} s\n", widths, formatted("%.2f", seconds));
}

} // namespace

void add_marche(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "marche",
      "Limits the gradient of widths as JIGSAW's program of this name does. The values of the grid "
      "HFUN_FILE become the largest ones below them that change by at most its SLOPE, which is one "
      "number, in a unit of length. The file is written anew. See calotte help jig.");
  auto path = std::make_shared<std::string>();
  command->add_option("FILE", *path, "Options of JIGSAW (.jig)")->required()->type_name("FILE.jig");
  set_help(*command, {.common = {},
                      .examples = {"calotte marche mesh.jig",
                                   "calotte marche mesh.jig && calotte jigsaw mesh.jig"}});
  command->callback([path] { run_marche(*path); });
}

} // namespace calotte::tools
