// nord_param asked for a node where there is no ROS. Beside a driver: rostest_nord_param.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "tools/program.h"

namespace nord_driver::test {
namespace {

using ::testing::AnyOf;
using ::testing::Eq;
using ::testing::HasSubstr;

Ended readThrough(const std::string& node) {
  return runProgram({NORD_PARAM_PROGRAM, "--config", NORD_CONFIG_FOLDER "/demo.yaml", "--bus", "/dev/null", "--node",
                     node, "read", "left", "P105"});
}

// Found out at once; without --node the bus is opened as ever (all tests of NordParam).
TEST(NordParamNode, IsNotAskedWithoutARosMaster) {
  ::setenv("ROS_MASTER_URI", "http://127.0.0.1:1", 1);  // nobody there
  const Ended read = readThrough("/nord_driver");
  EXPECT_EQ(1, read.code);
  EXPECT_EQ(
      "nord_param: no ROS master answers at ROS_MASTER_URI (http://127.0.0.1:1): node /nord_driver cannot be asked\n",
      read.errors);
}

// As roslaunch, rosservice and Debian's roscpp do; where this machine has a master there, it is this one that knows no
// such node.
TEST(NordParamNode, IsAskedOfTheUsualMasterWhereNoneIsNamed) {
  for (const char* const uri : {"", static_cast<const char*>(nullptr)}) {
    if (uri == nullptr) {
      ::unsetenv("ROS_MASTER_URI");
    } else {
      ::setenv("ROS_MASTER_URI", uri, 1);
    }
    const Ended read = readThrough("/node_of_no_robot");
    EXPECT_EQ(1, read.code);
    EXPECT_THAT(read.errors, AnyOf(Eq("nord_param: no ROS master answers at ROS_MASTER_URI (http://localhost:11311): "
                                      "node /node_of_no_robot cannot be asked\n"),
                                   HasSubstr("no service /node_of_no_robot/left/read_parameter")));
  }
}

}  // namespace
}  // namespace nord_driver::test
