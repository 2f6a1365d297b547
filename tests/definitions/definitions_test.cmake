# SPDX-License-Identifier: GPL-3.0-or-later
# The rule of one definition: no name of the library, the command and a program of the tests means two things. gcc compares the
# types and functions of all objects when it reads them for optimisation at link time; no code is made.
# Called with CXX (gcc), OBJECTS (a file that lists objects compiled with -flto) and SCRATCH.
cmake_minimum_required(VERSION 3.25)
file(MAKE_DIRECTORY ${SCRATCH})

# Sets `result` and `output`.
function(compare objects)
  execute_process(COMMAND ${CXX} -flto -Wodr -Werror=odr -Werror=lto-type-mismatch -r -flinker-output=rel -nostdlib
                          -o ${SCRATCH}/all.o ${objects}
                  RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  set(result "${result}" PARENT_SCOPE)
  set(output "${output}" PARENT_SCOPE)
endfunction()

# A type with two layouts must be found.
foreach(member one two)
  file(WRITE ${SCRATCH}/${member}.cpp
       "namespace sample { struct Tally { int ${member} = 1; }; }\nint count_${member}(sample::Tally t) { return t.${member}; }\n")
  execute_process(COMMAND ${CXX} -flto -c ${SCRATCH}/${member}.cpp -o ${SCRATCH}/${member}.o COMMAND_ERROR_IS_FATAL ANY)
endforeach()
compare("${SCRATCH}/one.o;${SCRATCH}/two.o")
if(result EQUAL 0 OR NOT output MATCHES "Tally.* violates the C\\+\\+ One Definition Rule")
  message(FATAL_ERROR "a type with two layouts was not found:\n${output}")
endif()

compare(@${OBJECTS})
file(REMOVE ${SCRATCH}/all.o)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${output}")
endif()
file(STRINGS ${OBJECTS} objects)
list(LENGTH objects count)
message(STATUS "every name means one thing in ${count} objects")
