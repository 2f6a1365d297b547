// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "support/encodings.h"

#include <calotte/mesh.h>

#include <cmath>

/// Polygons for the tests of files.
namespace calotte::test {

/// Faces as the corners of each, one after the other.
struct Faces {
  Points3 points;
  Values ids, ends; ///< the end of each face among the ids

  void add(const Values& corners) {
    ids.insert(ids.end(), corners.begin(), corners.end());
    ends.push_back(static_cast<double>(ids.size()));
  }
  /// As files that give each face after the number of its corners have it.
  Values lists() const {
    Values lists;
    std::size_t k = 0;
    for (const double end : ends) {
      lists.push_back(end - static_cast<double>(k));
      for (; k < static_cast<std::size_t>(end); ++k)
        lists.push_back(ids[k]);
    }
    return lists;
  }
  /// VTK's types: triangle, quad, polygon.
  Values types() const {
    Values types;
    double begin = 0;
    for (const double end : ends) {
      types.push_back(end - begin == 3 ? 5 : end - begin == 4 ? 9 : 7);
      begin = end;
    }
    return types;
  }
};

inline Faces faces_of(const Mesh& mesh) {
  Faces faces{mesh.points, {}, {}};
  for (const auto& triangle : mesh.triangles.colwise())
    faces.add({double(triangle[0]), double(triangle[1]), double(triangle[2])});
  return faces;
}

/// A pentagonal prism: polygons of 4 and of 5 corners, counter-clockwise seen from outside. Its
/// corners do not have norm 1.
inline Faces prism() {
  Faces faces{Points3(3, 10), {}, {}};
  for (int k = 0; k < 5; ++k) {
    const double angle = 2 * 3.14159265358979323846 * k / 5;
    faces.points.col(k) << 2 * std::cos(angle), 2 * std::sin(angle), 1;
    faces.points.col(5 + k) << 2 * std::cos(angle), 2 * std::sin(angle), -1;
  }
  faces.add({0, 1, 2, 3, 4});
  for (int k = 0; k < 5; ++k)
    faces.add({double(k), 5.0 + k, 5.0 + (k + 1) % 5, double((k + 1) % 5)});
  faces.add({9, 8, 7, 6, 5});
  return faces;
}

} // namespace calotte::test
