// SPDX-License-Identifier: GPL-3.0-or-later
#include "density/width_rules.h"
#include "base/message.h"
#include "density/width_profile.h"
#include "io/bytes/file_error.h"
#include "io/bytes/file_names.h"
#include "io/command.h"
#include "io/shapes/rule_table.h"
#include "io/toml.h"

#include <calotte/error.h>
#include <calotte/ocean.h>
#include <calotte/read.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace calotte {
namespace {

using base_detail::listed;
using base_detail::message;
using io_detail::fail_at;
using io_detail::RuleTable;

std::string folder_of(const std::string& path) {
  return std::filesystem::path(path).parent_path().string();
}

std::string beside(const std::string& path, const std::string& name) {
  return (std::filesystem::path(folder_of(path)) / name).string();
}

class RuleReader {
public:
  RuleReader(const std::string& path, const Surface& surface, double radius_km)
      : path_(path), surface_(surface), radius_km_(radius_km) {}

  WidthRules rules() {
    const toml::table root = read_toml(path_);
    const toml::table* const table = root["cell-width"].as_table();
    if (table == nullptr || root.size() != 1)
      io_detail::fail_file(path_,
                           "a file of widths has one table, [cell-width]; see calotte help widths");
    WidthRules rules;
    rules.widths = read_rule(*table, &rules);
    if (surface_.is_sphere() || !rules.gradient) // otherwise they are one raster
      rules.names = list_names(*table);
    return rules;
  }

  /// Whether the value of a key, of a rule or beside it, is the name of a file.
  static bool names_file(std::string_view key) {
    return std::ranges::any_of(
        sources(), [&](const Key& known) { return known.names_file && known.name == key; });
  }
  /// Whether it is a region.
  static bool names_region(std::string_view key) { return key == "share" || key == "within"; }

private:
  using Source = Widths (RuleReader::*)(RuleTable&);

  /// A key that names a rule, and the function that reads the rule.
  struct Key {
    std::string name;
    Source source;
    bool in_plane;   ///< whether the rule applies in a plane, too
    bool names_file; ///< whether its value is the name of a file
  };

  /// The keys that name rules. The first one that a table has applies.
  static const std::vector<Key>& sources() {
    static const std::vector<Key> all{{"minimum", nullptr, true, false}, // see read_rule()
                                      {"maximum", &RuleReader::greatest, true, false},
                                      {"sum", &RuleReader::sum, true, false},
                                      {"blend", &RuleReader::blend, true, false},
                                      {"by-latitude", &RuleReader::latitude, false, false},
                                      {"by-distance", &RuleReader::distance, true, true},
                                      {"around", &RuleReader::around, true, true},
                                      {"by-channel", &RuleReader::channel, false, true},
                                      {"by-depth", &RuleReader::depth, false, true},
                                      {"raster", &RuleReader::raster, true, true},
                                      {"polygons", &RuleReader::polygons, false, true},
                                      {"width", &RuleReader::constant, true, false}};
    return all;
  }

  /// \param all receives the keys of the whole file; null for a nested rule.
  Widths read_rule(const toml::table& given, WidthRules* all = nullptr) {
    RuleTable table(path_, given);
    std::optional<double> step;
    if (all != nullptr && table.take("step") != nullptr)
      step = table.number("step");
    if (all != nullptr && given.contains("gradient"))
      all->gradient = table.number("gradient");
    const bool in_domain = all != nullptr && !surface_.is_sphere() && all->gradient;
    const auto& [key, source, in_plane, names_file] = find_source(given);
    if (!in_plane && !surface_.is_sphere())
      table.refuse(key, "applies to the sphere only; in a plane give by-distance, around, raster "
                        "or width");
    // A change of a minimum is applied to each of its rules, so that active_rules() distinguishes
    // them.
    const bool least = key == "minimum";
    std::vector<Widths> rules =
        least ? parts(table, key) : std::vector{table.made([&, source = source] {
          Widths made = (this->*source)(table).on_sphere(radius_km_);
          made.rule(); // report its errors with this table
          return made;
        })};
    table.made([&] { change(table, rules, in_domain); });
    table.require_all_taken();
    Widths widths = Widths::minimum(rules);
    if (step)
      widths = widths.with_step(*step);
    return in_domain ? io_detail::named(
                           path_, [&] { return widths.limit_gradient(*all->gradient, surface_); })
                     : widths;
  }

  const Key& find_source(const toml::table& rule) const {
    std::vector<std::string> keys;
    for (const auto& known : sources()) {
      if (rule.contains(known.name))
        return known;
      keys.push_back(known.name);
    }
    if (rule.empty())
      fail_at(path_, rule.source().begin.line, "a rule has one of the keys {}", listed(keys));
    const toml::key& other = rule.begin()->first;
    fail_at(path_, other.source().begin.line, "a rule has one of the keys {}; this one has {}",
            listed(keys), std::string_view(other.str()));
  }

  /// The names of the rules of a minimum, or of the one rule, such as "by-distance coast.geojson".
  std::vector<std::string> list_names(const toml::table& rule) const {
    const std::string key = find_source(rule).name;
    if (key != "minimum") {
      const std::optional<std::string> file = rule[key].value_exact<std::string>();
      const std::optional<double> number = rule[key].value<double>();
      return {file ? message("{} {}", key, *file) : number ? message("{} {}", key, *number) : key};
    }
    std::vector<std::string> names;
    for (const toml::node& item : *rule[key].as_array())
      names.push_back(item.is_table() ? listed(list_names(*item.as_table()))
                                      : message("width {}", item.value_or(0.0)));
    return names;
  }

  /// Applies the keys that any rule may have: a part of the sphere, a factor, limits.
  /// \param in_domain whether the gradient of all rules is limited together, in their domain.
  void change(RuleTable& table, std::vector<Widths>& rules, bool in_domain) {
    const auto each = [&](const auto& changed) {
      std::transform(rules.begin(), rules.end(), rules.begin(), changed);
    };
    table.require_least_below_most();
    if (table.takes("times"))
      each([factor = table.number("times")](const Widths& rule) { return rule.times(factor); });
    if (table.takes("least")) // unless the rule has used it
      each([least = table.number("least")](const Widths& rule) {
        return Widths::maximum({rule, least});
      });
    if (table.takes("most"))
      each([most = table.number("most")](const Widths& rule) {
        return Widths::minimum({rule, most});
      });
    if (table.take("within") != nullptr) // also if a raster has been read for it
      each([share = share_in(region(table, "within"))](const Widths& rule) {
        return Widths::where(share, rule, Widths::no_demand);
      });
    if (!in_domain && table.take("gradient") != nullptr)
      each([gradient = table.number("gradient")](const Widths& rule) {
        return rule.limit_gradient(gradient);
      });
  }

  std::string file(RuleTable& table, const std::string& key) {
    return beside(path_, table.text(key, "the name of a file"));
  }

  /// The word of a region, or a raster of shares.
  std::string region(RuleTable& table, const std::string& key) {
    const std::string word = table.text(key, "a region");
    return surface_.is_sphere() ? region_beside(folder_of(path_), word) : beside(path_, word);
  }

  std::vector<Widths> parts(RuleTable& table, const std::string& key) {
    const toml::array* const list = table.take(key)->as_array();
    std::vector<Widths> parts;
    if (list != nullptr)
      for (const toml::node& item : *list) {
        if (const toml::table* const inner = item.as_table())
          parts.push_back(read_rule(*inner));
        else if (const std::optional<double> width = item.value<double>();
                 width && std::isfinite(*width))
          parts.push_back(table.made([&] { return Widths(*width); }));
        else
          table.refuse(key, "holds something else than rules; give [{...}, {...}]");
      }
    if (parts.empty())
      table.refuse(key, "holds no rules; give [{...}, {...}]");
    return parts;
  }

  Widths greatest(RuleTable& table) { return Widths::maximum(parts(table, "maximum")); }
  Widths sum(RuleTable& table) { return Widths::sum(parts(table, "sum")); }

  Widths blend(RuleTable& table) {
    const std::vector<Widths> both = parts(table, "blend");
    if (both.size() != 2)
      table.refuse("blend", message("holds {} rules; give [A, B]", both.size()));
    return Widths::blend(both[0], both[1], share(table));
  }

  /// Reads a part of the sphere or of the plane.
  Surface part_in(const std::string& path) const {
    return surface_.is_sphere() ? read_region(path, radius_km_) : read_domain(path);
  }

  bool is_raster_of_shares(const std::string& path) const {
    return surface_.is_sphere() && std::filesystem::path(path).extension() == ".nc";
  }

  /// Reads the share of such a part, or of a raster.
  WidthShare share_in(const std::string& path) const {
    if (is_raster_of_shares(path))
      return read_raster(path, {.quantity = RasterQuantity::land_fraction});
    return part_in(path);
  }

  WidthShare share(RuleTable& table) {
    const std::string path = region(table, "share");
    if (table.has("variable"))
      return read_raster(path, {.variable = table.text("variable", "its name"),
                                .quantity = RasterQuantity::land_fraction});
    if (!table.has("profile") && !table.has("over"))
      return share_in(path);
    const WidthProfile profile =
        table.has("profile")
            ? table.pairs("profile")
            : WidthProfile{{{0, 1}, {distance_of(table, "over"), 0}}, table.smooth()};
    const bool is_coast = std::filesystem::path(path).extension() == ".nc"; // of GSHHG
    if (surface_.is_sphere() && (is_coast || table.has("least-area")))
      return WidthShare(coast(table, path), profile);
    return WidthShare(part_in(path), profile);
  }

  Widths constant(RuleTable& table) { return table.number("width"); }
  Widths latitude(RuleTable& table) { return Widths::by_latitude(table.pairs("by-latitude")); }

  Widths distance(RuleTable& table) {
    const std::string path = file(table, "by-distance");
    const WidthProfile profile = table.has("profile") ? table.pairs("profile") : growing(table);
    if (surface_.is_sphere() && table.has("side"))
      return Widths::by_distance(coast(table, path), profile, side(table));
    if (surface_.is_sphere() && profile.nodes.front()[0] < 0)
      return Widths::by_distance(coast(table, path), profile);
    return Widths::by_distance(surface_.is_sphere() && table.has("least-area")
                                   ? shores(coast(table, path))
                                   : read_shapes(path, surface_),
                               profile, surface_);
  }

  /// Reads a coast, without what is smaller than the area that the rule gives.
  Coast coast(RuleTable& table, const std::string& path) const {
    const Coast whole = read_coast(path);
    return table.takes("least-area") ? without_small(whole, table.number("least-area"), radius_km_)
                                     : whole;
  }

  /// A distance in km, in a plane in its unit.
  double distance_of(RuleTable& table, const std::string& key) const {
    const double distance = table.number(key);
    if (surface_.is_sphere() && distance > density_detail::farthest_on_sphere)
      table.refuse(key, message("is {} km, and distances are 0 to {}; give km, not metres",
                                distance, density_detail::farthest_on_sphere));
    return distance;
  }

  WidthProfile growing(RuleTable& table) const {
    const double near = table.number("near"), far = table.number("far"),
                 over = distance_of(table, "over");
    return {{{0, near}, {over, far}}, table.smooth()};
  }

  static CoastSide side(RuleTable& table) {
    const std::string word = table.text("side", "sea or land");
    if (word != "sea" && word != "land")
      table.refuse("side", message("is \"{}\"; give sea or land", word));
    return word == "sea" ? CoastSide::sea : CoastSide::land;
  }

  Widths around(RuleTable& table) {
    const std::string path = file(table, "around");
    const double width = table.number("width"), over = distance_of(table, "over");
    return Widths::around(read_shapes(path, surface_), width, over, surface_);
  }

  Widths channel(RuleTable& table) {
    const std::string path = file(table, "by-channel");
    ChannelRule rule{.cells = table.number("cells"), .least = table.number("least")};
    if (table.take("widest") != nullptr)
      rule.widest = table.number("widest");
    return Widths::by_channel(coast(table, path), rule);
  }

  /// What a raster of a rule must cover: the region of `within`, if it is one, or all.
  Surface covered(RuleTable& table) {
    if (!surface_.is_sphere())
      return Surface::plane();
    const std::string path = table.has("within") ? region(table, "within") : "";
    return path.empty() || is_raster_of_shares(path) ? Surface() : part_in(path);
  }

  Widths depth(RuleTable& table) {
    const std::string path = file(table, "by-depth");
    const Raster raster = read_raster(
        path, {.variable = table.has("variable") ? table.text("variable", "its name") : "",
               .quantity = RasterQuantity::height,
               .surface = covered(table)});
    DepthRule rule{.least = table.number("least")};
    if (table.has("period")) {
      rule.period = seconds(table);
      rule.cells = table.number("cells");
    } else {
      const bool rossby = table.has("rossby");
      rule.kind = rossby ? DepthRule::Kind::rossby : DepthRule::Kind::slope;
      rule.cells = table.number(rossby ? "rossby" : "slope");
    }
    return Widths::by_depth(raster, rule);
  }

  static double seconds(RuleTable& table) {
    const std::string text = table.text("period", "a time such as 12.42h");
    try {
      return seconds_in(text);
    } catch (const Error& error) {
      table.refuse("period", error.what());
    }
  }

  /// A file of a rule, which must not be a file of rules: these could name each other without end.
  std::string require_no_rules(RuleTable& table, const std::string& key) {
    std::string path = file(table, key);
    if (has_rules(path))
      table.refuse(key, "is a file of rules; write its rules in this file");
    return path;
  }

  Widths raster(RuleTable& table) {
    const std::string path = require_no_rules(table, "raster");
    const Surface part = covered(table);
    if (table.has("variable"))
      return read_raster(path, {.variable = table.text("variable", "its name"),
                                .quantity = RasterQuantity::cell_width,
                                .surface = part});
    return read_cell_width(path, {}, part);
  }

  Widths polygons(RuleTable& table) {
    const std::string path = require_no_rules(table, "polygons");
    PolygonWidths widths{.radius_km = radius_km_};
    for (const auto& [key, value] : {std::pair{"inside", &widths.inside},
                                     {"outside", &widths.outside},
                                     {"transition", &widths.transition}})
      if (table.take(key) != nullptr)
        *value = table.number(key);
    return read_cell_width(path, widths);
  }

  const std::string& path_;
  const Surface& surface_;
  double radius_km_;
};

} // namespace

bool has_rules(const std::string& path) { return io_detail::suffix_of(path) == ".toml"; }

WidthRules read_width_rules(const std::string& path, const Surface& surface, double radius_km) {
  return RuleReader(path, surface, radius_km).rules();
}

Widths read_widths(const std::string& path, const PolygonWidths& polygons, const Surface& surface) {
  if (!has_rules(path))
    return read_cell_width(path, polygons, surface);
  return read_width_rules(path, surface, polygons.radius_km).widths;
}

std::vector<std::string> files_of_rules(const std::string& path) {
  const toml::table root = read_toml(path);
  std::vector<std::string> files;
  const auto add = [&](const auto& self, const toml::node& node) -> void {
    if (const toml::array* const list = node.as_array())
      for (const toml::node& item : *list)
        self(self, item);
    if (const toml::table* const table = node.as_table())
      for (const auto& [key, value] : *table) {
        const auto* const text = value.as_string();
        if (text != nullptr && RuleReader::names_file(key.str()))
          files.push_back(beside(path, text->get()));
        else if (text != nullptr && RuleReader::names_region(key.str()))
          if (std::string file = region_file(region_beside(folder_of(path), text->get()));
              !file.empty())
            files.push_back(std::move(file));
        self(self, value);
      }
  };
  add(add, root);
  return files;
}

} // namespace calotte
