# SPDX-License-Identifier: BSD-3-Clause

# What a person building mrpt-fild sees as warnings; never passed on to who links us.
set(FILD_WARNINGS
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wnon-virtual-dtor)
if(CMAKE_UNITY_BUILD)
  # A class's hidden part may hold what is in its file's anonymous namespace; g++ sees an included file.
  list(APPEND FILD_WARNINGS -Wno-subobject-linkage)
endif()

# fild_compile_alone(<files>): in a unity build, which compiles several files as one, these are compiled
# by themselves: a name in an anonymous namespace of theirs is in another file, too.
function(fild_compile_alone)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# fild_add_module(NAME <module> SOURCES <files> [PUBLIC <targets>] [PRIVATE <targets>] [NOT_INSTALLED])
#
# Library fild_<module> with alias fild::<module>, its public headers in include/fild/<module>,
# our warnings, and installation as component <module> of the CMake package. PUBLIC means "appears in our
# headers".
function(fild_add_module)
  cmake_parse_arguments(arg "NOT_INSTALLED" "NAME" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  set(target fild_${arg_NAME})
  add_library(${target} ${arg_SOURCES})
  add_library(fild::${arg_NAME} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${arg_NAME})
  target_compile_features(${target} PUBLIC cxx_std_17)
  target_compile_options(${target} PRIVATE ${FILD_WARNINGS})
  fild_keep_types(${target})
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(${target} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
  if(NOT arg_NOT_INSTALLED)
    install(DIRECTORY include/fild DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
    fild_install_component(${arg_NAME} ${arg_PUBLIC} ${arg_PRIVATE})
  endif()
endfunction()

# fild_install_component(<module> <target>...): what find_package() runs for the module. It first finds
# the modules and packages that the targets come from.
function(fild_install_component module)
  set(directory ${CMAKE_INSTALL_LIBDIR}/cmake/mrpt-fild)
  install(TARGETS fild_${module} EXPORT mrpt-fild-${module})
  install(EXPORT mrpt-fild-${module} NAMESPACE fild:: DESTINATION ${directory}
    FILE mrpt-fild-${module}-targets.cmake)
  set(modules ${ARGN})
  list(FILTER modules INCLUDE REGEX "^fild::")
  list(TRANSFORM modules REPLACE "^fild::" "")
  set(dependencies "")
  foreach(target IN LISTS ARGN)
    fild_package_of(${target} package)
    if(package)
      list(APPEND dependencies "find_dependency(${package})")
    endif()
  endforeach()
  list(REMOVE_DUPLICATES dependencies)
  list(JOIN dependencies "\n" dependencies)
  configure_file("${PROJECT_SOURCE_DIR}/libs/cmake/mrpt-fild-module.cmake.in"
    "${PROJECT_BINARY_DIR}/mrpt-fild-${module}.cmake" @ONLY)
  install(FILES "${PROJECT_BINARY_DIR}/mrpt-fild-${module}.cmake" DESTINATION ${directory})
  set_property(GLOBAL APPEND PROPERTY FILD_COMPONENTS ${module})
endfunction()

# fild_package_of(<target> <variable>): the arguments of find_package() that bring the target; empty for our
# own targets and the C library's.
function(fild_package_of target variable)
  set(mrpt::graphslam "mrpt-graphslam 2.5")
  set(hnswlib::hnswlib hnswlib)
  set(oneDNN::oneDNN "oneDNN 2.6...<3")
  set(OpenMP::OpenMP_CXX "OpenMP COMPONENTS CXX")
  set(OSMesa::OSMesa OSMesa)
  set(Eigen3::Eigen "Eigen3 3.4")
  set(matio::matio matio)
  set(nlohmann_json::nlohmann_json "nlohmann_json 3.11")
  set(OpenSSL::Crypto OpenSSL)
  set(ZLIB::ZLIB ZLIB)
  set(Ceres::ceres "Ceres 2.1")
  set(Threads::Threads Threads)
  if(DEFINED ${target})
    set(package "${${target}}")
  elseif(target MATCHES "^mrpt::(.*)")
    set(package "MRPT 2.5 COMPONENTS ${CMAKE_MATCH_1}")
  elseif(target MATCHES "^opencv_(.*)")
    set(package "OpenCV 4.6 COMPONENTS ${CMAKE_MATCH_1}")
  elseif(target MATCHES "^fild::" OR target STREQUAL "${CMAKE_DL_LIBS}")
    set(package "")
  else()
    message(FATAL_ERROR "fild_package_of() does not know the package of ${target}")
  endif()
  set(${variable} "${package}" PARENT_SCOPE)
endfunction()

# fild_add_app(<name> SOURCES <files> PRIVATE <targets>): an executable with MRPT's hyphenated name.
function(fild_add_app name)
  cmake_parse_arguments(arg "" "" "SOURCES;PRIVATE" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_compile_options(${name} PRIVATE ${FILD_WARNINGS})
  fild_keep_types(${name})
  target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}/apps")
  target_compile_definitions(${name} PRIVATE FILD_VERSION="${PROJECT_VERSION}")
  target_link_libraries(${name} PRIVATE ${arg_PRIVATE})
  install(TARGETS ${name})
endfunction()

# fild_add_test(<name> [SLOW] LABEL unit|integration|dataset|graphslam SOURCES <files> PRIVATE <targets>
#   [SUITES <suites>])
#
# One executable, which is one ctest case: a process takes a quarter of a second to load MRPT. SUITES
# are the long GoogleTest suites: each is a case <name>.<suite> of its own, and <name> is the rest.
# What is SLOW has the label `slow` as well. All executables of a label are the target <label>_tests.
# FILD_TEST_DATA_DIR reaches the sources as a macro, so that a test can skip and name the missing path.
function(fild_add_test name)
  cmake_parse_arguments(arg "SLOW" "LABEL" "SOURCES;PRIVATE;SUITES" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_compile_options(${name} PRIVATE ${FILD_TEST_OPTIONS})
  target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}/tests")
  target_compile_definitions(${name} PRIVATE
    FILD_TEST_DATA_DIR="${FILD_TEST_DATA_DIR}"
    FILD_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_link_libraries(${name} PRIVATE ${arg_PRIVATE} fild_test_main)

  set(labels ${arg_LABEL})
  if(arg_SLOW)
    list(APPEND labels slow)
  endif()
  list(GET labels -1 kind)
  add_dependencies(${kind}_tests ${name})

  set(rest "")
  foreach(suite IN LISTS arg_SUITES)
    set(filter "${suite}.*:*/${suite}.*:*/${suite}/*")
    string(APPEND rest ":${filter}")
    fild_add_test_case(${name}.${suite} "${labels}" ${name} --gtest_filter=${filter})
  endforeach()
  string(REGEX REPLACE "^:" "--gtest_filter=-" rest "${rest}")
  fild_add_test_case(${name} "${labels}" ${name} ${rest})
endfunction()

# fild_add_test_case(<case> <labels> <executable> [<arguments>]): see fild_add_test.
function(fild_add_test_case case labels executable)
  add_test(NAME ${case} COMMAND ${executable} ${ARGN})
  set_tests_properties(${case} PROPERTIES LABELS "${labels}" TIMEOUT 900 SKIP_RETURN_CODE 77)
endfunction()
