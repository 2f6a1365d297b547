// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/message.h"

#include <calotte/error.h>

#include <cstdint>
#include <string>
#include <type_traits>

namespace calotte::base_detail {

/// A mesh of n sites has up to 2n - 4 triangles, and their ids are int32.
constexpr std::int64_t most_points = std::int64_t{1} << 30;

/// \throws Error invalid_argument with the message, and with the index that it names.
[[noreturn]] inline void refuse(const std::string& message, std::int64_t index = -1) {
  throw Error(ErrorCode::invalid_argument, message, index);
}

/// \throws Error invalid_argument with the pattern's message, whose first {} is for the index.
template <class... Values>
[[noreturn]] void refuse_at(std::int64_t index,
                            std::type_identity_t<Pattern<std::int64_t, Values...>> pattern,
                            const Values&... values) {
  refuse(filled(pattern.text, {shown(index), shown(values)...}), index);
}

/// \throws Error invalid_argument with the message.
inline void require(bool holds, const std::string& message) {
  if (!holds)
    refuse(message);
}

/// \throws Error invalid_argument with the pattern's message, which is made then only.
template <class Value, class... Values>
void require(bool holds, std::type_identity_t<Pattern<Value, Values...>> pattern,
             const Value& value, const Values&... values) {
  if (!holds)
    refuse(filled(pattern.text, {shown(value), shown(values)...}));
}

/// \throws Error invalid_argument, when the count is below the least or above most_points.
inline void require_count(std::int64_t count, std::int64_t least, const std::string& name) {
  require(count >= least && count <= most_points, "{} is {}; give a number from {} to {}", name,
          count, least, most_points);
}

} // namespace calotte::base_detail
