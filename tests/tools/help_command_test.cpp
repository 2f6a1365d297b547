// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/command.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <vector>

using namespace calotte::test;

namespace {

const std::vector<std::string> commands{"delaunay",    "cvt",       "plan",   "points",  "check",
                                        "info",        "draw",      "view",   "convert", "cut",
                                        "cull",        "coast",     "refine", "coarsen", "rotate",
                                        "interpolate", "partition", "jigsaw", "marche",  "version"};

/// The text of a help, checked to succeed.
std::string help_text(const Bench& bench, const std::string& arguments) {
  CAPTURE(arguments);
  const Outcome help = bench.run(arguments);
  CHECK(help.code == 0);
  CHECK(help.err.empty());
  return help.out;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);)
    lines.push_back(line);
  return lines;
}

} // namespace

TEST_CASE("help has at most 50 lines of 100 columns, and ends with examples") {
  const Bench bench;
  std::vector<std::string> all = commands;
  all.insert(all.end(), {"", "help"});
  for (const std::string& command : all) {
    const std::string text = help_text(bench, command + " --help");
    const std::vector<std::string> lines = lines_of(text);
    CHECK(lines.size() <= 50);
    for (const std::string& line : lines)
      CHECK(line.size() <= 100);
    CHECK(has(text, "\nExamples:\n  calotte " + command));
  }
}

TEST_CASE("--help shows common options, --help-all the others and the exit codes, in groups") {
  const Bench bench;
  const std::string some = help_text(bench, "cvt --help"), all = help_text(bench, "cvt --help-all");
  for (const char* group :
       {"\nStart:\n", "\nWidths and density:\n", "\nStop:\n", "\nOutput:\n", "\nParallel:\n"}) {
    CHECK(has(some, group));
    CHECK(has(all, group));
  }
  for (const char* option : {"  --cells N|auto ", "  --cell-width KM|FILE ", "  -o,--output FILE ",
                             "  --region SHAPE|FILE ", "  --limited-area ", "  --gradient G ",
                             "  --outside-width KM ", "  --transition KM "}) {
    CHECK(has(some, option));
    CHECK(has(all, option));
  }
  CHECK(!has(some, "  --merge-within "));
  CHECK(has(all, "  --merge-within "));
  CHECK(has(some, "calotte cvt --help-all"));
  CHECK(has(all, "Requires --cell-width"));
  for (const std::string& command : commands)
    CHECK(has(help_text(bench, command + " --help-all"), "1  the mesh failed its check"));
  for (const std::string& line : lines_of(all))
    CHECK(line.size() <= 100);
}

TEST_CASE("help names each default once, and the words that an option takes") {
  const Bench bench;
  for (const std::string& command : commands) {
    std::string text; // without line ends and the indents after them
    std::istringstream words(help_text(bench, command + " --help-all"));
    for (std::string word; words >> word;)
      text += word + " ";
    std::size_t from = 0;
    for (std::size_t at; (at = text.find("; default: ", from)) != std::string::npos;
         from = at + 1) {
      const std::size_t before = text.rfind("Default: ", at);
      CHECK((before == std::string::npos || text.find(" --", before) < at));
    }
  }
  CHECK(has(help_text(bench, "cut --help"), "default: 7"));
  CHECK(has(help_text(bench, "plan --help"), "  --gradient "));
  CHECK(has(help_text(bench, "points --help"), "in a planar domain: random-plane or"));
  CHECK(has(help_text(bench, "refine --help"), "stayed in their order"));
}

TEST_CASE("calotte help shows the same as --help") {
  const Bench bench;
  CHECK(help_text(bench, "help") == help_text(bench, "--help"));
  for (const std::string& command : commands)
    CHECK(help_text(bench, "help " + command) == help_text(bench, command + " --help"));
  check_refusals(bench, "help", R"(
cvtt | 2 | no help on "cvtt"; did you mean cvt? See calotte --help
densities | 2 | no help on "densities"; did you mean density? See calotte --help
zzzzzz | 2 | no help on "zzzzzz"; see calotte --help
)");
}

TEST_CASE("the first screen has four commands to copy, and says where the manual is") {
  const Bench bench;
  const std::string screen = help_text(bench, "");
  CHECK(screen == help_text(bench, "help"));
  const std::size_t examples = screen.find("\nExamples:\n"),
                    commands_at = screen.find("\nCommands:\n");
  REQUIRE(examples < commands_at);
  std::size_t count = 0;
  for (const std::string& line : lines_of(screen.substr(examples, commands_at - examples)))
    count += line.starts_with("  calotte ") ? 1 : 0;
  CHECK(count == 4);
  CHECK(has(screen, "\n  The manual is in /")); // the command of a clone
  CHECK(help_text(bench, "version") == help_text(bench, "--version"));
}

TEST_CASE("help knows the words of modellers, and names options, topics and pages that exist") {
  const Bench bench;
  std::string all;
  for (const char* options :
       {"delaunay", "cvt", "plan", "points", "check", "info", "draw", "view", "convert", "cut",
        "cull", "coast", "refine", "coarsen", "rotate", "interpolate", "partition"})
    all += help_text(bench, std::string(options) + " --help-all");
  const std::filesystem::path pages = CALOTTE_FIXTURES "/../../tools/manual";
  for (const std::string word :
       {"ocean",    "coastline",  "limited area", "regional",  "mpas",       "fesom",
        "models",   "gradient",   "units",        "straits",   "bathymetry", "raster",
        "python",   "install",    "threads",      "resume",    "shapefile",  "examples",
        "sea",      "islands",    "lake",         "land_mask", "resolution", "spacing",
        "km",       "NetCDF",     "depth",        "conda",     "memory",     "restart",
        "toml",     "geojson",    "plot",         "paraview",  "quality",    "metis",
        "remap",    "weights",    "scrip",        "hexagons",  "plane",      "periodic",
        "voronoi",  "lloyd",      "radius",       "mars",      "errors",     "gebco",
        "converge", "licence",    "boundary",     "box",       "nesting",    "icosahedral",
        "rivers",   "mpas-tools", "zoom",         "namelist",  "manual",     "reproducible",
        "multimesh"}) {
    CAPTURE(word);
    const std::string text = help_text(bench, "help " + word);
    const std::vector<std::string> lines = lines_of(text);
    CHECK(has(text, "\n  "));
    CHECK(lines.size() <= 24);
    REQUIRE(lines.back().starts_with("Manual: "));
    std::istringstream words(text);
    for (std::string each; words >> each;) {
      CAPTURE(each);
      if (each.ends_with(".md,"))
        CHECK(std::filesystem::exists(pages / each.substr(0, each.size() - 1)));
      if (each.starts_with("--") && !each.starts_with("--help"))
        CHECK(has(all, each.substr(0, each.find_first_of(".,:)"))));
    }
    for (std::size_t k = 0; k + 1 < lines.size(); ++k)
      CHECK(lines[k].size() <= 100);
  }
  CHECK(help_text(bench, "help sea ice") == help_text(bench, "help ocean"));
  for (const char* word : {"coastline", "straits", "gebco", "schism", "adcirc"})
    CHECK(has(help_text(bench, std::string("help ") + word), "coasts.md"));
  CHECK(has(help_text(bench, "help dislocations"), "Options that mention \"dislocations\":\n"));
}

TEST_CASE("the syntax of a density stands in one place, to which the options refer") {
  const Bench bench;
  const std::string topic = help_text(bench, "help density");
  CHECK(has(topic, "stretch"));
  for (const std::string& line : lines_of(topic))
    CHECK(line.size() <= 100);
  for (const char* command : {"cvt", "plan", "info", "draw", "convert"})
    for (const char* option : {" --help", " --help-all"}) {
      const std::string help = help_text(bench, std::string(command).append(option));
      CHECK(has(help, "calotte help density"));
      CHECK(!has(help, "stretch"));
    }
  CHECK(has(help_text(bench, "help exit-codes"), "1  the mesh failed its check"));
}

TEST_CASE("help explains each word that info prints") {
  const Bench bench;
  const std::string topic = help_text(bench, "help measures");
  for (const std::string& line : lines_of(topic))
    CHECK(line.size() <= 100);
  for (const char* command :
       {"cvt --cells 642 -o closed.nc", "cvt --region circle=10,20,3000km --cells 300 -o open.vtp",
        "cvt --region circle=10,20,2000km --cell-width 300km --limited-area -o area.nc",
        "points random 60 -o random.txt", "delaunay random.txt -o random.vtp"})
    CHECK(bench.run(command).code == 0);
  const std::set<std::string> plain{"",     "cells",     "triangles", "distances",
                                    "cell", "longitude", "latitude"};
  const auto check_words = [&](const std::string& arguments, std::size_t width) {
    CAPTURE(arguments);
    for (const std::string& line : lines_of(help_text(bench, arguments))) {
      if (line.starts_with("- x") || line.starts_with("longest stable step ") ||
          line.find(": the ") != std::string::npos)
        continue; // the steps of other equations, whose rows are wider, or a remark
      std::string word = line.substr(0, width);
      for (const char* end : {",", " x speed", " / spacing", " / dc   ", " error  "})
        word = word.substr(0, word.find(end));
      word.erase(word.find_last_not_of(' ') + 1);
      word.erase(0, word.find_first_not_of(' '));
      CAPTURE(word);
      CHECK((plain.contains(word) || has(topic, word)));
    }
  };
  for (const char* file :
       {"closed.nc", "closed.nc --density tanh:lon=9,lat=3,beta=30deg,alpha=0.2,gamma=x2",
        "random.vtp", "open.vtp", "area.nc", "closed.nc --operators"})
    check_words(std::string("info ") + file, 22);
  CHECK(has(topic, "longest stable step"));
  check_words("info closed.nc --cell 3 --operators --density "
              "tanh:lon=9,lat=3,beta=30deg,alpha=0.2,gamma=x2",
              28);
}

TEST_CASE("a misspelt option or command is answered with the nearest one") {
  const Bench bench;
  check_refusals(bench, "", R"(
cvtt | 2 | unknown command cvtt; did you mean cvt? See calotte --help
cvtt --cells 12 -o mesh.vtp | 2 | unknown command cvtt; did you mean cvt?
cvtt --help | 2 | unknown command cvtt; did you mean cvt?
grid | 2 | unknown command grid; see calotte help grid
cvt --outside 300 -o mesh.vtp | 2 | unknown option --outside; did you mean --outside-width?
cvt 642 -o mesh.vtp | 3 | check its name and its permissions; a number of cells is --cells 642
plan 642 | 3 | a number of cells is --cells 642
cvt --cell-width 60 km -o mesh.vtp | 3 | permissions; a number and its unit are one word, such as 60km
ocean earth.nc | 2 | unknown command ocean; see calotte help ocean
cvt --resolution 60km -o mesh.vtp | 2 | unknown option --resolution; see calotte help resolution
--verison | 2 | unknown option --verison; did you mean --version? See calotte --help
cvt --cells 12 -o mesh.vtp --tolerence 1e-5 | 2 | unknown option --tolerence; did you mean --tolerance? See calotte cvt --help
cvt --cells 12 -o mesh.vtp --tolerence=1e-5 | 2 | unknown option --tolerence; did you mean --tolerance?
cvt --cells 12 --tolerence 1e-5 | 2 | unknown option --tolerence; did you mean --tolerance?
cvt --cells 12 --max_iteration 3 -o mesh.vtp | 2 | unknown option --max_iteration; did you mean --max-iterations?
cvt --cells 12 -o mesh.vtp --frobnicate | 2 | unknown option --frobnicate; see calotte cvt --help
cvt --cells 12 -o mesh.vtp --factor 2 | 2 | unknown option --factor; it is one of calotte refine and calotte coarsen; see calotte cvt --help
cvt --cells 12 --o mesh.vtp | 2 | unknown option --o; did you mean -o? See calotte cvt --help
CVT --cells 12 -o mesh.vtp | 2 | unknown command CVT; did you mean cvt? See calotte --help
cvt --Cells 12 -o mesh.vtp | 2 | unknown option --Cells; did you mean --cells?
)");
}
