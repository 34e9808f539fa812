#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/map_settings.h"
#include "transport/profibus/profibus_dp_config.h"

namespace nord_driver {
namespace {

using test::MapSettings;
using ::testing::AllOf;
using ::testing::HasSubstr;

class SerialLineConfig : public ::testing::Test {
 protected:
  link::SerialSettings read() const {
    const auto drive = std::make_shared<MapSettings>("~drives/left/");
    drive->set("address", 3).set("series", "sk5xxe").set("pole_pairs", 2);
    return readProfibusDpConfig(bus, {{"left", drive}}, 20.0).line;
  }
  std::string refusal() const {
    try {
      read();
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "taken";
  }

  MapSettings bus = MapSettings{"~bus/"}.set("device", "/dev/ttyUSB0");
};

TEST_F(SerialLineConfig, Defaults) {
  const link::SerialSettings line = read();
  EXPECT_EQ("/dev/ttyUSB0", line.device);
  EXPECT_EQ(500'000u, line.baud_rate.bitsPerSecond());
  EXPECT_EQ(link::EchoMode::kAuto, line.echo);
  EXPECT_FALSE(line.rs485.enabled);
  EXPECT_TRUE(line.follow_adapter);
}

TEST_F(SerialLineConfig, EverythingIsRead) {
  bus.set("baud_rate", 93'750).set("follow_adapter", false);
  bus.set("rs485/enabled", true).set("rs485/rts_on_send", false).set("rs485/rts_after_send", true);
  bus.set("rs485/rx_during_tx", true).set("rs485/delay_before", 0.001).set("rs485/delay_after", 0.1);
  const link::SerialSettings line = read();
  EXPECT_EQ(93'750u, line.baud_rate.bitsPerSecond());
  EXPECT_FALSE(line.follow_adapter);
  EXPECT_TRUE(line.rs485.enabled);
  EXPECT_FALSE(line.rs485.rts_on_send);
  EXPECT_TRUE(line.rs485.rts_after_send);
  EXPECT_TRUE(line.rs485.rx_during_tx);
  EXPECT_EQ(1u, line.rs485.delay_before_ms);
  EXPECT_EQ(100u, line.rs485.delay_after_ms);
}

// YAML makes a boolean of an unquoted on or off.
TEST_F(SerialLineConfig, EchoInWordsAndAsYamlReadsIt) {
  EXPECT_EQ(link::EchoMode::kOn, (bus.set("echo", "on"), read().echo));
  EXPECT_EQ(link::EchoMode::kOff, (bus.set("echo", "off"), read().echo));
  EXPECT_EQ(link::EchoMode::kAuto, (bus.set("echo", "auto"), read().echo));
  EXPECT_EQ(link::EchoMode::kOn, (bus.set("echo", true), read().echo));
  EXPECT_EQ(link::EchoMode::kOff, (bus.set("echo", false), read().echo));
  bus.set("echo", "maybe");
  EXPECT_THAT(refusal(), AllOf(HasSubstr("~bus/echo"), HasSubstr("maybe"), HasSubstr("auto, off or on")));
}

TEST_F(SerialLineConfig, DelaysAreWholeMillisecondsUpToHundred) {
  bus.set("rs485/delay_before", 0.0005);
  EXPECT_THAT(refusal(), AllOf(HasSubstr("~bus/rs485/delay_before"), HasSubstr("0.0005"), HasSubstr("whole milli")));
  bus.erase("rs485/delay_before").set("rs485/delay_after", 0.2);
  EXPECT_THAT(refusal(), AllOf(HasSubstr("~bus/rs485/delay_after"), HasSubstr("0.1")));
}

// With the same level for sending and listening the sender would hold the line for ever.
TEST_F(SerialLineConfig, RtsMustSwitch) {
  bus.set("rs485/enabled", true).set("rs485/rts_after_send", true);
  EXPECT_THAT(refusal(), AllOf(HasSubstr("~bus/rs485/rts_after_send"), HasSubstr("opposite")));
}

TEST_F(SerialLineConfig, TheDeviceIsRequired) {
  bus.erase("device");
  EXPECT_THAT(refusal(), HasSubstr("~bus/device"));
}

}  // namespace
}  // namespace nord_driver
