// The CANopen cycle allocates nothing once the drives are up.
//
// A program of its own, because it replaces malloc; in simulated time, in one thread. Not built under sanitizers, which
// do the same.
#include "system/can_robot.h"
#include "system/no_allocation.h"

namespace nord_driver::test {
namespace {

TEST(CanopenNoAllocation, InTheCycle) {
  CanRobot robot;
  expectNoAllocationInTheCycle(robot, std::chrono::seconds{3});
}

}  // namespace
}  // namespace nord_driver::test
