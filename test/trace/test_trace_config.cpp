#include <gtest/gtest.h>

#include "support/map_settings.h"
#include "trace/trace_config.h"

namespace nord_driver::trace {
namespace {

using test::MapSettings;

std::string refusal(const MapSettings& settings) {
  try {
    readTraceConfig(settings);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

// Without a directory there is no trace.
TEST(TraceConfig, IsOffByDefault) {
  EXPECT_FALSE(readTraceConfig(MapSettings{"~"}).withFaults());
  EXPECT_FALSE(readTraceConfig(MapSettings{"~", {{"trace_directory", std::string{}}}}).withFaults());
}

TEST(TraceConfig, KeepsTwentyByDefault) {
  const auto config = readTraceConfig(MapSettings{"~", {{"trace_directory", std::string{"/var/trace"}}}});
  EXPECT_TRUE(config.withFaults());
  EXPECT_EQ("/var/trace", config.directory);
  EXPECT_EQ(20u, config.keep);
}

// As ROS finds the folder of its logs.
TEST(TraceConfig, ATraceAskedForByHandGoesToTheHomeOfRos) {
  EXPECT_EQ("/var/ros", directoryByHand("/var/ros", "/home/robot"));
  EXPECT_EQ("/home/robot/.ros", directoryByHand(nullptr, "/home/robot"));
  EXPECT_EQ("/home/robot/.ros", directoryByHand("", "/home/robot"));
  EXPECT_EQ("", directoryByHand(nullptr, nullptr));
}

// By hand as many are kept as trace_keep says, wherever they go.
TEST(TraceConfig, WhatIsKeptCountsForTracesByHand) {
  TraceConfig config = byHand(readTraceConfig(MapSettings{"~", {{"trace_keep", 3}}}), "/var/ros", nullptr);
  EXPECT_EQ("/var/ros", config.directory);
  EXPECT_EQ(3u, config.keep);
  config = byHand(readTraceConfig(MapSettings{"~"}), nullptr, "/home/robot");
  EXPECT_EQ("/home/robot/.ros", config.directory);
  EXPECT_EQ(20u, config.keep);
  const MapSettings both{"~", {{"trace_keep", 3}, {"trace_directory", std::string{"/var/trace"}}}};
  config = byHand(readTraceConfig(both), "/var/ros", nullptr);
  EXPECT_EQ("/var/trace", config.directory);
  EXPECT_EQ(3u, config.keep);
}

// ROS expands no "~", and a relative path would lie wherever roslaunch was started.
TEST(TraceConfig, WantsAnAbsolutePath) {
  EXPECT_EQ(
      "~trace_directory: \"~/trace\" is not valid, expected an absolute path, such as /home/robot/trace, or nothing "
      "(no trace)",
      refusal(MapSettings{"~", {{"trace_directory", std::string{"~/trace"}}}}));
}

TEST(TraceConfig, KeepsAtLeastOne) {
  EXPECT_EQ("~trace_keep: 0 is not valid, expected a whole number from 1 to 100000",
            refusal(MapSettings{"~", {{"trace_keep", 0}}}));
}

}  // namespace
}  // namespace nord_driver::trace
