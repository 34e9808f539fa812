#include <gtest/gtest.h>

#include "profibus/record_wire.h"

namespace nord_driver::profibus {
namespace {

constexpr const char* kHasF5 = "68 06 06 68 81 88 08 3E 3B F5 7F 16";
constexpr const char* kCfgFault = "68 0B 0B 68 81 88 08 3E 3C 06 05 00 FF 75 31 3B 16";

SlaveConfig checked(ConfigurationCheck check) {
  SlaveConfig slave = nordModule(8);
  slave.configuration_check = check;
  return slave;
}

// As captured between an S7 and its slave: Slave_Diag 6D, Get_Cfg 5D, Set_Prm 7D, Chk_Cfg 5D.
TEST(GetConfiguration, InTheStartUp) {
  NordWire wire{quietBus(), checked(ConfigurationCheck::kTell)};
  wire.isFound();
  wire.isFree();
  EXPECT_EQ(SlavePhase::kReadConfiguration, wire.status().phase);
  wire.cycle(kGetCfg5D, kHasPpo1);
  wire.cycle(kSetPrm7D, kShortAcknowledge);
  wire.cycle(kChkCfg5D, kShortAcknowledge);
  wire.cycle(kDiag7D, kReady);
  EXPECT_EQ(SlavePhase::kDataExchange, wire.status().phase);
  EXPECT_EQ("F3 F1", toHex(wire.status().configuration));
  wire.tells(DpEventKind::kSlaveFound);
  wire.tells(DpEventKind::kDataExchangeEntered);
  wire.tellsNothing();
}

// F5 is PPO 4 on a module 7531h, 12 bytes like PPO 1: told in words with both lists, and Chk_Cfg decides.
TEST(GetConfiguration, TellsADifference) {
  NordWire wire{quietBus(), checked(ConfigurationCheck::kTell)};
  EXPECT_STREQ("has not been asked for its configuration, or did not tell", wire.master.configurationText(0).c_str());
  wire.isFound();
  wire.isFree();
  wire.forgetEvents();
  wire.cycle(kGetCfg5D, kHasF5);
  EXPECT_STRNE("", wire.tells(DpEventKind::kConfigurationDiffers).text);
  EXPECT_STREQ(
      "has another than the configured configuration: configured are F3 F1 (12 bytes out, 12 in), it reports F5 (12 "
      "bytes out, 12 in)",
      wire.master.configurationText(0).c_str());
  wire.cycle(kSetPrm7D, kShortAcknowledge);
}

// Where the difference is not to be tried: no parameters, a pause, the reason in words.
TEST(GetConfiguration, RefusesADifference) {
  NordWire wire{quietBus(), checked(ConfigurationCheck::kRequire)};
  wire.isFound();
  wire.isFree();
  wire.forgetEvents();
  wire.cycle(kGetCfg5D, kHasF5);
  wire.tells(DpEventKind::kConfigurationDiffers);
  EXPECT_EQ(SlavePhase::kBackOff, wire.status().phase);
  EXPECT_EQ(1u, wire.status().counters.refusals);
  wire.startCycle();
  wire.cycleEnds();
}

// A slave that does not know Get_Cfg may still know Chk_Cfg.
TEST(GetConfiguration, RefusedServiceIsNoFault) {
  NordWire wire{quietBus(), checked(ConfigurationCheck::kRequire)};
  wire.isFound();
  wire.isFree();
  wire.cycle(kGetCfg5D, kNotActivated);
  EXPECT_EQ(SlavePhase::kParameters, wire.status().phase);
  EXPECT_TRUE(wire.status().configuration.empty());
}

// So does one that does not answer it at all: the next request begins the frame count anew.
TEST(GetConfiguration, SilenceIsNoFault) {
  NordWire wire{quietBus(), checked(ConfigurationCheck::kRequire)};
  wire.isFound();
  wire.isFree();
  wire.startCycle();
  wire.sends(kGetCfg5D);
  wire.staysSilent();
  wire.sends(kGetCfg5D);
  wire.staysSilent();
  wire.cycleEnds();
  wire.cycle("68 0C 0C 68 88 81 6D 3D 3E 88 0A 01 0B 75 31 00 35 16", kShortAcknowledge);
}

// After a Cfg_Fault the next start-up asks, so that the fault can be told with both lists.
TEST(GetConfiguration, AfterAFault) {
  NordWire wire;
  wire.isFound();
  wire.isFree();
  wire.takesParameters();
  wire.takesConfiguration();
  wire.cycle(kDiag5D, kCfgFault);
  wire.forgetEvents();
  wire.advance(std::chrono::milliseconds{250});
  wire.isFree();
  wire.cycle(kGetCfg5D, kHasF5);
  wire.tells(DpEventKind::kConfigurationDiffers);
}

TEST(GetConfiguration, NeverWhenNotWanted) {
  NordWire wire{quietBus(), checked(ConfigurationCheck::kNever)};
  wire.isFound();
  wire.isFree();
  wire.takesParameters();
  wire.takesConfiguration();
  wire.cycle(kDiag5D, kCfgFault);
  wire.advance(std::chrono::milliseconds{250});
  wire.isFree();
  wire.takesParameters();
}

// On demand, beside data exchange; a difference or a refusal leaves the exchange alone.
TEST(GetConfiguration, OnDemand) {
  NordWire wire;
  EXPECT_FALSE(wire.master.requestConfiguration(0));
  wire.startsUp();
  for (const char* answer : {kHasPpo1, kHasF5, kNotActivated}) {
    ASSERT_TRUE(wire.master.requestConfiguration(0));
    wire.startCycle();
    wire.sends(kExchange7D);
    wire.receives(kInputs);
    wire.sends(kGetCfg5D);
    wire.receives(answer);
    wire.cycleEnds();
    const DpEvent read = wire.tells(DpEventKind::kConfigurationRead);
    EXPECT_EQ(answer == kNotActivated, std::string{} != read.text);
    if (answer == kHasF5) wire.tells(DpEventKind::kConfigurationDiffers);
    wire.tellsNothing();
    EXPECT_EQ(SlavePhase::kDataExchange, wire.status().phase);
  }
  wire.cycle(kExchange7D, kInputs);
}

TEST(GetConfiguration, OnDemandWithoutAnAnswer) {
  NordWire wire;
  wire.startsUp();
  ASSERT_TRUE(wire.master.requestConfiguration(0));
  wire.startCycle();
  wire.sends(kExchange7D);
  wire.receives(kInputs);
  wire.sends(kGetCfg5D);
  wire.staysSilent();
  wire.sends(kGetCfg5D);
  wire.staysSilent();
  wire.cycleEnds();
  EXPECT_STRNE("", wire.tells(DpEventKind::kConfigurationRead).text);
  wire.cycle(kExchange6D, kInputs);
  EXPECT_EQ(0u, wire.status().counters.losses);
}

// Zeros are never stripped: an empty slot is a byte of its own (BU 0220 4.2.2.4).
TEST(ModularStation, SendsItsWholeModuleList) {
  struct Example {
    std::vector<std::uint8_t> configuration;
    std::size_t bytes;
    const char* chk_cfg;
  };
  const Example examples[] = {
      {{0x00, 0xF5}, 12, "68 07 07 68 88 81 7D 3E 3E 00 F5 F7 16"},
      {{0x30, 0xF5}, 13, "68 07 07 68 88 81 7D 3E 3E 30 F5 27 16"},
      {{0x30, 0xF7, 0xF1, 0x00, 0xF3}, 29, "68 0A 0A 68 88 81 7D 3E 3E 30 F7 F1 00 F3 0D 16"},
  };
  for (const Example& example : examples) {
    SlaveConfig slave = modularModule(8);
    slave.configuration = example.configuration;
    slave.output_length = slave.input_length = example.bytes;
    NordWire wire{quietBus(), slave};
    wire.isFound();
    wire.cycle(kDiag6D, "68 0B 0B 68 81 88 08 3E 3C 02 05 00 FF 0B A8 44 16");
    wire.cycle("68 0F 0F 68 88 81 5D 3D 3E 88 0A 01 0B 0B A8 00 80 00 00 B2 16", kShortAcknowledge);
    wire.cycle(example.chk_cfg, kShortAcknowledge);
    EXPECT_EQ(SlavePhase::kAwaitReady, wire.status().phase);
  }
}

// With the I/O byte in slot 1 the first inverter's words begin at an odd offset.
TEST(ModularStation, ExchangesAtOddOffsets) {
  SlaveConfig slave = modularModule(8);
  slave.configuration = {0x30, 0xF1};
  slave.output_length = slave.input_length = 5;
  RecordWire wire{slave};
  wire.isFound();
  wire.cycle(kDiag6D, "68 0B 0B 68 81 88 08 3E 3C 02 05 00 FF 0B A8 44 16");
  wire.cycle("68 0F 0F 68 88 81 5D 3D 3E 88 0A 01 0B 0B A8 00 80 00 00 B2 16", kShortAcknowledge);
  wire.cycle("68 07 07 68 88 81 7D 3E 3E 30 F1 23 16", kShortAcknowledge);
  wire.cycle(kDiag5D, kReady0ba8);
  wire.master.setOutputs(0, fromHex("00 04 7E 12 34"));
  wire.cycle("68 08 08 68 08 01 7D 00 04 7E 12 34 4E 16", "68 08 08 68 01 08 08 A5 0B 31 00 00 F2 16");
  EXPECT_EQ("A5 0B 31 00 00", toHex(wire.master.inputs(0)));
}

}  // namespace
}  // namespace nord_driver::profibus
