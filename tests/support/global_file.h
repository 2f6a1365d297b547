// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "delaunay/delaunay.h"
#include "support/files.h"
#include "support/spoilt_files.h"

#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/write.h>

#include <netcdf.h>

#include <cstdint>
#include <string>
#include <vector>

/// Global MPAS files with further fields, as models have them.
namespace calotte::test {

struct GlobalFile {
  std::int64_t cells = 0;
  double radius = 1;
  int format = NC_64BIT_OFFSET; ///< of nc_create
};

/// Bytes that differ from row to row.
inline std::string sample_bytes(std::size_t size) {
  std::string bytes(size, '\0');
  for (std::size_t i = 0; i < size; ++i)
    bytes[i] = static_cast<char>('A' + (i * i + i / 7) % 50);
  return bytes;
}

/// A field of any type, filled with sample_bytes().
struct Extra {
  std::string name;
  nc_type type;
  std::vector<std::string> dimensions;
};

inline std::vector<Extra> extras_of(int format) {
  std::vector<Extra> all{{"ter", NC_FLOAT, {"nCells"}},
                         {"landmask", NC_BYTE, {"nCells"}},
                         {"ivgtyp", NC_INT, {"nCells"}},
                         {"vertexName", NC_CHAR, {"nVertices", "StrLen"}},
                         {"theta", NC_DOUBLE, {"Time", "nCells", "nVertLevels"}},
                         {"u", NC_FLOAT, {"Time", "nEdges"}},
                         {"layer", NC_SHORT, {"nVertLevels", "nVertices"}},
                         {"xtime", NC_CHAR, {"Time", "StrLen"}},
                         {"levels", NC_DOUBLE, {"nVertLevels"}}};
  if (format != NC_64BIT_OFFSET) {
    all.push_back({"pixels", NC_INT64, {"nCells", "nVertLevels"}});
    all.push_back({"flags", NC_USHORT, {"nEdges"}});
  }
  return all;
}

inline int define_extra(int id, const Extra& extra, int format) {
  std::vector<int> dimensions;
  for (const std::string& name : extra.dimensions) {
    dimensions.emplace_back();
    require(nc_inq_dimid(id, name.c_str(), &dimensions.back()));
  }
  int v = -1;
  require(nc_def_var(id, extra.name.c_str(), extra.type, static_cast<int>(dimensions.size()),
                     dimensions.data(), &v));
  const float fill = -999;
  const int flags[] = {1, 2, 3};
  if (extra.type == NC_FLOAT)
    require(nc_put_att_float(id, v, "_FillValue", NC_FLOAT, 1, &fill));
  require(nc_put_att_int(id, v, "flag_values", NC_INT, 3, flags));
  require(nc_put_att_text(id, v, "long_name", 7, "a field"));
  if (format == NC_NETCDF4 && extra.dimensions.size() > 1)
    require(nc_def_var_deflate(id, v, 1, 1, 1));
  return v;
}

inline void put_extra(int id, int v, const Extra& extra) {
  std::vector<std::size_t> start(extra.dimensions.size(), 0), count;
  std::size_t size = 0;
  require(nc_inq_type(id, extra.type, nullptr, &size));
  for (const std::string& name : extra.dimensions) {
    int d = -1;
    require(nc_inq_dimid(id, name.c_str(), &d));
    count.emplace_back();
    require(nc_inq_dimlen(id, d, &count.back()));
    if (name == "Time")
      count.back() = 2;
    size *= count.back();
  }
  require(nc_put_vara(id, v, start.data(), count.data(), sample_bytes(size).data()));
}

/// The Delaunay mesh of a Fibonacci lattice, with a density, as the library writes it, and further
/// fields; in another format by the C library.
inline void write_global(const Scratch& scratch, const std::string& path, const GlobalFile& file) {
  const std::string plain = scratch / "plain.nc";
  WriteOptions options;
  options.format = Format::mpas;
  options.sphere_radius = file.radius;
  options.density = tanh_bump({0, 0, 1}, 0.5, 0.2, 0.5); // about that of the lattice
  options.history = "made by a test";
  write(plain, delaunay(fibonacci_sphere(file.cells)), options);
  int in = -1, out = -1, dimensions = 0, variables = 0, attributes = 0, unlimited = -1;
  require(nc_open(plain.c_str(), NC_NOWRITE, &in));
  require(nc_create(path.c_str(), NC_CLOBBER | file.format, &out));
  require(nc_inq(in, &dimensions, &variables, &attributes, &unlimited));
  char name[NC_MAX_NAME + 1] = "";
  int d = -1;
  for (int k = 0; k < dimensions; ++k) {
    std::size_t size = 0;
    require(nc_inq_dim(in, k, name, &size));
    require(nc_def_dim(out, name, k == unlimited ? NC_UNLIMITED : size, &d));
  }
  require(nc_def_dim(out, "StrLen", 5, &d));
  require(nc_def_dim(out, "nVertLevels", 3, &d));
  for (int a = 0; a < attributes; ++a) {
    require(nc_inq_attname(in, NC_GLOBAL, a, name));
    require(nc_copy_att(in, NC_GLOBAL, name, out, NC_GLOBAL));
  }
  std::vector<int> ids;
  const std::vector<Extra> extras = extras_of(file.format);
  for (const Extra& extra : extras)
    ids.push_back(define_extra(out, extra, file.format));
  require(nc_enddef(out));
  for (std::size_t k = 0; k < ids.size(); ++k)
    put_extra(out, ids[k], extras[k]);
  for (int v = 0; v < variables; ++v)
    require(nc_copy_var(in, v, out));
  require(nc_close(in));
  require(nc_close(out));
  std::filesystem::remove(plain);
  std::filesystem::remove(scratch / "plain.graph.info");
}

} // namespace calotte::test
