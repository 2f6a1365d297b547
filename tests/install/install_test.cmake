# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the built library into a scratch prefix, then builds and runs a stranger's program with it.
# Called with BUILD (the library's build tree), SOURCE (this folder), SCRATCH, GENERATOR, CXX, CXX_FLAGS, BUILD_TYPE.
file(REMOVE_RECURSE ${SCRATCH})

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "failed (${result}): ${command}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${SCRATCH}/prefix)

# CGAL and oneTBB are the library's own affair: no public header shows them.
file(GLOB_RECURSE headers ${SCRATCH}/prefix/include/*.h)
if(NOT headers)
  message(FATAL_ERROR "no header was installed")
endif()
foreach(header ${headers})
  file(STRINGS ${header} leaks REGEX "# *include *[<\"](CGAL|boost|tbb|oneapi|gmp)")
  if(leaks)
    message(FATAL_ERROR "${header} shows a private dependency: ${leaks}")
  endif()
endforeach()

run(${CMAKE_COMMAND} -S ${SOURCE}/consumer -B ${SCRATCH}/build -G ${GENERATOR}
    -DCMAKE_PREFIX_PATH=${SCRATCH}/prefix -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF
    -DCMAKE_DISABLE_FIND_PACKAGE_CGAL=ON -DCMAKE_CXX_COMPILER=${CXX}
    -DCMAKE_CXX_FLAGS=${CXX_FLAGS} -DCMAKE_BUILD_TYPE=${BUILD_TYPE})
run(${CMAKE_COMMAND} --build ${SCRATCH}/build)
run(${SCRATCH}/build/consumer)
if(NOT output STREQUAL "1996 triangles\n")
  message(FATAL_ERROR "the consumer printed: ${output}")
endif()
message(STATUS "the installed library works: ${output}")
