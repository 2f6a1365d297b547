// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/delaunay_options.h"

#include "help/help.h"
#include "options/numbers.h"

#include <CLI/App.hpp>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <limits>
#include <map>

namespace calotte::tools {

void add_threads(CLI::App& command, std::optional<int>& threads, const std::string& help) {
  command.add_option("--threads", threads, help)->transform(whole_number(1, 4096));
}

std::shared_ptr<DelaunayWords> add_delaunay_options(CLI::App& command) {
  auto words = std::make_shared<DelaunayWords>();
  const OptionGroup group(command, "Parallel");
  add_threads(command, words->threads, "Number of threads, 1 to 4096; default: all");
  command
      .add_option(
          "--regions", words->regions,
          "Number of regions, >= 1; default: from the number of points. Does not affect the result")
      ->transform(whole_number(1, std::numeric_limits<int>::max()));
  command
      .add_option("--centres", words->centres,
                  "Centres of the regions: sample (a coarse CVT of the points) or fibonacci (a "
                  "lattice). Does not affect the result")
      ->check(CLI::IsMember({"sample", "fibonacci"}))
      ->capture_default_str();
  command
      .add_option("--sort", words->sort,
                  "Points that a region triangulates besides its own: halo (a strip around it), "
                  "distance or voronoi (Jacobsen et al., Sect. 2.1.1). Does not affect the result")
      ->check(CLI::IsMember({"halo", "distance", "voronoi"}))
      ->capture_default_str();
  command
      .add_option("--duplicates", words->duplicates,
                  "Treatment of equal points: merge keeps the first, refuse reports an error")
      ->check(CLI::IsMember({"merge", "refuse"}))
      ->capture_default_str();
  command.add_option("--merge-within", words->merge_within,
                     "Merge points that are closer than this to an earlier point; radians, in the "
                     "plane the unit of the coordinates; >= 0; default: 0");
  return words;
}

DelaunayOptions options_of(const DelaunayWords& words) {
  static const std::map<std::string, RegionOverlap> sorts{{"halo", RegionOverlap::halo},
                                                          {"distance", RegionOverlap::distance},
                                                          {"voronoi", RegionOverlap::voronoi}};
  DelaunayOptions options;
  options.decomposition.regions = words.regions;
  options.decomposition.overlap = sorts.at(words.sort);
  options.duplicates = words.duplicates == "merge" ? Duplicates::merge : Duplicates::refuse;
  options.merge_within = words.merge_within;
  options.decomposition.centres =
      words.centres == "sample" ? RegionCentres::sample : RegionCentres::fibonacci;
  return options;
}

void with_threads(std::optional<int> threads, const std::function<void()>& work) {
  std::optional<tbb::global_control> control;
  if (threads)
    control.emplace(tbb::global_control::max_allowed_parallelism,
                    static_cast<std::size_t>(*threads));
  tbb::task_arena arena(threads ? *threads : int{tbb::task_arena::automatic});
  arena.execute(work);
}

} // namespace calotte::tools
