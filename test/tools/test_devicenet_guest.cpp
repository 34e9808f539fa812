// nord_param on DeviceNet, where it exchanges no process data: what it cannot know it does not show, and does not guess.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "catalogue/shipped.h"
#include "tools/drive_watch.h"
#include "tools/parameter_link.h"
#include "tools/scope_scale.h"
#include "tools/write_value.h"
#include "transport/devicenet/devicenet.h"
#include "transport/devicenet/fake_devicenet_bus.h"

namespace nord_driver::tools {
namespace {

using ::testing::HasSubstr;

/// A link to a module at MAC id 5 that answers explicit messages.
class DevicenetGuest : public ::testing::Test {
 protected:
  devicenet::FakeDevice& device() { return *bus_->devices.front(); }
  void connect() {
    link_ = std::make_unique<ParameterLink>(config_, transport_, catalogue::shippedCatalogues());
    begun_ = link_->now();
    link_->connect(std::chrono::seconds{5}, end_asked_, [this](const std::string& wait) {
      told_.push_back(wait);
      told_after_ = link_->now() - begun_;
      end_asked_ = ends_then_;
    });
  }
  void run(Duration span) { link_->exchangeUntil(link_->now() + span, end_asked_); }
  WatchedDrive look() { return DriveWatch{*link_, {}}.look().front(); }
  std::string whyNotWritten(std::uint16_t number, double value) {
    catalogue::ParameterAddress address;
    address.number = number;
    catalogue::ParameterAccess access = catalogue::accessTo(address, link_->known());
    EXPECT_EQ("", catalogue::setValue(access, {value, false, false}));
    try {
      const ParameterAnswer answer = link_->write(access);
      return answer.success ? "" : answer.message;
    } catch (const Trouble& trouble) {
      return trouble.what();
    }
  }

  static ToolConfig config(const char* bus = "{interface: can0}") {
    YAML::Node file = YAML::Load(
        "{cycle_rate: 100, left_wheel: left_wheel_joint,"
        " drives: {left: {address: 5, series: sk2xxe, pole_pairs: 2}}}");
    file["bus"] = YAML::Load(bus);
    return readToolConfig(file, std::vector<std::string>{"left"});
  }

  ToolConfig config_ = config();
  test::FakeDevicenetBus* bus_ = nullptr;
  bool tells_state_ = true;
  DeviceNetTransport transport_{[this](const link::CanSettings&) {
    auto made = std::make_unique<test::FakeDevicenetBus>();
    made->devices.push_back(std::make_unique<devicenet::FakeDevice>(5));
    devicenet::FakeDevice& device = *made->devices.back();
    device.attributes[{101, 1, 2}] = {0xC8, 0x00};  // P102 = 2.00 s
    device.attributes[{101, 1, 5}] = {0xF4, 0x01};  // P105 = 50.0 Hz
    if (tells_state_) device.attributes[{41, 1, 6}] = {3};
    bus_ = made.get();
    return made;
  }};
  std::atomic<bool> end_asked_{false};
  bool ends_then_ = false;  // Ctrl-C when it is told
  std::vector<std::string> told_;
  Instant begun_{};
  Duration told_after_{};
  std::unique_ptr<ParameterLink> link_;
};

// A module is asked for nothing before its own time-out: whoever waits is told why, once.
TEST_F(DevicenetGuest, TellsWhyItWaitsForLong) {
  config_ = config("{interface: can0, expected_packet_rate: 2.0}");
  connect();
  ASSERT_EQ(1u, told_.size());
  EXPECT_LT(told_after_, std::chrono::seconds{4});
  EXPECT_THAT(told_[0],
              ::testing::StartsWith("waiting for drive left (DeviceNet MAC id 5, inverter 1), at most 11 s more: "));
  EXPECT_THAT(told_[0], HasSubstr("asked for nothing before its own time-out"));
}

TEST_F(DevicenetGuest, TellsNothingWhereItTakesNoLonger) {
  connect();
  EXPECT_EQ(std::vector<std::string>{}, told_);
}

TEST_F(DevicenetGuest, ItsEndHasTheReason) {
  config_ = config("{interface: can0, expected_packet_rate: 65.0}");
  ends_then_ = true;
  try {
    connect();
    FAIL();
  } catch (const Trouble& trouble) {
    EXPECT_THAT(trouble.what(), ::testing::StartsWith("ended before drive left answered: "));
    EXPECT_THAT(trouble.what(), HasSubstr("asked for nothing before its own time-out"));
  }
}

// The motor turns at its terminals, and nothing of that but the state is told.
TEST_F(DevicenetGuest, ShowsTheStateAndNoWords) {
  connect();
  device().attributes[{41, 1, 6}] = {4};
  run(std::chrono::seconds{1});
  const WatchedDrive seen = look();
  EXPECT_TRUE(seen.online && seen.state_known);
  EXPECT_FALSE(seen.commands_known || seen.words_known);
  EXPECT_EQ(std::nullopt, seen.frequency);
  const std::string table = watchTable({seen}, {});
  EXPECT_THAT(table, HasSubstr("state           operation enabled\n"));
  EXPECT_THAT(table, HasSubstr("status word     not known\n"));
  EXPECT_THAT(table, HasSubstr("control word    not known\n"));
  ScopeRecord record;
  readScale(*link_, std::nullopt, false, record);
  EXPECT_FALSE(record.commands_known || record.words_known);
  EXPECT_EQ(50.0, record.max_frequency);
}

TEST_F(DevicenetGuest, WritesToADriveAtRest) {
  connect();
  EXPECT_EQ("", link_->notAtRest());
  EXPECT_THAT(whyNotWritten(105, 60.0), ::testing::Not(HasSubstr("at rest")));
}

// Whether the motor turns nobody has told: that is no rest.
TEST_F(DevicenetGuest, DoesNotTakeAnUntoldStateForRest) {
  tells_state_ = false;
  connect();
  catalogue::ParameterAddress address;
  address.number = 105;
  EXPECT_EQ(50.0, link_->read(address).value) << "reading moves nothing";
  EXPECT_FALSE(look().state_known);
  EXPECT_THAT(whyNotWritten(105, 60.0), HasSubstr("whether drive left is at rest is not known"));
  EXPECT_THAT(link_->notAtRest(), HasSubstr("does not tell the state (class 41)"));
  EXPECT_EQ((devicenet::FakeDevice::Bytes{0xF4, 0x01}), (device().attributes[{101, 1, 5}]));
  EXPECT_THAT(whyNotWritten(102, 3.0), ::testing::Not(HasSubstr("at rest"))) << "a ramp turns nothing";
}

}  // namespace
}  // namespace nord_driver::tools
