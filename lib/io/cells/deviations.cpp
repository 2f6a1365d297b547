// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cells/deviations.h"

#include "base/message.h"

#include <cmath>
#include <limits>
#include <sstream>

namespace calotte::io_detail {
namespace {

std::string index_in_words(std::int64_t index, const std::vector<std::int64_t>& shape) {
  return shape.size() < 2 || shape[1] == 0 ? in_words({index})
                                           : in_words({index / shape[1], index % shape[1]});
}

std::int64_t size_of(const std::vector<std::int64_t>& shape) {
  std::int64_t size = 1;
  for (const std::int64_t count : shape)
    size *= count;
  return size;
}

} // namespace

void Differences::note(std::int64_t at, double stored_there, double derived_there,
                       double difference) {
  ++count;
  if (index >= 0 && !(difference > largest))
    return;
  index = at;
  largest = difference;
  stored = stored_there;
  derived = derived_there;
}

void Differences::compare(std::int64_t at, double stored_there, double derived_there, double scale,
                          double tolerance) {
  const double apart = std::abs(stored_there - derived_there);
  if (apart <= tolerance * scale)
    return;
  const double difference = apart / scale;
  note(at, stored_there, derived_there,
       std::isfinite(difference) ? difference : std::numeric_limits<double>::infinity());
}

void Differences::take(const Differences& later) {
  const std::int64_t both = count + later.count, both_unlike = unlike_fault + later.unlike_fault;
  if (later.count > 0 && (count == 0 || later.largest > largest))
    *this = later;
  count = both;
  unlike_fault = both_unlike;
}

bool Deviations::has(const std::string& variable, const std::vector<std::int64_t>& shape) {
  if (!file_.has_variable(variable) || !file_.is_numeric(variable))
    return false;
  const std::vector<std::int64_t> stored = file_.shape_of(variable);
  if (std::equal(stored.begin(), stored.end(), shape.begin(), shape.end(),
                 [](std::int64_t size, std::int64_t want) { return want < 0 || size == want; }))
    return true;
  add(variable,
      message("{} has the shape {} instead of {}", variable, in_words(stored), in_words(shape)));
  return false;
}

std::int64_t Deviations::width(const std::string& variable) const {
  const std::vector<std::int64_t> shape = file_.shape_of(variable);
  return shape.empty() || shape[0] == 0 ? 1 : size_of(shape) / shape[0];
}

void Deviations::add(const std::string& variable, const Differences& differences,
                     const std::string& rule, const std::string& fault) {
  if (differences.count == 0)
    return;
  const bool known = !fault.empty() && differences.unlike_fault == 0;
  const std::vector<std::int64_t> shape = file_.shape_of(variable);
  const std::int64_t size = size_of(shape);
  std::ostringstream text;
  text.precision(12);
  text << variable << ": ";
  if (size > 1)
    text << differences.count << " of " << size << " values are not " << rule << "; at "
         << index_in_words(differences.index, shape) << ", 0-based, ";
  else
    text << "the value is not " << rule << "; ";
  text << differences.stored << " is stored, " << differences.derived << " is derived";
  if (known)
    text << " (known: " << fault << ")";
  found_.push_back({variable, differences.largest, differences.index, known, text.str()});
}

void Deviations::add(const std::string& variable, const std::string& text, std::int64_t index,
                     double difference) {
  found_.push_back({variable, difference, index, false, text});
}

} // namespace calotte::io_detail
