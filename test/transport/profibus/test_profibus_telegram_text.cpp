#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "transport/profibus/profibus_telegram_text.h"

namespace nord_driver {
namespace {

ProfibusDpConfig twoDrives() {
  ProfibusDpConfig config;
  config.slaves.resize(2);
  config.stations.resize(2);
  for (const std::size_t i : {0u, 1u}) {
    config.slaves[i].address = *profibus::StationAddress::from(static_cast<int>(3 + i));
    config.slaves[i].output_length = 12;
    config.stations[i].drives = {i};
  }
  ProfibusDrive left, right;
  left.ppo = *profile::ppoLayout(1, profile::kIdentTechnologyUnit, profile::Series::kSk5xxe);
  right.ppo = *profile::ppoLayout(4, profile::kIdentTechnologyUnit, profile::Series::kSk700e);
  right.slave = 1;
  config.drives = {left, right};
  return config;
}

std::string textOf(const std::string& hex, TraceKind kind = TraceKind::kSent) {
  const auto bytes = fromHex(hex);
  TraceRecord record;
  record.kind = kind;
  record.length = static_cast<std::uint8_t>(bytes.size());
  std::copy(bytes.begin(), bytes.end(), record.bytes.begin());
  return ProfibusTelegramText{twoDrives()}(record);
}

// Process data by the manual's names: BU 2700 6.6.2, 50 % forward, and its answer.
TEST(ProfibusTelegramText, NamesTheProcessData) {
  EXPECT_EQ("DX 3 <- 1 STW 047F SW1 2000", textOf("68 0F 0F 68 03 01 5D 00 00 00 00 00 00 00 00 04 7F 20 00 04 16"));
  EXPECT_EQ("DX 1 <- 3 ZSW 0B37 IW1 2000", textOf("68 0F 0F 68 01 03 08 00 00 00 00 00 00 00 00 0B 37 20 00 6E 16"));
}

// DH announces a diagnosis.
TEST(ProfibusTelegramText, SaysThatADiagnosisWaits) {
  EXPECT_EQ("DX 1 <- 3 ZSW 0B37 IW1 2000, diagnosis waits",
            textOf("68 0F 0F 68 01 03 0A 00 00 00 00 00 00 00 00 0B 37 20 00 70 16"));
}

// The parameter channel's words, while something is in them.
TEST(ProfibusTelegramText, ShowsTheParameterChannel) {
  EXPECT_EQ("DX 3 <- 1 PKW 744E 0200 0000 03E8 STW 047E SW1 0000",
            textOf("68 0F 0F 68 03 01 5D 74 4E 02 00 00 00 03 E8 04 7E 00 00 92 16"));
}

// A connection of class 2, from the resource manager on.
TEST(ProfibusTelegramText, NamesConnectionsOfClass2) {
  EXPECT_EQ("MS2 resource manager 1 <- 8 data 56 30 00 14", textOf("68 09 09 68 81 88 08 32 31 56 30 00 14 0E 16"));
  EXPECT_EQ("MS2 8 <- 1 5E 00 65 08", textOf("68 09 09 68 88 81 5C 30 32 5E 00 65 08 92 16"));
}

// Several inverters behind one module, and its I/O byte before them: FI1 in PPO 1, FI3 in PPO 3.
TEST(ProfibusTelegramText, NamesTheInvertersBehindAModule) {
  ProfibusDpConfig config = twoDrives();
  config.slaves.resize(1);
  config.slaves[0].output_length = 17;
  config.stations.resize(1);
  config.stations[0].module = ProfibusModule::kSkCu4;
  config.stations[0].io_byte = true;
  config.stations[0].drives = {0, 1};
  config.drives[0].ppo = *profile::ppoLayout(1, profile::kIdentCu4Tu4, profile::Series::kSk2xxe);
  config.drives[0].offset = 1;
  config.drives[1].ppo = *profile::ppoLayout(3, profile::kIdentCu4Tu4, profile::Series::kSk2xxe);
  config.drives[1].slave = 0;
  config.drives[1].inverter = 3;
  config.drives[1].offset = 13;
  const auto bytes = fromHex("68 14 14 68 03 01 5D 00 00 00 00 00 00 00 00 00 04 7F 20 00 04 7E 00 00 86 16");
  TraceRecord record;
  record.length = static_cast<std::uint8_t>(bytes.size());
  std::copy(bytes.begin(), bytes.end(), record.bytes.begin());
  EXPECT_EQ("DX 3 <- 1 I/O 00 FI1 STW 047F SW1 2000 FI3 STW 047E SW1 0000", ProfibusTelegramText{config}(record));
}

// On SK 700E the third setpoint stands before the second (BU 0020 7.2.2).
TEST(ProfibusTelegramText, KnowsTheOrderOfTheSetpoints) {
  EXPECT_EQ("DX 4 <- 1 STW 047F SW1 2000 SW2 2222 SW3 1111",
            textOf("68 0F 0F 68 04 01 7D 04 7F 20 00 11 11 22 22 00 00 00 00 8B 16"));
}

// Start-up services and their answers.
TEST(ProfibusTelegramText, NamesTheServicesOfTheStartUp) {
  EXPECT_EQ("FDL status 3 <- 1", textOf("10 03 01 49 4D 16"));
  EXPECT_EQ("answer 1 <- 3 OK", textOf("10 01 03 00 04 16"));
  EXPECT_EQ("answer 1 <- 3 not activated", textOf("10 01 03 03 07 16"));
  EXPECT_EQ("Slave_Diag 3 <- 1", textOf("68 05 05 68 83 81 6D 3C 3E EB 16"));
  EXPECT_EQ("diag 1 <- 3 ident 7531, no owner, not ready, Prm_Req",
            textOf("68 0B 0B 68 81 83 08 3E 3C 02 05 00 FF 75 31 32 16"));
  EXPECT_EQ("diag 1 <- 3 ident 7531, no owner, not ready, Not_Supported, Prm_Fault, Prm_Req",
            textOf("68 0B 0B 68 81 83 08 3E 3C 52 05 00 FF 75 31 82 16"));
  EXPECT_EQ("Chk_Cfg 3 <- 1 F3 F1", textOf("68 07 07 68 83 81 5D 3E 3E F3 F1 C1 16"));
  EXPECT_EQ("Global_Control 127 <- 1 00 00", textOf("68 07 07 68 FF 81 46 3A 3E 00 00 3E 16"));
  EXPECT_EQ("acknowledge", textOf("E5", TraceKind::kReceived));
  EXPECT_EQ("token 2 <- 1", textOf("DC 02 01", TraceKind::kReceived));
}

// What stands behind the six standard bytes is told in words, too: here a module whose inverter is off (BU 0020 8.2).
TEST(ProfibusTelegramText, TellsTheBlocksOfADiagnosis) {
  EXPECT_EQ(
      "diag 1 <- 3 ident 7531, owner 1, watchdog on, extended 02 04, has no connection to its inverter: the inverter "
      "is "
      "off, or the link to it is broken (02 04)",
      textOf("68 0D 0D 68 81 83 08 3E 3C 08 0C 00 01 75 31 02 04 47 16"));
}

// Data of a station that is not ours, or of an unexpected length, are bytes.
TEST(ProfibusTelegramText, LeavesStrangeDataAsBytes) {
  EXPECT_EQ("DX 5 <- 2 12 34", textOf("68 05 05 68 05 02 5D 12 34 AA 16", TraceKind::kReceived));
  EXPECT_EQ("DX 3 <- 1 12 34", textOf("68 05 05 68 03 01 5D 12 34 A7 16"));
}

TEST(ProfibusTelegramText, DoesNotReadNoise) {
  EXPECT_EQ("no telegram", textOf("00 FF", TraceKind::kNoise));
}

}  // namespace
}  // namespace nord_driver
