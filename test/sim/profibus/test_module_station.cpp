#include <gtest/gtest.h>

#include "sim/profibus/conversation.h"

namespace nord_driver::sim {
namespace {

using std::chrono::milliseconds;

using Identifiers = std::vector<std::uint8_t>;

// Slave_Diag with ident 0BA8h, Set_Prm with the three DP-V1 bytes, Chk_Cfg 00 F5, twelve bytes each way.
TEST(ModuleStation, AnswersTheStartUpByteForByte) {
  Conversation bus{oneModule(1)};
  EXPECT_EQ("68 0B 0B 68 81 88 08 3E 3C 02 05 00 FF 0B A8 44 16", bus.ask("68 05 05 68 88 81 6D 3C 3E F0 16"));
  EXPECT_EQ("E5", bus.ask("68 0F 0F 68 88 81 5D 3D 3E 88 0A 01 0B 0B A8 00 80 00 00 B2 16"));
  EXPECT_EQ("E5", bus.ask("68 07 07 68 88 81 7D 3E 3E 00 F5 F7 16"));
  EXPECT_EQ("68 0B 0B 68 81 88 08 3E 3C 00 0C 00 01 0B A8 4B 16", bus.ask("68 05 05 68 88 81 5D 3C 3E E0 16"));
  EXPECT_EQ("68 0F 0F 68 01 08 08 00 00 00 00 00 00 00 00 0B 70 00 00 8C 16",
            bus.ask("68 0F 0F 68 08 01 7D 00 00 00 00 00 00 00 00 04 7E 00 00 08 16"));
  EXPECT_EQ("68 0F 0F 68 01 08 08 00 00 00 00 00 00 00 00 0B 31 00 00 4D 16",
            bus.ask("68 0F 0F 68 08 01 5D 00 00 00 00 00 00 00 00 04 7E 00 00 E8 16"));
  EXPECT_EQ("68 07 07 68 81 88 08 3E 3B 00 F5 7F 16", bus.ask("68 05 05 68 88 81 7D 3B 3E FF 16"));
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
}

// BU 0220 4.2.1 and P182: F5, F7, F1, F3 are PPO 1-4 with 12, 16, 4 and 8 bytes; slot 1 is 30h (one byte) or 00h.
TEST(ModuleStation, HasTheLengthsOfItsSlots) {
  const std::vector<std::pair<Identifiers, std::size_t>> cases{
      {{0x00, 0xF5}, 12},
      {{0x30, 0xF5}, 13},
      {{0x00, 0xF7}, 16},
      {{0x00, 0xF1}, 4},
      {{0x00, 0xF3}, 8},
      {{0x30, 0xF7, 0xF1, 0x00, 0xF3}, 29},
      {{0x30, 0x00, 0xF1}, 5},
      {{0x00, 0xF5, 0xF5, 0xF5, 0xF5}, 48},
      {{0x30}, 1},
  };
  for (const auto& [identifiers, length] : cases) {
    Conversation bus{oneModule(4)};
    bus.startUpModule(identifiers);
    const Identifiers data(length, 0);
    const std::string answer = bus.askBytes(Conversation::variable(0x08, 0x01, bus.frameCount(), data));
    EXPECT_EQ((length + 9) * 3 - 1, answer.size()) << toHex(identifiers) << ": " << answer;
    EXPECT_EQ(toHex(identifiers), bus.service(59, {}).substr(27, identifiers.size() * 3 - 1));
    EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
  }
}

// Slot 1 has to be there, there are no more than four inverters, and PPO identifiers of the other modules are unknown.
TEST(ModuleStation, RefusesWrongConfigurations) {
  for (const Identifiers& wrong :
       {Identifiers{0xF5}, Identifiers{0xF5, 0x00}, Identifiers{0x00}, Identifiers{0xF3, 0xF1}, Identifiers{0x00, 0x30},
        Identifiers{0x20, 0xF5}, Identifiers{0x00, 0xF5, 0xF5, 0xF5, 0xF5, 0xF5}, Identifiers{0x00, 0xF9},
        Identifiers{}}) {
    Conversation bus{oneModule(4)};
    bus.startUpModule(wrong);
    EXPECT_EQ(SlaveState::kWaitParameters, bus.station().state()) << toHex(wrong);
    // Cfg_Fault and not ready, Prm_Req, no owner.
    EXPECT_EQ("06 05 00 FF 0B A8", bus.service(60, {}).substr(27, 17)) << toHex(wrong);
  }
}

// Before a master has configured it, Get_Cfg says what is connected.
TEST(ModuleStation, SaysWhatIsConnected) {
  SimConfig config = oneModule(2);
  config.drives[0].bus.as<DpDriveConfig>().ppo_type = 2;
  config.drives[1].bus.as<DpDriveConfig>().ppo_type = 4;
  config.drives[1].place = 4;
  ModuleConfig module;
  module.settings.address = 8;
  module.settings.io_byte = true;
  config.bus.as<DpBusConfig>().modules.push_back(module);
  Conversation bus{config};
  EXPECT_EQ("30 F7 00 00 F3", bus.service(59, {}).substr(27, 14));
}

// With the I/O byte the first PKE is at offset 1; inputs come in it, outputs go out with it, other bits are not used.
TEST(ModuleStation, HasItsOwnInputsAndOutputs) {
  Conversation bus{oneModule(1)};
  bus.segment.stations().module(0).setInputs(0x0A);
  bus.startUpModule({0x30, 0xF5});
  EXPECT_EQ("0A 00 00 00 00 00 00 00 00 0B 70 00 00", bus.outputs("FE 0000 0000 0000 0000 047E 0000"));
  EXPECT_EQ(2, bus.segment.stations().module(0).outputs());
  // P509 (15E5h) is 3: the system bus.
  EXPECT_EQ("0A 00 00 00 00 00 00 00 00 0B 31 00 00", bus.outputs("01 15E5 0000 0000 0000 047E 0000"));
  EXPECT_EQ("0A 15 E5 00 00 00 00 00 03 0B 31 00 00", bus.outputs("01 15E5 0000 0000 0000 047E 0000"));
  EXPECT_EQ(1, bus.segment.stations().module(0).outputs());
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
}

// P150 takes the outputs away from the bus; a watchdog that expires switches them off (BU 0220 4.2.3.1, 5.2.1).
TEST(ModuleStation, OutputsFollowP150AndTheWatchdog) {
  Conversation bus{oneModule(1)};
  ModuleStation& module = bus.segment.stations().module(0);
  bus.startUpModule({0x30, 0xF1});
  bus.outputs("02 047E 0000");
  for (const auto& [value, outputs] : {std::pair{0, 2}, {1, 0}, {2, 1}, {3, 2}, {4, 3}}) {
    module.parameters().preset(150, 0, 0, value);
    EXPECT_EQ(outputs, module.outputs()) << "P150 = " << value;
  }
  module.parameters().preset(150, 0, 0, 0);
  bus.segment.run(milliseconds(150));
  EXPECT_EQ(0, module.outputs());
}

// Every inverter has its own words: the second turns, the others rest.
TEST(ModuleStation, DrivesOneOfFour) {
  Conversation bus{oneModule(4)};
  bus.startUpModule({0x00, 0xF1, 0xF1, 0xF1, 0xF1});
  bus.outputsFor("047E 0000 047E 0000 047E 0000 047E 0000", milliseconds(10));
  EXPECT_EQ("0B 31 00 00 0B 37 20 00 0B 31 00 00 0B 31 00 00",
            bus.outputsFor("047E 0000 047F 2000 047E 0000 047E 0000", seconds(2.0)));
  EXPECT_EQ(0.0, bus.segment.drive(0).shaftSpeed());
  EXPECT_GT(bus.segment.drive(1).shaftSpeed(), 70.0);
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
}

// One inverter off behind the living module: its process data are zero, the diagnosis says 02 04, PKW orders are
// answered with error 102; the others go on. The master is not to blame for zeros to one that is off.
TEST(ModuleStation, LivesOnWithAnInverterOff) {
  Conversation bus{oneModule(2)};
  bus.startUpModule({0x00, 0xF5, 0xF1});
  bus.outputs("0000 0000 0000 0000 047E 0000 047E 0000");
  bus.segment.drive(0).setInverterPower(false);
  // DH: a diagnosis is there.
  EXPECT_EQ("68 13 13 68 01 08 0A 00 00 00 00 00 00 00 00 00 00 00 00 0B 31 00 00 4F 16",
            bus.askBytes(Conversation::variable(0x08, 0x01, bus.frameCount(),
                                                fromHex("15E5 0000 0000 0000 047E 0000 047E 0000"))));
  EXPECT_EQ("68 0D 0D 68 81 88 08 3E 3C 08 0C 00 01 0B A8 02 04 59 16", bus.service(60, {}));
  EXPECT_EQ("75 E5 00 00 00 00 00 66 00 00 00 00 0B 31 00 00", bus.outputs("15E5 0000 0000 0000 0000 0000 047E 0000"));
  EXPECT_EQ("00 00 00 00 00 00 00 00 00 00 00 00 0B 31 00 00",
            bus.outputsFor("0000 0000 0000 0000 0000 0000 047E 0000", seconds(12.0)));
  EXPECT_EQ(SlaveState::kDataExchange, bus.station().state());

  bus.segment.drive(0).setInverterPower(true);
  bus.segment.run(milliseconds(5));
  bus.outputs("0000 0000 0000 0000 0000 0000 047E 0000");  // the master looks before it commands
  EXPECT_EQ("0B 31 00 00 0B 31 00 00",
            bus.outputsFor("0000 0000 0000 0000 047E 0000 047E 0000", milliseconds(400)).substr(24));
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
}

// An inverter that was never there: 101; one that is asked for too often by others: 103 (BU 0220 7.2.3.1).
TEST(ModuleStation, KnowsTheOtherParameterErrors) {
  Conversation bus{oneModule(1)};
  bus.startUpModule({0x00, 0xF5, 0xF5});
  const std::string nothing = "0000 0000 0000 0000 047E 0000";
  bus.outputs(nothing + "15E5 0000 0000 0000 047E 0000");
  EXPECT_EQ("75 E5 00 00 00 00 00 65", bus.outputs(nothing + "15E5 0000 0000 0000 047E 0000").substr(36, 23));
  bus.drive().pkw().refuse(PkwRefusal{103, std::nullopt});
  bus.outputs("15E5 0000 0000 0000 047E 0000" + nothing);
  EXPECT_EQ("75 E5 00 00 00 00 00 67", bus.outputs("15E5 0000 0000 0000 047E 0000" + nothing).substr(0, 23));
}

// The referee knows the length that was configured.
TEST(ModuleStation, RefereeKnowsTheLength) {
  Conversation bus{oneModule(1)};
  bus.startUpModule({0x30, 0xF1});
  bus.outputs("00 047E 0000");
  EXPECT_TRUE(bus.referee().content());
  bus.outputs("047E 0000");
  EXPECT_EQ(1u, bus.referee().count(Rule::kWrongDataLength));
}

// A write order left standing is seen for each inverter by itself.
TEST(ModuleStation, RefereeSeesStandingOrdersOfEachInverter) {
  Conversation bus{oneModule(2)};
  bus.startUpModule({0x00, 0xF5, 0xF5});
  const std::string order = "744E 0200 0000 03E8 047E 0000";
  for (int i = 0; i < 8; ++i) bus.outputs("0000 0000 0000 0000 047E 0000" + order);
  EXPECT_EQ(1u, bus.referee().count(Rule::kWriteOrderLeftStanding));
}

}  // namespace
}  // namespace nord_driver::sim
