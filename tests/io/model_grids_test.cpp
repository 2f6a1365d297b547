// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/delaunay.h"
#include "support/clouds.h"
#include "support/constants.h"
#include "support/files.h"
#include "support/laws.h"
#include "support/meshes.h"

#include "base/lonlat.h"
#include "io/cells/distinct_points.h"
#include "io/cells/dual.h"
#include "io/cells/model_grid.h"
#include "io/cells/polygons.h"
#include "io/formats/formats.h"
#include "io/netcdf/netcdf_reader.h"
#include "io/netcdf/netcdf_writer.h"
#include "support/spoilt_files.h"
#include "support/text.h"

#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/read.h>
#include <calotte/write.h>

#include <doctest/doctest.h>
#include <netcdf.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

// UGRID, SCRIP and ESMF: cells as polygons on longitudes and latitudes.

namespace fs = std::filesystem;
using namespace calotte;
using namespace calotte::test;
using calotte::base_detail::Vec3;
using calotte::io_detail::NetcdfAttributes;
using calotte::io_detail::NetcdfReader;
using calotte::io_detail::NetcdfType;
using calotte::io_detail::NetcdfWriter;
using calotte::io_detail::RawMesh;

namespace {

std::vector<NamedMesh> tessellated_meshes() {
  std::vector<NamedMesh> all = uneven_meshes();
  all.push_back({"bisected", delaunay(bisected_icosahedron(2))}); // with pentagons
  return all;
}

// ---- The laws of cells as polygons

struct CellPolygons {
  Points3 centres;
  std::vector<std::vector<Vec3>> corners; ///< of each cell, padding left out
  std::vector<double> areas;              ///< on the unit sphere; none where the file has none
};

Vec3 centre_of(const CellPolygons& cells, std::size_t cell) {
  return oracle::site(cells.centres, static_cast<std::int64_t>(cell));
}

/// Positive for a counter-clockwise triangle (Eriksson, Math. Mag. 63, 1990).
double signed_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  return 2 * std::atan2(dot(a, cross(b - a, c - a)), 1 + dot(a, b) + dot(b, c) + dot(c, a));
}

/// Seen from its centre, a cell's corners run counter-clockwise: so the centre is inside. Returns
/// the area. Corners err by some roundings of 360 degrees, 6e-14, as longitudes.
double require_counter_clockwise(const CellPolygons& cells, std::size_t cell) {
  const Vec3 centre = centre_of(cells, cell);
  const std::vector<Vec3>& corners = cells.corners[cell];
  double area = 0, turn = 0;
  REQUIRE(corners.size() >= 3);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec3 from = corners[k], to = corners[(k + 1) % corners.size()];
    const double part = signed_area(centre, from, to);
    REQUIRE(part > -1e-14);
    area += part;
    const Vec3 east = cross(centre, from);
    turn += std::atan2(dot(east, to) / norm(east), dot(cross(east, centre), to) / norm(east));
  }
  CHECK(turn == doctest::Approx(2 * pi).epsilon(1e-9));
  return area;
}

/// The corners are the sites' circumcentres: three sites are as near as the cell's own, none is
/// nearer. Those of obtuse triangles err by more than a rounding.
void require_voronoi(const CellPolygons& cells) {
  for (std::size_t cell = 0; cell < cells.corners.size(); ++cell)
    for (const Vec3& corner : cells.corners[cell]) {
      const Eigen::Vector3d point(corner.x, corner.y, corner.z);
      const Eigen::ArrayXd cosines = cells.centres.transpose() * point;
      const double own = cosines[static_cast<Eigen::Index>(cell)];
      REQUIRE(cosines.maxCoeff() < own + 1e-12);
      REQUIRE((cosines > own - 1e-12).count() >= 3);
    }
}

void require_tessellation(const CellPolygons& cells, const Mesh& mesh) {
  REQUIRE(cells.centres.cols() == mesh.points.cols());
  REQUIRE(std::ssize(cells.corners) == mesh.points.cols());
  double sum = 0;
  for (std::size_t cell = 0; cell < cells.corners.size(); ++cell) {
    CAPTURE(cell);
    const auto site = mesh.points.col(static_cast<Eigen::Index>(cell)).stableNormalized();
    REQUIRE((cells.centres.col(static_cast<Eigen::Index>(cell)) - site).norm() < 1e-14);
    const double area = require_counter_clockwise(cells, cell);
    if (!cells.areas.empty())
      REQUIRE(std::abs(cells.areas[cell] - area) < 1e-12);
    sum += area;
  }
  CHECK(std::abs(sum - 4 * pi) < 1e-11);
  if (!cells.areas.empty())
    CHECK(std::abs(std::accumulate(cells.areas.begin(), cells.areas.end(), 0.0) - 4 * pi) < 1e-12);
  require_voronoi(cells);
}

// ---- Files as they are

/// Longitudes and latitudes in range, as unit columns.
Points3 from_lonlats(const std::vector<double>& longitudes, const std::vector<double>& latitudes) {
  Points3 points(3, std::ssize(longitudes));
  for (std::size_t i = 0; i < longitudes.size(); ++i) {
    REQUIRE((longitudes[i] >= 0 && longitudes[i] < 360 && !std::signbit(longitudes[i])));
    REQUIRE(std::abs(latitudes[i]) <= 90);
    const Vec3 p = base_detail::from_lonlat(longitudes[i], latitudes[i]);
    points.col(static_cast<Eigen::Index>(i)) << p.x, p.y, p.z;
  }
  return points;
}

Points3 read_points(const NetcdfReader& file, const std::string& longitude,
                    const std::string& latitude) {
  CHECK(file.text(longitude, "standard_name") == "longitude");
  CHECK(file.text(latitude, "standard_name") == "latitude");
  return from_lonlats(file.doubles(longitude, {-1}), file.doubles(latitude, {-1}));
}

/// Columns of pairs.
Points3 read_pairs(const NetcdfReader& file, const std::string& name) {
  CHECK(file.text(name, "units") == "degrees");
  const std::vector<double> pairs = file.doubles(name, {-1, 2});
  std::vector<double> longitudes, latitudes;
  for (std::size_t i = 0; i < pairs.size(); i += 2) {
    longitudes.push_back(pairs[i]);
    latitudes.push_back(pairs[i + 1]);
  }
  return from_lonlats(longitudes, latitudes);
}

void require_attributes(const NetcdfReader& file, double radius, const std::string& history) {
  CHECK(file.text("", "Conventions").starts_with("CF-1.8"));
  CHECK(file.number("", "sphere_radius", 0) == radius);
  CHECK(file.text("", "history") == history);
  for (const std::string& name : file.variable_names()) {
    CAPTURE(name);
    CHECK(file.text(name, "units") != "");
    CHECK(file.text(name, "long_name") != "");
  }
}

/// The bounds of the faces' longitudes and latitudes are those of their nodes, in their order; the
/// last one fills the row.
void require_bounds(const NetcdfReader& file) {
  const std::vector<std::int64_t> shape = file.shape_of("mesh_face_nodes");
  const std::vector<std::int32_t> ids = file.ints("mesh_face_nodes", shape);
  for (const std::string axis : {"lon", "lat"}) {
    const std::string name = file.text("mesh_face_" + axis, "bounds");
    REQUIRE(file.shape_of(name) == shape);
    const std::vector<double> bounds = file.doubles(name, shape),
                              nodes = file.doubles("mesh_node_" + axis, {-1});
    std::int32_t last = -1;
    int wrong = 0;
    for (std::size_t k = 0; k < ids.size(); ++k) {
      last = ids[k] >= 0 ? ids[k] : last;
      wrong += bounds[k] != nodes[static_cast<std::size_t>(last)];
    }
    CHECK(wrong == 0);
  }
}

/// The polygons whose corners a table of node ids names; every node is a corner of three.
std::vector<std::vector<Vec3>> polygons(const NetcdfReader& file, const std::string& name,
                                        const Points3& nodes) {
  const int start = static_cast<int>(file.number(name, "start_index", -1));
  REQUIRE(file.number(name, "_FillValue", 0) == -1);
  const std::vector<std::int64_t> shape = file.shape_of(name);
  const std::vector<std::int32_t> ids = file.ints(name, {-1, -1});
  std::vector<std::vector<Vec3>> result(static_cast<std::size_t>(shape[0]));
  std::vector<int> uses(static_cast<std::size_t>(nodes.cols()));
  bool filled = false; // the widest row
  for (std::size_t i = 0; i < result.size(); ++i) {
    bool padding = false;
    for (std::int64_t k = 0; k < shape[1]; ++k) {
      const std::int32_t id = ids[i * static_cast<std::size_t>(shape[1]) + std::size_t(k)];
      padding = padding || id == -1;
      REQUIRE((padding ? id == -1 : id >= start && id < start + nodes.cols()));
      if (padding)
        continue;
      ++uses[static_cast<std::size_t>(id - start)];
      result[i].push_back(oracle::site(nodes, id - start));
    }
    filled = filled || !padding;
  }
  CHECK(filled);
  CHECK(std::all_of(uses.begin(), uses.end(), [](int count) { return count == 3; }));
  return result;
}

CellPolygons ugrid_polygons(const NetcdfReader& file) {
  const Points3 nodes = read_points(file, "mesh_node_lon", "mesh_node_lat");
  return {read_points(file, "mesh_face_lon", "mesh_face_lat"),
          polygons(file, "mesh_face_nodes", nodes),
          {}};
}

CellPolygons esmf_polygons(const NetcdfReader& file) {
  const Points3 nodes = read_pairs(file, "nodeCoords");
  CellPolygons cells{read_pairs(file, "centerCoords"), polygons(file, "elementConn", nodes),
                     file.doubles("elementArea", {-1})};
  const std::vector<std::int32_t> counts = file.ints("numElementConn", {std::ssize(cells.corners)});
  for (std::size_t i = 0; i < counts.size(); ++i)
    REQUIRE(counts[i] == std::ssize(cells.corners[i]));
  return cells;
}

CellPolygons scrip_polygons(const NetcdfReader& file) {
  CellPolygons cells{read_points(file, "grid_center_lon", "grid_center_lat"),
                     {},
                     file.doubles("grid_area", {file.dimension("grid_size")})};
  const std::int64_t size = file.dimension("grid_size"), most = file.dimension("grid_corners");
  const Points3 corners = from_lonlats(file.doubles("grid_corner_lon", {size, most}),
                                       file.doubles("grid_corner_lat", {size, most}));
  for (std::int64_t i = 0; i < size; ++i) {
    std::int64_t count = most; // padding repeats the last corner
    while (count > 1 && corners.col(i * most + count - 1) == corners.col(i * most + count - 2))
      --count;
    cells.corners.emplace_back();
    for (std::int64_t k = 0; k < count; ++k)
      cells.corners.back().push_back(oracle::site(corners, i * most + k));
  }
  return cells;
}

// ---- Round trips

using Write = void (*)(const std::string&, const Mesh&, const WriteOptions&);
using Read = RawMesh (*)(const NetcdfReader&, calotte::FieldChoice);

// The cells of a mesh as files of polygons.
void write_ugrid(const std::string& path, const Mesh& mesh, const WriteOptions& options) {
  io_detail::write_ugrid(path, io_detail::cell_grid(mesh), options);
}
void write_scrip(const std::string& path, const Mesh& mesh, const WriteOptions& options) {
  io_detail::write_scrip(path, io_detail::cell_grid(mesh), options);
}
void write_esmf(const std::string& path, const Mesh& mesh, const WriteOptions& options) {
  io_detail::write_esmf(path, io_detail::cell_grid(mesh), options);
}

RawMesh written_and_read(const std::string& path, const Mesh& mesh, Write write, Read read,
                         const WriteOptions& options = {}) {
  write(path, mesh, options);
  return read(NetcdfReader(path), calotte::FieldChoice::all);
}

/// The norms that the file has.
Points3 on_sphere(const Mesh& mesh, double radius) {
  Points3 points = mesh.points;
  points.colwise().normalize();
  return radius * points;
}

// ---- Bad files

/// The C library's own hand: what our writer would never write.
struct EditedFile : Patch {
  using Patch::attribute;
  using Patch::Patch;
  int variable(const std::string& name) const {
    int found = -1;
    require(nc_inq_varid(id(), name.c_str(), &found));
    return found;
  }
  void rename(const std::string& name, const std::string& to) const {
    require(nc_redef(id()));
    require(nc_rename_var(id(), variable(name), to.c_str()));
    require(nc_enddef(id()));
  }
  void attribute(const std::string& name, const std::string& key, int number) const {
    require(nc_put_att_int(id(), variable(name), key.c_str(), NC_INT, 1, &number));
  }
  void put(const std::string& name, std::vector<std::size_t> index, double value) const {
    require(nc_put_var1_double(id(), variable(name), index.data(), &value));
  }
};

/// One line that starts with the path and holds these words.
void check_bad_file(const std::string& path, Read read, const std::string& words) {
  CAPTURE(words);
  const Error error = error_of([&] { read(NetcdfReader(path), calotte::FieldChoice::all); });
  const std::string message = error.what();
  CAPTURE(message);
  CHECK(error.code() == ErrorCode::parse);
  CHECK(message.starts_with(path + ": "));
  CHECK(has(message, words));
}

/// A UGRID file of others: names of their own, no attributes that are ours.
struct Foreign {
  std::vector<std::vector<double>> faces; ///< as the file holds them
  bool faces_last = false, latitude_first = false, radians = false;
  int start_index = 0;
  double fill = -1;

  void write(const std::string& path, const Points3& points) const {
    NetcdfWriter file(path);
    const auto most = std::ssize(faces[0]);
    const int node = file.dimension("nodes", points.cols()),
              face = file.dimension("cells", std::ssize(faces));
    const int corner = file.dimension("three", most);
    const std::string unit = radians ? "radians" : "degrees";
    const int topology = file.variable(
        "topology", NetcdfType::int32, {},
        {{"cf_role", std::string("mesh_topology")},
         {"topology_dimension", std::int32_t{2}},
         {"node_coordinates", std::string(latitude_first ? "north east" : "east north")},
         {"face_node_connectivity", std::string("corners")},
         {"face_dimension", std::string("cells")}});
    const int east = file.variable("east", NetcdfType::float64, {node},
                                   {{"units", unit}, {"standard_name", std::string("longitude")}});
    const int north = file.variable("north", NetcdfType::float64, {node},
                                    {{"units", unit}, {"standard_name", std::string("latitude")}});
    const auto order = faces_last ? std::vector{corner, face} : std::vector{face, corner};
    const int corners =
        file.variable("corners", NetcdfType::float64, order,
                      {{"start_index", std::int32_t{start_index}}, {"_FillValue", fill}});
    file.begin();
    file.put(topology, [](std::int64_t, std::int64_t, std::int32_t* out) { *out = 0; });
    const double scale = radians ? 1 : 180 / pi;
    file.put(east, [&](std::int64_t begin, std::int64_t end, double* out) {
      for (std::int64_t i = begin; i < end; ++i)
        *out++ = scale * std::atan2(points(1, i), points(0, i));
    });
    file.put(north, [&](std::int64_t begin, std::int64_t end, double* out) {
      for (std::int64_t i = begin; i < end; ++i)
        *out++ = scale * std::asin(points(2, i));
    });
    file.put(corners, [&](std::int64_t begin, std::int64_t end, double* out) {
      for (std::int64_t row = begin; row < end; ++row)
        for (std::size_t k = 0; k < (faces_last ? faces.size() : faces[0].size()); ++k)
          *out++ = faces_last ? faces[k][std::size_t(row)] : faces[std::size_t(row)][k];
    });
    file.commit();
  }
};

/// The triangles of a mesh as another's faces.
std::vector<std::vector<double>> foreign_faces(const Mesh& mesh, int start_index) {
  std::vector<std::vector<double>> faces;
  for (std::int64_t t = 0; t < mesh.triangles.cols(); ++t) {
    faces.emplace_back();
    for (int k = 0; k < 3; ++k)
      faces.back().push_back(mesh.triangles(k, t) + start_index);
  }
  return faces;
}

} // namespace

TEST_CASE("UGRID, SCRIP and ESMF hold the Voronoi tessellation") {
  const Scratch scratch;
  const WriteOptions options{.sphere_radius = 6371220, .history = "made by a test\nfrom nothing"};
  for (const NamedMesh& c : tessellated_meshes()) {
    CAPTURE(c.name);
    write_ugrid(scratch / "ugrid.nc", c.mesh, options);
    write_scrip(scratch / "scrip.nc", c.mesh, options);
    write_esmf(scratch / "esmf.nc", c.mesh, options);
    const NetcdfReader ugrid(scratch / "ugrid.nc"), scrip(scratch / "scrip.nc"),
        esmf(scratch / "esmf.nc");
    for (const NetcdfReader* file : {&ugrid, &scrip, &esmf})
      require_attributes(*file, options.sphere_radius, options.history);
    require_tessellation(ugrid_polygons(ugrid), c.mesh);
    require_tessellation(scrip_polygons(scrip), c.mesh);
    require_tessellation(esmf_polygons(esmf), c.mesh);
  }
}

TEST_CASE("UGRID says what its variables are") {
  const Scratch scratch;
  const Mesh mesh = delaunay(random_sphere(40));
  for (const Write write : {write_ugrid, io_detail::write_ugrid_triangles}) {
    write(scratch / "grid.nc", mesh, {});
    const NetcdfReader file(scratch / "grid.nc");
    CHECK(file.text("", "Conventions") == "CF-1.8 UGRID-1.0");
    CHECK(file.text("mesh", "cf_role") == "mesh_topology");
    CHECK(file.number("mesh", "topology_dimension", 0) == 2);
    CHECK(file.shape_of("mesh").empty());
    CHECK(file.text("mesh", "node_coordinates") == "mesh_node_lon mesh_node_lat");
    CHECK(file.text("mesh", "face_coordinates") == "mesh_face_lon mesh_face_lat");
    CHECK(file.text("mesh", "face_dimension") == file.dimensions_of("mesh_face_nodes")[0]);
    CHECK(file.dimensions_of("mesh_face_lat") ==
          std::vector<std::string>{file.text("mesh", "face_dimension")});
    CHECK(file.text("mesh_face_nodes", "cf_role") == "face_node_connectivity");
    CHECK(file.number("mesh_face_nodes", "start_index", -1) == 0);
    CHECK(file.text("mesh_node_lat", "units") == "degrees_north");
    CHECK(file.text("mesh_node_lon", "units") == "degrees_east");
    require_bounds(file);
  }
}

TEST_CASE("UGRID of triangles holds the mesh and its circumcentres") {
  const Scratch scratch;
  for (const NamedMesh& c : tessellated_meshes()) {
    CAPTURE(c.name);
    io_detail::write_ugrid_triangles(scratch / "grid.nc", c.mesh, {.history = "a test"});
    const NetcdfReader file(scratch / "grid.nc");
    require_attributes(file, 1, "a test");
    const Points3 sites = read_points(file, "mesh_node_lon", "mesh_node_lat");
    const Points3 centres = read_points(file, "mesh_face_lon", "mesh_face_lat");
    const std::vector<std::int32_t> ids =
        file.ints("mesh_face_nodes", {c.mesh.triangles.cols(), 3});
    for (std::int64_t t = 0; t < c.mesh.triangles.cols(); ++t) {
      const Vec3 centre = oracle::site(centres, t);
      Vec3 corners[3];
      for (std::size_t k = 0; k < 3; ++k)
        corners[k] = oracle::site(sites, ids[3 * static_cast<std::size_t>(t) + k]);
      const auto& [a, b, d] = corners;
      REQUIRE(dot(a, cross(b - a, d - a)) > 0);
      REQUIRE(dot(centre, cross(b - a, d - a)) > 0);
      REQUIRE(std::abs(dot(centre, a - b)) < 1e-14);
      REQUIRE(std::abs(dot(centre, a - d)) < 1e-14);
    }
  }
}

TEST_CASE("SCRIP and ESMF describe their cells") {
  const Scratch scratch;
  const Mesh mesh = delaunay(random_sphere(40));
  write_scrip(scratch / "scrip.nc", mesh, {});
  write_esmf(scratch / "esmf.nc", mesh, {});
  const NetcdfReader scrip(scratch / "scrip.nc"), esmf(scratch / "esmf.nc");
  CHECK(scrip.dimension("grid_rank") == 1);
  CHECK(scrip.ints("grid_dims", {1}) == std::vector<std::int32_t>{40});
  CHECK(scrip.ints("grid_imask", {40}) == std::vector<std::int32_t>(40, 1));
  for (const std::string name : {"center_lat", "center_lon", "corner_lat", "corner_lon"})
    CHECK(scrip.text("grid_" + name, "units") == "degrees");
  CHECK(scrip.text("grid_area", "units") == "radians^2");
  CHECK(esmf.text("", "gridType") == "unstructured");
  CHECK(esmf.number("elementConn", "start_index", 0) == 1);
  CHECK(esmf.ints("elementMask", {40}) == std::vector<std::int32_t>(40, 1));
  CHECK(esmf.text("elementArea", "units") == "radians^2");
}

TEST_CASE("UGRID gives the mesh back to the bit") {
  const Scratch scratch;
  for (const NamedMesh& c : tessellated_meshes()) {
    CAPTURE(c.name);
    for (const Write write : {write_ugrid, io_detail::write_ugrid_triangles}) {
      // Unit columns stay as they are, whatever their last bits; others come to the radius and
      // stay.
      const bool unit = ((c.mesh.points.colwise().norm().array() - 1).abs() < 5e-16).all();
      RawMesh raw = written_and_read(scratch / "a.nc", c.mesh, write, io_detail::read_ugrid);
      CHECK((!unit || test::same_bits(raw.points, c.mesh.points)));
      CHECK((raw.points - on_sphere(c.mesh, 1)).cwiseAbs().maxCoeff() < 1e-15);
      CHECK(test::same_bits(raw.triangles, c.mesh.triangles));

      const WriteOptions earth{.sphere_radius = 6371220};
      raw = written_and_read(scratch / "b.nc", c.mesh, write, io_detail::read_ugrid, earth);
      CHECK((raw.points - on_sphere(c.mesh, 6371220)).cwiseAbs().maxCoeff() < 6371220e-15);
      const Mesh again{raw.points, raw.triangles, c.mesh.neighbours, c.mesh.site_of_input};
      const RawMesh twice =
          written_and_read(scratch / "c.nc", again, write, io_detail::read_ugrid, earth);
      CHECK(test::same_bits(twice.points, raw.points));
      CHECK(test::same_bits(twice.triangles, c.mesh.triangles));
    }
  }
}

TEST_CASE("SCRIP and ESMF give the sites back, but for rounding") {
  const Scratch scratch;
  for (const NamedMesh& c : tessellated_meshes()) {
    CAPTURE(c.name);
    for (const RawMesh& raw :
         {written_and_read(scratch / "a.nc", c.mesh, write_scrip, io_detail::read_scrip),
          written_and_read(scratch / "b.nc", c.mesh, write_esmf, io_detail::read_esmf)}) {
      CHECK(raw.triangles.cols() == 0);
      REQUIRE(raw.points.cols() == c.mesh.points.cols());
      CHECK((raw.points - on_sphere(c.mesh, 1)).cwiseAbs().maxCoeff() < 2e-15);
    }
  }
}

TEST_CASE("equal places are one: whole turns, both signs of zero, all longitudes at a pole") {
  const std::vector<double> longitudes{10, 370, -350, 10, 180, -180, 540, 0, 77, -0.0, 0, 10},
      latitudes{5, 5, 5, -5, 0, -0.0, 0, 90, 90, 0, 0, 5};
  const io_detail::DistinctPoints points = io_detail::find_distinct_points(longitudes, latitudes);
  CHECK(points.id == std::vector<std::int32_t>{0, 0, 0, 1, 2, 2, 2, 3, 3, 4, 4, 0});
  CHECK(points.longitudes == std::vector<double>{10, 10, 180, 0, 0});
  CHECK(points.latitudes == std::vector<double>{5, -5, 0, 90, 0});
  CHECK(io_detail::find_distinct_points({}, {}).id.empty());

  std::vector<double> east, north; // a thousand, three times
  for (int i = 0; i < 3000; ++i) {
    east.push_back(0.1 * (i % 1000));
    north.push_back(0.01 * (i % 1000));
  }
  const io_detail::DistinctPoints many = io_detail::find_distinct_points(east, north);
  REQUIRE(many.longitudes.size() == 1000);
  for (std::size_t i = 0; i < 3000; ++i)
    CHECK(many.id[i] == static_cast<std::int32_t>(i % 1000));
}

TEST_CASE("places computed together have the bits of single ones") {
  std::vector<double> longitudes, latitudes;
  for (int i = -2000; i <= 2000; ++i)
    for (const double off : {0.0, 1e-13, -1e-13, 0.3}) {
      longitudes.push_back(0.5 * i + off);
      latitudes.push_back(std::clamp(0.045 * i + off, -90.0, 90.0));
    }
  for (const double far : {0.0, 1e6}) { // beyond a few turns the loop is another
    longitudes.back() += far;
    std::vector<Vec3> points(longitudes.size());
    base_detail::from_lonlats(longitudes.data(), latitudes.data(), std::ssize(longitudes),
                              points.data());
    bool same = true;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec3 p = base_detail::from_lonlat(longitudes[i], latitudes[i]);
      const Vec3 turned = base_detail::from_lonlat(longitudes[i] - 720, latitudes[i]);
      same = same && p.x == points[i].x && p.y == points[i].y && p.z == points[i].z;
      CHECK(norm(p - turned) < 1e-12);
      CHECK(std::abs(p.z - std::sin(latitudes[i] * pi / 180)) < 4e-16);
      CHECK(std::abs(p.x - std::cos(latitudes[i] * pi / 180) *
                               std::cos(std::remainder(longitudes[i], 360) * pi / 180)) < 1e-15);
    }
    CHECK(same);
  }
}

TEST_CASE("the mesh of Voronoi cells is found without a triangulation, and of no other cells") {
  int found = 0;
  for (const NamedMesh& c : tessellated_meshes()) {
    CAPTURE(c.name);
    const Points3 centres = c.mesh.points;
    const calotte::Polygons cells = polygons_of(voronoi(c.mesh));
    const auto mesh_of = [&](Points3 sites, const calotte::Polygons& polygons) {
      std::vector<MeshField> fields{
          {.name = "t",
           .location = FieldLocation::vertices,
           .values = Eigen::VectorXd::LinSpaced(polygons.corners.cols(), 0, 1)}};
      const Points3 given = sites;
      std::optional<Mesh> mesh = io_detail::mesh_of_cells(sites, polygons, 0, fields);
      if (mesh && !mesh->closed()) // of the other cells, which are a part of the sphere
        return std::optional<Mesh>();
      if (!mesh)
        CHECK(test::same_bits(sites, given)); // they stay the caller's
      else
        for (Eigen::Index v = 0; v < fields[0].values.size(); ++v) {
          const auto corner = static_cast<Eigen::Index>(
              std::lround(fields[0].values[v] * static_cast<double>(polygons.corners.cols() - 1)));
          const auto ids = mesh->triangles.col(v);
          const Eigen::Vector3d p = polygons.corners.col(corner);
          CHECK(std::abs(p.dot(given.col(ids[0]).normalized() - given.col(ids[2]).normalized())) <
                1e-6);
        }
      return mesh;
    };
    if (const std::optional<Mesh> mesh = mesh_of(centres, cells)) {
      ++found;
      CHECK(test::same_bits(mesh->triangles, c.mesh.triangles));
      CHECK(test::same_bits(mesh->neighbours, c.mesh.neighbours));
      CHECK(test::same_bits(mesh->points, centres));
    }
    calotte::Polygons other = cells;
    other.corners.col(0) =
        (cells.corners.col(0) + 0.01 * centres.col(1).stableNormalized()).normalized();
    CHECK(!mesh_of(centres, other)); // a corner that moved
    other = cells;
    std::swap(other.ids[0][0], other.ids[0][1]);
    CHECK(!mesh_of(centres, other)); // a cell that crosses itself
    Points3 moved = centres;
    moved.col(0).swap(moved.col(1));
    CHECK(!mesh_of(moved, cells));
    CHECK(!mesh_of(centres.leftCols(3), cells));
  }
  CHECK(found >= 8); // of 13: some of the others have corners that coincide
}

TEST_CASE("cells need a closed mesh, triangles do not") {
  const Scratch scratch;
  const Mesh open = delaunay(test::upper_half(30, 1));
  for (const Format format : {Format::ugrid, Format::scrip, Format::esmf})
    CHECK_THROWS_AS(write(scratch / "a.nc", open, {.format = format}), Error);
  CHECK(scratch.files() == 0);
  const RawMesh raw = written_and_read(scratch / "a.nc", open, io_detail::write_ugrid_triangles,
                                       io_detail::read_ugrid);
  CHECK(test::same_bits(raw.triangles, open.triangles));
  CHECK(!NetcdfReader(scratch / "a.nc").has_variable("mesh_face_lon"));
}

TEST_CASE("each kind is known by its contents") {
  const Scratch scratch;
  const Mesh mesh = delaunay(test::octahedron());
  const auto kinds = [&](Write write) {
    write(scratch / "a.nc", mesh, {});
    const NetcdfReader file(scratch / "a.nc");
    return std::vector<bool>{io_detail::is_ugrid(file), io_detail::is_scrip(file),
                             io_detail::is_esmf(file)};
  };
  CHECK(kinds(write_ugrid) == std::vector<bool>{true, false, false});
  CHECK(kinds(io_detail::write_ugrid_triangles) == std::vector<bool>{true, false, false});
  CHECK(kinds(write_scrip) == std::vector<bool>{false, true, false});
  CHECK(kinds(write_esmf) == std::vector<bool>{false, false, true});
}

TEST_CASE("UGRID of others") {
  const Scratch scratch;
  Mesh mesh = delaunay(random_sphere(30));
  const std::string path = scratch / "a.nc";
  const auto check_read = [&](const Foreign& foreign, const Triangles& triangles) {
    foreign.write(path, mesh.points);
    const RawMesh raw = io_detail::read_ugrid(NetcdfReader(path));
    CHECK((raw.points - mesh.points).cwiseAbs().maxCoeff() < 2e-15);
    CHECK(test::same_bits(raw.triangles, triangles));
  };
  check_read({.faces = foreign_faces(mesh, 0)}, mesh.triangles);
  check_read({.faces = foreign_faces(mesh, 1), .start_index = 1}, mesh.triangles);
  check_read({.faces = foreign_faces(mesh, 0), .faces_last = true}, mesh.triangles);
  check_read({.faces = foreign_faces(mesh, 0), .latitude_first = true, .radians = true},
             mesh.triangles);

  auto padded = foreign_faces(mesh, 0);
  for (auto& face : padded)
    face.push_back(-0x1p63);
  check_read({.faces = padded, .fill = -0x1p63}, mesh.triangles);
  for (auto& face : padded)
    face.back() = std::numeric_limits<double>::quiet_NaN();
  check_read({.faces = padded}, mesh.triangles);
  padded[5].back() = 0; // a quadrangle: the faces are cells
  Foreign{.faces = padded}.write(path, mesh.points);
  const RawMesh cells = io_detail::read_ugrid(NetcdfReader(path));
  CHECK(cells.points.cols() == 0);
  CHECK(cells.triangles.cols() == 0);
  CHECK(cells.polygons.size() == mesh.triangles.cols());
  CHECK(cells.polygons.ids.count(5) == 4);

  SUBCASE("poles in radians") {
    mesh = delaunay(test::octahedron());
    check_read({.faces = foreign_faces(mesh, 0), .radians = true}, mesh.triangles);
  }
}

TEST_CASE("ICON's triangles, with their vertices in radians") {
  const Scratch scratch;
  const std::string path = scratch / "a.nc";
  const Mesh mesh = delaunay(random_sphere(30));
  const auto write_icon = [&](std::int32_t first) {
    io_detail::NetcdfWriter file(path);
    using Fill = io_detail::NetcdfWriter::Fill<double>;
    const int vertex = file.dimension("vertex", mesh.points.cols()),
              cell = file.dimension("cell", mesh.triangles.cols()),
              corner = file.dimension("nv", 3);
    const io_detail::NetcdfAttributes radian{{"units", std::string("radian")}};
    const int longitudes = file.variable("vlon", io_detail::NetcdfType::float64, {vertex}, radian);
    const int latitudes = file.variable("vlat", io_detail::NetcdfType::float64, {vertex}, radian);
    const int ids =
        file.variable("vertex_of_cell", io_detail::NetcdfType::int32, {corner, cell}, {});
    file.begin();
    file.put(longitudes, Fill([&](std::int64_t begin, std::int64_t end, double* out) {
               for (auto i = begin; i < end; ++i)
                 *out++ = std::atan2(mesh.points(1, i), mesh.points(0, i));
             }));
    file.put(latitudes, Fill([&](std::int64_t begin, std::int64_t end, double* out) {
               for (auto i = begin; i < end; ++i)
                 *out++ = std::atan2(mesh.points(2, i),
                                     std::hypot(mesh.points(0, i), mesh.points(1, i)));
             }));
    file.put(ids, io_detail::NetcdfWriter::Fill<std::int32_t>(
                      [&](std::int64_t begin, std::int64_t end, std::int32_t* out) {
                        for (auto row = begin; row < end; ++row)
                          for (std::int64_t t = 0; t < mesh.triangles.cols(); ++t)
                            *out++ = row == 0 && t == 0 ? first : mesh.triangles(row, t) + 1;
                      }));
    file.commit();
  };
  write_icon(mesh.triangles(0, 0) + 1);
  const Mesh read = read_mesh(path);
  CHECK((read.points - mesh.points).cwiseAbs().maxCoeff() < 2e-15);
  CHECK(test::same_bits(read.triangles, mesh.triangles));
  for (const std::int32_t id : {std::numeric_limits<std::int32_t>::min(), -1, 0, 31}) {
    CAPTURE(id);
    write_icon(id);
    CHECK_THROWS_AS(read_mesh(path), Error);
  }
}

TEST_CASE("bad UGRID files end in one line") {
  const Scratch scratch;
  const Mesh mesh = delaunay(random_sphere(30));
  const std::string path = scratch / "a.nc";
  const auto check_patched = [&](const auto& patch, const std::string& words) {
    write_ugrid(path, mesh, {});
    patch(EditedFile(path));
    check_bad_file(path, io_detail::read_ugrid, words);
  };
  const std::string ids = "mesh_face_nodes";
  check_patched(
      [&](const EditedFile& p) {
        p.put(ids, {7, 1}, 56);
      },
      ids + " of face 7 (0-based) has 56, which is not one of the 56 nodes from 0 on");
  check_patched([&](const EditedFile& p) { p.put(ids, {7, 1}, -2); }, "face 7 (0-based) has -2");
  check_patched(
      [&](const EditedFile& p) {
        p.put(ids, {7, 1}, -1);
      },
      ids + " of face 7 (0-based) does not start with three or more nodes");
  check_patched(
      [&](const EditedFile& p) {
        p.put(ids, {7, 0}, (mesh.triangles(0, 0) == 7) ? 1 : 0);
      },
      "the faces around node ");
  check_patched([&](const EditedFile& p) { p.rename(ids, "others"); }, "no variable " + ids);
  check_patched([](const EditedFile& p) { p.rename("mesh_face_y", "others"); },
                "no variable mesh_face_y");
  check_patched([](const EditedFile& p) { p.rename("mesh_node_lon", "others"); },
                "no variable mesh_node_lon");
  check_patched(
      [](const EditedFile& p) { p.attribute("mesh", "node_coordinates", "mesh_node_lon"); },
      "node_coordinates of the mesh variable mesh are not the names of two variables");
  check_patched([](const EditedFile& p) { p.attribute("mesh", "face_node_connectivity", ""); },
                "names no face_node_connectivity");
  check_patched(
      [&](const EditedFile& p) { p.attribute("mesh", "face_node_connectivity", "mesh_face_x"); },
      "mesh_face_x has the shape (30)");
  check_patched([](const EditedFile& p) { p.attribute("mesh", "site_coordinates", "a b"); },
                "site_coordinates of the mesh variable mesh are not the names of three");

  Foreign foreign{.faces = foreign_faces(mesh, 0)};
  foreign.start_index = 1;
  foreign.write(path, mesh.points);
  check_bad_file(path, io_detail::read_ugrid, "which is not one of the 30 nodes from 1 on");
  foreign.start_index = 0;
  foreign.write(path, mesh.points);
  EditedFile(path).put("north", {4}, 90.001);
  check_bad_file(path, io_detail::read_ugrid,
                 "east and north hold no place on the sphere at index 4 (0-based)");
  foreign.write(path, mesh.points);
  EditedFile(path).put("east", {4}, std::numeric_limits<double>::infinity());
  check_bad_file(path, io_detail::read_ugrid, "no place on the sphere at index 4");
  foreign.write(path, mesh.points);
  EditedFile(path).attribute("east", "units", "km");
  check_bad_file(path, io_detail::read_ugrid, "the units of east are \"km\"");
}

TEST_CASE("bad SCRIP and ESMF files end in one line") {
  const Scratch scratch;
  const Mesh mesh = delaunay(random_sphere(30));
  const std::string path = scratch / "a.nc";
  write_scrip(path, mesh, {});
  EditedFile(path).put("grid_center_lat", {3}, std::numeric_limits<double>::quiet_NaN());
  check_bad_file(path, io_detail::read_scrip, "grid_center_lon and grid_center_lat hold no place");
  EditedFile(path).rename("grid_center_lat", "others");
  CHECK(io_detail::is_scrip(NetcdfReader(path)));
  check_bad_file(path, io_detail::read_scrip, "no variable grid_center_lat");
  EditedFile(path).rename("grid_corner_lat", "grid_center_lat");
  check_bad_file(path, io_detail::read_scrip, "grid_center_lat has the shape (30, ");

  write_esmf(path, mesh, {});
  EditedFile(path).put("centerCoords", {3, 1}, -91);
  check_bad_file(path, io_detail::read_esmf, "centerCoords hold no place on the sphere at index 3");
  EditedFile(path).rename("centerCoords", "others");
  CHECK(io_detail::is_esmf(NetcdfReader(path)));
  CHECK(io_detail::read_esmf(NetcdfReader(path)).polygons.size() == 30);
  EditedFile(path).put("elementConn", {3, 0}, 400);
  check_bad_file(path, io_detail::read_esmf, "element 3 (0-based) has node 400 in elementConn");
  EditedFile(path).put("elementConn", {3, 0}, std::numeric_limits<std::int32_t>::min());
  check_bad_file(path, io_detail::read_esmf, "element 3 (0-based) has node -2147483648");
  EditedFile(path).attribute("elementConn", "start_index", -2147483647);
  check_bad_file(path, io_detail::read_esmf, "start_index of elementConn is neither 0 nor 1");
  EditedFile(path).rename("elementConn", "centerCoords");
  check_bad_file(path, io_detail::read_esmf, "centerCoords has the shape (30, ");
}

TEST_CASE("truncated files end in one line") {
  const Scratch scratch;
  const Mesh mesh = delaunay(random_sphere(12));
  const std::vector<std::pair<Write, Read>> formats{
      {write_ugrid, io_detail::read_ugrid},
      {io_detail::write_ugrid_triangles, io_detail::read_ugrid},
      {write_scrip, io_detail::read_scrip},
      {write_esmf, io_detail::read_esmf}};
  for (const auto& [write, read] : formats) {
    const std::string path = scratch / "a.nc";
    write(path, mesh, {});
    for (auto size = fs::file_size(path); size > 0;) {
      size -= std::min<std::uintmax_t>(size, 97);
      fs::resize_file(path, size);
      check_bad_file(path, read, "cut short");
    }
  }
}
