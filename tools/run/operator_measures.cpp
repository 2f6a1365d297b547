// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/operator_measures.h"

#include "text/text.h"

#include <calotte/generators.h>

#include <nlohmann/json.hpp>

#include <array>
#include <iomanip>
#include <sstream>

namespace calotte::tools {
namespace {

struct DistanceName {
  const char* word; ///< in the report
  const char* label;
  ErrorNorms OperatorErrors::*norms;
};

constexpr std::array<DistanceName, 2> distance_names = {{
    {"off_centroid", "off centroid / spacing", &OperatorErrors::off_centroid},
    {"off_midpoint", "off midpoint / dc", &OperatorErrors::off_midpoint},
}};

/// Longitude and latitude in degrees, or x and y.
Eigen::Vector2d location(const ErrorNorms& norms, bool on_sphere) {
  return on_sphere ? Eigen::Vector2d(to_lonlat(norms.position).col(0)) : norms.position.head<2>();
}

class Lines {
public:
  void add(const std::string& name, const std::string& l2, const std::string& max,
           const std::string& cell, const std::string& at) {
    out_ << std::left << std::setw(23) << name << std::setw(13) << l2 << std::setw(13) << max
         << std::setw(12) << cell << at << "\n";
  }
  void add(const std::string& label, const ErrorNorms& norms, bool on_sphere) {
    const Eigen::Vector2d at = location(norms, on_sphere);
    add(label, formatted("%.4g", norms.l2), formatted("%.4g", norms.max),
        norms.cell < 0 ? "none" : std::to_string(norms.cell),
        norms.cell < 0 ? ""
                       : message("{}, {}", formatted("%.6g", at[0]), formatted("%.6g", at[1])));
  }
  void add(const std::string& name, double value) {
    out_ << std::left << std::setw(48) << name << formatted("%.5g", value) << "\n";
  }
  std::string text() const { return out_.str(); }

private:
  std::ostringstream out_;
};

std::string in_unit(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : message("{}, {}", name, unit);
}

} // namespace

std::string operator_rows(const OperatorErrors& errors, const Unit& unit, bool on_sphere) {
  Lines lines;
  lines.add("errors of operators", "l2", "max", "at cell", on_sphere ? "lon, lat" : "x, y");
  for (const OperatorName& name : operator_names)
    lines.add(name.label, errors.*name.norms, on_sphere);
  lines.add("distances", "rms", "max", "at cell", on_sphere ? "lon, lat" : "x, y");
  for (const DistanceName& name : distance_names)
    lines.add(name.label, errors.*name.norms, on_sphere);
  lines.add(in_unit("longest stable step x speed of waves", unit.name),
            unit.of_radian * wave_step(errors, 1));
  lines.add(in_unit("- x viscosity, of divergence", unit.area),
            unit.of_steradian * diffusion_step(errors.primal_eigenvalue, 1));
  lines.add(in_unit("- x viscosity, of vorticity", unit.area),
            unit.of_steradian * diffusion_step(errors.dual_eigenvalue, 1));
  return lines.text();
}

nlohmann::ordered_json operators_to_json(const OperatorErrors& errors, bool on_sphere) {
  nlohmann::ordered_json json;
  const auto add = [&](const char* word, const ErrorNorms& norms, const char* mean) {
    const Eigen::Vector2d at = location(norms, on_sphere);
    json[word] = {{mean, norms.l2}, {"max", norms.max}, {"cell", norms.cell}};
    if (norms.cell >= 0)
      json[word]["at"] = {at[0], at[1]};
  };
  for (const OperatorName& name : operator_names)
    add(name.word, errors.*name.norms, "l2");
  for (const DistanceName& name : distance_names)
    add(name.word, errors.*name.norms, "rms");
  json["primal_eigenvalue"] = errors.primal_eigenvalue;
  json["dual_eigenvalue"] = errors.dual_eigenvalue; // null if infinite
  json["wave_step_times_speed"] = wave_step(errors, 1);
  json["divergence_step_times_viscosity"] = diffusion_step(errors.primal_eigenvalue, 1);
  json["vorticity_step_times_viscosity"] = diffusion_step(errors.dual_eigenvalue, 1);
  return json;
}

} // namespace calotte::tools
