// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>
#include <calotte/matrices.h>

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>

CALOTTE_API_BEGIN
namespace calotte {

/// Offsets of lists that are stored one after another.
using Offsets = Eigen::Matrix<std::int64_t, Eigen::Dynamic, 1, Eigen::DontAlign>;

/// n lists in one array, such as the edges of each cell: list i is items[begin[i]] to
/// items[begin[i + 1] - 1].
/// \tparam Items, Begin arrays with data(): vectors of Eigen or of the standard library.
template <class Items, class Begin = Offsets> struct Lists {
  Begin begin = {}; ///< n + 1, ascending from 0; none if there are no lists
  Items items = {}; ///< begin[n] in all

  /// The number of lists.
  std::int64_t size() const { return std::ssize(begin) > 0 ? std::ssize(begin) - 1 : 0; }
  /// The number of items of list i.
  std::int64_t count(std::int64_t i) const { return begin.data()[i + 1] - begin.data()[i]; }
  /// The items of list i.
  auto operator[](std::int64_t i) const {
    return std::span(items.data() + begin.data()[i], length(i));
  }
  /// The same, to be set.
  auto operator[](std::int64_t i) { return std::span(items.data() + begin.data()[i], length(i)); }

private:
  std::size_t length(std::int64_t i) const { return static_cast<std::size_t>(count(i)); }
};

/// Lists of ids.
using IdLists = Lists<Ids>;

} // namespace calotte
CALOTTE_API_END
