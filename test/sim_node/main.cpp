#include <gmock/gmock.h>
#include <ros/ros.h>

int main(int argc, char** argv) {
  testing::InitGoogleMock(&argc, argv);
  ros::init(argc, argv, "test_sim_node");
  ros::NodeHandle handle;  // lives as long as the tests
  return RUN_ALL_TESTS();
}
