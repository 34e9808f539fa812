// What BU 0280 prints, as frames on the bus: parameters of four inverters and of the module, and the variable assembly.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "transport/devicenet/devicenet_rig.h"

namespace nord_driver {
namespace {

using devicenet::FakeDevice;
using profile::ParameterAction;
using profile::ParameterOutcome;
using profile::ParameterShape;
using test::DevicenetRig;
using test::DevicenetSettings;
using test::readOf;
using testing::ElementsAre;

/// The bodies of the explicit requests from `first` on: service, class, instance, attribute, data.
std::vector<std::string> requestsSince(const DevicenetRig& rig, std::size_t first) {
  std::vector<std::string> bodies;
  for (std::size_t i = first; i < rig.bus->seen.size(); ++i) {
    const std::string& line = rig.bus->seen[i];
    if (line.rfind("> 42C#", 0) == 0) bodies.push_back(line.substr(8));
  }
  return bodies;
}

/// Four inverters at MAC id 5, assembly 102/112, that answer for P103, P546 and P151.
class DevicenetFrames : public testing::Test {
 protected:
  void start(const char* objects = "numbered") {
    DevicenetSettings settings = DevicenetSettings::gateway(4);
    for (std::size_t i = 0; i < 4; ++i) settings.drive(i).set("parameter_objects", objects);
    rig = std::make_unique<DevicenetRig>(settings);
    FakeDevice& device = rig->device();
    device.input.assign(33, 0);
    for (const std::size_t at : {1u, 9u, 17u, 25u}) {
      device.input[at] = 0x31;
      device.input[at + 1] = 0x0B;
    }
    for (const unsigned class_id : {101u, 111u, 121u, 131u}) device.attributes[{class_id, 3, 3}] = {0xC8, 0x00};
    for (const unsigned class_id : {105u, 115u, 125u, 135u}) device.attributes[{class_id, 1, 46}] = {0x01, 0x00};
    device.attributes[{181, 1, 51}] = {0xF4, 0x01};
    for (unsigned instance = 1; instance <= 4; ++instance) {
      for (const unsigned attribute : {1u, 3u}) device.attributes[{199, instance, attribute}] = {0, 0};
      device.attributes[{199, instance, 2}] = {0};
    }
    ASSERT_TRUE(rig->starts());
    rig->run(std::chrono::milliseconds{500});
  }
  std::vector<std::string> ask(const profile::ParameterRequest& request, DriveIndex drive) {
    const std::size_t first = rig->bus->seen.size();
    result = rig->ask(request, drive);
    EXPECT_EQ(ParameterOutcome::kDone, result.outcome) << result.text.c_str();
    return requestsSince(*rig, first);
  }

  std::unique_ptr<DevicenetRig> rig;
  profile::ParameterResult result;
};

// BU 0280 4.3.9: class 100 + number / 100 + 10 for each further inverter, instance sub-index + 1, attribute number mod 100.
TEST_F(DevicenetFrames, ParametersOfFourInverters) {
  start();
  profile::ParameterRequest ramp = readOf(103, ParameterShape::kPerSet);
  ramp.parameter_set = 3;
  EXPECT_THAT(ask(ramp, 0), ElementsAre("0E650303"));
  EXPECT_EQ(200, result.raw);
  EXPECT_THAT(ask(ramp, 1), ElementsAre("0E6F0303"));
  EXPECT_THAT(ask(ramp, 2), ElementsAre("0E790303"));
  EXPECT_THAT(ask(ramp, 3), ElementsAre("0E830303"));
  EXPECT_THAT(ask(readOf(546), 2), ElementsAre("0E7D012E"));
  ramp.action = ParameterAction::kWritePersistent;
  ramp.raw = 150;
  EXPECT_THAT(ask(ramp, 3), ElementsAre("108303039600"));
  EXPECT_EQ((FakeDevice::Bytes{0x96, 0x00}), (rig->device().attributes[{131, 3, 3}]));
}

TEST_F(DevicenetFrames, ParametersOfTheModule) {
  for (const char* objects : {"numbered", "index_object"}) {
    start(objects);
    EXPECT_THAT(ask(readOf(151), 0), ElementsAre("0EB50133")) << objects;
    EXPECT_EQ(500, result.raw);
    profile::ParameterRequest write = readOf(151);
    write.action = ParameterAction::kWritePersistent;
    write.raw = 200;
    EXPECT_THAT(ask(write, 3), ElementsAre("10B50133C800")) << "whichever inverter asks, " << objects;
  }
}

// BU 0280 4.3.10: number (UINT), index (USINT), then the value (INT), in the instance of the inverter.
TEST_F(DevicenetFrames, TheIndexObject) {
  start("index_object");
  profile::ParameterRequest ramp = readOf(103, ParameterShape::kPerSet);
  ramp.parameter_set = 3;
  EXPECT_THAT(ask(ramp, 0), ElementsAre("10C701016700", "10C7010202", "0EC70103"));
  EXPECT_THAT(ask(ramp, 3), ElementsAre("10C704016700", "10C7040202", "0EC70403"));
  ramp.action = ParameterAction::kWritePersistent;
  ramp.raw = 150;
  EXPECT_THAT(ask(ramp, 1), ElementsAre("10C702016700", "10C7020202", "10C702039600"));
}

// The example of BU 0280 4.2.5: P161 {1,1}, P162 {8,8,2}, P163 {4,8,2}, P164 {4,4,0}, P165 {0,0,0}. Index 0 is the length of
// the status data, so that 17 bytes come and 21 go (the manual's last two lines have them the other way round).
TEST(DevicenetVariableAssembly, TheManualsExample) {
  DevicenetSettings settings = DevicenetSettings::gateway(3, 120);
  settings.drive(0).set("module_input_bytes", 1).set("module_output_bytes", 1);
  settings.drive(0).set("status_bytes", 8).set("control_bytes", 8);
  settings.drive(1).set("status_bytes", 4).set("control_bytes", 8);
  settings.drive(2).set("status_bytes", 4).set("control_bytes", 4).set("profile", "ac_drive");
  for (std::size_t i = 0; i < 3; ++i) settings.drive(i).set("max_frequency", 50.0);
  DevicenetRig rig{settings};
  rig.device().attributes[{41, 3, 6}] = {4};  // whether the third one is there, its words do not tell
  rig.device().input = {0x0F,                 // the module's inputs
                        0x37, 0x0B, 0x00, 0x20, 0x22, 0x11, 0x44, 0x33,  // ZSW, IW1, IW2, IW3 of FI 1
                        0x31, 0x0B, 0x66, 0x55,                          // ZSW, IW1 of FI 2
                        0x04, 0x00, 0xEE, 0x02};                         // running, 750 rpm of FI 3
  ASSERT_TRUE(rig.starts());
  EXPECT_EQ(17u, rig.transport.config().scanner.nodes[0].io.input_bytes);
  EXPECT_EQ(21u, rig.transport.config().scanner.nodes[0].io.output_bytes);
  EXPECT_EQ(0x0B37, rig.inputs[0].input.status_word);
  EXPECT_THAT(rig.inputs[0].input.actual_values, ElementsAre(0x2000, 0x1122, 0x3344));
  EXPECT_EQ(0x0B31, rig.inputs[1].input.status_word);
  EXPECT_THAT(rig.inputs[1].input.actual_values, ElementsAre(0x5566, 0, 0));
  EXPECT_EQ(0x2000, rig.inputs[2].input.actual_values[0]) << "750 rpm are half of 50 Hz, two pole pairs";
  rig.outputs[0] = {0x047F, {0x1000, 0x0102, 0x0304}};
  rig.outputs[1] = {0x047E, {0x2000, 0x0506, 0x0708}};
  rig.outputs[2] = {0x047F, {0x2000, 0, 0}};
  rig.run(std::chrono::milliseconds{30});
  EXPECT_EQ((FakeDevice::Bytes{0x00,                                            // the module's outputs: off
                               0x7F, 0x04, 0x00, 0x10, 0x02, 0x01, 0x04, 0x03,  // STW, SW1, SW2, SW3 of FI 1
                               0x7E, 0x04, 0x00, 0x20, 0x06, 0x05, 0x08, 0x07,  // of FI 2
                               0x01, 0x00, 0xEE, 0x02}),                        // run forward, 750 rpm of FI 3
            rig.device().output);
  EXPECT_THAT(rig.bus->seen, testing::Contains("> 42D#00007F0400100201")) << "in three fragments";
  EXPECT_THAT(rig.violations(), testing::IsEmpty());
}

// io: strobe as frames: a poll for each, then the strobe of all; the words that count are those of the strobe's answer.
TEST(DevicenetStrobe, PollsThenStrobe) {
  DevicenetSettings settings{2};
  for (std::size_t i = 0; i < 2; ++i) settings.drive(i).set("io", "strobe");
  DevicenetRig rig{settings};
  ASSERT_TRUE(rig.starts());
  rig.outputs[0] = {0x047F, {0x2000, 0, 0}};
  rig.run(std::chrono::milliseconds{30});
  const std::size_t first = rig.bus->seen.size();
  rig.cycle();
  const std::vector<std::string> cycle(rig.bus->seen.begin() + static_cast<std::ptrdiff_t>(first), rig.bus->seen.end());
  EXPECT_THAT(cycle, ElementsAre("> 42D#007F040020", "> 435#007E040000", "> 400#0000000000000000", "< 3C5#00310B0000",
                                 "< 385#00310B0000", "< 3C6#00310B0000", "< 386#00310B0000"));
  EXPECT_EQ(0x07, rig.device(0).held) << "explicit, polled, strobed";
  EXPECT_THAT(rig.violations(), testing::IsEmpty());
}

}  // namespace
}  // namespace nord_driver
