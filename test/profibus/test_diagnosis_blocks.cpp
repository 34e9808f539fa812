#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "profibus/diagnosis_blocks.h"
#include "profibus/nord_wire.h"

namespace nord_driver::profibus {
namespace {

/// The blocks in words, separated by bars.
std::string blocks(const char* hex) {
  const auto bytes = fromHex(hex);
  DiagnosisBlocks source{bytes};
  std::string all;
  while (const auto block = source.next()) all += describe(*block).str() + "|";
  return all;
}

// Another project's example: module 8 of 24 by the identifier block, its channel 1 with a short circuit, and three
// bytes of the device.
TEST(DiagnosisBlocks, OfAModularStation) {
  const auto bytes = fromHex("44 00 01 00 88 41 21 04 10 20 30");
  DiagnosisBlocks source{bytes};
  const auto identifier = source.next();
  ASSERT_TRUE(identifier);
  EXPECT_EQ(DiagnosisBlockKind::kIdentifier, identifier->kind);
  EXPECT_EQ(fromHex("00 01 00"), identifier->content());
  const auto channel = source.next();
  ASSERT_TRUE(channel);
  EXPECT_EQ(DiagnosisBlockKind::kChannel, channel->kind);
  EXPECT_EQ(8, channel->module());
  EXPECT_EQ(1, channel->channel());
  EXPECT_TRUE(channel->isInput());
  EXPECT_FALSE(channel->isOutput());
  EXPECT_EQ(1, channel->errorType());
  EXPECT_STREQ("reports of module 8, input 1: short circuit", describe(*channel).c_str());
  const auto device = source.next();
  ASSERT_TRUE(device);
  EXPECT_EQ(DiagnosisBlockKind::kDevice, device->kind);
  EXPECT_EQ("10 20 30", toHex(device->content()));
  EXPECT_FALSE(source.next());
}

// The same project's blocks that are none: named, and nothing behind them is read.
TEST(DiagnosisBlocks, ThatAreNone) {
  EXPECT_EQ(
      "reports a diagnosis of its modules (one bit each): 00 01 00|reports revision 63|"
      "reports a diagnosis block that is none: 12 34|",
      blocks("44 00 01 00 FF 12 34"));
  EXPECT_EQ("reports a diagnosis block that is none: 48 00 01 00|", blocks("48 00 01 00"));
  EXPECT_EQ("reports a diagnosis block that is none: 88 00|", blocks("88 00"));
  EXPECT_EQ("reports a diagnosis block that is none: 08 00 01 00|", blocks("08 00 01 00"));
  EXPECT_EQ("reports a diagnosis block that is none: 00 02 04|", blocks("00 02 04"));
  EXPECT_EQ("reports a diagnosis block that is none: 40|", blocks("40"));
  EXPECT_EQ("", blocks(""));
}

// EN 50170-8: six bits for the number of the module, six for that of the channel, two for its direction, five for the
// error.
TEST(DiagnosisBlocks, EveryBitOfAChannelBlock) {
  EXPECT_EQ("reports of module 63, input and output 63: an error of the device|", blocks("BF FF FF"));
  EXPECT_EQ("reports of module 1, output 1: short circuit|", blocks("81 81 01"));
  EXPECT_EQ("reports of module 0, input 32: wire break|", blocks("80 60 26"));
  EXPECT_EQ("reports revision 1|", blocks("C1"));
}

// Before a station was asked nothing is known of it.
TEST(Diagnosis, OfAStationThatWasNotAsked) {
  const Diagnosis none;
  EXPECT_TRUE(none.empty());
  EXPECT_FALSE(none.notReady() || none.configurationFault() || none.extended() || none.parameterFault());
  EXPECT_FALSE(none.parameterRequest() || none.staticDiagnosis() || none.watchdogOn());
  EXPECT_EQ(0, none.ident());
  EXPECT_EQ(0u, none.extendedBytes().size());
}

// Bit by bit (EN 50170-8, Slave_Diag): station_not_ready, Cfg_Fault, Ext_Diag, Not_Supported, Prm_Fault; Prm_Req,
// Stat_Diag, WD_On.
TEST(Diagnosis, EachBitIsOneFinding) {
  const auto found = [](const char* hex) {
    const auto diagnosis = Diagnosis::from(fromHex(hex));
    EXPECT_TRUE(diagnosis) << hex;
    std::string text;
    if (diagnosis->notReady()) text += "not ready ";
    if (diagnosis->configurationFault()) text += "configuration ";
    if (diagnosis->extended()) text += "extended ";
    if (diagnosis->notSupported()) text += "not supported ";
    if (diagnosis->parameterFault()) text += "parameters ";
    if (diagnosis->parameterRequest()) text += "request ";
    if (diagnosis->staticDiagnosis()) text += "static ";
    if (diagnosis->watchdogOn()) text += "watchdog ";
    return text;
  };
  EXPECT_EQ("not ready ", found("02 00 00 01 75 31"));
  EXPECT_EQ("configuration ", found("04 00 00 01 75 31"));
  EXPECT_EQ("extended ", found("08 00 00 01 75 31"));
  EXPECT_EQ("not supported ", found("10 00 00 01 75 31"));
  EXPECT_EQ("parameters ", found("40 00 00 01 75 31"));
  EXPECT_EQ("request ", found("00 01 00 01 75 31"));
  EXPECT_EQ("static ", found("00 02 00 01 75 31"));
  EXPECT_EQ("watchdog ", found("00 08 00 01 75 31"));
  EXPECT_EQ("", found("A1 F4 FF 01 75 31")) << "none of the others";
}

TEST(DiagnosisBlocks, ChannelErrors) {
  EXPECT_STREQ("wire break", channelErrorName(6));
  EXPECT_STREQ("error", channelErrorName(9));
  EXPECT_STREQ("a reserved error number", channelErrorName(15));
  EXPECT_STREQ("an error of the device", channelErrorName(16));
}

// Whatever the bytes: every one of them is in exactly one block.
RC_GTEST_PROP(DiagnosisBlocks, LoseNoByte, (const std::vector<std::uint8_t>& bytes)) {
  DiagnosisBlocks source{bytes};
  std::vector<std::uint8_t> seen;
  while (const auto block = source.next()) {
    RC_ASSERT(!block->bytes.empty());
    RC_ASSERT(!describe(*block).empty());
    seen.insert(seen.end(), block->bytes.begin(), block->bytes.end());
  }
  RC_ASSERT(seen == bytes);
}

// A module with a supply of its own exchanges data while its inverter is off; its diagnosis says so with 02 04 (BU 0020
// 8.2), and takes it back.
TEST(InverterLink, IsToldByTheDiagnosis) {
  NordWire wire;
  wire.startsUp();
  EXPECT_FALSE(wire.status().inverterLinkBroken());
  wire.startCycle();
  wire.sends(kExchange7D);
  wire.receives(kInputsDh);
  wire.sends(kDiag5D);
  wire.receives("68 0D 0D 68 81 88 08 3E 3C 08 0C 00 01 75 31 02 04 4C 16");
  wire.cycleEnds();
  EXPECT_TRUE(wire.status().inverterLinkBroken());
  EXPECT_TRUE(wire.status().exchanged_this_cycle);
  EXPECT_EQ(SlavePhase::kDataExchange, wire.status().phase);
  wire.startCycle();
  wire.sends(kExchange7D);
  wire.receives(kInputsDh);
  wire.sends(kDiag5D);
  wire.receives(kReady);
  wire.cycleEnds();
  EXPECT_FALSE(wire.status().inverterLinkBroken());
}

// What was known of the inverter is not known any more when the module is lost.
TEST(InverterLink, IsUnknownOfALostModule) {
  NordWire wire;
  wire.startsUp();
  wire.startCycle();
  wire.sends(kExchange7D);
  wire.receives(kInputsDh);
  wire.sends(kDiag5D);
  wire.receives("68 0D 0D 68 81 88 08 3E 3C 08 0C 00 01 75 31 02 04 4C 16");
  wire.cycleEnds();
  wire.startCycle();
  wire.sends(kExchange7D);
  wire.staysSilent();
  wire.sends(kExchange7D);
  wire.staysSilent();
  EXPECT_FALSE(wire.status().inverterLinkBroken());
}

// DH announced it, Slave_Diag was not answered, and the module fell silent. Found again it announces nothing: it has said
// so once.
TEST(InverterLink, IsAskedForWhereTheModuleIsGoneOnWith) {
  NordWire wire;
  wire.master.setSilenceLimit(0, std::chrono::milliseconds{50});
  wire.startsUp();
  wire.announcesWithoutTelling();
  while (wire.status().phase == SlavePhase::kDataExchange) {
    wire.startCycle();
    for (int i = 0; i < 2; ++i) {
      wire.sends(kExchange6D);
      wire.staysSilent();
    }
    wire.cycleEnds();
  }
  EXPECT_EQ(LossCause::kSilence, wire.tells(DpEventKind::kSlaveLost).cause);
  wire.isFound();
  wire.isGoneOnWith("68 0D 0D 68 81 88 08 3E 3C 08 0C 00 01 75 31 02 04 4C 16");
  EXPECT_TRUE(wire.status().inverterLinkBroken());
  wire.cycle(kExchange7D, kInputs);
}

}  // namespace
}  // namespace nord_driver::profibus
