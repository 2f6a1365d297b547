// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/bytes/scalars.h"
#include "io/bytes/xml.h"
#include "io/formats/poly_data.h"
#include "io/formats/room.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

/// How VTK's XML files store the numbers of an array: as text, in base64, or after the XML; behind
/// a header of lengths; compressed or not.
namespace calotte::io_detail {

/// What the file's first elements say about all arrays.
struct VtkStorage {
  std::string name; ///< of the file, for messages
  bool swapped = false;
  Scalar length_type = Scalar::uint32;                     ///< of the lengths before a block
  bool compressed = false;                                 ///< by zlib
  std::optional<std::string_view> appended = std::nullopt; ///< the bytes that offsets refer to
  bool appended_base64 = false;
};

/// The type of an array's numbers; none for strings and bits.
std::optional<Scalar> vtk_type(const std::string& name);

/// Makes room for so many numbers.
template <class T> using Room = std::function<T*(std::int64_t count)>;

/// Reads the numbers of an array (T: double, std::int32_t or std::int64_t), converted as
/// number_as().
/// \param count how many there must be; -1 for any number.
/// \param room called once, when the file is known to have that many.
/// \throws Error parse. The memory is in proportion to the bytes that the file has.
template <class T>
void read_vtk_numbers(const VtkStorage& storage, const XmlElement& array, std::int64_t count,
                      const Room<T>& room);

extern template void read_vtk_numbers(const VtkStorage&, const XmlElement&, std::int64_t,
                                      const Room<double>&);
extern template void read_vtk_numbers(const VtkStorage&, const XmlElement&, std::int64_t,
                                      const Room<std::int32_t>&);
extern template void read_vtk_numbers(const VtkStorage&, const XmlElement&, std::int64_t,
                                      const Room<std::int64_t>&);

/// The same as a column.
template <class T>
Column<T> vtk_numbers(const VtkStorage& storage, const XmlElement& array, std::int64_t count) {
  Column<T> numbers;
  read_vtk_numbers<T>(storage, array, count, [&](std::int64_t size) {
    numbers.resize(size);
    return numbers.data();
  });
  return numbers;
}

} // namespace calotte::io_detail
