// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/scale.h"

#include "text/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <map>
#include <sstream>

namespace calotte::tools {

namespace {

constexpr Rgb uniform_colour = {0.90, 0.93, 0.95};
constexpr int least_class = 3;
constexpr int greatest_class = 9;

/// Grey for the regular 6 and the boundary, blue below, red above, so that defects stand out.
Rgb valence_colour(double valence) {
  if (valence == boundary_valence) {
    return colour_of(0xc3cad1);
  }
  static constexpr std::array<std::uint32_t, 7> colours = {0x0b2a5b, 0x2166ac, 0x74add1, 0xeceef0,
                                                           0xf4a261, 0xd1495b, 0x7a0c2e};
  const int v = std::clamp(static_cast<int>(valence), least_class, greatest_class);
  return colour_of(colours[static_cast<std::size_t>(v - least_class)]);
}

/// Viridis' green for the region, oranges to red for the relaxation zone, greys for the specified
/// zone.
Rgb mask_colour(double mask) {
  static constexpr std::array<std::uint32_t, 8> colours = {0x9fcfb5, 0xfdd9a0, 0xfcb96a, 0xf6953f,
                                                           0xe06f1f, 0xb94a0c, 0x8b93a1, 0x565d6b};
  return colour_of(colours[static_cast<std::size_t>(std::clamp(mask, 0.0, colours.size() - 1.0))]);
}

/// The ratio of values above which a scale is logarithmic; 0 for one that never is.
double wide_ratio(Colouring colouring) {
  switch (colouring) {
  case Colouring::spacing:
  case Colouring::area:
  case Colouring::density:
    return 4;
  case Colouring::field: // of any meaning: temperatures are read from a linear scale
    return 1000;
  default:
    return 0;
  }
}

/// \param low, high values of which the automatic choice takes the ratio.
bool is_logarithmic(const Scale& scale, double low, double high) {
  const double ratio = wide_ratio(scale.colouring);
  return scale.low > 0 && (scale.kind == ScaleKind::logarithmic ||
                           (scale.kind == ScaleKind::automatic && ratio > 0 && high > ratio * low));
}

double quantile(std::vector<double>& values, double p) {
  const auto k = std::lround(p * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + k, values.end());
  return values[static_cast<std::size_t>(k)];
}

constexpr double low_quantile = 0.01, high_quantile = 0.99;

/// A few outliers must not compress the others into nearly one colour. For spacings and areas only
/// small values are cut off, because a few wide shapes fill much of the picture.
void trim(Scale& scale, std::vector<double>& values) {
  const double low = quantile(values, low_quantile);
  const bool wide = scale.colouring == Colouring::spacing || scale.colouring == Colouring::area;
  const double high = wide ? scale.high : quantile(values, high_quantile);
  const double range = scale.position(high) - scale.position(low);
  if (values.size() < 200 || range > 0.8 || high <= low) {
    return;
  }
  scale.below = low > scale.low;
  scale.above = high < scale.high;
  scale.low = low;
  scale.high = high;
}

} // namespace

double Scale::position(double value) const {
  const double v = std::clamp(value, low, high);
  return logarithmic ? std::log(v / low) / std::log(high / low) : (v - low) / (high - low);
}

Rgb Scale::colour(double value) const {
  if (colouring == Colouring::none) {
    return uniform_colour;
  }
  return has_classes(colouring) ? class_colour(colouring, value)
                                : palette_colour(palette, position(value));
}

Scale make_scale(const std::vector<double>& values, Colouring colouring, ScaleKind kind) {
  Scale scale;
  scale.colouring = colouring;
  scale.kind = kind;
  std::vector<double> known;
  std::copy_if(values.begin(), values.end(), std::back_inserter(known),
               [](double v) { return std::isfinite(v); });
  if (known.empty() || colouring == Colouring::none || has_classes(colouring)) {
    return scale;
  }
  const auto [least, greatest] = std::minmax_element(known.begin(), known.end());
  scale.low = scale.least = *least;
  scale.high = scale.greatest = *greatest;
  scale.logarithmic =
      colouring == Colouring::field
          ? is_logarithmic(scale, quantile(known, low_quantile), quantile(known, high_quantile))
          : is_logarithmic(scale, scale.low, scale.high);
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

void set_range(Scale& scale, const ColourRange& range) {
  if (scale.colouring == Colouring::none || has_classes(scale.colouring)) {
    refuse("--range sets the ends of a colour bar, which this --colour "
           "does not have; leave --range out");
  }
  scale.low = range.low;
  scale.high = range.high;
  scale.constant = false;
  scale.logarithmic = is_logarithmic(scale, scale.low, scale.high);
  scale.below = scale.least < scale.low;
  scale.above = scale.greatest > scale.high;
}

Scale make_scale(const std::vector<double>& values, Colouring colouring, const Look& look) {
  if (look.scale != ScaleKind::automatic &&
      (colouring == Colouring::none || has_classes(colouring)))
    refuse("--scale is that of a colour bar, which this --colour does not have; leave --scale out");
  Scale scale = make_scale(values, colouring, look.scale);
  scale.palette = look.palette;
  if (look.range)
    set_range(scale, *look.range);
  if (look.scale == ScaleKind::logarithmic && !scale.logarithmic)
    refuse(message("--scale log needs values above 0, and the colour bar begins at {}; give a "
                   "--range above 0, or leave --scale out",
                   scale.low));
  return scale;
}

const std::vector<std::pair<std::string, Palette>>& palette_names() {
  static const std::vector<std::pair<std::string, Palette>> names{
      {"viridis", Palette::viridis},
      {"cividis", Palette::cividis},
      {"magma", Palette::magma},
      {"diverging", Palette::diverging}};
  return names;
}

std::vector<Rgb> palette_colours(Palette palette) {
  constexpr std::size_t count = 25;
  // clang-format off
  static constexpr std::array<std::array<std::uint32_t, count>, 4> colours{{
    // viridis
    {0x440154, 0x471063, 0x481f70, 0x472d7b, 0x443983, 0x404688, 0x3b528b, 0x365d8d,
     0x31688e, 0x2c728e, 0x287c8e, 0x24868e, 0x21918c, 0x1f9a8a, 0x20a486, 0x28ae80,
     0x35b779, 0x48c16e, 0x5ec962, 0x75d054, 0x90d743, 0xaddc30, 0xc8e020, 0xe5e419,
     0xfde725},
    // cividis
    {0x00224e, 0x002a5f, 0x003170, 0x1a386f, 0x2a3f6d, 0x38476c, 0x434e6c, 0x4d556c,
     0x575d6d, 0x61656f, 0x6a6c71, 0x737475, 0x7d7c78, 0x868379, 0x918b78, 0x9b9476,
     0xa59c74, 0xb0a571, 0xbcae6c, 0xc6b667, 0xd2c060, 0xdec958, 0xe9d34e, 0xf6dd3f,
     0xfee838},
    // magma
    {0x000004, 0x050416, 0x100b2d, 0x1d1147, 0x2c115f, 0x3f0f72, 0x51127c, 0x601880,
     0x721f81, 0x832681, 0x932b80, 0xa5317e, 0xb73779, 0xc73d73, 0xd8456c, 0xe75263,
     0xf1605d, 0xf8745c, 0xfc8961, 0xfd9b6b, 0xfeb078, 0xfec488, 0xfed799, 0xfdebac,
     0xfcfdbf},
    // diverging
    {0x0b2a5b, 0x11366b, 0x18437b, 0x1e508c, 0x265d9d, 0x2d6bae, 0x447dbb, 0x6091c5,
     0x7ba5d0, 0x96b9da, 0xb1cde3, 0xd0dee8, 0xefeeec, 0xf1d8cd, 0xf1c2ae, 0xeaab96,
     0xe2937e, 0xda7b66, 0xd0634e, 0xc34c3b, 0xae4036, 0x993432, 0x85282d, 0x711c28,
     0x5e0f23},
  }};
  // clang-format on
  std::vector<Rgb> steps(count);
  std::ranges::transform(colours[static_cast<std::size_t>(palette)], steps.begin(), colour_of);
  return steps;
}

Rgb palette_colour(Palette palette, double position) {
  static const std::array<std::vector<Rgb>, 4> palettes{
      palette_colours(Palette::viridis), palette_colours(Palette::cividis),
      palette_colours(Palette::magma), palette_colours(Palette::diverging)};
  const std::vector<Rgb>& steps = palettes[static_cast<std::size_t>(palette)];
  const double x = std::clamp(position, 0.0, 1.0) * static_cast<double>(steps.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(x), steps.size() - 2);
  const double t = x - static_cast<double>(i);
  const Rgb &a = steps[i], &b = steps[i + 1];
  return {std::lerp(a.r, b.r, t), std::lerp(a.g, b.g, t), std::lerp(a.b, b.b, t)};
}

std::string hex_text(const Rgb& colour) {
  std::ostringstream text;
  text << std::hex << std::setfill('0') << std::setw(6) << bytes_of(colour);
  return text.str();
}

Rgb class_colour(Colouring colouring, double value) {
  return colouring == Colouring::valence ? valence_colour(value) : mask_colour(value);
}

std::vector<ValueClass> classes_of(const std::vector<double>& values, Colouring colouring) {
  const bool valences = colouring == Colouring::valence;
  std::map<int, std::int64_t> counts;
  for (const double value : values)
    if (has_classes(colouring) && std::isfinite(value))
      ++counts[valences && value != boundary_valence
                   ? std::clamp(static_cast<int>(value), least_class, greatest_class)
                   : static_cast<int>(value)];
  std::vector<ValueClass> classes;
  for (const auto& [value, count] : counts) {
    const std::string label = valences && value == boundary_valence ? "at the boundary"
                              : valences && value == greatest_class ? std::to_string(value) + "+"
                                                                    : std::to_string(value);
    classes.push_back({class_colour(colouring, value), label, count});
  }
  return classes;
}

} // namespace calotte::tools
