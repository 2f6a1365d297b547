# SPDX-License-Identifier: GPL-3.0-or-later
# A shared library exports the public functions and hides the internal symbols of the rooms.
# Called with LIBRARY (a file) and NM.
cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND ${NM} -DC --defined-only ${LIBRARY} OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
if(NOT symbols MATCHES "calotte::write\\(")
  message(FATAL_ERROR "the shared library exports no calotte::write")
endif()
string(REGEX MATCHALL "[^\n]*calotte::[a-z]+_detail::[^\n]*" hidden "${symbols}")
if(hidden)
  list(JOIN hidden "\n" hidden)
  message(FATAL_ERROR "the shared library exports what it should hide:\n${hidden}")
endif()
