// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

/// Texts of GeoJSON, made here and not by the library.
namespace calotte::test {

/// \param rings joined by commas, each a list of positions in brackets.
inline std::string polygon(const std::string& rings) {
  return R"({"type":"Polygon","coordinates":[)" + rings + "]}";
}

inline std::string feature(const std::string& geometry, const std::string& properties = "{}") {
  return R"({"type":"Feature","properties":)" + properties + R"(,"geometry":)" + geometry + "}";
}

inline std::string collection(const std::vector<std::string>& features) {
  std::string text = R"({"type":"FeatureCollection","features":[)";
  for (std::size_t f = 0; f < features.size(); ++f)
    text += (f > 0 ? "," : "") + features[f];
  return text + "]}";
}

} // namespace calotte::test
