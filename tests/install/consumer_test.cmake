# SPDX-License-Identifier: GPL-3.0-or-later
# Builds and runs a program of another project, which uses the library in one way. Warnings in public headers are errors.
# Called with WAY (find_package, pkg_config, add_subdirectory or fetch_content), CXX (a compiler), TYPE (of the
# installed library), ROOT (the project), PREFIX (where it is installed), SCRATCH and GENERATOR.
cmake_minimum_required(VERSION 3.25)
if(NOT CXX)
  message(STATUS "skipped: clang++ is not installed; tools/setup --tests installs it")
  return()
endif()
file(REMOVE_RECURSE ${SCRATCH})
set(warnings -Wall -Wextra -Wconversion -Wshadow -Werror)
set(sources ${CMAKE_CURRENT_LIST_DIR}/consumer/main.cpp ${SCRATCH}/headers.cpp)

# Every public header.
file(GLOB headers RELATIVE ${ROOT}/include ${ROOT}/include/calotte/*.h)
foreach(header ${headers})
  file(APPEND ${SCRATCH}/headers.cpp "#include <${header}>\n")
endforeach()

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "failed (${result}): ${command}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

function(build_with_cmake folder)
  run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/${folder} -B ${SCRATCH}/build -G ${GENERATOR}
      "-DSOURCES=${sources}" "-DWARNINGS=${warnings}" -DCMAKE_CXX_COMPILER=${CXX} ${ARGN})
  run(${CMAKE_COMMAND} --build ${SCRATCH}/build --parallel 2)
endfunction()

# A plain command line. Eigen's .pc file does not mark its headers as system headers.
function(build_with_pkg_config)
  file(GLOB_RECURSE pc ${PREFIX}/*/calotte.pc)
  get_filename_component(folder ${pc} DIRECTORY)
  set(ENV{PKG_CONFIG_PATH} ${folder})
  if(TYPE STREQUAL "STATIC_LIBRARY")
    set(static --static)
  else()
    get_filename_component(folder ${folder} DIRECTORY)
    set(rpath -Wl,-rpath,${folder})
  endif()
  run(pkg-config ${static} --cflags --libs calotte)
  string(REPLACE "-I/usr/include/eigen3" "-isystem/usr/include/eigen3" output "${output}")
  separate_arguments(flags UNIX_COMMAND "${output}")
  file(MAKE_DIRECTORY ${SCRATCH}/build)
  run(${CXX} -std=c++20 ${warnings} ${sources} ${flags} ${rpath} -o ${SCRATCH}/build/consumer)
endfunction()

if(WAY STREQUAL "find_package")
  build_with_cmake(consumer -DCMAKE_PREFIX_PATH=${PREFIX} -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF
                   -DCMAKE_DISABLE_FIND_PACKAGE_CGAL=ON)
elseif(WAY STREQUAL "pkg_config")
  build_with_pkg_config()
else()
  build_with_cmake(subdirectory -DCALOTTE=${ROOT} -DWAY=${WAY} -DCALOTTE_PRECOMPILE=ON)
  run(${CMAKE_COMMAND} --install ${SCRATCH}/build --prefix ${SCRATCH}/prefix)
  if(EXISTS ${SCRATCH}/prefix)
    message(FATAL_ERROR "the library is installed with the project that it is a part of")
  endif()
endif()
run(${SCRATCH}/build/consumer)
if(NOT output STREQUAL "1996 triangles\n")
  message(FATAL_ERROR "the consumer printed: ${output}")
endif()
message(STATUS "${WAY} with ${CXX}: ${output}")
