// The configuration of a lift that positions, as users write it.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "cycle/cycle_config.h"
#include "support/map_settings.h"

namespace nord_driver::cycle {

class PositionConfiguration : public ::testing::Test {
 protected:
  CycleConfig read(const std::string& robot_description = "") {
    return readCycleConfig(node_, {{"lift", drive_}}, robot_description);
  }
  PositionSetup setup(const std::string& robot_description = "") { return *read(robot_description).drives[0].position; }
  std::string refusal(const std::string& robot_description = "") {
    try {
      read(robot_description);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "taken";
  }
  void SetUp() override {
    drive_->set("address", 3).set("series", "sk5xxe").set("joint", "lift_joint");
    drive_->set("gear_ratio", 20.0).set("pole_pairs", 2).set("mode", "position");
  }

  std::shared_ptr<test::MapSettings> drive_ = std::make_shared<test::MapSettings>("~drives/lift/");
  test::MapSettings node_{"~", {}};
};

}  // namespace nord_driver::cycle
