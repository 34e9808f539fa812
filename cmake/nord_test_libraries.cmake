# The libraries of the tests, under the same names wherever they come from.

# No find_package(GTest): FindGTest has other targets in every version of CMake, none has gmock, and GoogleTest's own description
# refuses to be read where catkin has read FindGTest before. All have libraries of these names.
foreach(library gtest gtest_main gmock)
  if(NOT TARGET GTest::${library})
    find_library(NORD_${library}_LIBRARY ${library})
    if(NOT NORD_${library}_LIBRARY)
      message(FATAL_ERROR "lib${library} was not found (libgtest-dev, libgmock-dev)")
    endif()
    add_library(GTest::${library} INTERFACE IMPORTED)
    target_link_libraries(GTest::${library} INTERFACE ${NORD_${library}_LIBRARY})
    if(library STREQUAL gtest)
      target_link_libraries(GTest::gtest INTERFACE Threads::Threads)
    else()
      target_link_libraries(GTest::${library} INTERFACE GTest::gtest)
    endif()
  endif()
endforeach()

# Debian bullseye and Ubuntu 20.04 have no rapidcheck: there each property test is a test case that says it was skipped.
add_library(nord_rapidcheck INTERFACE)
find_path(NORD_RAPIDCHECK_INCLUDE_DIR rapidcheck/gtest.h)
find_library(NORD_RAPIDCHECK_LIBRARY rapidcheck)
if(NORD_RAPIDCHECK_INCLUDE_DIR AND NORD_RAPIDCHECK_LIBRARY)
  target_include_directories(nord_rapidcheck SYSTEM INTERFACE ${NORD_RAPIDCHECK_INCLUDE_DIR})
  target_link_libraries(nord_rapidcheck INTERFACE ${NORD_RAPIDCHECK_LIBRARY})
else()
  message(WARNING "rapidcheck was not found (librapidcheck-dev): the property tests are left out, each is counted as skipped")
  target_include_directories(nord_rapidcheck INTERFACE ${PROJECT_SOURCE_DIR}/test/support/without_rapidcheck)
endif()
