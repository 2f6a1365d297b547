// SPDX-License-Identifier: GPL-3.0-or-later
// Makes a grid for a density of one's own, shows its progress, and cancels it on request.
// Usage: density [N], the number of evaluations after which the run is cancelled; none by default.
#include <calotte/error.h>
#include <calotte/grid.h>

#include <cstddef>
#include <iostream>
#include <string>

int main(int argc, char** argv) {
  const std::size_t limit = argc > 1 ? std::stoul(argv[1]) : 10'000;

  // Widths are proportional to rho^(-1/4): here twice as wide at the poles as at the equator. Many
  // threads call the function at once.
  const calotte::Density density = calotte::density_of([](const Eigen::Vector3d& x) {
    const double root = 1 + 3 * x.z() * x.z();
    return 1 / (root * root);
  });
  calotte::RunOptions options;
  options.progress = [limit](const calotte::Progress& now) { // one thread at a time
    const calotte::CvtReport& report = now.run->report;
    std::cerr << report.iterations.size() << " evaluations, residual " << report.residual << '\n';
    using Reply = calotte::ProgressReply; // Reply::stop would end the run with the grid as it is
    return report.iterations.size() < limit ? Reply::proceed : Reply::cancel;
  };
  try {
    const calotte::Cvt grid = calotte::make_grid({.cells = 1000, .resolution = density}, options);
    std::cout << grid.mesh.points.cols() << " cells, "
              << (grid.report.well_centred ? "well-centred" : "not well-centred") << '\n';
  } catch (const calotte::Error& error) {
    std::cout << error.what() << '\n';
    return error.code() == calotte::ErrorCode::cancelled ? 3 : 1;
  }
}
