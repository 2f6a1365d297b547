// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/error.h>
#include <calotte/mesh_file.h>

#include <doctest/doctest.h>
#include <netcdf.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

/// NetCDF files that the C library itself reads and spoils, for the tests of check_file.
namespace calotte::test {

// ---- Files through the C library

inline void require(int code) { REQUIRE(std::string(nc_strerror(code)) == nc_strerror(NC_NOERR)); }

/// A variable as a file holds it.
struct Variable {
  std::string name;
  std::vector<std::size_t> shape;
  std::vector<std::string> dimensions;
  bool integer = false;
  std::vector<double> values;

  std::size_t width() const { return shape.size() < 2 ? 1 : shape[1]; }
};

class Patch {
public:
  explicit Patch(const std::string& path) { require(nc_open(path.c_str(), NC_WRITE, &id_)); }
  Patch(const Patch&) = delete;
  Patch& operator=(const Patch&) = delete;
  ~Patch() { nc_close(id_); }

  int id() const { return id_; }
  Variable get(int v) const {
    char name[NC_MAX_NAME + 1] = "";
    int dimensions[NC_MAX_VAR_DIMS], count = 0;
    nc_type type = NC_NAT;
    require(nc_inq_var(id_, v, name, &type, &count, dimensions, nullptr));
    Variable variable{name, {}, {}, type != NC_DOUBLE && type != NC_FLOAT, {}};
    std::size_t size = 1;
    for (int d = 0; d < count; ++d) {
      variable.shape.emplace_back();
      require(nc_inq_dimlen(id_, dimensions[d], &variable.shape.back()));
      size *= variable.shape.back();
      require(nc_inq_dimname(id_, dimensions[d], name));
      variable.dimensions.emplace_back(name);
    }
    variable.values.resize(size);
    require(nc_get_var_double(id_, v, variable.values.data()));
    return variable;
  }
  Variable get(const std::string& name) const {
    int v = -1;
    require(nc_inq_varid(id_, name.c_str(), &v));
    return get(v);
  }
  /// \param variable "" for the file.
  void attribute(const std::string& variable, const std::string& key,
                 const std::string& text) const {
    require(nc_redef(id_));
    require(nc_put_att_text(id_, number_of(variable), key.c_str(), text.size(), text.data()));
    require(nc_enddef(id_));
  }
  void attribute(const std::string& variable, const std::string& key, double value) const {
    require(nc_redef(id_));
    require(nc_put_att_double(id_, number_of(variable), key.c_str(), NC_DOUBLE, 1, &value));
    require(nc_enddef(id_));
  }
  void remove_attribute(const std::string& variable, const std::string& key) const {
    require(nc_redef(id_));
    require(nc_del_att(id_, number_of(variable), key.c_str()));
    require(nc_enddef(id_));
  }
  /// Adds integer variables, each named by an attribute of another variable.
  void add(const std::vector<std::pair<std::string, Variable>>& variables,
           const std::string& owner) const {
    require(nc_redef(id_));
    for (const auto& [attribute, variable] : variables) {
      std::vector<int> dimensions;
      for (std::size_t d = 0; d < variable.shape.size(); ++d) {
        int dimension = -1;
        if (nc_inq_dimid(id_, variable.dimensions[d].c_str(), &dimension) != NC_NOERR)
          require(nc_def_dim(id_, variable.dimensions[d].c_str(), variable.shape[d], &dimension));
        dimensions.push_back(dimension);
      }
      int v = -1;
      require(nc_def_var(id_, variable.name.c_str(), NC_INT, static_cast<int>(dimensions.size()),
                         dimensions.data(), &v));
      require(nc_put_att_text(id_, number_of(owner), attribute.c_str(), variable.name.size(),
                              variable.name.data()));
    }
    require(nc_enddef(id_));
    for (const auto& [attribute, variable] : variables)
      put(variable);
  }
  void put(const Variable& variable) const {
    int v = -1;
    require(nc_inq_varid(id_, variable.name.c_str(), &v));
    require(nc_put_var_double(id_, v, variable.values.data()));
  }
  std::vector<Variable> all() const {
    int count = 0;
    require(nc_inq_nvars(id_, &count));
    std::vector<Variable> variables;
    for (int v = 0; v < count; ++v)
      variables.push_back(get(v));
    return variables;
  }

private:
  int number_of(const std::string& variable) const {
    int v = NC_GLOBAL;
    if (!variable.empty())
      require(nc_inq_varid(id_, variable.c_str(), &v));
    return v;
  }

  int id_ = -1;
};

inline std::string in_lines(const std::vector<Deviation>& deviations) {
  std::string lines;
  for (const Deviation& deviation : deviations)
    lines += deviation.text + "\n";
  return lines;
}

inline std::vector<Deviation> deviations_of(const std::string& path) {
  return check_file(path, read_mesh_file(path));
}

inline void check_none(const std::string& path) { CHECK(in_lines(deviations_of(path)) == ""); }

/// Whether reading refuses a file, or the check finds a deviation that counts.
inline bool is_found(const std::string& path) {
  try {
    const std::vector<Deviation> found = deviations_of(path);
    for (const Deviation& deviation : found) {
      CHECK(!deviation.text.empty());
      CHECK(deviation.text.find('\n') == std::string::npos);
      CHECK(deviation.difference > 0);
    }
    return std::any_of(found.begin(), found.end(), [](const Deviation& d) { return !d.known; });
  } catch (const Error& error) {
    CHECK(std::string(error.what()).find('\n') == std::string::npos);
    return true;
  }
}

/// An MPAS file in memory; ids are 1-based.
struct Mpas {
  Mpas() = default;
  explicit Mpas(const std::string& path) {
    for (Variable& variable : Patch(path).all())
      variables.emplace(variable.name, std::move(variable));
  }
  void write(const std::string& path) const {
    const Patch patch(path);
    for (const auto& [name, variable] : variables)
      patch.put(variable);
  }
  /// A new file with these variables, of the type given for floating-point ones, and attributes.
  void create(const std::string& path, nc_type type,
              const std::function<void(int id)>& put_attributes) const {
    int id = -1;
    require(nc_create(path.c_str(), NC_CLOBBER | NC_64BIT_OFFSET, &id));
    std::map<std::string, int> dimensions;
    for (const auto& [name, variable] : variables) {
      std::vector<int> of_variable;
      for (std::size_t d = 0; d < variable.shape.size(); ++d) {
        const auto [known, is_new] = dimensions.emplace(variable.dimensions[d], -1);
        if (is_new)
          require(nc_def_dim(id, known->first.c_str(), variable.shape[d], &known->second));
        of_variable.push_back(known->second);
      }
      int v = -1;
      require(nc_def_var(id, name.c_str(), variable.integer ? NC_INT : type,
                         static_cast<int>(of_variable.size()), of_variable.data(), &v));
    }
    put_attributes(id);
    require(nc_close(id));
    write(path);
  }
  Variable& operator[](const std::string& name) { return variables.at(name); }
  std::size_t rows(const std::string& name) { return (*this)[name].shape[0]; }
  double& at(const std::string& name, std::size_t row, std::size_t k = 0) {
    Variable& variable = (*this)[name];
    return variable.values[row * variable.width() + k];
  }
  std::size_t id(const std::string& name, std::size_t row, std::size_t k = 0) {
    return static_cast<std::size_t>(at(name, row, k)) - 1;
  }
  /// Turns the first `count` entries of a row to the left.
  void rotate_row(const std::string& name, std::size_t row, std::size_t by, std::size_t count) {
    const auto first =
        (*this)[name].values.begin() + static_cast<std::ptrdiff_t>(row * (*this)[name].width());
    std::rotate(first, first + static_cast<std::ptrdiff_t>(by),
                first + static_cast<std::ptrdiff_t>(count));
  }

  std::map<std::string, Variable> variables;
};

// ---- Corruption

/// A way to spoil the values of a variable; `pick` chooses a place.
struct Corruption {
  std::string name;
  std::function<void(Variable&, std::size_t pick)> spoil;
  bool of_one_value = false;
};

/// Another id of the variable; of a flag, the other one.
inline double another_id(const Variable& variable, std::size_t pick) {
  const double own = variable.values[pick];
  for (std::size_t k = 1; k < variable.values.size(); ++k) {
    const double other = variable.values[(pick + k * k) % variable.values.size()];
    if (other != own && other > 0)
      return other;
  }
  return own == 0 ? 1 : own + 1;
}

inline void nudge(Variable& variable, std::size_t pick) {
  double& value = variable.values[pick];
  value = variable.integer ? another_id(variable, pick) : value * (1 + 1e-3);
}

inline const std::vector<Corruption>& corruptions() {
  static const std::vector<Corruption> all{
      {"one value changed", nudge, true},
      {"one value zeroed", [](Variable& v, std::size_t pick) { v.values[pick] = 0; }, true},
      {"halved",
       [](Variable& v, std::size_t) {
         for (double& value : v.values)
           value = v.integer ? std::trunc(value / 2) : value / 2;
       }},
      {"reversed",
       [](Variable& v, std::size_t) { std::reverse(v.values.begin(), v.values.end()); }},
      {"zeroed",
       [](Variable& v, std::size_t) { std::fill(v.values.begin(), v.values.end(), 0.0); }},
      {"shifted by one place",
       [](Variable& v, std::size_t) {
         std::rotate(v.values.begin(), v.values.begin() + 1, v.values.end());
       }},
      {"shifted by one row",
       [](Variable& v, std::size_t) {
         std::rotate(v.values.begin(), v.values.begin() + static_cast<std::ptrdiff_t>(v.width()),
                     v.values.end());
       }},
      {"not a number", [](Variable& v, std::size_t pick) {
         if (!v.integer)
           v.values[pick] = std::numeric_limits<double>::quiet_NaN();
       }}};
  return all;
}

/// Values that are large for their variable, evenly spaced among these: a relative change of 1e-3
/// moves each beyond the tolerance.
inline std::vector<std::size_t> picks_of(const Variable& variable, std::size_t count) {
  double greatest = 0;
  for (const double value : variable.values)
    greatest = std::max(greatest, std::abs(value));
  std::vector<std::size_t> large, picks;
  for (std::size_t i = 0; i < variable.values.size(); ++i)
    if (variable.integer ? variable.values[i] >= 0 : std::abs(variable.values[i]) > greatest / 100)
      large.push_back(i);
  if (large.empty())
    large.push_back(0);
  const std::size_t step = std::max<std::size_t>(large.size() / count, 1);
  for (std::size_t k = 0; k < large.size() && picks.size() < count; k += step)
    picks.push_back(large[k]);
  return picks;
}

/// Whether a corruption leaves a file that means something else, but is right.
inline bool is_still_right(Format format, const Variable& before, const Variable& after) {
  // The mesh variable of UGRID carries attributes alone; the conventions give its value no meaning.
  if (before.name == "mesh")
    return format == Format::ugrid || format == Format::ugrid_triangles;
  // A mask with some cells left out is as right as one without.
  if (before.name == "grid_imask" || before.name == "elementMask")
    return std::any_of(after.values.begin(), after.values.end(), [](double m) { return m == 1; }) &&
           std::all_of(after.values.begin(), after.values.end(),
                       [](double m) { return m == 0 || m == 1; });
  return false;
}

/// Spoils each variable alone in each way, and restores it.
inline int check_each_variable(const std::string& path, Format format, std::size_t picks) {
  const std::vector<Variable> variables = Patch(path).all();
  int done = 0;
  for (const Variable& variable : variables)
    for (const Corruption& corruption : corruptions())
      for (const std::size_t pick : picks_of(variable, corruption.of_one_value ? picks : 1)) {
        Variable spoilt = variable;
        corruption.spoil(spoilt, pick);
        const bool same =
            std::equal(spoilt.values.begin(), spoilt.values.end(), variable.values.begin());
        if (same || is_still_right(format, variable, spoilt))
          continue;
        Patch(path).put(spoilt);
        CAPTURE(variable.name);
        CAPTURE(corruption.name);
        CAPTURE(pick);
        CHECK(is_found(path));
        Patch(path).put(variable);
        ++done;
      }
  check_none(path);
  return done;
}

} // namespace calotte::test
