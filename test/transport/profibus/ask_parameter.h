// A parameter asked for over a transport, cycle by cycle, until its answer is there.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>

#include "nord_driver/transport/transport.h"

namespace nord_driver {

/// `step` runs one cycle; at most `cycles` of them.
template <typename Step>
profile::ParameterResult askParameter(Transport& transport, DriveIndex drive, std::uint16_t number,
                                      profile::ParameterAction action, std::int32_t raw, int cycles, const Step& step) {
  profile::ParameterRequest request;
  request.id = 77;
  request.number = number;
  request.action = action;
  request.raw = raw;
  EXPECT_TRUE(transport.submit(drive, request));
  for (int i = 0; i < cycles; ++i) {
    if (const auto result = transport.pollResult()) return *result;
    step();
  }
  ADD_FAILURE() << "no result";
  return {};
}

}  // namespace nord_driver
