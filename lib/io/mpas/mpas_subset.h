// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/mpas/mpas_part.h"
#include "io/mpas/room.h"
#include "io/netcdf/netcdf_subset.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

/// MPAS files of which cells are left out.
namespace calotte::io_detail {

/// What becomes of the variables of a file that holds the part: ids are numbered anew, 0 for what
/// is left out, and weights of edges that are left out are 0. The result refers to both.
NetcdfSubset subset_of(const MpasSource& source, const MpasPart& part);

/// Values in a row of a variable whose rows are those of its first dimension.
std::int64_t width_of(const NetcdfReader& source, int variable);

/// Sets the attributes that say which sphere a file is of.
void set_sphere(double radius, NetcdfSubset& subset);

/// Adds what becomes of lengths, areas and what else depends on the radius of the sphere, if they
/// are to belong to another one.
void add_radius(const MpasSource& source, double radius, NetcdfSubset& subset);

/// Adds the turn of the vertices around cells to another order, if the source has another.
void add_vertex_order(const MpasSource& source, const MpasPart& part, VertexOrder order,
                      NetcdfSubset& subset);

/// Adds the division of a variable of floats or doubles by a number.
/// \pre the file has the variable. \throws Error parse.
void add_division(const MpasSource& source, const std::string& variable, double divisor,
                  NetcdfSubset& subset);

/// Adds attributes that say where the file comes from, before those that it has.
/// \param history of the new file; "" for none.
void add_history(const MpasSource& source, const MpasPart& part, const std::string& history,
                 NetcdfSubset& subset);

/// Writes the file and NAME.graph.info beside it; both are complete or absent.
/// \param commit_others gives other files, which are finished, their names. It is called when the
///        two are finished, before these get theirs.
/// \returns the variables of the source that it does not have.
/// \throws Error as put_subset(); cancelled.
std::vector<std::string> write_part(const MpasSource& source, const MpasPart& part,
                                    const NetcdfSubset& subset, const std::string& path,
                                    const ProgressCallback& progress,
                                    const std::function<void()>& commit_others = {});

} // namespace calotte::io_detail
