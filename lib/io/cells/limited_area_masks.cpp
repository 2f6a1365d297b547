// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cells/limited_area_masks.h"

#include <algorithm>

namespace calotte::io_detail {

std::optional<Ids> cell_mask_among(const std::vector<MeshField>& fields) {
  const auto at = std::ranges::find_if(fields, [](const MeshField& field) {
    return field.name == cell_mask && field.location == Location::cells && field.integer &&
           field.count() == 1 && !field.values.hasNaN();
  });
  return at == fields.end() ? std::nullopt : std::optional<Ids>(at->values.cast<std::int32_t>());
}

bool is_derived_mask(const std::string& name, const std::vector<MeshField>& fields) {
  return (name == edge_mask.name || name == vertex_mask.name) && cell_mask_among(fields);
}

} // namespace calotte::io_detail
