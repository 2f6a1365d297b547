// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/files.h"
#include "support/text.h"

#include <calotte/error.h>
#include <calotte/ocean.h>
#include <calotte/read.h>

#include <doctest/doctest.h>
#include <shapefil.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

using namespace calotte;
using namespace calotte::test;

namespace {

struct Shape {
  int type;
  std::vector<std::vector<std::array<double, 2>>> parts;
};

constexpr const char* degrees =
    R"(GEOGCS["GCS_WGS_1984",DATUM["D_WGS_1984",SPHEROID["WGS_1984",6378137.0,298.257223563]],)"
    R"(PRIMEM["Greenwich",0.0],UNIT["Degree",0.0174532925199433]])";

/// Writes NAME.shp and NAME.shx of one type, and NAME.prj unless it is empty.
void write_shapes(const std::string& path, int type, const std::vector<Shape>& shapes,
                  const std::string& projection = degrees) {
  SHPInfo* const file = SHPCreate(path.c_str(), type);
  REQUIRE(file != nullptr);
  for (const Shape& shape : shapes) {
    std::vector<int> starts;
    std::vector<double> x, y, z;
    for (const auto& part : shape.parts) {
      starts.push_back(static_cast<int>(x.size()));
      for (const auto& [u, v] : part) {
        x.push_back(u);
        y.push_back(v);
        z.push_back(7);
      }
    }
    SHPObject* const object =
        SHPCreateObject(shape.type, -1, static_cast<int>(starts.size()), starts.data(), nullptr,
                        static_cast<int>(x.size()), x.data(), y.data(), z.data(), nullptr);
    SHPWriteObject(file, -1, object);
    SHPDestroyObject(object);
  }
  SHPClose(file);
  const std::string other = std::filesystem::path(path).replace_extension(".prj");
  std::filesystem::remove(other);
  if (!projection.empty())
    write_text(other, projection);
}

void write_widths(const std::string& path, const std::vector<double>& widths) {
  DBFInfo* const table = DBFCreate(path.c_str());
  REQUIRE(table != nullptr);
  DBFAddField(table, "NAME", FTString, 20, 0);
  DBFAddField(table, "cellWidth", FTDouble, 12, 3);
  for (std::size_t i = 0; i < widths.size(); ++i) {
    DBFWriteStringAttribute(table, static_cast<int>(i), 0, "\xc3\x85land");
    DBFWriteDoubleAttribute(table, static_cast<int>(i), 1, widths[i]);
  }
  DBFClose(table);
}

std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

const std::vector<std::array<double, 2>> outer{{0, 0}, {0, 20}, {20, 20}, {20, 0}, {0, 0}},
    hole{{5, 5}, {10, 5}, {10, 10}, {5, 10}, {5, 5}},
    island{{6, 6}, {6, 9}, {9, 9}, {9, 6}, {6, 6}},
    far{{40, -10}, {40, 10}, {60, 10}, {60, -10}, {40, -10}};

const std::string geojson_of_polygons =
    R"({"type":"MultiPolygon","coordinates":[
        [[[0,0],[0,20],[20,20],[20,0],[0,0]],[[5,5],[10,5],[10,10],[5,10],[5,5]]],
        [[[6,6],[6,9],[9,9],[9,6],[6,6]]],
        [[[40,-10],[40,10],[60,10],[60,-10],[40,-10]]]]})";

} // namespace

TEST_CASE("a shapefile has the coast, the region and the domain of the same GeoJSON") {
  const Scratch scratch;
  const std::string path = scratch / "a.shp", same = scratch / "a.geojson";
  write_text(same, geojson_of_polygons);
  for (const int type : {SHPT_POLYGON, SHPT_POLYGONZ, SHPT_POLYGONM})
    for (const bool reversed : {false, true}) { // as some programs write them
      std::vector<Shape> shapes{{SHPT_NULL, {}}, {type, {hole, outer, island, far}}};
      for (auto& part : shapes[1].parts)
        if (reversed)
          std::reverse(part.begin(), part.end());
      write_shapes(path, type, shapes);
      CHECK(std::abs(read_coast(path).area / read_coast(same).area - 1) < 1e-12);
      CHECK(read_coast(path).rings.size() == 4);
      const Surface region = read_region(path), expected = read_region(same);
      for (const auto& [x, y] :
           {std::array<double, 2>{2, 2}, {5.5, 5.5}, {7, 7}, {50, 0}, {30, 0}}) {
        const double u = x * 0.017453292519943295, v = y * 0.017453292519943295;
        const Eigen::Vector3d point(std::cos(v) * std::cos(u), std::cos(v) * std::sin(u),
                                    std::sin(v));
        CHECK(region.contains(point) == expected.contains(point));
      }
      CHECK(read_domain(path).rings().size() == read_domain(same).rings().size());
    }
}

TEST_CASE("a shapefile has lines and points, in several parts") {
  const Scratch scratch;
  const std::string path = scratch / "a.shp", same = scratch / "a.geojson";
  write_text(same,
             R"({"type":"MultiLineString","coordinates":[[[0,0],[1,2]],[[3,4],[5,6],[7,8]]]})");
  write_shapes(path, SHPT_ARCZ, {{SHPT_ARCZ, {{{0, 0}, {1, 2}}, {{3, 4}, {5, 6}, {7, 8}}}}});
  CHECK(read_lines(path) == read_lines(same));
  CHECK(read_shapes(path) == read_shapes(same));
  write_text(same, R"({"type":"MultiPoint","coordinates":[[1,2],[3,4]]})");
  write_shapes(path, SHPT_POINT, {{SHPT_POINT, {{{1, 2}}}}, {SHPT_POINT, {{{3, 4}}}}});
  CHECK(read_shapes(path) == read_shapes(same));
  CHECK(read_shapes(path).size() == 2);
}

TEST_CASE("polygons of a shapefile have the widths of its table") {
  const Scratch scratch;
  const std::string path = scratch / "a.shp", same = scratch / "a.geojson";
  write_text(same, R"({"type":"Feature","properties":{"cellWidth":50.5},"geometry":)" +
                       geojson_of_polygons + "}");
  write_shapes(path, SHPT_POLYGON, {{SHPT_POLYGON, {outer, hole, island, far}}});
  write_widths(path, {50.5});
  const PolygonWidths widths{.outside = 200, .transition = 3000};
  CHECK(read_cell_width(path, widths).values == read_cell_width(same, widths).values);
}

TEST_CASE("a row of the table may be deleted, or no number") {
  const Scratch scratch;
  const std::string path = scratch / "a.shp", table = scratch / "a.dbf";
  write_shapes(path, SHPT_POLYGON, {{SHPT_POLYGON, {outer}}, {SHPT_POLYGON, {far}}});
  write_widths(path, {50.5, 60.5});
  const std::string whole = bytes_of(table);
  DBFInfo* const deleted = DBFOpen(path.c_str(), "r+b");
  DBFMarkRecordDeleted(deleted, 0, 1);
  DBFClose(deleted);
  const auto coast = read_coast(path);
  REQUIRE(coast.rings.size() == 1);
  CHECK(coast.rings[0].row(0).minCoeff() < 0.8); // 40 degrees east and more
  const PolygonWidths widths{.outside = 200, .transition = 3000};
  std::string damaged = whole;
  const std::size_t number = damaged.find("50.500");
  REQUIRE(number != damaged.npos);
  damaged.replace(number, 6, "50abc0");
  write_text(table, damaged);
  CHECK(
      has(message_of([&] { read_cell_width(path, widths); }), "shape 0: cellWidth in its row of "));
  for (std::size_t size = 0; size < whole.size(); size += 3) {
    CAPTURE(size);
    write_text(table, whole.substr(0, size));
    CHECK_THROWS_AS(read_cell_width(path, widths), Error);
  }
  for (std::size_t byte = 0; byte < whole.size(); ++byte) { // nothing worse than an error
    damaged = whole;
    damaged[byte] = static_cast<char>(damaged[byte] ^ 0xff);
    write_text(table, damaged);
    try {
      read_cell_width(path, widths);
    } catch (const Error&) {
    }
  }
}

TEST_CASE("shapefiles without degrees are refused with the command") {
  const Scratch scratch;
  const std::string path = scratch / "a.shp";
  const std::vector<Shape> shapes{{SHPT_POLYGON, {outer}}};
  const auto refusal = [&](const std::string& projection) {
    write_shapes(path, SHPT_POLYGON, shapes, projection);
    return message_of([&] { read_coast(path); });
  };
  for (const std::string& bad :
       {"PROJCS[\"P\"," + std::string(degrees) + ",UNIT[\"Meter\",1.0]]", std::string("anything"),
        std::string(R"(GEOGCS["G",PRIMEM["Paris",2.337],UNIT["Degree",0.0174532925199433]])"),
        std::string(R"(GEOGCS["G",PRIMEM["Greenwich",0],UNIT["Grad",0.0157079632679489]])")}) {
    CHECK(has(refusal(bad), "convert it with GDAL: ogr2ogr -t_srs EPSG:4326 "));
    CHECK(read_domain(path).rings().size() == 1); // in the plane x and y have any unit
  }
  write_shapes(path, SHPT_POLYGON, shapes, "");
  CHECK(read_coast(path).rings.size() == 1);
  write_shapes(path, SHPT_POLYGON,
               {{SHPT_POLYGON, {outer}}, {SHPT_POLYGON, {{{0, 0}, {0, 9e5}, {9e5, 0}}}}}, "");
  CHECK(has(message_of([&] { read_coast(path); }), "shape 1: position 1 is [0, 900000], no"));
}

TEST_CASE("damaged shapefiles are refused with the shape") {
  const Scratch scratch;
  const std::string path = scratch / "a.shp", index = scratch / "a.shx";
  write_shapes(path, SHPT_POLYGON, {});
  CHECK(has(message_of([&] { read_coast(path); }), "there is no shape in it"));
  write_shapes(path, SHPT_POLYGON, {{SHPT_POLYGON, {outer}}, {SHPT_POLYGON, {far, hole}}});
  const std::string whole = bytes_of(path), whole_index = bytes_of(index);
  write_text(path, whole.substr(0, whole.size() - 20));
  CHECK(has(message_of([&] { read_coast(path); }), "a.shp: shape 1: it cannot be read ("));
  for (std::size_t size = 0; size < whole.size(); size += 7) {
    CAPTURE(size);
    write_text(path, whole.substr(0, size));
    CHECK_THROWS_AS(read_coast(path), Error);
  }
  write_text(path, whole);
  for (std::size_t size = 0; size < whole_index.size(); size += 7) {
    CAPTURE(size);
    write_text(index, whole_index.substr(0, size));
    CHECK_THROWS_AS(read_coast(path), Error);
  }
  std::filesystem::remove(index);
  CHECK(has(message_of([&] { read_coast(path); }), "ogr2ogr --config SHAPE_RESTORE_SHX YES "));
  write_text(index, whole_index);
  for (std::size_t byte = 0; byte < whole.size(); ++byte) { // nothing worse than an error
    std::string damaged = whole;
    damaged[byte] = static_cast<char>(damaged[byte] ^ 0xff);
    write_text(path, damaged);
    try {
      read_coast(path);
    } catch (const Error&) {
    }
  }
  CHECK(has(message_of([&] { read_mesh(path); }), "reads only as lines and polygons"));
}
