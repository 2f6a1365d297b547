// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/width_rules.h"

#include "options/numbers.h"
#include "options/toml_file.h"
#include "text/text.h"

#include <calotte/error.h>
#include <calotte/ocean.h>
#include <calotte/read.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <utility>

namespace calotte::tools {
namespace {

std::string beside(const std::string& path, const std::filesystem::path& name) {
  return (std::filesystem::path(path).parent_path() / name).string();
}

/// One table of a file, whose keys are taken one after the other.
class RuleTable {
public:
  RuleTable(const std::string& path, const toml::table& table) : path_(path), table_(table) {}

  bool has(const std::string& key) const { return table_.contains(key); }

  [[noreturn]] void refuse(const std::string& key, const std::string& problem) const {
    const toml::node* const node = table_.get(key);
    refuse_line(path_, (node != nullptr ? node->source() : table_.source()).begin.line,
                key + " " + problem);
  }

  const toml::node* take(const std::string& key) {
    taken_.insert(key);
    return table_.get(key);
  }

  double number(const std::string& key) {
    const toml::node* const node = take(key);
    if (node == nullptr)
      refuse_line(path_, table_.source().begin.line, "the rule needs " + key + "; give a number");
    const std::optional<double> value = node->value<double>();
    if (!value || !(*value > 0) || !std::isfinite(*value))
      refuse(key, "is not a positive number; give one");
    return *value;
  }

  std::string text(const std::string& key, const std::string& what) {
    const toml::node* const node = take(key);
    const std::optional<std::string> value = node ? node->value_exact<std::string>() : std::nullopt;
    if (!value || value->empty())
      refuse(key, "is no text; give " + what + " in quotes");
    return *value;
  }

  WidthProfile::Between between() {
    if (!has("between"))
      return WidthProfile::Between::linear;
    const std::string word = text("between", "linear or smooth");
    if (word != "linear" && word != "smooth")
      refuse("between", "is \"" + word + "\"; give linear or smooth");
    return word == "smooth" ? WidthProfile::Between::smooth : WidthProfile::Between::linear;
  }

  /// Pairs of numbers.
  WidthProfile pairs(const std::string& key) {
    const toml::node* const node = take(key);
    WidthProfile profile;
    if (const toml::array* const list = node->as_array())
      for (const toml::node& item : *list) {
        const toml::array* const pair = item.as_array();
        const auto at = [&](std::size_t k) {
          return pair != nullptr && pair->size() == 2 ? (*pair)[k].value<double>() : std::nullopt;
        };
        if (!at(0) || !at(1))
          refuse(key, "holds no pair at place " + std::to_string(profile.nodes.size()) +
                          "; give [[number, width], ...]");
        profile.nodes.push_back({*at(0), *at(1)});
      }
    if (profile.nodes.empty())
      refuse(key, "holds no pairs; give [[number, width], ...]");
    profile.between = between();
    return profile;
  }

  /// \throws Error parse for a key that nobody took.
  void require_all_taken() const {
    for (const auto& [key, node] : table_)
      if (!taken_.contains(std::string(key.str())))
        refuse_line(path_, key.source().begin.line,
                    "the rule does not take " + std::string(key.str()) + "; it takes " +
                        joined({taken_.begin(), taken_.end()}) + "; see calotte help widths");
  }

  /// With the place in the file before what the library refuses.
  template <class Make> Widths made(const Make& make) const {
    try {
      return make();
    } catch (const Error& error) {
      if (error.code() != ErrorCode::invalid_argument)
        throw;
      refuse_line(path_, table_.source().begin.line, error.what());
    }
  }

private:
  const std::string& path_;
  const toml::table& table_;
  std::set<std::string> taken_;
};

class RuleReader {
public:
  explicit RuleReader(const std::string& path) : path_(path) {}

  WidthRules rules() {
    const toml::table root = read_toml(path_);
    const toml::table* const table = root["cell-width"].as_table();
    if (table == nullptr || root.size() != 1)
      throw Error(ErrorCode::parse,
                  path_ +
                      ": a file of widths has one table, [cell-width]; see calotte help widths");
    double step = 0;
    Widths widths = rule_of(*table, &step);
    return {std::move(widths), step};
  }

private:
  using Source = Widths (RuleReader::*)(RuleTable&);

  /// A rule has one of these keys, which says what it is; the first that is there.
  static const std::vector<std::pair<std::string, Source>>& sources() {
    static const std::vector<std::pair<std::string, Source>> all{
        {"min", &RuleReader::least},         {"max", &RuleReader::greatest},
        {"sum", &RuleReader::sum},           {"blend", &RuleReader::blend},
        {"latitude", &RuleReader::latitude}, {"distance-to", &RuleReader::distance},
        {"lines", &RuleReader::lines},       {"channels", &RuleReader::channels},
        {"heights", &RuleReader::heights},   {"raster", &RuleReader::raster},
        {"polygons", &RuleReader::polygons}, {"width", &RuleReader::constant}};
    return all;
  }

  /// \param step takes the key of that name; null where a rule has none.
  Widths rule_of(const toml::table& given, double* step = nullptr) {
    RuleTable table(path_, given);
    if (step != nullptr && table.take("step") != nullptr)
      *step = table.number("step");
    for (const auto& [key, source] : sources())
      if (table.has(key))
        return changed(table, table.made([&] { return (this->*source)(table); }));
    std::vector<std::string> keys;
    for (const auto& [key, source] : sources())
      keys.push_back(key);
    refuse_line(path_, given.source().begin.line, "a rule has one of the keys " + joined(keys));
  }

  /// What any rule may have: a part of the sphere, a factor, limits.
  Widths changed(RuleTable& table, Widths widths) {
    if (table.take("times") != nullptr)
      widths = Widths::product(widths, table.number("times"));
    if (table.take("least") != nullptr)
      widths = Widths::maximum({widths, table.number("least")});
    if (table.take("most") != nullptr)
      widths = Widths::minimum({widths, table.number("most")});
    if (table.take("within") != nullptr)
      widths = Widths::where(share_in(file(table, "within")), widths, Widths::no_demand);
    if (table.take("gradient") != nullptr)
      widths = widths.limit_gradient(table.number("gradient"));
    table.require_all_taken();
    return widths;
  }

  std::string file(RuleTable& table, const std::string& key) {
    const std::filesystem::path name = table.text(key, "the name of a file");
    return beside(path_, name);
  }

  std::vector<Widths> parts(RuleTable& table, const std::string& key) {
    const toml::array* const list = table.take(key)->as_array();
    std::vector<Widths> parts;
    if (list != nullptr)
      for (const toml::node& item : *list) {
        if (const toml::table* const inner = item.as_table())
          parts.push_back(rule_of(*inner));
        else if (const std::optional<double> width = item.value<double>())
          parts.push_back(table.made([&] { return Widths(*width); }));
        else
          table.refuse(key, "holds something else than rules; give [{...}, {...}]");
      }
    if (parts.empty())
      table.refuse(key, "holds no rules; give [{...}, {...}]");
    return parts;
  }

  Widths least(RuleTable& table) { return Widths::minimum(parts(table, "min")); }
  Widths greatest(RuleTable& table) { return Widths::maximum(parts(table, "max")); }
  Widths sum(RuleTable& table) { return Widths::sum(parts(table, "sum")); }

  Widths blend(RuleTable& table) {
    const std::vector<Widths> both = parts(table, "blend");
    if (both.size() != 2)
      table.refuse("blend", "holds " + std::to_string(both.size()) + " rules; give [A, B]");
    return Widths::blend(both[0], both[1], share(table));
  }

  /// Of a region, or of a raster.
  static Share share_in(const std::string& path) {
    if (std::filesystem::path(path).extension() == ".nc")
      return read_land_raster(path, {}, RasterValues::land_fraction);
    return read_region(path);
  }

  Share share(RuleTable& table) {
    const std::string path = file(table, "share");
    if (table.has("variable"))
      return read_land_raster(path, table.text("variable", "its name"),
                              RasterValues::land_fraction);
    if (table.has("profile"))
      return Share(read_region(path), table.pairs("profile"));
    if (table.take("over") != nullptr) {
      const double over = table.number("over");
      return Share(read_region(path), {{{0, 1}, {over, 0}}, table.between()});
    }
    return share_in(path);
  }

  Widths constant(RuleTable& table) { return table.number("width"); }
  Widths latitude(RuleTable& table) { return Widths::by_latitude(table.pairs("latitude")); }

  Widths distance(RuleTable& table) {
    const std::string path = file(table, "distance-to");
    const WidthProfile profile = table.has("profile") ? table.pairs("profile") : growing(table);
    if (table.has("side"))
      return Widths::by_coast(read_coast(path), profile, side(table));
    return profile.nodes.front()[0] < 0 ? Widths::by_coast(read_coast(path), profile)
                                        : Widths::by_distance(read_shapes(path), profile);
  }

  static WidthProfile growing(RuleTable& table) {
    const double near = table.number("near"), far = table.number("far"),
                 over = table.number("over");
    return {{{0, near}, {over, far}}, table.between()};
  }

  static CoastSide side(RuleTable& table) {
    const std::string word = table.text("side", "sea or land");
    if (word != "sea" && word != "land")
      table.refuse("side", "is \"" + word + "\"; give sea or land");
    return word == "sea" ? CoastSide::sea : CoastSide::land;
  }

  /// A band about lines; beyond it the rule says nothing.
  Widths lines(RuleTable& table) {
    const std::string path = file(table, "lines");
    const double width = table.number("width"), over = table.number("over");
    constexpr double edge = 1e-6; // km
    return Widths::by_distance(read_shapes(path),
                               {{{0, width}, {over, width}, {over + edge, Widths::no_demand}}});
  }

  Widths channels(RuleTable& table) {
    const std::string path = file(table, "channels");
    ChannelRule rule{.cells = table.number("cells"), .least = table.number("least")};
    if (table.take("widest") != nullptr)
      rule.widest = table.number("widest");
    return Widths::by_channel(read_coast(path), rule);
  }

  Widths heights(RuleTable& table) {
    const std::string path = file(table, "heights");
    const HeightRaster raster =
        read_heights(path, table.has("variable") ? table.text("variable", "its name") : "");
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
    const std::optional<Measure> measure = measure_of(text);
    constexpr std::array<std::pair<std::string_view, double>, 4> units{
        {{"s", 1}, {"min", 60}, {"h", 3600}, {"d", 86400}}};
    const auto* const unit = std::find_if(units.begin(), units.end(), [&](const auto& known) {
      return measure && known.first == measure->unit;
    });
    if (unit == units.end() || !(measure->value > 0))
      table.refuse("period", "is \"" + text +
                                 "\"; give a time with its unit, s, min, h or d, such as 12.42h");
    return measure->value * unit->second;
  }

  Widths raster(RuleTable& table) { return read_cell_width(file(table, "raster")); }

  Widths polygons(RuleTable& table) {
    const std::string path = file(table, "polygons");
    PolygonWidths widths;
    for (const auto& [key, value] : {std::pair{"inside", &widths.inside},
                                     {"outside", &widths.outside},
                                     {"transition", &widths.transition}})
      if (table.take(key) != nullptr)
        *value = table.number(key);
    return read_cell_width(path, widths);
  }

  const std::string& path_;
};

} // namespace

WidthRules read_width_rules(const std::string& path) { return RuleReader(path).rules(); }

RulesOutline outline_of_rules(const std::string& path) {
  const toml::table root = read_toml(path);
  RulesOutline outline{{}, root["cell-width"]["gradient"].value<double>()};
  const auto add = [&](const auto& self, const toml::node& node) -> void {
    if (const toml::array* const list = node.as_array())
      for (const toml::node& item : *list)
        self(self, item);
    if (const toml::table* const table = node.as_table())
      for (const auto& [key, value] : *table) {
        static const std::set<std::string_view> named{
            "distance-to", "lines", "raster", "channels", "heights", "polygons", "share", "within"};
        if (const auto* const text = value.as_string(); text && named.contains(key.str()))
          outline.files.push_back(beside(path, text->get()));
        self(self, value);
      }
  };
  add(add, root);
  return outline;
}

} // namespace calotte::tools
