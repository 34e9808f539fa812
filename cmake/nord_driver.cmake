# Helpers of this package's CMake files.

# What reads robot descriptions. urdfdom 1.0 (Ubuntu 20.04) names libraries and folders in variables, later ones have targets;
# both are known only to the folder that asks for them.
function(nord_link_urdfdom target)
  find_package(urdfdom_headers REQUIRED)
  find_package(urdfdom REQUIRED)
  if(TARGET urdfdom::urdfdom_model)
    target_link_libraries(${target} PRIVATE urdfdom::urdfdom_model)
  else()
    target_link_libraries(${target} PRIVATE ${urdfdom_LIBRARIES})
    target_include_directories(${target} SYSTEM PRIVATE ${urdfdom_INCLUDE_DIRS} ${urdfdom_headers_INCLUDE_DIRS})
  endif()
endfunction()

# The warnings every target of ours is built with.
function(nord_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wnon-virtual-dtor)
  if(NORD_DRIVER_STRICT)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(NORD_DRIVER_SANITIZE STREQUAL "thread")
    target_compile_options(${target} PRIVATE -fsanitize=thread -fno-omit-frame-pointer -Wno-tsan)  # fences: only between atomics
    target_link_options(${target} PRIVATE -fsanitize=thread)
  elseif(NORD_DRIVER_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
    target_link_options(${target} PRIVATE -fsanitize=address,undefined)
  endif()
endfunction()

# Off by default: with it a source may forget an include and still build.
function(nord_precompile target)
  if(NORD_DRIVER_PRECOMPILE)
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
endfunction()

# Those of C++ most sources of the libraries include.
set(nord_std_headers
  <algorithm> <array> <cmath> <cstddef> <cstdint> <memory> <optional> <stdexcept> <string> <utility> <vector>)

# The precompiled headers of `owner`, which must be compiled with the same options.
function(nord_share_precompiled target owner)
  if(NORD_DRIVER_PRECOMPILE)
    target_precompile_headers(${target} REUSE_FROM ${owner})
  endif()
endfunction()

# How every source of a test is compiled.
function(nord_test_options target)
  nord_warnings(${target})
  target_compile_options(${target} PRIVATE ${NORD_DRIVER_TEST_OPTIONS})
endfunction()

# What owns precompiled headers for programs has to be compiled as a program is, and not as a library.
function(nord_compile_as_program target)
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
  target_compile_options(${target} PRIVATE -fPIE)
endfunction()

# Nothing but the precompiled headers of GoogleTest, once for all unit tests: making them takes longer than compiling a test.
function(nord_gtest_headers)
  if(NORD_DRIVER_PRECOMPILE)
    file(GENERATE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/gtest_headers.cpp CONTENT "")
    add_library(nord_gtest_headers OBJECT EXCLUDE_FROM_ALL ${CMAKE_CURRENT_BINARY_DIR}/gtest_headers.cpp)
    target_link_libraries(nord_gtest_headers PRIVATE GTest::gmock GTest::gtest Threads::Threads)
    nord_test_options(nord_gtest_headers)
    nord_compile_as_program(nord_gtest_headers)
    nord_precompile(nord_gtest_headers <gmock/gmock.h> <gtest/gtest.h>)
  endif()
endfunction()

# A unit test: nord_gtest(NAME SOURCES a.cpp ... LIBS lib ...). It runs without a ROS master.
function(nord_gtest name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBS" ${ARGN})
  catkin_add_gtest(${name} ${ARG_SOURCES})
  nord_test_settings(${name} ${ARG_LIBS})
  nord_merge_tests(${name})
  add_dependencies(unit_tests ${name})
endfunction()

# A GoogleTest program that ctest does not run, since it needs more than any machine has: nord_test_program(NAME ...) as
# nord_gtest().
function(nord_test_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBS" ${ARGN})
  add_executable(${name} EXCLUDE_FROM_ALL ${ARG_SOURCES})
  set_target_properties(${name} PROPERTIES
    RUNTIME_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
  nord_test_settings(${name} ${ARG_LIBS})
  add_dependencies(tests ${name})
endfunction()

function(nord_test_settings name)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/test)
  target_link_libraries(${name} ${ARGN} GTest::gmock GTest::gtest GTest::gtest_main Threads::Threads)
  nord_test_options(${name})
  nord_share_precompiled(${name} nord_gtest_headers)
endfunction()

# The manual page and the bash completion of a program, which prints both; installed with it.
function(nord_manual program)
  set(folder ${CMAKE_BINARY_DIR}/manual)
  file(MAKE_DIRECTORY ${folder})
  add_custom_command(OUTPUT ${folder}/${program}.1 ${folder}/${program}
    COMMAND ${program} --manual-page > ${folder}/${program}.1
    COMMAND ${program} --bash-completion > ${folder}/${program}
    DEPENDS ${program} VERBATIM)
  add_custom_target(${program}_manual ALL DEPENDS ${folder}/${program}.1 ${folder}/${program})
  install(FILES ${folder}/${program}.1 DESTINATION share/man/man1)
  install(FILES ${folder}/${program} DESTINATION share/bash-completion/completions)
endfunction()
