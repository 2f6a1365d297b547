// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/check/mpas_check.h"

#include "base/parallel.h"
#include "io/mpas/mpas.h"
#include "io/mpas/mpas_coordinates.h"
#include "io/mpas/vertex_order.h"

#include <algorithm>
#include <vector>

// Receives variables from the writer, which puts them here instead of into a file.

namespace calotte::io_detail {
namespace {

/// Whether the values of the writer have the rows and ids of the file.
bool is_comparable(const MpasCheck& check, const MpasVariable& variable) {
  if (variable.name == mpas::boundary_vertex && check.closed)
    return true; // independent of the vertices
  if (check.closed &&
      (variable.name == mpas::cells_on_edge || variable.name == mpas::cells_on_vertex))
    return false; // find_numbering() used it to identify edges and vertices
  const bool is_list = variable.numbers == MpasNumbers::cells ||
                       variable.numbers == MpasNumbers::edges ||
                       variable.numbers == MpasNumbers::vertices;
  if (is_list && !check.closed && variable.name != mpas::edges_on_edge)
    return false; // an open mesh uses the lists of its file
  const bool of_edges =
      variable.rows == MpasDimension::edges || variable.numbers == MpasNumbers::edges;
  const bool of_vertices =
      variable.rows == MpasDimension::vertices || variable.numbers == MpasNumbers::vertices;
  return (check.has_edges || !of_edges) && (check.has_vertices || !of_vertices);
}

/// A variable of a group.
struct Column {
  const MpasVariable& variable;
  std::int64_t width;            ///< values in a row of the writer
  std::int64_t stored_width = 0; ///< values in a row of the file; 0 if it is not compared
  Array<double> stored = {};     ///< some rows
};

/// Memory for some rows of variables.
template <class T> class Rows {
public:
  T* add(std::int64_t values) {
    memory_.emplace_back(values);
    begins_.push_back(memory_.back().begin());
    return begins_.back();
  }
  T* const* begins() const { return begins_.data(); }

private:
  std::vector<Array<T>> memory_;
  std::vector<T*> begins_;
};

using Rules = std::map<std::string, MpasRule>;

/// Compares rows begin to end - 1 of the columns, whose stored rows start with `first`.
void compare_block(const Rules& rules, const std::vector<Column>& columns,
                   const NetcdfWriter::GroupFill& contents, std::int64_t first, std::int64_t begin,
                   std::int64_t end, std::vector<Differences>& out) {
  constexpr std::int64_t most = 512; // number of rows at once, which fit into the caches
  Rows<std::int32_t> ints;
  Rows<double> doubles;
  std::vector<MpasRows> rows;
  for (const Column& of : columns) {
    const bool integer = of.variable.integer;
    const std::int64_t values = most * of.width;
    rows.push_back({begin, end, of.stored.begin(), of.stored_width,
                    integer ? ints.add(values) : nullptr, integer ? nullptr : doubles.add(values),
                    of.width,
                    of.variable.name == mpas::weights_on_edge ? ints.begins()[0] : nullptr});
  }
  for (std::int64_t row = begin; row < end; row += most) {
    const std::int64_t after = std::min(row + most, end);
    contents(row, after, ints.begins(), doubles.begins());
    for (std::size_t c = 0; c < columns.size(); ++c) {
      rows[c].begin = row;
      rows[c].end = after;
      rows[c].stored = columns[c].stored.begin() + (row - first) * columns[c].stored_width;
      if (columns[c].stored_width > 0)
        rules.at(columns[c].variable.name)(rows[c], out[c]);
    }
  }
}

/// Reads the columns and compares them, some rows at a time.
std::vector<Differences> differences(const MpasCheck& check, const Rules& rules,
                                     std::vector<Column>& columns,
                                     const NetcdfWriter::GroupFill& contents) {
  constexpr std::int64_t at_once = std::int64_t{1} << 22; // values in memory
  std::int64_t values = 1;                                // values in a row
  for (const Column& column : columns)
    values += column.stored_width;
  const std::int64_t rows = check.rows(columns[0].variable.rows),
                     most = std::max<std::int64_t>(at_once / values, 1);
  const std::vector<Differences> none(columns.size());
  std::vector<Differences> all = none;
  for (std::int64_t first = 0; first < rows; first += most) {
    const std::int64_t count = std::min(most, rows - first);
    for (Column& column : columns)
      if (column.stored_width > 0) {
        column.stored = Array<double>(count * column.stored_width);
        check.deviations.file().rows(column.variable.name, first, count, column.stored.begin());
      }
    std::vector<std::vector<Differences>> parts(static_cast<std::size_t>(block_count(count)), none);
    for_each_block(count, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
      compare_block(rules, columns, contents, first, first + begin, first + end,
                    parts[static_cast<std::size_t>(block)]);
    });
    for (const std::vector<Differences>& part : parts)
      for (std::size_t c = 0; c < columns.size(); ++c)
        all[c].take(part[c]);
  }
  return all;
}

/// Adds differences of a variable. If there are any, determines whether a known fault explains all
/// values.
void add_differences(const MpasCheck& check, const std::string& variable, Differences differences) {
  const Fault fault = mpas_fault(check, variable);
  if (differences.count > 0 && fault.explains)
    differences.unlike_fault =
        check.deviations
            .visit_rows<double>(variable,
                                [&](std::int64_t row, const double* stored, Differences& out) {
                                  out.unlike_fault += fault.explains(row, *stored) ? 0 : 1;
                                })
            .unlike_fault;
  check.add(variable, differences, fault.text);
}

} // namespace

void compare_mpas(const MpasCheck& check) {
  const Rules rules = mpas_rules(check);
  const bool whole = check.voronoi.edges_on_cell.size() > 0;
  const std::int64_t most = whole ? most_corners(check.voronoi) : 0;
  const auto width = [&](MpasDimension columns) {
    return columns == MpasDimension::none         ? 1
           : columns == MpasDimension::max_edges  ? most
           : columns == MpasDimension::max_edges2 ? 2 * most
                                                  : check.rows(columns);
  };
  const MpasSink sink = [&](const std::vector<std::string>& names,
                            const NetcdfWriter::GroupFill& contents) {
    std::vector<Column> columns;
    for (const std::string& name : names) {
      const MpasVariable& variable = mpas_variable(name);
      columns.push_back({variable, width(variable.columns)});
      if (is_comparable(check, variable) && check.has(name))
        columns.back().stored_width = check.deviations.width(name);
    }
    if (std::ranges::all_of(columns, [](const Column& c) { return c.stored_width == 0; }))
      return;
    const std::vector<Differences> found = differences(check, rules, columns, contents);
    for (std::size_t c = 0; c < columns.size(); ++c)
      add_differences(check, names[c], found[c]);
  };
  const MpasMesh mesh{check.voronoi, {}, check.radius};
  if (whole)
    put_variables(sink, mesh, read_vertex_order(check.deviations.file()));
  else
    put_cells(sink, mesh);
}

} // namespace calotte::io_detail
