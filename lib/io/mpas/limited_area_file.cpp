// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/cut.h>

#include "cvt/hull.h"
#include "delaunay/far_hull.h"
#include "domain/spherical_outline.h"
#include "domain/surface.h"
#include "exact/space.h"
#include "io/mpas/mpas.h"
#include "io/mpas/mpas_cut.h"

#include <calotte/delaunay.h>
#include <calotte/write.h>

#include <filesystem>
#include <string>
#include <utility>

namespace calotte {
namespace {

/// A file that is removed, with its graph, at the end at the latest.
class ScopedFile {
public:
  explicit ScopedFile(std::string path) : path_(std::move(path)) {}
  ScopedFile(const ScopedFile&) = delete;
  ScopedFile& operator=(const ScopedFile&) = delete;
  ~ScopedFile() { remove(); }
  /// Who has the file open reads on.
  void remove() {
    if (std::error_code ignored; !std::exchange(removed_, true)) {
      std::filesystem::remove(path_, ignored);
      std::filesystem::remove(io_detail::graph_path(path_), ignored);
    }
  }
  const std::string& path() const { return path_; }

private:
  std::string path_;
  bool removed_ = false;
};

/// The generators, and points far from their region, so that no hemisphere is empty.
Points3 spanning(const Points3& generators, const Surface& meshed, const Density& density) {
  if (!meshed.is_bounded())
    return generators;
  const Points3 far = delaunay_detail::far_hull(
                    *domain_detail::outline_of<exact_detail::Sphere>(meshed)),
                rows = cvt_detail::hull_rows(meshed, density, generators.cols());
  Points3 all(3, generators.cols() + far.cols() + rows.cols());
  all << generators, far, rows;
  return all;
}

} // namespace

CutReport write_limited_area(const std::string& target, const Mesh& mesh, const Surface& region,
                             const WriteOptions& written, const CutOptions& options) {
  ScopedFile whole(target + ".whole.nc");
  WriteOptions mpas = written;
  mpas.format = Format::mpas;
  mpas.sphere_radius = 1;
  write(whole.path(), delaunay(spanning(mesh.points, mesh.surface, written.density)), mpas);
  const io_detail::MpasSource source(whole.path());
  whole.remove(); // now, so that a run that is killed later leaves nothing
  const auto inside = [&](const Eigen::Vector3d& place) { return region.contains(place); };
  return io_detail::cut(source, target, inside, options, io_detail::Nominal::of_cells);
}

} // namespace calotte
