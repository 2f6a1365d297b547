# SPDX-License-Identifier: GPL-3.0-or-later
# Writes a C++ source that defines the bytes of files, which HEADER declares, as std::string_view of calotte::tools. Called
# with OUTPUT, HEADER and FILES, a list of NAME=PATH.

cmake_minimum_required(VERSION 3.25)

set(text "// Generated.\n#include \"${HEADER}\"\n\nnamespace calotte::tools {\n\n")
foreach(entry ${FILES})
  string(REGEX MATCH "^([^=]+)=(.*)$" entry "${entry}")
  set(name ${CMAKE_MATCH_1})
  file(READ ${CMAKE_MATCH_2} bytes HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," bytes "${bytes}")
  string(APPEND text "constexpr char ${name}_bytes[] = {${bytes}'\\0'};\n"
    "const std::string_view ${name}(${name}_bytes, sizeof ${name}_bytes - 1);\n\n")
endforeach()
string(APPEND text "} // namespace calotte::tools\n")
file(WRITE ${OUTPUT} "${text}")
