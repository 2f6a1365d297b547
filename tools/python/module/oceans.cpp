// SPDX-License-Identifier: GPL-3.0-or-later
#include "arrays.h"
#include "calls.h"
#include "module.h"

#include <calotte/generalise.h>
#include <calotte/generators.h>
#include <calotte/read.h>
#include <calotte/write_region.h>

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <string>
#include <utility>
#include <vector>

namespace calotte::python {
namespace {

/// For each its longitude and latitude, degrees, and its area.
py::list rows_of(const std::vector<ClosedSea>& seas) {
  py::list rows;
  for (const ClosedSea& sea : seas) {
    const Points2 at = to_lonlat(sea.position);
    rows.append(py::make_tuple(py::make_tuple(at(0, 0), at(1, 0)), sea.area));
  }
  return rows;
}

/// \param coasts files of land. \param passages n x 3 each. \param seeds n x 3.
py::dict generalise(const std::vector<std::string>& coasts, const Widths& widths,
                    const Surface& within, double least_island,
                    const std::vector<Doubles>& passages, const Doubles& seeds) {
  const GeneraliseOptions options{.least_island = least_island,
                                  .passages = lines_of(passages),
                                  .within = within,
                                  .seeds = columns(seeds)};
  GeneralisedSea made = call([&] { return generalised_sea(read_coasts(coasts), widths, options); });
  py::dict values;
  values["sea"] = std::move(made.sea);
  values["islands"] = made.islands;
  values["lakes"] = made.lakes;
  values["parts"] = rows_of(made.parts);
  values["straits"] = rows_of(made.straits);
  values["stranded_passages"] = made.stranded_passages;
  values["land_to_sea"] = made.land_to_sea;
  values["sea_to_land"] = made.sea_to_land;
  values["displacement"] = made.displacement;
  values["usual_displacement"] = made.usual_displacement;
  return values;
}

/// The lines of a file, n x 3 each.
py::list lines_in(const std::string& path) {
  py::list lines;
  for (Points3& line : call([&] { return read_lines(path); }))
    lines.append(handed_over(std::move(line)));
  return lines;
}

} // namespace

void add_oceans(py::module_& module) {
  module.def("generalised_sea", &generalise);
  module.def("read_lines", &lines_in);
  module.def("write_region", [](const std::string& path, const Surface& region) {
    call([&] { write_region(path, region); });
  });
}

} // namespace calotte::python
