// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/fields/carried.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <sstream>
#include <utility>

namespace calotte::io_detail {
namespace {

using Names = std::set<std::string>;

bool contains_all(const Names& names, const std::vector<std::string>& some) {
  return std::ranges::all_of(some, [&](const std::string& name) { return names.contains(name); });
}

bool contains_any(const Names& names, const std::vector<std::string>& some) {
  return std::ranges::any_of(some, [&](const std::string& name) { return names.contains(name); });
}

Names read_words(const NetcdfReader& file, const std::string& variable, const char* attribute) {
  std::istringstream text(file.text(variable, attribute));
  Names words;
  for (std::string word; text >> word;)
    words.insert(word);
  return words;
}

/// Adds the names of variables that the attributes of a variable contain.
void add_named(const NetcdfReader& file, const std::string& variable, Names& named) {
  for (const char* const attribute : {"coordinates", "bounds", "climatology", "formula_terms"})
    named.merge(read_words(file, variable, attribute));
}

class Carriers {
public:
  Carriers(const NetcdfReader& file, const std::vector<MeshField>& fields) : file_(file) {
    for (const MeshField& field : fields) {
      if (file.has_variable(field.name))
        fields_.insert(field.name);
      for (const FieldDimension& dimension : field.dimensions)
        own_.insert(dimension.name);
    }
    for (const std::string& field : fields_) {
      add_named(file, field, named_);
      for (const std::string& dimension : file.dimensions_of(field))
        if (!own_.contains(dimension))
          of_location_.insert(dimension);
    }
  }

  std::vector<Carried> variables() {
    Names selected;
    for (const NetcdfVariable& variable : file_.variables())
      if (belongs(variable))
        select(variable.name, selected);
    // These name others in turn: a level names its bounds and terms.
    std::size_t before = 0;
    do {
      before = selected.size();
      for (const NetcdfVariable& variable : file_.variables())
        if (named_.contains(variable.name) && can_be_carried(variable))
          select(variable.name, selected);
    } while (before != selected.size());
    std::vector<Carried> out;
    for (const NetcdfVariable& variable : file_.variables()) // in the order of the file
      if (selected.contains(variable.name))
        out.push_back(read(variable));
    return out;
  }

private:
  void select(const std::string& name, Names& selected) {
    if (selected.insert(name).second)
      add_named(file_, name, named_);
  }

  bool can_be_carried(const NetcdfVariable& variable) const {
    const std::vector<std::int64_t> shape = file_.shape_of(variable.name);
    return variable.type && !fields_.contains(variable.name) &&
           !contains_any(of_location_, file_.dimensions_of(variable.name)) &&
           std::ranges::find(shape, 0) == shape.end();
  }

  bool belongs(const NetcdfVariable& variable) const {
    const std::vector<std::string> dimensions = file_.dimensions_of(variable.name);
    return can_be_carried(variable) && !dimensions.empty() &&
           (contains_all(own_, dimensions) ||
            (variable.type == NetcdfType::text && own_.contains(dimensions.front())));
  }

  Carried read(const NetcdfVariable& variable) const {
    const int id = file_.find(variable.name);
    const std::size_t rank = variable.dimensions.size();
    Carried out{variable.name, *variable.type, {}, variable.attributes, {}, {}};
    for (const std::string& name : file_.dimensions_of(variable.name))
      out.dimensions.push_back({name, file_.dimension(name), file_.is_unlimited(name)});
    for (const std::string& field : fields_)
      if (read_words(file_, field, "coordinates").contains(variable.name))
        out.of.push_back(field);
    out.bytes.resize(static_cast<std::size_t>(file_.product(id, 0, rank) * size_of(out.type)));
    file_.stored_rows(id, 0, 0, rank > 0 ? out.dimensions.front().size : 1, out.bytes.data());
    return out;
  }

  const NetcdfReader& file_;
  Names fields_, own_, of_location_, named_;
};

} // namespace

std::vector<Carried> carried_with(const NetcdfReader& file, const std::vector<MeshField>& fields) {
  return Carriers(file, fields).variables();
}

} // namespace calotte::io_detail
