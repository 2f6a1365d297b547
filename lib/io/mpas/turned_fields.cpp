// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mpas/turned_fields.h"

#include "base/spherical_angles.h"
#include "io/cells/limited_area_masks.h"
#include "io/mpas/mpas_variables.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <string_view>

namespace calotte::io_detail {
namespace {

using Kind = FieldTurn::Kind;

// ---- Words

struct WordPair {
  std::string_view east, north;
};
constexpr std::array<WordPair, 4> words{{{"zonal", "meridional"},
                                         {"Zonal", "Meridional"},
                                         {"eastward", "northward"},
                                         {"Eastward", "Northward"}}};

/// The next place of a word; descriptions of MPAS have "horizonal", too.
std::size_t find_word(const std::string& text, std::string_view word, std::size_t from) {
  std::size_t at = text.find(word, from);
  while (at != text.npos && at >= 4 && text.compare(at - 4, 4, "hori") == 0)
    at = text.find(word, at + 1);
  return at;
}

/// A text of eastward components as that of northward ones; empty if it has no such word.
std::string northward(const std::string& text) {
  std::string out = text;
  bool found = false;
  for (const auto& [east, north] : words)
    for (std::size_t at = find_word(out, east, 0); at != out.npos;
         at = find_word(out, east, at + north.size())) {
      out.replace(at, east.size(), north);
      found = true;
    }
  return found ? out : "";
}

using Text = std::string FieldTraits::*;
constexpr std::array<Text, 3> texts{&FieldTraits::name, &FieldTraits::long_name,
                                    &FieldTraits::standard_name};

bool names_direction(const FieldTraits& field) {
  return std::ranges::any_of(texts, [&](Text text) {
    return std::ranges::any_of(words, [&](const WordPair& pair) {
      return find_word(field.*text, pair.east, 0) != std::string::npos ||
             find_word(field.*text, pair.north, 0) != std::string::npos;
    });
  });
}

/// Whether both can be components of one vector.
bool are_alike(const FieldTraits& a, const FieldTraits& b) {
  return a.real && b.real && a.dimensions == b.dimensions;
}

// ---- Components

class Turns {
public:
  explicit Turns(const std::vector<FieldTraits>& fields) : fields_(fields), turns_(fields.size()) {}

  std::vector<FieldTurn> find() {
    take_table();
    for (std::size_t i = 0; i < fields_.size(); ++i)
      if (is_free(i))
        take_cartesian(i);
    for (const Text text : texts)
      for (std::size_t i = 0; i < fields_.size(); ++i)
        if (is_free(i))
          take_pair(i, text);
    for (std::size_t i = 0; i < fields_.size(); ++i)
      if (is_free(i) && fields_[i].along_edges)
        turns_[i].kind = Kind::along_edges;
    for (std::size_t i = 0; i < fields_.size(); ++i)
      if (is_free(i) && fields_[i].real && (names_direction(fields_[i]) || is_tensor(fields_[i])))
        turns_[i].kind = Kind::unknown;
    return std::move(turns_);
  }

private:
  bool is_free(std::size_t i) const { return turns_[i].kind == Kind::none; }

  std::optional<std::size_t> index_of(const std::string& name) const {
    const auto at = std::ranges::find(fields_, name, &FieldTraits::name);
    return at == fields_.end() ? std::nullopt
                               : std::optional(static_cast<std::size_t>(at - fields_.begin()));
  }

  void set(Kind kind, const std::vector<std::size_t>& parts) {
    for (std::size_t k = 0; k < parts.size(); ++k)
      turns_[parts[k]] = {kind, parts, k};
  }

  void set_pair(Kind kind, std::size_t east, const std::string& north) {
    const std::optional<std::size_t> other = index_of(north);
    if (other && are_alike(fields_[east], fields_[*other]))
      set(kind, {east, *other});
    else
      turns_[east].kind = Kind::unknown;
  }

  /// The variables of the table of MPAS.
  void take_table() {
    const std::span<const MpasVariable> table = mpas_variables();
    for (auto row = table.begin(); row != table.end(); ++row) {
      const std::optional<std::size_t> i = index_of(row->name);
      if (!i || !is_free(*i))
        continue;
      const FieldTraits& field = fields_[*i];
      if (row->turn == MpasTurn::none)
        turns_[*i].kind = Kind::of_mesh;
      else if (row->turn == MpasTurn::vectors)
        turns_[*i].kind = field.real && is_vector(field) ? Kind::vectors : Kind::unknown;
      else if (row->turn == MpasTurn::coriolis)
        turns_[*i].kind =
            field.real && field.dimensions.size() == 1 ? Kind::coriolis : Kind::unknown;
      else if (row->turn == MpasTurn::north) // its eastward component is missing
        turns_[*i].kind = Kind::unknown;
      else
        set_pair(row->turn == MpasTurn::east2 ? Kind::twice : Kind::east_north, *i,
                 std::next(row)->name);
    }
    for (const std::string& name :
         {std::string(cell_mask), std::string(edge_mask.name), std::string(vertex_mask.name),
          mpas_cell.base_numbers(), mpas_edge.base_numbers(), mpas_vertex.base_numbers()})
      if (const std::optional<std::size_t> i = index_of(name))
        turns_[*i].kind = Kind::of_mesh;
  }

  void take_cartesian(std::size_t i) {
    const std::string& name = fields_[i].name;
    if (name.size() < 2 || name.back() != 'X')
      return;
    const std::string stem = name.substr(0, name.size() - 1);
    const std::optional<std::size_t> y = index_of(stem + "Y"), z = index_of(stem + "Z");
    if (y && z && is_free(*y) && is_free(*z) && are_alike(fields_[i], fields_[*y]) &&
        are_alike(fields_[i], fields_[*z]))
      set(Kind::components, {i, *y, *z});
  }

  void take_pair(std::size_t i, Text text) {
    const std::string north = northward(fields_[i].*text);
    std::vector<std::size_t> found, rivals;
    for (std::size_t j = 0; j < fields_.size() && !north.empty(); ++j)
      if (is_free(j) && are_alike(fields_[i], fields_[j])) {
        if (fields_[j].*text == north)
          found.push_back(j);
        else if (j != i && fields_[j].*text == fields_[i].*text)
          rivals.push_back(j);
      }
    if (found.size() == 1 && rivals.empty())
      set(Kind::east_north, {i, found.front()});
    else if (!found.empty()) // which belong together is not known
      for (const std::vector<std::size_t>& all : {std::vector{i}, found, rivals})
        for (const std::size_t j : all)
          turns_[j].kind = Kind::unknown;
  }

  static bool is_vector(const FieldTraits& field) {
    return names_vector(field) && field.last_length == 3;
  }
  static bool names_vector(const FieldTraits& field) {
    return !field.dimensions.empty() && field.dimensions.back() == "R3";
  }
  /// Whether a field has components that the table does not know.
  static bool is_tensor(const FieldTraits& field) { return names_vector(field); }

  const std::vector<FieldTraits>& fields_;
  std::vector<FieldTurn> turns_;
};

// ---- Directions

Eigen::Vector3d east_at(const Eigen::Vector3d& point) {
  const double radius = std::sqrt(point.x() * point.x() + point.y() * point.y());
  if (radius == 0)
    return {0, 1, 0};
  return {-point.y() / radius, point.x() / radius, 0};
}

Vec3 vec3(const Eigen::Vector3d& a) { return {a.x(), a.y(), a.z()}; }

} // namespace

std::vector<FieldTurn> find_turns(const std::vector<FieldTraits>& fields) {
  return Turns(fields).find();
}

void add_name(const std::string& name, const FieldTurn& turn, TurnedFields& fields) {
  switch (turn.kind) {
  case Kind::along_edges:
  case Kind::vectors:
  case Kind::components:
  case Kind::east_north:
  case Kind::twice:
    return fields.turned.push_back(name);
  case Kind::none:
    return fields.moved.push_back(name);
  case Kind::unknown:
    return fields.unturned.push_back(name);
  default:
    return;
  }
}

double SiteTurn::angle() const { return base_detail::longitude_of(cos, sin); }

SiteTurn turn_at(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Rotation& rotation) {
  const Vec3 moved = vec3(rotation.matrix() * east_at(from)), east = vec3(east_at(to)),
             north = cross(vec3(to.normalized()), east);
  const double c = dot(moved, east), s = dot(moved, north), size = std::sqrt(c * c + s * s);
  return size > 0 ? SiteTurn{c / size, s / size} : SiteTurn{};
}

Eigen::Vector3d turned(const Eigen::Vector3d& of, const Rotation& rotation) {
  return of.allFinite() ? rotation(of) : of;
}

double sine_of_latitude(const Eigen::Vector3d& point) {
  const double size = point.norm();
  return size > 0 ? point.z() / size : 0;
}

double coriolis_factor(std::span<const double> values, std::span<const double> sines) {
  double products = 0, squares = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    products += values[i] * sines[i];
    squares += sines[i] * sines[i];
  }
  const double factor = squares > 0 ? products / squares : 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!(std::abs(values[i] - factor * sines[i]) <= 1e-6 * std::abs(factor)))
      return 0;
  return std::isfinite(factor) ? factor : 0;
}

void add_coriolis(const std::string& name, std::span<const double> values, double factor,
                  TurnedFields& fields) {
  const bool constant = std::ranges::all_of(values, [&](double f) { return f == values.front(); });
  (factor != 0 ? fields.coriolis : constant ? fields.moved : fields.unturned).push_back(name);
}

} // namespace calotte::io_detail
