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

/// The storage of the numbers of an array in XML files of VTK: as text, in base64, or after the
/// XML; after a header of lengths; compressed or not.
namespace calotte::io_detail {

/// The storage of all arrays, according to the first elements of the file.
struct VtkStorage {
  std::string name; ///< of the file, for messages
  bool swapped = false;
  Scalar length_type = Scalar::uint32;                     ///< type of the lengths before a block
  bool compressed = false;                                 ///< by zlib
  std::optional<std::string_view> appended = std::nullopt; ///< bytes that offsets refer to
  bool appended_base64 = false;
};

/// The type of the numbers of an array; none for strings and bits.
std::optional<Scalar> vtk_type(const std::string& name);

/// Allocates memory for `count` numbers.
template <class T> using Room = std::function<T*(std::int64_t count)>;

/// Reads the numbers of an array (T: double, std::int32_t or std::int64_t), converted as in
/// number_as().
/// \param count required number; -1 for any number.
/// \param room called once, when it is known that the file has that many.
/// \throws Error parse. The memory is proportional to the size of the file.
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
