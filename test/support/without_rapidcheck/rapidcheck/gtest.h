// A property test without rapidcheck is a test case that says it was skipped. Its body is compiled, as a template
// nobody asks for.
#pragma once

#include <gtest/gtest.h>
#include <rapidcheck.h>

#define RC_GTEST_PROP(Suite, Name, Parameters)                          \
  TEST(Suite, Name) {                                                   \
    GTEST_SKIP() << "left out: rapidcheck was not found at build time"; \
  }                                                                     \
  template <typename Nobody>                                            \
  void leftOut_##Suite##_##Name Parameters
