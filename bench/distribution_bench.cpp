// SPDX-License-Identifier: GPL-3.0-or-later
// Measures the time of each region of a decomposition, in an iteration of the CVT or in a
// triangulation, and the bytes of positions that it would exchange. All regions run on one thread,
// so that none disturbs another. bench/report derives the time of distributed runs from these
// measurements.

#include "clouds.h"
#include "cvt/cvt.h"
#include "delaunay/delaunay.h"
#include "program.h"
#include "stopwatch.h"
#include "support/starts.h"

#include "cvt/functional.h"
#include "delaunay/centres.h"
#include "delaunay/divide.h"

#include <calotte/cvt.h>
#include <calotte/delaunay.h>
#include <calotte/generators.h>

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <stdexcept>

namespace calotte::bench {

namespace {

const std::vector<std::string> decompositions = {"default", "uniform", "x8"};
const std::map<std::string, Overlap> sorts = {
    {"halo", Overlap::halo}, {"distance", Overlap::distance}, {"voronoi", Overlap::voronoi}};

struct Options : RoundOptions {
  std::vector<std::string> sets = {"uniform", "x8"};
  std::vector<std::int64_t> sizes = {163842};
  std::vector<std::string> works = {"iteration", "triangulation"};
  std::vector<int> regions = {0, 96};
  std::vector<std::string> sorts = {"halo"};
  std::vector<std::string> decompositions = {"default"};
  int iterations = 9, triangulations = 4;
};

struct Workload {
  std::string set;
  std::int64_t n = 0;
  Points3 points; ///< computed at first use
};

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
Points3 generators(const std::string& set, std::int64_t n) {
  const Density density = named_density(set);
  const std::int64_t coarse = std::min<std::int64_t>(n, 10242);
  const test::FirstGenerators from = test::continuation(coarse, density);
  CvtOptions options;
  options.density = density;
  options.bisections = from.bisections;
  options.tolerance = 1e-3;
  options.max_iterations = 300;
  Points3 points = cvt(from.start, Surface::sphere(), options).mesh.points;
  while (points.cols() < n)
    points = bisect(delaunay(points));
  options.bisections = 0;
  options.norm = Norm::none;
  options.method = Method::lloyd;
  options.max_iterations = 3;
  return cvt(points, Surface::sphere(), options).mesh.points;
}

/// Centres of the paper's decompositions: bisected icosahedra, and a coarse CVT of the x8 density.
Points3 centres_of(const std::string& decomposition, int regions) {
  const auto& sizes = bisected_sizes();
  const auto at = std::find(sizes.begin(), sizes.end(), regions);
  if (decomposition == "uniform") {
    if (at == sizes.end())
      throw std::invalid_argument("a uniform decomposition has 42, 162 ... regions");
    return bisected_icosahedron(static_cast<int>(at - sizes.begin()) + 1);
  }
  CvtOptions options;
  options.density = x8_density();
  options.tolerance = 1e-3;
  return cvt(random_sphere(regions, site_density(x8_density())), Surface::sphere(), options)
      .mesh.points;
}

Partition partition_of(const Cut& cut) {
  Partition options;
  options.overlap = sorts.at(cut.sort);
  if (cut.regions > 0)
    options.regions = cut.regions;
  if (cut.decomposition != "default")
    options.given_centres = centres_of(cut.decomposition, cut.regions);
  return options;
}

/// Lists, by region: seconds, owned, halo (sites), received and sent (bytes).
struct Lists {
  std::vector<double> seconds, owned, halo, received, sent;
};

constexpr double position_bytes = 3 * sizeof(double);

void add_lists(benchmark::State& state, Lists lists) {
  for (const double halo : lists.halo)
    lists.received.push_back(position_bytes * halo);
  if (lists.sent.empty())
    lists.sent = lists.received;
  set_lists(state, {{"seconds", lists.seconds},
                    {"owned", lists.owned},
                    {"halo", lists.halo},
                    {"received", lists.received},
                    {"sent", lists.sent}});
}

/// For lists with one value per region: the median for each region, without the first
/// `without` lists.
std::vector<double> medians(const std::vector<std::vector<double>>& lists, int without) {
  std::vector<double> result;
  for (std::size_t k = 0; k < lists.front().size(); ++k) {
    std::vector<double> values;
    for (auto list = lists.begin() + without; list != lists.end(); ++list)
      values.push_back(list->at(k));
    result.push_back(median(values));
  }
  return result;
}

/// Adds the number of sites that each region would receive in an iteration of a distributed run,
/// and the number of bytes that it would send.
void count_halos(const Points3& points, const Partition& partition, Lists& lists) {
  const delaunay_detail::Sites sites = delaunay_detail::make_sites(points, Duplicates::merge, 0);
  const delaunay_detail::Regions regions = delaunay_detail::divide(sites, partition);
  lists.halo.resize(regions.centres.size(), 0);
  lists.sent.resize(regions.centres.size(), 0);
  for (std::size_t k = 0; k < regions.members.size(); ++k)
    for (const delaunay_detail::Run& run : regions.members[k])
      for (std::int32_t r = run.begin; r != run.end; ++r)
        if (const auto owner = static_cast<std::size_t>(regions.owner[r]); owner != k) {
          ++lists.halo[k];
          lists.sent[owner] += position_bytes;
        }
}

/// Iterations of Lloyd's method. The seconds of a region are the median over all iterations but the
/// first two, which test the start's mesh twice and use fresh memory.
class Iterations {
public:
  Iterations(const Workload& work, const Cut& cut)
      : points_(work.points), partition_(partition_of(cut)),
        functional_(
            cvt_detail::make_functional(work.points, Surface::sphere(), options_of(work, cut))) {}

  /// \returns the wall-clock seconds of this iteration.
  double step() {
    const std::vector<CvtRegion> before = functional_->regions();
    const Stopwatch watch;
    functional_->evaluate(points_, false, false, evaluation_);
    Timed timed;
    watch.stop(timed);
    regions_ = functional_->regions();
    std::vector<double>& seconds = seconds_.emplace_back();
    for (std::size_t k = 0; k < regions_.size(); ++k)
      seconds.push_back(regions_[k].seconds - before.at(k).seconds);
    points_.swap(evaluation_.centroids);
    return timed.seconds;
  }

  Lists lists() const {
    Lists lists;
    lists.seconds = medians(seconds_, warm_up);
    for (const CvtRegion& region : regions_)
      lists.owned.push_back(static_cast<double>(region.sites));
    count_halos(points_, partition_, lists);
    return lists;
  }

  static constexpr int warm_up = 2;

private:
  static CvtOptions options_of(const Workload& work, const Cut& cut) {
    CvtOptions options;
    options.density = named_density(work.set);
    options.partition = partition_of(cut);
    return options;
  }

  Points3 points_;
  Partition partition_;
  std::unique_ptr<cvt_detail::RunFunctional> functional_;
  cvt_detail::Evaluation evaluation_;
  std::vector<CvtRegion> regions_;
  std::vector<std::vector<double>> seconds_; ///< of each iteration, by region
};

void run_iterations(benchmark::State& state, const Workload& work, const Cut& cut, int count) {
  Iterations iterations(work, cut);
  std::vector<double> seconds;
  for (int i = 0; i < count; ++i)
    seconds.push_back(iterations.step());
  state.SetIterationTime(median({seconds.begin() + Iterations::warm_up, seconds.end()}));
  add_lists(state, iterations.lists());
}

/// Triangulations. The seconds of a region (gather, project, triangulate, cull and certify) are the
/// median over all but the first, which uses fresh memory. Regions start far apart, because the
/// first one finds the caches cold. The centres are given; the time to choose them is not measured.
class Triangulations {
public:
  Triangulations(const Workload& work, const Cut& cut)
      : points_(work.points), partition_(partition_of(cut)),
        centres_(delaunay_detail::make_centres(
            delaunay_detail::make_sites(work.points, Duplicates::merge, 0), partition_)) {}

  /// The regions in cyclic order from the first-th on.
  DelaunayReport step(std::size_t first) {
    Points3 centres(3, centres_.size());
    const std::size_t count = centres_.size();
    for (std::size_t k = 0; k < count; ++k)
      base_detail::set_column(centres, static_cast<std::int64_t>(k), centres_[(first + k) % count]);
    partition_.given_centres = centres;
    DelaunayReport report =
        triangulate(points_, Surface::sphere(), {.partition = partition_}).report;
    if (report.serial) {
      report.seconds_per_region = {report.seconds.triangulate};
      return report;
    }
    const auto in_place = [&](auto& list) {
      std::rotate(list.begin(), list.end() - static_cast<std::ptrdiff_t>(first), list.end());
    };
    in_place(report.seconds_per_region);
    in_place(report.owned_per_region);
    in_place(report.sites_per_region);
    return report;
  }

  std::size_t regions() const { return centres_.size(); }

  static constexpr int warm_up = 1;

private:
  const Points3& points_;
  Partition partition_;
  std::vector<base_detail::Vec3> centres_;
};

void run_triangulations(benchmark::State& state, const Workload& work, const Cut& cut, int count) {
  Triangulations triangulations(work, cut);
  DelaunayReport report;
  std::vector<double> total;
  std::vector<std::vector<double>> seconds;
  for (int i = 0; i < count; ++i) {
    const auto turn = static_cast<std::size_t>(i);
    report = triangulations.step(turn * triangulations.regions() / static_cast<std::size_t>(count));
    total.push_back(report.seconds.total);
    seconds.push_back(report.seconds_per_region);
  }
  const int without = Triangulations::warm_up;
  state.SetIterationTime(median({total.begin() + without, total.end()}));
  Lists lists;
  lists.seconds = medians(seconds, without);
  for (std::size_t k = 0; k < report.owned_per_region.size(); ++k) {
    const auto owned = static_cast<double>(report.owned_per_region[k]);
    lists.owned.push_back(owned);
    lists.halo.push_back(static_cast<double>(report.sites_per_region[k]) - owned);
  }
  add_lists(state, lists);
}

void run_cut(benchmark::State& state, Workload& work, const Cut& cut, const Options& options) {
  if (work.points.cols() == 0)
    work.points = generators(work.set, work.n);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
  tbb::task_arena arena(1);
  for (auto _ : state)
    arena.execute([&] {
      if (cut.work == "iteration")
        run_iterations(state, work, cut, options.iterations);
      else
        run_triangulations(state, work, cut, options.triangulations);
    });
}

std::vector<RoundRow> make_rows(const Options& options, const std::shared_ptr<Workload>& work) {
  std::vector<RoundRow> rows;
  for (const std::string& kind : options.works)
    for (const std::string& decomposition : options.decompositions)
      for (const std::string& sort : options.sorts)
        for (const int regions : options.regions) {
          const Cut cut{kind, sort, decomposition, regions};
          const auto run = [work, cut, &options](benchmark::State& state) {
            run_cut(state, *work, cut, options);
          };
          rows.push_back({name_of(cut), run});
        }
  return rows;
}

void register_all(const Options& options) {
  std::vector<std::shared_ptr<Workload>> works;
  for (const std::int64_t n : options.sizes)
    for (const std::string& set : options.sets)
      works.push_back(std::make_shared<Workload>(Workload{set, n, {}}));
  for (int round = 0; round < options.rounds; ++round)
    for (const auto& work : works)
      register_round(work->set, work->n, round, make_rows(options, work));
}

void add_options(CLI::App& app, Options& options) {
  add_grid_options(app, options.sets, options.sizes);
  add_list_option(app, "--works", options.works, "iteration, triangulation",
                  CLI::IsMember({"iteration", "triangulation"}));
  add_list_option(app, "--regions", options.regions, "numbers of regions; 0 for the library's own",
                  CLI::NonNegativeNumber);
  add_list_option(app, "--sorts", options.sorts, "halo, distance, voronoi", CLI::IsMember(sorts));
  add_list_option(app, "--decompositions", options.decompositions,
                  "centres: default, uniform (42, 162 ... regions), x8",
                  CLI::IsMember(decompositions));
  app.add_option("--iterations", options.iterations, "of each run; the first two count for nothing")
      ->check(CLI::Range(Iterations::warm_up + 1, 10000))
      ->capture_default_str();
  app.add_option("--triangulations", options.triangulations,
                 "of each run, beginning with regions far apart; the first counts for nothing")
      ->check(CLI::Range(Triangulations::warm_up + 3, 10000)) // a median of two is their mean
      ->capture_default_str();
  app.add_option("--rounds", options.rounds, "how often every row runs")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
}

} // namespace

} // namespace calotte::bench

int main(int argc, char** argv) {
  using namespace calotte::bench;
  Options options;
  options.rounds = 3;
  return run_program(argc, argv,
                     {"Measures what each region of a decomposition takes, on one thread.",
                      {},
                      [&](CLI::App& app) { add_options(app, options); },
                      [&] { register_all(options); }});
}
