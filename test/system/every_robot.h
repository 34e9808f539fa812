// The simulated robots of all buses, of those with a parameter channel, and what a test on all of them asks of each.
//
//     TYPED_TEST_SUITE(RefusalReason, EveryRobot, BusName);
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <type_traits>

#include "system/can_robot.h"
#include "system/devicenet_robot.h"
#include "system/interbus_robot.h"
#include "system/simulated_robot.h"

namespace nord_driver::test {

/// Of the buses with a parameter channel of their own.
using EveryRobot = ::testing::Types<SimulatedRobot, CanRobot, DevicenetRobot>;
using EveryBusRobot = ::testing::Types<SimulatedRobot, CanRobot, DevicenetRobot, InterbusRobot>;

struct BusName {
  template <typename Robot>
  static std::string GetName(int /*index*/) {
    if (std::is_same_v<Robot, SimulatedRobot>) return "Profibus";
    if (std::is_same_v<Robot, InterbusRobot>) return "Interbus";
    return std::is_same_v<Robot, CanRobot> ? "Canopen" : "Devicenet";
  }
};

inline auto& busOf(SimulatedRobot& robot) {
  return robot.segment();
}
inline auto& busOf(CanRobot& robot) {
  return robot.bus();
}
inline auto& busOf(DevicenetRobot& robot) {
  return robot.bus();
}

}  // namespace nord_driver::test
