#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "canopen/master_run.h"

namespace nord_driver::canopen {
namespace {

using std::chrono::seconds;

struct Watched : testing::Test {
  static MasterConfig config() {
    MasterConfig config = busConfig(2);
    config.sync_cob_id = 0x80;
    config.own_id = 127;
    return config;
  }
  Watched() {
    run.begin();
    EXPECT_TRUE(run.runUntil([this] { return run.allOperational(); }, seconds{1}));
    run.events.clear();
  }
  /// The one event after the frame, but for `others` of another kind.
  std::string told(const std::string& candump, CanopenEventKind kind, std::size_t others = 0) {
    run.events.clear();
    run.say(candump);
    while (const auto event = run.master.pollEvent()) run.events.push_back(*event);
    EXPECT_EQ(run.events.size(), run.count(kind) + others) << candump;
    return run.eventText(kind);
  }
  MasterRun run{config()};
};

// A node nobody configured is named once, however often it speaks.
TEST_F(Watched, ForeignNode) {
  EXPECT_EQ("node 9 is on the bus, but is not configured", told("709#05", CanopenEventKind::kForeignNode));
  EXPECT_EQ("", told("709#05", CanopenEventKind::kForeignNode));
  EXPECT_EQ("", told("089#0010010000000000", CanopenEventKind::kForeignNode));
  EXPECT_EQ("node 10 is on the bus, but is not configured",
            told("08A#0010010000000000", CanopenEventKind::kForeignNode));
  EXPECT_EQ(4u, run.master.counters().foreign);
  run.say("4FF#00");
  EXPECT_EQ(5u, run.master.counters().foreign);
}

TEST_F(Watched, SecondMaster) {
  EXPECT_EQ("another master sends NMT \"start\" to all nodes", told("000#0100", CanopenEventKind::kSecondMaster));
  EXPECT_EQ("", told("000#0102", CanopenEventKind::kSecondMaster)) << "once per second";
  run.run(seconds{1});
  EXPECT_EQ("another master sends NMT \"stop\" to node 2", told("000#0202", CanopenEventKind::kSecondMaster, 1))
      << "beside the loss of that node";
  run.run(seconds{1});
  EXPECT_EQ("another master is on the bus: it sends RPDO (201h), which only we should",
            told("201#7F040020", CanopenEventKind::kSecondMaster));
  run.run(seconds{1});
  EXPECT_EQ("another master is on the bus: it sends SYNC (080h), which only we should",
            told("080#", CanopenEventKind::kSecondMaster));
  run.run(seconds{1});
  EXPECT_EQ("another master is on the bus: it sends guarding (701h), which only we should",
            told("701#R1", CanopenEventKind::kSecondMaster));
  run.run(seconds{1});
  EXPECT_EQ("another master is on the bus: it sends SDO request (601h), which only we should",
            told("601#4000100000000000", CanopenEventKind::kSecondMaster));
  EXPECT_EQ(7u, run.master.counters().second_master);
  EXPECT_TRUE(run.allOperational());
  run.run(seconds{1});
  EXPECT_EQ("another master sends NMT \"start\" to node 127", told("000#017F", CanopenEventKind::kSecondMaster));
  EXPECT_EQ("somebody sent a malformed NMT command (2 bytes)", told("000#0180", CanopenEventKind::kMalformed))
      << "there is no node 128";
}

// Masters may share a bus as long as their nodes differ: what another one tells its own nodes is nothing of ours.
TEST_F(Watched, NmtForNodesOfOthers) {
  EXPECT_EQ("another master sends NMT \"start\" to node 33, which is not configured",
            told("000#0121", CanopenEventKind::kForeignCommand));
  EXPECT_EQ("", told("000#8221", CanopenEventKind::kForeignCommand)) << "once per second";
  EXPECT_EQ(0u, run.master.counters().second_master);
  EXPECT_EQ(2u, run.master.counters().foreign);
  EXPECT_TRUE(run.allOperational());
}

// What stops a drive is told at once, whatever was told a moment ago.
TEST_F(Watched, WhatStopsADriveIsNotHiddenByWhatDoesNot) {
  told("000#0121", CanopenEventKind::kForeignCommand);
  EXPECT_EQ("another master is on the bus: it sends SDO request (601h), which only we should",
            told("601#4000100000000000", CanopenEventKind::kSecondMaster));
  EXPECT_EQ("another master is on the bus: it sends RPDO (202h), which only we should",
            told("202#7F040010", CanopenEventKind::kSecondMaster));
  EXPECT_EQ("another master sends NMT \"stop\" to node 2", told("000#0202", CanopenEventKind::kSecondMaster, 1));
  EXPECT_EQ("", told("202#7F040010", CanopenEventKind::kSecondMaster)) << "once per second each";
  EXPECT_EQ("", told("601#4000100000000000", CanopenEventKind::kSecondMaster));
}

// Before our first frame: who works with our nodes, and who does not. A node that was left operational is nobody's.
TEST_F(Watched, SomebodyElseHasOurNodes) {
  const auto noted = [this](const CanFrame& frame) { return run.master.noteOtherMaster(frame, run.now); };
  for (const char* text :
       {"000#0100", "000#8201", "201#7F040020", "601#4000100000000000", "080#", "701#R1", "181#R4", "701#85"}) {
    EXPECT_TRUE(noted(frame(text))) << text;
  }
  EXPECT_EQ(8u, run.master.counters().second_master);
  for (const char* text : {"000#0109", "000#01", "209#7F040020", "701#05", "701#00", "181#31030000",
                           "581#4300100000000000", "081#0010010000000000", "709#85", "100#000000000000"}) {
    EXPECT_FALSE(noted(frame(text))) << text;
  }
  EXPECT_EQ(8u, run.master.counters().second_master);
  EXPECT_TRUE(run.allOperational()) << "nothing else comes of it";
}

// Control words of another master: when the last one came is known.
TEST_F(Watched, AnotherMasterCommandsANode) {
  run.say("202#7F040020");
  EXPECT_EQ(run.now, run.master.status(1).other_commands_at.value_or(Instant{}));
  EXPECT_EQ(1u, run.master.status(1).counters.foreign_receive_pdos);
  EXPECT_FALSE(run.master.status(0).other_commands_at.has_value());
}

TEST_F(Watched, OwnNodeIdUsed) {
  EXPECT_EQ("another node has our own node id 127", told("77F#00", CanopenEventKind::kOwnIdUsed));
  EXPECT_EQ(127u, run.events[0].value);
  EXPECT_EQ(1u, run.master.counters().own_id_used);
  EXPECT_EQ("", told("77F#05", CanopenEventKind::kOwnIdUsed)) << "once per second";
  EXPECT_EQ(2u, run.master.counters().own_id_used);
}

// TIME and an unused SYNC identifier are everybody's.
TEST_F(Watched, TimeIsNobodysBusiness) {
  EXPECT_EQ("", told("100#000000000000", CanopenEventKind::kForeignNode));
  EXPECT_EQ(0u, run.master.counters().foreign);
}

// Frames of our nodes with a wrong length or an impossible value: named and counted, and the node goes on.
TEST_F(Watched, MalformedFrames) {
  EXPECT_EQ("sent a malformed frame 701h: a state is one byte (2 bytes)",
            told("701#0505", CanopenEventKind::kMalformed));
  EXPECT_EQ("", told("701#", CanopenEventKind::kMalformed)) << "once per second";
  run.run(seconds{1});
  EXPECT_EQ("sent a malformed frame 701h: no such state (1 bytes)", told("701#33", CanopenEventKind::kMalformed));
  EXPECT_EQ("sent a malformed frame 082h: an emergency has eight bytes (3 bytes)",
            told("082#008111", CanopenEventKind::kMalformed));
  run.run(seconds{1});
  EXPECT_EQ("sent a malformed frame 581h: an SDO has eight bytes (4 bytes)",
            told("581#60171000", CanopenEventKind::kMalformed));
  EXPECT_EQ("sent a malformed frame 582h: nobody asks for this by a remote frame (8 bytes, remote)",
            told("582#R8", CanopenEventKind::kMalformed));
  EXPECT_EQ("somebody sent a malformed NMT command (1 bytes)", told("000#01", CanopenEventKind::kMalformed));
  EXPECT_EQ("", told("000#01", CanopenEventKind::kMalformed)) << "once per second";
  run.run(seconds{1});
  EXPECT_EQ("somebody sent a malformed NMT command (2 bytes)", told("000#7701", CanopenEventKind::kMalformed));
  EXPECT_EQ(9u, run.master.counters().malformed);
  EXPECT_TRUE(run.allOperational());
  CanFrame extended = frame("701#00");
  extended.extended = true;
  run.master.handleFrame(extended, run.now);
  EXPECT_TRUE(run.allOperational()) << "a 29 bit identifier is none of ours";
}

// BU 0060 p. 93: P513 time-out is `00 81 01 ...`, code 0 follows the acknowledgement; the gateway names the inverter in
// the fourth byte (BU 0260 p. 78).
TEST_F(Watched, Emergencies) {
  EXPECT_EQ("emergency 8100h, error register 01h, manufacturer's bytes 00 00 00 00 00",
            told("081#0081010000000000", CanopenEventKind::kEmergency));
  EXPECT_EQ(0x810001u, run.events[0].value);
  EXPECT_EQ(0u, run.events[0].node);
  const EmergencyHistory& history = run.master.status(0).emergencies;
  EXPECT_TRUE(history.standing());
  told("081#0010010300000000", CanopenEventKind::kEmergency);
  EXPECT_EQ(3, history.back(0).manufacturer[0]);
  EXPECT_EQ(0x1000, history.back(0).code);
  EXPECT_EQ(0x8100, history.back(1).code);
  told("081#0000000000000000", CanopenEventKind::kEmergency);
  EXPECT_FALSE(history.standing());
  EXPECT_EQ(3u, history.size());
  for (int i = 0; i < 20; ++i) run.say("081#0081010000000000");
  EXPECT_EQ(23u, history.count());
  EXPECT_EQ(EmergencyHistory::kLength, history.size());
  EXPECT_EQ(0u, run.master.status(1).emergencies.count());
}

// The interface was opened anew: what was heard before is of before, and what is told once is told once again.
TEST_F(Watched, ARestartForgetsWhatWasHeard) {
  told("709#05", CanopenEventKind::kForeignNode);
  run.say("081#0081010000000000");
  run.say("202#7F040020");
  run.master.restart(run.now);
  EXPECT_EQ(0u, run.master.status(0).emergencies.size());
  EXPECT_FALSE(run.master.status(0).emergencies.standing());
  EXPECT_FALSE(run.master.status(1).other_commands_at.has_value());
  while (run.master.pollEvent()) {
  }
  EXPECT_EQ("node 9 is on the bus, but is not configured", told("709#05", CanopenEventKind::kForeignNode));
}

TEST_F(Watched, NamesTheIdentifiersItMustSee) {
  const std::vector<std::uint32_t> ids = run.master.receivedIds();
  for (const std::uint32_t id :
       {0x000u, 0x080u, 0x081u, 0x082u, 0x181u, 0x182u, 0x201u, 0x581u, 0x601u, 0x701u, 0x77Fu}) {
    EXPECT_TRUE(std::binary_search(ids.begin(), ids.end(), id)) << std::hex << id;
  }
  EXPECT_FALSE(std::binary_search(ids.begin(), ids.end(), 0x4FFu));
  EXPECT_LE(ids.size(), 512u) << "most filters of one socket";
  EXPECT_THAT(run.master.receivedRemoteIds(), testing::ElementsAre(0x701u, 0x702u));
}

}  // namespace
}  // namespace nord_driver::canopen
