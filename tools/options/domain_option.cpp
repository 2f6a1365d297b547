// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/domain_option.h"

#include "options/files.h"

#include <calotte/error.h>
#include <calotte/io.h>

#include <array>
#include <charconv>
#include <cmath>

namespace calotte::tools {
namespace {

/// So many finite numbers with commas between them and nothing else.
template <std::size_t count>
std::optional<std::array<double, count>> numbers_of(const std::string& text) {
  std::array<double, count> numbers{};
  const char *at = text.data(), *const end = text.data() + text.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0 && (at == end || *at++ != ','))
      return std::nullopt;
    const auto [stop, problem] = std::from_chars(at, end, numbers[i]);
    if (problem != std::errc() || !std::isfinite(numbers[i]))
      return std::nullopt;
    at = stop;
  }
  return at == end ? std::optional(numbers) : std::nullopt;
}

PlanarDomain rectangle_of(const std::string& word) {
  const auto sides = numbers_of<4>(word);
  if (!sides || !((*sides)[0] < (*sides)[2]) || !((*sides)[1] < (*sides)[3]))
    throw Error(ErrorCode::bad_option, "--rectangle " + word +
                                           " is no rectangle; give its lower left and its upper "
                                           "right corner, as in --rectangle 0,0,2,1");
  return rectangle({(*sides)[0], (*sides)[1]}, {(*sides)[2], (*sides)[3]});
}

} // namespace

CLI::Option* add_periodic(CLI::App& command, std::optional<std::string>& word) {
  return command
      .add_option("--periodic", word,
                  "the plane repeats itself every WIDTH in x and HEIGHT in y, and all points lie "
                  "in the box from 0 0 on; meshes of it are .nc (MPAS) or triangles alone")
      ->type_name("WIDTH,HEIGHT");
}

std::shared_ptr<DomainWords> add_domain(CLI::App& command) {
  auto words = std::make_shared<DomainWords>();
  CLI::Option* file =
      command
          .add_option("--domain", words->file,
                      "the part of the plane inside polygons: GeoJSON (.geojson, .json; x and y "
                      "for longitude and latitude), or text, a corner x y a line, with a blank "
                      "line or one of > between rings; rings within rings are holes")
          ->type_name("FILE");
  CLI::Option* box =
      command
          .add_option("--rectangle", words->rectangle, "the part of the plane between two corners")
          ->type_name("X0,Y0,X1,Y1")
          ->excludes(file);
  add_periodic(command, words->periodic)->excludes(file)->excludes(box);
  return words;
}

std::optional<Eigen::Vector2d> period_of(const std::optional<std::string>& word) {
  if (!word)
    return std::nullopt;
  const auto sides = numbers_of<2>(*word);
  if (!sides || !((*sides)[0] > 0) || !((*sides)[1] > 0))
    throw Error(ErrorCode::bad_option, "--periodic " + *word +
                                           " is no box; give two positive lengths, as in "
                                           "--periodic 1000,866.025");
  return Eigen::Vector2d((*sides)[0], (*sides)[1]);
}

std::string domain_configuration(const DomainWords& words) {
  if (words.file)
    return "domain of " + checksum_of(*words.file) + "\n";
  return words.rectangle ? "rectangle " + *words.rectangle + "\n"
                         : "periodic " + *words.periodic + "\n";
}

std::optional<PlanarDomain> domain_of(const DomainWords& words) {
  if (words.file)
    return read_domain(*words.file);
  if (words.rectangle)
    return rectangle_of(*words.rectangle);
  if (const std::optional<Eigen::Vector2d> period = period_of(words.periodic))
    return periodic_box(*period);
  return std::nullopt;
}

} // namespace calotte::tools
