// SPDX-License-Identifier: GPL-3.0-or-later
// Measures the time of each region of a decomposition, in an iteration of the CVT or in a
// triangulation, and the bytes of positions that it would exchange. All regions run on one thread,
// so that none disturbs another. bench/report derives the time of distributed runs from these
// measurements.

#include "clouds.h"
#include "program.h"

#include "cvt/functional.h"
#include "delaunay/centres.h"
#include "delaunay/divide.h"

#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/grid.h>

#include <algorithm>
#include <memory>

namespace calotte::bench {

namespace {

const std::map<std::string, RegionOverlap> sorts = {{"halo", RegionOverlap::halo},
                                                    {"distance", RegionOverlap::distance},
                                                    {"voronoi", RegionOverlap::voronoi}};

struct Options : RoundOptions {
  std::vector<std::string> works = {"iteration", "triangulation"};
  std::vector<int> regions = {0, 96};
  std::vector<std::string> sorts = {"halo"};
  std::vector<std::string> decompositions = {"default"};
};

/// Runs of each work in a round; the first ones use fresh memory and count for nothing, and the
/// first two iterations test the start's mesh twice. Regions count with their medians.
constexpr int iterations = 9, first_iteration = 2, triangulations = 4, first_triangulation = 1;

/// The quantity that one row measures.
struct Cut {
  std::string work, sort, decomposition;
  int regions = 0; ///< 0 for the library's own number
};

std::string name_of(const Cut& cut) {
  const std::string regions = cut.regions == 0 ? "default" : std::to_string(cut.regions);
  return cut.work + ", " + regions + " regions, " + cut.sort + " sort, " + cut.decomposition +
         " decomposition";
}

/// Cells of a nearly converged CVT: a coarse one, bisected.
Points3 generators(const Density& density, std::int64_t n) {
  const std::int64_t coarse = std::min<std::int64_t>(n, 10242);
  Points3 points = make_grid({.cells = coarse,
                              .resolution = density,
                              .start = {.kind = CvtStart::Kind::continuation},
                              .stop = {.tolerance = 1e-3, .max_iterations = 300}})
                       .mesh.points;
  while (points.cols() < n)
    points = bisect(delaunay(points));
  return make_grid({.resolution = density,
                    .start = {.points = std::move(points)},
                    .stop = {.iterations = 3},
                    .method = Method::lloyd})
      .mesh.points;
}

/// Centres of the paper's decompositions: bisected icosahedra, and a coarse CVT of the x8 density.
Points3 centres_of(const std::string& decomposition, int regions) {
  if (decomposition == "uniform")
    return bisected_icosahedron(bisection_level(regions));
  return make_grid({.cells = regions,
                    .resolution = named_density("x8"),
                    .start = {.kind = CvtStart::Kind::density},
                    .stop = {.tolerance = 1e-3}})
      .mesh.points;
}

Decomposition partition_of(const Cut& cut) {
  Decomposition options;
  options.overlap = sorts.at(cut.sort);
  if (cut.regions > 0)
    options.regions = cut.regions;
  if (cut.decomposition != "default")
    options.given_centres = centres_of(cut.decomposition, cut.regions);
  return options;
}

using Lists = std::map<std::string, std::vector<double>>;

/// Adds the number of sites that each region would receive in an iteration of a distributed run,
/// and the number of bytes of positions that it would send.
void count_halos(const Points3& points, const Decomposition& decomposition, Lists& lists) {
  const delaunay_detail::Sites sites = delaunay_detail::make_sites(points, Duplicates::merge, 0);
  const delaunay_detail::Regions regions = delaunay_detail::divide(sites, decomposition);
  std::vector<double>& halo = lists["halo"];
  std::vector<double>& sent = lists["sent"];
  halo.resize(regions.centres.size());
  sent.resize(regions.centres.size());
  for (std::size_t k = 0; k < regions.members.size(); ++k)
    for (const delaunay_detail::Run& run : regions.members[k])
      for (std::int32_t r = run.begin; r != run.end; ++r)
        if (const auto owner = static_cast<std::size_t>(regions.owner[r]); owner != k) {
          ++halo[k];
          sent[owner] += 3 * sizeof(double);
        }
}

/// \param seconds of all runs, and of each region in each run.
Sample sample_of(const std::vector<double>& seconds,
                 const std::vector<std::vector<double>>& by_region, Lists lists) {
  std::vector<double>& medians = lists["seconds"];
  for (const std::vector<double>& values : by_region)
    medians.push_back(median(values));
  return {median(seconds), {}, std::move(lists)};
}

/// Iterations of Lloyd's method.
Sample run_iterations(Points3 points, const Density& density, const Decomposition& decomposition) {
  const std::unique_ptr<cvt_detail::RunFunctional> functional = cvt_detail::make_functional(
      points, Surface::sphere(), density, {.decomposition = decomposition});
  cvt_detail::Evaluation evaluation;
  std::vector<CvtRegion> regions = functional->regions();
  std::vector<double> seconds;
  std::vector<std::vector<double>> by_region(regions.size());
  for (int i = 0; i < iterations; ++i) {
    const std::vector<CvtRegion> before = std::exchange(regions, {});
    const Stopwatch watch;
    functional->evaluate(points, false, false, evaluation);
    const Timed timed = watch.stop();
    regions = functional->regions();
    points.swap(evaluation.centroids);
    if (i < first_iteration)
      continue;
    seconds.push_back(timed.seconds);
    for (std::size_t k = 0; k < regions.size(); ++k)
      by_region.at(k).push_back(regions[k].seconds - before.at(k).seconds);
  }
  Lists lists;
  for (const CvtRegion& region : regions)
    lists["owned"].push_back(static_cast<double>(region.sites));
  count_halos(points, decomposition, lists);
  return sample_of(seconds, by_region, std::move(lists));
}

/// Triangulations. A region's seconds are those to gather, project, triangulate, cull and certify.
/// Regions start far apart, because the first one finds the caches cold. The centres are given; the
/// time to choose them is not measured.
Sample run_triangulations(const Points3& points, Decomposition decomposition) {
  const auto centres = delaunay_detail::make_centres(
      delaunay_detail::make_sites(points, Duplicates::merge, 0), decomposition);
  const std::size_t count = centres.size();
  std::vector<double> seconds;
  std::vector<std::vector<double>> by_region(count);
  Lists lists;
  lists["owned"].resize(count);
  lists["halo"].resize(count);
  for (std::size_t i = 0; i < triangulations; ++i) {
    const std::size_t first = i * count / triangulations;
    Points3 rotated(3, count);
    for (std::size_t k = 0; k < count; ++k)
      base_detail::set_column(rotated, static_cast<std::int64_t>(k), centres[(first + k) % count]);
    decomposition.given_centres = rotated;
    const DelaunayReport report =
        triangulate(points, Surface::sphere(), {.decomposition = decomposition}).report;
    if (i < first_triangulation)
      continue;
    seconds.push_back(report.seconds.total);
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t region = (first + k) % count;
      const auto owned = static_cast<double>(report.owned_per_region.at(k));
      by_region[region].push_back(report.serial ? report.seconds.triangulate
                                                : report.seconds_per_region.at(k));
      lists["owned"][region] = owned;
      lists["halo"][region] = static_cast<double>(report.sites_per_region.at(k)) - owned;
    }
  }
  return sample_of(seconds, by_region, std::move(lists));
}

std::vector<Row> rows(const std::string& set, std::int64_t n, const Options& options) {
  const Density density = named_density(set);
  const auto points = std::make_shared<Points3>(); // computed at first use
  const auto run = [=](const Cut& cut) {
    if (points->cols() == 0)
      *points = generators(density, n);
    Sample sample;
    on_threads(1, [&] {
      const Decomposition decomposition = partition_of(cut);
      sample = cut.work == "iteration" ? run_iterations(*points, density, decomposition)
                                       : run_triangulations(*points, decomposition);
    });
    return sample;
  };
  std::vector<Row> result;
  for (const std::string& work : options.works)
    for (const std::string& decomposition : options.decompositions)
      for (const std::string& sort : options.sorts)
        for (const int regions : options.regions) {
          const Cut cut{work, sort, decomposition, regions};
          result.push_back({name_of(cut), [=] { return run(cut); }});
        }
  return result;
}

void add_options(CLI::App& app, Options& options) {
  add_grid_options(app, options);
  add_list_option(app, "--works", options.works, "iteration, triangulation",
                  CLI::IsMember({"iteration", "triangulation"}));
  add_list_option(app, "--regions", options.regions, "numbers of regions; 0 for the library's own",
                  CLI::NonNegativeNumber);
  add_list_option(app, "--sorts", options.sorts, "halo, distance, voronoi", CLI::IsMember(sorts));
  add_list_option(app, "--decompositions", options.decompositions,
                  "centres: default, uniform (42, 162 ... regions), x8",
                  CLI::IsMember({"default", "uniform", "x8"}));
}

} // namespace

} // namespace calotte::bench

int main(int argc, char** argv) {
  using namespace calotte::bench;
  Options options;
  options.sets = {"uniform", "x8"};
  options.sizes = {163842};
  options.rounds = 3;
  return run_program(
      argc, argv, options,
      {"Measures what each region of a decomposition takes, on one thread.",
       {},
       [&](CLI::App& app) { add_options(app, options); },
       [&](const std::string& set, std::int64_t n) { return rows(set, n, options); }});
}
