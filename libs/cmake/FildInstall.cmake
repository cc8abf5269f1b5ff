# SPDX-License-Identifier: BSD-3-Clause
# Installs the CMake package: find_package(mrpt-fild COMPONENTS <module>...) gives the fild:: targets.
include(CMakePackageConfigHelpers)
set(FILD_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/mrpt-fild)
get_property(components GLOBAL PROPERTY FILD_COMPONENTS)
configure_package_config_file(
  libs/cmake/mrpt-fild-config.cmake.in ${PROJECT_BINARY_DIR}/mrpt-fild-config.cmake
  INSTALL_DESTINATION ${FILD_CMAKE_DIR})
write_basic_package_version_file(
  ${PROJECT_BINARY_DIR}/mrpt-fild-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES
  ${PROJECT_BINARY_DIR}/mrpt-fild-config.cmake
  ${PROJECT_BINARY_DIR}/mrpt-fild-config-version.cmake
  libs/cmake/FindOSMesa.cmake
  libs/cmake/Findhnswlib.cmake
  libs/cmake/Findmatio.cmake
  libs/cmake/FindoneDNN.cmake
  DESTINATION ${FILD_CMAKE_DIR})
install(DIRECTORY config-ini DESTINATION ${CMAKE_INSTALL_DATADIR}/mrpt-fild)
# Error messages name datasets-scripts/get-model.sh: whoever installed has it too.
install(PROGRAMS datasets-scripts/get-model.sh datasets-scripts/npm_package.sh
  datasets-scripts/tflite_to_onnx.py
  DESTINATION ${CMAKE_INSTALL_DATADIR}/mrpt-fild/datasets-scripts)
install(FILES LICENSE README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR})
