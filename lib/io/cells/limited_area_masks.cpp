// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cells/limited_area_masks.h"

#include "base/message.h"
#include "base/parallel.h"

#include <algorithm>
#include <limits>

namespace calotte::io_detail {
namespace {

bool is_cell_mask(const MeshField& field) {
  return field.name == cell_mask && field.location == FieldLocation::cells && field.integer &&
         field.count() == 1;
}

} // namespace

std::string cell_mask_meaning(int rings) {
  return rings == 0 ? "0 in the region"
                    : message("0 in the region, 1 to {} in the rings of boundary cells", rings);
}

std::vector<std::uint8_t> flag_points(const Points3& points,
                                      const std::function<bool(const Eigen::Vector3d&)>& inside) {
  std::vector<std::uint8_t> flags(static_cast<std::size_t>(points.cols()));
  for_each_block(points.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i)
      flags[static_cast<std::size_t>(i)] = inside(points.col(i)) ? 1 : 0;
  });
  return flags;
}

std::optional<Ids> cell_mask_among(const std::vector<MeshField>& fields, std::int64_t cells) {
  constexpr double most = std::numeric_limits<std::int32_t>::max();
  const auto at = std::ranges::find_if(fields, is_cell_mask);
  if (at == fields.end() || at->values.size() != cells || !(at->values.array().abs() <= most).all())
    return std::nullopt;
  return at->values.cast<std::int32_t>();
}

bool is_derived_mask(const std::string& name, const std::vector<MeshField>& fields) {
  return (name == edge_mask.name || name == vertex_mask.name) &&
         std::ranges::any_of(fields, is_cell_mask);
}

} // namespace calotte::io_detail
