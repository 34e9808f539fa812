# Helpers of this package's CMake files.

# The warnings every target of ours is built with.
function(nord_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wnon-virtual-dtor)
  if(NORD_DRIVER_STRICT)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(NORD_DRIVER_SANITIZE)
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

# A unit test: nord_gtest(NAME SOURCES a.cpp ... LIBS lib ...). It runs without a ROS master.
function(nord_gtest name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBS" ${ARGN})
  catkin_add_gtest(${name} ${ARG_SOURCES})
  nord_test_settings(${name} ${ARG_LIBS})
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
  nord_warnings(${name})
  nord_precompile(${name} <gmock/gmock.h> <gtest/gtest.h>)
endfunction()
