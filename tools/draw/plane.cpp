// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/draw.h"
#include "draw/legend_of.h"
#include "draw/page.h"
#include "draw/picture.h"
#include "draw/text.h"
#include "draw/values.h"
#include "draw/vector.h"

#include <calotte/delaunay.h>
#include <calotte/domain.h>
#include <calotte/error.h>
#include <calotte/voronoi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

namespace calotte::tools {

namespace {

using Eigen::Vector2d;

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

bool is_periodic(const PlanarMesh& mesh) { return mesh.period.minCoeff() > 0; }

/// The visible part of the plane.
struct Window {
  Vector2d low, high;

  Vector2d middle() const { return low + (high - low) / 2; }
  Vector2d extent() const { return high - low; }
};

Window window_around(const Points2& places, double margin) {
  const Vector2d low = places.rowwise().minCoeff();
  const Vector2d high = places.rowwise().maxCoeff();
  const Vector2d room = Vector2d::Constant(margin * (high - low).maxCoeff());
  return {low - room, high + room};
}

Window window_of(const PlanarMesh& mesh, const std::optional<PlanarDomain>& domain) {
  if (is_periodic(mesh)) {
    return {Vector2d::Zero(), mesh.period};
  }
  if (!domain) {
    return window_around(mesh.points, 0.04);
  }
  Points2 corners(2, 0);
  for (const Eigen::MatrixXd& ring : domain->rings) {
    const Eigen::Index before = corners.cols();
    corners.conservativeResize(Eigen::NoChange, before + ring.cols());
    corners.rightCols(ring.cols()) = ring;
  }
  return window_around(corners, 0.01);
}

/// The mesh to draw, or a larger one that contains it.
struct Drawn {
  Mesh mesh; ///< triangles and neighbours
  Points2 places;
  std::vector<std::int32_t> site; ///< of each place, or -1

  explicit Drawn(const PlanarMesh& from)
      : mesh{{}, from.triangles, from.neighbours, {}}, places(from.points),
        site(static_cast<std::size_t>(from.points.cols())) {
    for (std::size_t i = 0; i < site.size(); ++i) {
      site[i] = static_cast<std::int32_t>(i);
    }
  }
};

/// Adds far sites around the mesh, which close the outer cells beyond the window.
Drawn closed_by_far_sites(const PlanarMesh& mesh, const Window& window) {
  constexpr int around = 64;
  constexpr double far = 40; // of the window's extent
  const Eigen::Index n = mesh.points.cols();
  Points2 places(2, n + around);
  places.leftCols(n) = mesh.points;
  const double reach = far * window.extent().maxCoeff();
  for (int i = 0; i < around; ++i) {
    const double angle = 2 * std::numbers::pi * i / around;
    places.col(n + i) = window.middle() + reach * Vector2d(std::cos(angle), std::sin(angle));
  }
  Drawn drawn(planar_delaunay(places));
  std::fill(drawn.site.begin() + n, drawn.site.end(), -1);
  return drawn;
}

/// Adds the copies of a box's sites near it.
Drawn with_copies(const PlanarMesh& mesh) {
  const Eigen::Index n = mesh.points.cols();
  const double spacing = std::sqrt(mesh.period.prod() / static_cast<double>(n));
  const double margin = std::min(mesh.period.maxCoeff() / 2, 8 * spacing);
  std::vector<Vector2d> copies;
  std::vector<std::int32_t> site;
  for (const int i : {-1, 0, 1}) {
    for (const int j : {-1, 0, 1}) {
      for (Eigen::Index s = 0; s < n; ++s) {
        const Vector2d place =
            mesh.points.col(s) + Vector2d(i * mesh.period.x(), j * mesh.period.y());
        if ((i != 0 || j != 0) && (place.array() > -margin).all() &&
            (place.array() < mesh.period.array() + margin).all()) {
          copies.push_back(place);
          site.push_back(static_cast<std::int32_t>(s));
        }
      }
    }
  }
  Points2 places(2, n + std::ssize(copies));
  places.leftCols(n) = mesh.points;
  for (std::size_t k = 0; k < copies.size(); ++k) {
    places.col(n + static_cast<Eigen::Index>(k)) = copies[k];
  }
  Drawn drawn(planar_delaunay(places));
  std::copy(site.begin(), site.end(), drawn.site.begin() + n);
  return drawn;
}

Drawn drawn_of(const PlanarMesh& mesh, Shapes shapes, const Window& window) {
  if (is_periodic(mesh)) {
    return with_copies(mesh);
  }
  return shapes == Shapes::triangles ? Drawn(mesh) : closed_by_far_sites(mesh, window);
}

Scene scene_of(const Drawn& drawn, Shapes shapes, const Window& window) {
  const double half = window.extent().maxCoeff() / 2;
  return make_flat_scene(drawn.mesh, shapes, (drawn.places.colwise() - window.middle()) / half);
}

/// The power of the scene's unit in a quantity: 1 for lengths, 2 for areas, otherwise 0.
double power_of(Colouring colouring) {
  return colouring == Colouring::spacing ? 1 : colouring == Colouring::area ? 2 : 0;
}

/// Of a domain, a density depends on the period only.
Eigen::VectorXd by_site(const PlanarMesh& mesh, const DrawOptions& options) {
  if (options.colouring == Colouring::density) {
    const bool periodic = mesh.period.minCoeff() > 0;
    const Eigen::VectorXd density =
        evaluate(options.density, periodic ? periodic_box(mesh.period) : rectangle({0, 0}, {1, 1}),
                 mesh.points);
    return density / density.maxCoeff();
  }
  if (options.colouring != Colouring::field) {
    return {};
  }
  require_field(options, mesh.points.cols());
  return options.field.values;
}

/// The part of a segment within the window; none if it misses the window.
std::optional<std::array<Vector2d, 2>> within(const Window& window, const Vector2d& from,
                                              const Vector2d& to) {
  double first = 0;
  double last = 1;
  for (int i = 0; i < 2; ++i) {
    const double way = to[i] - from[i];
    const double enter = ((way > 0 ? window.low : window.high)[i] - from[i]) / way;
    const double leave = ((way > 0 ? window.high : window.low)[i] - from[i]) / way;
    if (way != 0) {
      first = std::max(first, enter);
      last = std::min(last, leave);
    } else if (from[i] < window.low[i] || from[i] > window.high[i]) {
      return std::nullopt;
    }
  }
  if (!(first <= last)) {
    return std::nullopt;
  }
  return std::array<Vector2d, 2>{from + first * (to - from), from + last * (to - from)};
}

/// True if two cells meet in the visible part: tests some places of their common side.
class Meeting {
public:
  Meeting(const std::optional<PlanarDomain>& domain, const Window& window) : window_(window) {
    if (domain) {
      inside_ = containing(*domain);
    }
  }

  bool operator()(const Vector2d& from, const Vector2d& to) const {
    constexpr int places = 16;
    const auto side = within(window_, from, to);
    if (!side || !inside_) {
      return side.has_value();
    }
    for (int i = 0; i <= places; ++i) {
      const Vector2d place = (*side)[0] + (i / double(places)) * ((*side)[1] - (*side)[0]);
      if (inside_(place)) {
        return true;
      }
    }
    return false;
  }

private:
  Window window_;
  std::function<bool(const Vector2d&)> inside_;
};

/// For an open mesh: mean distances to the neighbours, or their number. Neighbours are sites whose
/// cells meet the site's own inside the domain; triangles reach across bays and islands.
std::vector<double> values_by_neighbours(const PlanarMesh& mesh, Colouring colouring,
                                         const std::optional<PlanarDomain>& domain,
                                         const Scene& scene, const Window& window) {
  const Meeting meet(domain, window);
  const double half = window.extent().maxCoeff() / 2;
  const auto corner = [&](std::int32_t t) -> Vector2d {
    return window.middle() + half * scene.circumcentres.col(t).head<2>();
  };
  const auto sites = static_cast<std::size_t>(mesh.points.cols());
  std::vector<double> sums(sites);
  std::vector<double> counts(sites);
  for (std::int32_t t = 0; t < scene.mesh->triangles.cols(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const auto a = static_cast<std::size_t>(scene.mesh->triangles((i + 1) % 3, t));
      const auto b = static_cast<std::size_t>(scene.mesh->triangles((i + 2) % 3, t));
      const std::int32_t other = scene.mesh->neighbours(i, t);
      if (other < t || a >= sites || b >= sites || !meet(corner(t), corner(other))) {
        continue;
      }
      const double distance = (mesh.points.col(static_cast<Eigen::Index>(a)) -
                               mesh.points.col(static_cast<Eigen::Index>(b)))
                                  .norm();
      for (const std::size_t end : {a, b}) {
        sums[end] += distance;
        ++counts[end];
      }
    }
  }
  if (colouring == Colouring::valence) {
    return counts;
  }
  for (std::size_t i = 0; i < sites; ++i) {
    sums[i] /= counts[i]; // NaN for a cell that meets no other
  }
  return sums;
}

/// Uses the mesh's own cells only.
std::vector<double> values_of_cells(const PlanarMesh& mesh, const DrawOptions& options,
                                    const std::optional<PlanarDomain>& domain, const Scene& scene,
                                    const Window& window) {
  const bool tessellated =
      options.colouring == Colouring::area || options.colouring == Colouring::quality;
  const bool periodic = is_periodic(mesh);
  if (tessellated && periodic) {
    const Voronoi cells = voronoi(mesh);
    const Eigen::VectorXd values =
        options.colouring == Colouring::area ? cells.cell_area : cell_fields(cells).quality;
    return {values.data(), values.data() + values.size()};
  }
  if (!periodic &&
      (options.colouring == Colouring::spacing || options.colouring == Colouring::valence)) {
    return values_by_neighbours(mesh, options.colouring, domain, scene, window);
  }
  const Drawn own(mesh);
  const Scene own_scene = scene_of(own, Shapes::cells, window);
  // In a box the values of copies are used as well as the sites' own.
  Eigen::VectorXd given = by_site(mesh, options);
  std::vector<double> values;
  if (periodic) {
    given.conservativeResize(given.size() > 0 ? scene.sites.cols() : 0);
    values = values_of(scene, options.colouring, given);
    values.resize(static_cast<std::size_t>(mesh.points.cols()));
  } else {
    values = values_of(own_scene, options.colouring, given);
  }
  const double unit = std::pow(window.extent().maxCoeff() / 2, power_of(options.colouring));
  std::for_each(values.begin(), values.end(), [unit](double& value) { value *= unit; });
  return values;
}

std::vector<double> values_of_triangles(const PlanarMesh& mesh, const DrawOptions& options,
                                        const Drawn& drawn, const Scene& scene,
                                        const Window& window) {
  const Eigen::VectorXd given = by_site(mesh, options);
  Eigen::VectorXd of_places(given.size() > 0 ? scene.sites.cols() : 0);
  for (Eigen::Index i = 0; i < of_places.size(); ++i) {
    of_places[i] = given[drawn.site[static_cast<std::size_t>(i)]];
  }
  std::vector<double> values = values_of(scene, options.colouring, of_places);
  const double unit = std::pow(window.extent().maxCoeff() / 2, power_of(options.colouring));
  std::for_each(values.begin(), values.end(), [unit](double& value) { value *= unit; });
  return values;
}

/// Omits lines of triangles with a far site.
void hide_far_triangles(const Drawn& drawn, std::vector<float>& widths) {
  for (std::size_t t = 0; t < widths.size(); ++t) {
    for (const std::int32_t place : drawn.mesh.triangles.col(static_cast<Eigen::Index>(t))) {
      if (drawn.site[static_cast<std::size_t>(place)] < 0) {
        widths[t] = 0;
      }
    }
  }
}

Painting make_painting(const PlanarMesh& mesh, const Drawn& drawn, const DrawOptions& options,
                       const std::optional<PlanarDomain>& domain, const Window& window) {
  Painting painting;
  painting.scene = scene_of(drawn, options.shapes, window);
  if (options.shapes == Shapes::triangles) {
    painting.values = values_of_triangles(mesh, options, drawn, painting.scene, window);
  } else {
    const std::vector<double> values =
        values_of_cells(mesh, options, domain, painting.scene, window);
    for (const std::int32_t site : drawn.site) {
      painting.values.push_back(site < 0 ? nothing : values[static_cast<std::size_t>(site)]);
    }
  }
  painting.widths = widths_of(painting.scene, painting.scene.shapes);
  if (options.shapes == Shapes::both) {
    painting.triangle_widths = widths_of(painting.scene, Shapes::triangles);
    hide_far_triangles(drawn, painting.triangle_widths);
  }
  return painting;
}

std::string title_of(const PlanarMesh& mesh) {
  return grouped(mesh.points.cols()) + " sites, " + grouped(mesh.triangles.cols()) + " triangles" +
         (is_periodic(mesh) ? ", periodic" : "");
}

// ---- The map

/// The domain's outline, or the window's, as a path.
void add_outline(cairo_t* context, const std::optional<PlanarDomain>& domain, const Window& window,
                 double scale) {
  if (!domain || domain->periodic()) {
    const Vector2d extent = scale * window.extent();
    cairo_rectangle(context, -extent.x() / 2, -extent.y() / 2, extent.x(), extent.y());
    return;
  }
  for (const Eigen::MatrixXd& ring : domain->rings) {
    cairo_new_sub_path(context);
    for (const auto& corner : ring.colwise()) {
      const Vector2d place = scale * (corner - window.middle());
      cairo_line_to(context, place.x(), -place.y());
    }
    cairo_close_path(context);
  }
}

/// \param cut clips by the domain.
void paint_plane(cairo_t* context, const Page& page, const Painting& painting,
                 const std::optional<PlanarDomain>& domain, const Window& window, bool cut) {
  const double scale = page.map.width / window.extent().x();
  cairo_save(context);
  cairo_set_fill_rule(context, CAIRO_FILL_RULE_EVEN_ODD);
  add_outline(context, cut ? domain : std::nullopt, window, scale);
  set_colour(context, globe_colour);
  cairo_fill_preserve(context);
  cairo_clip(context);
  flat_map(context, painting, scale * window.extent().maxCoeff() / 2);
  cairo_restore(context);
  add_outline(context, domain, window, scale);
  set_colour(context, domain && !domain->periodic() ? text_colour : map_border_colour);
  cairo_set_line_width(context, std::max(0.8, 0.06 * page.text));
  cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
  cairo_stroke(context);
}

} // namespace

void draw(const std::string& path, const PlanarMesh& mesh,
          const std::optional<PlanarDomain>& domain, const DrawOptions& options) {
  require_picture(path, options.look.size);
  if (domain && (domain->periodic() != is_periodic(mesh) ||
                 (domain->periodic() && domain->period != mesh.period))) {
    throw Error(ErrorCode::bad_option,
                "the domain is not the one that the mesh was made for: one of the two is periodic, "
                "or both with other periods; leave the domain out");
  }
  const Window window = window_of(mesh, domain);
  const Drawn drawn = drawn_of(mesh, options.shapes, window);
  Painting painting = make_painting(mesh, drawn, options, domain, window);
  const Legend legend = make_legend(painting, options);
  const Page page = page_of_plane(options.look.size, window.extent().y() / window.extent().x(),
                                  options.colouring != Colouring::none);
  write_picture(path, page.width, page.height, [&](cairo_t* context) {
    draw_page(context, page, title_of(mesh), legend, [&] {
      paint_plane(context, page, painting, domain, window, options.shapes != Shapes::triangles);
    });
  });
}

} // namespace calotte::tools
