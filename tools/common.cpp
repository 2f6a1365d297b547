// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"

#include "options/format_options.h"

#include <calotte/error.h>
#include <calotte/io.h>

#include <boost/crc.hpp>

#include <array>
#include <cerrno>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <string_view>
#include <system_error>

#include <unistd.h>

namespace calotte::tools {

void finish(ExitCode code) { throw CLI::RuntimeError(code); }

void require_folder(const std::string& path) {
  const std::filesystem::path parent = std::filesystem::path(path).parent_path();
  const std::string folder = parent.empty() ? "." : parent.string();
  if (std::error_code error; std::filesystem::is_directory(path, error))
    throw Error(ErrorCode::file,
                "cannot write " + path + ": it is a folder; give the name of a file");
  if (std::error_code error; !std::filesystem::is_directory(folder, error))
    throw Error(ErrorCode::file, "cannot write " + path + ": the folder " + folder +
                                     " does not exist; create it first");
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    throw Error(ErrorCode::file, "cannot write " + path + ": the folder " + folder + ": " +
                                     std::generic_category().message(errno) + "; write elsewhere");
}

void require_distinct(const std::string& output, const std::string& input) {
  std::error_code absent;
  if (input != "-" && std::filesystem::equivalent(output, input, absent))
    throw Error(ErrorCode::bad_option, output + " is both input and output; give the output "
                                                "another name");
}

void require_outputs(const std::vector<Output>& outputs, const std::vector<std::string>& inputs) {
  const auto place = [](const Output& output) {
    return std::filesystem::path(output.path).lexically_normal();
  };
  for (auto output = outputs.begin(); output != outputs.end(); ++output) {
    if (output->path.empty())
      continue;
    require_folder(output->path);
    for (const std::string& input : inputs)
      require_distinct(output->path, input);
    for (auto other = outputs.begin(); other != output; ++other)
      if (place(*other) == place(*output))
        throw Error(ErrorCode::bad_option, output->path + " is both " + other->what + " and " +
                                               output->what + "; give the " + output->what +
                                               " another name");
  }
}

std::string checksum_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  boost::crc_32_type checksum;
  std::int64_t size = 0;
  std::array<char, 1 << 16> bytes;
  while (in.read(bytes.data(), bytes.size()) || in.gcount() > 0) {
    checksum.process_bytes(bytes.data(), static_cast<std::size_t>(in.gcount()));
    size += in.gcount();
  }
  if (in.bad() || !in.eof())
    throw Error(ErrorCode::file, "cannot read " + path + ": " +
                                     std::generic_category().message(errno) +
                                     "; check its name and its permissions");
  return std::to_string(size) + " bytes with checksum " + std::to_string(checksum.checksum());
}

std::string shortest(double value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

CLI::Validator whole_number(std::uint64_t least, std::uint64_t most) {
  const std::string range = most == std::numeric_limits<int>::max()
                                ? std::to_string(least) + " or more"
                                : "from " + std::to_string(least) + " to " + std::to_string(most);
  return {[=](std::string& text) -> std::string {
            std::uint64_t value = 0;
            const char* const end = text.data() + text.size();
            const auto [stop, problem] = std::from_chars(text.data(), end, value);
            if (problem != std::errc() || stop != end || value < least || value > most)
              return "\"" + text + "\" is not a whole number " + range;
            text = std::to_string(value); // CLI11 takes leading zeros for octal
            return "";
          },
          "N"};
}

Points3 points_from(const std::string& path, Columns columns, std::vector<std::int64_t>* lines) {
  return path == "-" ? read_points(std::cin, "standard input", columns, lines)
                     : read_points(path, columns, lines);
}

PointFile read_point_file(const std::string& path, bool lonlat) {
  if (holds_points(path)) {
    if (lonlat)
      throw Error(ErrorCode::bad_option,
                  path + ": a mesh's points are x y z; leave --lonlat out, or give text");
    return {path, read_sites(path), {}};
  }
  PointFile file;
  file.name = path == "-" ? "standard input" : path;
  file.points = points_from(path, lonlat ? Columns::lonlat : Columns::xyz, &file.lines);
  return file;
}

PlanarPointFile read_planar_point_file(const std::string& path) {
  PlanarPointFile file;
  file.name = path == "-" ? "standard input" : path;
  file.points = path == "-" ? read_planar_points(std::cin, file.name, &file.lines)
                            : read_planar_points(path, &file.lines);
  return file;
}

void rethrow_with_line(const Error& error, const std::string& name,
                       const std::vector<std::int64_t>& lines) {
  const bool of_input = error.code() == ErrorCode::not_finite ||
                        error.code() == ErrorCode::zero_vector ||
                        error.code() == ErrorCode::duplicate ||
                        // outside of a domain; other options' indices are of other things
                        (error.code() == ErrorCode::bad_option &&
                         std::string_view(error.what()).starts_with("point "));
  if (!of_input || error.index() < 0 || error.index() >= static_cast<std::int64_t>(lines.size()))
    throw error;
  const std::int64_t line = lines[static_cast<std::size_t>(error.index())];
  throw Error(error.code(), name + " line " + std::to_string(line) + ": " + error.what(), line);
}

std::shared_ptr<MeshSource> add_mesh_source(CLI::App& command, const std::string& names) {
  auto source = std::make_shared<MeshSource>();
  command
      .add_option(names, source->path,
                  "the mesh: " + std::string(mesh_suffixes) +
                      ", SaveVertices (MPI-SCVT), or .txt and .tri with --points")
      ->type_name("FILE")
      ->required();
  command.add_option("--points", source->points, "the points that a .txt or .tri file refers to")
      ->type_name("FILE");
  command.add_flag("--lonlat", source->lonlat,
                   "these points are longitude and latitude in degrees");
  return source;
}

Mesh read_mesh(const MeshSource& source) {
  if (source.points.empty())
    return calotte::read_mesh(source.path);
  const Points3 points = read_point_file(source.points, source.lonlat).points;
  return calotte::read_mesh(source.path, &points);
}

CLI::Option* add_plane(CLI::App& command, MeshSource& source) {
  return command
      .add_flag("--plane", source.plane,
                "the mesh is one of the plane: .vtp, .vtu, .off, .ply or .msh with z = 0, periodic "
                "MPAS, or .txt and .tri with --points, x y a line")
      ->excludes(command.get_option("--lonlat"));
}

PlanarMesh read_planar_mesh(const MeshSource& source) {
  if (source.points.empty())
    return calotte::read_planar_mesh(source.path);
  const Points2 points = read_planar_point_file(source.points).points;
  return calotte::read_planar_mesh(source.path, &points);
}

} // namespace calotte::tools
