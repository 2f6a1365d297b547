// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "support/spoilt_files.h"

#include <cstddef>
#include <cstring>
#include <map>
#include <string>
#include <vector>

/// What the C library reads in a NetCDF file, of any type.
namespace calotte::test {

struct Content {
  nc_type type = NC_NAT;
  std::vector<std::string> dimensions;
  std::vector<std::size_t> shape;
  std::string bytes;                             ///< of the machine's order
  std::map<std::string, std::string> attributes; ///< type and bytes

  /// Bytes of a value.
  std::size_t size() const {
    std::size_t bytes_of_one = 0;
    require(nc_inq_type(0, type, nullptr, &bytes_of_one));
    return bytes_of_one;
  }
  /// Bytes of all values with one index in dimensions 0 to d.
  std::size_t row_bytes(std::size_t d) const {
    std::size_t row = size();
    for (std::size_t k = d + 1; k < shape.size(); ++k)
      row *= shape[k];
    return row;
  }
  std::size_t width() const { return shape.size() < 2 ? 1 : shape[1]; }
};

struct Contents {
  std::map<std::string, Content> variables;
  std::map<std::string, std::size_t> dimensions;
  std::map<std::string, std::string> attributes;
  std::vector<std::string> unlimited;
  std::map<std::string, std::vector<double>> numbers; ///< of all but text

  double at(const std::string& name, std::size_t row, std::size_t k = 0) const {
    return numbers.at(name)[row * variables.at(name).width() + k];
  }
  /// 0-based; -1 for a missing one.
  int id(const std::string& name, std::size_t row, std::size_t k = 0) const {
    return static_cast<int>(at(name, row, k)) - 1;
  }
};

inline std::map<std::string, std::string> attributes_of(int id, int variable, int count) {
  std::map<std::string, std::string> found;
  for (int a = 0; a < count; ++a) {
    char name[NC_MAX_NAME + 1] = "";
    nc_type type = NC_NAT;
    std::size_t length = 0, size = 0;
    require(nc_inq_attname(id, variable, a, name));
    require(nc_inq_att(id, variable, name, &type, &length));
    require(nc_inq_type(id, type, nullptr, &size));
    std::string bytes(length * size, '\0');
    require(nc_get_att(id, variable, name, bytes.data()));
    found[name] = std::to_string(type) + ":" + bytes;
  }
  return found;
}

inline Contents contents_of(const std::string& path) {
  Contents all;
  int id = -1, dimensions = 0, variables = 0, attributes = 0, unlimited = 0;
  require(nc_open(path.c_str(), NC_NOWRITE, &id));
  require(nc_inq(id, &dimensions, &variables, &attributes, nullptr));
  std::vector<int> ids(static_cast<std::size_t>(dimensions));
  std::vector<std::string> names;
  char name[NC_MAX_NAME + 1] = "";
  for (int d = 0; d < dimensions; ++d) {
    std::size_t size = 0;
    require(nc_inq_dim(id, d, name, &size));
    all.dimensions[name] = size;
    names.emplace_back(name);
  }
  require(nc_inq_unlimdims(id, &unlimited, ids.data()));
  for (int k = 0; k < unlimited; ++k)
    all.unlimited.push_back(names[static_cast<std::size_t>(ids[static_cast<std::size_t>(k)])]);
  for (int v = 0; v < variables; ++v) {
    int rank = 0, of_variable = 0, dims[NC_MAX_VAR_DIMS];
    Content content;
    require(nc_inq_var(id, v, name, &content.type, &rank, dims, &of_variable));
    std::size_t values = 1;
    for (int d = 0; d < rank; ++d) {
      content.dimensions.push_back(names[static_cast<std::size_t>(dims[d])]);
      content.shape.push_back(all.dimensions[content.dimensions.back()]);
      values *= content.shape.back();
    }
    content.attributes = attributes_of(id, v, of_variable);
    content.bytes.resize(values * content.size());
    require(nc_get_var(id, v, content.bytes.data()));
    if (content.type != NC_CHAR) {
      all.numbers[name].resize(values);
      require(nc_get_var_double(id, v, all.numbers[name].data()));
    }
    all.variables[name] = content;
  }
  all.attributes = attributes_of(id, NC_GLOBAL, attributes);
  require(nc_close(id));
  return all;
}

} // namespace calotte::test
