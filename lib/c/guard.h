// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/require.h"
#include "c/room.h"

#include <calotte/c.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <functional>
#include <string>
#include <string_view>

namespace calotte::c_detail {

using base_detail::message;
using base_detail::require;

/// The threads of later work of the calling thread; 0 for all cores.
void set_threads(int count);

/// Does the work in these threads. Converts exceptions to a code and *error.
/// \param error null, or provided by the caller. If there is no memory for a message, nothing is
///        done, and the code is CALOTTE_INVALID_ARGUMENT.
calotte_status guarded(calotte_error* error, const std::function<void()>& work);

/// The remedy for a struct of a caller that was not initialised.
/// \param name of its type.
inline std::string initialise(const std::string& name) {
  return message("initialise the {} with {}_init()",
                 std::string_view(name).substr(std::string_view("calotte_").size()), name);
}

/// The size of a struct of a caller.
/// \param name of its type.
/// \throws Error invalid_argument for a null pointer and for a size that no struct of this type
/// has.
template <class Struct> std::size_t size_of(const Struct* given, const std::string& name) {
  constexpr std::size_t most = 1 << 16; // a member that was never set
  require(given != nullptr, "the pointer to a {} is null; give the address of one", name);
  require(given->size >= sizeof given->size && given->size <= most, "the size of the {} is {}; {}",
          name, given->size, initialise(name));
  return given->size;
}

/// A struct of a caller, with all members that the library knows.
/// \param usual has the members that the struct of the caller lacks. Default: 0.
/// \throws Error invalid_argument as size_of(), and for other members that are not 0.
template <class Struct>
Struct known_part(const Struct* given, const std::string& name, const Struct& usual = {}) {
  const std::size_t size = size_of(given, name);
  Struct known = usual;
  std::memcpy(&known, given, std::min(size, sizeof known));
  const auto* bytes = reinterpret_cast<const unsigned char*>(given);
  require(std::all_of(bytes + std::min(size, sizeof known), bytes + size,
                      [](unsigned char byte) { return byte == 0; }),
          "the {} has members beyond the {} bytes that this library knows, and they are not 0; "
          "leave them 0, or use a newer library",
          name, sizeof known);
  return known;
}

/// Sets the members that the struct of a caller has. \throws Error invalid_argument as size_of().
template <class Struct> void fill(Struct* out, Struct values, const std::string& name) {
  values.size = size_of(out, name);
  std::memcpy(out, &values, std::min(values.size, sizeof values));
}

} // namespace calotte::c_detail
