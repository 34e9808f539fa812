#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "canopen/master_run.h"

namespace nord_driver::canopen {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::vector<std::string> withoutPdos(const std::vector<std::string>& sent) {
  std::vector<std::string> rest;
  for (const std::string& frame : sent) {
    if (frame.substr(0, 3) != "232") rest.push_back(frame);
  }
  return rest;
}

// The whole start-up of a node that is as it shall be: reset, questions, 1017h, start. Nothing else is written.
// Frames by CiA 301 7.2.8 and 7.2.4; node 32h as on BU 0060 p. 96.
TEST(StartUp, AsksFirstAndWritesOnlyTheHeartbeat) {
  MasterConfig config = busConfig(1, 0x32);
  config.nodes[0].vendor_id = 0x1E2;
  MasterRun run{config};
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{1})) << run.master.status(0).reason.c_str();
  EXPECT_THAT(
      withoutPdos(run.sent),
      ElementsAre("000#8232",              // reset communication
                  "632#4000100000000000",  // device type
                  "632#4018100100000000",  // vendor id
                  "632#4018100200000000",  // product code
                  "632#4000140100000000",  // RPDO 1: COB-ID, mapping, transmission type
                  "632#4000160000000000", "632#4000160100000000", "632#4000160200000000", "632#4000140200000000",
                  "632#4000180100000000",  // TPDO 1
                  "632#40001A0000000000", "632#40001A0100000000", "632#40001A0200000000", "632#4000180200000000",
                  "632#4017100000000000", "632#2B17100064000000",  // heartbeat: 100 ms
                  "000#0132"));                                    // start
  EXPECT_THAT(run.nodes[0]->writes, ElementsAre("1017:00=64"));
  EXPECT_THAT(run.violations(), IsEmpty());
  EXPECT_EQ(1u, run.count(CanopenEventKind::kNodeFound));
  EXPECT_EQ(1u, run.count(CanopenEventKind::kNodeOperational));
  EXPECT_EQ(NmtState::kOperational, run.master.status(0).nmt);
  EXPECT_EQ(0x1E2u, run.master.status(0).vendor_id);
}

// The trace of BU 0060 p. 96, both ways.
TEST(StartUp, ExchangesTheTraceOfTheManual) {
  MasterRun run{busConfig(1, 0x32)};
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{1}));
  run.sent.clear();
  run.run(milliseconds{10});
  EXPECT_THAT(run.sent, ElementsAre("232#7E040000"));
  run.say("1B2#310B0000");
  EXPECT_EQ("31 0B 00 00", toHex(run.master.transmitPdo(0, 0).bytes));
  EXPECT_EQ(run.now, run.master.transmitPdo(0, 0).at);
  run.before_cycle = [](Master& master) { master.setReceivePdo(0, 0, fromHex("7F 04 00 20")); };
  run.sent.clear();
  run.run(milliseconds{10});
  EXPECT_THAT(run.sent, ElementsAre("232#7F040020"));
  run.say("1B2#370B0020");
  EXPECT_EQ("37 0B 00 20", toHex(run.master.transmitPdo(0, 0).bytes));
}

// 32 nodes start side by side: not much longer than one.
TEST(StartUp, StartsThirtyTwoNodesAtOnce) {
  MasterRun run{busConfig(32)};
  run.begin();
  ASSERT_TRUE(run.runUntil([&] { return run.allOperational(); }, milliseconds{500}));
  EXPECT_THAT(run.violations(), IsEmpty());
  run.run(seconds{3});
  EXPECT_TRUE(run.allOperational());
  for (std::size_t i = 0; i < 32; ++i) {
    EXPECT_EQ(0u, run.master.status(i).counters.losses);
    EXPECT_GE(run.nodes[i]->received_pdos.size(), 295u);
  }
}

// A node whose boot-up was missed is asked for, not waited for (CiA 302-2).
TEST(StartUp, FindsANodeThatNeverSendsItsBootUp) {
  MasterRun run{busConfig(1)};
  run.nodes[0]->sends_boot_up = false;
  run.begin();
  EXPECT_TRUE(run.reaches(NodeState::kOperational, milliseconds{2500}));
  EXPECT_EQ(0u, run.master.status(0).counters.boot_ups);
  EXPECT_THAT(run.violations(), IsEmpty());
}

// Without a reset the node is only sent to pre-operational, in which PDOs may be changed (BU 0060 p. 63).
TEST(StartUp, LeavesARunningNodeUnreset) {
  MasterConfig config = busConfig(1, 0x32);
  config.nodes[0].reset = BootReset::kNone;
  config.nodes[0].transmit_pdos[0].transmission_type = 1;
  config.sync_cob_id = 0x80;
  MasterRun run{config};
  run.nodes[0]->sends_boot_up = false;
  run.nodes[0]->powerOn(run.now);
  run.nodes[0]->state = 0x05;
  run.master.restart(run.now);
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{1}));
  EXPECT_EQ(0, run.nodes[0]->resets);
  EXPECT_EQ("632#4000100000000000", run.sent[0]);
  EXPECT_EQ("000#8032", run.sent[1]);
  EXPECT_THAT(run.violations(), IsEmpty());
}

// A start that never left this computer was for the node as it was before the link was opened again: without a reset
// the node behind it now is asked first, and starts only behind its whole script.
TEST(StartUp, AStartThatWasNotSentIsForgottenWithTheLink) {
  MasterConfig config = busConfig(1, 0x32);
  config.nodes[0].reset = BootReset::kNone;
  MasterRun run{config};
  run.nodes[0]->sends_boot_up = false;
  run.begin();
  ASSERT_TRUE(run.runUntil([&] { return !run.nodes[0]->writes.empty(); }, seconds{1})) << "1017h, its last step";
  run.link_full = true;
  run.run(milliseconds{20});
  ASSERT_GT(run.master.counters().not_sent, 0u);
  ASSERT_THAT(run.sent, Not(Contains("000#0132")));
  run.sent.clear();
  run.link_full = false;
  run.master.restart(run.now);
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{1}));
  ASSERT_GT(run.sent.size(), 2u);
  EXPECT_EQ("632#4000100000000000", run.sent[0]);
  EXPECT_EQ("000#8032", run.sent[1]);
  EXPECT_EQ(1, std::count(run.sent.begin(), run.sent.end(), "000#0132"));
}

TEST(StartUp, ResetsTheWholeNodeWhenToldSo) {
  MasterConfig config = busConfig(1, 0x32);
  config.nodes[0].reset = BootReset::kResetNode;
  MasterRun run{config};
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{1}));
  EXPECT_EQ("000#8132", run.sent[0]);
}

// Another device than configured is not started, and the reason is a sentence.
TEST(StartUp, RefusesAnotherDevice) {
  MasterConfig config = busConfig(1);
  config.nodes[0].product_code = 0x0D;
  MasterRun run{config};
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kRefused, seconds{1}));
  EXPECT_STREQ("is another device: product code (1018h:2) is 0000000Ch, configured is 0000000Dh",
               run.master.status(0).reason.c_str());
  run.run(seconds{20});
  EXPECT_EQ(NodeState::kRefused, run.master.status(0).state);
  EXPECT_EQ(0x7F, run.nodes[0]->state);
  EXPECT_EQ(1u, run.count(CanopenEventKind::kNodeRefused)) << "told once";
  EXPECT_LE(run.master.status(0).counters.refusals, 9u) << "with a growing pause";
  EXPECT_THAT(run.nodes[0]->received_pdos, IsEmpty());
  // The right one is put in its place.
  run.nodes[0]->powerOff();
  run.nodes[0]->object(0x1018, 2).value = 0x0D;
  run.nodes[0]->powerOn(run.now);
  EXPECT_TRUE(run.reaches(NodeState::kOperational, seconds{2}));
}

TEST(StartUp, ChecksEveryPartOfTheIdentity) {
  MasterConfig config = busConfig(5);
  config.nodes[0].device_type = 0x00010192;
  config.nodes[1].vendor_id = 1;
  config.nodes[2].revision_number = 1;
  config.nodes[3].serial_number = 1;
  config.nodes[4].device_type = 0;
  config.nodes[4].vendor_id = 0x1E2;
  config.nodes[4].product_code = 0x0C;
  config.nodes[4].revision_number = 0x00010002;
  config.nodes[4].serial_number = 0x12345678;
  MasterRun run{config};
  run.begin();
  run.run(seconds{1});
  EXPECT_THAT(run.master.status(0).reason.str(), HasSubstr("device type (1000h) is 00000000h"));
  EXPECT_THAT(run.master.status(1).reason.str(), HasSubstr("vendor id (1018h:1) is 000001E2h"));
  EXPECT_THAT(run.master.status(2).reason.str(), HasSubstr("revision number (1018h:3) is 00010002h"));
  EXPECT_THAT(run.master.status(3).reason.str(), HasSubstr("serial number (1018h:4) is 12345678h"));
  EXPECT_EQ(NodeState::kOperational, run.master.status(4).state);
}

// Vendor and product are told where nobody demands them, too; a node that does not have them is started all the same.
TEST(StartUp, TellsVendorAndProductWhereTheyAre) {
  MasterRun run{busConfig(2)};
  run.nodes[1]->remove(0x1018, 1);
  run.nodes[1]->remove(0x1018, 2);
  run.begin();
  ASSERT_TRUE(run.runUntil([&run] { return run.allOperational(); }, seconds{1}));
  EXPECT_EQ(0x000001E2u, run.master.status(0).vendor_id);
  EXPECT_EQ(0x0000000Cu, run.master.status(0).product_code);
  EXPECT_EQ(0u, run.master.status(0).serial_number) << "not asked for";
  EXPECT_EQ(0u, run.master.status(1).vendor_id);
  EXPECT_EQ(0u, run.master.status(1).product_code);
}

// What is demanded and cannot be read is a reason not to start it.
TEST(StartUp, WhatIsDemandedHasToBeThere) {
  MasterConfig config = busConfig(3);
  config.nodes[0].device_type = 0x00010192;
  config.nodes[1].serial_number = 0x12345678;
  config.nodes[2].setup = {{0x2067, 0, 1, 2}};
  MasterRun run{config};
  run.nodes[0]->remove(0x1000, 0);
  run.nodes[1]->remove(0x1018, 4);
  run.begin();
  run.run(seconds{1});
  EXPECT_EQ(NodeState::kRefused, run.master.status(0).state);
  EXPECT_THAT(run.master.status(0).reason.str(), HasSubstr("device type (1000h:0) cannot be read: abort 0602 0000h"));
  EXPECT_EQ(NodeState::kRefused, run.master.status(1).state);
  EXPECT_THAT(run.master.status(1).reason.str(), HasSubstr("serial number (1018h:4) cannot be read: abort 0609 0011h"));
  EXPECT_EQ(NodeState::kRefused, run.master.status(2).state);
  EXPECT_THAT(run.master.status(2).reason.str(), HasSubstr("set-up (2067h:0) cannot be read: abort 0602 0000h"));
  EXPECT_THAT(run.nodes[2]->writes, IsEmpty());
}

// An object that may only be written (abort 0601 0001h) is written without a comparison.
TEST(StartUp, WhatCannotBeReadIsWritten) {
  MasterConfig config = busConfig(1);
  config.nodes[0].setup = {{0x2066, 1, 104, 2}};
  MasterRun run{config};
  run.loses = [&run](const CanFrame& frame) {
    if (text(frame) != "601#4066200100000000") return false;
    run.nodes[0]->say("581#8066200101000106", run.now);
    return true;
  };
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{1})) << run.master.status(0).reason.c_str();
  EXPECT_THAT(run.nodes[0]->writes, ElementsAre("2066:01=68", "1017:00=64"));
  EXPECT_EQ(1u, run.master.status(0).counters.sdo_aborts);
  EXPECT_EQ(1u, run.master.counters().sdo_aborts);
}

// Objects of error control that shall be 0 need not be there: a node without heartbeat does not answer for 1017h.
TEST(StartUp, WhatShallBeZeroMayBeMissing) {
  MasterConfig config = busConfig(2);
  config.nodes[0].error_control.mode = ErrorControlMode::kGuarding;
  MasterRun run{config};
  run.nodes[0]->remove(0x1017, 0);
  run.nodes[1]->remove(0x1017, 0);
  run.begin();
  run.run(seconds{1});
  EXPECT_EQ(NodeState::kOperational, run.master.status(0).state) << run.master.status(0).reason.c_str();
  EXPECT_EQ(NodeState::kRefused, run.master.status(1).state) << "it shall send one";
  EXPECT_THAT(run.master.status(1).reason.str(), HasSubstr("heartbeat time (1017h:0) cannot be read"));
}

// A node that does not obey NMT start is asked why.
TEST(StartUp, NamesWhyANodeDoesNotStart) {
  MasterRun run{busConfig(1)};
  run.nodes[0]->refuses_start = true;
  run.nodes[0]->object(0x1001, 0).value = 0x81;
  run.nodes[0]->object(0x1003, 1).value = 0x00008130;
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kRefused, seconds{4}));
  EXPECT_STREQ(
      "does not become operational after NMT start: it stays pre-operational, error register 81h, last error 8130h",
      run.master.status(0).reason.c_str());
  run.nodes[0]->refuses_start = false;
  EXPECT_TRUE(run.reaches(NodeState::kOperational, seconds{5}));
  EXPECT_STREQ("", run.master.status(0).reason.c_str());
  EXPECT_THAT(run.violations(), IsEmpty());
}

// ... and one that obeys, but sends no heartbeat, is not trusted.
TEST(StartUp, NamesAMissingHeartbeat) {
  MasterRun run{busConfig(1)};
  run.nodes[0]->sends_heartbeat = false;
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kRefused, seconds{4}));
  EXPECT_STREQ("was started, but is not heard by heartbeat, error register 00h", run.master.status(0).reason.c_str());
  EXPECT_THAT(run.nodes[0]->received_pdos, IsEmpty());
}

// A lost NMT start is sent again.
TEST(StartUp, SendsTheStartAgain) {
  MasterRun run{busConfig(1, 0x32)};
  bool lost = false;
  run.loses = [&lost](const CanFrame& frame) {
    const bool first = !lost && text(frame) == "000#0132";
    lost = lost || first;
    return first;
  };
  run.begin();
  EXPECT_TRUE(run.reaches(NodeState::kOperational, seconds{2}));
  EXPECT_TRUE(lost);
}

// Accesses of the set-up are compared first, too; lost answers are asked for again.
TEST(StartUp, SetsUpAndRepeatsWhatWasLost) {
  MasterConfig config = busConfig(1, 0x32);
  config.nodes[0].setup = {{0x2066, 1, 103, 2}, {0x2067, 1, 104, 2}};
  MasterRun run{config};
  run.nodes[0]->object(0x2067, 1) = {103, 2, false};
  int lost = 0;
  run.loses = [&lost](const CanFrame& frame) { return frame.id == 0x5B2 && frame.data[2] == 0x20 && lost++ < 2; };
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{3}));
  EXPECT_EQ(2u, run.master.status(0).counters.sdo_timeouts);
  EXPECT_EQ(104u, run.nodes[0]->object(0x2067, 1).value);
  EXPECT_THAT(run.nodes[0]->writes, ElementsAre("2067:01=68", "1017:00=64"));
}

// CiA 301 7.5.2.33: bits 0 to 29 do not change while the server exists; strict ones refuse it (0609 0030h).
TEST(StartUp, SwitchesAnSdoServerOffBeforeItGetsOtherIdentifiers) {
  MasterConfig config = busConfig(1);
  config.nodes[0].setup = {{0x1201, 1, 0x680, 4}, {0x1201, 2, 0x681, 4}, {0x1202, 1, 0x682, 4}};
  MasterRun run{config};
  run.nodes[0]->object(0x1201, 1) = {0x6A0, 4, false};
  run.nodes[0]->object(0x1201, 2) = {0x681, 4, false};
  run.nodes[0]->object(0x1202, 1) = {0x80000000, 4, false};
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{3}));
  EXPECT_THAT(run.nodes[0]->writes, ElementsAre("1201:01=800006A0", "1201:01=680", "1202:01=682", "1017:00=64"));
}

TEST(StartUp, NamesARefusedSetUp) {
  MasterConfig config = busConfig(1);
  config.nodes[0].setup = {{0x2066, 1, 200, 4}};
  MasterRun run{config};
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kRefused, seconds{1}));
  EXPECT_THAT(run.master.status(0).reason.str(), HasSubstr("set-up (2066h:1) cannot be written: abort 0607 0010h"));
}

// Another master may have told it "start" while it was set up: it refuses then what may be written before the start only.
// Its boot-up said that it was pre-operational by itself, which it is no longer. (Found by the fault campaign:
// canopen:3367.)
TEST(StartUp, WhoRefusesIsMadePreOperationalBeforeTheNextAttempt) {
  MasterConfig config = busConfig(1);
  config.nodes[0].setup = {{0x2066, 1, 200, 4}};
  MasterRun run{config};
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kRefused, seconds{1}));
  run.sent.clear();
  run.run(seconds{2});
  EXPECT_THAT(run.sent, Contains("000#8001"));
}

// Nothing but a boot-up, again and again: two nodes with one id, or a heartbeat that says 0. Named, not followed.
TEST(StartUp, SurvivesEndlessBootUps) {
  MasterRun run{busConfig(2)};
  run.begin();
  for (int i = 0; i < 100; ++i) {
    run.say("701#00");
    run.run(milliseconds{5});
  }
  EXPECT_EQ(NodeState::kRefused, run.master.status(0).state);
  EXPECT_THAT(run.master.status(0).reason.str(), HasSubstr("sends its boot-up again and again"));
  EXPECT_EQ(1u, run.count(CanopenEventKind::kBootUpRepeated));
  EXPECT_EQ(NodeState::kOperational, run.master.status(1).state);
  EXPECT_TRUE(run.reaches(NodeState::kOperational, seconds{3})) << "when it has become quiet";
}

// Without error control nothing can be verified: started is operational.
TEST(StartUp, TakesTheStartForGrantedWithoutErrorControl) {
  MasterConfig config = busConfig(1);
  config.nodes[0].error_control.mode = ErrorControlMode::kNone;
  MasterRun run{config};
  run.begin();
  EXPECT_TRUE(run.reaches(NodeState::kOperational, seconds{1}));
  EXPECT_THAT(run.nodes[0]->writes, IsEmpty());
  // What another master does to it is undone.
  run.nodes[0]->receive(frame("000#8001"), run.now);
  run.say("000#8001");
  EXPECT_EQ(NodeState::kBooting, run.master.status(0).state);
  run.run(milliseconds{100});
  EXPECT_EQ(NodeState::kOperational, run.master.status(0).state);
  EXPECT_EQ(0x05, run.nodes[0]->state);
}

// An absent node costs one question per second, and no more.
TEST(StartUp, AsksAbsentNodesSeldom) {
  MasterRun run{busConfig(3)};
  run.nodes[0]->powerOn(run.now);
  run.master.restart(run.now);
  run.run(seconds{10});
  EXPECT_EQ(NodeState::kAbsent, run.master.status(1).state);
  EXPECT_THAT(run.master.status(1).reason.str(), HasSubstr("does not answer"));
  int questions = 0;
  for (const std::string& sent : run.sent) questions += sent == "602#4000100000000000" ? 1 : 0;
  EXPECT_GE(questions, 5);
  EXPECT_LE(questions, 12);
  // It is switched on: running within 2 s, with or without its boot-up.
  run.nodes[2]->sends_boot_up = false;
  run.nodes[1]->powerOn(run.now);
  run.nodes[2]->powerOn(run.now);
  EXPECT_TRUE(run.runUntil([&] { return run.allOperational(); }, seconds{2}));
}

}  // namespace
}  // namespace nord_driver::canopen
