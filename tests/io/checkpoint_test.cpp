// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/state.h"
#include "support/files.h"

#include <calotte/checkpoint.h>
#include <calotte/error.h>
#include <calotte/generators.h>
#include <calotte/grid.h>
#include <calotte/read.h>
#include <calotte/write.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>
#include <string>
#include <vector>

using namespace calotte;
using cvt_detail::Memory;
using cvt_detail::State;

namespace fs = std::filesystem;

namespace {

const std::string configuration = "start random\ncells 30\ntolerance 1e-06\n";

/// A checkpoint in a folder that is removed at the end of the test.
struct CheckpointFile : test::Scratch {
  std::string bytes() const { return test::read_file(path); }
  void put(const std::string& content) const { test::write_text(path, content); }

  std::string path = *this / "run.checkpoint";
};

/// A state in which every field has a value of its own.
State some_state() {
  State state;
  state.points = random_sphere(30);
  state.points(0, 7) = -0.0;
  for (int i = 0; i < 30; ++i)
    state.id.push_back((7 * i) % 30);
  for (int i = 0; i < 33; ++i)
    state.site_of_input.push_back(i % 30);
  state.cursor = {.action = 1, .times = 2, .idle = 3, .glides = 4};
  state.polish = {.penalty = 0.25, .demanded_spacing = 1.5, .descended = false};
  state.memory.iterations = 17;
  state.memory.since_restart = 16;
  state.memory.final_rule = true;
  state.memory.stuck = true;
  state.report.actions = {{CvtAction::Kind::start, 12, 1, Norm::linf, 1e-3, 75},
                          {CvtAction::Kind::insert, 30, 14, Norm::l2_scaled, 1e-4, 76}};
  state.report.done = {{1, 20, 12}, {2, 17, 29}};
  for (std::uint64_t seed = 2; seed < 5; ++seed) {
    state.memory.steps.push_back(base_detail::compacted(random_sphere(30, seed), 30));
    state.memory.changes.push_back(base_detail::compacted(-0.5 * random_sphere(30, seed), 7.5));
    state.memory.curvatures.push_back(1 / static_cast<double>(seed));
  }
  state.memory.laplacian_at = random_sphere(30, 5);
  state.memory.since_laplacian = 19;
  state.memory.flipped = true;
  state.report.residual = 0.125;
  state.report.seconds = 1e300;
  for (int k = 0; k < 3; ++k) {
    CvtIteration i;
    i.cells = (std::int64_t{1} << 33) + k;
    i.rule = 6;
    i.l2 = 0.1, i.linf = std::numeric_limits<double>::denorm_min(), i.gradient = 0.3;
    i.energy = 0.4, i.accepted = k != 2, i.flips = 5 + k, i.rebuilt = k == 1;
    i.seconds = 0.6, i.seconds_exchange = 0.7, i.seconds_repair = 0.8, i.seconds_moments = 0.9;
    i.seconds_solver = 1.1;
    state.report.iterations.push_back(i);
  }
  state.report.regions.push_back({11, 1.4});
  state.report.regions.push_back({21, 2.4});
  return state;
}

/// Of any number of columns; Eigen's operator asks that they be as many.
bool equal(const Points3& a, const Points3& b) { return a.cols() == b.cols() && a == b; }

void check_restored(const CvtIteration& a, const CvtIteration& b) {
  CHECK(a.cells == b.cells);
  CHECK(a.rule == b.rule);
  CHECK(a.l2 == b.l2);
  CHECK(a.linf == b.linf);
  CHECK(a.gradient == b.gradient);
  CHECK(a.energy == b.energy);
  CHECK(a.accepted == b.accepted);
  CHECK(a.flips == b.flips);
  CHECK(a.rebuilt == b.rebuilt);
  CHECK(a.seconds == b.seconds);
  CHECK(a.seconds_exchange == b.seconds_exchange);
  CHECK(a.seconds_repair == b.seconds_repair);
  CHECK(a.seconds_moments == b.seconds_moments);
  CHECK(a.seconds_solver == b.seconds_solver);
}

using Fields = std::vector<base_detail::CompactField>;

bool equal(const Fields& a, const Fields& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return x.scale == y.scale && x.values.cols() == y.values.cols() && x.values == y.values;
  });
}

void check_restored(const Memory& a, const Memory& b) {
  CHECK(equal(a.steps, b.steps));
  CHECK(equal(a.changes, b.changes));
  CHECK(a.curvatures == b.curvatures);
  CHECK(equal(a.laplacian_at, b.laplacian_at));
  CHECK(a.since_laplacian == b.since_laplacian);
  CHECK(a.flipped == b.flipped);
  CHECK(a.iterations == b.iterations);
  CHECK(a.since_restart == b.since_restart);
  CHECK(a.final_rule == b.final_rule);
  CHECK(a.stuck == b.stuck);
}

void check_restored(const State& a, const State& b) {
  CHECK(equal(a.points, b.points));
  CHECK(a.id == b.id);
  CHECK(a.site_of_input == b.site_of_input);
  CHECK(a.cursor.action == b.cursor.action);
  CHECK(a.cursor.times == b.cursor.times);
  CHECK(a.cursor.idle == b.cursor.idle);
  CHECK(a.cursor.glides == b.cursor.glides);
  CHECK(a.polish.penalty == b.polish.penalty);
  CHECK(a.polish.demanded_spacing == b.polish.demanded_spacing);
  CHECK(a.polish.descended == b.polish.descended);
  check_restored(a.memory, b.memory);
  REQUIRE(a.report.actions.size() == b.report.actions.size());
  for (std::size_t k = 0; k < a.report.actions.size(); ++k) {
    const CvtAction &now = a.report.actions[k], &before = b.report.actions[k];
    CHECK(now.kind == before.kind);
    CHECK(now.cells == before.cells);
    CHECK(now.times == before.times);
    CHECK(now.norm == before.norm);
    CHECK(now.tolerance == before.tolerance);
    CHECK(now.max_iterations == before.max_iterations);
  }
  REQUIRE(a.report.done.size() == b.report.done.size());
  for (std::size_t k = 0; k < a.report.done.size(); ++k) {
    CHECK(a.report.done[k].times == b.report.done[k].times);
    CHECK(a.report.done[k].iterations == b.report.done[k].iterations);
    CHECK(a.report.done[k].cells == b.report.done[k].cells);
  }
  CHECK(a.report.converged == b.report.converged);
  CHECK(a.report.residual == b.report.residual);
  CHECK(a.report.seconds == b.report.seconds);
  REQUIRE(a.report.iterations.size() == b.report.iterations.size());
  for (std::size_t k = 0; k < a.report.iterations.size(); ++k)
    check_restored(a.report.iterations[k], b.report.iterations[k]);
  REQUIRE(a.report.regions.size() == b.report.regions.size());
  for (std::size_t k = 0; k < a.report.regions.size(); ++k) {
    CHECK(a.report.regions[k].sites == b.report.regions[k].sites);
    CHECK(a.report.regions[k].seconds == b.report.regions[k].seconds);
  }
}

/// Of all the evaluations, trials too.
std::vector<double> energies(const Cvt& run) {
  std::vector<double> values;
  for (const CvtIteration& iteration : run.report.iterations)
    values.push_back(iteration.energy);
  return values;
}

/// The refusal's code and words; the code is internal where there was none.
Error refusal_of_checkpoint(const CheckpointFile& scratch,
                            const std::string& words = configuration) {
  try {
    read_checkpoint(scratch.path, words);
  } catch (const Error& error) {
    return error;
  }
  return {ErrorCode::internal, "not refused"};
}

bool says(const Error& error, const std::string& part) {
  const std::string message = error.what();
  return message.find(part) != std::string::npos && message.find('\n') == std::string::npos;
}

} // namespace

TEST_CASE("a state comes back with every field, bit for bit") {
  const CheckpointFile scratch;
  State state = some_state();
  for (const bool converged : {false, true}) {
    state.report.converged = converged;
    write_checkpoint(scratch.path, State::wrapped(State(state)), configuration);
    check_restored(State::of(read_checkpoint(scratch.path, configuration)), state);
    CHECK(std::signbit(State::of(read_checkpoint(scratch.path, configuration)).points(0, 7)));
  }
  write_checkpoint(scratch.path, {}, "");
  check_restored(State::of(read_checkpoint(scratch.path, "")), State{});
  CHECK(scratch.files() == 1);
}

TEST_CASE("a run resumes from its checkpoint to the same bits, on every level") {
  const CheckpointFile scratch;
  const Recipe recipe{.start = {.points = random_sphere(200, 3), .bisections = 1},
                      .stop = {.iterations = 12},
                      .method = Method::lloyd}; // whose steps are one iteration each
  const Cvt whole = make_grid(recipe);
  for (const std::size_t last : {1, 11, 12, 13, 24}) { // 12 end the coarse level, 24 the fine one
    CAPTURE(last);
    const auto saved = [&](const Progress& now) {
      if (now.run->report.iterations.size() != last)
        return ProgressReply::proceed;
      write_checkpoint(scratch.path, now.run->state, configuration);
      return ProgressReply::stop;
    };
    make_grid(recipe, {.progress = saved});
    const Cvt resumed = make_grid(recipe, {.state = read_checkpoint(scratch.path, configuration)});
    CHECK((resumed.mesh.points == whole.mesh.points));
    CHECK((resumed.mesh.triangles == whole.mesh.triangles));
    CHECK(resumed.mesh.site_of_input == whole.mesh.site_of_input);
    CHECK(resumed.report.converged == whole.report.converged);
    CHECK(resumed.report.iterations.size() == whole.report.iterations.size());
  }
}

TEST_CASE("with every method a run resumes from its checkpoint to the same bits") {
  const CheckpointFile scratch;
  const Density milder = tanh_bump({0.6, 0, 0.8}, 0.5, 0.2, 1.0 / 81); // some fall far away, too
  Recipe recipe{.resolution = tanh_bump({0.6, 0, 0.8}, 0.5, 0.2, 1.0 / 4096),
                .start = {.points = random_sphere(150, milder, 3)},
                .stop = {.tolerance = 2e-3, // so that the final rule takes over on the way
                         .max_iterations = 90}};
  for (const Method method :
       {Method::automatic, Method::lloyd, Method::lbfgs, Method::lbfgs_laplacian}) {
    CAPTURE(method);
    recipe.method = method;
    std::vector<CvtState> states; // after each step
    const auto kept = [&](const Progress& now) {
      states.push_back(now.run->state);
      return ProgressReply::proceed;
    };
    const Cvt whole = make_grid(recipe, {.progress = kept});
    REQUIRE(states.size() > 10);
    const auto ruled = std::find_if(states.begin(), states.end(), [](const CvtState& state) {
      return State::of(state).memory.final_rule;
    });
    std::set<std::ptrdiff_t> steps{
        0, 1, 2, ruled - states.begin() - 1, ruled - states.begin(), ruled - states.begin() + 1};
    for (std::ptrdiff_t step = 5; step < std::ssize(states); step += 11)
      steps.insert(step);
    for (const std::ptrdiff_t step : steps) {
      CAPTURE(step);
      if (step < 0 || step >= std::ssize(states))
        continue;
      write_checkpoint(scratch.path, states[static_cast<std::size_t>(step)], configuration);
      const Cvt resumed =
          make_grid(recipe, {.state = read_checkpoint(scratch.path, configuration)});
      CHECK(equal(resumed.mesh.points, whole.mesh.points));
      CHECK((resumed.mesh.triangles == whole.mesh.triangles));
      CHECK(resumed.report.converged == whole.report.converged);
      CHECK(energies(resumed) == energies(whole));
    }
  }
}

TEST_CASE("a checkpoint that was cut short anywhere is refused, and so is one with more") {
  const CheckpointFile scratch;
  write_checkpoint(scratch.path, State::wrapped(some_state()), configuration);
  const std::string whole = scratch.bytes();
  for (std::size_t size = 0; size < whole.size(); size += test::cut_step) {
    CAPTURE(size);
    scratch.put(whole.substr(0, size));
    const Error error = refusal_of_checkpoint(scratch);
    CHECK(error.code() == ErrorCode::parse);
    CHECK(says(error, "run.checkpoint: the checkpoint is cut short"));
  }
  scratch.put(whole + '\0');
  CHECK(says(refusal_of_checkpoint(scratch), "damaged"));
  scratch.put(whole);
  CHECK(refusal_of_checkpoint(scratch).code() == ErrorCode::internal);
}

TEST_CASE("damage to any byte is found") {
  const CheckpointFile scratch;
  write_checkpoint(scratch.path, State::wrapped(some_state()), configuration);
  const std::string whole = scratch.bytes();
  for (std::size_t offset = 0; offset < whole.size(); offset += test::cut_step) {
    CAPTURE(offset);
    std::string damaged = whole;
    damaged[offset] = static_cast<char>(damaged[offset] ^ (1 << offset % 8));
    scratch.put(damaged);
    CHECK(refusal_of_checkpoint(scratch).code() == ErrorCode::parse);
  }
}

TEST_CASE("a file that is no checkpoint of this version is refused") {
  const CheckpointFile scratch;
  write_checkpoint(scratch.path, State::wrapped(some_state()), configuration);
  std::string other = scratch.bytes();
  other[other.find("checkpoint ") + 11] = '3'; // an older version
  scratch.put(other);
  CHECK(says(refusal_of_checkpoint(scratch), "run.checkpoint: a checkpoint of another version"));
  scratch.put("1 0 0\n0 1 0\n");
  CHECK(says(refusal_of_checkpoint(scratch), "run.checkpoint: not a checkpoint"));
  fs::remove(scratch.path);
  CHECK(refusal_of_checkpoint(scratch).code() == ErrorCode::file);
  fs::create_directory(scratch.path);
  CHECK(refusal_of_checkpoint(scratch).code() == ErrorCode::file);
}

TEST_CASE("another configuration is refused with the first line that differs") {
  const CheckpointFile scratch;
  write_checkpoint(scratch.path, State::wrapped(some_state()), configuration);
  const auto check_words = [&](const std::string& words, const std::string& part) {
    CAPTURE(words);
    const Error error = refusal_of_checkpoint(scratch, words);
    CHECK(error.code() == ErrorCode::invalid_argument);
    CHECK(says(error, "run.checkpoint: a checkpoint of another configuration: it has " + part));
  };
  check_words("start random\ncells 31\ntolerance 1e-08\n",
              "\"cells 30\" where this run has \"cells 31\"");
  check_words("start random\ncells 30\n", "\"tolerance 1e-06\" where this run has nothing more");
  check_words(configuration + "rule 3\n", "nothing more where this run has \"rule 3\"");
  check_words("", "\"start random\" where this run has nothing more");
  check_words(configuration.substr(0, configuration.size() - 1), "");
}

TEST_CASE("a checkpoint that cannot be written leaves the old one unchanged") {
  const CheckpointFile scratch;
  write_checkpoint(scratch.path, State::wrapped(some_state()), configuration);
  const std::string before = scratch.bytes();
  CHECK_THROWS_AS(write_checkpoint(scratch.folder / "absent" / "file", {}, ""), Error);
  CHECK_THROWS_AS(write_checkpoint("/dev/full", State::wrapped(some_state()), ""), Error);
  CHECK(scratch.bytes() == before);
}
