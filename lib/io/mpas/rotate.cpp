// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/rotate.h>

#include "base/array.h"
#include "base/require.h"
#include "base/spherical_angles.h"
#include "io/bytes/big_endian.h"
#include "io/mpas/mpas.h"
#include "io/mpas/mpas_part.h"
#include "io/mpas/mpas_subset.h"
#include "io/mpas/mpas_variables.h"
#include "io/mpas/turned_fields.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace calotte {
namespace io_detail {
namespace {

using Kind = FieldTurn::Kind;

/// Calls change(begin, end, values) on the floats or doubles of rows.
using ChangeValues = std::function<void(std::int64_t begin, std::int64_t end, double* values)>;

void to_doubles(const char* bytes, std::int64_t count, bool single, double* out) {
  if (!single)
    return swap_big_endian(bytes, count, 8, reinterpret_cast<char*>(out));
  Array<float> values(count);
  swap_big_endian(bytes, count, 4, reinterpret_cast<char*>(values.begin()));
  std::copy(values.begin(), values.end(), out);
}

void from_doubles(const double* values, std::int64_t count, bool single, char* out) {
  if (!single)
    return to_big_endian(values, count, out);
  Array<float> rounded(count);
  std::transform(values, values + count, rounded.begin(),
                 [](double value) { return static_cast<float>(value); });
  to_big_endian(rounded.begin(), count, out);
}

/// All of n items.
Kept keep_all(std::int64_t n) {
  return select_kept(std::vector<std::int8_t>(static_cast<std::size_t>(n)));
}

/// All of a file, as a part of it.
MpasPart whole_part(const MpasSource& source) {
  MpasPart part;
  part.cells = keep_all(source.cells());
  part.edges = keep_all(source.edges());
  part.vertices = keep_all(source.vertices());
  part.cells_on_cell = source.lists(mpas::cells_on_cell, source.cells());
  return part;
}

/// A variable of floats or doubles with a row for each cell, edge or vertex, or for each of these
/// at each time.
struct RealVariable {
  int variable = -1;
  std::size_t axis = 0; ///< the dimension of the rows
  std::int64_t width = 1;
  bool single = false;
  /// The numbers that stand for missing values.
  double fill = std::numeric_limits<double>::quiet_NaN(), missing = fill;

  bool is_missing(double value) const {
    constexpr double unset = 1e30; // NetCDF fills what was not written with 9.97e36
    return !(std::abs(value) < unset) || value == fill || value == missing;
  }
};

/// The changes of a file by a rotation.
class RotatedVariables {
public:
  RotatedVariables(const MpasSource& source, const MpasPart& part, const Rotation& rotation,
                   NetcdfSubset& subset)
      : file_(source.netcdf()), part_(part), rotation_(rotation), subset_(subset) {}

  void change_mesh() {
    for (const MpasKind* kind : kinds)
      change_coordinates(*kind);
    change_angles();
  }

  TurnedFields change_fields() {
    TurnedFields fields;
    const std::vector<FieldTraits> traits = field_traits();
    const std::vector<FieldTurn> turns = find_turns(traits);
    for (std::size_t i = 0; i < traits.size(); ++i) {
      if (turns[i].kind == Kind::coriolis)
        change_coriolis(traits[i].name, fields);
      else
        change_field(traits, turns[i], i);
      add_name(traits[i].name, turns[i], fields);
    }
    return fields;
  }

private:
  static constexpr std::array<const MpasKind*, 3> kinds{&mpas_cell, &mpas_edge, &mpas_vertex};

  const Kept& items(const MpasKind& kind) const {
    return kind.rows == MpasDimension::cells   ? part_.cells
           : kind.rows == MpasDimension::edges ? part_.edges
                                               : part_.vertices;
  }

  const NetcdfVariable& header(int variable) const {
    return file_.variables()[static_cast<std::size_t>(variable)];
  }

  /// The first dimension of a variable that is that of cells, edges or vertices, and its kind; null
  /// for none.
  std::pair<std::size_t, const MpasKind*> find_axis(const std::string& name) const {
    const std::vector<std::string> dimensions = file_.dimensions_of(name);
    for (std::size_t d = 0; d < dimensions.size(); ++d)
      for (const MpasKind* kind : kinds)
        if (dimensions[d] == kind->dimension())
          return {d, kind};
    return {0, nullptr};
  }

  bool is_real(int variable) const {
    return header(variable).type == NetcdfType::float32 ||
           header(variable).type == NetcdfType::float64;
  }

  /// \throws Error parse, for other numbers.
  RealVariable real(const std::string& name, const MpasKind& kind) const {
    const auto [axis, of] = find_axis(name);
    const int variable = file_.find(name);
    if (of != &kind || !is_real(variable))
      file_.fail("{} does not hold floating-point numbers for each {}; make the file again", name,
                 kind.word);
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    return {variable,
            axis,
            row_values(file_, subset_, variable),
            header(variable).type == NetcdfType::float32,
            file_.number(name, "_FillValue", none),
            file_.number(name, "missing_value", none)};
  }

  std::vector<double> read(const RealVariable& of, const MpasKind& kind, std::int64_t begin,
                           std::int64_t end) const {
    const std::int64_t count = (end - begin) * of.width;
    Array<double> stored(count); // sufficient for floats
    auto* const bytes = reinterpret_cast<char*>(stored.begin());
    read_kept_rows(file_, of.variable, of.axis, items(kind), begin, end, bytes);
    std::vector<double> values(static_cast<std::size_t>(count));
    to_doubles(bytes, count, of.single, values.data());
    return values;
  }

  /// The coordinates of the items of rows, which are numbered anew at each time.
  Points3 points(const MpasKind& kind, std::int64_t begin, std::int64_t end) const {
    const std::int64_t n = items(kind).count();
    Points3 out(3, end - begin);
    for (int k = 0; k < 3; ++k) {
      const RealVariable axis = real(kind.axis(k), kind);
      for (std::int64_t row = begin; row < end;) {
        const std::int64_t first = row % n, count = std::min(n - first, end - row);
        const std::vector<double> values = read(axis, kind, first, first + count);
        for (std::int64_t i = 0; i < count; ++i)
          out(k, row - begin + i) = values[static_cast<std::size_t>(i)];
        row += count;
      }
    }
    return out;
  }

  void add_change(const std::string& name, const MpasKind& kind, const ChangeValues& change) {
    const RealVariable of = real(name, kind);
    subset_.changes[name].push_back(
        [of, change](std::int64_t begin, std::int64_t end, char* bytes) {
          const std::int64_t count = (end - begin) * of.width;
          std::vector<double> values(static_cast<std::size_t>(count));
          to_doubles(bytes, count, of.single, values.data());
          change(begin, end, values.data());
          from_doubles(values.data(), count, of.single, bytes);
        });
  }

  // ---- The mesh

  bool has_points(const MpasKind& kind) const {
    return file_.has_variable(kind.axis(0)) && file_.has_variable(kind.axis(1)) &&
           file_.has_variable(kind.axis(2));
  }

  /// \throws Error invalid_argument.
  void require_points(const MpasKind& kind, const std::string& name) const {
    if (!has_points(kind))
      base_detail::refuse(message("{} holds {}, but not {}, {} and {}; complete it with calotte "
                                  "convert IN OUT.nc",
                                  file_.path(), name, kind.axis(0), kind.axis(1), kind.axis(2)));
  }

  /// Sets a variable of one number to of(rotated point).
  void set_by_point(const std::string& name, const MpasKind& kind,
                    const std::function<double(const Eigen::Vector3d&)>& of) {
    if (!file_.has_variable(name))
      return;
    require_points(kind, name);
    add_change(name, kind, [this, &kind, of](std::int64_t begin, std::int64_t end, double* values) {
      const Points3 at = points(kind, begin, end);
      for (std::int64_t i = 0; i < end - begin; ++i)
        values[i] = of(rotation_(Eigen::Vector3d(at.col(i))));
    });
  }

  void change_coordinates(const MpasKind& kind) {
    for (int k = 0; k < 3; ++k)
      set_by_point(kind.axis(k), kind, [k](const Eigen::Vector3d& to) { return to[k]; });
    set_by_point(kind.latitude(), kind, [](const Eigen::Vector3d& to) {
      return base_detail::latitude_of(to.x(), to.y(), to.z());
    });
    set_by_point(kind.longitude(), kind, [](const Eigen::Vector3d& to) {
      return base_detail::eastern(base_detail::longitude_of(to.x(), to.y()), 2 * std::numbers::pi);
    });
  }

  /// Turns angles from east. They stay in the range of the file: from -pi to pi, or from 0 to 2 pi.
  void change_angles() {
    const std::string name = mpas::angle_edge;
    if (!file_.has_variable(name))
      return;
    require_points(mpas_edge, name);
    const std::vector<double> all = file_.doubles(name, {part_.edges.count()});
    const double lower =
        std::ranges::any_of(all, [](double angle) { return angle < 0; }) ? -std::numbers::pi : 0;
    add_change(name, mpas_edge,
               [this, lower, of = real(name, mpas_edge)](std::int64_t begin, std::int64_t end,
                                                         double* values) {
                 for_each_turn(mpas_edge, begin, end, [&](std::int64_t i, const SiteTurn& turn) {
                   constexpr double whole = 2 * std::numbers::pi;
                   if (of.is_missing(values[i]))
                     return;
                   const double angle = values[i] + turn.angle();
                   values[i] = angle < lower            ? angle + whole
                               : angle >= lower + whole ? angle - whole
                                                        : angle;
                 });
               });
  }

  // ---- Fields

  FieldTraits traits_of(int variable) const {
    const std::string& name = header(variable).name;
    const std::string long_name = file_.text(name, "long_name"),
                      standard_name = file_.text(name, "standard_name");
    const std::vector<std::string> dimensions = file_.dimensions_of(name);
    return {name,
            long_name,
            standard_name,
            dimensions,
            dimensions.empty() ? 0 : file_.dimension(dimensions.back()),
            is_real(variable),
            find_axis(name).second == &mpas_edge && is_along_edges(name, long_name, standard_name)};
  }

  /// The variables at cells, edges and vertices.
  std::vector<FieldTraits> field_traits() const {
    std::vector<FieldTraits> all;
    for (int v = 0; v < std::ssize(file_.variables()); ++v) {
      const std::string& name = header(v).name;
      if (find_axis(name).second != nullptr && file_.is_numeric(name))
        all.push_back(traits_of(v));
    }
    return all;
  }

  template <class Use>
  void for_each_turn(const MpasKind& kind, std::int64_t begin, std::int64_t end,
                     const Use& use) const {
    const Points3 from = points(kind, begin, end);
    for (std::int64_t i = 0; i < end - begin; ++i)
      use(i, turn_at(from.col(i), rotation_(Eigen::Vector3d(from.col(i))), rotation_));
  }

  void change_field(const std::vector<FieldTraits>& all, const FieldTurn& turn, std::size_t i) {
    const std::string& name = all[i].name;
    const MpasKind& kind = *find_axis(name).second;
    if (turn.kind == Kind::vectors) {
      const RealVariable of = real(name, kind);
      add_change(name, kind, [this, of](std::int64_t begin, std::int64_t end, double* values) {
        for (double* at = values; at < values + (end - begin) * of.width; at += 3)
          if (!of.is_missing(at[0]) && !of.is_missing(at[1]) && !of.is_missing(at[2]))
            Eigen::Map<Eigen::Vector3d>{at} = turned({at[0], at[1], at[2]}, rotation_);
      });
    } else if (!turn.parts.empty()) {
      std::vector<RealVariable> parts;
      for (const std::size_t part : turn.parts)
        parts.push_back(real(all[part].name, kind));
      if (turn.kind != Kind::components)
        require_points(kind, name);
      add_change(name, kind,
                 [this, parts, &kind, turn](std::int64_t begin, std::int64_t end, double* values) {
                   change_part(parts, kind, turn, begin, end, values);
                 });
    }
  }

  /// Turns one of the components of vectors.
  void change_part(const std::vector<RealVariable>& parts, const MpasKind& kind,
                   const FieldTurn& turn, std::int64_t begin, std::int64_t end,
                   double* values) const {
    std::vector<std::vector<double>> old;
    for (const RealVariable& part : parts)
      old.push_back(read(part, kind, begin, end));
    const auto is_missing = [&](std::size_t at) {
      for (std::size_t k = 0; k < parts.size(); ++k)
        if (parts[k].is_missing(old[k][at]))
          return true;
      return false;
    };
    const std::int64_t width = parts.front().width;
    if (turn.kind == Kind::components) {
      for (std::size_t at = 0; at < old.front().size(); ++at)
        if (!is_missing(at))
          values[at] = turned({old[0][at], old[1][at], old[2][at]},
                              rotation_)[static_cast<Eigen::Index>(turn.part)];
      return;
    }
    for_each_turn(kind, begin, end, [&](std::int64_t i, const SiteTurn& at_site) {
      const SiteTurn by = turn.kind == Kind::twice ? at_site.twice() : at_site;
      for (std::int64_t k = i * width; k < (i + 1) * width; ++k)
        if (const auto at = static_cast<std::size_t>(k); !is_missing(at))
          values[k] = by.of(old[0][at], old[1][at])[turn.part];
    });
  }

  void change_coriolis(const std::string& name, TurnedFields& fields) {
    const MpasKind& kind = *find_axis(name).second;
    require_points(kind, name);
    const std::int64_t n = items(kind).count();
    const Points3 at = points(kind, 0, n);
    std::vector<double> sines(static_cast<std::size_t>(n));
    for (std::int64_t i = 0; i < n; ++i)
      sines[static_cast<std::size_t>(i)] = sine_of_latitude(at.col(i));
    const std::vector<double> values = file_.doubles(name, {n});
    const double factor = coriolis_factor(values, sines);
    add_coriolis(name, values, factor, fields);
    if (factor != 0)
      set_by_point(name, kind,
                   [factor](const Eigen::Vector3d& to) { return factor * sine_of_latitude(to); });
  }

  const NetcdfReader& file_;
  const MpasPart& part_;
  const Rotation& rotation_;
  NetcdfSubset& subset_;
};

} // namespace
} // namespace io_detail

RotateReport rotate(const std::string& path, const std::string& target, const Rotation& rotation,
                    const RotateOptions& options) {
  using namespace io_detail;
  const MpasSource source(path);
  const MpasPart part = whole_part(source);
  NetcdfSubset subset;
  subset.kept = {{mpas_cell.dimension(), &part.cells},
                 {mpas_edge.dimension(), &part.edges},
                 {mpas_vertex.dimension(), &part.vertices}};
  RotatedVariables variables(source, part, rotation, subset);
  RotateReport report;
  if (!rotation.is_identity()) {
    variables.change_mesh();
    report.fields = variables.change_fields();
  }
  add_history(source, part, options.history, subset);
  subset.attributes["file_id"] = {
      "file_id",
      fingerprint(part.cells.old, source.netcdf().text("", "file_id") + options.history)};
  report.left_out = write_part(source, part, subset, target, options.progress);
  return report;
}

} // namespace calotte
