// Two drivers, or a driver and somebody else who commands, on one bus with the same nodes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "system/can_robot.h"

namespace nord_driver::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;

constexpr DriveIndex kLeft = 0, kRight = 1;
constexpr char kContestedStop[] = "drive left stopped: another master commands it, too (status word ";

class TwoMasters : public ::testing::Test {
 protected:
  /// A cycle of each in turn; somebody goes on commanding the first one.
  void step() {
    first_.command(kHalfSpeed);
    first_.step();
    if (second_) second_->step();
  }
  void run(Duration span) {
    for (const Instant end = now() + span; now() < end;) step();
  }
  template <typename Condition>
  bool runUntil(Condition done, Duration limit) {
    for (const Instant end = now() + limit; now() < end && !done();) step();
    return done();
  }
  void startSecond() {
    CanRobot::Options options;
    options.beside = &first_.bus();
    second_ = std::make_unique<CanRobot>(options);
  }
  void driveFirst() {
    ASSERT_TRUE(first_.bringUpAndEnable());
    first_.drive(kHalfSpeed, 0.0, seconds{3});
    ASSERT_EQ(0x2000, first_.setpoint(kLeft));
  }
  void otherCommands(std::initializer_list<std::uint8_t> bytes, std::uint32_t id = 0x203) {
    const std::vector<std::uint8_t> data{bytes};
    first_.bus().inject(dataFrame(id, ByteView{data.data(), data.size()}));
  }
  /// The control word of another master alone.
  void expectStoppedBy(std::uint32_t id) {
    driveFirst();
    int cycles = 0;
    while (first_.snapshot().base.enabled && cycles < 100) {
      otherCommands({0x7F, 0x04}, id);
      step();
      ++cycles;
    }
    EXPECT_LE(cycles, 2) << "at once: that is no silence";
    EXPECT_THAT(first_.busText(), HasSubstr("another master is on the bus: it sends RPDO"));
    EXPECT_THAT(first_.snapshot().base.text.c_str(), HasSubstr(kContestedStop));
    EXPECT_TRUE(runUntil([this] { return first_.standsStill(); }, seconds{10}));
  }
  Instant now() { return first_.transport().now(); }
  bool bothOnline(CanRobot& robot) { return robot.online(kLeft) && robot.online(kRight); }
  /// Whoever is asked: no wheel turns from now on.
  void expectRestForGood() {
    ASSERT_TRUE(runUntil([this] { return first_.standsStill(); }, seconds{10}));
    for (const Instant end = now() + seconds{5}; now() < end;) {
      step();
      ASSERT_TRUE(first_.standsStill());
    }
  }

  CanRobot first_;
  std::unique_ptr<CanRobot> second_;
};

// A node that is driven by somebody else is not reset under way: who comes second says nothing, and says why. When the
// first has ended it takes over, at rest.
TEST_F(TwoMasters, ADriverThatStartsSecondWaits) {
  driveFirst();
  const std::uint64_t boot_ups = first_.node(kLeft).counters().boot_ups;
  startSecond();
  run(seconds{4});
  EXPECT_EQ(0u, second_->beside().sent());
  EXPECT_EQ(boot_ups, first_.node(kLeft).counters().boot_ups);
  EXPECT_TRUE(first_.snapshot().base.enabled) << first_.snapshot().base.text.str();
  EXPECT_NEAR(25.0, first_.unit(kLeft).inverter().frequency(), 0.1);
  EXPECT_FALSE(second_->online(kLeft));
  EXPECT_THAT(second_->busText(), HasSubstr("another master"));
  EXPECT_GT(second_->snapshot().counters.value(bus_counter::kUnexpected), 0u);
  EXPECT_FALSE(second_->transport().connected());
  EXPECT_EQ(0u, first_.snapshot().counters.value(bus_counter::kUnexpected));

  first_.run(milliseconds{600});
  ASSERT_TRUE(first_.ask(cycle::RequestKind::kShutDown).success);
  first_.transport().close();
  ASSERT_TRUE(second_->runUntil([this] { return bothOnline(*second_); }, seconds{6}));
  EXPECT_TRUE(first_.standsStill());
  EXPECT_FALSE(second_->snapshot().base.enabled);
  second_->run(seconds{1});
  EXPECT_STREQ("enabled", second_->ask(cycle::RequestKind::kEnable).message.c_str());
  second_->drive(kHalfSpeed, 0.0, seconds{3});
  EXPECT_NEAR(25.0, first_.unit(kLeft).inverter().frequency(), 0.1);
}

// While the interface is down nobody can be heard: that is no silence of the other master.
TEST_F(TwoMasters, ListensOnceTheInterfaceIsUp) {
  driveFirst();
  const std::uint64_t boot_ups = first_.node(kLeft).counters().boot_ups;
  startSecond();
  second_->beside().setUp(false);
  run(seconds{2});
  second_->beside().setUp(true);
  run(seconds{3});
  EXPECT_EQ(0u, second_->beside().sent()) << "it was heard as soon as it could be";
  second_->beside().setUp(false);
  run(seconds{3});
  second_->beside().setUp(true);
  run(seconds{3});
  EXPECT_EQ(0u, second_->beside().sent()) << "it waited already";
  EXPECT_EQ(boot_ups, first_.node(kLeft).counters().boot_ups);
  EXPECT_TRUE(first_.snapshot().base.enabled) << first_.snapshot().base.text.str();
}

// It has never had the nodes: what was heard before its adapter was unplugged, or not heard, says nothing of now.
TEST_F(TwoMasters, ListensAnewWhenItsAdapterIsBack) {
  driveFirst();
  for (const milliseconds before : {milliseconds{100}, milliseconds{3000}}) {
    SCOPED_TRACE(before.count());
    const std::uint64_t boot_ups = first_.node(kLeft).counters().boot_ups;
    second_.reset();
    startSecond();
    run(before);
    second_->beside().setPresent(false);
    run(seconds{3});
    second_->beside().setPresent(true);
    run(seconds{3});
    EXPECT_EQ(0u, second_->beside().sent());
    EXPECT_THAT(second_->busText(), HasSubstr("another master"));
    EXPECT_EQ(boot_ups, first_.node(kLeft).counters().boot_ups);
    EXPECT_TRUE(first_.snapshot().base.enabled) << first_.snapshot().base.text.str();
  }
}

// Nodes that a driver has left operational when it died are nobody's: they are taken over at once.
TEST_F(TwoMasters, ADriverThatDiedIsNotWaitedFor) {
  driveFirst();
  startSecond();
  const Instant start = now();
  ASSERT_TRUE(second_->runUntil([this] { return bothOnline(*second_); }, seconds{5}));
  EXPECT_LT(now() - start, seconds{2});
  EXPECT_TRUE(second_->runUntil([this] { return first_.standsStill(); }, seconds{10}));
  EXPECT_FALSE(second_->snapshot().base.enabled);
}

// One that does not listen takes the nodes away under way: the base stops, both are named, nothing moves any more until
// one of them is gone.
TEST_F(TwoMasters, OneThatStartsSecondAndDoesNotListenStopsTheBase) {
  driveFirst();
  startSecond();
  second_->beside().setDeaf(true);
  run(seconds{1});
  second_->beside().setDeaf(false);
  run(seconds{2});
  EXPECT_FALSE(first_.snapshot().base.enabled);
  EXPECT_TRUE(first_.snapshot().base.stopped);
  EXPECT_THAT(first_.busText(), HasSubstr("another master"));
  EXPECT_THAT(second_->busText(), HasSubstr("another master"));
  EXPECT_GT(first_.snapshot().counters.value(bus_counter::kUnexpected), 10u);
  EXPECT_GT(second_->snapshot().counters.value(bus_counter::kUnexpected), 10u);
  expectRestForGood();
  // It ends, and the first has its nodes back, at rest.
  second_->transport().close();
  second_.reset();
  ASSERT_TRUE(runUntil([this] { return bothOnline(first_); }, seconds{8}));
  expectRestForGood();
  first_.run(milliseconds{600});
  for (const DriveIndex drive : {kLeft, kRight}) first_.ask(cycle::RequestKind::kAcknowledge, drive);
  EXPECT_STREQ("enabled", first_.ask(cycle::RequestKind::kEnable).message.c_str());
}

// Both begin to talk at the same moment and heard nobody: neither may enable as long as the other commands.
TEST_F(TwoMasters, BothAtOnceMoveNothing) {
  startSecond();
  second_->beside().setDeaf(true);
  run(milliseconds{560});
  second_->beside().setDeaf(false);
  run(seconds{5});
  for (CanRobot* robot : {&first_, second_.get()}) {
    EXPECT_THAT(robot->busText(), HasSubstr("another master"));
    EXPECT_GT(robot->snapshot().counters.value(bus_counter::kUnexpected), 0u);
  }
  cycle::Request request;
  request.kind = cycle::RequestKind::kEnable;
  request.id = 77;
  request.patience = seconds{3};
  first_.ports().submit(request);
  second_->ports().submit(request);
  for (const Instant end = now() + seconds{5}; now() < end;) {
    step();
    second_->command(kHalfSpeed);
    ASSERT_TRUE(first_.standsStill());
    ASSERT_FALSE(first_.snapshot().base.enabled);
    ASSERT_FALSE(second_->snapshot().base.enabled);
  }
}

// A node obeys all four RPDOs as delivered (BU 0060 p. 59): a control word in one that this driver does not use is another
// master's as well.
TEST_F(TwoMasters, ControlWordsInTheSecondPdoStopTheBaseToo) {
  expectStoppedBy(0x303);
}

TEST_F(TwoMasters, ControlWordsInTheFourthPdoStopTheBaseToo) {
  expectStoppedBy(0x503);
}

// Control words of somebody else for a drive of ours: it does what that master says as much as what we say. The base stops, the
// drive is named, and enabled again only when that master has ended and somebody asks.
TEST_F(TwoMasters, ControlWordsOfSomebodyElseStopTheBase) {
  driveFirst();
  int cycles = 0;
  while (first_.snapshot().base.enabled && cycles < 100) {
    otherCommands({0x7F, 0x04, 0x00, 0x10});
    step();
    ++cycles;
  }
  EXPECT_LE(cycles, 2) << "at once: that is no silence";
  for (int i = 0; i < 300; ++i) {
    if (i % 3 == 0) otherCommands({0x7F, 0x04, 0x00, 0x10});
    step();
    ASSERT_EQ(0x047E, first_.controlWord(kLeft));
    ASSERT_EQ(0, first_.setpoint(kRight));
  }
  EXPECT_FALSE(first_.online(kLeft));
  EXPECT_TRUE(first_.online(kRight));
  EXPECT_THAT(first_.text(kLeft), HasSubstr("another master commands it, too"));
  EXPECT_THAT(first_.busText(), HasSubstr("another master is on the bus: it sends RPDO (203h)"));
  ASSERT_TRUE(runUntil([this] { return first_.online(kLeft); }, seconds{2}));
  expectRestForGood();
  EXPECT_FALSE(first_.snapshot().base.enabled);
  EXPECT_THAT(first_.snapshot().base.text.c_str(), HasSubstr(kContestedStop)) << "its TPDOs came all the while";
  first_.run(milliseconds{600});
  EXPECT_STREQ("enabled", first_.ask(cycle::RequestKind::kEnable).message.c_str());
}

}  // namespace
}  // namespace nord_driver::test
