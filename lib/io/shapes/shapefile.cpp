// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/shapes/shapefile.h"

#include "base/message.h"
#include "io/bytes/file.h"
#include "io/bytes/file_error.h"
#include "io/bytes/file_names.h"
#include "io/bytes/text.h"

#include <nlohmann/json.hpp>
#include <shapefil.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace calotte::io_detail {
namespace {

/// The last error of shapelib, which passes it to a function without further arguments.
thread_local std::string last_error;

void keep_error(const char* text) {
  last_error = text;
  while (!last_error.empty() && (last_error.back() == '.' || last_error.back() == '\n'))
    last_error.pop_back();
}

/// The number that a text is, but for blanks around it; NaN if it is none.
double number_in(std::string_view text) {
  text = text.substr(0, text.find_last_not_of(' ') + 1);
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  double value = 0;
  return parse_number(text, value).outcome == Outcome::ok ? value : std::nan("");
}

/// atof() would depend on the locale, and read 12 from 12abc.
double number_of_table(const char* text) { return number_in(text); }

SAHooks make_hooks() {
  SAHooks hooks;
  SASetupDefaultHooks(&hooks);
  hooks.Error = keep_error;
  hooks.Atof = number_of_table;
  last_error.clear();
  return hooks;
}

struct Close {
  void operator()(SHPInfo* file) const { SHPClose(file); }
  void operator()(DBFInfo* table) const { DBFClose(table); }
  void operator()(SHPObject* shape) const { SHPDestroyObject(shape); }
};

/// The path of a file beside NAME.shp, as shapelib looks for it; none if there is no such file.
std::optional<std::string> beside(const std::string& path, const char* lower, const char* upper) {
  for (const char* const suffix : {lower, upper}) {
    const std::filesystem::path other = std::filesystem::path(path).replace_extension(suffix);
    if (std::error_code error; std::filesystem::exists(other, error))
      return other.string();
  }
  return std::nullopt;
}

std::string with_suffix(const std::string& path, const char* suffix) {
  return std::filesystem::path(path).replace_extension(suffix).string();
}

/// A keyword of well-known text, and what follows its bracket.
struct Word {
  std::string_view keyword, rest;
};

std::vector<Word> words_of(std::string_view text) {
  std::vector<Word> words;
  std::size_t start = 0;
  bool in_quotes = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"')
      in_quotes = !in_quotes;
    if (in_quotes)
      continue;
    if (c == '[' || c == '(')
      words.push_back({text.substr(start, i - start), text.substr(i + 1)});
    if (!(c >= 'A' && c <= 'Z') && !(c >= 'a' && c <= 'z') && c != '_')
      start = i + 1;
  }
  return words;
}

/// The number after the name of a unit or a meridian: "Degree",0.0174532925199433. NaN without one.
double number_after_name(std::string_view rest) {
  const std::size_t open = rest.find('"'), close = rest.find('"', open + 1),
                    comma = rest.find(',', close);
  return open == rest.npos || close == rest.npos || comma == rest.npos
             ? std::nan("")
             : number_in(rest.substr(comma + 1, rest.find_first_of(",])", comma + 1) - comma - 1));
}

bool is_any_of(std::string_view keyword, std::initializer_list<std::string_view> keywords) {
  return std::ranges::find(keywords, keyword) != keywords.end();
}

/// Whether well-known text describes degrees east of Greenwich and degrees north.
bool is_geographic(const std::string& text) {
  std::string upper = text;
  std::ranges::transform(upper, upper.begin(), [](char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  });
  constexpr double degree = std::numbers::pi / 180;
  bool geographic = false, vertical = false;
  for (const auto& [keyword, rest] : words_of(upper)) {
    vertical |= keyword.starts_with("VERT");
    geographic |= is_any_of(keyword, {"GEOGCS", "GEOGCRS", "GEOGRAPHICCRS", "GEODCRS"});
    if (is_any_of(keyword, {"PROJCS", "PROJCRS", "PROJECTEDCRS", "GEOCCS", "LOCAL_CS", "ENGCRS"}))
      return false;
    const double number = number_after_name(rest);
    if (keyword == "PRIMEM" && !(number == 0))
      return false;
    if ((keyword == "ANGLEUNIT" || (keyword == "UNIT" && !vertical)) &&
        !(std::abs(number / degree - 1) < 1e-6))
      return false;
  }
  return geographic;
}

using Ring = std::vector<GeoPosition>;

/// Twice the area, positive counter-clockwise.
double area_of(const Ring& ring) {
  double area = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const auto& [x, y] = ring[i];
    const auto& [u, v] = ring[(i + 1) % ring.size()];
    area += (x - ring[0][0]) * (v - ring[0][1]) - (u - ring[0][0]) * (y - ring[0][1]);
  }
  return area;
}

bool is_inside(const GeoPosition& point, const Ring& ring) {
  bool inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const auto& [x, y] = ring[i];
    const auto& [u, v] = ring[(i + 1) % ring.size()];
    if ((y > point[1]) != (v > point[1]) && point[0] < x + (point[1] - y) / (v - y) * (u - x))
      inside = !inside;
  }
  return inside;
}

struct Box {
  explicit Box(const Ring& ring) : low(ring[0]), high(ring[0]) {
    for (const GeoPosition& position : ring)
      for (std::size_t k = 0; k < 2; ++k) {
        low[k] = std::min(low[k], position[k]);
        high[k] = std::max(high[k], position[k]);
      }
  }
  bool contains(const Box& other) const {
    return low[0] <= other.low[0] && low[1] <= other.low[1] && other.high[0] <= high[0] &&
           other.high[1] <= high[1];
  }
  GeoPosition low, high;
};

/// A hole may touch a ring around it, but only at corners of both.
bool is_within(const Ring& hole, const Ring& ring) {
  for (const GeoPosition& corner : hole)
    if (std::ranges::find(ring, corner) == ring.end())
      return is_inside(corner, ring);
  const GeoPosition &a = hole[0], &b = hole[1 % hole.size()];
  return is_inside({(a[0] + b[0]) / 2, (a[1] + b[1]) / 2}, ring);
}

/// The polygons of the rings of a shape, as GeoJSON has them: an outer ring, then its holes.
Json polygons_of(const std::vector<Ring>& rings) {
  std::vector<double> areas;
  std::vector<Box> boxes;
  for (const Ring& ring : rings) {
    areas.push_back(area_of(ring));
    boxes.emplace_back(ring);
  }
  // Outer rings run clockwise, but some programs write them the other way round.
  const double largest =
      *std::ranges::max_element(areas, {}, [](double area) { return std::abs(area); });
  const auto is_outer = [&](std::size_t r) { return !(areas[r] * largest < 0); };
  std::vector<std::size_t> owner(rings.size());
  for (std::size_t r = 0; r < rings.size(); ++r) {
    owner[r] = r; // without a ring around it, a hole is a polygon
    for (std::size_t o = 0; o < rings.size() && !is_outer(r); ++o)
      if (is_outer(o) && (owner[r] == r || std::abs(areas[o]) < std::abs(areas[owner[r]])) &&
          std::abs(areas[o]) > std::abs(areas[r]) && boxes[o].contains(boxes[r]) &&
          is_within(rings[r], rings[o]))
        owner[r] = o;
  }
  std::vector<Json> polygons(rings.size());
  for (std::size_t r = 0; r < rings.size(); ++r)
    if (owner[r] == r)
      polygons[r] = Json::array({rings[r]});
  for (std::size_t r = 0; r < rings.size(); ++r)
    if (owner[r] != r)
      polygons[owner[r]].push_back(rings[r]);
  std::erase(polygons, Json());
  return polygons;
}

class Shapefile {
public:
  Shapefile(const std::string& path, const GeoPair& pair) : path_(path) {
    if (pair.degrees)
      check_projection();
    if (!beside(path, ".shx", ".SHX"))
      fail_read(path, message("there is no index {} beside it; copy it there, or make it with "
                              "GDAL: {}",
                              with_suffix(path, ".shx"),
                              ogr2ogr("--config SHAPE_RESTORE_SHX YES",
                                      with_suffix(path, ".geojson"), path)));
    SAHooks hooks = make_hooks();
    file_.reset(SHPOpenLL(path.c_str(), "rb", &hooks));
    if (!file_)
      fail_damaged(path, "no shapefile, or its index {} is damaged ({})", with_suffix(path, ".shx"),
                   last_error);
    if (!beside(path, ".dbf", ".DBF"))
      return;
    table_.reset(DBFOpenLL(path.c_str(), "rb", &hooks));
    if (!table_)
      fail_damaged(path, "its table {} cannot be read", with_suffix(path, ".dbf"));
  }

  void visit(const GeometryVisit& visit) {
    int count = 0;
    SHPGetInfo(file_.get(), &count, nullptr, nullptr, nullptr);
    if (count == 0)
      fail_file(path_, "there is no shape in it; give a file with shapes");
    for (int i = 0; i < count; ++i) {
      where_ = message("shape {}: ", i);
      last_error.clear();
      if (table_ && i < DBFGetRecordCount(table_.get()) && DBFIsRecordDeleted(table_.get(), i) != 0)
        continue;
      const std::unique_ptr<SHPObject, Close> shape(SHPReadObject(file_.get(), i));
      if (!shape)
        fail_damaged(path_, "{}it cannot be read ({})", where_, last_error);
      if (shape->nSHPType == SHPT_NULL || shape->nVertices == 0)
        continue;
      const auto [type, coordinates] = geometry_of(*shape);
      const Json properties = properties_of(i);
      visit({i, where_, properties, Json()}, type, coordinates);
    }
  }

private:
  void check_projection() {
    const std::optional<std::string> file = beside(path_, ".prj", ".PRJ");
    bounded_ = !file;
    if (!file)
      return;
    std::ifstream in(*file, std::ios::binary);
    if (!is_geographic(read_all(in, *file)))
      fail_file(path_,
                "{} does not say longitude and latitude in degrees; convert it with GDAL: {}",
                *file, ogr2ogr("-t_srs EPSG:4326", degrees_path(), path_));
  }

  std::string degrees_path() const {
    return std::filesystem::path(path_).replace_extension().string() + "_degrees.shp";
  }

  Json properties_of(int record) {
    if (!table_)
      return Json();
    if (record >= DBFGetRecordCount(table_.get()))
      fail_damaged(path_, "{}it has no row in {}", where_, with_suffix(path_, ".dbf"));
    Json properties = Json::object();
    for (int field = 0; field < DBFGetFieldCount(table_.get()); ++field) {
      std::array<char, XBASE_FLDNAME_LEN_READ + 1> name{};
      const DBFFieldType type = DBFGetFieldInfo(table_.get(), field, name.data(), nullptr, nullptr);
      if ((type != FTDouble && type != FTInteger) ||
          DBFIsAttributeNULL(table_.get(), record, field) != 0)
        continue;
      const double value = DBFReadDoubleAttribute(table_.get(), record, field);
      if (std::isnan(value))
        fail_damaged(path_, "{}{} in its row of {} is no number", where_, name.data(),
                     with_suffix(path_, ".dbf"));
      properties[name.data()] = value;
    }
    if (!last_error.empty())
      fail_damaged(path_, "{}its row in {} cannot be read", where_, with_suffix(path_, ".dbf"));
    return properties;
  }

  GeoPosition position(const SHPObject& shape, int k) const {
    const double x = shape.padfX[k], y = shape.padfY[k];
    if (!std::isfinite(x) || !std::isfinite(y))
      fail_file(path_, "{}position {} is not a pair of finite numbers; correct it", where_, k);
    if (bounded_ && (std::abs(x) > 360 || std::abs(y) > 90))
      fail_file(path_,
                "{}position {} is [{}, {}], no longitude and latitude in degrees, and there is no "
                "{} that names its projection; convert it with GDAL: {}",
                where_, k, x, y, with_suffix(path_, ".prj"),
                ogr2ogr("-s_srs EPSG:CODE -t_srs EPSG:4326", degrees_path(), path_));
    return {x, y};
  }

  std::vector<Ring> parts_of(const SHPObject& shape) const {
    std::vector<Ring> parts;
    for (int part = 0; part < shape.nParts; ++part) {
      const int end = part + 1 < shape.nParts ? shape.panPartStart[part + 1] : shape.nVertices;
      Ring& positions = parts.emplace_back();
      for (int k = shape.panPartStart[part]; k < end; ++k)
        positions.push_back(position(shape, k));
      if (positions.empty())
        fail_damaged(path_, "{}part {} has no positions", where_, part);
    }
    if (parts.empty())
      fail_damaged(path_, "{}positions without a part", where_);
    return parts;
  }

  /// The type and the coordinates.
  std::pair<std::string, Json> geometry_of(const SHPObject& shape) const {
    switch (shape.nSHPType) {
    case SHPT_POINT:
    case SHPT_POINTZ:
    case SHPT_POINTM:
      return {"Point", position(shape, 0)};
    case SHPT_MULTIPOINT:
    case SHPT_MULTIPOINTZ:
    case SHPT_MULTIPOINTM: {
      Ring positions;
      for (int k = 0; k < shape.nVertices; ++k)
        positions.push_back(position(shape, k));
      return {"MultiPoint", positions};
    }
    case SHPT_ARC:
    case SHPT_ARCZ:
    case SHPT_ARCM:
      return {"MultiLineString", parts_of(shape)};
    case SHPT_POLYGON:
    case SHPT_POLYGONZ:
    case SHPT_POLYGONM:
      return {"MultiPolygon", polygons_of(parts_of(shape))};
    default:
      fail_file(path_,
                "{}a surface of several patches is neither a line nor a polygon; leave it "
                "out",
                where_);
    }
  }

  const std::string& path_;
  std::string where_;    ///< "shape 3: ", for messages
  bool bounded_ = false; ///< whether the coordinates must show that they are degrees
  std::unique_ptr<SHPInfo, Close> file_;
  std::unique_ptr<DBFInfo, Close> table_; ///< null without one
};

} // namespace

void read_shapefile(const std::string& path, const GeoPair& pair, const GeometryVisit& visit) {
  Shapefile(path, pair).visit(visit);
}

} // namespace calotte::io_detail
