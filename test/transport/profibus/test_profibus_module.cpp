// The PROFIBUS transport with a module SK CU4/TU4-PBR: several inverters in one station, records beside the exchange.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "sim/profibus/simulated_segment.h"
#include "support/map_settings.h"
#include "transport/profibus/ask_parameter.h"
#include "transport/profibus/profibus_dp.h"

namespace nord_driver {
namespace {

using profile::ParameterOutcome;
using std::chrono::milliseconds;
using std::chrono::seconds;
using test::MapSettings;
using ::testing::Contains;
using ::testing::HasSubstr;

/// Inverters at station 3, numbered from 1, in these PPO types.
class OnAModule : public ::testing::Test {
 protected:
  void open(const std::vector<int>& ppo_types, bool io_byte = false, std::uint8_t simulated_address = 3) {
    std::vector<DriveSettings> drives;
    sim::SimConfig config;
    for (std::size_t i = 0; i < ppo_types.size(); ++i) {
      const std::string name = "fi" + std::to_string(i + 1);
      auto settings = std::make_shared<MapSettings>("~drives/" + name + "/");
      settings->set("address", 3).set("series", "sk2xxe").set("pole_pairs", 2).set("ppo_type", ppo_types[i]);
      settings->set("inverter", static_cast<int>(i + 1)).set("io_byte", io_byte);
      if (!user_parameters_.empty()) settings->set("user_parameters", user_parameters_.c_str());
      drives.push_back({name, settings});
      sim::DriveConfig drive;
      drive.name = name;
      drive.address = simulated_address;
      drive.device.series = sim::Series::kSk2xxe;
      drive.place = static_cast<unsigned>(i + 1);
      config.drives.push_back(drive);
    }
    config.drives.insert(config.drives.end(), beside_.begin(), beside_.end());
    outputs_.resize(ppo_types.size());
    inputs_.resize(ppo_types.size());
    transport_ = std::make_unique<ProfibusDpTransport>([&](const link::SerialSettings&) {
      auto segment = std::make_unique<sim::SimulatedSegment>(config);
      segment_ = segment.get();
      return segment;
    });
    bus_.set("device", "simulated").set("slot_time", 0.0005);
    transport_->configure(bus_, drives, 100.0);
  }
  void step() {
    const Instant start = transport_->now();
    transport_->exchange(outputs_, inputs_);
    transport_->sleepUntil(start + milliseconds{10});
    while (const auto event = transport_->pollEvent()) events_.push_back(event->text.str());
  }
  void run(Duration span) {
    const Instant end = transport_->now() + span;
    while (transport_->now() < end) step();
  }
  bool allAnswer() const {
    for (const DriveExchange& input : inputs_) {
      if (!input.inverter_answers) return false;
    }
    return true;
  }
  void bringUp(const std::vector<int>& ppo_types, bool io_byte = false) {
    open(ppo_types, io_byte);
    for (int i = 0; i < 200 && !allAnswer(); ++i) step();
    ASSERT_TRUE(allAnswer());
    for (auto& output : outputs_) output.control_word = 0x047E;
    run(milliseconds{500});
  }
  profile::ParameterResult ask(DriveIndex drive, std::uint16_t number,
                               profile::ParameterAction action = profile::ParameterAction::kRead,
                               std::int32_t raw = 0) {
    return askParameter(*transport_, drive, number, action, raw, 300, [this] { step(); });
  }
  /// Every telegram sent, in hexadecimal.
  std::vector<std::string> sent() const {
    std::vector<std::string> telegrams;
    for (const TraceRecord& record : transport_->trace()->copy()) {
      if (record.kind == TraceKind::kSent) telegrams.push_back(toHex(record.view()));
    }
    return telegrams;
  }

  MapSettings bus_{"~bus/"};
  std::string user_parameters_;
  std::vector<sim::DriveConfig> beside_;  ///< of other stations
  sim::SimulatedSegment* segment_ = nullptr;
  std::unique_ptr<ProfibusDpTransport> transport_;
  std::vector<profile::ProcessOutput> outputs_;
  std::vector<DriveExchange> inputs_;
  std::vector<std::string> events_;
};

// Set_Prm with the DP-V1 bytes, Chk_Cfg 00 F5, byte for byte (station 3, master 1, watchdog 0.2 s = 20 x 1 x 10 ms).
TEST_F(OnAModule, StartsUpByteForByte) {
  bringUp({1});
  EXPECT_THAT(sent(), Contains("68 0F 0F 68 83 81 5D 3D 3E 88 14 01 0B 0B A8 00 80 00 00 B7 16"));
  EXPECT_THAT(sent(), Contains("68 07 07 68 83 81 7D 3E 3E 00 F5 F2 16"));
  EXPECT_EQ(0x0BA8u, transport_->identNumber(0));
  EXPECT_EQ("PROFIBUS station 3, inverter 1", transport_->identity(0).address);
  EXPECT_EQ("no rule broken", segment_->referee().report());
}

// 30 F7 F1 ... : slot 1 one byte, then PPO 2 at offset 1, PPO 3 at offset 17. Everyone gets and gives its own words.
TEST_F(OnAModule, CarriesEachInverterItsOwnWordsAtOddOffsets) {
  bringUp({2, 3, 1}, true);
  EXPECT_THAT(sent(), Contains("68 09 09 68 83 81 7D 3E 3E 30 F7 F1 F5 0A 16"));
  for (auto& output : outputs_) output.control_word = 0x047F;
  outputs_[0].setpoints[0] = 0x2000;
  outputs_[1].setpoints[0] = -0x1000;
  outputs_[2].setpoints[0] = 0x0800;
  run(seconds{4});
  EXPECT_EQ(0x2000, inputs_[0].input.actual_values[0]);
  EXPECT_EQ(-0x1000, inputs_[1].input.actual_values[0]);
  EXPECT_EQ(0x0800, inputs_[2].input.actual_values[0]);
  EXPECT_EQ(1u, transport_->config().drives[0].offset);
  EXPECT_EQ("no rule broken", segment_->referee().report());
}

// One module for all of them: with it, all have left.
TEST_F(OnAModule, EachInverterIsToldThatTheModuleLeft) {
  bringUp({1, 3});
  segment_->station(0).setPowered(false);
  segment_->station(0).setPowered(true);
  int told = 0;
  for (int i = 0; i < 100; ++i) {
    step();
    EXPECT_EQ(inputs_[0].interruption, inputs_[1].interruption);
    if (inputs_[0].interruption == Interruption::kUnasked) ++told;
  }
  EXPECT_EQ(1, told);
  EXPECT_TRUE(allAnswer());
}

// The driver owns the digital outputs of the module and switches nothing with them.
TEST_F(OnAModule, TheIoByteIsZeroWhateverTheDrivesDo) {
  bringUp({3}, true);
  for (const Word word : std::vector<Word>{0x047E, 0x047F, 0x047B, 0x047E}) {
    outputs_[0].control_word = word;
    outputs_[0].setpoints[0] = 0x7FFF;
    run(milliseconds{50});
  }
  for (const TraceRecord& record : transport_->trace()->copy()) {
    const ByteView bytes = record.view();
    const bool exchange = record.kind == TraceKind::kSent && bytes.size() == 14 && bytes[4] == 0x03;
    if (exchange) {
      EXPECT_EQ(0x00, bytes[7]) << toHex(bytes);
    }
  }
}

// --- Parameters ------------------------------------------------------------------------------------------------------

// P151 is the module's: slot 0, index 100, PNU 1151, though this drive has a PKW.
TEST_F(OnAModule, ReadsAndWritesAParameterOfTheModule) {
  bringUp({1, 1});
  const auto read = ask(1, 151);
  EXPECT_EQ(ParameterOutcome::kDone, read.outcome);
  EXPECT_EQ(77u, read.id);
  EXPECT_EQ(0, read.raw) << "the factory setting";
  EXPECT_EQ(ParameterOutcome::kDone, ask(0, 151, profile::ParameterAction::kWritePersistent, 500).outcome);
  EXPECT_EQ(500, ask(1, 151).raw);
  const auto telegrams = sent();
  bool seen = false;
  for (const std::string& telegram : telegrams) seen |= telegram.find("33 33 5F 00 64 08 14 7F 00 00") != telegram.npos;
  EXPECT_TRUE(seen);
  EXPECT_EQ("no rule broken", segment_->referee().report());
}

// P500 and so on are the inverter's: by its PKW where it has one, by its record where not (PPO 3).
TEST_F(OnAModule, ReadsInverterParametersByPkwOrByRecord) {
  bringUp({1, 3});
  EXPECT_EQ("PKW", transport_->identity(0).parameter_channel);
  EXPECT_EQ("DP-V1 records", transport_->identity(1).parameter_channel);
  segment_->drive(1).parameters().preset(560, 0, 0, 0);
  EXPECT_EQ(1, ask(0, 560).raw);
  EXPECT_EQ(0, ask(1, 560).raw);
  EXPECT_EQ(ParameterOutcome::kRefused, ask(1, 998).outcome);
}

TEST_F(OnAModule, TheOtherAddressingIsASwitch) {
  bus_.set("record_addressing", "slot").set("record_number_offset", false);
  open({3});
  auto& module = segment_->stations().module(0);
  module.recordSettings().by_slot = true;
  module.recordSettings().plain_numbers = true;
  for (int i = 0; i < 200 && !allAnswer(); ++i) step();
  EXPECT_EQ(ParameterOutcome::kDone, ask(0, 151).outcome);
  EXPECT_EQ(1, ask(0, 560).raw);
}

// A module with DP-V1 switched off has no way to its parameters: said in words, not waited for.
TEST_F(OnAModule, WhoeverHasNoChannelIsToldSo) {
  bringUp({3});
  segment_->stations().module(0).recordSettings().busy = 1000;
  const Instant asked = transport_->now();
  EXPECT_EQ(ParameterOutcome::kTimeout, ask(0, 151).outcome);
  EXPECT_LT(transport_->now() - asked, seconds{3});
}

// --- One inverter off behind a living module -------------------------------------------------------------------------

TEST_F(OnAModule, OneInverterOffIsThatDriveOffline) {
  bringUp({1, 1, 1, 1});
  segment_->drive(2).setInverterPower(false);
  run(milliseconds{100});
  for (const DriveIndex drive : {0u, 1u, 3u}) EXPECT_TRUE(inputs_[drive].inverter_answers) << drive;
  EXPECT_TRUE(inputs_[2].module_answers);
  EXPECT_FALSE(inputs_[2].inverter_answers);
  EXPECT_THAT(transport_->note(2).text, HasSubstr("the inverter behind it does not (diagnosis 02 04)"));
  EXPECT_EQ(ParameterOutcome::kOffline, ask(2, 560).outcome);
  EXPECT_EQ(ParameterOutcome::kDone, ask(2, 173).outcome) << "the module answers for itself";
  segment_->drive(2).setInverterPower(true);
  run(seconds{1});
  EXPECT_TRUE(allAnswer());
  EXPECT_STREQ("", transport_->note(2).text);
}

TEST_F(OnAModule, TheModuleGoneIsAllDrivesOffline) {
  bringUp({1, 3});
  segment_->stations().module(0).setMute(true);
  run(milliseconds{50});
  for (const DriveExchange& input : inputs_) EXPECT_FALSE(input.module_answers);
  EXPECT_EQ(ParameterOutcome::kOffline, ask(0, 151).outcome);
}

// --- Words -----------------------------------------------------------------------------------------------------------

// The ident number of Slave_Diag against the configured one, both named.
TEST_F(OnAModule, AnotherModuleThanConfiguredIsNamed) {
  sim::SimConfig config;
  sim::DriveConfig drive;
  drive.address = 3;
  config.drives.push_back(drive);  // SK TU3-PBR, 7531h
  auto settings = std::make_shared<MapSettings>("~drives/fi1/");
  settings->set("address", 3).set("series", "sk2xxe").set("pole_pairs", 2);
  transport_ = std::make_unique<ProfibusDpTransport>(
      [&](const link::SerialSettings&) { return std::make_unique<sim::SimulatedSegment>(config); });
  transport_->configure(bus_.set("device", "simulated").set("slot_time", 0.0005), {{"fi1", settings}}, 100.0);
  outputs_.resize(1);
  inputs_.resize(1);
  run(seconds{1});
  const std::string words =
      "is another module than configured: it reports the ident number 7531h (SK TU1/2/3-PBR), expected 0BA8h "
      "(SK CU4/TU4-PBR)";
  EXPECT_EQ(words, transport_->note(0).text);
  EXPECT_THAT(events_, Contains("PROFIBUS station 3 (fi1) " + words));
}

// One byte of the three that DP-V1 has: the module refuses Set_Prm, which it acknowledges, and then Chk_Cfg.
TEST_F(OnAModule, RefusedParametersAreNamed) {
  user_parameters_ = "80";
  open({1});
  run(seconds{1});
  EXPECT_THAT(transport_->note(0).text, HasSubstr("Prm_Fault"));
  EXPECT_THAT(events_, Contains(HasSubstr("PROFIBUS station 3 (fi1) refuses its parameters (Prm_Fault)")));
  EXPECT_EQ("no rule broken", segment_->referee().report());
}

TEST_F(OnAModule, TellsWhatHappensOnTheBus) {
  bringUp({1, 1});
  EXPECT_THAT(events_, Contains("PROFIBUS station 3 (fi1, fi2) answers, and is being parameterised"));
  EXPECT_THAT(events_, Contains("PROFIBUS station 3 (fi1, fi2) exchanges data"));
  events_.clear();
  segment_->station(0).setMute(true);
  run(milliseconds{100});
  EXPECT_THAT(events_, Contains("PROFIBUS station 3 (fi1, fi2) fell silent: check its power and the cable"));
}

// A scan names who is there, above all the station nobody has given an address yet (126: BU 2700 7.1.2).
TEST_F(OnAModule, AScanNamesTheStationWithoutAnAddress) {
  bus_.set("scan", true);
  open({1}, false, 126);
  step();
  EXPECT_THAT(transport_->busText().c_str(), HasSubstr("every address is asked (scan)"));
  run(seconds{5});
  EXPECT_THAT(transport_->busText().c_str(),
              HasSubstr("scan: stations that answered: 126 (not addressed yet: set its address to 3 to 125)"));
  EXPECT_THAT(
      events_,
      Contains("PROFIBUS station 126 is a slave with the ident number 0BA8h, not addressed yet: set its address "
               "to 3 to 125"));
}

// Each one, however many there are.
TEST_F(OnAModule, AScanNamesEveryStation) {
  constexpr int kFirst = 4, kLast = 125;
  for (int address = kFirst; address <= kLast; ++address) {
    sim::DriveConfig drive;
    drive.name = "beside" + std::to_string(address);
    drive.address = static_cast<std::uint8_t>(address);
    beside_.push_back(drive);
  }
  bus_.set("scan", true);
  open({1});
  run(seconds{5});
  EXPECT_THAT(events_, Contains("PROFIBUS station 3 is a slave with the ident number 0BA8h"));
  for (int address = kFirst; address <= kLast; ++address) {
    EXPECT_THAT(events_,
                Contains("PROFIBUS station " + std::to_string(address) + " is a slave with the ident number 7531h"));
  }
}

TEST_F(OnAModule, ListensFirstWhenAskedTo) {
  bus_.set("listen_first", 0.5);
  open({1});
  step();
  EXPECT_THAT(transport_->busText().c_str(), HasSubstr("listens for other masters"));
  EXPECT_TRUE(sent().empty());
  run(milliseconds{400});
  EXPECT_TRUE(sent().empty());
  run(milliseconds{400});
  EXPECT_FALSE(sent().empty());
  EXPECT_TRUE(allAnswer());
}

// SYNC behind every cycle in which all drives run as they should (68 .. 46 3A 3E 20 00); UNSYNC (10 00) as soon as one
// of them is told to stop, since a slave in SYNC keeps the outputs it has.
TEST_F(OnAModule, SyncIsTakenBackWithTheFirstStopWord) {
  bus_.set("sync", true);
  bringUp({1, 1});
  const auto synchronises = [this] { return sent().back() == "68 07 07 68 FF 81 46 3A 3E 20 00 5E 16"; };
  EXPECT_FALSE(synchronises());
  for (auto& output : outputs_) output.control_word = 0x047F;
  run(seconds{1});
  EXPECT_TRUE(synchronises());
  outputs_[0].setpoints[0] = 0x2000;
  run(seconds{2});
  EXPECT_TRUE(synchronises());
  EXPECT_EQ(0x2000, inputs_[0].input.actual_values[0]);
  outputs_[1].control_word = 0x047B;
  step();
  EXPECT_EQ("68 07 07 68 FF 81 46 3A 3E 10 00 4E 16", sent().back());
}

// The same as soon as one of them does not run: its stop word comes in this cycle or the next.
TEST_F(OnAModule, SyncIsTakenBackWhenADriveStopsByItself) {
  bus_.set("sync", true);
  bringUp({1, 1});
  for (auto& output : outputs_) output.control_word = 0x047F;
  run(seconds{1});
  ASSERT_EQ("68 07 07 68 FF 81 46 3A 3E 20 00 5E 16", sent().back());
  sim::Terminals terminals;
  terminals.coast = true;
  segment_->drive(1).inverter().setTerminals(terminals);
  const auto enabled = [this] { return (inputs_[1].input.status_word & 0x0004) != 0; };
  for (int i = 0; i < 20 && enabled(); ++i) step();
  ASSERT_FALSE(enabled());
  ASSERT_EQ(0, inputs_[1].input.status_word & 0x0008) << "no fault";
  step();
  EXPECT_EQ("68 07 07 68 FF 81 46 3A 3E 10 00 4E 16", sent().back());
}

}  // namespace
}  // namespace nord_driver
