#include <gtest/gtest.h>

#include "sim/profibus/conversation.h"

namespace nord_driver::sim {
namespace {

using std::chrono::milliseconds;

// A station starts as the standard has it, byte for byte: FDL status, diagnosis, Set_Prm, Chk_Cfg, data exchange.
TEST(DpSlave, AnswersTheStartUpByteForByte) {
  Conversation bus;
  EXPECT_EQ("10 01 08 00 09 16", bus.ask("10 08 01 49 52 16"));
  EXPECT_EQ("68 0B 0B 68 81 88 08 3E 3C 02 05 00 FF 75 31 37 16", bus.ask("68 05 05 68 88 81 6D 3C 3E F0 16"));
  EXPECT_EQ("E5", bus.ask("68 0C 0C 68 88 81 5D 3D 3E 88 0A 01 0B 75 31 00 25 16"));
  EXPECT_EQ("E5", bus.ask("68 07 07 68 88 81 7D 3E 3E F3 F1 E6 16"));
  EXPECT_EQ("68 0B 0B 68 81 88 08 3E 3C 00 0C 00 01 75 31 3E 16", bus.ask("68 05 05 68 88 81 5D 3C 3E E0 16"));
  EXPECT_EQ("68 0F 0F 68 01 08 08 00 00 00 00 00 00 00 00 0B 70 00 00 8C 16",
            bus.ask("68 0F 0F 68 08 01 7D 00 00 00 00 00 00 00 00 04 7E 00 00 08 16"));
  EXPECT_EQ("68 0F 0F 68 01 08 08 00 00 00 00 00 00 00 00 0B 31 00 00 4D 16",
            bus.ask("68 0F 0F 68 08 01 5D 00 00 00 00 00 00 00 00 04 7E 00 00 E8 16"));
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
}

// Start-up to 50 %, BU 0020 9.1 and 9.2: 0B70, 047E, 0B31, 047F 2000, 0B37 2000.
TEST(DpSlave, FollowsTheManualsTelegramExamples) {
  Conversation bus;
  bus.startUp();
  EXPECT_EQ("0B 70 00 00", bus.pzd("047E 0000"));
  bus.segment.run(milliseconds(5));
  EXPECT_EQ("0B 31 00 00", bus.pzd("047F 2000"));
  EXPECT_EQ("0B 37 20 00", bus.pzdFor("047F 2000", seconds(2.0)));
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
}

// BU 0020 9.3: P102 of set 3 to 10.00 s.
TEST(DpSlave, WritesAParameterAsTheManualShows) {
  Conversation bus;
  bus.startUp();
  bus.exchange("744E 0200 0000 03E8", "047E 0000");
  EXPECT_EQ("44 4E 02 00 00 00 03 E8", bus.exchange("744E 0200 0000 03E8", "047E 0000").substr(0, 23));
  EXPECT_EQ(1000, bus.drive().parameters().value(102, 2));
  EXPECT_EQ(200, bus.drive().parameters().value(102, 0));
}

// Data exchange before the station is ready is answered with RS.
TEST(DpSlave, RefusesDataExchangeBeforeReady) {
  Conversation bus;
  EXPECT_EQ("10 01 08 03 0C 16", bus.ask("68 0F 0F 68 08 01 6D 00 00 00 00 00 00 00 00 04 7E 00 00 F8 16"));
}

// A wrong ident number is a parameter fault and leads nowhere.
TEST(DpSlave, RefusesAWrongIdent) {
  Conversation bus;
  bus.service(60, {});
  EXPECT_EQ("E5", bus.service(61, {0x88, 10, 1, 11, 0x0B, 0xA8, 0}));
  EXPECT_EQ("68 0B 0B 68 81 88 08 3E 3C 42 05 00 FF 75 31 77 16", bus.service(60, {}));
  EXPECT_EQ(SlaveState::kWaitParameters, bus.station().state());
}

// Set_Prm without Lock_Req does not lead to data exchange.
TEST(DpSlave, NeedsTheLock) {
  Conversation bus;
  bus.service(60, {});
  bus.service(61, {0x08, 10, 1, 11, 0x75, 0x31, 0});
  EXPECT_EQ(SlaveState::kWaitParameters, bus.station().state());
}

// A configuration other than the module's PPO type is a configuration fault.
TEST(DpSlave, RefusesAnotherPpo) {
  Conversation bus;
  bus.service(60, {});
  bus.service(61, {0x88, 10, 1, 11, 0x75, 0x31, 0});
  bus.service(62, {0xF3, 0xF5});
  EXPECT_EQ("68 0B 0B 68 81 88 08 3E 3C 06 05 00 FF 75 31 3B 16", bus.service(60, {}));
}

// PPO 2 of this module has six words of process data, SW2 and SW3 in the order of the series: BU 0020 7.2.
TEST(DpSlave, KnowsTheOtherPpoTypes) {
  const std::vector<std::vector<std::uint8_t>> identifiers{{0xF3, 0xF1}, {0xF3, 0xF5}, {0xF1}, {0xF5}};
  const std::vector<std::size_t> lengths{12, 20, 4, 12};
  for (int ppo = 1; ppo <= 4; ++ppo) {
    SimConfig config = oneDrive();
    config.drives[0].bus.as<DpDriveConfig>().ppo_type = ppo;
    Conversation bus{config};
    bus.service(60, {});
    bus.service(61, {0x88, 10, 1, 11, 0x75, 0x31, 0});
    bus.service(62, identifiers[static_cast<std::size_t>(ppo - 1)]);
    bus.service(60, {});
    const std::vector<std::uint8_t> outputs(lengths[static_cast<std::size_t>(ppo - 1)], 0);
    const std::string answer = bus.askBytes(Conversation::variable(0x08, 0x01, bus.frameCount(), outputs));
    EXPECT_EQ((outputs.size() + 9) * 3 - 1, answer.size()) << "PPO " << ppo << ": " << answer;
    EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
  }
}

// The same FCB with FCV = 1 is a repetition: answered from the store, not executed again.
TEST(DpSlave, DoesNotExecuteARepetition) {
  SimConfig config = oneDrive();
  Conversation bus{config};
  bus.startUp();
  bus.pzd("047E 0000");
  const auto telegram = Conversation::variable(0x08, 0x01, bus.frameCount(), fromHex("744E 0200 0000 03E8 047E 0000"));
  const std::string first = bus.askBytes(telegram);
  const std::uint64_t writes = bus.drive().parameters().eepromWrites();
  const std::uint64_t exchanges = bus.station().counters().data_exchanges;
  bus.segment.run(milliseconds(5));
  EXPECT_EQ(first, bus.askBytes(telegram));
  EXPECT_EQ(writes, bus.drive().parameters().eepromWrites());
  EXPECT_EQ(exchanges, bus.station().counters().data_exchanges);
  EXPECT_EQ(1u, bus.station().counters().repeated);
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
}

// A station that knows no frame count yet takes only FCV = 0 with FCB = 1.
TEST(DpSlave, WantsAFirstRequest) {
  Conversation bus;
  EXPECT_EQ("", bus.ask("68 05 05 68 88 81 5D 3C 3E E0 16"));
  EXPECT_EQ("", bus.ask("68 05 05 68 88 81 4D 3C 3E D0 16"));
  EXPECT_NE("", bus.ask("68 05 05 68 88 81 6D 3C 3E F0 16"));
}

// Watchdog expired: back to waiting for parameters, E10.2 in the inverter, and the wheel coasts.
TEST(DpSlave, WatchdogTripsTheInverterAndTheWheelCoasts) {
  Conversation bus;
  bus.startUp(10);  // 100 ms
  bus.pzdFor("047E 0000", milliseconds(10));
  bus.pzdFor("047F 2000", seconds(2.0));
  const double speed = bus.drive().shaftSpeed();
  ASSERT_GT(speed, 70.0);
  bus.segment.run(milliseconds(98));
  EXPECT_EQ(SlaveState::kDataExchange, bus.station().state());
  bus.segment.run(milliseconds(20));
  EXPECT_EQ(SlaveState::kWaitParameters, bus.station().state());
  EXPECT_EQ(102, bus.drive().inverter().faultNumber());
  EXPECT_EQ(0x047F, bus.station().counters().control_before_loss);
  EXPECT_EQ(0x0B37, bus.station().counters().status_at_loss);
  EXPECT_EQ(0.0, bus.drive().inverter().frequency());
  EXPECT_GT(bus.drive().shaftSpeed(), 0.9 * speed);
  bus.segment.run(seconds(60.0));
  EXPECT_EQ(0.0, bus.drive().shaftSpeed());
}

// The module with its own 24 V answers for an inverter that is off: zeros, and the diagnosis 02 04 (BU 0020 8.2).
TEST(DpSlave, AnswersForAnInverterThatIsOff) {
  Conversation bus;
  bus.startUp();
  bus.pzd("047E 0000");
  bus.drive().setInverterPower(false);
  const std::string answer =
      bus.askBytes(Conversation::variable(0x08, 0x01, bus.frameCount(), fromHex("0000 0000 0000 0000 047E 0000")));
  EXPECT_EQ("68 0F 0F 68 01 08 0A 00 00 00 00 00 00 00 00 00 00 00 00 13 16", answer);
  EXPECT_EQ("68 0D 0D 68 81 88 08 3E 3C 08 0C 00 01 75 31 02 04 4C 16", bus.service(60, {}));
  EXPECT_EQ("00 00 00 00", bus.pzd("047E 0000"));
  bus.drive().setInverterPower(true);
  bus.segment.run(milliseconds(5));
  EXPECT_EQ("0B 30 00 00", bus.pzd("047E 0000"));  // charging
  EXPECT_EQ("0B 31 00 00", bus.pzdFor("047E 0000", milliseconds(400)));
}

// A zero control word is the master's mistake while an inverter could lose its commands by it, not while the inverter
// is off behind the living module, nor before the first valid word after it came back.
TEST(DpSlave, ZerosToAnInverterThatIsOffAreNoMistake) {
  Conversation bus;
  bus.startUp(0);
  bus.pzd("047E 0000");
  bus.drive().setInverterPower(false);
  bus.pzdFor("0000 0000", seconds(12.0));
  bus.drive().setInverterPower(true);
  bus.pzdFor("0000 0000", milliseconds(20));
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
  bus.pzd("047E 0000");
  bus.pzd("0000 0000");
  EXPECT_EQ(1u, bus.referee().count(Rule::kZeroControlWord));
  EXPECT_EQ(1u, bus.drive().counters().zero_control_words);
}

// Unplugged: silence; plugged in again, it wants everything from the start.
TEST(DpSlave, IsSilentWithoutPower) {
  Conversation bus;
  bus.startUp();
  bus.drive().setPlugged(false);
  EXPECT_EQ("", bus.pzd("047E 0000"));
  EXPECT_EQ("", bus.ask("10 08 01 49 52 16"));
  bus.drive().setPlugged(true);
  EXPECT_EQ("10 01 08 00 09 16", bus.ask("10 08 01 49 52 16"));
  EXPECT_EQ(SlaveState::kWaitParameters, bus.station().state());
}

// Global_Control is a broadcast without answer; a token to oneself is nobody's business.
TEST(DpSlave, IsSilentToBroadcastsAndTokens) {
  Conversation bus;
  EXPECT_EQ("", bus.ask("68 07 07 68 FF 81 46 3A 3E 00 00 3E 16"));
  EXPECT_EQ("", bus.ask("DC 01 01"));
  EXPECT_EQ(1u, bus.station().counters().global_controls);
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
}

}  // namespace
}  // namespace nord_driver::sim
