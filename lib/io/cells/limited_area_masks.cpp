// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cells/limited_area_masks.h"

#include <algorithm>
#include <limits>

namespace calotte::io_detail {
namespace {

bool is_cell_mask(const MeshField& field) {
  return field.name == cell_mask && field.location == Location::cells && field.integer &&
         field.count() == 1;
}

} // namespace

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
