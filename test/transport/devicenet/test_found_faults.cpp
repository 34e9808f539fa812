// A fault that stood before the first word of the AC drive profile, which has none that the inverter ignores.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "profile/status_word.h"
#include "transport/devicenet/devicenet_rig.h"

namespace nord_driver {
namespace {

using devicenet::FakeDevice;
using std::chrono::milliseconds;
using std::chrono::seconds;
using test::DevicenetRig;
using test::DevicenetSettings;

constexpr std::uint8_t kReady = 3, kFaulted = 7;

DevicenetSettings acDrive(int assembly) {
  DevicenetSettings settings{1};
  settings.drive().set("assembly", assembly).set("max_frequency", 50.0);
  return settings;
}

bool tellsFault(const DevicenetRig& rig, DriveIndex drive = 0) {
  return rig.inputs[drive].inverter_answers && profile::StatusWord{rig.inputs[drive].input.status_word}.fault();
}

TEST(DevicenetFoundFaults, AreToldBeforeTheFirstWordGoesOut) {
  for (const int assembly : {20, 21}) {
    DevicenetRig rig{acDrive(assembly)};
    rig.device().attributes[{41, 1, 6}] = {kFaulted};
    rig.device().input = {0x70, kReady, 0x00, 0x00};  // what the first word has made of it
    if (assembly == 20) rig.device().input = {0, 0, 0, 0};
    ASSERT_TRUE(rig.starts());
    EXPECT_TRUE(tellsFault(rig)) << assembly;
    EXPECT_TRUE(rig.inputs[0].module_answers);
    EXPECT_EQ(0u, rig.device().polls) << assembly;
    rig.device().attributes[{41, 1, 6}] = {kReady};
    rig.cycle();
    EXPECT_EQ(1u, rig.device().polls) << assembly << ": then it goes out as ever";
    rig.run(seconds{1});
    EXPECT_TRUE(rig.allAnswer());
    EXPECT_FALSE(tellsFault(rig)) << assembly << ": told once";
  }
}

// One that was met and lost is a loss to the layers above; its words do not wait for what is asked.
TEST(DevicenetFoundFaults, AreToldOfNoneThatWasMetBefore) {
  DevicenetRig rig{acDrive(21)};
  rig.device().input = {0x70, kReady, 0x00, 0x00};
  ASSERT_TRUE(rig.starts());
  rig.run(milliseconds{100});
  rig.device().powerOff();
  rig.run(seconds{1});
  rig.device().attributes[{41, 1, 6}] = {kFaulted};
  rig.device().powerOn();
  rig.device().polls = 0;
  ASSERT_TRUE(rig.starts());
  EXPECT_FALSE(tellsFault(rig));
  EXPECT_LT(0u, rig.device().polls);
}

// A module that does not have the object, or whose inverter is off, goes on as ever.
TEST(DevicenetFoundFaults, WhereTheStateIsNotToldTheWordsGoOut) {
  for (const unsigned error : {0x14u, 0x02u}) {
    DevicenetRig rig{acDrive(21)};
    rig.device().attributes.erase({41, 1, 6});
    rig.device().error = static_cast<std::uint8_t>(error);
    rig.device().input = {0x70, kReady, 0x00, 0x00};
    ASSERT_TRUE(rig.starts());
    EXPECT_FALSE(tellsFault(rig));
    EXPECT_LT(0u, rig.device().polls);
  }
}

// NORD's words have one that is ignored, and the status word tells the fault: nothing more is asked.
TEST(DevicenetFoundFaults, WithNordsWordsNothingIsAsked) {
  DevicenetRig rig;
  EXPECT_EQ(0u, rig.transport.config().scanner.nodes[0].asked_supervisors);
}

// Behind one module each has an instance of its own.
TEST(DevicenetFoundFaults, AreToldOfTheInverterThatHasThem) {
  DevicenetSettings settings = DevicenetSettings::gateway(2, 120);
  for (std::size_t i = 0; i < 2; ++i) settings.drive(i).set("profile", "ac_drive").set("max_frequency", 50.0);
  DevicenetRig rig{settings};
  EXPECT_EQ(0x03u, rig.transport.config().scanner.nodes[0].asked_supervisors);
  rig.device().attributes[{41, 2, 6}] = {kFaulted};
  rig.device().input = FakeDevice::Bytes(rig.device().produced, 0);
  ASSERT_LT(rig.until([&] { return tellsFault(rig, 1); }), seconds{5});
  EXPECT_EQ(0u, rig.device().polls);
  rig.device().attributes[{41, 2, 6}] = {kReady};
  rig.run(seconds{1});
  EXPECT_TRUE(rig.allAnswer());
  EXPECT_FALSE(tellsFault(rig, 0) || tellsFault(rig, 1));
}

}  // namespace
}  // namespace nord_driver
