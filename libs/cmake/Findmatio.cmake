# SPDX-License-Identifier: BSD-3-Clause
# Debian's libmatio-dev has no CMake config. Defines matio::matio.
find_path(MATIO_INCLUDE_DIR matio.h)
find_library(MATIO_LIBRARY matio)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(matio REQUIRED_VARS MATIO_LIBRARY MATIO_INCLUDE_DIR)
if(matio_FOUND AND NOT TARGET matio::matio)
  add_library(matio::matio UNKNOWN IMPORTED)
  set_target_properties(matio::matio PROPERTIES
    IMPORTED_LOCATION "${MATIO_LIBRARY}"
    INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${MATIO_INCLUDE_DIR}"
    INTERFACE_INCLUDE_DIRECTORIES "${MATIO_INCLUDE_DIR}")
endif()
