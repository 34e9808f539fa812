// A master that looks on only, and was there first: another one that begins to lead finds it silent, so that nothing but the
// watchdog of that one decides how long its drives turn.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "profibus/nord_wire.h"

namespace nord_driver::profibus {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

constexpr const char* kOfMaster3 = "10 08 03 49 54 16";  // FDL status to 8
// Of master 1, whose address we have: its exchange with 8, with the word 047F and not ours.
constexpr const char* kOfOurAddress = "68 0F 0F 68 08 01 7D 00 00 00 00 00 00 00 00 04 7F 00 00 09 16";
constexpr const char* kSetPrmUnwatched5D = "68 0C 0C 68 88 81 5D 3D 3E 80 01 01 0B 75 31 00 14 16";
constexpr const char* kUnwatched = "68 0B 0B 68 81 88 08 3E 3C 00 04 00 01 75 31 36 16";
constexpr const char* kWatched = kReady;

BusParameters looking() {
  BusParameters bus = quietBus();
  bus.listen_first = 100ms;
  bus.gives_way = true;
  return bus;
}

SlaveConfig unwatched(int address) {
  SlaveConfig slave = nordModule(address);
  slave.watchdog = Duration::zero();
  return slave;
}

/// Who looks on, has listened, and exchanges data with station 8.
class Looker : public NordWire {
 public:
  explicit Looker(const BusParameters& bus = looking()) : NordWire{bus, unwatched(8)} {
    isConfigured();
    cycle(kDiag5D, kUnwatched);
    EXPECT_EQ(SlavePhase::kDataExchange, status().phase);
    forgetEvents();
  }
  /// As far as it goes before the slave is ready; the line is free.
  void isConfigured() {
    advance(100ms);
    isFound();
    isFree();
    cycle(kSetPrmUnwatched5D, kShortAcknowledge);
    takesConfiguration();
  }
  /// The next one carries FC 7D, the one after it 5D, and so on.
  void exchanges() {
    cycle(even_ ? kExchange7D : kExchange5D, kInputs);
    even_ = !even_;
  }
  void expectGivenWay(const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
    testing::ScopedTrace trace(file, line, "expectGivenWay");
    EXPECT_TRUE(master.cycleDone());
    EXPECT_TRUE(master.hasGivenWay());
    EXPECT_EQ(SlavePhase::kSilent, status().phase);
    EXPECT_FALSE(status().exchanged_this_cycle);
    EXPECT_THAT(status().note, HasSubstr("is left to another master, which leads this segment"));
  }
  void expectSilence(Duration span) {
    for (const Instant end = now + span; now < end; advance(5ms)) {
      startCycle();
      while (!master.cycleDone()) staysSilent();
      ASSERT_EQ("", toHex(master.pollTransmit(now)));
    }
  }

 private:
  bool even_ = true;
};

TEST(GivesWay, ToARequestOfAnotherMaster) {
  Looker looker;
  looker.exchanges();
  looker.advance(5ms);
  looker.arrives(kOfMaster3);
  looker.expectGivenWay();
  const DpEvent foreign = looker.tells(DpEventKind::kForeignMaster);
  EXPECT_EQ(3, foreign.master);
  EXPECT_THAT(foreign.text, HasSubstr("another master leads this segment: nothing is sent"));
  const DpEvent lost = looker.tells(DpEventKind::kSlaveLost);
  EXPECT_EQ(LossCause::kGivenWay, lost.cause);
  EXPECT_STREQ(looker.status().note, lost.text);
  looker.expectSilence(90ms);
  looker.tellsNothing();
}

// Nothing is sent for as long as it is heard; then everything begins anew, and its watchdog has run out by then.
TEST(GivesWay, ForAsLongAsThatOneIsHeard) {
  Looker looker;
  for (int i = 0; i < 20; ++i) {
    looker.arrives(kOfMaster3);
    looker.expectSilence(90ms);
    EXPECT_TRUE(looker.master.hasGivenWay());
  }
  looker.advance(20ms);
  looker.isFound();
  EXPECT_FALSE(looker.master.hasGivenWay());
  looker.isFree();
}

// A second master with our address, whose answer follows in the same bytes, must not be taken for ours.
TEST(GivesWay, ToAnotherMasterWithOurAddress) {
  Looker looker;
  looker.exchanges();
  looker.startCycle();
  looker.sends(kExchange5D);
  looker.receives(std::string{kOfOurAddress} + " " + kInputs);
  looker.expectGivenWay();
  EXPECT_EQ(1, looker.tells(DpEventKind::kForeignMaster).master);
  looker.expectSilence(90ms);
}

// The very telegram that we send, from somebody else: told by when it comes.
TEST(GivesWay, ToWhoSendsTheSameAsWe) {
  Looker looker;
  looker.exchanges();
  looker.arrives(kExchange7D);
  looker.expectGivenWay();
}

// What was to be sent is not, in whatever state it is: the line is not idle yet, or a repetition is due.
TEST(GivesWay, InTheMiddleOfACycle) {
  Looker looker;
  looker.exchanges();
  looker.startCycle();
  looker.arrives(kOfMaster3);
  looker.expectGivenWay();
  looker.expectSilence(90ms);

  Looker repeating;
  repeating.startCycle();
  repeating.sends(kExchange7D);
  repeating.staysSilent();
  repeating.arrives(kOfMaster3);
  repeating.expectGivenWay();
  repeating.expectSilence(90ms);
}

TEST(GivesWay, ToARing) {
  Looker looker;
  looker.arrives("DC 03 03");
  EXPECT_FALSE(looker.master.hasGivenWay()) << "it may be noise";
  looker.advance(30ms);
  looker.arrives("DC 03 03");
  looker.expectGivenWay();
}

// Nor to a telegram of which one byte is not what was sent, wherever that is; nor to answers.
TEST(GivesWay, NotToNoise) {
  const std::vector<std::uint8_t> request = fromHex(kOfMaster3);
  Looker looker;
  for (std::size_t i = 0; i < request.size(); ++i) {
    std::vector<std::uint8_t> garbled = request;
    garbled[i] = static_cast<std::uint8_t>(garbled[i] ^ 0x20u);
    looker.arrives(toHex(garbled));
    looker.arrives("FF");
    looker.advance(2ms);
    looker.exchanges();
  }
  looker.arrives(kInputs);
  looker.advance(2ms);
  looker.exchanges();
  looker.arrives("DC 05 03");
  looker.advance(2ms);
  looker.exchanges();
  EXPECT_FALSE(looker.master.isListening());
  looker.tellsNothing();
}

// Of an adapter that hears itself, which nobody has said.
TEST(GivesWay, NotToOurOwnTelegramsHandedBack) {
  Looker looker;
  for (int i = 0; i < 4; ++i) {
    for (const char* ours : {kExchange7D, kExchange5D}) {
      looker.startCycle();
      looker.sends(ours);
      looker.arrives(ours);
      looker.receives(kInputs);
      looker.cycleEnds();
    }
  }
  EXPECT_THAT(looker.tells(DpEventKind::kForeignMaster).text, HasSubstr("switch its echo off"));
  EXPECT_EQ(SlavePhase::kDataExchange, looker.status().phase);
  // Each one once: what comes twice was sent by somebody else.
  looker.startCycle();
  looker.sends(kExchange7D);
  looker.arrives(kExchange7D);
  EXPECT_FALSE(looker.master.hasGivenWay());
  looker.arrives(kExchange7D);
  looker.expectGivenWay();
}

// A broadcast has no answer behind it, nor has a request to who is silent: they come back with the next one.
TEST(GivesWay, NotToTelegramsHandedBackLate) {
  constexpr const char* kOperate = "68 07 07 68 FF 81 46 3A 3E 00 00 3E 16";
  BusParameters bus = looking();
  bus.operate_interval = 1s;
  NordWire wire{bus, unwatched(8)};
  wire.advance(100ms);
  wire.startCycle();
  wire.sends(kOperate);
  wire.sends(kFdlStatus8);
  wire.staysSilent();
  wire.cycleEnds();
  wire.advance(250ms);
  wire.startCycle();
  wire.sends(kFdlStatus8);
  wire.receives(std::string{kOperate} + " " + kFdlStatus8 + " " + kFdlStatus8 + " " + kHere8);
  wire.cycleEnds();
  EXPECT_EQ(SlavePhase::kFirstDiagnosis, wire.status().phase);
  EXPECT_FALSE(wire.master.isListening());
}

// Nor behind an answer that came late, when its request was sent again already: the second one comes back after it, to an
// echo filter as well, which has taken the answer for a collision.
TEST(GivesWay, NotToARepetitionHandedBackBehindALateAnswer) {
  Looker looker;
  looker.startCycle();
  looker.sends(kExchange7D);
  looker.arrives(kExchange7D);
  looker.staysSilent();
  looker.sends(kExchange7D);
  looker.receives(std::string{kInputs} + " " + kExchange7D + " " + kInputs);
  looker.cycleEnds();
  EXPECT_FALSE(looker.master.hasGivenWay());
  EXPECT_TRUE(looker.status().exchanged_this_cycle);
  looker.advance(2ms);
  looker.cycle(kExchange5D, kInputs);
  // Each one once, as ever.
  looker.arrives(kExchange7D);
  looker.expectGivenWay();
}

// Nor behind an answer to the request before, which was given up by then: the echo of this one comes after it.
TEST(GivesWay, NotToARequestHandedBackBehindTheAnswerToTheOneBefore) {
  Looker looker;
  looker.master.setSilenceLimit(0, 400ms);
  looker.startCycle();
  for (int i = 0; i < 2; ++i) {
    looker.sends(kExchange7D);
    looker.staysSilent();
  }
  looker.cycleEnds();
  looker.advance(5ms);
  looker.startCycle();
  looker.sends(kExchange6D);
  looker.receives(std::string{kInputs} + " " + kExchange6D + " " + kInputs);
  looker.cycleEnds();
  EXPECT_FALSE(looker.master.hasGivenWay());
  EXPECT_EQ(SlavePhase::kDataExchange, looker.status().phase);
  // No more than that: what comes behind an answer was sent by somebody else.
  for (const char* next : {kExchange5D, kExchange7D}) {
    looker.advance(2ms);
    looker.cycle(next, kInputs);
  }
  looker.arrives(kExchange7D);
  looker.expectGivenWay();
}

// Nor while an adapter goes on to be late by a request: each answer is taken for that to the next one.
TEST(GivesWay, NotToAnAdapterThatIsLateByARequest) {
  Looker looker;
  looker.startCycle();
  looker.sends(kExchange7D);
  looker.staysSilent();
  looker.sends(kExchange7D);
  looker.receives(kInputs);
  looker.cycleEnds();
  looker.advance(2ms);
  looker.cycle(kExchange5D, kInputs);
  for (int i = 0; i < 3; ++i) {
    looker.advance(2ms);
    looker.cycle(kExchange7D, std::string{kExchange5D} + " " + kInputs);
    looker.advance(2ms);
    looker.cycle(kExchange5D, std::string{kExchange7D} + " " + kInputs);
    EXPECT_FALSE(looker.master.hasGivenWay()) << i;
  }
  looker.arrives(kExchange5D);
  EXPECT_FALSE(looker.master.hasGivenWay());
  looker.arrives(kExchange5D);
  looker.expectGivenWay();
}

// A driver does not leave its drives to anybody: it goes on, and tells.
TEST(GivesWay, NotAsADriver) {
  BusParameters bus = quietBus();
  bus.listen_first = 100ms;
  NordWire wire{bus};
  wire.advance(100ms);
  wire.startsUp();
  wire.cycle(kExchange7D, kInputs);
  wire.arrives(kOfMaster3);
  EXPECT_THAT(wire.tells(DpEventKind::kForeignMaster).text, HasSubstr("this driver must be the only one"));
  wire.advance(2ms);
  wire.cycle(kExchange5D, kInputs);
  wire.arrives(kOfOurAddress);
  wire.advance(2ms);
  wire.cycle(kExchange7D, kInputs);
  EXPECT_FALSE(wire.master.isListening());
}

TEST(GivesWay, WithoutListeningThereIsNothingToWaitFor) {
  BusParameters bus = looking();
  bus.listen_first = Duration::zero();
  EXPECT_THROW(bus.validate(), std::invalid_argument);
}

// Unheard, the other master has set the slave up with a watchdog: each exchange would feed it.
TEST(GivesWay, AWatchdogThatIsNotOursIsLeftToRun) {
  Looker looker;
  looker.master.requestDiagnosis(0);
  looker.startCycle();
  looker.sends(kExchange7D);
  looker.receives(kInputs);
  looker.sends(kDiag5D);
  looker.receives(kWatched);
  looker.cycleEnds();
  EXPECT_EQ(SlavePhase::kBackOff, looker.status().phase);
  EXPECT_THAT(looker.tells(DpEventKind::kSlaveLost).text, HasSubstr("a watchdog runs that is not ours"));
  EXPECT_THAT(looker.tells(DpEventKind::kLeftRunning).text,
              HasSubstr("its watchdog runs: wait until that has run out"));
  looker.expectSilence(60s);
}

// Each new look at it would start it anew.
TEST(GivesWay, AWatchdogThatIsNotOursIsLeftToRunBesideAnotherMasterToo) {
  NordWire wire{looking(), unwatched(8)};
  wire.advance(100ms);
  wire.isFound();
  wire.cycle(kDiag6D, kWatched);
  ASSERT_EQ(SlavePhase::kBackOff, wire.status().phase);
  wire.arrives(kOfMaster3);
  EXPECT_TRUE(wire.master.hasGivenWay());
  for (const Instant end = wire.now + 60s; wire.now < end; wire.advance(20ms)) {
    wire.startCycle();
    while (!wire.master.cycleDone()) wire.staysSilent();
  }
  EXPECT_FALSE(wire.master.isListening());
  EXPECT_EQ(2u, wire.master.counters().telegrams_sent);
}

TEST(GivesWay, AWatchdogThatIsNotOursIsNotBegunWith) {
  NordWire wire{looking(), unwatched(8)};
  wire.advance(100ms);
  wire.isFound();
  wire.isFree();
  wire.cycle(kSetPrmUnwatched5D, kShortAcknowledge);
  wire.takesConfiguration();
  wire.cycle(kDiag5D, kWatched);
  EXPECT_EQ(SlavePhase::kBackOff, wire.status().phase);
  EXPECT_THAT(wire.status().note, HasSubstr("another master has our address"));
}

}  // namespace
}  // namespace nord_driver::profibus
