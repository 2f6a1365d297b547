# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the built library and checks the installed files.
# Called with BUILD (the library's build tree), PREFIX (where to install), TYPE (of the library's target) and NM.
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${PREFIX})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${PREFIX} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)

# CGAL, oneTBB and so on are private dependencies: no public header includes them.
file(GLOB_RECURSE headers ${PREFIX}/include/*.h)
if(NOT headers)
  message(FATAL_ERROR "no header was installed")
endif()
foreach(header ${headers})
  file(STRINGS ${header} leaks REGEX "# *include *[<\"](CGAL|boost|tbb|oneapi|gmp|netcdf|expat|zlib)")
  if(leaks)
    message(FATAL_ERROR "${header} shows a private dependency: ${leaks}")
  endif()
endforeach()

# Internal symbols of the rooms are not exported.
if(TYPE STREQUAL "SHARED_LIBRARY")
  file(GLOB_RECURSE library ${PREFIX}/*/libcalotte.so)
  execute_process(COMMAND ${NM} -DC --defined-only ${library} OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
  if(NOT symbols MATCHES "calotte::write\\(")
    message(FATAL_ERROR "the shared library exports no calotte::write")
  endif()
  string(REGEX MATCHALL "[^\n]*calotte::[a-z]+_detail::[^\n]*" hidden "${symbols}")
  if(hidden)
    list(JOIN hidden "\n" hidden)
    message(FATAL_ERROR "the shared library exports what it should hide:\n${hidden}")
  endif()
endif()

# The command finds the library after the prefix is moved.
if(EXISTS ${PREFIX}/bin/calotte)
  file(RENAME ${PREFIX} ${PREFIX}-moved)
  execute_process(COMMAND ${PREFIX}-moved/bin/calotte --version RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  file(RENAME ${PREFIX}-moved ${PREFIX})
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "the installed command failed: ${output}")
  endif()
endif()
