// SPDX-License-Identifier: GPL-3.0-or-later
// Progress and cancellation of triangulation, check and write.
#include "delaunay/delaunay.h"
#include "support/files.h"
#include "support/laws.h"

#include <calotte/check.h>
#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/generators.h>
#include <calotte/progress.h>
#include <calotte/read.h>
#include <calotte/write.h>

#include <doctest/doctest.h>

#include <atomic>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

using namespace calotte;
using namespace calotte::test;

namespace {

using Work = std::function<void(const ProgressCallback&)>;

/// What a run tells: its stages in order, and whether the calls keep what is documented.
struct Telling {
  std::vector<std::string> stages;
  std::vector<double> fractions;
  std::atomic<int> inside{0};
  bool one_at_a_time = true;

  ProgressCallback callback() {
    return [this](const Progress& progress) {
      one_at_a_time = one_at_a_time && inside++ == 0;
      if (stages.empty() || stages.back() != progress.stage)
        stages.emplace_back(progress.stage);
      fractions.push_back(progress.fraction);
      --inside;
      return ProgressReply::proceed;
    };
  }
};

/// Runs to the end; \returns the stages.
std::vector<std::string> check_told(const Work& work) {
  Telling telling;
  work(telling.callback());
  CHECK(telling.one_at_a_time);
  REQUIRE_FALSE(telling.fractions.empty());
  CHECK(telling.fractions.front() >= 0);
  CHECK(telling.fractions.back() == 1);
  for (std::size_t i = 1; i < telling.fractions.size(); ++i)
    CHECK(telling.fractions[i - 1] <= telling.fractions[i]);
  CHECK(telling.fractions.size() > telling.stages.size());
  return telling.stages;
}

/// Cancels at the first and at a later call of each stage.
void check_cancelled(const Work& work, const std::vector<std::string>& stages,
                     const std::function<void()>& check_after) {
  for (const std::string& stage : stages)
    for (const int wanted : {1, 3}) {
      CAPTURE(stage);
      CAPTURE(wanted);
      int calls = 0;
      bool cancelled = false, called_again = false;
      const auto callback = [&](const Progress& progress) {
        called_again = called_again || cancelled;
        cancelled =
            cancelled || (progress.stage == stage && progress.fraction < 1 && ++calls == wanted);
        return cancelled ? ProgressReply::cancel : ProgressReply::proceed;
      };
      try {
        work(callback);
      } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::cancelled);
        CHECK(cancelled);
      }
      CHECK(cancelled == (calls >= wanted));
      CHECK_FALSE(called_again);
      if (cancelled)
        check_after();
    }
}

DelaunayOptions with(const ProgressCallback& progress) {
  DelaunayOptions options;
  options.progress = progress;
  return options;
}

WriteOptions told(const ProgressCallback& progress) {
  WriteOptions options;
  options.progress = progress;
  return options;
}

const std::vector<std::string> stages_of_delaunay{"sites", "regions", "triangulate", "unite"};

} // namespace

TEST_CASE("a triangulation reports progress and gives the same bits") {
  const Points3 points = random_sphere(200'000, 4);
  const Mesh mesh = delaunay(points);
  const std::vector<std::string> stages = check_told([&](const ProgressCallback& progress) {
    CHECK(identical(delaunay(points, {}, with(progress)), mesh));
  });
  CHECK(stages == stages_of_delaunay);
}

TEST_CASE("a triangulation is cancelled in any stage, and the next one is whole") {
  const Points3 points = random_sphere(200'000, 4);
  const Mesh mesh = delaunay(points);
  check_cancelled([&](const ProgressCallback& progress) { delaunay(points, {}, with(progress)); },
                  stages_of_delaunay, [] {});
  CHECK(identical(delaunay(points), mesh));
}

TEST_CASE("triangulations of the plane, of a box and of few sites report progress") {
  const Surface square = rectangle({0, 0}, {1, 1});
  const Points2 points = random_points(20'000, square, {}, 3).topRows<2>();
  const Points3 few = random_sphere(50, 3);
  check_told([&](const ProgressCallback& progress) {
    delaunay(points, Surface::plane(), with(progress));
  });
  check_told([&](const ProgressCallback& progress) {
    delaunay(points, Surface::periodic({1, 1}), with(progress));
  });
  check_told([&](const ProgressCallback& progress) { delaunay(few, {}, with(progress)); });
}

TEST_CASE("an exception of the callback reaches the caller") {
  const Points3 points = random_sphere(100'000, 4);
  for (const std::string& stage : stages_of_delaunay) {
    const auto callback = [&](const Progress& progress) {
      if (progress.stage == stage)
        throw std::out_of_range("mine");
      return ProgressReply::proceed;
    };
    CHECK_THROWS_WITH_AS(delaunay(points, {}, with(callback)), "mine", std::out_of_range);
  }
}

TEST_CASE("check reports progress and can be cancelled") {
  const Mesh mesh = delaunay(random_sphere(100'000, 4));
  const CheckReport alone = check(mesh);
  const Work work = [&](const ProgressCallback& progress) {
    const CheckReport watched = check(mesh, progress);
    CHECK(watched.passed());
    CHECK(watched.area == alone.area);
  };
  CHECK(check_told(work) == std::vector<std::string>{"check"});
  check_cancelled(work, {"check"}, [] {});
  Mesh broken = mesh;
  broken.points.col(7) *= -1;
  check_told([&](const ProgressCallback& progress) {
    CHECK(check(broken, progress).failure == check(broken).failure);
  });
}

TEST_CASE("write reports progress; if cancelled, it leaves no file") {
  const Mesh mesh = delaunay(random_sphere(20'000, 4));
  for (const char* name :
       {"a.nc", "a.off", "a.vtu", "a.ply", "a.tri", "a.geojson", "SaveVertices"}) {
    CAPTURE(name);
    const Scratch plain, watched;
    write(plain / name, mesh);
    const Work work = [&](const ProgressCallback& progress) {
      for (const auto& entry : std::filesystem::directory_iterator(watched.folder))
        std::filesystem::remove(entry);
      write(watched / name, mesh, told(progress));
    };
    check_cancelled(work, {"number", "write"}, [&] { CHECK(watched.files() == 0); });
    const std::vector<std::string> stages = check_told(work);
    CHECK(stages.back() == "write");
    CHECK(watched.files() == plain.files());
    CHECK(test::read_file(watched / name) == test::read_file(plain / name));
  }
}

TEST_CASE("outside of make_grid() stop is as cancel") {
  const auto stop = [](const Progress& progress) {
    return progress.fraction > 0.1 ? ProgressReply::stop : ProgressReply::proceed;
  };
  const Points3 points = random_sphere(20'000, 4);
  CHECK(code_of([&] { delaunay(points, {}, with(stop)); }) == ErrorCode::cancelled);
  const Scratch scratch;
  const Mesh mesh = delaunay(points);
  CHECK(code_of([&] { write(scratch / "a.nc", mesh, told(stop)); }) == ErrorCode::cancelled);
  CHECK(scratch.files() == 0);
}

TEST_CASE("write of a file that is there leaves it as it was when cancelled") {
  const Mesh mesh = delaunay(random_sphere(20'000, 4));
  const Scratch scratch;
  test::write_text(scratch / "a.nc", "older");
  const auto cancel = [](const Progress& progress) {
    return progress.stage == "write" ? ProgressReply::cancel : ProgressReply::proceed;
  };
  CHECK(code_of([&] { write(scratch / "a.nc", mesh, told(cancel)); }) == ErrorCode::cancelled);
  CHECK(scratch.files() == 1);
  CHECK(test::read_file(scratch / "a.nc") == "older");
}
