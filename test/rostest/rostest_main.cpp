// The main of every rostest: a node whose messages are taken by threads of their own while the test waits.
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <stdio.h>

#include <string>

namespace {

// What the launch file gave this run for its own.
void removeStateFile() {
  std::string file;
  if (!ros::param::get("nord_driver/eeprom_state_file", file)) return;
  for (const char* ending : {"", ".lock", ".new"}) ::remove((file + ending).c_str());
}

}  // namespace

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "rostest", ros::init_options::AnonymousName);
  ros::NodeHandle keep_alive;
  ros::AsyncSpinner spinner(2);
  spinner.start();
  const int result = RUN_ALL_TESTS();
  removeStateFile();
  return result;
}
