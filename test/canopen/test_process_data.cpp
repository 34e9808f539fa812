#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "canopen/master_run.h"

namespace nord_driver::canopen {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Not;

struct Running : MasterRun {
  explicit Running(const MasterConfig& config) : MasterRun{config} {
    begin();
    EXPECT_TRUE(runUntil([this] { return allOperational(); }, seconds{2}));
    // To the end of a cycle: the next step begins one.
    const std::uint64_t cycles = master.counters().cycles;
    EXPECT_TRUE(runUntil([&] { return master.counters().cycles != cycles; }, seconds{1}));
    run(milliseconds{9});
    sent.clear();
  }
};

// SYNC follows the RPDOs of its cycle: what is set before a cycle acts with the SYNC of this cycle.
TEST(ProcessData, SyncFollowsTheReceivePdos) {
  MasterConfig config = busConfig(3);
  config.sync_cob_id = 0x80;
  for (NodeConfig& node : config.nodes) {
    node.receive_pdos[0].transmission_type = 0;
    node.transmit_pdos[0].transmission_type = 1;
  }
  Running run{config};
  run.run(milliseconds{20});
  EXPECT_THAT(run.sent, ElementsAre("201#7E040000", "202#7E040000", "203#7E040000", "080#", "201#7E040000",
                                    "202#7E040000", "203#7E040000", "080#"));
  EXPECT_THAT(run.violations(), IsEmpty());
  EXPECT_GE(run.master.transmitPdo(2, 0).count, 2u);
}

// No SYNC into a bus on which nobody is operational.
TEST(ProcessData, NoSyncWithoutAnOperationalNode) {
  MasterConfig config = busConfig(1);
  config.sync_cob_id = 0x80;
  MasterRun run{config};
  run.master.restart(run.now);
  run.run(seconds{1});
  EXPECT_EQ(0u, run.master.counters().syncs);
}

// Before somebody has set a value there is none to send; after a loss the old one is gone.
TEST(ProcessData, SendsNothingThatWasNotSet) {
  MasterRun run{busConfig(1)};
  run.before_cycle = [](Master&) {};
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{1}));
  run.run(milliseconds{100});
  EXPECT_THAT(run.nodes[0]->received_pdos, IsEmpty());
  run.master.setReceivePdo(0, 0, fromHex("7F 04 00 20"));
  run.run(milliseconds{30});
  EXPECT_THAT(run.nodes[0]->received_pdos, ElementsAre("201#7F040020", "201#7F040020", "201#7F040020"));
  run.nodes[0]->powerOff();
  ASSERT_TRUE(run.reaches(NodeState::kLost, seconds{1}));
  run.nodes[0]->received_pdos.clear();
  run.nodes[0]->powerOn(run.now);
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{1}));
  run.run(milliseconds{100});
  EXPECT_THAT(run.nodes[0]->received_pdos, IsEmpty());
}

// The first control word acknowledges a fault when it takes the enable away (BU 0020 8): the node tells its state
// first.
TEST(ProcessData, WaitsForTheFirstTransmitPdo) {
  MasterConfig config = busConfig(2);
  config.nodes[0].first_answer_timeout = milliseconds{80};
  MasterRun run{config};
  run.loses = [](const CanFrame& frame) { return frame.id == 0x181; };
  run.begin();
  ASSERT_TRUE(run.runUntil([&run] { return run.allOperational(); }, seconds{2}));
  run.run(milliseconds{50});
  EXPECT_THAT(run.nodes[0]->received_pdos, IsEmpty());
  EXPECT_THAT(run.nodes[1]->received_pdos, Not(IsEmpty())) << "it is told to take them at once";
  run.loses = nullptr;
  run.nodes[0]->say("181#380B0000", run.now);
  run.run(milliseconds{22});
  EXPECT_THAT(run.nodes[0]->received_pdos, Not(IsEmpty()));
}

// A TPDO that comes in the pause between two cycles is read at the end of the next one. An RPDO in that one would bring
// another TPDO, in the place of the first.
TEST(ProcessData, TheFirstTransmitPdoIsReadBeforeItCanBeReplaced) {
  MasterConfig config = busConfig(1);
  config.nodes[0].first_answer_timeout = seconds{10};
  MasterRun run{config};
  std::vector<bool> answered;     // at the start of each cycle: it runs, and its first TPDO has come
  std::vector<std::size_t> sent;  // RPDOs, likewise
  run.before_cycle = [&](Master& master) {
    master.setReceivePdo(0, 0, fromHex("7E 04 00 00"));
    const bool runs = master.status(0).state == NodeState::kOperational;
    answered.push_back(runs && master.transmitPdo(0, 0).count != 0);
    sent.push_back(run.nodes[0]->received_pdos.size());
  };
  run.begin();
  ASSERT_TRUE(run.runUntil([&run] { return !run.nodes[0]->received_pdos.empty(); }, seconds{2}));
  run.run(milliseconds{20});
  const auto first = static_cast<std::size_t>(std::find(answered.begin(), answered.end(), true) - answered.begin());
  ASSERT_LT(first + 2, answered.size());
  EXPECT_EQ(0u, sent[first + 1]) << "the cycle that begins with the first TPDO is there to read it";
  EXPECT_EQ(1u, sent[first + 2]);
}

// One that hears us without being heard must get its stop words.
TEST(ProcessData, DoesNotWaitForeverForTheFirstTransmitPdo) {
  MasterConfig config = busConfig(1);
  config.nodes[0].first_answer_timeout = milliseconds{80};
  PdoConfig off;
  off.number = 2;
  off.enabled = false;
  config.nodes[0].transmit_pdos.push_back(off);
  MasterRun run{config};
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{2}));
  run.run(milliseconds{22});
  EXPECT_THAT(run.nodes[0]->received_pdos, Not(IsEmpty())) << "the PDO that is off is not waited for";

  run.nodes[0]->powerOff();
  ASSERT_TRUE(run.reaches(NodeState::kLost, seconds{1}));
  run.nodes[0]->received_pdos.clear();
  run.loses = [](const CanFrame& frame) { return frame.id == 0x181; };
  run.nodes[0]->powerOn(run.now);
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{1}));
  run.run(milliseconds{70});
  EXPECT_THAT(run.nodes[0]->received_pdos, IsEmpty());
  run.run(milliseconds{22});
  EXPECT_THAT(run.nodes[0]->received_pdos, Not(IsEmpty()));
}

// A synchronous TPDO comes with the SYNC, which is not held back.
TEST(ProcessData, SyncGoesOutWhileTheFirstAnswerIsAwaited) {
  MasterConfig config = busConfig(1);
  config.sync_cob_id = 0x80;
  config.nodes[0].receive_pdos[0].transmission_type = 0;
  config.nodes[0].transmit_pdos[0].transmission_type = 1;
  config.nodes[0].first_answer_timeout = seconds{10};
  bool lost = false;  // what the node sends by itself at its start
  MasterRun run{config};
  run.loses = [&lost](const CanFrame& frame) { return frame.id == 0x181 && !std::exchange(lost, true); };
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{2}));
  run.run(milliseconds{40});
  EXPECT_TRUE(lost);
  EXPECT_GE(run.nodes[0]->syncs, 2);
  EXPECT_THAT(run.nodes[0]->received_pdos, Not(IsEmpty()));
}

TEST(ProcessData, FitsValuesToTheMapping) {
  Running run{busConfig(1)};
  run.before_cycle = [](Master& master) { master.setReceivePdo(0, 0, fromHex("7F 04")); };
  run.run(milliseconds{10});
  run.before_cycle = [](Master& master) { master.setReceivePdo(0, 0, fromHex("7F 04 00 20 99 99")); };
  run.run(milliseconds{10});
  EXPECT_THAT(run.sent, ElementsAre("201#7F040000", "201#7F040020"));
}

// A TPDO shorter than its mapping is not used; of a longer one the first bytes are (CiA 301 7.2.2.2).
TEST(ProcessData, WrongLengths) {
  Running run{busConfig(1)};
  run.say("181#310B0000");
  run.say("181#370B00");
  run.say("181#");
  EXPECT_EQ("31 0B 00 00", toHex(run.master.transmitPdo(0, 0).bytes));
  EXPECT_EQ(2u, run.master.status(0).counters.malformed);
  run.say("181#370B002011223344");
  EXPECT_EQ("37 0B 00 20", toHex(run.master.transmitPdo(0, 0).bytes));
  run.step();
  EXPECT_EQ("sent a malformed frame 181h: a TPDO shorter than its mapping (3 bytes)",
            run.eventText(CanopenEventKind::kMalformed));
  EXPECT_EQ(1u, run.count(CanopenEventKind::kMalformed)) << "one per second";
}

// What a node sends before its start is not its process data.
TEST(ProcessData, IgnoresTransmitPdosBeforeTheStart) {
  MasterRun run{busConfig(1)};
  run.master.restart(run.now);
  run.say("181#310B0000");
  EXPECT_EQ(0u, run.master.transmitPdo(0, 0).count);
}

// A node that is slow on its parameter channel delays nobody's process data, its own included.
TEST(ProcessData, SlowSdoDelaysNothing) {
  Running run{busConfig(4)};
  for (auto& node : run.nodes) {
    node->sdo_delay = milliseconds{250};
    node->received_pdos.clear();
  }
  for (int cycle = 0; cycle < 100; ++cycle) {
    for (std::size_t node = 0; node < 4; ++node) run.master.submitSdo(node, 0, sdoRead(1, 0x2066, 1));
    while (run.master.pollSdo()) {
    }
    run.sent.clear();
    run.run(milliseconds{10});
    ASSERT_GE(run.sent.size(), 4u);
    for (std::size_t node = 0; node < 4; ++node)
      EXPECT_EQ("20" + std::to_string(node + 1), run.sent[node].substr(0, 3));
  }
  for (const auto& node : run.nodes) EXPECT_EQ(100u, node->received_pdos.size());
}

// A link without room: no setpoint of that time ever leaves, the first one after it is the newest; NMT and SDO are
// kept.
TEST(ProcessData, NoStaleSetpointAfterAStall) {
  Running run{busConfig(2)};
  int cycle = 0;
  run.before_cycle = [&cycle](Master& master) {
    ++cycle;
    const std::array<std::uint8_t, 4> value{0x7F, 0x04, static_cast<std::uint8_t>(cycle), 0x00};
    master.setReceivePdo(0, 0, value);
    master.setReceivePdo(1, 0, value);
  };
  run.link_full = true;
  ASSERT_TRUE(run.master.submitSdo(1, 0, sdoRead(9, 0x2066, 1)));
  run.run(milliseconds{100});
  EXPECT_EQ(10, cycle);
  EXPECT_THAT(run.sent, IsEmpty());
  EXPECT_EQ(20u, run.master.counters().superseded);
  EXPECT_EQ(10u, run.master.status(0).counters.superseded);
  run.link_full = false;
  run.run(milliseconds{10});
  EXPECT_THAT(run.sent, ElementsAre("201#7F040B00", "202#7F040B00", "602#4066200100000000"));
  const auto answer = run.master.pollSdo();
  ASSERT_TRUE(answer);
  EXPECT_EQ(1u, answer->node);
  EXPECT_EQ(103u, answer->answer.number());
}

// Every second frame is refused by the link from the first on: the start-up gets through all the same.
TEST(ProcessData, StartsOverALinkThatIsOftenFull) {
  MasterRun run{busConfig(4)};
  run.begin();
  const bool all = run.runUntil(
      [&] {
        run.link_full = !run.link_full;
        return run.allOperational();
      },
      seconds{3});
  EXPECT_TRUE(all);
  EXPECT_GT(run.master.counters().not_sent, 10u);
  EXPECT_THAT(run.violations(), IsEmpty());
}

}  // namespace
}  // namespace nord_driver::canopen
