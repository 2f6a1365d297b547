// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/config_option.h"

#include "help/nearest_name.h"
#include "support/files.h"

#include <calotte/error.h>

#include <CLI/App.hpp>
#include <doctest/doctest.h>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

using namespace calotte;
using namespace calotte::tools;

namespace {

/// A command with options of every kind, and the folder of its file of options.
class Parser {
public:
  Parser() {
    app_.add_option("POINTS,--points", points)->type_name("FILE");
    app_.add_option("--cell-width", cell_width)->type_name("KM|FILE");
    app_.add_option("--region", region)->type_name("SHAPE|FILE");
    app_.add_option("--density", densities)->allow_extra_args(false);
    app_.add_option("--start", start)->check(CLI::IsMember({"random", "spiral"}));
    app_.add_option("--sort", sort);
    app_.add_option("-o,--output", output)->type_name("FILE");
    CLI::Option* tolerance_option = app_.add_option("--tolerance", tolerance);
    app_.add_option("--max-iterations", limit);
    app_.add_option("--iterations", iterations)->excludes(tolerance_option);
    app_.add_option("--half-life", half_life)->needs(tolerance_option);
    app_.add_option("--cells", cells)
        ->check(CLI::Validator([](std::string&) { return ""; }, "N|auto"))
        ->type_name("");
    app_.add_option("--seed", seed);
    app_.add_flag("--lonlat", lonlat);
    config_ = add_config(app_);
  }
  Parser(const Parser&) = delete;
  Parser& operator=(const Parser&) = delete;

  std::string path() const { return folder_ / "run.toml"; }

  /// Parses a file with this text, together with arguments on the command line.
  void parse(const std::string& text, const std::string& arguments = "") {
    test::write_text(path(), text);
    app_.parse(arguments + " --config " + path());
    CHECK(*config_ == path());
  }

  std::string in_folder(const std::string& file) const { return folder_ / file; }

  std::string points, cell_width, region, start, sort, cells, output;
  std::vector<std::string> densities;
  double tolerance = 0, half_life = 0;
  int limit = 0, iterations = 0;
  std::uint64_t seed = 0;
  bool lonlat = false;

private:
  CLI::App app_{"", "test"};
  test::Scratch folder_;
  std::shared_ptr<std::string> config_;
};

/// The message of a rejection without the file's name, with which every message starts.
std::string refused_options(const std::string& text, const std::string& arguments = "") {
  Parser parser;
  try {
    parser.parse(text, arguments);
  } catch (const Error& error) {
    const std::string message = error.what(), name = parser.path() + " ";
    REQUIRE(message.starts_with(name));
    CHECK(message.starts_with(name + "line " + std::to_string(error.index()) + ": "));
    CHECK(message.find('\n') == std::string::npos);
    return message.substr(name.size());
  }
  return "not refused";
}

/// The same for values of which the message has the key, on line 2.
std::string refused_value(const std::string& setting) {
  const std::string message = refused_options("# a run\n" + setting + "\n");
  const std::string start = "line 2: " + setting.substr(0, setting.find(' ')) + " ";
  CAPTURE(message);
  REQUIRE(message.starts_with(start));
  return message.substr(start.size());
}

} // namespace

TEST_CASE("every kind of value reaches its option") {
  Parser parser;
  parser.parse("start = \"random\" # a comment\ntolerance = 1e-6\nmax-iterations = 163_842\n"
               "seed = 0x10\nlonlat = true\ndensity = ['one,two', \"three\"]\n");
  CHECK(parser.start == "random");
  CHECK(parser.tolerance == 1e-6);
  CHECK(parser.limit == 163'842);
  CHECK(parser.seed == 16);
  CHECK(parser.lonlat);
  CHECK(parser.densities == std::vector<std::string>{"one,two", "three"});
  for (const std::string cells : {"42", "auto"}) {
    Parser other;
    other.parse(cells == "auto" ? "cells = \"auto\"" : "cells = 42");
    CHECK(other.cells == cells);
  }
}

TEST_CASE("numbers keep their bits, in quotes, too") {
  for (const double value : {0.1, 1.0 / 3, 1e-300, 0x1.fffffffffffffp+100}) {
    Parser parser;
    std::ostringstream text;
    text.precision(17);
    text << std::scientific << value;
    parser.parse("tolerance = " + text.str());
    CHECK(parser.tolerance == value);
  }
  Parser parser;
  parser.parse("seed = \"18446744073709551615\"\ntolerance = 3\n");
  CHECK(parser.seed == std::numeric_limits<std::uint64_t>::max());
  CHECK(parser.tolerance == 3);
}

TEST_CASE("hyphens and underscores are equivalent, and a table's name has no effect") {
  for (const std::string text :
       {"max-iterations = 7\ntolerance = 2\n", "max_iterations = 7\ntolerance = 2\n",
        "tolerance = 2\n[end]\nmax_iterations = 7\n",
        "[a]\nmax-iterations = 7\n[tolerance]\ntolerance = 2\n",
        "end = { max-iterations = 7, tolerance = 2 }\n",
        "end.tolerance = 2\nend.max_iterations = 7\n"}) {
    CAPTURE(text);
    Parser parser;
    parser.parse(text);
    CHECK(parser.limit == 7);
    CHECK(parser.tolerance == 2);
  }
  CHECK(refused_options("[a]\ntolerance = 1\n[a.b]\nseed = 1\n") ==
        "line 3: table b is nested in table a; nested tables are not supported; remove the inner "
        "one");
}

TEST_CASE("the command line takes precedence, also over options that it excludes") {
  const std::string text =
      "tolerance = 1e-3\nseed = 3\nlonlat = true\ndensity = [\"one\", \"two\"]\n";
  Parser parser;
  parser.parse(text, "--seed 4 --density three");
  CHECK(parser.tolerance == 1e-3);
  CHECK(parser.seed == 4);
  CHECK(parser.lonlat);
  CHECK(parser.densities == std::vector<std::string>{"three"});
  Parser other;
  other.parse(text, "--iterations 9");
  CHECK(other.iterations == 9);
  CHECK(other.tolerance == 0);
  Parser needing; // one that the command line excludes
  needing.parse("half-life = 3\n" + text, "--iterations 9");
  CHECK(needing.half_life == 0);
  Parser needed;
  needed.parse("half-life = 3\n" + text, "--tolerance 2");
  CHECK(needed.half_life == 3);
  Parser third;
  third.parse("iterations = 9\n", "--tolerance 1e-4");
  CHECK(third.iterations == 0);
  CHECK(third.tolerance == 1e-4);
  Parser both;
  CHECK_THROWS_AS(both.parse("iterations = 9\ntolerance = 1\n"), CLI::ExcludesError);
  // A wrong value in the file is an error even if the command line has another.
  CHECK(refused_options("seed = true\n", "--seed 4") ==
        "line 1: seed takes an integer, not true or false");
}

TEST_CASE("a flag that is false is not given") {
  Parser parser;
  parser.parse("lonlat = false\n");
  CHECK(!parser.lonlat);
}

TEST_CASE("files that are read are relative to the file of options, others to the folder") {
  Parser parser;
  parser.parse("points = \"points.txt\"\ncell-width = \"widths.txt\"\nsort = \"points.txt\"\n"
               "output = \"mesh.nc\"\n");
  CHECK(parser.output == "mesh.nc");
  CHECK(parser.points == parser.in_folder("points.txt"));
  CHECK(parser.cell_width == parser.in_folder("widths.txt"));
  CHECK(parser.sort == "points.txt"); // an option that is not allowed in a file
  Parser outright;
  outright.parse("points = \"/absolute\"\ncell-width = \"60km\"\n");
  CHECK(outright.points == "/absolute");
  CHECK(outright.cell_width == "60km");
  Parser standard;
  standard.parse("points = \"-\"\n");
  CHECK(standard.points == "-");
  for (const std::string shape : {"circle=1,2,3km", "box=1,2,3,4", "no=shape"}) {
    Parser by_words;
    by_words.parse("region = \"" + shape + "\"\n");
    CHECK(by_words.region == shape);
  }
  Parser area, land;
  area.parse("region = \"area.geojson\"\n");
  CHECK(area.region == area.in_folder("area.geojson"));
  land.parse("region = \"land=coast.nc,1,2\"\n");
  CHECK(land.region == "land=" + land.in_folder("coast.nc") + ",1,2");
  Parser named_land; // as its shape
  named_land.parse("region = \"land=land,1,2\"\n");
  CHECK(named_land.region == "land=" + named_land.in_folder("land") + ",1,2");
  Parser overridden;
  overridden.parse("points = \"points.txt\"\n", "there.txt");
  CHECK(overridden.points == "there.txt");
}

TEST_CASE("the names of MPI-SCVT") {
  Parser parser;
  parser.parse("convergence_criteria = 1e-10\nmaximum_iterations = 1000\n"
               "sort_method = 0\n");
  CHECK(parser.tolerance == 1e-10);
  CHECK(parser.limit == 1000);
  CHECK(parser.sort == "distance");
  for (const std::string sort : {"halo", "distance", "voronoi"}) {
    Parser other;
    other.parse("sort-method = '" + sort + "'");
    CHECK(other.sort == sort);
  }
  Parser other;
  other.parse("sort_method = 1\nmaximum-iterations = 9", "--max-iterations 7");
  CHECK(other.sort == "voronoi");
  CHECK(other.limit == 7);
  CHECK(refused_value("sort_method = 2") == "2 is not one of 0 (distance), 1 (voronoi), halo");
  CHECK(refused_value("sort_method = true") ==
        "true is not one of 0 (distance), 1 (voronoi), halo");
}

TEST_CASE("an unknown name is refused with the nearest, and the line") {
  const auto unknown = [](const std::string& name, const std::string& near) {
    CAPTURE(name);
    CHECK(refused_options("seed = 1\n\n" + name + " = 1\n") == "line 3: unknown option \"" + name +
                                                                   "\"; did you mean " + near +
                                                                   "? See calotte test --help");
  };
  unknown("tolerence", "tolerance");
  unknown("max_iteration", "max-iterations");
  unknown("maximal_iterations", "maximum_iterations");
  unknown("convergence_criterion", "convergence_criteria");
  unknown("sort_methods", "sort_method");
  unknown("see", "seed");
  unknown("Seed", "seed");
  CHECK(refused_options("speedometer = 1\n") ==
        "line 1: unknown option \"speedometer\"; see calotte test --help");
  for (const std::string none : {"config", "help"}) // options that are not allowed in files
    CHECK(refused_options(none + " = \"other.toml\"\n") ==
          "line 1: unknown option \"" + none + "\"; see calotte test --help");
}

TEST_CASE("a name that is given twice is refused with both lines") {
  CHECK(refused_options("max-iterations = 1\nseed = 2\nmax_iterations = 1\n") ==
        "line 3: max-iterations is given twice, also on line 1; leave one out");
  CHECK(refused_options("[a]\nconvergence_criteria = 1\n[b]\ntolerance = 2\n") ==
        "line 4: tolerance is given twice, also on line 2; leave one out");
  CHECK(refused_options("seed = 1\nseed = 2\n").starts_with("line 2: ")); // by a rule of TOML
}

TEST_CASE("values of the wrong kind are refused with their key and line") {
  CHECK(refused_value("tolerance = true") == "takes a number, not true or false");
  CHECK(refused_value("seed = false") == "takes an integer, not true or false");
  CHECK(refused_value("start = true") == "takes text in quotes, not true or false");
  CHECK(refused_value("start = 3") == "takes text in quotes, not a number");
  CHECK(refused_value("cells = true") == "takes a number or text in quotes, not true or false");
  CHECK(refused_value("density = [\"one\", 2]") == "takes text in quotes, not a number");
  CHECK(refused_value("points = 3") == "takes text in quotes, not a number");
  for (const std::string value : {"1", "\"true\"", "[true, true]"})
    CHECK(refused_value("lonlat = " + value) == "takes true or false");
  CHECK(refused_value("seed = [1, 2]") == "takes one value, and the array has 2; keep one of them");
  CHECK(refused_value("density = []") == "is an empty array; leave it out");
  const std::string other =
      "; give text in quotes, a number, true or false, or an array of texts or numbers";
  CHECK(refused_value("seed = 2020-01-01") == "holds a date or time" + other);
  CHECK(refused_value("density = [[\"one\"]]") == "holds an array" + other);
  CHECK(refused_value("density = [{ lon = 1 }]") == "holds a table" + other);
  // The message of an option for an invalid value.
  CHECK(refused_options("# a run\nstart = \"there\"\n") ==
        "line 2: --start: there not in {random,spiral}");
  CHECK(refused_options("seed = 1.5\n").starts_with("line 1: "));
  CHECK(refused_options("tolerance = \"small\"\n").starts_with("line 1: "));
  CHECK(refused_options("max_iterations = 99999999999\n").starts_with("line 1: "));
}

TEST_CASE("a file that is no TOML is refused with its line") {
  for (const std::string text :
       {"seed = 1\nstart = random\n", "seed = 1\nstart\n", "seed = 1\ndensity = [\"one\"\n\n",
        "seed = 1\n[end\n", "seed = 1\nstart = \"ran\n", "seed = 1\n= 3\n",
        "seed = 1\nstart = \"\xff\"\n", "seed = 1\ntolerance = 1e\n",
        "seed = 1\nseed = 99999999999999999999\n"}) {
    CAPTURE(text);
    const std::string message = refused_options(text);
    CAPTURE(message);
    CHECK((message.starts_with("line 2: ") || message.starts_with("line 3: ") ||
           message.starts_with("line 4: ")));
    CHECK(message.ends_with("; write key = value, with text in quotes"));
  }
}

TEST_CASE("the message names the first wrong line") {
  CHECK(refused_options("seed = 1\nzebra = 1\n[table]\naardvark = 2\n")
            .starts_with("line 2: unknown option \"zebra\""));
}

TEST_CASE("a file that cannot be read") {
  CLI::App app("", "test");
  const auto config = add_config(app);
  try {
    app.parse("--config absent.toml");
    FAIL("not refused");
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::file);
    CHECK(error.what() ==
          std::string("cannot read absent.toml: No such file or directory; check its name and its "
                      "permissions"));
  }
  CHECK_THROWS_WITH_AS(app.parse("--config /"),
                       "cannot read /: it is a folder; give the name of a file", Error);
}

TEST_CASE("the distance of words is a metric that counts letters") {
  const std::vector<std::string> words{"",          "a",        "b",    "ab",         "tolerance",
                                       "tolerence", "olerance", "sort", "sort-method"};
  for (const std::string& a : words)
    for (const std::string& b : words) {
      CHECK((edit_distance(a, b) == 0) == (a == b));
      CHECK(edit_distance(a, b) == edit_distance(b, a));
      CHECK(edit_distance(a, b) <= std::max(a.size(), b.size()));
      for (const std::string& c : words)
        CHECK(edit_distance(a, c) <= edit_distance(a, b) + edit_distance(b, c));
    }
  CHECK(edit_distance("tolerance", "tolerence") == 1);
  CHECK(edit_distance("tolerance", "olerance") == 1);
  CHECK(edit_distance("sort", "sort-method") == 7);
}
