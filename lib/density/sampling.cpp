// SPDX-License-Identifier: GPL-3.0-or-later
#include "density/sampling.h"

#include "base/message.h"
#include "base/parallel.h"
#include "base/require.h"
#include "base/split_mix.h"
#include "density/envelope.h"
#include "density/surface_density.h"
#include "domain/surface.h"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace calotte::density_detail {
namespace {

constexpr std::size_t batch = 512; ///< proposals that are evaluated at once
constexpr std::int64_t batches_of_task = 16;
constexpr std::int64_t proposals_of_task = batches_of_task * batch;

/// The outcome of the proposals of a task.
struct Drawn {
  std::vector<Vec3> accepted;
  std::vector<Witness> above; ///< their envelope
};

struct Batch {
  std::array<std::int64_t, batch> box;
  std::array<double, batch> u, v; ///< in the map
  std::array<double, batch> x, y, z, rho;
  std::array<double, batch> level; ///< of the envelope, at random from 0 to it
};

/// Makes a batch of proposals. Each takes four numbers of the random stream.
template <class Map> void propose(const EnvelopeOf<Map>& envelope, SplitMix& random, Batch& out) {
  for (std::size_t i = 0; i < batch; ++i) {
    out.box[i] = envelope.choose(random.unit());
    const Box& box = envelope.boxes()[static_cast<std::size_t>(out.box[i])];
    out.u[i] = box.x + box.side * random.unit();
    out.v[i] = box.y + box.side * random.unit();
    out.level[i] = box.bounds.greatest * random.unit();
    const Vec3 p = envelope.map().point(out.u[i], out.v[i], box.south);
    out.x[i] = p.x;
    out.y[i] = p.y;
    out.z[i] = p.z;
  }
  envelope.density()(out.x, out.y, out.z, out.rho);
}

template <class Map>
void accept(const EnvelopeOf<Map>& envelope, const Batch& proposals, Drawn& drawn) {
  for (std::size_t i = 0; i < batch; ++i) {
    const double u = proposals.u[i], v = proposals.v[i], rho = proposals.rho[i];
    const Vec3 point{proposals.x[i], proposals.y[i], proposals.z[i]};
    if (!envelope.map().contains(u, v, point)) // a box may stick out
      continue;
    if (rho > envelope.boxes()[static_cast<std::size_t>(proposals.box[i])].bounds.greatest)
      drawn.above.push_back({proposals.box[i], u, v, rho});
    if (proposals.level[i] < rho)
      drawn.accepted.push_back(point);
  }
}

template <class Map>
Drawn draw_task(const EnvelopeOf<Map>& envelope, std::uint64_t seed, std::uint64_t first) {
  Drawn drawn;
  drawn.accepted.reserve(proposals_of_task);
  SplitMix random(seed, 4 * first);
  Batch proposals;
  for (std::int64_t b = 0; b < batches_of_task; ++b) {
    propose(envelope, random, proposals);
    accept(envelope, proposals, drawn);
  }
  return drawn;
}

/// The greatest witness of each box, in the order of the boxes.
std::vector<Witness> greatest_of_boxes(const std::vector<Drawn>& drawn) {
  std::vector<Witness> all;
  for (const Drawn& d : drawn)
    all.insert(all.end(), d.above.begin(), d.above.end());
  std::stable_sort(all.begin(), all.end(), [](const Witness& a, const Witness& b) {
    return a.box != b.box ? a.box < b.box : a.rho > b.rho;
  });
  const auto same = [](const Witness& a, const Witness& b) { return a.box == b.box; };
  all.erase(std::unique(all.begin(), all.end(), same), all.end());
  return all;
}

/// Appends the accepted points to the first `filled` columns, in the order of the tasks. Returns
/// the number of filled columns.
std::int64_t append(const std::vector<Drawn>& drawn, std::int64_t filled, Points3& points) {
  std::vector<std::int64_t> begin{filled};
  for (const Drawn& d : drawn)
    begin.push_back(std::min<std::int64_t>(points.cols(), begin.back() + std::ssize(d.accepted)));
  for_each_task(std::ssize(drawn), [&](std::int64_t task) {
    const auto t = static_cast<std::size_t>(task);
    for (std::int64_t i = begin[t]; i < begin[t + 1]; ++i) {
      const Vec3& p = drawn[t].accepted[static_cast<std::size_t>(i - begin[t])];
      points.col(i) << p.x, p.y, p.z;
    }
  });
  return begin.back();
}

/// The number of tasks that probably suffices at the current acceptance rate.
std::int64_t tasks_for(std::int64_t missing, std::int64_t accepted, std::int64_t proposed) {
  constexpr std::int64_t most = 512; // accepted points are in memory twice
  const double share = static_cast<double>(accepted + 1) / static_cast<double>(proposed + 2);
  const double needed = 1.02 * static_cast<double>(missing) / share / proposals_of_task;
  return needed < most ? static_cast<std::int64_t>(needed) + 1 : most;
}

/// If the proposals exceed these limits, the density is refused: its envelope does not fit it, and
/// drawing might not end.
constexpr std::int64_t most_in_vain = 1 << 24, acceptable = 1 << 14;

template <class Map> std::string remedy_in_vain() {
  if (std::is_same_v<Map, Hemispheres>)
    return "follow the density: lower its peaks, or make them wider";
  return message("lie in the {} and follow the density: widen the {}, or lower the density's peaks",
                 Map::name, Map::name);
}

/// Fills the points, or returns the witnesses above the envelope.
/// \param stream number of the seed's stream; streams are 2^56 numbers apart.
template <class Map>
std::vector<Witness> fill(const EnvelopeOf<Map>& envelope, std::uint64_t seed, std::uint64_t stream,
                          Points3& points) {
  std::int64_t filled = 0, proposed = 0;
  while (filled < points.cols()) {
    const std::int64_t tasks = tasks_for(points.cols() - filled, filled, proposed);
    std::vector<Drawn> drawn(static_cast<std::size_t>(tasks));
    for_each_task(tasks, [&](std::int64_t task) {
      const auto first = static_cast<std::uint64_t>(proposed + task * proposals_of_task);
      drawn[static_cast<std::size_t>(task)] = draw_task(envelope, seed, (stream << 54) + first);
    });
    std::vector<Witness> above = greatest_of_boxes(drawn);
    if (!above.empty())
      return above;
    filled = append(drawn, filled, points);
    proposed += tasks * proposals_of_task;
    if (proposed >= most_in_vain && proposed / acceptable > filled)
      refuse(message("only {} of {} points tried {}", filled, proposed, remedy_in_vain<Map>()));
  }
  return {};
}

template <class Map>
Points3 draw_from(EnvelopeOf<Map> envelope, std::int64_t n, std::uint64_t seed) {
  Points3 points(3, n);
  constexpr std::uint64_t most_attempts = 64;
  constexpr std::size_t most_boxes = 1 << 20; // valid densities need fewer
  for (std::uint64_t attempt = 0; attempt < most_attempts && envelope.boxes().size() < most_boxes;
       ++attempt) {
    const std::vector<Witness> above = fill(envelope, seed, attempt, points);
    if (above.empty())
      return points;
    envelope.raise(above);
  }
  refuse("the density grows without bound, or from call to call: give one with a greatest value; "
         "where it is that of cell widths, these jump: limit their gradient");
}

} // namespace

Points3 draw(std::int64_t n, const Density& density, const Surface& surface, std::uint64_t seed) {
  if (!surface.is_sphere())
    return draw_from(EnvelopeOf<PlanarMap>(surface_density(density, surface), PlanarMap(surface)),
                     n, seed);
  if (!surface.is_bounded())
    return draw_from(Envelope(density), n, seed);
  const SphericalOutline& outline = *outline_of<Sphere>(surface);
  return draw_from(EnvelopeOf<RegionMap>(density, RegionMap(outline, density.uniform())), n, seed);
}

} // namespace calotte::density_detail
