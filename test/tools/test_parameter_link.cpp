// A program that comes, reads or writes parameters, and goes: what the drives notice of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temporary_folder.h"
#include "tools/linked_drive.h"

namespace nord_driver::tools {
namespace {

using sim::InverterState;
using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

catalogue::ParameterAddress parameter(std::uint16_t number, std::uint8_t set = 0, std::uint8_t index = 0) {
  catalogue::ParameterAddress address;
  address.number = number;
  address.parameter_set = set;
  address.index = index;
  return address;
}

catalogue::ParameterWrite value(double value) {
  catalogue::ParameterWrite write;
  write.value = value;
  return write;
}

// As a master that has died left it: P513 = 0 lets it run on (BU 2700 7.1.1).
void letRun(LinkedDrive& drive) {
  sim::ProcessData data;
  data.control = 0x047E;
  drive.left().inverter().receive(data);
  drive.segment().run(seconds{1});
  data.control = 0x047F;
  data.setpoints[0] = 0x2000;
  drive.left().inverter().receive(data);
  drive.segment().run(seconds{4});
  ASSERT_EQ(InverterState::kOperationEnabled, drive.left().inverter().state());
  ASSERT_DOUBLE_EQ(25.0, drive.left().inverter().frequency());
}

/// A transport of somebody else, who does not know of programs for parameters only.
class DriversOnly final : public Transport {
 public:
  void configure(const Settings&, const std::vector<DriveSettings>&, double) override { configured = true; }
  void exchange(const std::vector<profile::ProcessOutput>&, std::vector<DriveExchange>&) noexcept override {}
  bool connected() const noexcept override { return false; }
  DriveIdentity identity(DriveIndex) const override { return {}; }

  bool configured = false;
};

// What the start-up and the end of a bus do to a drive, only its transport can know.
TEST(ParameterLink, RefusesATransportThatDoesNotServeIt) {
  const ToolConfig config = readToolConfig(LinkedDrive::file(), "left");
  DriversOnly transport;
  try {
    ParameterLink link{config, transport, catalogue::shippedCatalogues()};
    FAIL() << "not refused";
  } catch (const Trouble& error) {
    EXPECT_STREQ(
        "transport nord_driver/profibus_dp does not serve a program for parameters only, and its start-up might stop a "
        "drive that runs: ask the driver (~<drive>/read_parameter)",
        error.what());
  }
  EXPECT_FALSE(transport.configured);
}

TEST(ParameterLink, ReadsAndWrites) {
  LinkedDrive drive;
  drive.connect();
  const ParameterAnswer read = drive.link().read(parameter(105));
  EXPECT_TRUE(read.success) << read.message;
  EXPECT_EQ(500, read.raw);
  EXPECT_DOUBLE_EQ(50.0, read.value);
  EXPECT_EQ(1, read.set) << "the one in force";
  const ParameterAnswer written = writeValue(drive.link(), parameter(102, 4), value(2.5));
  EXPECT_TRUE(written.success) << written.message;
  EXPECT_EQ(250, drive.left().parameters().value(102, 3));
  EXPECT_EQ(200, drive.left().parameters().value(102, 0));
  EXPECT_THAT(writeValue(drive.link(), parameter(102, 4), value(2.5)).message, HasSubstr("nothing was written"));
}

// A value of the run before may be in the RAM only, and reads the same.
TEST(ParameterLink, SavesWhatIsThereAlready) {
  LinkedDrive drive;
  drive.left().parameters().write(102, 0, 0, 250, sim::Storage::kRam);
  drive.connect();
  catalogue::ParameterWrite write = value(2.5);
  EXPECT_THAT(writeValue(drive.link(), parameter(102), write).message, HasSubstr("nothing was written"));
  write.persistent = true;
  const ParameterAnswer saved = writeValue(drive.link(), parameter(102), write);
  EXPECT_TRUE(saved.success) << saved.message;
  EXPECT_EQ(1u, drive.left().parameters().eepromWrites());
  drive.left().parameters().restoreFromEeprom();
  EXPECT_EQ(250, drive.left().parameters().value(102));
}

// Counted on the disk before it is done, and refused when the day's writes are used up; the RAM can be written.
TEST(ParameterLink, WritesTheEepromWithinItsBudget) {
  const test::TemporaryFolder folder;
  YAML::Node file = LinkedDrive::file();
  file["eeprom_budget"] = 2;
  file["eeprom_state_file"] = folder.path("counts.yaml");
  catalogue::ParameterWrite write = value(2.5);
  write.persistent = true;
  for (const double ramp : {2.5, 3.0}) {
    LinkedDrive drive{file};
    drive.connect();
    write.value = ramp;
    const ParameterAnswer written = writeValue(drive.link(), parameter(102, 4), write);
    EXPECT_TRUE(written.success) << written.message;
    EXPECT_EQ(1u, drive.left().parameters().eepromWrites());
  }
  EXPECT_THAT(folder.read("counts.yaml"), HasSubstr("\"simulated, address 3, inverter 1, sk5xxe\": {day: "));
  EXPECT_THAT(folder.read("counts.yaml"), HasSubstr("writes: 2, total: 2}"));
  LinkedDrive drive{file};
  drive.connect();
  const ParameterAnswer refused = writeValue(drive.link(), parameter(102, 4), write);
  EXPECT_FALSE(refused.success);
  EXPECT_TRUE(refused.refused);
  EXPECT_THAT(refused.message, HasSubstr("drive left: its EEPROM has had 2 writes"));
  EXPECT_EQ(0u, drive.left().parameters().eepromWrites());
  EXPECT_TRUE(writeValue(drive.link(), parameter(102, 4), value(1.5)).success);
  EXPECT_EQ(150, drive.left().parameters().value(102, 3));
}

// The end of the program is no loss of the master: with a watchdog each run would leave E10.2 behind (BU 2700 8.1.1).
TEST(ParameterLink, ItsEndTripsNothing) {
  LinkedDrive drive;
  drive.connect();
  EXPECT_TRUE(drive.link().read(parameter(105)).success);
  EXPECT_THAT(drive.link().finish(), IsEmpty());
  drive.segment().run(seconds{60});
  EXPECT_EQ(0, drive.left().inverter().faultNumber());
  EXPECT_EQ(InverterState::kReadyToSwitchOn, drive.left().inverter().state());
  EXPECT_EQ("no rule broken", drive.segment().referee().report());
}

// 047E would stop it; the one word that may reach it is 0000, which it ignores.
TEST(ParameterLink, LeavesADriveThatRunsAlone) {
  LinkedDrive drive;
  letRun(drive);
  EXPECT_EQ("drive left is not at rest (operation enabled): it was left as it is; disable it first", drive.trouble());
  EXPECT_THAT(drive.link().finish(), IsEmpty());
  drive.segment().run(seconds{60});
  EXPECT_EQ(InverterState::kOperationEnabled, drive.left().inverter().state());
  EXPECT_DOUBLE_EQ(25.0, drive.left().inverter().frequency());
  EXPECT_EQ(0x0000, drive.left().counters().last_control);
}

// Under local control the terminals turn it; it is left alone all the same.
TEST(ParameterLink, LeavesADriveAloneThatItsTerminalsTurn) {
  LinkedDrive drive;
  drive.left().inverter().setLocalControl(true, 0.0);
  drive.segment().run(seconds{1});
  drive.left().inverter().setLocalControl(true, 20.0);
  drive.segment().run(seconds{4});
  ASSERT_EQ(InverterState::kOperationEnabled, drive.left().inverter().state());
  EXPECT_THAT(drive.trouble(), HasSubstr("not at rest"));
  drive.segment().run(seconds{10});
  EXPECT_DOUBLE_EQ(20.0, drive.left().inverter().frequency());
}

TEST(ParameterLink, SaysNothingToTheOtherDrivesOfTheBus) {
  LinkedDrive drive;
  drive.connect();
  drive.link().read(parameter(105));
  drive.link().finish();
  EXPECT_EQ(0u, drive.right().counters().telegrams);
}

// Another master would be heard meanwhile.
TEST(ParameterLink, ListensForHalfASecondBeforeItsFirstTelegram) {
  LinkedDrive drive;
  const Instant start = drive.segment().now();
  drive.connect();
  const auto telegrams = drive.transport().trace()->copy();
  ASSERT_FALSE(telegrams.empty());
  EXPECT_GE(telegrams.front().time - start, milliseconds{500});
}

// 047E alone says "set 1": the drive keeps its own, and a parameter without a set is that of the set in force.
TEST(ParameterLink, KeepsTheParameterSetInForce) {
  LinkedDrive drive;
  sim::ProcessData data;
  data.control = 0x847E;
  drive.left().inverter().receive(data);
  drive.segment().run(seconds{1});
  ASSERT_EQ(2u, drive.left().inverter().parameterSet());
  const auto switches = drive.left().inverter().setSwitches();
  drive.connect();
  EXPECT_EQ(3, drive.link().read(parameter(105)).set);
  drive.link().finish();
  EXPECT_EQ(switches, drive.left().inverter().setSwitches());
  EXPECT_EQ(0x847E, drive.left().counters().last_control);
}

// P513 > 0 trips on control words with bit 10 = 0 (E10.3): the idle word keeps it quiet as long as the program runs.
// Nothing can after that, so it is said.
TEST(ParameterLink, TelegramTimeoutIsKeptQuietAndThenNamed) {
  LinkedDrive drive{{{513, 0, 0, 10}}};
  drive.connect();
  const Instant end = drive.segment().now() + seconds{5};
  while (drive.segment().now() < end) ASSERT_TRUE(drive.link().read(parameter(105)).success);
  EXPECT_EQ(0, drive.left().inverter().faultNumber());
  EXPECT_THAT(drive.link().finish(), ElementsAre(HasSubstr("drive left has P513 = 1 s")));
  drive.segment().run(seconds{3});
  EXPECT_EQ(sim::fault::kTimeout, drive.left().inverter().faultNumber());
}

// Behind SK CU4-PBR the module's P151 watches in place of P513, and all four inverters are in the same telegrams.
TEST(ParameterLink, NamesTheTimeoutOfAModuleThatServesSeveral) {
  const YAML::Node file = YAML::Load(
      "{cycle_rate: 100, bus: {device: simulated, baud_rate: 500000, slot_time: 0.0005}, drives: {"
      " one: {address: 5, inverter: 1, series: sk2xxe, pole_pairs: 2},"
      " two: {address: 5, inverter: 2, series: sk2xxe, pole_pairs: 2}}}");
  sim::SimConfig simulated;
  for (const unsigned place : {1u, 2u}) {
    sim::DriveConfig drive;
    drive.name = place == 1 ? "one" : "two";
    drive.address = 5;
    drive.device.series = sim::Series::kSk2xxe;
    drive.place = place;
    simulated.drives.push_back(drive);
  }
  sim::ModuleConfig module;
  module.settings.address = 5;
  module.parameters = {{151, 0, 0, 1000}};
  simulated.bus.as<sim::DpBusConfig>().modules.push_back(module);
  sim::SimulatedSegment* segment = nullptr;
  ProfibusDpTransport transport([&](const link::SerialSettings&) {
    auto made = std::make_unique<sim::SimulatedSegment>(simulated);
    segment = made.get();
    return made;
  });
  const ToolConfig config = readToolConfig(file, "two");
  ParameterLink link{config, transport, catalogue::shippedCatalogues()};
  const std::atomic<bool> not_asked{false};
  link.connect(seconds{5}, not_asked);
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(link.read(parameter(105)).success);
  segment->run(milliseconds{500});
  EXPECT_THAT(link.finish(), ElementsAre(HasSubstr("drive two has P151 = 1 s")));
  EXPECT_EQ(0, segment->drive(0).inverter().faultNumber());
  EXPECT_EQ(0, segment->drive(1).inverter().faultNumber());
  segment->run(seconds{3});
  EXPECT_EQ(sim::fault::kTimeout, segment->drive(1).inverter().faultNumber());
}

// PPO 3 leaves the records, and the module answers RS at their access point: that, and not the PPO type, is the reason.
TEST(ParameterLink, NamesAModuleThatRefusesRecords) {
  const YAML::Node file = YAML::Load(
      "{cycle_rate: 100, bus: {device: simulated, baud_rate: 500000, slot_time: 0.0005}, drives: {"
      " one: {address: 5, inverter: 1, series: sk2xxe, ppo_type: 3, pole_pairs: 2, max_frequency: 50.0}}}");
  sim::SimConfig simulated;
  sim::DriveConfig drive;
  drive.name = "one";
  drive.address = 5;
  drive.bus.as<sim::DpDriveConfig>().ppo_type = 3;
  drive.device.series = sim::Series::kSk2xxe;
  drive.place = 1;
  simulated.drives.push_back(drive);
  sim::ModuleConfig module;
  module.settings.address = 5;
  module.settings.records.active = false;
  simulated.bus.as<sim::DpBusConfig>().modules.push_back(module);
  ProfibusDpTransport transport(
      [&](const link::SerialSettings&) { return std::make_unique<sim::SimulatedSegment>(simulated); });
  const ToolConfig config = readToolConfig(file, "one");
  ParameterLink link{config, transport, catalogue::shippedCatalogues()};
  const std::atomic<bool> not_asked{false};
  link.connect(seconds{5}, not_asked);
  const ParameterAnswer answer = link.read(parameter(105));
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(
      answer.message,
      HasSubstr("no parameter channel reaches P105 of drive one: its bus module refuses acyclic requests (DP-V1): it "
                "answers RS"));
}

// The records are addressed in the way this module does not know: refused in the words of DP-V1, not of another bus.
TEST(ParameterLink, TellsARefusalOfTheRecordInTheWordsOfDpv1) {
  const YAML::Node file = YAML::Load(
      "{cycle_rate: 100, bus: {device: simulated, baud_rate: 500000, slot_time: 0.0005, record_addressing: slot},"
      " drives: {one: {address: 5, inverter: 1, series: sk2xxe, ppo_type: 3, pole_pairs: 2, max_frequency: 50.0}}}");
  sim::SimConfig simulated;
  sim::DriveConfig drive;
  drive.name = "one";
  drive.address = 5;
  drive.bus.as<sim::DpDriveConfig>().ppo_type = 3;
  drive.device.series = sim::Series::kSk2xxe;
  drive.place = 1;
  simulated.drives.push_back(drive);
  sim::ModuleConfig module;
  module.settings.address = 5;
  simulated.bus.as<sim::DpBusConfig>().modules.push_back(module);
  ProfibusDpTransport transport(
      [&](const link::SerialSettings&) { return std::make_unique<sim::SimulatedSegment>(simulated); });
  const ToolConfig config = readToolConfig(file, "one");
  ParameterLink link{config, transport, catalogue::shippedCatalogues()};
  const std::atomic<bool> not_asked{false};
  link.connect(seconds{5}, not_asked);
  const ParameterAnswer answer = link.read(parameter(105));
  EXPECT_TRUE(answer.refused);
  EXPECT_EQ("drive one refuses P105: DP-V1 error B2, invalid slot (80 B2 00)", answer.message);
}

// An order left standing is executed for ever (BU 2700 6.5).
TEST(ParameterLink, LeavesNoOrderStanding) {
  LinkedDrive drive;
  drive.connect();
  writeValue(drive.link(), parameter(102), value(3.0));
  EXPECT_NE(0u, drive.left().pkw().answer().label());
  drive.link().finish();
  EXPECT_EQ(0u, drive.left().pkw().answer().label());
}

// An inverter without orders that spare the EEPROM is written with P560 = 0, which must not stay (BU 0020 7.5.1).
TEST(ParameterLink, PutsP560Back) {
  LinkedDrive drive{{}, false};
  drive.connect();
  const ParameterAnswer written = writeValue(drive.link(), parameter(102), value(3.0));
  EXPECT_TRUE(written.success) << written.message;
  EXPECT_THAT(written.message, HasSubstr("put back to 1"));
  EXPECT_THAT(drive.link().finish(), IsEmpty());
  EXPECT_EQ(1, drive.left().parameters().value(560));
  EXPECT_EQ(300, drive.left().parameters().value(102));
}

TEST(ParameterLink, SaysWhyAnAccessFailed) {
  LinkedDrive drive;
  drive.connect();
  const ParameterAnswer refused = drive.link().read(parameter(999));
  EXPECT_TRUE(refused.refused);
  EXPECT_THAT(refused.message, HasSubstr("no parameter of this number"));
  drive.left().pkw().setSilent(true);
  const ParameterAnswer silent = drive.link().read(parameter(105));
  EXPECT_FALSE(silent.success);
  EXPECT_FALSE(silent.refused);
  EXPECT_EQ("drive left gave no answer for P105", silent.message);
  drive.left().setPlugged(false);
  EXPECT_EQ("drive left does not answer", drive.link().read(parameter(105)).message);
  EXPECT_THAT(drive.link().finish(), IsEmpty());
}

// A few lost telegrams are no reason to send a technician away: a loaded computer loses them, too.
TEST(ParameterLink, AsksAgainWhenTheLineWasLostForAMoment) {
  LinkedDrive drive;
  drive.connect();
  drive.segment().loseAnswers(8);
  const ParameterAnswer read = drive.link().read(parameter(105));
  EXPECT_TRUE(read.success) << read.message;
  drive.segment().loseAnswers(8);
  const ParameterAnswer written = writeValue(drive.link(), parameter(102), value(3.0));
  EXPECT_TRUE(written.success) << written.message;
  EXPECT_EQ(300, drive.left().parameters().value(102));
}

TEST(ParameterLink, SaysThatAPpoTypeHasNoParameterChannel) {
  LinkedDrive drive{{}, true, 3};
  drive.connect();
  EXPECT_THAT(drive.link().read(parameter(105)).message, HasSubstr("no parameter channel"));
}

TEST(ParameterLink, SaysWhyNobodyAnswers) {
  LinkedDrive silent;
  silent.left().setPlugged(false);
  EXPECT_THAT(silent.trouble(), HasSubstr("no station answers"));
  LinkedDrive gone;
  gone.segment().setDevicePresent(false);
  EXPECT_THAT(gone.trouble(), ::testing::Not(IsEmpty()));
}

TEST(ParameterLink, EndsWhenItIsAskedTo) {
  LinkedDrive drive;
  const std::atomic<bool> asked{true};
  EXPECT_THROW(drive.link().connect(seconds{5}, asked), Trouble);
}

// Terminals may turn a drive while the program runs; a new P105 would be a step of what its setpoints mean.
TEST(ParameterLink, DoesNotChangeTheScaleOfADriveThatTurns) {
  LinkedDrive drive;
  drive.connect();
  drive.left().inverter().setLocalControl(true, 20.0);
  const Instant end = drive.segment().now() + seconds{2};
  while (drive.segment().now() < end) drive.link().read(parameter(102));
  EXPECT_THROW(writeValue(drive.link(), parameter(105), value(60.0)), Trouble);
  EXPECT_EQ(500, drive.left().parameters().value(105));
  EXPECT_TRUE(writeValue(drive.link(), parameter(102), value(3.0)).success);
}

}  // namespace
}  // namespace nord_driver::tools
