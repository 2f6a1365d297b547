# SPDX-License-Identifier: GPL-3.0-or-later
# The library's matrices have the storage of std::malloc: no object defines or calls Eigen's own allocation functions, whose
# blocks differ between instruction sets.
# Called with OBJECTS (a file that lists the library's objects, compiled with lib/base/eigen_allocation.h), NM, CXX, FLAGS
# (of CXX), EIGEN (folders of headers), ROOT (the project) and SCRATCH.
cmake_minimum_required(VERSION 3.25)
file(MAKE_DIRECTORY ${SCRATCH})
set(functions "Eigen::(internal::(handmade_aligned_|aligned_(malloc|free|realloc|new|delete|stack)|conditional_aligned_[a-z_]*<([^<>]*, )?true>)|aligned_allocator)")

# Sets `faults` to the names that must not be there, and `count` to the number of all.
function(find_faults objects)
  execute_process(COMMAND ${NM} -AC ${objects} OUTPUT_FILE ${SCRATCH}/names.txt COMMAND_ERROR_IS_FATAL ANY)
  file(STRINGS ${SCRATCH}/names.txt names REGEX " [A-Za-z] ")
  list(LENGTH names count)
  file(STRINGS ${SCRATCH}/names.txt faults REGEX "${functions}")
  list(TRANSFORM faults REPLACE "^[^:]*/([^/:]+):[0-9a-f ]*[A-Za-z] " "\\1: ")
  list(REMOVE_DUPLICATES faults)
  set(faults "${faults}" PARENT_SCOPE)
  set(count ${count} PARENT_SCOPE)
endfunction()

# A matrix of Eigen's default options must be found, and one without alignment must not.
separate_arguments(flags UNIX_COMMAND "${FLAGS}")
list(TRANSFORM EIGEN PREPEND -isystem OUTPUT_VARIABLE includes)
foreach(options 0 Eigen::DontAlign)
  file(WRITE ${SCRATCH}/sample.cpp "#include <Eigen/Core>
using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, ${options}>;
Vector doubled(const Eigen::Ref<const Eigen::VectorXd>& x) { return 2 * x; }\n")
  execute_process(COMMAND ${CXX} -std=c++20 ${flags} -include ${ROOT}/lib/base/eigen_allocation.h ${includes}
                          -c ${SCRATCH}/sample.cpp -o ${SCRATCH}/sample.o COMMAND_ERROR_IS_FATAL ANY)
  find_faults(${SCRATCH}/sample.o)
  if(NOT options AND NOT faults OR options AND faults)
    message(FATAL_ERROR "a vector with the options ${options} has the faults: ${faults}")
  endif()
endforeach()

find_faults(@${OBJECTS})
file(REMOVE ${SCRATCH}/names.txt)
if(faults)
  list(JOIN faults "\n" faults)
  message(FATAL_ERROR "use the types of include/calotte/mesh.h, or others with Eigen::DontAlign, instead of:\n${faults}")
endif()
message(STATUS "no aligned matrix in ${count} names")
