// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/scale.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace calotte::tools {

namespace {

constexpr Rgb plain = {0.90, 0.93, 0.95};
constexpr int least_class = 3;
constexpr int greatest_class = 9;

Rgb hex(std::uint32_t rgb) {
  const auto channel = [rgb](int shift) { return ((rgb >> shift) & 0xff) / 255.0; };
  return {channel(16), channel(8), channel(0)};
}

/// Grey for the regular 6 and the boundary, blue below, red above, so that defects stand out.
Rgb valence_colour(double valence) {
  if (valence == boundary_valence) {
    return hex(0xc3cad1);
  }
  static constexpr std::array<std::uint32_t, 7> colours = {0x0b2a5b, 0x2166ac, 0x74add1, 0xeceef0,
                                                           0xf4a261, 0xd1495b, 0x7a0c2e};
  const int v = std::clamp(static_cast<int>(valence), least_class, greatest_class);
  return hex(colours[static_cast<std::size_t>(v - least_class)]);
}

/// Viridis' green for the region, oranges to red for the relaxation zone, greys for the specified
/// zone.
Rgb mask_colour(double mask) {
  static constexpr std::array<std::uint32_t, 8> colours = {0x9fcfb5, 0xfdd9a0, 0xfcb96a, 0xf6953f,
                                                           0xe06f1f, 0xb94a0c, 0x8b93a1, 0x565d6b};
  return hex(colours[static_cast<std::size_t>(std::clamp(mask, 0.0, colours.size() - 1.0))]);
}

/// Quantities that may range over powers of ten.
bool is_magnitude(Colouring colouring) {
  return colouring == Colouring::spacing || colouring == Colouring::area ||
         colouring == Colouring::density || colouring == Colouring::field;
}

/// A few outliers must not compress the others into nearly one colour. For spacings and areas only
/// small values are cut off, because a few wide shapes fill much of the picture.
void trim(Scale& scale, std::vector<double>& values) {
  const auto quantile = [&](double p) {
    const auto k = static_cast<std::ptrdiff_t>(p * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + k, values.end());
    return values[static_cast<std::size_t>(k)];
  };
  const double low = quantile(0.01);
  const bool wide = scale.colouring == Colouring::spacing || scale.colouring == Colouring::area;
  const double high = wide ? scale.high : quantile(0.99);
  const double range = scale.place(high) - scale.place(low);
  if (values.size() < 200 || range > 0.8 || high <= low) {
    return;
  }
  scale.below = low > scale.low;
  scale.above = high < scale.high;
  scale.low = low;
  scale.high = high;
}

} // namespace

double Scale::place(double value) const {
  const double v = std::clamp(value, low, high);
  return logarithmic ? std::log(v / low) / std::log(high / low) : (v - low) / (high - low);
}

Rgb Scale::colour(double value) const {
  if (colouring == Colouring::none) {
    return plain;
  }
  return colouring == Colouring::valence  ? valence_colour(value)
         : colouring == Colouring::region ? mask_colour(value)
                                          : viridis(place(value));
}

Scale make_scale(const std::vector<double>& values, Colouring colouring) {
  Scale scale;
  scale.colouring = colouring;
  std::vector<double> known;
  std::copy_if(values.begin(), values.end(), std::back_inserter(known),
               [](double v) { return std::isfinite(v); });
  if (known.empty() || colouring == Colouring::none || has_classes(colouring)) {
    return scale;
  }
  const auto [least, greatest] = std::minmax_element(known.begin(), known.end());
  scale.low = scale.least = *least;
  scale.high = scale.greatest = *greatest;
  scale.logarithmic = is_magnitude(colouring) && scale.low > 0 && scale.high > 4 * scale.low;
  scale.constant = scale.high - scale.low <= 1e-6 * std::abs(scale.high);
  if (scale.constant) {
    // One colour, in the middle of a bar of positive width.
    const double margin = std::max(0.05 * std::abs(scale.high), 1e-300);
    scale.low -= margin;
    scale.high += margin;
    return scale;
  }
  if (colouring != Colouring::density) { // smooth
    trim(scale, known);
  }
  return scale;
}

bool has_classes(Colouring colouring) {
  return colouring == Colouring::valence || colouring == Colouring::region;
}

Rgb viridis(double place) {
  static constexpr std::array<std::uint32_t, 11> anchors = {0x440154, 0x482576, 0x414487, 0x35608d,
                                                            0x2a788e, 0x21908c, 0x22a884, 0x43bf71,
                                                            0x7ad151, 0xbbdf27, 0xfde725};
  const double x = std::clamp(place, 0.0, 1.0) * (anchors.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(x), anchors.size() - 2);
  const Rgb a = hex(anchors[i]);
  const Rgb b = hex(anchors[i + 1]);
  const double t = x - static_cast<double>(i);
  return {std::lerp(a.r, b.r, t), std::lerp(a.g, b.g, t), std::lerp(a.b, b.b, t)};
}

std::vector<ValenceClass> valence_classes(const std::vector<double>& values) {
  std::map<int, std::int64_t> counts;
  for (const double v : values) {
    if (std::isfinite(v)) {
      ++counts[v == boundary_valence
                   ? 0
                   : std::clamp(static_cast<int>(v), least_class, greatest_class)];
    }
  }
  std::vector<ValenceClass> classes;
  for (const auto& [valence, count] : counts) {
    const std::string label =
        valence == boundary_valence
            ? "at the boundary"
            : std::to_string(valence) + (valence == greatest_class ? "+" : "");
    classes.push_back({valence_colour(valence), label, count});
  }
  return classes;
}

std::vector<ValenceClass> mask_classes(const std::vector<double>& values) {
  std::map<int, std::int64_t> counts;
  for (const double mask : values) {
    if (std::isfinite(mask)) {
      ++counts[static_cast<int>(mask)];
    }
  }
  std::vector<ValenceClass> classes;
  for (const auto& [mask, count] : counts) {
    classes.push_back({mask_colour(mask), std::to_string(mask), count});
  }
  return classes;
}

} // namespace calotte::tools
