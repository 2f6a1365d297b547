// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/mpas/mpas_part.h"
#include "io/mpas/room.h"
#include "io/netcdf/netcdf_subset.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

/// MPAS files without some of their cells.
namespace calotte::io_detail {

/// The changes from a file to its part: ids are replaced by new ones, 0 for removed items, and
/// weights of removed edges are 0. The result refers to both arguments.
NetcdfSubset make_subset(const MpasSource& source, const MpasPart& part);

/// Number of values in a row of a variable, where the first dimension counts the rows.
std::int64_t row_width(const NetcdfReader& source, int variable);

/// Sets the attributes that describe the sphere: on the unit sphere the planet of a source that is
/// not on it, on others none besides the radius.
void set_sphere(const MpasSource& source, double radius, NetcdfSubset& subset);

/// Converts lengths, areas and all other values that depend on the radius of the sphere to another
/// radius.
void add_radius(const MpasSource& source, double radius, NetcdfSubset& subset);

/// Converts the order of the vertices around cells, if the source has another order.
void add_vertex_order(const MpasSource& source, const MpasPart& part, VertexOrder order,
                      NetcdfSubset& subset);

/// Adds the division of a variable of floats or doubles by a number.
/// \pre the file has the variable. \throws Error parse.
void add_division(const MpasSource& source, const std::string& variable, double divisor,
                  NetcdfSubset& subset);

/// Adds attributes that describe the origin of the file, before existing ones.
/// \param history of the new file; "" for none.
void add_history(const MpasSource& source, const MpasPart& part, const std::string& history,
                 NetcdfSubset& subset);

/// Writes the file and NAME.graph.info beside it. Both are complete or absent.
/// \param commit_others renames other files that are finished. It is called when these two are
///        finished, before they are renamed.
/// \returns the variables of the source that the file does not have.
/// \throws Error as put_subset(); cancelled.
std::vector<std::string> write_part(const MpasSource& source, const MpasPart& part,
                                    const NetcdfSubset& subset, const std::string& path,
                                    const ProgressCallback& progress,
                                    const std::function<void()>& commit_others = {});

} // namespace calotte::io_detail
