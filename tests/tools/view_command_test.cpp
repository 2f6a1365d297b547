// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/command.h"

#include <calotte/read.h>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>
#include <zlib.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace calotte::test;
using nlohmann::json;

namespace {

/// The text between two others, the second after the first.
std::string between(const std::string& text, const std::string& first, const std::string& second) {
  const std::size_t begin = text.find(first);
  REQUIRE(begin != std::string::npos);
  const std::size_t from = begin + first.size(), end = text.find(second, from);
  REQUIRE(end != std::string::npos);
  return text.substr(from, end - from);
}

std::string from_base64(const std::string& text) {
  static const std::string digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t word = 0;
  int bits = 0;
  for (const char letter : text.substr(0, text.find('='))) {
    word = word << 6U | static_cast<std::uint32_t>(digits.find(letter));
    bits += 6;
    if (bits >= 8) {
      bits -= 8;
      bytes += static_cast<char>(word >> static_cast<unsigned>(bits));
    }
  }
  return bytes;
}

/// A page as the browser reads it.
class HtmlPage {
public:
  explicit HtmlPage(std::string text) : text_(std::move(text)) {
    header = json::parse(between(text_, "id=\"header\">", "</script>"));
  }

  std::vector<std::uint32_t> words(const json& block) const {
    const std::string packed = from_base64(between(
        text_, "id=\"block-" + std::to_string(block["id"].get<int>()) + "\">", "</script>"));
    const std::size_t count = block["count"], width = block["width"];
    std::string bytes(count * width, '\0');
    uLongf size = bytes.size();
    REQUIRE(::uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size,
                         reinterpret_cast<const Bytef*>(packed.data()), packed.size()) == Z_OK);
    REQUIRE(size == bytes.size());
    std::vector<std::uint32_t> result(count);
    for (std::size_t plane = 0; plane < width; ++plane)
      for (std::size_t i = 0; i < count; ++i)
        result[i] |=
            static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[plane * count + i]))
            << (8 * plane);
    return result;
  }
  std::vector<std::int32_t> integers(const json& block) const {
    std::vector<std::uint32_t> values = words(block);
    const std::size_t delta = block["delta"];
    for (std::size_t i = 0; delta > 0 && i < values.size(); ++i)
      values[i] =
          ((values[i] >> 1U) ^ (0U - (values[i] & 1U))) + (i < delta ? 0 : values[i - delta]);
    return {values.begin(), values.end()};
  }
  std::vector<float> numbers(const json& block) const {
    std::vector<float> result;
    for (const std::uint32_t word : words(block))
      result.push_back(std::bit_cast<float>(word));
    return result;
  }
  const json& mesh(std::size_t k = 0) const { return header["meshes"][k]; }
  const json& measure(const std::string& name, std::size_t k = 0) const {
    for (const json& each : header["meshes"][k]["measures"])
      if (each["name"] == name)
        return each;
    FAIL(name);
    return header;
  }

  json header;

private:
  std::string text_;
};

HtmlPage make_page(const Bench& bench, const std::string& arguments) {
  CAPTURE(arguments);
  const Outcome outcome = bench.run("view " + arguments + " -o page.html");
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  return HtmlPage(bench.file("page.html"));
}

void make(const Bench& bench, const std::string& arguments) {
  const Outcome outcome = bench.run(arguments);
  CAPTURE(arguments);
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
}

/// The places of points, of three coordinates or two.
std::vector<std::vector<double>> coordinates(const HtmlPage& page, const json& mesh,
                                             const json& block) {
  const std::vector<std::int32_t> integers = page.integers(block);
  const std::size_t dimensions = mesh["low"].size();
  std::vector<std::vector<double>> points(integers.size() / dimensions);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t k = 0; k < dimensions; ++k)
      points[i].push_back(mesh["low"][k].get<double>() +
                          mesh["step"][k].get<double>() * integers[i * dimensions + k]);
  return points;
}

} // namespace

TEST_CASE("a page has the mesh's points, triangles and numbers") {
  const Bench bench;
  make(bench, "cvt --cells 642 --density tanh:lon=270,lat=30,beta=30deg,alpha=0.20,gamma=x2 "
              "--sphere-radius earth -o grid.nc");
  const HtmlPage page = make_page(bench, "grid.nc");
  const json& mesh = page.mesh();
  CHECK(page.header["title"] == "grid.nc");
  CHECK(page.header["coastlines"].is_object());
  CHECK(mesh["cells"] == 642);
  CHECK(mesh["radius"] == doctest::Approx(6371.229));
  for (const std::vector<double>& p : coordinates(page, mesh, mesh["points"]))
    CHECK(std::hypot(p[0], p[1], p[2]) == doctest::Approx(1).epsilon(1e-6));
  const std::vector<std::int32_t> ids = page.integers(mesh["triangles"]);
  CHECK(ids.size() == 3 * 1280);
  CHECK(std::set<std::int32_t>(ids.begin(), ids.end()).size() == 642);
  double area = 0;
  for (const float cell : page.numbers(page.measure("area")["values"]))
    area += cell;
  CHECK(area == doctest::Approx(4 * 3.14159265 * 6371.229 * 6371.229).epsilon(1e-4));
  CHECK(mesh["law"]["spacing"].is_number()); // the density is the file's
  CHECK(page.measure("degree")["classes"].size() >= 2);
}

TEST_CASE("the page's numbers are those of calotte info") {
  const Bench bench;
  make(bench, "cvt --cells 642 --sphere-radius earth -o grid.nc");
  make(bench, "info grid.nc --report info.json");
  const json info = json::parse(bench.file("info.json"));
  const HtmlPage page = make_page(bench, "grid.nc");
  const std::vector<std::pair<const char*, const char*>> same = {
      {"quality", "cell_quality"}, {"sigma", "sigma"}, {"triangle_quality", "triangle_quality"}};
  for (const auto& [name, key] : same) {
    CAPTURE(name);
    CHECK(page.measure(name)["least"].get<double>() == doctest::Approx(info[key]["min"]));
    CHECK(page.measure(name)["mean"].get<double>() == doctest::Approx(info[key]["mean"]));
    CHECK(page.measure(name)["greatest"].get<double>() == doctest::Approx(info[key]["max"]));
  }
  const Outcome cell = bench.run("info grid.nc --cell 17");
  const std::string spacing = between(cell.out, "spacing", " km");
  CHECK(std::stod(spacing) ==
        doctest::Approx(page.numbers(page.measure("spacing")["values"])[17]).epsilon(1e-4));
  const Outcome reported = bench.run("info grid.nc --cell 17 --report cell.json");
  CHECK(reported.out == cell.out);
  const json report = json::parse(bench.file("cell.json"));
  CHECK(report["cell"] == 17);
  CHECK(report["longitude"].get<double>() ==
        doctest::Approx(std::stod(between(cell.out, "longitude", "\n"))).epsilon(1e-5));
  CHECK(report["quantities"]["spacing"]["unit"] == "km");
  CHECK(report["quantities"]["spacing"]["value"].get<double>() ==
        doctest::Approx(std::stod(spacing)).epsilon(1e-3));
  const auto rows = std::count(cell.out.begin(), cell.out.end(), '\n');
  CHECK(static_cast<std::ptrdiff_t>(report["quantities"].size()) == rows - 3); // cell and location
  check_refusals(bench, "info grid.nc", R"(
--cell 642 | 2 | --cell 642: the mesh has the cells 0 to 641
--cell 642 --report no.json | 2 | --cell 642: the mesh has the cells 0 to 641
--cell 17 --report grid.nc | 2 | grid.nc is both input and output
)");
}

TEST_CASE("a page shows the errors of operators where they are asked for") {
  const Bench bench;
  make(bench, "cvt --cells 642 -o grid.nc");
  make(bench, "info grid.nc --operators --report info.json");
  const json info = json::parse(bench.file("info.json"))["operators"];
  const HtmlPage page = make_page(bench, "grid.nc --operators");
  for (const std::string word :
       {"divergence", "gradient", "laplacian", "curl", "tangential", "kinetic_energy"})
    CHECK(page.measure("error_" + word)["greatest"].get<double>() ==
          doctest::Approx(info[word]["max"]));
  for (const json& measure : make_page(bench, "grid.nc").mesh()["measures"])
    CHECK(!measure["name"].get<std::string>().starts_with("error_"));
  bench.file("four.txt", "0.1 0.1 1\n-0.1 0.1 1\n-0.1 -0.11 1\n0.1 -0.1 1\n");
  make(bench, "delaunay four.txt -o four.vtp"); // two triangles, no whole cell
  for (const json& measure : make_page(bench, "four.vtp --operators").mesh()["measures"])
    CHECK(!measure["name"].get<std::string>().starts_with("error_"));
}

TEST_CASE("open, planar and periodic meshes, and cells of any shape") {
  const Bench bench;
  make(bench, "cvt --region circle=-105,40,1000km --cell-width 120km --limited-area -o la.nc");
  const HtmlPage open = make_page(bench, "la.nc");
  const std::vector<std::int32_t> sides = open.integers(open.mesh()["sides"]);
  CHECK(sides.size() == open.mesh()["cells"]);
  CHECK(*std::min_element(sides.begin(), sides.end()) >= 3); // also at the boundary
  CHECK(open.measure("region")["classes"].size() == 8);
  const std::vector<float> areas = open.numbers(open.measure("area")["values"]);
  const Eigen::VectorXd of_file =
      calotte::read_cell_field(bench.folder() / "la.nc", "areaCell", std::ssize(areas)).values;
  CHECK(open.measure("area")["missing"] == 0); // those of the boundary, too
  CHECK(open.measure("quality")["missing"] == 0);
  CHECK(open.measure("area")["unit"] == "km^2"); // of widths in km
  constexpr double of_steradian = 6371.0 * 6371;
  for (std::size_t i = 0; i < areas.size(); ++i)
    CHECK(areas[i] ==
          doctest::Approx(of_steradian * of_file[static_cast<Eigen::Index>(i)]).epsilon(0x1p-15));
  make(bench, "cvt --cells 100 --periodic 2,1 -o box.nc");
  const HtmlPage box = make_page(bench, "box.nc --plane");
  const auto corners = coordinates(box, box.mesh(), box.mesh()["corners"]);
  const std::vector<std::int32_t> around = box.integers(box.mesh()["sides"]),
                                  ring = box.integers(box.mesh()["ring"]);
  const auto sites = coordinates(box, box.mesh(), box.mesh()["points"]);
  CHECK(sites.size() > 100); // copies
  std::size_t k = 0;
  for (std::size_t i = 0; i < around.size(); ++i) // corners are the copies near the site
    for (std::int32_t side = 0; side < around[i]; ++side, ++k) {
      const auto& corner = corners[static_cast<std::size_t>(ring[k])];
      CHECK(std::hypot(corner[0] - sites[i][0], corner[1] - sites[i][1]) < 0.3);
    }
  make(bench, "points latlon 6 -o points.txt");
  make(bench, "delaunay points.txt -o cells.geojson");
  CHECK(make_page(bench, "cells.geojson").mesh()["cells"].get<int>() > 12);
  make(bench, "points random 12 -o twelve.txt");
  make(bench, "delaunay twelve.txt -o twelve.ply");
  CHECK(make_page(bench, "twelve.ply").mesh()["cells"] == 12);
}

TEST_CASE("a large mesh is thinned, and keeps its worst cells") {
  const Bench bench;
  make(bench, "points random 3000 -o points.txt");
  make(bench, "delaunay points.txt -o mesh.vtp");
  const HtmlPage whole = make_page(bench, "mesh.vtp"),
                 part = make_page(bench, "mesh.vtp --most-cells 500");
  CHECK(part.mesh()["total"] == 3000);
  CHECK(part.mesh()["cells"].get<int>() <= 500);
  CHECK(part.mesh()["cells"].get<int>() > 400);
  CHECK(has(part.mesh()["notice"].get<std::string>(), "of 3000 cells"));
  CHECK(part.measure("quality")["mean"] == whole.measure("quality")["mean"]);
  const std::vector<std::int32_t> number = part.integers(part.mesh()["number"]);
  const std::vector<float> all = whole.numbers(whole.measure("quality")["values"]),
                           some = part.numbers(part.measure("quality")["values"]);
  for (std::size_t i = 0; i < some.size(); ++i)
    CHECK(some[i] == all[static_cast<std::size_t>(number[i])]);
  CHECK(*std::min_element(some.begin(), some.end()) == *std::min_element(all.begin(), all.end()));
}

TEST_CASE("two meshes, a plan, and the states of a run") {
  const Bench bench;
  make(bench, "cvt --cells 162 --start random --stop tolerance --report run.json --keep-every 10 "
              "-o grid.vtp");
  make(bench, "cvt --cells 642 -o other.vtp");
  CHECK(bench.names().contains("grid.000010.vtp"));
  const HtmlPage two = make_page(bench, "grid.vtp other.vtp --history run.json");
  CHECK(two.header["views"] == json::array({0, 1}));
  CHECK(two.header["history"]["series"].size() == 3);
  const json& states = two.header["history"]["states"];
  REQUIRE(states.size() > 1);
  CHECK(states[0]["iteration"] == 10);
  CHECK(two.mesh(states[0]["mesh"])["name"] == "grid.000010.vtp");
  CHECK(two.mesh(states[0]["mesh"])["home"].is_object());
  CHECK(two.mesh(states[0]["mesh"])["home"] == two.mesh(states[1]["mesh"])["home"]);
  const HtmlPage plan = make_page(bench, "--plan --cell-width 60km");
  CHECK(plan.measure("prescribed")["mean"] == doctest::Approx(60));
  CHECK(plan.measure("gradient")["greatest"].get<double>() < 1e-9);
  CHECK(plan.header["title"] == "plan of 163 842 cells: uniform, 60 km");
  CHECK(plan.mesh(0)["planned"] == 163842);
  CHECK(plan.mesh(0)["home"].is_null());
  const HtmlPage bump = make_page(
      bench, "--plan --cells 4000 --density tanh:lon=-90,lat=30,beta=30deg,alpha=0.2,gamma=x8");
  CHECK(bump.mesh(0)["home"]["lon"].get<double>() == doctest::Approx(-90).epsilon(0.05));
  CHECK(bump.mesh(0)["home"]["lat"].get<double>() == doctest::Approx(30).epsilon(0.1));
  CHECK(bump.measure("prescribed")["unit"] == "degrees");
  make(bench, "plan --cells 4000 --density tanh:lon=-90,lat=30,beta=30deg,alpha=0.2,gamma=x8 "
              "-o plan.html");
  CHECK(HtmlPage(bench.file("plan.html")).header["title"] == bump.header["title"]);
  const HtmlPage angles = make_page(bench, "--plan --cell-width 60km --units radians");
  CHECK(angles.measure("prescribed")["mean"] == doctest::Approx(60.0 / 6371));
}

TEST_CASE("the states of a periodic run are kept in its box") {
  const Bench bench;
  make(bench, "cvt --cells 100 --periodic 2,1 --report run.json --keep-every 20 -o box.nc");
  const HtmlPage page = make_page(bench, "box.nc --history run.json");
  REQUIRE(page.header["history"]["states"].size() > 1);
  CHECK(page.mesh(1)["name"] == "box.000020.nc");
  CHECK(page.measure("area", 1)["missing"] == 0);
  CHECK(page.measure("area", 1)["mean"] == doctest::Approx(0.02));
}

TEST_CASE("a history of a run with another number of cells has a notice") {
  const Bench bench;
  make(bench, "cvt --cells 162 --report run.json -o grid.vtp");
  make(bench, "cvt --cells 642 -o other.vtp");
  CHECK(make_page(bench, "grid.vtp --history run.json").mesh()["notice"] == "");
  CHECK(make_page(bench, "other.vtp --history run.json").mesh()["notice"] ==
        "The history is of a run with 162 cells. ");
}

TEST_CASE("two meshes have the same units") {
  const Bench bench;
  make(bench, "cvt --cells 642 --sphere-radius earth -o grid.nc");
  make(bench, "cvt --cells 162 -o plain.vtp");
  for (const char* const meshes : {"grid.nc plain.vtp", "plain.vtp grid.nc"}) {
    const HtmlPage page = make_page(bench, meshes);
    for (std::size_t k = 0; k < 2; ++k) {
      CHECK(page.measure("spacing", k)["unit"] == "km");
      CHECK(page.measure("area", k)["mean"].get<double>() * page.mesh(k)["cells"].get<double>() ==
            doctest::Approx(4 * 3.14159265 * 6371.229 * 6371.229).epsilon(1e-4));
    }
  }
}

TEST_CASE("fields of great and tiny values, and of great codes") {
  const Bench bench;
  std::string features;
  const char* const values[] = {"1e300,\"code\":100001", "-2.5e-300,\"code\":2000000003",
                                "null,\"code\":100002"};
  for (int k = 0; k < 3; ++k) {
    const std::string x = std::to_string(10 * k), y = std::to_string(10 * k + 8);
    features += std::string(k > 0 ? "," : "") + R"({"type":"Feature","properties":{"v":)" +
                values[k] + R"(},"geometry":{"type":"Polygon","coordinates":[[[)" + x + ",0],[" +
                y + ",0],[" + y + ",8],[" + x + ",8],[" + x + ",0]]]}}";
  }
  bench.file("cells.geojson", R"({"type":"FeatureCollection","features":[)" + features + "]}");
  const HtmlPage page = make_page(bench, "cells.geojson");
  const json& block = page.measure("field:v")["values"];
  CHECK(block["type"] == "double");
  const std::vector<std::uint32_t> halves = page.words(block);
  const auto number = [&](std::size_t i) {
    return std::bit_cast<double>(std::uint64_t{halves[i]} << 32U);
  };
  CHECK(number(0) == doctest::Approx(1e300).epsilon(1e-5));
  CHECK(number(1) / -2.5e-300 == doctest::Approx(1).epsilon(1e-5));
  CHECK(std::isnan(number(2)));
  const json& codes = page.measure("field:code");
  REQUIRE(codes["classes"].size() == 3);
  CHECK(codes["classes"][1]["label"] == "100002");
  CHECK(page.integers(codes["values"]) == std::vector<std::int32_t>{0, 2, 1});
}

TEST_CASE("a part of a mesh has whole shapes of the file, or none") {
  const Bench bench;
  make(bench, "cvt --region circle=-105,40,1000km --cell-width 60km --limited-area -o area.nc");
  const HtmlPage all = make_page(bench, "area.nc"),
                 page = make_page(bench, "area.nc --most-cells 100 --view -105,40");
  CHECK(page.mesh()["home"]["lon"].get<double>() == doctest::Approx(-105));
  CHECK(page.mesh()["home"]["lat"].get<double>() == doctest::Approx(40));
  const auto shapes_of = [](const HtmlPage& of) {
    const auto corners = coordinates(of, of.mesh(), of.mesh()["corners"]);
    const std::vector<std::int32_t> ring = of.integers(of.mesh()["ring"]);
    std::vector<std::vector<std::vector<double>>> shapes;
    std::size_t next = 0;
    for (const std::int32_t sides : of.integers(of.mesh()["sides"])) {
      shapes.emplace_back();
      for (std::int32_t k = 0; k < sides; ++k)
        shapes.back().push_back(corners[static_cast<std::size_t>(ring[next++])]);
    }
    return shapes;
  };
  const auto whole = shapes_of(all), part = shapes_of(page);
  const std::vector<std::int32_t> number = page.integers(page.mesh()["number"]);
  REQUIRE(part.size() == number.size());
  std::size_t shown = 0;
  for (std::size_t i = 0; i < part.size(); ++i) {
    if (part[i].empty())
      continue;
    ++shown;
    const auto& expected = whole[static_cast<std::size_t>(number[i])];
    REQUIRE(part[i].size() == expected.size());
    for (std::size_t k = 0; k < expected.size(); ++k)
      for (std::size_t d = 0; d < 3; ++d)
        CHECK(part[i][k][d] == doctest::Approx(expected[k][d]).epsilon(1e-6));
  }
  CHECK(shown >= 10);
  CHECK(shown < part.size());
}

TEST_CASE("names from files are data, never markup") {
  const Bench bench;
  make(bench, "cvt --cells 42 -o grid.vtu");
  std::string text = bench.file("grid.vtu");
  const std::string name = "Name=\"quality\"";
  text.replace(text.find(name), name.size(),
               "Name=\"&lt;/script&gt;&lt;script&gt;alert(1)&lt;/script&gt;\"");
  bench.file("<b>.vtu", text);
  const HtmlPage page = make_page(bench, "'<b>.vtu'");
  const std::string html = bench.file("page.html");
  CHECK(has(html, "alert(1)"));
  CHECK(!has(html, "<script>alert"));
  CHECK(!has(html, "<b>"));
  CHECK(page.measure("field:</script><script>alert(1)</script>")["missing"] == 0);
}

TEST_CASE("bad input of view is one line") {
  const Bench bench;
  make(bench, "cvt --cells 42 -o grid.vtp");
  make(bench, "cvt --cells 100 --periodic 2,1 -o box.nc");
  check_refusals(bench, "view", R"(
| 2 | give a mesh, or --plan and the widths of a grid
nowhere/grid.vtp | 3 | cannot read nowhere/grid.vtp: No such file or directory
grid.vtp --plan --cell-width 60km | 2 | --plan shows widths before there is a mesh; leave MESH out
grid.vtp -o grid.png | 2 | a page is HTML; give a name that ends in .html, or draw a picture: calotte draw grid.vtp -o
--plan | 2 | a density has no unit; give --cells N, or widths in km (--cell-width 60km)
--plan --cell-width 60km --field nope | 2 | --plan shows widths on the sphere; leave out --field, --mesh, --at,
--plan --cell-width 60km --sphere-radius earth | 2 | widths in km refer to --earth-radius; give it in place of
grid.vtp --view 1,91 | 2 | --view 1,91 is not a location; give longitude and latitude in degrees
box.nc --view 1,2 | 2 | --view applies to the sphere only
grid.vtp -o grid.vtp | 2 | grid.vtp is both input and output; give the output another name
grid.vtp --field nope | 2 | --field nope: the file has no such field, or one with several numbers
missing.vtp | 3 | missing.vtp
grid.vtp missing.vtp | 3 | missing.vtp
)");
}

TEST_CASE("a state that cannot be written does not end the run") {
  const Bench bench;
  std::filesystem::create_directory(bench.folder() / "grid.000010.vtp");
  const Outcome run = bench.run("cvt --cells 162 --start random --stop tolerance --keep-every 10 "
                                "--report run.json -o grid.vtp");
  CHECK(run.code == 0);
  CHECK(has(run.err, "grid.000010.vtp"));
  CHECK(has(run.err, "(the run continues)"));
  const json states = json::parse(bench.file("run.json"))["states"];
  REQUIRE(!states.empty());
  CHECK(states[0]["evaluation"] == 20);
}
