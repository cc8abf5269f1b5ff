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

# fild_add_test(<name> LABEL unit|integration|dataset SOURCES <files> PRIVATE <targets> [SUITES <suites>])
#
# One executable, which is one ctest case: a process takes a quarter of a second to load MRPT. SUITES
# are the long GoogleTest suites: each is a case <name>.<suite> of its own, and <name> is the rest.
# FILD_TEST_DATA_DIR reaches the sources as a macro, so that a test can skip and name the missing path.
function(fild_add_test name)
  cmake_parse_arguments(arg "" "LABEL" "SOURCES;PRIVATE;SUITES" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_compile_options(${name} PRIVATE ${FILD_TEST_OPTIONS})
  target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}/tests")
  target_compile_definitions(${name} PRIVATE
    FILD_TEST_DATA_DIR="${FILD_TEST_DATA_DIR}"
    FILD_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_link_libraries(${name} PRIVATE ${arg_PRIVATE} fild_test_main)

  add_dependencies(${arg_LABEL}_tests ${name})

  set(rest "")
  foreach(suite IN LISTS arg_SUITES)
    set(filter "${suite}.*:*/${suite}.*:*/${suite}/*")
    string(APPEND rest ":${filter}")
    fild_add_test_case(${name}.${suite} ${arg_LABEL} ${name} --gtest_filter=${filter})
  endforeach()
  string(REGEX REPLACE "^:" "--gtest_filter=-" rest "${rest}")
  fild_add_test_case(${name} ${arg_LABEL} ${name} ${rest})
endfunction()

# fild_add_test_case(<case> <label> <executable> [<arguments>]): see fild_add_test.
function(fild_add_test_case case label executable)
  add_test(NAME ${case} COMMAND ${executable} ${ARGN})
  set_tests_properties(${case} PROPERTIES LABELS ${label} TIMEOUT 900 SKIP_RETURN_CODE 77)
endfunction()
