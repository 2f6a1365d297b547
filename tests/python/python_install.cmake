# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the package as pip does for a user, but for the library, which is built already. A later run compiles only
# changes of the module.
# Called with PYTHON, ROOT (the project), PREFIX (of the installed library), SITE (where to install) and CXX.
cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND ${PYTHON} -c "import setuptools, pip, wheel, numpy, pytest" RESULT_VARIABLE missing ERROR_QUIET)
find_path(pybind11 pybind11/pybind11.h PATHS /usr/include /usr/local/include)
if(missing OR NOT pybind11)
  message("skipped: pip, setuptools, wheel, numpy, pytest or pybind11 is not installed; run tools/setup --python")
  return()
endif()
file(REMOVE_RECURSE ${SITE} ${SITE}-source)
# pip builds in the folder of the sources, which stays clean this way.
file(COPY ${ROOT}/tools/python/ DESTINATION ${SITE}-source PATTERN build EXCLUDE PATTERN *.egg-info EXCLUDE)
file(COPY ${ROOT}/include DESTINATION ${SITE}-source/library)
foreach(name coastlines.h coastlines.cpp draw.h)
  file(COPY ${ROOT}/tools/draw/${name} DESTINATION ${SITE}-source/library/tools/draw)
endforeach()
execute_process(COMMAND ${CMAKE_COMMAND} -E env CALOTTE_PREFIX=${PREFIX} CALOTTE_BUILD=${SITE}-build CXX=${CXX}
  ${PYTHON} -m pip install --quiet --no-index --no-build-isolation --no-deps --target ${SITE} ${SITE}-source
  RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "pip failed:\n${output}")
endif()
