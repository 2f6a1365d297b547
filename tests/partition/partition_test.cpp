// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/lists.h"
#include "partition/connected_parts.h"
#include "partition/graph.h"
#include "support/errors.h"

#include <calotte/error.h>
#include <calotte/partition.h>

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <limits>
#include <mutex>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using namespace calotte;
using partition_detail::Graph;

namespace {

using Pair = std::pair<std::int32_t, std::int32_t>;

IdLists lists_of(std::int64_t cells, const std::vector<Pair>& edges) {
  const Graph graph =
      base_detail::lists_by_key<std::vector<std::int32_t>>(cells, [&](const auto& put) {
        for (const auto& [a, b] : edges) {
          put(a, b);
          put(b, a);
        }
      });
  return {Eigen::Map<const Offsets>(graph.begin.data(), std::ssize(graph.begin)),
          Eigen::Map<const Ids>(graph.items.data(), std::ssize(graph.items))};
}

/// The edges of a lattice of squares, numbered by rows from `first` on.
std::vector<Pair> lattice(std::int32_t columns, std::int32_t rows, std::int32_t first = 0) {
  std::vector<Pair> edges;
  for (std::int32_t i = 0; i < columns * rows; ++i) {
    if ((i + 1) % columns != 0)
      edges.emplace_back(first + i, first + i + 1);
    if (i + columns < columns * rows)
      edges.emplace_back(first + i, first + i + columns);
  }
  return edges;
}

/// The number of pieces of a set of cells, by repeated search: another way than the library's.
int pieces(const std::vector<Pair>& edges, const Ids& part, std::int32_t which) {
  std::vector<std::int32_t> root(static_cast<std::size_t>(part.size()));
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](std::int32_t i) {
    while (root[static_cast<std::size_t>(i)] != i)
      i = root[static_cast<std::size_t>(i)];
    return i;
  };
  for (const auto& [a, b] : edges)
    if (part[a] == which && part[b] == which)
      root[static_cast<std::size_t>(find(a))] = find(b);
  std::set<std::int32_t> roots;
  for (std::int32_t i = 0; i < part.size(); ++i)
    if (part[i] == which)
      roots.insert(find(i));
  return static_cast<int>(roots.size());
}

/// What CellParts promises of any graph.
void check_parts(const std::vector<Pair>& edges, std::int64_t parts, const CellParts& made,
                 const DoubleVector& weights) {
  CAPTURE(parts);
  CHECK(made.parts == parts);
  REQUIRE(made.part.size() == weights.size());
  REQUIRE(made.part.minCoeff() >= 0);
  REQUIRE(made.part.maxCoeff() < parts);
  DoubleVector sums = DoubleVector::Zero(parts);
  for (Eigen::Index i = 0; i < weights.size(); ++i)
    sums[made.part[i]] += weights[i];
  CHECK(made.imbalance == doctest::Approx(sums.maxCoeff() / sums.mean() - 1).epsilon(1e-12));
  CHECK(made.balanced == (sums.maxCoeff() <= 1.03005 * sums.mean() + weights.maxCoeff()));
  std::int64_t cut = 0, unconnected = 0;
  for (const auto& [a, b] : edges)
    cut += made.part[a] != made.part[b];
  CHECK(made.edge_cut == cut);
  for (std::int32_t k = 0; k < parts; ++k) {
    const int count = pieces(edges, made.part, k);
    CHECK(count >= 1);
    unconnected += count > 1;
  }
  CHECK(made.unconnected == unconnected);
}

} // namespace

TEST_CASE("parts are connected, balanced, none is empty, and the measures are theirs") {
  const std::vector<Pair> edges = lattice(30, 20);
  const IdLists graph = lists_of(600, edges);
  for (const std::int64_t parts : {1, 2, 3, 7, 16, 50, 150, 299, 450, 599, 600}) {
    const CellParts made = partition(graph, parts);
    check_parts(edges, parts, made, DoubleVector::Ones(600));
    CHECK(made.unconnected == 0);
    CHECK(made.balanced);
  }
  CHECK(partition(graph, 1).part.isZero());
  CHECK(partition(graph, 2).edge_cut <= 22); // the shortest straight cut has 20
}

TEST_CASE("small parts of no whole number of cells have no longer boundaries than others") {
  const std::vector<Pair> edges = lattice(60, 60);
  const IdLists graph = lists_of(3600, edges);
  const auto cut = [&](std::int64_t parts) {
    const CellParts made = partition(graph, parts);
    CHECK(made.balanced);
    return static_cast<double>(made.edge_cut);
  };
  CHECK(cut(149) < 1.1 * cut(150)); // 1.03 times the mean is 24.9 cells, and 24 are too few
  CHECK(cut(380) < 1.1 * cut(400)); // 9.5 cells
}

TEST_CASE("weights balance the parts, whatever their scale, and a cell of weight 0 has a part") {
  const std::vector<Pair> edges = lattice(40, 20);
  const IdLists graph = lists_of(800, edges);
  PartitionOptions options;
  options.weights.resize(800);
  for (const double scale : {1.0, 1e-3, 1e300}) {
    for (int i = 0; i < 800; ++i)
      options.weights[i] = scale * (i % 40 < 10 ? 5 : i % 7 == 0 ? 0 : 1);
    for (const std::int64_t parts : {2, 9, 40}) {
      const CellParts made = partition(graph, parts, options);
      check_parts(edges, parts, made, options.weights);
      CHECK(made.unconnected == 0);
      CAPTURE(made.imbalance);
      CAPTURE(scale);
      CAPTURE(parts);
      CHECK(made.balanced);
    }
  }
}

TEST_CASE("the bits depend neither on threads nor on the other numbers of parts") {
  const IdLists graph = lists_of(1200, lattice(40, 30));
  const std::vector<std::int64_t> counts{24, 3, 8, 12, 5, 8};
  std::vector<std::vector<Ids>> found;
  for (const int threads : {1, 4}) {
    std::vector<std::pair<std::int64_t, Ids>> all;
    std::mutex mutex;
    tbb::task_arena(threads).execute([&] {
      partition(graph, counts, {}, [&](CellParts made) {
        const std::lock_guard lock(mutex);
        all.emplace_back(made.parts, std::move(made.part));
      });
    });
    REQUIRE(all.size() == counts.size());
    std::stable_sort(all.begin(), all.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    found.emplace_back();
    for (auto& [parts, part] : all) {
      CHECK(part == partition(graph, parts).part);
      found.back().push_back(std::move(part));
    }
  }
  CHECK(found[0] == found[1]);
}

TEST_CASE("cells that are not connected have parts, which are counted") {
  std::vector<Pair> edges = lattice(20, 20);
  const std::vector<Pair> lake = lattice(3, 2, 400);
  edges.insert(edges.end(), lake.begin(), lake.end()); // and the lone cell 406
  const IdLists graph = lists_of(407, edges);
  CHECK((component_sizes(graph) == std::vector<std::int64_t>{400, 6, 1}));
  for (const std::int64_t parts : {2, 4, 30, 407}) {
    const CellParts made = partition(graph, parts);
    check_parts(edges, parts, made, DoubleVector::Ones(407));
    CHECK(made.balanced);
    CHECK((made.unconnected > 0) == (parts < 407));
  }
}

TEST_CASE("what no connected parts can balance is said not to be") {
  std::vector<Pair> edges; // a star
  for (std::int32_t i = 1; i < 60; ++i)
    edges.emplace_back(0, i);
  const IdLists graph = lists_of(60, edges);
  for (const std::int64_t parts : {2, 5, 30}) {
    const CellParts made = partition(graph, parts);
    check_parts(edges, parts, made, DoubleVector::Ones(60));
    CHECK(made.unconnected == 0);
    CHECK(!made.balanced);
  }
}

TEST_CASE("small graphs of every number of parts keep the laws") {
  for (const auto& [columns, rows] : std::vector<Pair>{{1, 1}, {2, 1}, {3, 1}, {9, 1}, {4, 3}}) {
    const std::vector<Pair> edges = lattice(columns, rows);
    const IdLists graph = lists_of(columns * rows, edges);
    for (std::int64_t parts = 1; parts <= columns * rows; ++parts) {
      const CellParts made = partition(graph, parts);
      check_parts(edges, parts, made, DoubleVector::Ones(columns * rows));
      CHECK(made.unconnected == 0);
    }
  }
}

TEST_CASE("missing neighbours, repetitions and the cell itself have no effect") {
  IdLists graph;
  graph.begin.resize(5);
  graph.begin << 0, 3, 7, 10, 11;
  graph.items.resize(11);
  graph.items << 1, -1, 1, 0, 2, 1, 0, 3, 1, -1, 2;
  const std::vector<Pair> chain{{0, 1}, {1, 2}, {2, 3}};
  check_parts(chain, 2, partition(graph, 2), DoubleVector::Ones(4));
  CHECK(partition(graph, 2).part == partition(lists_of(4, chain), 2).part);
}

TEST_CASE("invalid arguments are refused with the index and the remedy") {
  const IdLists graph = lists_of(6, lattice(3, 2));
  const auto refusal = [&](const DoubleVector& weights) {
    return test::refusal_of([&] { partition(graph, 2, {.weights = weights}); });
  };
  CHECK(test::refusal_of([&] { partition(graph, 7); }) ==
        "6 cells cannot make 7 parts; give a number from 1 to 6");
  CHECK(test::refusal_of([&] { partition(graph, 0); }) ==
        "6 cells cannot make 0 parts; give a number from 1 to 6");
  CHECK(test::refusal_of([&] { partition({}, 1); }) ==
        "there are no cells; give the neighbours of at least one");
  CHECK(refusal(DoubleVector::Ones(5)) ==
        "there are 5 weights, but 6 cells; give one for each cell");
  CHECK(refusal(DoubleVector::Zero(6)) == "all weights are 0; give at least one that is positive");
  DoubleVector weights = DoubleVector::Ones(6);
  weights[4] = -1;
  CHECK(refusal(weights) == "the weight of cell 4 is -1; give finite weights >= 0");
  weights[3] = std::numeric_limits<double>::quiet_NaN();
  CHECK(refusal(weights) == "the weight of cell 3 is nan; give finite weights >= 0");
  weights[3] = std::numeric_limits<double>::infinity();
  CHECK(refusal(weights) == "the weight of cell 3 is inf; give finite weights >= 0");
  CHECK(refusal(DoubleVector::Constant(6, 1e308)) ==
        "the sum of the weights is infinite; give smaller ones");
  IdLists bad = graph;
  bad.items[0] = 6;
  CHECK(test::refusal_of([&] { partition(bad, 2); }) ==
        "cell 0 has a neighbour that is not one of the 6 cells; number them from 0, and give -1 "
        "for none");
  bad.items[0] = 5; // which does not have 0
  CHECK(test::refusal_of([&] { partition(bad, 2); }) ==
        "cell 0 has a neighbour that does not have it as a neighbour; give both");
}

TEST_CASE("a callback ends the call, and so does an exception of the visitor") {
  const IdLists graph = lists_of(600, lattice(30, 20));
  const std::vector<std::int64_t> counts{2, 3, 4};
  PartitionOptions options;
  options.progress = [](const Progress& progress) {
    CHECK(progress.stage == "partition");
    return ProgressReply::cancel;
  };
  CHECK(test::code_of([&] { partition(graph, counts, options, [](const CellParts&) {}); }) ==
        ErrorCode::cancelled);
  CHECK_THROWS_AS(
      partition(graph, counts, {}, [](const CellParts&) { throw std::runtime_error("full"); }),
      std::runtime_error);
}

TEST_CASE("METIS leaves the random numbers and the handlers of the process alone") {
  const IdLists graph = lists_of(600, lattice(30, 20));
  std::srand(5);
  const int expected = std::rand();
  std::srand(5);
  struct sigaction own = {}, before = {}, after = {};
  own.sa_sigaction = [](int, siginfo_t*, void*) {};
  own.sa_flags = SA_SIGINFO | SA_RESTART;
  ::sigaddset(&own.sa_mask, SIGUSR1);
  ::sigaction(SIGTERM, &own, &before);
  partition(graph, 8);
  ::sigaction(SIGTERM, &before, &after);
  CHECK(std::rand() == expected);
  CHECK((after.sa_sigaction == own.sa_sigaction));
  CHECK((after.sa_flags & (SA_SIGINFO | SA_RESTART)) == own.sa_flags);
  CHECK(::sigismember(&after.sa_mask, SIGUSR1) == 1);
}

TEST_CASE("fragments go to a neighbouring part, and empty parts get cells") {
  using partition_detail::connected_parts;
  const Graph chain = partition_detail::make_graph(lists_of(8, lattice(8, 1)));
  const auto made = [&](std::vector<std::int32_t> part, std::int64_t parts) {
    return connected_parts(chain, {}, parts, std::move(part));
  };
  CHECK((made({0, 0, 0, 0, 1, 1, 1, 1}, 2) == std::vector<std::int32_t>{0, 0, 0, 0, 1, 1, 1, 1}));
  CHECK((made({0, 0, 1, 0, 1, 1, 1, 1}, 2) == std::vector<std::int32_t>{0, 0, 0, 0, 1, 1, 1, 1}));
  CHECK((made({1, 0, 0, 0, 0, 1, 1, 1}, 2) == std::vector<std::int32_t>{0, 0, 0, 0, 0, 1, 1, 1}));
  CHECK((made({0, 0, 0, 0, 0, 0, 0, 0}, 2) == std::vector<std::int32_t>{0, 0, 0, 0, 1, 1, 1, 1}));
  const std::vector<std::int32_t> all = made({0, 0, 2, 0, 2, 0, 2, 0}, 8);
  CHECK(std::set(all.begin(), all.end()).size() == 8);
  const DoubleVector none = DoubleVector::Unit(8, 7); // the others weigh nothing
  const std::vector<std::int32_t> light =
      connected_parts(chain, none, 8, std::vector<std::int32_t>(8, 0));
  CHECK(std::set(light.begin(), light.end()).size() == 8);
}
