// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/message.h"
#include "io/bytes/room.h"

#include <calotte/error.h>

#include <cstdint>
#include <string>
#include <system_error>
#include <type_traits>

/// Errors whose message starts with the name of a file. What follows is a text, or a pattern with a
/// {} for each value, as in message(): fail_file(path, "{} values for {} cells", values, cells).
namespace calotte::io_detail {

/// The end of messages about a file that its writer has not completed.
inline const std::string damaged = "; the file is damaged or incomplete, make it again";

/// \throws Error parse: what is wrong with the contents of a file.
[[noreturn]] inline void fail_file(const std::string& name, const std::string& problem) {
  throw Error(ErrorCode::parse, name + ": " + problem);
}
template <class Value, class... Values>
[[noreturn]] void fail_file(const std::string& name,
                            std::type_identity_t<Pattern<Value, Values...>> pattern,
                            const Value& value, const Values&... values) {
  fail_file(name, message(pattern, value, values...));
}

/// The same, with the index that the message names.
[[noreturn]] inline void fail_file(const std::string& name, std::int64_t index,
                                   const std::string& problem) {
  throw Error(ErrorCode::parse, name + ": " + problem, index);
}
template <class Value, class... Values>
[[noreturn]] void fail_file(const std::string& name, std::int64_t index,
                            std::type_identity_t<Pattern<Value, Values...>> pattern,
                            const Value& value, const Values&... values) {
  fail_file(name, index, message(pattern, value, values...));
}

/// \throws Error parse: what is wrong with a line of a file, "PATH line LINE: problem".
[[noreturn]] inline void fail_at(const std::string& path, std::int64_t line,
                                 const std::string& problem) {
  throw Error(ErrorCode::parse, message("{} line {}: {}", path, line, problem), line);
}
template <class Value, class... Values>
[[noreturn]] void fail_at(const std::string& path, std::int64_t line,
                          std::type_identity_t<Pattern<Value, Values...>> pattern,
                          const Value& value, const Values&... values) {
  fail_at(path, line, message(pattern, value, values...));
}

/// fail_file() for a file that its writer has not completed.
template <class... Values>
[[noreturn]] void fail_damaged(const std::string& name,
                               std::type_identity_t<Pattern<Values...>> pattern,
                               const Values&... values) {
  fail_file(name, message(pattern, values...) + damaged);
}

/// \throws Error file: why a file cannot be read.
[[noreturn]] inline void fail_read(const std::string& path, const std::string& why) {
  throw Error(ErrorCode::file, "cannot read " + path + ": " + why);
}

/// \throws Error file: the system's error while an open file is read.
[[noreturn]] inline void fail_disk(const std::string& path, int error) {
  fail_read(path, std::generic_category().message(error) + "; check the disk");
}

/// \throws Error file: why a file cannot be written.
[[noreturn]] inline void fail_write(const std::string& path, const std::string& why) {
  throw Error(ErrorCode::file, "cannot write " + path + ": " + why);
}

/// \throws Error invalid_argument: what a file with that path cannot contain.
[[noreturn]] inline void refuse_path(const std::string& path, const std::string& problem) {
  throw Error(ErrorCode::invalid_argument, path + ": " + problem);
}
template <class Value, class... Values>
[[noreturn]] void refuse_path(const std::string& path,
                              std::type_identity_t<Pattern<Value, Values...>> pattern,
                              const Value& value, const Values&... values) {
  refuse_path(path, message(pattern, value, values...));
}

/// Calls a function. Prefixes the messages of its errors with a file's name.
template <class Call> auto named(const std::string& name, const Call& call) -> decltype(call()) {
  try {
    return call();
  } catch (const Error& error) {
    throw Error(error.code(), name + ": " + error.what(), error.index());
  }
}

} // namespace calotte::io_detail
