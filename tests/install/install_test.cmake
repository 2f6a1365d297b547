# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the built library and checks the installed files.
# Called with BUILD (the library's build tree) and PREFIX (where to install).
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${PREFIX})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${PREFIX} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)

# CGAL, oneTBB and so on are private dependencies: no public header includes them.
file(GLOB_RECURSE headers ${PREFIX}/include/*.h)
if(NOT headers)
  message(FATAL_ERROR "no header was installed")
endif()
foreach(header ${headers})
  file(STRINGS ${header} leaks REGEX "# *include *[<\"](CGAL|boost|tbb|oneapi|gmp|metis|netcdf|expat|zlib|shapefil)")
  if(leaks)
    message(FATAL_ERROR "${header} shows a private dependency: ${leaks}")
  endif()
endforeach()

# The command finds the library after the prefix is moved.
if(EXISTS ${PREFIX}/bin/calotte)
  file(RENAME ${PREFIX} ${PREFIX}-moved)
  execute_process(COMMAND ${PREFIX}-moved/bin/calotte --version RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  file(RENAME ${PREFIX}-moved ${PREFIX})
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "the installed command failed: ${output}")
  endif()
endif()

# The programs of JIGSAW's names find it.
if(EXISTS ${PREFIX}/bin/calotte)
  foreach(name jigsaw marche)
    execute_process(COMMAND ${PREFIX}/libexec/calotte/jigsaw/${name} --help OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
    if(NOT output MATCHES "calotte ${name}")
      message(FATAL_ERROR "the installed ${name} is not calotte ${name}: ${output}")
    endif()
  endforeach()
endif()
