// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cells/field_order.h"

#include "base/message.h"
#include "io/cells/limited_area_masks.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace calotte::io_detail {
namespace {

/// The values as a matrix, with a column for each cell, edge or vertex.
Eigen::Map<DoubleMatrix> as_columns(DoubleVector& values, std::int64_t count) {
  return {values.data(), count, count > 0 ? values.size() / count : 0};
}

/// A key by which pairs are sorted.
std::uint64_t edge_key(std::int32_t low, std::int32_t high) {
  return static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint32_t>(high);
}

void set_pair(Pairs& pairs, Eigen::Index column, std::uint64_t key) {
  pairs.col(column) << static_cast<std::int32_t>(key >> 32), static_cast<std::int32_t>(key);
}

std::vector<std::string> edge_fields(const std::vector<MeshField>& fields, bool directed) {
  std::vector<std::string> names;
  for (const MeshField& field : fields)
    if (field.location == FieldLocation::edges && field.directed == directed)
      names.push_back(field.name);
  return names;
}

std::string describe_changes(const EdgeOrder& order, const std::vector<MeshField>& fields) {
  const auto turned = std::count(order.turned.begin(), order.turned.end(), true);
  const std::vector<std::string> directed = edge_fields(fields, true),
                                 others = edge_fields(fields, false);
  return message("edges run from their lower to their higher cell: turned {} of {}{}{}", turned,
                 order.turned.size(),
                 directed.empty() ? "" : "; changes its sign there: " + listed(directed),
                 others.empty() ? "" : "; keeps its sign: " + listed(others));
}

void ignore_edge_fields(std::vector<MeshField>& fields, std::vector<std::string>& ignored) {
  for (const MeshField& field : fields)
    if (field.location == FieldLocation::edges && !is_derived_mask(field.name, fields))
      ignored.push_back(field.name);
  std::erase_if(fields,
                [](const MeshField& field) { return field.location == FieldLocation::edges; });
}

} // namespace

bool has_values_for(const MeshField& field, std::int64_t count) {
  return field.values.size() == count * field.count();
}

void move_values(MeshField& field, std::span<const std::int32_t> new_index) {
  DoubleVector moved(field.values.size());
  const auto from = as_columns(field.values, field.count());
  auto to = as_columns(moved, field.count());
  for (std::size_t i = 0; i < new_index.size(); ++i)
    to.col(new_index[i]) = from.col(static_cast<Eigen::Index>(i));
  field.values = std::move(moved);
}

void move_vertex_values(std::vector<MeshField>& fields, std::span<const std::int32_t> new_index) {
  for (MeshField& field : fields)
    if (field.location == FieldLocation::vertices && has_values_for(field, std::ssize(new_index)))
      move_values(field, new_index);
}

void select_values(MeshField& field, std::span<const std::int32_t> from) {
  DoubleVector selected(field.count() * std::ssize(from));
  const auto all = as_columns(field.values, field.count());
  auto to = as_columns(selected, field.count());
  for (std::size_t i = 0; i < from.size(); ++i)
    to.col(static_cast<Eigen::Index>(i)) = all.col(from[i]);
  field.values = std::move(selected);
}

Pairs list_edges(const Triangles& triangles) {
  std::vector<std::uint64_t> keys;
  keys.reserve(static_cast<std::size_t>(triangles.size() / 2));
  for (Eigen::Index t = 0; t < triangles.cols(); ++t)
    for (int i = 0; i < 3; ++i)
      if (const std::int32_t a = triangles(i, t), b = triangles((i + 1) % 3, t); a < b)
        keys.push_back(edge_key(a, b));
  std::sort(keys.begin(), keys.end());
  Pairs edges(2, std::ssize(keys));
  for (std::size_t e = 0; e < keys.size(); ++e)
    set_pair(edges, static_cast<Eigen::Index>(e), keys[e]);
  return edges;
}

EdgeOrder sort_pairs(const Pairs& pairs) {
  std::vector<std::pair<std::uint64_t, std::int32_t>> keys(static_cast<std::size_t>(pairs.cols()));
  EdgeOrder order{Pairs(2, pairs.cols()), std::vector<std::int32_t>(keys.size()),
                  std::vector<bool>(keys.size())};
  for (std::size_t e = 0; e < keys.size(); ++e) {
    const auto column = static_cast<Eigen::Index>(e);
    const auto [low, high] = std::minmax(pairs(0, column), pairs(1, column));
    keys[e] = {edge_key(low, high), static_cast<std::int32_t>(e)};
    order.turned[e] = pairs(0, column) > pairs(1, column);
  }
  std::sort(keys.begin(), keys.end());
  for (std::size_t k = 0; k < keys.size(); ++k) {
    set_pair(order.sorted, static_cast<Eigen::Index>(k), keys[k].first);
    order.index[static_cast<std::size_t>(keys[k].second)] = static_cast<std::int32_t>(k);
  }
  return order;
}

void move_edge_values(MeshField& field, const EdgeOrder& order) {
  auto values = as_columns(field.values, field.count());
  for (std::size_t e = 0; field.directed && e < order.turned.size(); ++e)
    if (order.turned[e])
      values.col(static_cast<Eigen::Index>(e)) *= -1;
  move_values(field, order.index);
}

void reorder_edge_fields(const Triangles& triangles, const Pairs& pairs,
                         std::vector<MeshField>& fields, std::vector<std::string>& changes,
                         std::vector<std::string>& ignored) {
  const auto is_at_edges = [](const MeshField& field) {
    return field.location == FieldLocation::edges;
  };
  if (std::none_of(fields.begin(), fields.end(), is_at_edges))
    return;
  const bool may_be = pairs.cols() > 0 && 2 * pairs.cols() == triangles.size();
  const EdgeOrder order = may_be ? sort_pairs(pairs) : EdgeOrder();
  if (!may_be || order.sorted != list_edges(triangles))
    return ignore_edge_fields(fields, ignored);
  for (MeshField& field : fields)
    if (is_at_edges(field))
      move_edge_values(field, order);
  changes.push_back(describe_changes(order, fields));
}

} // namespace calotte::io_detail
