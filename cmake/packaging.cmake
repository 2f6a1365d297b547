# SPDX-License-Identifier: GPL-3.0-or-later
# What is installed: the library and its headers, the command if it is built, and beside the library what
# find_package(calotte) and pkg-config read.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(calotte_targets core)
set(calotte_target_of_core calotte_core)
set(calotte_target_of_io calotte)
set(calotte_name_of_core core)
set(calotte_name_of_io calotte) # and calotte::io
if(CALOTTE_BUILD_IO)
  set(calotte_targets core io)
  if(calotte_type STREQUAL "SHARED_LIBRARY") # it has the core's objects
    set(calotte_targets io)
  endif()
endif()
foreach(part ${calotte_targets})
  set(target ${calotte_target_of_${part}})
  target_include_directories(${target} PUBLIC $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${calotte_name_of_${part}})
  install(TARGETS ${target} EXPORT calotte_${part}
    LIBRARY COMPONENT library NAMELINK_COMPONENT development
    ARCHIVE COMPONENT development)
endforeach()
include(cmake/io_headers.cmake)
if(NOT CALOTTE_BUILD_IO)
  list(JOIN calotte_io_headers "|" left_out)
  set(left_out REGEX "/(c|${left_out})\\.h$" EXCLUDE)
endif()
install(DIRECTORY include/calotte TYPE INCLUDE COMPONENT development ${left_out})
if(TARGET calotte_command)
  install(TARGETS calotte_command COMPONENT command)
  if(calotte_type STREQUAL "SHARED_LIBRARY") # found wherever the prefix is moved
    set_target_properties(calotte_command PROPERTIES INSTALL_RPATH $ORIGIN/../${CMAKE_INSTALL_LIBDIR})
  endif()
endif()

set(calotte_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/calotte)
configure_package_config_file(cmake/calotteConfig.cmake.in calotteConfig.cmake INSTALL_DESTINATION ${calotte_package_dir})
write_basic_package_version_file(calotteConfigVersion.cmake COMPATIBILITY SameMajorVersion)
foreach(part ${calotte_targets})
  install(EXPORT calotte_${part} NAMESPACE calotte:: DESTINATION ${calotte_package_dir} COMPONENT development)
endforeach()
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/calotteConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/calotteConfigVersion.cmake
        DESTINATION ${calotte_package_dir} COMPONENT development)

# A shared library brings its own libraries along; programs link those of an archive, which stands alone.
set(calotte_pc_requires "eigen3 >= 3.4")
set(calotte_pc_further_libs "")
if(calotte_type STREQUAL "STATIC_LIBRARY")
  string(APPEND calotte_pc_requires ", tbb, gmp")
  if(CALOTTE_BUILD_IO)
    string(APPEND calotte_pc_requires ", netcdf, expat, zlib, shapelib, tomlplusplus")
    set(calotte_pc_further_libs " -lmetis") # METIS has no .pc file
    install(FILES cmake/FindMETIS.cmake DESTINATION ${calotte_package_dir} COMPONENT development)
  endif()
endif()
set(calotte_pc_libs "")
foreach(part io core) # an archive stands before those that it needs
  if(part IN_LIST calotte_targets)
    string(APPEND calotte_pc_libs " -l${calotte_target_of_${part}}")
  endif()
endforeach()
foreach(kind LIB INCLUDE) # found from where the .pc file stands
  file(RELATIVE_PATH calotte_pc_${kind} ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_FULL_${kind}DIR})
endforeach()
configure_file(cmake/calotte.pc.in calotte.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/calotte.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
if(PROJECT_IS_TOP_LEVEL)
  include(cmake/debian.cmake)
endif()
