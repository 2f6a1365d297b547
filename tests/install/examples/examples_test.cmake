# SPDX-License-Identifier: GPL-3.0-or-later
# Runs the programs of tools/examples/cpp and compares what they print.
# Called with SOURCES (their folder), PROGRAMS (where they are built), EMULATOR (that runs them, or empty) and SCRATCH.
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${SCRATCH})
file(MAKE_DIRECTORY ${SCRATCH})

# \param status the exit code. \param printed a regular expression of the output, the error stream aside.
function(expect status printed program)
  execute_process(COMMAND ${EMULATOR} ${PROGRAMS}/${program} ${ARGN} WORKING_DIRECTORY ${SCRATCH} RESULT_VARIABLE result
                  OUTPUT_VARIABLE output ERROR_VARIABLE errors)
  if(NOT result EQUAL status OR NOT output MATCHES "^${printed}$")
    message(SEND_ERROR "${program} ${ARGN} ended with ${result} and printed\n${output}${errors}")
  endif()
  set(errors "${errors}" PARENT_SCOPE)
  list(APPEND run ${program})
  set(run ${run} PARENT_SCOPE)
endfunction()

set(run "")
set(number "-?[0-9.]+(e-[0-9]+)?")
expect(0 "2000 points, 3996 triangles\ntriangle 0 has the corners +0 +[0-9]+ +[0-9]+ and the neighbours [ 0-9]+\n" triangulate 2000)
expect(0 "site 17 has the neighbours 4 9 22 30 38 25 12\n.*\nand ${number} steradians, on the Earth ${number} km\\^2\n" cells)
expect(0 "the width implies 589 cells\nconverged after [0-9]+ evaluations\n" grid 1000 grid.nc)
expect(0 "MPAS, of a sphere\n589 sites, 1174 triangles\nfield sine_of_latitude at cells, 589 numbers from ${number} to ${number} 1\n" file grid.nc)
expect(0 "the point is in cell [0-9]+, whose site.*\nand in triangle [0-9]+, with z = 0\\.744.* for 0\\.744.*\n" locate)
expect(0 "1000 cells, well-centred\n" density)

# What goes wrong says so.
expect(2 "" grid)
expect(1 "" grid -5 grid.nc)
if(NOT errors MATCHES "^[^\n]*width[^\n]*\n$")
  message(SEND_ERROR "a negative width: ${errors}")
endif()
expect(1 "" file missing.nc)
if(NOT errors MATCHES "missing\\.nc")
  message(SEND_ERROR "a missing file: ${errors}")
endif()
expect(3 ".*cancelled.*\n" density 3)

# Each is short, says what it shows, and is run above.
file(GLOB sources RELATIVE ${SOURCES} ${SOURCES}/*.cpp)
foreach(source ${sources})
  file(STRINGS ${SOURCES}/${source} lines)
  list(LENGTH lines count)
  list(GET lines 1 head)
  get_filename_component(name ${source} NAME_WE)
  if(count GREATER 40 OR NOT head MATCHES "^// [A-Z]" OR NOT name IN_LIST run)
    message(SEND_ERROR "${source} has ${count} lines, begins with '${head}', or is not run here")
  endif()
endforeach()
