// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "calls.h"

#include <calotte/error.h>
#include <calotte/grid.h>

#include <algorithm>
#include <span>
#include <string>

/// Attributes that are words in Python, and values of an enumeration in C++.
namespace calotte::python {

/// \throws Error invalid_argument, with the words that there are.
template <class Value>
Value named(std::span<const NamedValue<Value>> words, const std::string& word,
            const std::string& what) {
  std::string names;
  for (const NamedValue<Value>& known : words) {
    if (known.word == word)
      return known.value;
    names += (names.empty() ? "" : ", ") + std::string(known.word);
  }
  throw Error(ErrorCode::invalid_argument, "no " + what + " " + word + "; give one of: " + names);
}

template <class Value> std::string word_in(std::span<const NamedValue<Value>> words, Value value) {
  return std::string(std::ranges::find(words, value, &NamedValue<Value>::value)->word);
}

/// A field of a type, or of a part of it, as an attribute.
/// \param what it is, in messages. \param field returns a reference to it.
template <class Type, class Value, class Field>
void add_word(py::class_<Type>& type, const char* name, const std::string& what,
              std::span<const NamedValue<Value>> words, const Field& field) {
  type.def_property(
      name, [=](const Type& of) { return word_in(words, field(of)); },
      [=](Type& of, const std::string& word) { field(of) = named(words, word, what); });
}

} // namespace calotte::python
