# SPDX-License-Identifier: BSD-3-Clause

# What a person building mrpt-fild sees as warnings; never passed on to who links us.
set(FILD_WARNINGS
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wnon-virtual-dtor)

# fild_add_module(NAME <module> SOURCES <files> [PUBLIC <targets>] [PRIVATE <targets>])
#
# Library fild_<module> with alias fild::<module>, its public headers in include/fild/<module>,
# our warnings, installation and export. PUBLIC means "appears in our headers".
function(fild_add_module)
  cmake_parse_arguments(arg "" "NAME" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  set(target fild_${arg_NAME})
  add_library(${target} ${arg_SOURCES})
  add_library(fild::${arg_NAME} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${arg_NAME})
  target_compile_features(${target} PUBLIC cxx_std_17)
  target_compile_options(${target} PRIVATE ${FILD_WARNINGS})
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(${target} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
  install(TARGETS ${target} EXPORT mrpt-fild-targets)
  install(DIRECTORY include/fild DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endfunction()

# fild_add_app(<name> SOURCES <files> PRIVATE <targets>): an executable with MRPT's hyphenated name.
function(fild_add_app name)
  cmake_parse_arguments(arg "" "" "SOURCES;PRIVATE" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_compile_options(${name} PRIVATE ${FILD_WARNINGS})
  target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}/apps")
  target_compile_definitions(${name} PRIVATE FILD_VERSION="${PROJECT_VERSION}")
  target_link_libraries(${name} PRIVATE ${arg_PRIVATE})
  install(TARGETS ${name})
endfunction()

# fild_add_test(<name> LABEL unit|integration|dataset SOURCES <files> PRIVATE <targets>)
#
# One executable; each GoogleTest case is a ctest case. FILD_TEST_DATA_DIR reaches the sources
# as a macro, so that a test can skip and name the missing path.
function(fild_add_test name)
  cmake_parse_arguments(arg "" "LABEL" "SOURCES;PRIVATE" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  # Only what is tested is optimised: the tests' own code compiles a third faster without. Not with the
  # sanitizers: Eigen allocates otherwise there, and Ceres must not get those functions from a test.
  target_compile_options(${name} PRIVATE ${FILD_WARNINGS} $<$<CONFIG:RelWithDebInfo>:-O0>)
  target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}/tests")
  target_compile_definitions(${name} PRIVATE
    FILD_TEST_DATA_DIR="${FILD_TEST_DATA_DIR}"
    FILD_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_link_libraries(${name} PRIVATE ${arg_PRIVATE} GTest::gmock GTest::gtest_main)
  gtest_discover_tests(${name}
    PROPERTIES LABELS ${arg_LABEL} TIMEOUT 600
    DISCOVERY_TIMEOUT 60)
endfunction()
