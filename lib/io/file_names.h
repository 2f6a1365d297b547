// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/room.h"

#include <calotte/io.h>

#include <optional>
#include <string>
#include <string_view>

/// What the names of files say.
namespace calotte::io_detail {

// MPI-SCVT's names; what follows them, as in RegionList.12, is common to files that go together.
inline constexpr std::string_view vertices_name = "SaveVertices";
inline constexpr std::string_view triangles_name = "SaveTriangles";
inline constexpr std::string_view density_name = "SaveDensity";
inline constexpr std::string_view centres_name = "RegionList";
inline constexpr std::string_view centre_triangles_name = "RegionTriangulation";

/// ".nc" of NAME.NC: in lower case, or nothing.
std::string suffix_of(const std::string& path);

bool is_netcdf(Format format);

/// The format of a mesh file's name, if it says one.
std::optional<Format> format_of_name(const std::string& path);

/// The path with the name's start, `stem`, changed to `other`; nothing where it does not start so.
std::optional<std::string> sibling(const std::string& path, std::string_view stem,
                                   std::string_view other);

/// \throws Error bad_option, always: names that say a format.
[[noreturn]] void refuse_name(const std::string& path);

} // namespace calotte::io_detail
