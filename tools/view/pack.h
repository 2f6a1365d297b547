// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/mesh.h>

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <vector>

/// The arrays of a page of calotte view, compressed.
///
/// A block is a zlib stream of W bytes for each of N numbers in byte planes: the lowest bytes of
/// all numbers, then the next ones. It is stored in base64. Whole numbers are unsigned, or
/// differences to the number `delta` positions before, zigzag-coded (0, -1, 1, -2, ... as 0, 1, 2,
/// 3). Other numbers are of single precision with 15 bits of the mantissa, a relative error of at
/// most 2^-16; or, where single precision has not their range, the higher half of doubles.
namespace calotte::tools {

/// The blocks of a page.
class Blocks {
public:
  /// \returns the description of the new block for the page's header.
  nlohmann::ordered_json add(const std::vector<std::int32_t>& numbers, int delta);
  nlohmann::ordered_json add(const DoubleVector& numbers);

  const std::vector<std::string>& base64() const { return base64_; }

private:
  nlohmann::ordered_json add(const std::vector<std::uint32_t>& words, int width, const char* type,
                             int delta);

  std::vector<std::string> base64_;
};

} // namespace calotte::tools
