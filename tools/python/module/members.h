// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "arrays.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <type_traits>
#include <vector>

namespace calotte::python {

/// A data member of a struct as an attribute of its class in Python.
template <class Struct, class Value> struct Member {
  const char* name;
  Value Struct::*pointer;
  const char* doc;             ///< what it is, with shape and unit
  const char* begin = nullptr; ///< of lists: what the attribute `begin` is, if they give it
};

template <class Value> struct IsArray : std::is_base_of<Eigen::MatrixBase<Value>, Value> {};
template <class Scalar> struct IsArray<std::vector<Scalar>> : std::true_type {};

/// A read-only attribute; arrays are views of the struct's memory.
template <class Class, class Struct, class Value>
void add_member(Class& type, const Member<Struct, Value>& member) {
  if constexpr (IsArray<Value>::value)
    type.def_property_readonly(
        member.name,
        [pointer = member.pointer](py::object self) {
          return view(self.cast<const Struct&>().*pointer, self);
        },
        member.doc);
  else
    type.def_readonly(member.name, member.pointer, member.doc);
}

/// The items of lists, and where these begin.
template <class Class, class Struct>
void add_member(Class& type, const Member<Struct, IdLists>& member) {
  const auto add = [&](const char* name, auto part, const char* doc) {
    type.def_property_readonly(
        name,
        [pointer = member.pointer, part](py::object self) {
          return view(self.cast<const Struct&>().*pointer.*part, self);
        },
        doc);
  };
  if (member.begin != nullptr)
    add("begin", &IdLists::begin, member.begin);
  add(member.name, &IdLists::items, member.doc);
}

/// Attributes for all members, and with them the pickled form.
template <class Class, class Struct, class... Values>
void add_members(Class& type, const Member<Struct, Values>&... members) {
  (add_member(type, members), ...);
  type.def(py::pickle(
      [members...](const Struct& from) { return py::make_tuple(from.*members.pointer...); },
      [members...](const py::tuple& state) {
        Struct to;
        std::size_t place = 0;
        ((to.*members.pointer = state[place++].template cast<Values>()), ...);
        return to;
      }));
}

} // namespace calotte::python
