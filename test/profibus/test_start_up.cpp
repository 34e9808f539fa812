#include <gtest/gtest.h>

#include "profibus/nord_wire.h"

namespace nord_driver::profibus {
namespace {

// EN 50170-8: FDL status, Slave_Diag, Set_Prm, Chk_Cfg, Slave_Diag, data exchange; FC 6D first, then 5D and 7D in
// turns.
TEST(StartUp, GoesByTheBook) {
  NordWire wire;
  wire.cycle("10 08 01 49 52 16", "10 01 08 00 09 16");
  EXPECT_EQ(SlavePhase::kFirstDiagnosis, wire.status().phase);
  EXPECT_EQ(0u, wire.tells(DpEventKind::kSlaveFound).slave);
  wire.cycle("68 05 05 68 88 81 6D 3C 3E F0 16", "68 0B 0B 68 81 88 08 3E 3C 02 05 00 FF 75 31 37 16");
  EXPECT_EQ(0x7531, wire.status().ident);
  wire.cycle("68 0C 0C 68 88 81 5D 3D 3E 88 0A 01 0B 75 31 00 25 16", "E5");
  wire.cycle("68 07 07 68 88 81 7D 3E 3E F3 F1 E6 16", "E5");
  wire.cycle("68 05 05 68 88 81 5D 3C 3E E0 16", "68 0B 0B 68 81 88 08 3E 3C 00 0C 00 01 75 31 3E 16");
  EXPECT_EQ(SlavePhase::kDataExchange, wire.status().phase);
  EXPECT_STREQ("", wire.status().note);
  wire.tells(DpEventKind::kDataExchangeEntered);
  EXPECT_FALSE(wire.status().exchanged_this_cycle);
  wire.cycle("68 0F 0F 68 08 01 7D 00 00 00 00 00 00 00 00 04 7E 00 00 08 16",
             "68 0F 0F 68 01 08 08 00 00 00 00 00 00 00 00 0B 31 00 00 4D 16");
  EXPECT_TRUE(wire.status().exchanged_this_cycle);
  EXPECT_EQ("00 00 00 00 00 00 00 00 0B 31 00 00", toHex(wire.master.inputs(0)));
  wire.cycle("68 0F 0F 68 08 01 5D 00 00 00 00 00 00 00 00 04 7E 00 00 E8 16",
             "68 0F 0F 68 01 08 08 00 00 00 00 00 00 00 00 0B 31 00 00 4D 16");
  wire.tellsNothing();
  EXPECT_EQ(2u, wire.status().counters.exchanges);
  EXPECT_EQ(0u, wire.master.counters().unexpected);
}

// Captured on a real bus: four diagnoses with Stat_Diag before the slave is ready.
TEST(StartUp, AsksForTheDiagnosisUntilTheSlaveIsReady) {
  NordWire wire;
  wire.isFound();
  wire.isFree();
  wire.takesParameters();
  wire.takesConfiguration();
  wire.cycle(kDiag5D, "68 0B 0B 68 81 88 08 3E 3C 02 0C 00 01 75 31 40 16");  // not ready
  wire.cycle(kDiag7D, "68 0B 0B 68 81 88 08 3E 3C 00 0E 00 01 75 31 40 16");  // Stat_Diag
  EXPECT_EQ(SlavePhase::kAwaitReady, wire.status().phase);
  wire.cycle(kDiag5D, "68 0B 0B 68 81 88 08 3E 3C 00 0D 00 01 75 31 3F 16");  // Prm_Req
  EXPECT_EQ(SlavePhase::kAwaitReady, wire.status().phase);
  wire.cycle(kDiag7D, kReady);
  EXPECT_EQ(SlavePhase::kDataExchange, wire.status().phase);
  wire.cycle(kExchange5D, kInputs);
}

// A slave that finds its rate by listening stays silent at first: it is simply asked again, never twice in one cycle.
TEST(StartUp, AsksASilentSlaveAgainEveryProbeInterval) {
  NordWire wire;
  for (int probe = 0; probe < 12; ++probe) {
    wire.startCycle();
    wire.sends(kFdlStatus8);
    wire.staysSilent();
    wire.cycleEnds();
    wire.startCycle();  // the interval is not over
    wire.cycleEnds();
    wire.advance(std::chrono::milliseconds{250});
  }
  EXPECT_EQ(12u, wire.master.counters().timeouts);
  EXPECT_EQ(0u, wire.master.counters().retries);
  wire.tellsNothing();
  wire.startsUp();
}

// Set_Prm without watchdog: WD_On is clear and the factors are 1 (0 is no factor).
TEST(StartUp, WithoutWatchdog) {
  SlaveConfig slave = nordModule(8);
  slave.watchdog = Duration::zero();
  NordWire wire{quietBus(), slave};
  wire.isFound();
  wire.isFree();
  wire.cycle("68 0C 0C 68 88 81 5D 3D 3E 80 01 01 0B 75 31 00 14 16", "E5");
}

// The modular configuration and the DP-V1 bytes of a 0BA8h module, zeros kept.
TEST(StartUp, SendsUserParametersAndModularConfigurations) {
  SlaveConfig slave = nordModule(8);
  slave.ident_number = 0x0BA8;
  slave.user_parameters = {0x80, 0x00, 0x00};
  slave.configuration = {0x00, 0xF5};
  NordWire wire{quietBus(), slave};
  wire.isFound();
  wire.cycle(kDiag6D, "68 0B 0B 68 81 88 08 3E 3C 02 05 00 FF 0B A8 44 16");
  wire.cycle("68 0F 0F 68 88 81 5D 3D 3E 88 0A 01 0B 0B A8 00 80 00 00 B2 16", "E5");
  wire.cycle("68 07 07 68 88 81 7D 3E 3E 00 F5 F7 16", "E5");
}

// Captured slaves of other makers answer the same way: master 2, slave 8, Festo CPV, an output-only slave that answers
// its exchange with SC.
TEST(StartUp, OfACapturedSlaveWithoutInputs) {
  BusParameters bus = quietBus();
  bus.master = station(2);
  SlaveConfig slave;
  slave.address = station(8);
  slave.ident_number = 0x0A35;
  slave.configuration = {0x21};
  slave.output_length = 2;
  slave.watchdog = std::chrono::milliseconds{300};
  slave.min_tsdr_bits = 0;
  NordWire wire{bus, slave};
  wire.cycle("10 08 02 49 53 16", "10 02 08 00 0A 16");
  wire.cycle("68 05 05 68 88 82 6D 3C 3E F1 16", "68 0B 0B 68 82 88 08 3E 3C 02 05 00 FF 0A 35 D1 16");
  wire.cycle("68 0C 0C 68 88 82 5D 3D 3E 88 1E 01 00 0A 35 00 C8 16", "E5");
  wire.cycle("68 06 06 68 88 82 7D 3E 3E 21 24 16", "E5");
  wire.cycle("68 05 05 68 88 82 5D 3C 3E E1 16", "68 0B 0B 68 82 88 08 3E 3C 00 0C 00 02 0A 35 D9 16");
  wire.cycle("68 05 05 68 08 02 7D 00 00 87 16", "E5");
  EXPECT_TRUE(wire.status().exchanged_this_cycle);
  wire.cycle("68 05 05 68 08 02 5D 00 00 67 16", "10 02 08 03 0D 16");  // RS
  EXPECT_FALSE(wire.status().exchanged_this_cycle);
}

// Eight octets may travel as SD3; both kinds are legal, SD2 is what slaves are seen to use. Answers may be of either
// kind.
TEST(StartUp, SendsEightOctetsAsSd3WhenAskedTo) {
  for (const bool sd3 : {false, true}) {
    BusParameters bus = quietBus();
    bus.send_sd3 = sd3;
    SlaveConfig slave = nordModule(8);
    slave.configuration = {0xF3};
    slave.output_length = 8;
    slave.input_length = 8;
    NordWire wire{bus, slave};
    wire.master.setOutputs(0, fromHex("04 7E 00 00 00 00 00 00"));
    wire.isFound();
    wire.isFree();
    wire.takesParameters();
    wire.cycle("68 06 06 68 88 81 7D 3E 3E F3 F5 16", "E5");
    wire.cycle(kDiag5D, kReady);
    wire.cycle(sd3 ? "A2 08 01 7D 04 7E 00 00 00 00 00 00 08 16" : "68 0B 0B 68 08 01 7D 04 7E 00 00 00 00 00 00 08 16",
               "A2 01 08 08 0B 31 00 00 00 00 00 00 4D 16");
    EXPECT_TRUE(wire.status().exchanged_this_cycle);
    wire.cycle(sd3 ? "A2 08 01 5D 04 7E 00 00 00 00 00 00 E8 16" : "68 0B 0B 68 08 01 5D 04 7E 00 00 00 00 00 00 E8 16",
               "68 0B 0B 68 01 08 08 0B 31 00 00 00 00 00 00 4D 16");
    EXPECT_TRUE(wire.status().exchanged_this_cycle);
  }
}

}  // namespace
}  // namespace nord_driver::profibus
