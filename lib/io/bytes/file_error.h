// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/bytes/room.h"

#include <calotte/error.h>

#include <cstdint>
#include <string>

/// Errors whose message starts with the name of a file.
namespace calotte::io_detail {

/// The end of messages about a file that its writer has not completed.
inline const std::string damaged = "; the file is damaged or incomplete, make it again";

/// \throws Error parse: what is wrong with the contents of a file.
[[noreturn]] inline void fail_file(const std::string& name, const std::string& problem,
                                   std::int64_t index = -1) {
  throw Error(ErrorCode::parse, name + ": " + problem, index);
}

/// \throws Error file: why a file cannot be read.
[[noreturn]] inline void fail_read(const std::string& path, const std::string& why) {
  throw Error(ErrorCode::file, "cannot read " + path + ": " + why);
}

/// \throws Error invalid_argument: what a file of that path cannot hold.
[[noreturn]] inline void refuse_path(const std::string& path, const std::string& problem) {
  throw Error(ErrorCode::invalid_argument, path + ": " + problem);
}

/// Calls a function whose errors are those of a file.
template <class Call> auto named(const std::string& name, const Call& call) -> decltype(call()) {
  try {
    return call();
  } catch (const Error& error) {
    throw Error(error.code(), name + ": " + error.what(), error.index());
  }
}

} // namespace calotte::io_detail
