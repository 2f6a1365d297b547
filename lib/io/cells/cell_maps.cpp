// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/file.h"
#include "io/cells/room.h"
#include "io/command.h"

#include <filesystem>

namespace calotte {
namespace {

/// Writes each id on a line.
void put_lines(const Ids& ids, io_detail::OutputFile& file) {
  constexpr std::size_t enough = 1 << 20;
  std::string text;
  for (const std::int32_t id : ids) {
    text += std::to_string(id);
    text += '\n';
    if (text.size() > enough) {
      file.append(text);
      text.clear();
    }
  }
  file.append(text);
  file.finish();
}

} // namespace

CellMapPaths cell_map_paths(const std::string& folder) {
  if (folder.empty())
    return {};
  const std::filesystem::path in = folder;
  return {(in / "cellMapForward.txt").string(), (in / "cellMapBackward.txt").string()};
}

struct CellMapFiles::Files {
  io_detail::OutputFile forward, backward;

  explicit Files(const CellMapPaths& paths) : forward(paths.forward), backward(paths.backward) {}
};

CellMapFiles::CellMapFiles(const CellMapPaths& paths, const Ids& new_of_old, const Ids& old_of_new)
    : files_(std::make_unique<Files>(paths)) {
  put_lines(new_of_old, files_->forward);
  put_lines(old_of_new, files_->backward);
}

CellMapFiles::~CellMapFiles() = default;

void CellMapFiles::commit() {
  files_->forward.commit();
  files_->backward.commit();
}

} // namespace calotte
