// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/model_gates.h"

#include "options/numbers.h"
#include "text/text.h"

#include <calotte/error.h>
#include <calotte/generators.h>
#include <calotte/limited_area.h>

#include <nlohmann/json.hpp>

#include <iomanip>
#include <sstream>
#include <utility>

namespace calotte::tools {
namespace {

ModelGates at_positions(const ModelNeeds& model, std::vector<Gate> gates, const Points3& cells) {
  ModelGates found{model.name, std::move(gates), {}};
  found.positions.setZero(2, std::ssize(found.gates));
  for (std::size_t k = 0; k < found.gates.size(); ++k)
    if (found.gates[k].cell >= 0)
      found.positions.col(static_cast<Eigen::Index>(k)) = to_lonlat(cells.col(found.gates[k].cell));
  return found;
}

std::string limit_words(const Gate& gate) {
  return gate.limit
             ? message("at {} {}", gate.at_least ? "least" : "most", formatted("%.4g", *gate.limit))
             : "";
}

/// Where the worst is; "" without one.
std::string position_words(const ModelGates& found, std::size_t k) {
  if (found.gates[k].cell < 0)
    return "";
  const auto at = found.positions.col(static_cast<Eigen::Index>(k));
  return lonlat_words(at[0], at[1]);
}

} // namespace

Ids cell_mask_of(const std::string& path, std::int64_t cells) {
  try {
    const DoubleVector values = read_cell_field(path, "bdyMaskCell", cells).values;
    if (values.size() > 0 && values.minCoeff() >= 0 && values.maxCoeff() <= limited_area_rings)
      return values.cast<std::int32_t>();
  } catch (const Error& error) {
    if (error.code() != ErrorCode::invalid_argument) // no such variable
      throw;
  }
  return {};
}

bool has_demanded_cells(const MeshFile& file) {
  return file.polygons ? file.not_voronoi.passed() : file.mesh && file.mesh->closed();
}

std::string unsuited(const ModelNeeds& model, const MeshFile& file) {
  if (file.format != "MPAS" ||
      suits(model, model.format, file.sphere_radius, file.vertex_order, model.dimensions))
    return "";
  const auto edge = [](VertexOrder order) {
    return order == VertexOrder::before_edges ? "k and k + 1" : "k - 1 and k";
  };
  std::vector<std::string> differences;
  if (!suits(model, model.format, file.sphere_radius, model.vertex_order, model.dimensions))
    differences.push_back(message("its radius is {}, instead of {}", shortest(file.sphere_radius),
                                  shortest(model.sphere_radius)));
  if (file.vertex_order != model.vertex_order)
    differences.push_back(message("edge k of its cells lies between vertices {}, instead of {}",
                                  edge(file.vertex_order), edge(model.vertex_order)));
  return message("the file is not one for {}: {}; calotte convert FILE NEW --for {}", model.name,
                 listed(differences, " and "), model.word);
}

std::string no_demanded_cells(const ModelNeeds& model) {
  return message(
      "the demands of {} are on Voronoi cells, of the whole sphere or with the corners of "
      "a part, so they are not compared",
      model.name);
}

ModelGates gates_of(const ModelNeeds& model, const std::string& path, const MeshFile& file) {
  const Voronoi cells = voronoi(file);
  const bool may_have_rings = file.polygons && is_netcdf(file);
  return at_positions(model,
                      gates(cells, model, file.planet_radius,
                            may_have_rings ? cell_mask_of(path, cells.cells.cols()) : Ids()),
                      cells.cells);
}

std::string table(const ModelGates& found) {
  std::ostringstream out;
  const auto line = [&out](const std::string& name, const std::string& value,
                           const std::string& limit, const std::string& beyond,
                           const std::string& at) {
    out << std::left << std::setw(32) << name << std::setw(12) << value << std::setw(16) << limit
        << std::setw(9) << beyond << at << "\n";
  };
  line(found.model, "grid", "limit", "beyond", "at");
  for (std::size_t k = 0; k < found.gates.size(); ++k) {
    const Gate& gate = found.gates[k];
    line(gate.name, gate.cell < 0 ? "none" : formatted("%.4g", gate.value), limit_words(gate),
         gate.limit ? std::to_string(gate.beyond) : "", position_words(found, k));
  }
  return out.str();
}

nlohmann::ordered_json to_json(const ModelGates& found) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < found.gates.size(); ++k) {
    const Gate& gate = found.gates[k];
    nlohmann::ordered_json& json = list.emplace_back();
    json["name"] = gate.name;
    if (gate.cell >= 0)
      json["value"] = gate.value;
    if (gate.limit) {
      json["limit"] = *gate.limit;
      json["beyond"] = gate.beyond;
    }
    if (gate.cell < 0)
      continue;
    const auto at = found.positions.col(static_cast<Eigen::Index>(k));
    json["cell"] = gate.cell;
    json["at"] = {at[0], at[1]};
  }
  return {{"model", found.model}, {"gates", list}};
}

std::string failure_of(const ModelGates& found) {
  std::vector<std::string> failures;
  for (std::size_t k = 0; k < found.gates.size(); ++k)
    if (const Gate& gate = found.gates[k]; !gate.passed())
      failures.push_back(message("{}: {}, the limit is {}, {} beyond, the worst at {}", gate.name,
                                 formatted("%.4g", gate.value), formatted("%.4g", *gate.limit),
                                 gate.beyond, position_words(found, k)));
  return failures.empty()
             ? ""
             : message("beyond the limits of {}: {}", found.model, listed(failures, "; ", "; "));
}

} // namespace calotte::tools
