# SPDX-License-Identifier: BSD-3-Clause
# Debian's libhnswlib-dev has headers and no CMake config. Defines hnswlib::hnswlib.
find_path(HNSWLIB_INCLUDE_DIR hnswlib/hnswlib.h)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(hnswlib REQUIRED_VARS HNSWLIB_INCLUDE_DIR)
if(hnswlib_FOUND AND NOT TARGET hnswlib::hnswlib)
  add_library(hnswlib::hnswlib INTERFACE IMPORTED)
  target_include_directories(hnswlib::hnswlib SYSTEM INTERFACE "${HNSWLIB_INCLUDE_DIR}")
endif()
