// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/parallel.h"
#include "io/bytes/text.h"
#include "io/shapes/room.h"

#include <calotte/error.h>

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

namespace calotte::io_detail {

/// Whole lines, parsed by a task of their own.
///
/// A `Parser` has parse(reader, line, rows), has_points(), following() for the lines that follow,
/// and append() for what the parser of these has found, as RowParser has. `Rows` has clear().
template <class Parser, class Rows> struct TextPart {
  Parser parser;
  Rows rows{};
  std::int64_t before = 0; ///< number of lines of the text before them
  std::int64_t lines = 0;  ///< their number
  bool refused = false;

  /// \throws Error parse.
  void parse(LineReader reader) {
    for (std::string_view line; reader.next(line);)
      parser.parse(reader, line, rows);
    lines = reader.number();
  }
};

/// Parses whole lines, which follow those of the parser, in parallel. The parts before keep their
/// memory for the next lines.
/// \throws Error parse, of the first line that is refused.
template <class Parser, class Rows>
void parse_parts(LineReader& reader, std::string_view text, Parser& parser,
                 std::vector<TextPart<Parser, Rows>>& parts) {
  constexpr std::size_t part_bytes = std::size_t{1} << 18;
  const std::vector<std::string_view> texts = parts_of(text, part_bytes);
  parts.resize(texts.size(), TextPart<Parser, Rows>{parser});
  base_detail::for_each_task(std::ssize(texts), [&](std::int64_t i) {
    TextPart<Parser, Rows>& part = parts[static_cast<std::size_t>(i)];
    part.parser = parser.following();
    part.rows.clear();
    try {
      part.parse(LineReader(texts[static_cast<std::size_t>(i)], reader.name()));
    } catch (const Error&) {
      part.refused = true; // its message would lack what the lines before decide
    }
  });
  for (std::size_t i = 0; i < texts.size(); ++i) {
    TextPart<Parser, Rows>& part = parts[i];
    if (part.refused) {
      part = {parser};
      part.parse(LineReader(texts[i], reader.name(), reader.number())); // throws
    }
    part.before = reader.number();
    parser.append(part.parser);
    reader.count_lines(part.lines);
  }
}

/// Parses all lines of a text: the first ones serially, up to the first row, all others in
/// parallel.
/// \param take(parts, reader) takes the rows of parts, in their order; `before` of each plus a
///        row's line is the line in the text.
/// \returns the parser after the last line.
/// \throws Error parse, of the first line that is refused; file.
template <class Rows, class Parser, class Take>
Parser parse_text(LineReader& reader, Parser parser, const Take& take) {
  constexpr std::size_t bytes_per_thread = std::size_t{1} << 20, most_bytes = std::size_t{8} << 20;
  std::vector<TextPart<Parser, Rows>> parts{TextPart<Parser, Rows>{parser}};
  for (std::string_view line; !parser.has_points() && reader.next(line);)
    parser.parse(reader, line, parts[0].rows);
  const std::size_t bytes = std::min(
      most_bytes, bytes_per_thread * static_cast<std::size_t>(base_detail::thread_count()));
  while (true) {
    take(parts, reader);
    const std::string_view text = reader.take_lines(bytes);
    if (text.empty())
      return parser;
    parse_parts(reader, text, parser, parts);
  }
}

} // namespace calotte::io_detail
