// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/file_error.h"
#include "io/command.h"
#include "io/toml.h"

#include <calotte/error.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <system_error>

namespace calotte {
namespace {

/// Finds dotted keys of too many parts, such as a.b.c...: toml++ recurses once for each part. In
/// files of options two parts suffice.
class KeyParts {
public:
  static constexpr int most = 32;

  /// Whether a key of the text has more parts.
  static bool exceeded(std::string_view text) {
    int parts = 1;
    for (std::size_t k = 0; k < text.size(); ++k)
      switch (text[k]) {
      case '"':
      case '\'':
        k = end_of_text(text, k) - 1;
        break;
      case '#':
        k = std::min(text.find('\n', k), text.size()) - 1;
        break;
      case '.':
        if (++parts > most)
          return true;
        break;
      case '\n':
      case '=':
      case ',':
      case '[':
      case ']':
      case '{':
      case '}':
        parts = 1;
        break;
      default:
        break;
      }
    return false;
  }

private:
  /// The offset behind the closing quote of the string that begins at `begin`.
  static std::size_t end_of_text(std::string_view text, std::size_t begin) {
    const char quote = text[begin];
    const std::string_view three = text.substr(begin, 3);
    const bool lines = three == std::string(3, quote);
    const std::string end(lines ? 3 : 1, quote);
    for (std::size_t k = begin + end.size(); k < text.size(); ++k)
      if (quote == '"' && text[k] == '\\')
        ++k;
      else if (text.substr(k).starts_with(end))
        return k + end.size();
      else if (!lines && text[k] == '\n') // the parser refuses it
        return k;
    return text.size();
  }
};

/// \throws Error parse for a text that would take much memory or stack.
std::string read_text(const std::string& path) {
  constexpr std::uintmax_t most = std::uintmax_t{1} << 20;
  std::error_code error;
  if (const std::uintmax_t size = std::filesystem::file_size(path, error); !error && size > most)
    io_detail::fail_file(path,
                         "{} bytes are too many for a file of options; give a TOML file of at most "
                         "1 MiB",
                         size);
  std::string text = read_file(path);
  if (KeyParts::exceeded(text))
    io_detail::fail_file(path, "a key of more than {} parts; write key = value", KeyParts::most);
  return text;
}

} // namespace

toml::table read_toml(const std::string& path) {
  try {
    return toml::parse(read_text(path), path);
  } catch (const toml::parse_error& error) {
    io_detail::fail_at(path, error.source().begin.line,
                       "{}; write key = value, with text in quotes", error.description());
  }
}

} // namespace calotte
