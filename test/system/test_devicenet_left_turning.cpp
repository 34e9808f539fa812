// A driver behind one that was killed with a turning wheel on DeviceNet, P151 = 0: the time-out that the first one has left
// in the module is all that stops the motor, and outlasts the second one's check for its MAC id. Whatever comes of its start,
// the motor stops.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "sim/devicenet/simulated_dn_bus.h"
#include "support/can_text.h"
#include "support/map_settings.h"
#include "transport/devicenet/devicenet.h"

namespace nord_driver::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::HasSubstr;

constexpr Duration kCycle = milliseconds{10};

sim::SimConfig oneModule() {
  sim::SimConfig config;
  config.bus = sim::DnBusConfig{};
  sim::DriveConfig drive;
  drive.name = "left";
  drive.address = 5;
  drive.place = 1;
  drive.device.series = sim::Series::kSk2xxe;
  sim::DnDriveConfig module;
  module.kind = sim::DnModuleKind::kGateway;
  drive.bus = module;
  config.drives.push_back(drive);
  return config;
}

/// What MAC id 0 has said to MAC id 5, the last of it just now: 25 Hz, with an expected packet rate of 1 s.
void leaveItTurning(sim::SimulatedDnBus& bus) {
  const auto say = [&bus](const char* candump) {
    bus.inject(frame(candump));
    bus.sleepUntil(bus.now() + milliseconds{100});
  };
  bus.sleepUntil(bus.now() + seconds{3});  // its own check for its MAC id
  say("42E#004B03010300");
  say("42C#0010050209E803");
  for (int i = 0; i < 10; ++i) say("42D#007E040000");
  for (int i = 0; i < 40; ++i) say("42D#007F040020");
  ASSERT_TRUE(bus.module(0).inDataExchange());
  ASSERT_DOUBLE_EQ(25.0, bus.drive(0).inverter().frequency());
}

/// The second driver; its drive's settings may differ by one from those of the first.
class SecondDriver {
 public:
  explicit SecondDriver(const char* key = nullptr, int value = 0) {
    const auto drive = std::make_shared<MapSettings>("~drives/left/");
    drive->set("address", 5).set("series", "sk2xxe").set("joint", "j").set("gear_ratio", 20.0).set("pole_pairs", 2);
    if (key != nullptr) drive->set(key, value);
    MapSettings bus{"~bus/", {{"interface", std::string{"can0"}}, {"expected_packet_rate", 1.0}}};
    transport_.configure(bus, {{"left", drive}}, 100.0);
    outputs_[0].control_word = 0x047E;
  }
  void run(Duration span) {
    for (const Instant end = bus_->now() + span; bus_->now() < end;) {
      const Instant begun = transport_.now();
      transport_.exchange(outputs_, inputs_);
      transport_.sleepUntil(begun + kCycle);
    }
  }
  void close() { transport_.close(); }
  sim::SimulatedDnBus& bus() { return *bus_; }
  double frequency() { return bus_->drive(0).inverter().frequency(); }
  std::string rules() { return bus_->referee().report(); }
  bool answers() const { return inputs_[0].inverter_answers; }
  std::string busText() const { return transport_.busText().str(); }

 private:
  sim::SimulatedDnBus* bus_ = nullptr;
  DeviceNetTransport transport_{[this](const link::CanSettings&) {
    auto made = std::make_unique<sim::SimulatedDnBus>(oneModule());
    bus_ = made.get();
    bus_->open();
    leaveItTurning(*bus_);
    bus_->close();
    return made;
  }};
  std::vector<profile::ProcessOutput> outputs_ = std::vector<profile::ProcessOutput>(1);
  std::vector<DriveExchange> inputs_ = std::vector<DriveExchange>(1);
};

// As it was: it brings the time-out forward, says what it waits for, and exchanges when the motor has stopped.
TEST(DevicenetLeftTurning, TheSameDriver) {
  SecondDriver driver;
  driver.run(milliseconds{2200});
  EXPECT_DOUBLE_EQ(25.0, driver.frequency());
  EXPECT_THAT(driver.busText(), HasSubstr("MAC id 5 has process data of ours from before, with a time-out of 0.4 s"));
  driver.run(milliseconds{700});
  EXPECT_DOUBLE_EQ(0.0, driver.frequency());
  EXPECT_TRUE(driver.answers()) << driver.busText();
  EXPECT_EQ(1u, driver.bus().module(0).counters().timeouts);
  EXPECT_EQ("no rule broken", driver.rules());
}

// Another module, or another assembly, than the file of the second one says.
TEST(DevicenetLeftTurning, ADriverThatRefusesTheModule) {
  for (const auto& [key, value] :
       {std::pair{"product_code", 4711}, std::pair{"vendor_id", 4711}, std::pair{"assembly", 21}}) {
    SecondDriver driver{key, value};
    driver.run(seconds{5});
    EXPECT_DOUBLE_EQ(0.0, driver.frequency()) << key;
    EXPECT_FALSE(driver.answers()) << key;
    EXPECT_EQ("no rule broken", driver.rules()) << key;
    EXPECT_THAT(driver.busText(), HasSubstr(std::string{key} == "assembly" ? "are configured" : "is another device"))
        << key;
  }
}

// Ended while it starts, at whatever moment.
TEST(DevicenetLeftTurning, ADriverThatIsEnded) {
  for (int after = 1900; after < 4400; after += after < 2100 || after > 3990 ? 10 : 300) {
    SecondDriver driver;
    driver.run(milliseconds{after});
    driver.close();
    driver.bus().run(milliseconds{4500});
    EXPECT_DOUBLE_EQ(0.0, driver.frequency()) << after;
    EXPECT_EQ("no rule broken", driver.rules()) << after;
  }
}

}  // namespace
}  // namespace nord_driver::test
