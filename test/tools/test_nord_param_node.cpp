// nord_param asked for a node where there is no ROS. Beside a driver: rostest_nord_param.
#include <gtest/gtest.h>

#include <cstdlib>

#include "tools/program.h"

namespace nord_driver::test {
namespace {

// Found out at once; without --node the bus is opened as ever (all tests of NordParam).
TEST(NordParamNode, IsNotAskedWithoutARosMaster) {
  ::setenv("ROS_MASTER_URI", "http://127.0.0.1:1", 1);  // nobody there
  const Ended read = runProgram({NORD_PARAM_PROGRAM, "--config", NORD_CONFIG_FOLDER "/demo.yaml", "--bus", "/dev/null",
                                 "--node", "/nord_driver", "read", "left", "P105"});
  EXPECT_EQ(1, read.code);
  EXPECT_EQ(
      "nord_param: no ROS master answers at ROS_MASTER_URI (http://127.0.0.1:1): node /nord_driver cannot be asked\n",
      read.errors);
}

}  // namespace
}  // namespace nord_driver::test
