// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cells/cell_maps.h"

#include "io/command.h"

#include <filesystem>

namespace calotte {
namespace io_detail {
namespace {

/// A line for each of so many ids.
void put_lines(std::int64_t count, const CellMaps::Id& id, OutputFile& file) {
  constexpr std::size_t enough = 1 << 20;
  std::string text;
  for (std::int64_t i = 0; i < count; ++i) {
    text += std::to_string(id(i));
    text += '\n';
    if (text.size() > enough || i + 1 == count) {
      file.append(text);
      text.clear();
    }
  }
}

} // namespace

CellMaps::CellMaps(const std::string& folder, std::int64_t old_cells, const Id& new_of_old,
                   std::int64_t new_cells, const Id& old_of_new) {
  const auto write = [&](const std::string& path, std::int64_t count, const Id& id) {
    files_.push_back(std::make_unique<OutputFile>(path));
    put_lines(count, id, *files_.back());
    files_.back()->finish();
  };
  const CellMapPaths paths = cell_map_paths(folder);
  write(paths.forward, old_cells, new_of_old);
  write(paths.backward, new_cells, old_of_new);
}

void CellMaps::commit() {
  for (const std::unique_ptr<OutputFile>& file : files_)
    file->commit();
}

} // namespace io_detail

CellMapPaths cell_map_paths(const std::string& folder) {
  if (folder.empty())
    return {};
  const std::filesystem::path in = folder;
  return {(in / "cellMapForward.txt").string(), (in / "cellMapBackward.txt").string()};
}

void write_cell_maps(const std::string& folder, const Ids& new_of_old, const Ids& old_of_new) {
  io_detail::CellMaps maps(
      folder, new_of_old.size(), [&](std::int64_t i) { return new_of_old[i]; }, old_of_new.size(),
      [&](std::int64_t i) { return old_of_new[i]; });
  maps.commit();
}

} // namespace calotte
