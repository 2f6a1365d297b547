# SPDX-License-Identifier: GPL-3.0-or-later
# Finds METIS 5, which Debian installs without a file for CMake or pkg-config: the target METIS::METIS. Versions from 5.2
# on need GKlib where they are archives. METIS_ROOT names a folder to look in first.
find_path(METIS_INCLUDE_DIR metis.h)
find_library(METIS_LIBRARY metis)
find_library(METIS_GKLIB_LIBRARY GKlib)
mark_as_advanced(METIS_INCLUDE_DIR METIS_LIBRARY METIS_GKLIB_LIBRARY)
if(METIS_INCLUDE_DIR)
  file(STRINGS ${METIS_INCLUDE_DIR}/metis.h lines REGEX "#define METIS_VER_(MAJOR|MINOR|SUBMINOR)")
  string(REGEX REPLACE "[^;0-9]+" "" numbers "${lines}")
  string(REPLACE ";" "." METIS_VERSION "${numbers}")
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(METIS REQUIRED_VARS METIS_LIBRARY METIS_INCLUDE_DIR VERSION_VAR METIS_VERSION
  REASON_FAILURE_MESSAGE "install libmetis-dev, or metis of conda-forge or vcpkg")
if(METIS_FOUND AND NOT TARGET METIS::METIS)
  add_library(METIS::METIS INTERFACE IMPORTED)
  target_include_directories(METIS::METIS INTERFACE ${METIS_INCLUDE_DIR})
  target_link_libraries(METIS::METIS INTERFACE ${METIS_LIBRARY})
  if(METIS_GKLIB_LIBRARY)
    target_link_libraries(METIS::METIS INTERFACE ${METIS_GKLIB_LIBRARY})
  endif()
endif()
