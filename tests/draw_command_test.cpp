// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/command.h"

#include <doctest/doctest.h>

using namespace calotte::test;

namespace {

const std::string bump = "tanh:lon=270,lat=30,beta=30deg,alpha=0.20,gamma=x2";

/// A run's mesh and report.
void make_run(const Bench& bench, const std::string& name) {
  const Outcome outcome = bench.run("cvt --cells 162 --tolerance 1e-2 --density " + bump + " -o " +
                                    name + ".vtp --report " + name + ".json");
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
}

} // namespace

TEST_CASE("the reports of calotte cvt become a picture of convergence") {
  const Bench bench;
  make_run(bench, "a");
  make_run(bench, "b");
  const Outcome one = bench.run("draw --history a.json -o a.png --size 300");
  CHECK(one.code == 0);
  CHECK(one.err.empty());
  CHECK(one.out == "a.png: convergence of 1 run\n");
  CHECK(bench.file("a.png").starts_with("\x89PNG"));
  const Outcome two = bench.run("draw --history a.json b.json -o two.svg");
  CHECK(two.out == "two.svg: convergence of 2 runs\n");
  CHECK(bench.file("two.svg").ends_with("</svg>\n"));
}

TEST_CASE("a mesh and its density become a picture of the spacing law") {
  const Bench bench;
  make_run(bench, "a");
  const Outcome outcome = bench.run("draw a.vtp --spacing-law --density " + bump + " -o law.pdf");
  CHECK(outcome.code == 0);
  CHECK(outcome.err.empty());
  CHECK(outcome.out == "law.pdf: spacing law of 162 sites, 320 triangles\n");
  CHECK(bench.file("law.pdf").starts_with("%PDF-"));
}

TEST_CASE("the options of one picture are refused for another, before anything is read") {
  const Bench bench;
  const auto check_usage = [&](const std::string& arguments, const std::string& message) {
    check_refusal(bench, "draw " + arguments, 2, message + "; see calotte draw --help");
  };
  check_usage("-o a.png", "MESH is required");
  check_usage("a.vtp -o a.png --spacing-law", "--spacing-law requires --density");
  check_usage("a.vtp -o a.png --density uniform", "--density requires --spacing-law");
  check_usage("a.vtp -o a.png --spacing-law --density uniform --view 1,2",
              "--view excludes --spacing-law");
  check_usage("a.vtp --history a.json -o a.png", "MESH excludes --history");
  check_usage("--history a.json -o a.png --what cells", "--what excludes --history");
  check_usage("--history a.json -o a.png --spacing-law --density uniform",
              "--history excludes --spacing-law");
  check_usage("--history 1 2 3 4 5 6 7 8 9 -o a.png",
              "--history: At Most 8 required but received 9");
}

TEST_CASE("what is no report is named, and nothing is written") {
  const Bench bench;
  const std::string remedy = "; give a report of calotte cvt --report";
  bench.file("a.json", "{\"norm\": \"l2\"}\n");
  check_refusal(bench, "draw --history a.json -o a.png", 2, "a.json: density is missing" + remedy);
  bench.file("empty.json", "");
  check_refusal(bench, "draw --history empty.json -o a.png", 2,
                "empty.json line 1: this is not JSON, or was cut short" + remedy);
  check_refusal(bench, "draw --history absent.json -o a.png", 3,
                "cannot read absent.json: No such file or directory; check its name and its "
                "permissions");
  check_refusal(bench, "draw --history a.json -o a.gif", 2,
                "a.gif: the suffix names no picture format; use .png, .svg or .pdf");
  bench.file("a.png", "{}");
  check_refusal(bench, "draw --history a.png -o a.png", 2,
                "a.png is both input and output; give the output another name");
}
