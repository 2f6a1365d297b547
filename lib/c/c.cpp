// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/c.h>

#include "c/room.h"

#include <calotte/check.h>
#include <calotte/cvt.h>
#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/read.h>
#include <calotte/version.h>
#include <calotte/voronoi.h>
#include <calotte/write.h>

#include <tbb/task_arena.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <variant>

struct calotte_mesh {
  std::variant<calotte::Mesh, calotte::PlanarMesh> mesh;
};

struct calotte_cells {
  calotte::Voronoi cells;
};

namespace calotte {
namespace {

thread_local int threads = 0;

void set(calotte_error* error, const char* message, std::int64_t index) {
  if (error == nullptr)
    return;
  error->index = index;
  const std::size_t length = std::min(std::strlen(message), sizeof error->message - 1);
  std::memcpy(error->message, message, length);
  error->message[length] = '\0';
}

/// Does the work and turns what it throws into a code.
template <class Work> calotte_status guarded(calotte_error* error, Work work) {
  try {
    if (threads == 0)
      work();
    else
      tbb::task_arena(threads).execute(work);
    return CALOTTE_OK;
  } catch (const Error& failure) {
    set(error, failure.what(), failure.index());
    return static_cast<calotte_status>(static_cast<int>(failure.code()) + 1);
  } catch (const std::bad_alloc&) {
    set(error, "not enough memory; give fewer points or use a larger machine", -1);
    return CALOTTE_NO_MEMORY;
  } catch (const std::exception& failure) {
    set(error, failure.what(), -1);
  } catch (...) {
    set(error, "an unknown exception; please report it", -1);
  }
  return CALOTTE_INTERNAL;
}

void require(bool holds, const char* problem) {
  if (!holds)
    throw Error(ErrorCode::bad_option, problem);
}

Eigen::Map<const DoubleMatrix> points_of(const double* values, std::int64_t n, int rows) {
  require(n >= 0, "the number of points is negative; give 0 or more");
  require(values != nullptr || n == 0, "the points are a null pointer; give an array");
  return {values, rows, n};
}

template <class AnyMesh> void hand_over(AnyMesh&& made, calotte_mesh** mesh) {
  require(mesh != nullptr, "the place for the mesh is a null pointer; give the address of one");
  *mesh = new calotte_mesh{std::forward<AnyMesh>(made)};
}

template <class AnyMesh> calotte_triangulation view_of(const AnyMesh& mesh) {
  return {static_cast<int>(mesh.points.rows()),
          mesh.points.cols(),
          mesh.triangles.cols(),
          mesh.points.data(),
          mesh.triangles.data(),
          mesh.neighbours.data(),
          std::ssize(mesh.site_of_input),
          mesh.site_of_input.data()};
}

Density density_of(calotte_density function, void* data) {
  Density density;
  if (function == nullptr)
    return density;
  density.kind = Density::Kind::callable;
  density.callable = [function, data](const Eigen::Ref<const Points3>& x,
                                      Eigen::Ref<Eigen::VectorXd> rho) {
    if (function(x.data(), x.cols(), rho.data(), data) != 0)
      throw Error(ErrorCode::cancelled, "the density function ended the run");
  };
  return density;
}

calotte_cvt_options defaults() {
  calotte_cvt_options options{};
  options.seed = 1;
  return options;
}

CvtOptions options_of(const calotte_cvt_options& words) {
  CvtOptions options;
  options.density = density_of(words.density, words.density_data);
  options.well_centred = words.well_centred != 0;
  if (words.tolerance != 0)
    options.tolerance = words.tolerance;
  else if (options.well_centred)
    options.tolerance = tolerance_before_finish;
  require(words.iterations >= 0 && words.iterations <= 1'000'000'000,
          "iterations is not within 0 to 10^9");
  if (words.iterations > 0)
    options.max_iterations = static_cast<int>(words.iterations);
  return options;
}

CvtCallback callback_of(const calotte_cvt_options& words) {
  if (words.progress == nullptr)
    return {};
  return [words](const CvtProgress& now) {
    return words.progress(std::ssize(now.report.iterations), now.report.residual,
                          words.progress_data) != 0;
  };
}

void run(const PointsRef& start, const CvtOptions& options, const calotte_cvt_options& words,
         calotte_mesh** mesh, calotte_cvt_report* report) {
  Cvt cvt = spherical_cvt(start, options, callback_of(words));
  hand_over(std::move(cvt.mesh), mesh);
  if (report != nullptr)
    *report = {cvt.report.converged ? 1 : 0,
               cvt.report.well_centred ? 1 : 0,
               std::ssize(cvt.report.iterations),
               cvt.report.residual,
               cvt.report.iterations.empty() ? 0 : cvt.report.iterations.back().energy,
               cvt.report.seconds};
}

} // namespace
} // namespace calotte

using namespace calotte;

const char* calotte_version(void) { return CALOTTE_VERSION; }

void calotte_set_threads(int count) { threads = std::max(count, 0); }

void calotte_mesh_free(calotte_mesh* mesh) { delete mesh; }

calotte_status calotte_delaunay(const double* xyz, int64_t n, calotte_mesh** mesh,
                                calotte_error* error) {
  return guarded(error, [&] { hand_over(spherical_delaunay(points_of(xyz, n, 3)), mesh); });
}

calotte_status calotte_delaunay_in_plane(const double* xy, int64_t n, double period_x,
                                         double period_y, calotte_mesh** mesh,
                                         calotte_error* error) {
  return guarded(error, [&] {
    const auto places = points_of(xy, n, 2);
    const bool periodic = period_x != 0 || period_y != 0;
    hand_over(periodic ? periodic_delaunay(places, {period_x, period_y}) : planar_delaunay(places),
              mesh);
  });
}

void calotte_mesh_view(const calotte_mesh* mesh, calotte_triangulation* view) {
  *view = std::visit([](const auto& any) { return view_of(any); }, mesh->mesh);
}

calotte_status calotte_check(const calotte_mesh* mesh, calotte_error* error) {
  return guarded(error, [&] {
    require(mesh != nullptr, "the mesh is a null pointer");
    const Check result = std::visit([](const auto& any) { return check(any); }, mesh->mesh);
    require(result.passed(), result.failure.c_str());
  });
}

void calotte_cells_free(calotte_cells* cells) { delete cells; }

calotte_status calotte_voronoi(const calotte_mesh* mesh, calotte_cells** cells,
                               calotte_error* error) {
  return guarded(error, [&] {
    require(mesh != nullptr && cells != nullptr, "the mesh or the place for the cells is null");
    *cells =
        new calotte_cells{std::visit([](const auto& any) { return voronoi(any); }, mesh->mesh)};
  });
}

void calotte_cells_view(const calotte_cells* cells, calotte_tessellation* view) {
  const Voronoi& v = cells->cells;
  *view = {v.cells.cols(),
           v.edges.cols(),
           v.vertices.cols(),
           v.edges.data(),
           v.vertices.data(),
           v.begin.data(),
           v.edges_on_cell.data(),
           v.vertices_on_cell.data(),
           v.cells_on_cell.data(),
           v.cells_on_vertex.data(),
           v.cells_on_edge.data(),
           v.vertices_on_edge.data(),
           v.dc.data(),
           v.dv.data(),
           v.cell_area.data(),
           v.vertex_area.data()};
}

void calotte_cvt_defaults(calotte_cvt_options* options) { *options = defaults(); }

calotte_status calotte_grid(int64_t cells, const calotte_cvt_options* options, calotte_mesh** mesh,
                            calotte_cvt_report* report, calotte_error* error) {
  return guarded(error, [&] {
    const calotte_cvt_options words = options == nullptr ? defaults() : *options;
    CvtOptions here = options_of(words);
    const auto seed = static_cast<std::uint64_t>(words.seed);
    const bool uniform = here.density.uniform();
    Continuation from =
        uniform ? continuation(cells, here.density, seed) : multilevel(cells, here.density, seed);
    here.bisections = from.bisections;
    if (!uniform) {
      here.cells = cells;
      here.insertion_rounds = usual_insertion_rounds;
    }
    run(from.start, here, words, mesh, report);
  });
}

calotte_status calotte_cvt(const double* xyz, int64_t n, const calotte_cvt_options* options,
                           calotte_mesh** mesh, calotte_cvt_report* report, calotte_error* error) {
  return guarded(error, [&] {
    const calotte_cvt_options words = options == nullptr ? defaults() : *options;
    run(points_of(xyz, n, 3), options_of(words), words, mesh, report);
  });
}

calotte_status calotte_read(const char* path, calotte_mesh** mesh, calotte_error* error) {
  return guarded(error, [&] {
    require(path != nullptr, "the path is a null pointer");
    hand_over(read_mesh(path), mesh);
  });
}

calotte_status calotte_write(const char* path, const calotte_mesh* mesh, double sphere_radius,
                             calotte_error* error) {
  return guarded(error, [&] {
    require(path != nullptr && mesh != nullptr, "the path or the mesh is a null pointer");
    WriteOptions options;
    options.sphere_radius = sphere_radius;
    std::visit([&](const auto& any) { write(path, any, options); }, mesh->mesh);
  });
}
