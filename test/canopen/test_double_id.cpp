// Two nodes with one id: both answer each question of the start-up.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "canopen/master_run.h"

namespace nord_driver::canopen {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr std::uint32_t kSdoAnswer = 0x581;

struct Doubled : testing::Test {
  /// Every `nth` answer comes twice.
  void answerTwice(int nth) {
    run.loses = [this, nth](const CanFrame& frame) {
      if (frame.id != kSdoAnswer || ++answers % nth != 0) return false;
      run.master.handleFrame(frame, run.now);
      if (other_asks) run.say("601#4001100000000000");
      return false;
    };
  }
  /// Every `nth` answer comes again, two answers later.
  void answerLate(int nth) {
    run.loses = [this, nth](const CanFrame& frame) {
      if (frame.id != kSdoAnswer) return false;
      const int turn = ++answers % nth;
      if (turn == 1) late = frame;
      if (turn == 3 % nth) run.master.handleFrame(late, run.now);
      return false;
    };
  }
  bool started() const { return std::find(run.sent.begin(), run.sent.end(), "000#0101") != run.sent.end(); }

  MasterRun run{busConfig(1)};
  int answers = 0;
  CanFrame late;
  bool other_asks = false;
};

TEST_F(Doubled, IsNotStartedAndTold) {
  answerTwice(1);
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kRefused, seconds{2}));
  EXPECT_STREQ("two nodes answer with this id: is it set twice, by switches or P515?",
               run.master.status(0).reason.c_str());
  run.run(seconds{20});
  EXPECT_EQ(NodeState::kRefused, run.master.status(0).state) << "tried again, and refused again";
  EXPECT_FALSE(started());
  EXPECT_EQ(1u, run.count(CanopenEventKind::kDoubleId));
  EXPECT_GE(run.master.counters().stray_sdo, 4u);
  run.loses = nullptr;
  EXPECT_TRUE(run.reaches(NodeState::kOperational, seconds{6}));
}

// A frame may be received twice (ISO 11898-1); most answers are single ones then.
TEST_F(Doubled, IsNotSaidOfABadLine) {
  answerTwice(3);
  run.begin();
  EXPECT_TRUE(run.reaches(NodeState::kOperational, seconds{2}));
  EXPECT_EQ(0u, run.count(CanopenEventKind::kDoubleId));
}

// The second one is slow and answers few questions, each after the first node has answered the next one.
TEST_F(Doubled, IsToldOfAFewAnswersThatAreNotTheOneBefore) {
  answerLate(4);
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kRefused, seconds{2}));
  EXPECT_EQ(1u, run.count(CanopenEventKind::kDoubleId));
}

// Somebody else asks, too: the answers are for that master.
TEST_F(Doubled, IsNotSaidBesideAnotherMaster) {
  other_asks = true;
  answerTwice(1);
  run.begin();
  EXPECT_TRUE(run.reaches(NodeState::kOperational, seconds{2}));
  EXPECT_EQ(0u, run.count(CanopenEventKind::kDoubleId));
  EXPECT_GE(run.count(CanopenEventKind::kSecondMaster), 1u);
}

// A second node that has gone since was the first to answer: what was read is not what the node has.
TEST_F(Doubled, ASetUpWithAnswersTooManyIsLookedAtAgain) {
  run.nodes[0]->object(0x1800, 2).value = 1;
  bool mistaken = false;
  run.loses = [&](const CanFrame& frame) {
    const bool type = frame.id == kSdoAnswer && text(frame).substr(0, 12) == "581#4F001802";
    if (type && !std::exchange(mistaken, true)) run.say("581#4F001802FF000000");
    return false;
  };
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{2}));
  EXPECT_TRUE(mistaken);
  EXPECT_EQ(255u, run.nodes[0]->object(0x1800, 2).value);
}

// An answer that is always there twice, with other data: not for ever.
TEST_F(Doubled, ASetUpIsLookedAtOnceMore) {
  run.loses = [&](const CanFrame& frame) {
    if (text(frame).substr(0, 12) == "581#4F001802") run.say("581#4F00180201000000");
    return false;
  };
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{2}));
  EXPECT_EQ(2, std::count(run.sent.begin(), run.sent.end(), "601#4000100000000000")) << "1000h, the first of a set-up";
}

// A slow server whose answers come after the question was repeated: late ones, not those of a second node.
TEST_F(Doubled, IsNotSaidOfASlowServer) {
  MasterConfig config = busConfig(1);
  config.nodes[0].sdo_timeout = milliseconds{50};
  MasterRun slow{config};
  slow.nodes[0]->sdo_delay = milliseconds{60};
  slow.begin();
  slow.run(seconds{20});
  EXPECT_EQ(0u, slow.count(CanopenEventKind::kDoubleId));
  EXPECT_GT(slow.master.counters().sdo_timeouts, 0u);
}

// One that was in operation may turn: it is started again for stop words, and stays out then.
TEST_F(Doubled, WhileItRunsIsStoppedFirst) {
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{2}));
  answerTwice(1);
  run.say("701#00");
  run.nodes[0]->state = 0x7F;
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{2}));
  EXPECT_TRUE(run.master.status(0).doubled);
  const std::uint64_t before = run.master.status(0).counters.receive_pdos;
  run.run(seconds{2});
  EXPECT_GT(run.master.status(0).counters.receive_pdos, before + 100);
  ASSERT_TRUE(run.reaches(NodeState::kRefused, seconds{6}));
  run.run(seconds{20});
  EXPECT_EQ(NodeState::kRefused, run.master.status(0).state);
  EXPECT_EQ(1u, run.count(CanopenEventKind::kDoubleId));
}

// Its answers unlike the ones before have told of the second one already: looking again would keep the stop words back, and
// might find less.
TEST_F(Doubled, WhileItRunsItIsNotLookedAtAgain) {
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{2}));
  answerLate(3);
  run.say("701#00");
  run.nodes[0]->state = 0x7F;
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{2}));
  EXPECT_TRUE(run.master.status(0).doubled);
  EXPECT_EQ(2, std::count(run.sent.begin(), run.sent.end(), "601#4000100000000000")) << "1000h, the first of a set-up";
}

// Each set-up with such answers is, also when the one looked at again came to nothing.
TEST_F(Doubled, TheNextSetUpIsLookedAtOnceMoreToo) {
  int looks = 0;
  bool mute = false;
  run.loses = [&](const CanFrame& frame) {
    if (frame.id != kSdoAnswer || mute) return mute && frame.id == kSdoAnswer;
    if (text(frame).substr(0, 12) == "581#43001000" && ++looks == 2) return mute = true;
    if (text(frame).substr(0, 12) == "581#4F001802") run.say("581#4F00180201000000");
    return false;
  };
  run.begin();
  ASSERT_TRUE(run.runUntil([&] { return mute && run.master.status(0).state == NodeState::kAbsent; }, seconds{5}));
  mute = false;
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{5}));
  EXPECT_EQ(4, looks) << "the next set-up, and the look at it";
}

// --- In operation, by guarding ---------------------------------------------------------------------------------------

/// A node that is guarded, in operation, and from then on answers each question twice.
struct DoubledInOperation : testing::Test {
  void SetUp() override {
    ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{1}));
    run.run(seconds{1});
    ASSERT_EQ(NodeState::kOperational, run.master.status(0).state);
  }
  static MasterConfig guarded() {
    MasterConfig config = busConfig(1);
    config.nodes[0].error_control.mode = ErrorControlMode::kGuarding;
    return config;
  }
  /// Of each `every` questions the last has two answers, the second one with the other toggle bit or the same.
  void answerTwice(bool same, int every = 1) {
    run.loses = [this, same, every](const CanFrame& frame) {
      if (frame.id != 0x701 || frame.remote || ++answers % every != 0) return false;
      CanFrame other = frame;
      other.data[0] = static_cast<std::uint8_t>(frame.data[0] ^ (same ? 0u : 0x80u));
      run.master.handleFrame(frame, run.now);
      run.master.handleFrame(other, run.now);
      return true;
    };
  }
  DoubledInOperation() : run{guarded()} { run.begin(); }

  MasterRun run;
  int answers = 0;
};

TEST_F(DoubledInOperation, IsToldAndLeftRunningToHearWhatStopsIt) {
  for (const bool same : {false, true}) {
    answerTwice(same);
    ASSERT_TRUE(run.runUntil([this] { return run.master.status(0).doubled; }, seconds{1}));
    EXPECT_EQ(NodeState::kOperational, run.master.status(0).state);
    EXPECT_STREQ("two nodes answer with this id: is it set twice, by switches or P515?",
                 run.master.status(0).reason.c_str());
    run.sent.clear();
    run.run(milliseconds{3900});
    EXPECT_EQ(NodeState::kOperational, run.master.status(0).state);
    EXPECT_GT(std::count(run.sent.begin(), run.sent.end(), "201#7E040000"), 300);
    EXPECT_THAT(run.sent, testing::Not(testing::Contains("601#4000100000000000")));
    run.run(milliseconds{200});
    EXPECT_THAT(run.sent, testing::Contains("601#4000100000000000")) << "looked at from its beginning";
    run.loses = nullptr;
    EXPECT_TRUE(run.reaches(NodeState::kOperational, seconds{6}));
    EXPECT_FALSE(run.master.status(0).doubled);
  }
  EXPECT_EQ(2u, run.count(CanopenEventKind::kDoubleId));
}

// Frames that are received twice now and then, three questions in a row among them, are none of a second node.
TEST_F(DoubledInOperation, NotForSomeFrames) {
  answerTwice(true, 2);
  run.run(seconds{10});
  EXPECT_FALSE(run.master.status(0).doubled);
  for (int round = 0; round < 3; ++round) {
    answerTwice(true);
    const std::size_t before = run.master.status(0).counters.heartbeats;
    ASSERT_TRUE(run.runUntil([&] { return run.master.status(0).counters.heartbeats >= before + 6; }, seconds{1}));
    run.loses = nullptr;
    run.run(milliseconds{300});
  }
  EXPECT_FALSE(run.master.status(0).doubled);
}

// Another master asks: its answers are none of a second node.
TEST_F(DoubledInOperation, NotWhereAnotherMasterAsks) {
  answerTwice(false);
  for (int i = 0; i < 100; ++i) {
    run.say("701#R1");
    run.run(milliseconds{50});
  }
  EXPECT_FALSE(run.master.status(0).doubled);
}

// --- In operation, by heartbeats -------------------------------------------------------------------------------------

/// A node that sends a heartbeat each 100 ms, in operation, and another one of the same id.
struct DoubledHeartbeats : testing::Test {
  void SetUp() override {
    run.begin();
    ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{1}));
    run.run(seconds{1});
  }
  /// The other one sends `after` each of the first one's, for `span`.
  void hearTheOther(Duration after, Duration span) {
    const Instant end = run.now + span;
    std::optional<Instant> due;
    run.loses = [&](const CanFrame& frame) {
      if (frame.id == 0x701 && !frame.remote) due = run.now + after;
      return false;
    };
    while (run.now < end && !run.master.status(0).doubled) {
      run.run(milliseconds{5});
      if (!due || run.now < *due) continue;
      due.reset();
      run.say("701#05");
    }
    run.loses = nullptr;
  }

  MasterRun run{busConfig(1)};
};

TEST_F(DoubledHeartbeats, AreToldWhereverTheOtherOneSendsBetweenThem) {
  for (const int after : {0, 5, 35, 50, 95}) {
    hearTheOther(milliseconds{after}, seconds{1});
    ASSERT_TRUE(run.master.status(0).doubled) << after << " ms";
    EXPECT_EQ(NodeState::kOperational, run.master.status(0).state) << "left running to hear what stops it";
    EXPECT_STREQ("two nodes answer with this id: is it set twice, by switches or P515?",
                 run.master.status(0).reason.c_str());
    run.run(seconds{5});
    ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{6}));
    EXPECT_FALSE(run.master.status(0).doubled);
  }
}

TEST_F(DoubledHeartbeats, NotForSomeFramesThatComeTwice) {
  for (int round = 0; round < 5; ++round) {
    hearTheOther(milliseconds{0}, milliseconds{400});
    run.run(milliseconds{300});
  }
  EXPECT_FALSE(run.master.status(0).doubled);
  EXPECT_EQ(0u, run.count(CanopenEventKind::kDoubleId));
}

// A host that stood still gets those of seconds at once; one that is slow reads them in bundles.
TEST_F(DoubledHeartbeats, NotForBundlesOfThem) {
  for (const int gap : {0, 1, 20, 30}) {
    for (int i = 0; i < 30; ++i) {
      run.say("701#05");
      run.now += milliseconds{gap};
    }
    run.run(milliseconds{500});
    EXPECT_EQ(0u, run.count(CanopenEventKind::kDoubleId)) << gap << " ms";
  }
}

// It may have told the node another time.
TEST_F(DoubledHeartbeats, NotWhereAnotherMasterAsks) {
  run.say("601#4017100000000000");
  hearTheOther(milliseconds{50}, seconds{3});
  EXPECT_FALSE(run.master.status(0).doubled);
}

}  // namespace
}  // namespace nord_driver::canopen
