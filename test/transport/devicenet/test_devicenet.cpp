// The DeviceNet transport on a bus with modules: start, process data, parameters, what it tells.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "profile/status_word.h"
#include "support/count_allocations.h"
#include "transport/devicenet/devicenet_rig.h"

namespace nord_driver {
namespace {

using devicenet::FakeDevice;
using profile::ParameterAction;
using profile::ParameterOutcome;
using profile::ParameterReason;
using profile::ParameterShape;
using std::chrono::milliseconds;
using std::chrono::seconds;
using test::readOf;
using Rig = test::DevicenetRig;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Two seconds of the duplicate-MAC check, then the devices: what the bus waits for is told.
TEST(DeviceNetTransportTest, StartsAfterTheDuplicateMacCheck) {
  Rig rig{test::DevicenetSettings{2}};
  rig.cycle();
  EXPECT_EQ("checks for two seconds that no other device has our MAC id 0", rig.transport.busText().str());
  EXPECT_STREQ("the duplicate-MAC check of this computer takes two seconds", rig.transport.note(0).text);
  const Duration took = rig.until([&] { return rig.allAnswer(); });
  EXPECT_GE(took, milliseconds{1990});
  EXPECT_LE(took, milliseconds{2300});
  EXPECT_EQ("", rig.transport.busText().str());
  EXPECT_STREQ("", rig.transport.note(0).text);
  EXPECT_TRUE(rig.transport.connected());
  EXPECT_EQ(389u << 16 | 7u, rig.transport.identNumber(0));
  EXPECT_THAT(rig.violations(), IsEmpty());
}

// BU 0280 4.2.4: the module's own outputs stay 0, words are low byte first.
TEST(DeviceNetTransportTest, WordsComeAndGo) {
  Rig rig;
  ASSERT_TRUE(rig.starts());
  EXPECT_EQ(0x0B31, rig.inputs[0].input.status_word);
  rig.outputs[0] = {0x047F, {0x2000}};
  rig.device().input = {0x0F, 0x37, 0x0B, 0x00, 0xE0};
  rig.run(milliseconds{30});
  EXPECT_EQ((FakeDevice::Bytes{0x00, 0x7F, 0x04, 0x00, 0x20}), rig.device().output);
  EXPECT_EQ(0x0B37, rig.inputs[0].input.status_word);
  EXPECT_EQ(-0x2000, rig.inputs[0].input.actual_values[0]);
  EXPECT_THAT(rig.bus->seen, Contains("> 42D#007F040020"));
}

// One poll and one answer in each cycle, over and over; the explicit connection is kept alive meanwhile.
TEST(DeviceNetTransportTest, EachCyclePollsOnce) {
  Rig rig{test::DevicenetSettings{2}};
  ASSERT_TRUE(rig.starts());
  const std::size_t before = rig.device().polls;
  rig.run(seconds{20});
  EXPECT_NEAR(2000.0, static_cast<double>(rig.device().polls - before), 2.0);
  EXPECT_EQ(0u, rig.device().explicit_deaths + rig.device().io_deaths);
  EXPECT_EQ(0, rig.unasked + rig.silences);
  EXPECT_THAT(rig.violations(), IsEmpty());
}

TEST(DeviceNetTransportTest, FourInvertersShareOneModule) {
  Rig rig{test::DevicenetSettings::gateway(4)};
  FakeDevice::Bytes input(33, 0);
  for (std::size_t i = 0; i < 4; ++i) {
    input[1 + 8 * i] = 0x31;
    input[2 + 8 * i] = 0x0B;
    input[3 + 8 * i] = static_cast<std::uint8_t>(i);
  }
  rig.device().input = input;
  ASSERT_TRUE(rig.starts());
  EXPECT_EQ(3, rig.inputs[3].input.actual_values[0]);
  rig.outputs[2] = {0x047F, {0x1000, 2, 3}};
  rig.run(milliseconds{30});
  ASSERT_EQ(33u, rig.device().output.size());
  EXPECT_EQ(0x7F, rig.device().output[17]);
  EXPECT_EQ(0x10, rig.device().output[20]);
  EXPECT_EQ(0x7E, rig.device().output[25]);
  // One of them is switched off: the module answers zeros for it.
  std::fill(rig.device().input.begin() + 9, rig.device().input.begin() + 17, std::uint8_t{0});
  rig.run(milliseconds{30});
  EXPECT_FALSE(rig.inputs[1].inverter_answers);
  EXPECT_TRUE(rig.inputs[1].module_answers && rig.inputs[1].inverter_missing);
  EXPECT_TRUE(rig.inputs[0].inverter_answers && rig.inputs[2].inverter_answers);
  EXPECT_THAT(rig.transport.note(1).text, HasSubstr("the inverter behind it does not"));
  EXPECT_EQ("DeviceNet MAC id 5, inverter 2", rig.transport.identity(1).address);
  EXPECT_EQ(rig.transport.identity(0).shared_module, rig.transport.identity(3).shared_module);
  EXPECT_THAT(rig.violations(), IsEmpty());
}

TEST(DeviceNetTransportTest, ChangesAreSentAtOnceAndAcknowledged) {
  test::DevicenetSettings settings{1};
  settings.drive().set("io", "cos");
  Rig rig{settings};
  ASSERT_TRUE(rig.starts());
  rig.run(seconds{2});
  const std::size_t before = rig.device().outputs;
  rig.run(seconds{1});
  EXPECT_LE(rig.device().outputs - before, 60u) << "unchanged words go at the expected packet rate";
  rig.outputs[0] = {0x047F, {1}};
  rig.cycle();
  EXPECT_EQ((FakeDevice::Bytes{0x00, 0x7F, 0x04, 0x01, 0x00}), rig.device().output);
  rig.device().input = {0x00, 0x37, 0x0B, 0x01, 0x00};
  rig.run(milliseconds{20});
  EXPECT_EQ(0x0B37, rig.inputs[0].input.status_word);
  EXPECT_TRUE(rig.allAnswer());
  EXPECT_EQ(0u, rig.device().repeated_productions);
}

// --- The AC drive profile --------------------------------------------------------------------------------------------

TEST(DeviceNetTransportTest, TheAcDriveProfileIsTranslated) {
  test::DevicenetSettings settings{1};
  settings.drive().set("assembly", 21).set("max_frequency", 50.0);
  Rig rig{settings};
  rig.device().input = {0x70, 0x03, 0x00, 0x00};
  ASSERT_TRUE(rig.starts());
  EXPECT_EQ(profile::DriveState::kReadyToSwitchOn, profile::StatusWord{rig.inputs[0].input.status_word}.state());
  rig.outputs[0] = {0x047F, {-8192}};
  rig.device().input = {0x78, 0x04, 0x12, 0xFD};
  rig.run(milliseconds{30});
  EXPECT_EQ((FakeDevice::Bytes{0x62, 0x00, 0xEE, 0x02}), rig.device().output) << "reverse, 750 rpm";
  EXPECT_EQ(-8192, rig.inputs[0].input.actual_values[0]);
}

TEST(DeviceNetTransportTest, NeitherAcDriveProfileTellsWhetherTheBusHasControl) {
  for (const int assembly : {20, 21}) {
    test::DevicenetSettings settings{1};
    settings.drive().set("assembly", assembly).set("max_frequency", 50.0);
    EXPECT_THAT((Rig{settings}.transport.warnings()),
                Contains(HasSubstr("drive drive0: the AC drive profile does not tell whether the bus has control")));
  }
}

// Assembly 70 is zero at rest, whether there is an inverter or not: class 41 is asked.
TEST(DeviceNetTransportTest, ProfileOneAsksWhetherThereIsAnInverter) {
  test::DevicenetSettings settings{1};
  settings.drive().set("assembly", 20);
  Rig rig{settings};
  rig.device().input = {0, 0, 0, 0};
  rig.device().attributes.erase({41, 1, 6});
  rig.device().error = 0x02;
  rig.until([&] { return rig.inputs[0].module_answers; });
  rig.run(seconds{1});
  EXPECT_TRUE(rig.inputs[0].inverter_missing);
  rig.device().attributes[{41, 1, 6}] = {3};
  EXPECT_LE(rig.until([&] { return rig.allAnswer(); }), milliseconds{300});
}

// --- Parameters ------------------------------------------------------------------------------------------------------

TEST(DeviceNetTransportTest, ParametersAreReadAndWrittenBesideTheExchange) {
  Rig rig;
  ASSERT_TRUE(rig.starts());
  auto result = rig.ask(readOf(105, ParameterShape::kPerSet));
  EXPECT_EQ(ParameterOutcome::kDone, result.outcome);
  EXPECT_EQ(500, result.raw);
  profile::ParameterRequest write = readOf(105, ParameterShape::kPerSet);
  write.action = ParameterAction::kWritePersistent;
  write.raw = 600;
  EXPECT_EQ(ParameterOutcome::kDone, rig.ask(write).outcome);
  EXPECT_EQ((FakeDevice::Bytes{0x58, 0x02}), (rig.device().attributes[{101, 1, 5}]));
  result = rig.ask(readOf(999));
  EXPECT_EQ(ParameterReason::kNoSuchParameter, result.reason);
  EXPECT_EQ("DeviceNet error 14h, the attribute is not supported", result.text.str());
  EXPECT_TRUE(rig.allAnswer());
}

// BU 0280 4.1.2: an inverter that is off behind a module that lives, whatever words the module goes on sending for it.
TEST(DeviceNetTransportTest, ResourceUnavailableTakesTheInverterAway) {
  Rig rig;
  ASSERT_TRUE(rig.starts());
  rig.device().error = 0x02;
  rig.device().attributes.erase({41, 1, 6});
  EXPECT_EQ(ParameterReason::kNoInverter, rig.ask(readOf(700)).reason);
  rig.run(milliseconds{20});
  EXPECT_TRUE(rig.inputs[0].inverter_missing);
  rig.device().attributes[{41, 1, 6}] = {3};
  EXPECT_LE(rig.until([&] { return rig.allAnswer(); }), milliseconds{300});
}

// Class 40, attribute 12 (BU 0280 4.3.5): what it says of the motor is compared once per connection, and told once.
TEST(DeviceNetTransportTest, PolesOtherThanConfiguredAreTold) {
  Rig rig;
  rig.device().attributes[{40, 1, 12}] = {0x04, 0x00};
  ASSERT_TRUE(rig.starts());
  rig.run(milliseconds{100});
  EXPECT_THAT(rig.bus->seen, testing::Contains(testing::EndsWith("0E28010C")));
  const auto isOfTheMotor = HasSubstr("its motor has");
  EXPECT_THAT(rig.told, testing::Not(testing::Contains(isOfTheMotor)));
  rig.device().attributes[{40, 1, 12}] = {0x06, 0x00};
  for (int i = 0; i < 2; ++i) {
    rig.device().powerOff();
    rig.run(milliseconds{500});
    rig.device().powerOn();
    ASSERT_LT(rig.until([&] { return rig.allAnswer(); }), std::chrono::seconds{5});
    rig.run(milliseconds{100});
  }
  std::size_t told = 0;
  for (const std::string& text : rig.told) told += text.find("its motor has") != std::string::npos ? 1 : 0;
  EXPECT_EQ(1u, told);
  EXPECT_THAT(rig.told,
              testing::Contains("drive drive0: its motor has 6 poles by class 40 of the module, pole_pairs: 2 is "
                                "configured: speeds and ways are wrong by that"));
}

// --- What is told ----------------------------------------------------------------------------------------------------

TEST(DeviceNetTransportTest, TellsWhatStopsADrive) {
  Rig rig;
  const DriveIdentity identity = rig.transport.identity(0);
  EXPECT_EQ("DeviceNet MAC id 5, inverter 1", identity.address);
  EXPECT_EQ("explicit messages", identity.parameter_channel);
  EXPECT_EQ(TimeoutOwner::kModule, identity.timeout_owner) << "P151, and P120 on the way to the inverter";
  EXPECT_DOUBLE_EQ(0.1, identity.protection_time);
  EXPECT_EQ(
      "DeviceNet time-out of 0.1 s, four times the expected packet rate, which the module may round up: the inverter "
      "trips E10.2 and the motor coasts",
      identity.protected_by);
  EXPECT_THAT(rig.transport.warnings(), IsEmpty());
  EXPECT_STREQ("interface", rig.transport.endPoint().key);
}

// The module may round the rate up; for parameters only the process data are known all the same.
TEST(DeviceNetTransportTest, TellsTheLongestPauseBetweenItsTelegrams) {
  EXPECT_DOUBLE_EQ(0.0, Rig{}.transport.identity(0).longest_pause) << "polled in each cycle";
  test::DevicenetSettings settings{1};
  settings.drive().set("io", "cos");
  for (const bool guest : {false, true}) {
    const DriveIdentity identity = Rig{settings, guest}.transport.identity(0);
    EXPECT_DOUBLE_EQ(0.125, identity.longest_pause) << guest;
    EXPECT_EQ(!guest, identity.sends_words) << guest;
    EXPECT_EQ(!guest, identity.tells_words) << guest;
  }
}

TEST(DeviceNetTransportTest, ClosingReleasesTheModules) {
  Rig rig{test::DevicenetSettings{2}};
  ASSERT_TRUE(rig.starts());
  rig.transport.close();
  EXPECT_EQ(0, rig.device(0).held);
  EXPECT_EQ(0, rig.device(1).held);
  EXPECT_EQ(0u, rig.device(0).io_deaths);
  EXPECT_FALSE(rig.bus->isOpen());
}

TEST(DeviceNetTransportTest, CountersAreUniqueAndCount) {
  Rig rig;
  ASSERT_TRUE(rig.starts());
  const BusCounters counters = rig.transport.counters();
  EXPECT_LT(0u, counters.value(bus_counter::kTelegramsSent));
  EXPECT_EQ(0u, counters.value(bus_counter::kTimeouts));
  EXPECT_LT(counters.size(), BusCounters::kCapacity);
}

// A bus on which nobody answers: what is sent, waited for and told takes no memory. With devices it is the scanner's own
// test (test/devicenet) that looks, since the fake ones take some.
TEST(DeviceNetTransportTest, ASilentBusTakesNoMemory) {
  if (!test::kCanCountAllocations) GTEST_SKIP() << "the sanitizers have replaced malloc";
  DeviceNetTransport transport{[](const link::CanSettings&) {
    auto bus = std::make_unique<test::FakeDevicenetBus>();
    bus->records = false;
    return bus;
  }};
  const test::DevicenetSettings settings{2};
  transport.configure(settings.bus, settings.drives, 100.0);
  std::vector<profile::ProcessOutput> outputs(2);
  std::vector<DriveExchange> inputs(2);
  unsigned long allocated = 0;
  for (int i = 0; i < 400; ++i) {
    allocated += test::countAllocations([&] {
      const Instant start = transport.now();
      transport.submit(0, readOf(105));
      transport.exchange(outputs, inputs);
      while (transport.pollResult()) {
      }
      while (transport.pollEvent()) {
      }
      static_cast<void>(transport.counters());
      static_cast<void>(transport.busText());
      static_cast<void>(transport.note(0));
      transport.sleepUntil(start + milliseconds{10});
    });
  }
  EXPECT_EQ(0u, allocated);
  EXPECT_LT(2u, transport.counters().value(bus_counter::kTelegramsSent)) << "on-line, and asking for its devices";
}

}  // namespace
}  // namespace nord_driver
