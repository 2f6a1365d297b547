// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/file_error.h"
#include "io/bytes/file_names.h"
#include "io/bytes/text.h"
#include "io/formats/format_table.h"

#include <algorithm>
#include <filesystem>

namespace calotte {
namespace io_detail {
namespace {

bool is_suffix(const std::string& name) { return name.starts_with('.'); }

/// The name of the files of a format that is selected by a name instead of a suffix; empty for
/// others.
std::string whole_name(const FormatInfo& info) {
  return info.names.empty() || is_suffix(info.names[0]) ? "" : info.names[0];
}

bool has_suffix(const FormatInfo& info, const std::string& suffix) {
  return std::find(info.names.begin(), info.names.end(), suffix) != info.names.end();
}

/// The format that a suffix alone selects: the first row with that suffix.
const FormatInfo* by_suffix(const std::string& suffix) {
  for (const FormatRow& row : format_table())
    if (has_suffix(row.info, suffix))
      return &row.info;
  return nullptr;
}

} // namespace

std::optional<Format> format_of_name(const std::string& path) {
  const std::string name = std::filesystem::path(path).filename();
  if (name == fesom_nodes_name)
    return Format::fesom;
  const FormatInfo* const known = by_suffix(suffix_of(path));
  // A name such as SaveVertices.vtp belongs to a file that was converted from SaveVertices.
  if (name.starts_with(vertices_name) && (known == nullptr || has_suffix(*known, ".txt")))
    return Format::mpi_scvt;
  return known == nullptr ? std::nullopt : std::optional(known->format);
}

void refuse_name(const std::string& path) {
  std::vector<std::string> suffixes, names;
  for (const FormatRow& row : format_table())
    for (const std::string& name : row.info.names)
      if (!is_suffix(name))
        names.push_back(name);
      else if (by_suffix(name) == &row.info)
        suffixes.push_back(name + (row.info.word.empty() ? " (read only)" : ""));
  const std::string suffix = suffix_of(path);
  refuse_path(path, "{}; a mesh file ends in {}, or is named {}",
              suffix.empty() ? "no suffix" : "unknown suffix " + in_quotes(suffix),
              listed(suffixes, " or "), listed(names, " or "));
}

} // namespace io_detail

using namespace io_detail;

const std::vector<FormatInfo>& formats() {
  static const std::vector<FormatInfo> all = [] {
    std::vector<FormatInfo> infos;
    for (const FormatRow& row : format_table())
      infos.push_back(row.info);
    return infos;
  }();
  return all;
}

const FormatInfo& info_of(Format format) { return find_row(format).info; }

Format format_of(const std::string& path, Format option) {
  const std::optional<Format> named = format_of_name(path);
  const Format format = option == Format::by_name ? named.value_or(option) : option;
  if (format == Format::by_name)
    refuse_name(path);
  const FormatInfo& info = info_of(format);
  if (info.word.empty() || (named && info_of(*named).word.empty()))
    refuse_path(path, "{} files are read, but not written; write .vtp, .vtu or .nc",
                info_of(info.word.empty() ? format : *named).title);
  if (const std::string name = whole_name(info); !name.empty() && named != format)
    refuse_path(path, "files of that format are named {}{}", name,
                format == Format::fesom ? "; give that name" : " and so on; give such a name");
  if (named && named != format &&
      (!whole_name(info_of(*named)).empty() || !has_suffix(info, suffix_of(path))))
    refuse_path(path,
                "its name belongs to another format than the selected one; change one of them");
  return format;
}

} // namespace calotte
