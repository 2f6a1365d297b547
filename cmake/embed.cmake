# SPDX-License-Identifier: GPL-3.0-or-later
# Writes a C++ source that defines the parts of the page of calotte view. Called with OUTPUT, TEMPLATE, STYLE and SCRIPT.

cmake_minimum_required(VERSION 3.25)

set(text "// Generated from tools/view/page.\n#include \"view/page_parts.h\"\n\nnamespace calotte::tools {\n\n")
foreach(part template style script)
  string(TOUPPER ${part} file)
  file(READ ${${file}} bytes HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," bytes "${bytes}")
  string(APPEND text "constexpr char ${part}_bytes[] = {${bytes}'\\0'};\n"
    "const std::string_view page_${part}(${part}_bytes, sizeof ${part}_bytes - 1);\n\n")
endforeach()
string(APPEND text "} // namespace calotte::tools\n")
file(WRITE ${OUTPUT} "${text}")
