# SPDX-License-Identifier: GPL-3.0-or-later
# Debian packages of a shared build, made by cpack: the preset package, or tools/package.
#   libcalotteX.Y    the library
#   libcalotte-dev   its headers, and what find_package(calotte) and pkg-config read
#   calotte          the command
#   python3-calotte  the Python package
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME calotte)
set(CPACK_PACKAGE_CONTACT "Calotte maintainers <maintainers@calotte.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Delaunay triangulations and centroidal Voronoi tessellations")
set(CPACK_COMPONENTS_ALL library development command)
if(CALOTTE_BUILD_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_COMPONENTS_IGNORE_GROUPS ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR})
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(library libcalotte${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(same "${library} (= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME ${library})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libcalotte-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${same}, libeigen3-dev (>= 3.4)")
set(CPACK_DEBIAN_COMMAND_PACKAGE_NAME calotte)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SECTION science)
set(CPACK_DEBIAN_COMMAND_PACKAGE_DEPENDS "${same}")
set(CPACK_DEBIAN_COMMAND_PACKAGE_SUGGESTS "gmt-gshhg-low")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-calotte)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)

set(about "Calotte computes exact Delaunay triangulations and centroidal Voronoi
tessellations of the sphere and the plane. Results have the same bits for
any number of threads.")
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION "${about}\n.\nThis package holds the shared library.")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "${about}\n.\nThis package holds the headers for C++, C and Fortran.")
set(CPACK_COMPONENT_COMMAND_DESCRIPTION
  "${about}\n.\nThis package holds the command, which makes grids for MPAS and other models.")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "${about}\n.\nThis package holds the Python package, which works on numpy arrays.")
if(CALOTTE_BUILD_PYTHON)
  math(EXPR next "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "${same}, python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next}), python3-numpy")
endif()

# What Debian asks of each package: its licence and its changes. Python modules name no version for other packages.
if(CALOTTE_DEBIAN_DOCS)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_GENERATE_SHLIBS OFF)
  set(folder ${PROJECT_BINARY_DIR}/debian)
  file(MAKE_DIRECTORY ${folder})
  configure_file(tools/packaging/debian/changelog.in ${folder}/changelog @ONLY)
  foreach(file ${folder}/changelog ${PROJECT_SOURCE_DIR}/.github/CHANGELOG.md)
    get_filename_component(name ${file} NAME)
    string(REPLACE CHANGELOG.md NEWS name ${name})
    execute_process(COMMAND gzip -9nc ${file} OUTPUT_FILE ${folder}/${name}.gz COMMAND_ERROR_IS_FATAL ANY)
  endforeach()
  file(WRITE ${folder}/triggers "activate-noawait ldconfig\n")
  set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${folder}/triggers)
  foreach(component ${CPACK_COMPONENTS_ALL})
    string(TOUPPER ${component} name)
    install(FILES ${folder}/changelog.gz ${folder}/NEWS.gz COMPONENT ${component}
            DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${CPACK_DEBIAN_${name}_PACKAGE_NAME})
    install(FILES tools/packaging/debian/copyright COMPONENT ${component}
            DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${CPACK_DEBIAN_${name}_PACKAGE_NAME})
  endforeach()
endif()
include(CPack)
