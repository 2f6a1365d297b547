// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/format_table.h"
#include "io/mpas/mpas_variables.h"
#include "io/netcdf/netcdf_reader.h"
#include "support/files.h"

#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/write.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

// The tables say all that there is, and each thing once.

using namespace calotte;
using calotte::test::Scratch;
using io_detail::find_row;
using io_detail::format_of_name;
using io_detail::format_table;
using io_detail::FormatRow;
using io_detail::mpas_variables;
using io_detail::MpasDimension;
using io_detail::MpasNumbers;
using io_detail::MpasVariable;
using io_detail::NetcdfReader;

TEST_CASE("each format has one row") {
  std::set<Format> seen;
  for (const FormatRow& row : format_table()) {
    CAPTURE(row.info.title);
    CHECK(row.info.format != Format::by_name);
    CHECK(seen.insert(row.info.format).second);
    CHECK_FALSE(row.info.names.empty());
    CHECK_FALSE(row.label.empty());
    CHECK(&find_row(row.info.format) == &row);
  }
  // Enumerators count from by_name on, without gaps.
  CHECK(static_cast<int>(*seen.begin()) == static_cast<int>(Format::by_name) + 1);
  CHECK(static_cast<int>(*seen.rbegin()) - static_cast<int>(*seen.begin()) + 1 ==
        static_cast<int>(seen.size()));
}

TEST_CASE("what a row says agrees with what it does") {
  std::set<std::string> words;
  for (const FormatRow& row : format_table()) {
    const FormatInfo& info = row.info;
    CAPTURE(info.title);
    CHECK(info.word.empty() == (row.write_mesh == nullptr));
    if (!info.word.empty())
      CHECK(words.insert(info.word).second);
    if (row.is != nullptr) {
      CHECK(info.netcdf);
      CHECK((row.read != nullptr));
    }
    if (row.write_polygons != nullptr)
      CHECK((row.polygons_as == info.format));
    // Another row of the same label may read what this one writes.
    const auto reads = [&](const FormatRow& other) {
      return other.label == row.label && other.read != nullptr;
    };
    CHECK(info.read == (std::any_of(format_table().begin(), format_table().end(), reads) ||
                        !info.points)); // with the points at hand, see read_mesh()
  }
}

TEST_CASE("a name selects a format that has it, and each format that is written has one") {
  for (const FormatRow& row : format_table())
    for (const std::string& name : row.info.names) {
      const std::string path = name.starts_with('.') ? "mesh" + name : name;
      CAPTURE(path);
      const std::vector<std::string>& names = info_of(*format_of_name(path)).names;
      CHECK(std::find(names.begin(), names.end(), name) != names.end());
      if (!row.info.word.empty())
        CHECK(format_of(path, row.info.format) == row.info.format);
    }
}

TEST_CASE("MPAS files hold the variables of the table, as it describes them") {
  const Scratch scratch;
  const Mesh mesh = delaunay(fibonacci_sphere(200)), plane = hexagonal_box(8, 8, 1);
  std::set<std::string> written;
  const auto compare = [&](const std::string& name, const Mesh& of, Format format) {
    WriteOptions options{.format = format};
    options.site_density = DoubleVector::LinSpaced(of.points.cols(), 1, 2);
    write(scratch / name, of, options);
    const NetcdfReader file(scratch / name);
    for (const std::string& variable : file.variable_names()) {
      CAPTURE(name);
      CAPTURE(variable);
      const auto table = mpas_variables();
      const auto found = std::find_if(table.begin(), table.end(), [&](const MpasVariable& row) {
        return row.name == variable;
      });
      REQUIRE(found != table.end());
      const MpasVariable& row = *found;
      written.insert(variable);
      CHECK_FALSE(row.of_models);
      std::vector<std::string> dimensions;
      for (const MpasDimension dimension : {row.rows, row.columns})
        if (dimension != MpasDimension::none)
          dimensions.emplace_back(name_of(dimension));
      CHECK(file.dimensions_of(variable) == dimensions);
      CHECK(file.is_integer(variable) == row.integer);
      CHECK(file.text(variable, "units") == row.units);
      CHECK(file.text(variable, "long_name") == row.long_name);
      CHECK_FALSE(row.long_name.empty());
      const bool ids = row.numbers == MpasNumbers::cells || row.numbers == MpasNumbers::edges ||
                       row.numbers == MpasNumbers::vertices;
      CHECK(row.long_name.ends_with(", 1-based; 0 where there is none") == ids);
    }
  };
  compare("sphere.nc", mesh, Format::mpas);
  compare("minimal.nc", mesh, Format::mpas_minimal);
  compare("plane.nc", plane, Format::mpas);
  for (const MpasVariable& row : mpas_variables()) {
    CAPTURE(row.name);
    CHECK(written.contains(row.name) != row.of_models);
  }
}
