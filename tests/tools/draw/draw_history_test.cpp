// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/history.h"
#include "support/constants.h"
#include "support/pictures.h"
#include "support/text.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

using namespace calotte;
using namespace calotte::test;
using namespace calotte::tools;
using nlohmann::json;

namespace {

/// A run of two levels whose norms and energy excess fall by a tenth each iteration; every fourth
/// one has flips, and the first of each level is a rebuild.
json sample_report(int iterations_of_level = 20, double scale = 1) {
  json report = {{"density", {"uniform"}}, {"norm", "l2-scaled"}, {"tolerance", 1e-3},
                 {"converged", true},      {"cells", 642},        {"seconds", 0.5}};
  for (const int cells : {162, 642}) {
    const double h = std::sqrt(4 * pi / cells);
    for (int k = 0; k < iterations_of_level; ++k) {
      const double fall = scale * std::pow(0.9, k);
      report["iterations"].push_back({{"cells", cells},
                                      {"rule", 3},
                                      {"l2", 1e-2 * h * fall},
                                      {"linf", 5e-2 * h * fall},
                                      {"gradient", 1e-3 * fall},
                                      {"energy", 25.44 / cells * (1 + 1e-2 * fall)},
                                      {"flips", k % 4 == 0 ? 7 : 0},
                                      {"rebuilt", k == 0},
                                      {"seconds", 0.01},
                                      {"seconds_exchange", 0.001},
                                      {"seconds_repair", 0.002},
                                      {"seconds_moments", 0.003}});
    }
  }
  return report;
}

std::string written(const Folder& folder, const std::string& text,
                    const std::string& name = "report.json") {
  std::ofstream(folder.file(name), std::ios::binary) << text;
  return folder.file(name);
}

History history_of_report(const Folder& folder, const json& report) {
  return read_history(written(folder, report.dump(2)));
}

/// Checks that reading fails with one line that names the file and the key.
void check_refused(const Folder& folder, const std::string& text, const std::string& key) {
  CAPTURE(text.substr(0, 200));
  const Error error = error_of([&] { read_history(written(folder, text)); });
  const std::string message = error.what();
  CAPTURE(message);
  CHECK(error.code() == ErrorCode::parse);
  CHECK(message.starts_with(folder.file("report.json")));
  CHECK(has(message, key));
  CHECK(message.find('\n') == std::string::npos);
}

std::vector<double> excess_of(const History& history) { return energy_excess({history})[0]; }

const HistoryColumn& by_evaluations(const HistoryPage& page) { return page.columns[0]; }

std::vector<double> positions_in(const HistoryColumn& column, const History& history) {
  return column.quantity == Across::seconds ? elapsed_seconds(history)
                                            : evaluation_numbers(history);
}

std::uint32_t pixel_at(const Picture& picture, const PagePoint& point) {
  return picture.at(static_cast<int>(point.x), static_cast<int>(point.y));
}

} // namespace

TEST_CASE("a report is read by its keys") {
  const Folder folder;
  const History history = history_of_report(folder, sample_report());
  CHECK(history.name == folder.file("report.json"));
  CHECK(history.norm == Norm::l2_scaled);
  CHECK(history.tolerance == 1e-3);
  CHECK(history.converged);
  CHECK(history.seconds == 0.5);
  CHECK(history.density == std::vector<std::string>{"uniform"});
  REQUIRE(history.iterations.size() == 40);
  CHECK(history.iterations[4].flips == 7);
  CHECK(history.iterations[20].rebuilt);
  CHECK(!history.iterations[21].rebuilt);
  CHECK(level_starts(history) == std::vector<std::size_t>{0, 20, 40});
  for (const std::size_t i : {0U, 19U, 20U, 39U}) {
    const double fall = std::pow(0.9, i % 20);
    CHECK(scaled_l2(history)[i] == doctest::Approx(1e-2 * fall));
    CHECK(scaled_linf(history)[i] == doctest::Approx(5e-2 * fall));
  }
}

TEST_CASE("a file that is no report is refused in a line that names the file and the key") {
  const Folder folder;
  for (const char* key : {"density", "norm", "tolerance", "converged", "seconds", "iterations"}) {
    json report = sample_report();
    report.erase(key);
    check_refused(folder, report.dump(), std::string(key) + " is missing");
    report[key] = json::object();
    check_refused(folder, report.dump(), std::string(key) + " is ");
    report[key] = nullptr;
    check_refused(folder, report.dump(), std::string(key) + " is ");
  }
  for (const char* key : {"cells", "rule", "l2", "linf", "energy", "flips", "rebuilt", "seconds"}) {
    json report = sample_report();
    const std::string position = std::string("iterations[3].") + key;
    json& iteration = report["iterations"][3];
    iteration.erase(key);
    check_refused(folder, report.dump(), position + " is missing");
    for (const json& bad : {json("1"), json(nullptr), json(-2), json::array({1})}) {
      iteration[key] = bad;
      check_refused(folder, report.dump(), position + " is ");
    }
  }
  json report = sample_report();
  report["iterations"][2]["cells"] = 0;
  check_refused(folder, report.dump(), "iterations[2].cells is not an integer >= 1");
  report["iterations"][2]["cells"] = 1.5;
  check_refused(folder, report.dump(), "iterations[2].cells");
  report["iterations"][2] = 5;
  check_refused(folder, report.dump(), "iterations[2].cells is missing");
  report["norm"] = "l7";
  check_refused(folder, report.dump(), "norm is not one of l2, ");
  for (const json& bad : {json(1), json("uniform"), json::array({1})}) {
    report["norm"] = "l2";
    report["density"] = bad;
    check_refused(folder, report.dump(), "density is not an array of strings");
  }
  report = sample_report();
  report["iterations"] = json::array();
  check_refused(folder, report.dump(), "iterations is empty: the run made no iteration");
}

TEST_CASE(
    "keys of newer reports are read and checked; without them all evaluations count as accepted") {
  const Folder folder;
  json report = sample_report();
  const History old = history_of_report(folder, report);
  CHECK(old.method.empty());
  CHECK(old.iterations[3].accepted);
  CHECK(old.iterations[3].seconds_solver == 0);
  json& iteration = report["iterations"][3];
  for (const char* method : {"auto", "lloyd", "lbfgs", "lbfgs-laplacian"}) {
    report["method"] = method;
    CHECK(history_of_report(folder, report).method == method);
  }
  iteration["accepted"] = false;
  iteration["seconds_solver"] = 0.25;
  const History history = history_of_report(folder, report);
  CHECK(!history.iterations[3].accepted);
  CHECK(history.iterations[3].seconds_solver == 0.25);
  iteration["accepted"] = 1;
  check_refused(folder, report.dump(), "iterations[3].accepted is neither true nor false");
  iteration["accepted"] = true;
  iteration["seconds_solver"] = -1;
  check_refused(folder, report.dump(), "iterations[3].seconds_solver is not a number >= 0");
  iteration["seconds_solver"] = 0;
  report["method"] = "newton";
  check_refused(folder, report.dump(), "method is not one of auto, lloyd, ");
  report["method"] = 3;
  check_refused(folder, report.dump(), "method is not one of auto, lloyd, ");
}

TEST_CASE("the clock sums the evaluations, rejected ones included, and the solver") {
  const Folder folder;
  json report = sample_report();
  report["iterations"][2]["seconds_solver"] = 0.5;
  report["iterations"][4]["accepted"] = false;
  const History history = history_of_report(folder, report);
  const std::vector<double> elapsed = elapsed_seconds(history);
  for (std::size_t i = 0; i < elapsed.size(); ++i) {
    const auto number = static_cast<double>(i + 1);
    CHECK(evaluation_numbers(history)[i] == number);
    CHECK(elapsed[i] == doctest::Approx(0.01 * number + (i < 2 ? 0 : 0.5)));
  }
}

TEST_CASE(
    "rejected evaluations have no norms and no excess, and do not affect the excess of others") {
  const Folder folder;
  json report = sample_report();
  const std::vector<double> before = excess_of(history_of_report(folder, report));
  const json trial = {{"cells", 162},     {"rule", 3},       {"l2", 1},
                      {"linf", 1},        {"energy", 1e3},   {"flips", 9},
                      {"rebuilt", false}, {"seconds", 0.01}, {"accepted", false}};
  json& iterations = report["iterations"];
  iterations.insert(iterations.begin() + 20, trial); // the last of the first level
  iterations.insert(iterations.begin() + 5, trial);
  const History history = history_of_report(folder, report);
  const std::vector<double> excess = excess_of(history);
  std::size_t next = 0;
  for (std::size_t i = 0; i < excess.size(); ++i) {
    CAPTURE(i);
    const bool rejected = i == 5 || i == 21;
    CHECK(std::isnan(excess[i]) == rejected);
    CHECK(std::isnan(scaled_l2(history)[i]) == rejected);
    CHECK(std::isnan(scaled_linf(history)[i]) == rejected);
    if (!rejected) {
      CHECK(excess[i] == before[next++]);
    }
  }
}

TEST_CASE("the excess is over the best of the runs with as many cells, that density and rule") {
  const Folder folder;
  json better = sample_report(30);
  better["method"] = "lbfgs";
  const History best = history_of_report(folder, better);
  const History other = history_of_report(folder, sample_report(10));
  const auto both = energy_excess({other, best});
  for (std::size_t i = 0; i < 10; ++i) { // in any run, the same energy has the same excess
    CHECK(both[0][i] == doctest::Approx(both[1][i]));
    CHECK(both[0][10 + i] == doctest::Approx(both[1][30 + i]));
  }
  CHECK(both[1] == excess_of(best));
  CHECK(both[1].back() == 0);
  const double end = other.iterations.back().energy;
  const double least = best.iterations.back().energy;
  CHECK(both[0].back() == doctest::Approx(end / least - 1));
  for (const char* difference : {"density", "cells", "rule"}) {
    CAPTURE(difference);
    json apart = better;
    apart["density"] = difference == std::string("density") ? json{"bump"} : json{"uniform"};
    for (json& iteration : apart["iterations"]) {
      if (difference != std::string("density")) {
        iteration[difference] = iteration[difference].get<int>() + 1;
      }
    }
    CHECK(energy_excess({other, history_of_report(folder, apart)})[0] == excess_of(other));
  }
}

TEST_CASE("a file that is no JSON, or is cut short, is refused with its line") {
  const Folder folder;
  const std::string whole = sample_report(2).dump(2);
  for (std::size_t length = 0; length < whole.size(); length += 37) {
    check_refused(folder, whole.substr(0, length), "is not JSON, or was cut short");
  }
  check_refused(folder, whole + "x", "not JSON");
  check_refused(folder, std::string(whole).replace(0, 1, std::string(3, '\0')), "line 1: ");
  check_refused(folder, "{\n\n\"norm\": oh }", "line 3: ");
  check_refused(folder, "{\"norm\": \"l2\", \"tolerance\": 1e999}", "too large");
  check_refused(folder, std::string(100000, '['), "not JSON");
  for (const char* text : {"[]", "null", "7", "\"report\"", "{}"}) {
    check_refused(folder, text, "density is missing");
  }
  CHECK(code_of([&] { read_history(folder.file("absent.json")); }) == ErrorCode::file);
  CHECK(code_of([&] { read_history(folder.path.string()); }) == ErrorCode::file);
}

TEST_CASE(
    "the tolerance of a scaled norm is unchanged, that of another is divided by h, and without "
    "one it is NaN") {
  const Folder folder;
  json report = sample_report();
  for (const char* norm : {"l2-scaled", "linf-scaled", "l2", "linf", "none"}) {
    CAPTURE(norm);
    report["norm"] = norm;
    const std::vector<double> tolerance = scaled_tolerance(history_of_report(folder, report));
    const std::string word = norm;
    if (word == "none") {
      CHECK(std::isnan(tolerance[5]));
    } else {
      const bool scaled = word.ends_with("-scaled");
      CHECK(tolerance[5] == doctest::Approx(scaled ? 1e-3 : 1e-3 / std::sqrt(4 * pi / 162)));
      CHECK(tolerance[25] == doctest::Approx(scaled ? 1e-3 : 1e-3 / std::sqrt(4 * pi / 642)));
    }
  }
}

TEST_CASE("the energy's excess falls to 0 in each level, for any energies of the rules") {
  const Folder folder;
  json report = sample_report();
  const std::vector<double> excess = excess_of(history_of_report(folder, report));
  for (std::size_t i = 0; i < excess.size(); ++i) {
    const double end = std::pow(0.9, 19);
    const double expected =
        1e-2 * (std::pow(0.9, static_cast<double>(i % 20)) - end) / (1 + 1e-2 * end);
    CHECK(excess[i] == doctest::Approx(expected).epsilon(1e-9));
  }
  // From iteration 12 of the second level on another rule applies, which gives higher energies.
  for (std::size_t i = 32; i < 40; ++i) {
    json& iteration = report["iterations"][i];
    iteration["rule"] = 6;
    iteration["energy"] = iteration["energy"].get<double>() + 1e-5;
  }
  const std::vector<double> joined = excess_of(history_of_report(folder, report));
  const double step = 1e-2 * (std::pow(0.9, 10) - std::pow(0.9, 11)); // of the descent before
  for (std::size_t i = 0; i < excess.size(); ++i) {
    CAPTURE(i);
    CHECK(std::abs(joined[i] - excess[i]) < 0.01 * excess[i] + 0.11 * step);
  }
  CHECK(joined[39] == 0);
}

namespace {

/// True if a column's frames are in order on the page and contain the whole run in order.
void check_column(const HistoryPage& page, const HistoryColumn& column, const History& history) {
  CHECK(column.norms.left > 0);
  CHECK(column.norms.right() < page.width);
  CHECK(column.norms.top > page.levels);
  CHECK(column.energy.top > column.norms.bottom());
  CHECK(column.repairs.top > column.energy.bottom());
  CHECK(page.height > column.repairs.bottom());
  const std::vector<double> across = positions_in(column, history);
  const std::vector<double> l2 = scaled_l2(history);
  const std::vector<double> linf = scaled_linf(history);
  for (std::size_t i = 0; i < l2.size(); ++i) {
    const PagePoint point = column.norms.at(across[i], l2[i]);
    CHECK(point.x > column.norms.left);
    CHECK(point.x < column.norms.right());
    CHECK(point.y < column.norms.bottom());
    CHECK(column.norms.at(across[i], linf[i]).y > column.norms.top);
    CHECK(column.norms.at(across[i], linf[i]).y < point.y);
    CHECK(column.energy.at(across[i], 1).x == point.x);
    if (i % 20 > 0) { // smaller is further down, later is further right
      const PagePoint before = column.norms.at(across[i - 1], l2[i - 1]);
      CHECK(point.x > before.x);
      CHECK(point.y > before.y);
    }
  }
}

} // namespace

TEST_CASE("the frames stand on the page apart from each other, and hold all data") {
  const Folder folder;
  const History two_levels = history_of_report(folder, sample_report());
  for (const std::size_t runs : {1U, 3U, 8U}) {
    for (const int size : {64, 300, 1200}) {
      const HistoryPage page = history_page(std::vector(runs, two_levels), size);
      CHECK(page.width == size);
      CHECK(page.columns[0].quantity == Across::evaluations);
      CHECK(page.columns[1].quantity == Across::seconds);
      CHECK(page.columns[1].norms.left > page.columns[0].norms.right());
      for (const HistoryColumn& column : page.columns) {
        check_column(page, column, two_levels);
      }
    }
  }
}

TEST_CASE("runs of very different length have logarithmic axes across, which hold all data") {
  const Folder folder;
  const History brief = history_of_report(folder, sample_report(1));
  for (const int length : {20, 21}) {
    const std::vector<History> both = {history_of_report(folder, sample_report(length)), brief};
    const HistoryPage page = history_page(both, 1200);
    for (const HistoryColumn& column : page.columns) {
      for (const Frame* frame : {&column.norms, &column.energy, &column.repairs}) {
        CHECK(frame->across.logarithmic == (length > 20));
      }
      for (const History& history : both) {
        for (const double position : positions_in(column, history)) {
          CHECK(column.norms.across.position(position) > 0);
          CHECK(column.norms.across.position(position) < 1);
        }
      }
    }
  }
}

namespace {

/// The curves have the colour of the run at its values.
void check_curves(const Picture& picture, const HistoryColumn& column, const History& history) {
  const Rgb colour = history_colour(0);
  const std::vector<double> across = positions_in(column, history);
  const std::vector<double> l2 = scaled_l2(history);
  const std::vector<double> excess = excess_of(history);
  for (std::size_t i = 1; i < 40; ++i) {
    CAPTURE(i);
    if (i == 19 || i == 20) { // there the line between the levels is near
      continue;
    }
    CHECK(has_colour(pixel_at(picture, column.norms.at(across[i], l2[i])), colour));
    CHECK(pixel_at(picture, column.norms.at(across[i], 0.37 * l2[i])) != packed(colour));
    if (excess[i] > 0) {
      CHECK(has_colour(pixel_at(picture, column.energy.at(across[i], excess[i])), colour));
    }
  }
}

/// The middle of a flip's stroke, and the foot of a rebuild's triangle.
void check_marks(const Picture& picture, const HistoryPage& page, const HistoryColumn& column,
                 const History& history) {
  const std::vector<double> across = positions_in(column, history);
  const auto mark = [&](std::size_t i, double letters) {
    const PagePoint point = {column.repairs.at(across[i], 0).x,
                             column.repairs.top + letters * page.text};
    return has_colour(pixel_at(picture, point), history_colour(0));
  };
  for (std::size_t i = 1; i < 19; ++i) {
    CAPTURE(i);
    CHECK(mark(i, 0.6) == (i % 4 == 0));
    CHECK(!mark(i, 1.3));
  }
  CHECK(mark(0, 1.3));
  CHECK(mark(20, 1.3));
}

} // namespace

TEST_CASE("the picture has its size, and its curves, steps and marks in their places") {
  const Folder folder;
  const History history = history_of_report(folder, sample_report());
  draw_history(folder.file("a.png"), {history}, 2400);
  const Picture picture(folder.file("a.png"));
  const HistoryPage page = history_page({history}, 2400);
  CHECK(picture.width() == 2400);
  CHECK(picture.height() == page.height);
  for (const HistoryColumn& column : page.columns) {
    CAPTURE(static_cast<int>(column.quantity));
    check_curves(picture, column, history);
    check_marks(picture, page, column, history);
  }
}

TEST_CASE("the tolerance is a dashed line, and a level ends in a full one") {
  const Folder folder;
  const History history = history_of_report(folder, sample_report());
  draw_history(folder.file("a.png"), {history}, 1800);
  const Picture picture(folder.file("a.png"));
  const HistoryPage page = history_page({history}, 1800);
  const auto dark = [&](const PagePoint& at) { return (pixel_at(picture, at) & 0xff) < 0xd8; };
  for (const HistoryColumn& column : page.columns) {
    const std::vector<double> across = positions_in(column, history);
    int dashes = 0;
    int gaps = 0;
    for (double part = 0; part < 1; part += 0.003) {
      const double x = std::lerp(across[1], across[17], part);
      (dark(column.norms.at(x, history.tolerance)) ? dashes : gaps) += 1;
    }
    CHECK(dashes > 50);
    CHECK(gaps > 50);
    const double border = column.quantity == Across::seconds ? across[19] : 20.5;
    for (const Frame* frame : {&column.norms, &column.energy, &column.repairs}) {
      int full = 0;
      for (int step = 1; step < 100; ++step) {
        PagePoint at = frame->at(border, 1);
        at.y = frame->top + step * frame->height / 100;
        const bool found = dark(at) || dark({at.x - 1, at.y}) || dark({at.x + 1, at.y});
        full += found ? 1 : 0;
      }
      CHECK(full == 99);
    }
  }
}

TEST_CASE("a curve skips rejected evaluations") {
  const Folder folder;
  json report = sample_report();
  for (const char* key : {"l2", "linf"}) { // would lower the curve, still within the frame
    report["iterations"][9][key] = report["iterations"][19][key];
  }
  for (const bool accepted : {true, false}) {
    report["iterations"][9]["accepted"] = accepted;
    const History history = history_of_report(folder, report);
    draw_history(folder.file("a.png"), {history}, 2400);
    const Picture picture(folder.file("a.png"));
    const HistoryPage page = history_page({history}, 2400);
    for (const HistoryColumn& column : page.columns) {
      const double tried = 1e-2 * std::pow(0.9, 19);
      const double between = 1e-2 * std::pow(0.9, 9);
      const double x = positions_in(column, history)[9];
      const auto drawn = [&](double l2) {
        return has_colour(pixel_at(picture, column.norms.at(x, l2)), history_colour(0));
      };
      CHECK(drawn(tried) == accepted);
      CHECK(drawn(between) == !accepted);
    }
  }
}

TEST_CASE("several runs have different colours") {
  const Folder folder;
  std::vector<History> histories;
  for (const double scale : {1., 0.3, 0.1}) {
    histories.push_back(history_of_report(folder, sample_report(20, scale)));
  }
  draw_history(folder.file("a.png"), histories, 1800);
  const Picture picture(folder.file("a.png"));
  const HistoryPage page = history_page(histories, 1800);
  for (std::size_t run = 0; run < histories.size(); ++run) {
    const double l2 = scaled_l2(histories[run])[10];
    CHECK(
        has_colour(pixel_at(picture, by_evaluations(page).norms.at(11, l2)), history_colour(run)));
  }
}

TEST_CASE("the oddest reports can be drawn in every format") {
  const Folder folder;
  std::vector<History> all;
  const auto add = [&](const json& report) {
    all.push_back(history_of_report(folder, report));
    for (const char* picture : {"a.png", "a.svg", "a.pdf"}) {
      draw_history(folder.file(picture), {all.back()}, 100);
    }
  };
  json report = sample_report(1);
  add(report);
  report["iterations"].erase(1);
  add(report);
  for (const double extreme : {0.0, 5e-324, 1e-200, 1e200, 1.7e308}) {
    report = sample_report(3);
    for (const char* key : {"l2", "linf", "energy"}) {
      report["iterations"][1][key] = extreme;
      report["iterations"][5][key] = extreme;
    }
    report["tolerance"] = extreme;
    add(report);
  }
  for (const char* key : {"seconds", "seconds_solver"}) {
    for (const double extreme : {0.0, 5e-324, 1.7e308}) {
      report = sample_report(3);
      for (json& iteration : report["iterations"]) {
        iteration[key] = extreme;
      }
      add(report);
    }
  }
  report = sample_report(3);
  for (json& iteration : report["iterations"]) {
    iteration["accepted"] = false;
  }
  all.resize(7);
  add(report);
  all.back().name =
      "a name that is no UTF-8 \xff\xfe\xc3, has *marks_{} and " + std::string(400, 'x') + ".json";
  draw_history(folder.file("a.svg"), all, 64);
  CHECK(bytes_of(folder.file("a.svg")).ends_with("</svg>\n"));
  draw_history(folder.file("a.pdf"), all, 64);
  CHECK(bytes_of(folder.file("a.pdf")).ends_with("%%EOF\n"));
}

TEST_CASE("no reports, too many, an invalid size or suffix: refused, and no file is left") {
  const Folder folder;
  const History history = history_of_report(folder, sample_report());
  const std::vector<History> one = {history};
  const auto code = [&](const std::string& name, const std::vector<History>& histories, int size) {
    return code_of([&] { draw_history(folder.file(name), histories, size); });
  };
  CHECK(code("a.png", {}, 1200) == ErrorCode::invalid_argument);
  CHECK(code("a.png", std::vector(most_histories + 1, history), 1200) ==
        ErrorCode::invalid_argument);
  CHECK(code("a.png", one, 63) == ErrorCode::invalid_argument);
  CHECK(code("a.jpg", one, 1200) == ErrorCode::invalid_argument);
  CHECK(code("none/a.png", one, 1200) == ErrorCode::file);
  CHECK(folder.count() == 1); // the report
}
