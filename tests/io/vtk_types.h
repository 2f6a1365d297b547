// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>

namespace calotte::test {

/// What VTK's XML files call the types of PLY and of legacy VTK files.
inline const std::map<std::string, std::string> vtk_types{
    {"char", "Int8"},           {"int8", "Int8"},           {"uchar", "UInt8"},
    {"uint8", "UInt8"},         {"unsigned_char", "UInt8"}, {"short", "Int16"},
    {"int16", "Int16"},         {"ushort", "UInt16"},       {"uint16", "UInt16"},
    {"int", "Int32"},           {"int32", "Int32"},         {"vtkIdType", "Int32"},
    {"uint", "UInt32"},         {"uint32", "UInt32"},       {"unsigned_short", "UInt16"},
    {"unsigned_int", "UInt32"}, {"long", "Int64"},          {"vtktypeint64", "Int64"},
    {"float", "Float32"},       {"float32", "Float32"},     {"double", "Float64"},
    {"float64", "Float64"}};

} // namespace calotte::test
