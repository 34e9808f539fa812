// The main of every rostest: a node whose messages are taken by threads of their own while the test waits.
#include <gtest/gtest.h>
#include <ros/ros.h>

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "rostest", ros::init_options::AnonymousName);
  ros::NodeHandle keep_alive;
  ros::AsyncSpinner spinner(2);
  spinner.start();
  return RUN_ALL_TESTS();
}
