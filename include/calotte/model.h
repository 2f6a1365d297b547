// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>
#include <calotte/mesh_field.h>
#include <calotte/write.h>

#include <string>
#include <string_view>
#include <vector>

/// The models that read files of this library, and what they expect.
CALOTTE_API_BEGIN
namespace calotte {

/// A model, and the options of write() that suit it.
struct Model {
  std::string word;         ///< such as "mpas-ocean"
  std::string name;         ///< such as "MPAS-Ocean"
  Format format;            ///< of its files
  double sphere_radius = 1; ///< of its files
  /// Whether it takes lengths as they are, in metres, so that other radii of a planet suit it, too.
  bool any_planet = false;
  Numbering numbering = Numbering::by_format;          ///< of the cells
  VertexOrder vertex_order = VertexOrder::after_edges; ///< of MPAS files
  std::vector<FieldDimension> dimensions = {};         ///< besides those of the mesh
};

/// All models:
///
/// - MPAS-Atmosphere: the unit sphere. Its initialisation multiplies lengths by the radius of the
///   Earth (mpas_init_atm_static.F), whatever their unit. Its deformation weights take edge k of a
///   cell between vertices k and k + 1 (mpas_atm_advection.F).
/// - MPAS-Ocean: metres, which it takes as they are. 6371220 m is SHR_CONST_REARTH of E3SM, with
///   which MPAS-Tools makes its meshes.
/// - MPAS' shallow-water core: the unit sphere (mpas_sw_test_cases.F), and the dimensions
///   nVertLevels and nTracers, which it reads from the file.
/// - FESOM: the triangles, nod2d.out and elem2d.out.
const std::vector<Model>& models();

/// The model of that word; null if there is none.
const Model* find_model(std::string_view word);

/// Whether a model reads a file of a mesh of the sphere that write() makes with these options.
/// \param format not by_name.
bool suits(const Model& model, Format format, double sphere_radius, VertexOrder vertex_order,
           const std::vector<FieldDimension>& dimensions = {});

} // namespace calotte
CALOTTE_API_END
