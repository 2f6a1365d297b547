// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cells/field_index.h"

#include "base/message.h"
#include "base/require.h"
#include "io/bytes/text.h"

#include <algorithm>
#include <utility>

namespace calotte {
namespace io_detail {
namespace {

using base_detail::message, base_detail::refuse, base_detail::require;

/// The dimension that a choice belongs to; the end of the dimensions for none.
std::size_t find_dimension(const std::vector<FieldDimension>& dimensions,
                           const FieldIndex& choice) {
  const std::string name = lower(choice.dimension);
  std::vector<std::size_t> found;
  for (std::size_t d = 0; d < dimensions.size(); ++d) {
    const std::string known = lower(dimensions[d].name);
    if (known == name)
      return d;
    if (!name.empty() && known.find(name) != std::string::npos)
      found.push_back(d);
  }
  require(found.size() <= 1, "{} is a part of several names of dimensions: {}; give one of these",
          choice.dimension, in_words(dimensions));
  return found.empty() ? dimensions.size() : found.front();
}

std::int64_t index_in(const FieldDimension& dimension, const FieldIndex& choice) {
  const std::int64_t index = choice.index < 0 ? dimension.size + choice.index : choice.index;
  if (index < 0 || index >= dimension.size)
    refuse(message("{}={} is out of range: {} has the indices 0 to {}; give one of these, or -1 "
                   "for the last",
                   choice.dimension, choice.index, dimension.name, dimension.size - 1));
  return index;
}

/// Refuses choices that belong to no dimension of a field.
void require_dimensions(const std::string& name, const std::vector<FieldDimension>& dimensions,
                        const std::vector<FieldIndex>& choices) {
  for (const FieldIndex& choice : choices)
    if (!belongs(choice, dimensions))
      refuse(message("{} has no dimension {}; {}", name, choice.dimension,
                     dimensions.empty() ? "it has one number for each cell: leave it out"
                                        : "it has " + in_words(dimensions)));
}

} // namespace

std::string in_words(const std::vector<FieldDimension>& dimensions) {
  std::string text;
  for (const FieldDimension& dimension : dimensions)
    text += message("{}{} ({})", text.empty() ? "" : ", ", dimension.name, dimension.size);
  return text;
}

bool belongs(const FieldIndex& choice, const std::vector<FieldDimension>& dimensions) {
  return find_dimension(dimensions, choice) < dimensions.size();
}

MeshField field_at_indices(MeshField field,
                           const std::vector<std::optional<std::int64_t>>& indices) {
  for (std::size_t d = indices.size(); d-- > 0;) {
    if (!indices[d])
      continue;
    const FieldDimension dimension = field.dimensions[d];
    std::int64_t finer = 1;
    for (std::size_t k = d + 1; k < field.dimensions.size(); ++k)
      finer *= field.dimensions[k].size;
    DoubleVector values(field.values.size() / dimension.size);
    for (Eigen::Index row = 0; row < values.size() / finer; ++row)
      values.segment(row * finer, finer) =
          field.values.segment((row * dimension.size + *indices[d]) * finer, finer);
    field.values = std::move(values);
    field.dimensions.erase(field.dimensions.begin() + static_cast<std::ptrdiff_t>(d));
    field.leading -= static_cast<int>(d) < field.leading ? 1 : 0;
  }
  return field;
}

} // namespace io_detail

std::vector<std::optional<std::int64_t>> find_indices(const std::vector<FieldDimension>& dimensions,
                                                      const std::vector<FieldIndex>& choices) {
  using namespace io_detail;
  std::vector<std::optional<std::int64_t>> indices(dimensions.size());
  for (const FieldIndex& choice : choices)
    if (const std::size_t d = find_dimension(dimensions, choice); d < dimensions.size()) {
      require(!indices[d], "there are two indices of the dimension {}; give one",
              dimensions[d].name);
      indices[d] = index_in(dimensions[d], choice);
    }
  return indices;
}

std::vector<std::int64_t> find_all_indices(const std::string& name,
                                           const std::vector<FieldDimension>& dimensions,
                                           const std::vector<FieldIndex>& choices) {
  using namespace io_detail;
  require_dimensions(name, dimensions, choices);
  const auto found = find_indices(dimensions, choices);
  std::vector<std::int64_t> indices;
  std::string lacking; // "Time=0,nVertLevels=0"
  for (std::size_t d = 0; d < found.size(); ++d) {
    indices.push_back(found[d].value_or(0));
    if (!found[d] && dimensions[d].size > 1)
      lacking += message("{}{}=0", lacking.empty() ? "" : ",", dimensions[d].name);
  }
  require(lacking.empty(), "{} has several numbers for each cell: {}; choose one index of each: {}",
          name, in_words(dimensions), lacking);
  return indices;
}

MeshField field_at(const MeshField& field, const std::vector<FieldIndex>& choices) {
  using namespace io_detail;
  require_dimensions(field.name, field.dimensions, choices);
  return field_at_indices(field, find_indices(field.dimensions, choices));
}

std::vector<MeshField> fields_at(std::vector<MeshField> fields,
                                 const std::vector<FieldIndex>& choices) {
  using namespace io_detail;
  for (const FieldIndex& choice : choices)
    if (std::ranges::none_of(
            fields, [&](const MeshField& field) { return belongs(choice, field.dimensions); }))
      refuse(message("no field has a dimension {}; leave it out", choice.dimension));
  for (MeshField& field : fields) {
    const auto indices = find_indices(field.dimensions, choices);
    field = field_at_indices(std::move(field), indices);
  }
  return fields;
}

} // namespace calotte
