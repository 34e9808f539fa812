// One inverter's parameters: what is asked of it, in which order, and what it costs its EEPROM.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>
#include <vector>

#include "drive/fake_parameters.h"
#include "drive/parameter_session.h"

namespace nord_driver::drive {
namespace {

using profile::ParameterAction;
using profile::ParameterOutcome;
using profile::ParameterReason;
using profile::ParameterRequest;
using profile::ParameterResult;
using profile::ParameterShape;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

ParameterRequest access(ParameterAction action, std::uint16_t number, std::int32_t raw = 0) {
  ParameterRequest request;
  request.id = 7;
  request.action = action;
  request.number = number;
  request.raw = raw;
  return request;
}
ParameterRequest read(std::uint16_t number) {
  return access(ParameterAction::kRead, number);
}
ParameterRequest writeRam(std::uint16_t number, std::int32_t raw) {
  return access(ParameterAction::kWriteRam, number, raw);
}
ParameterRequest writePersistent(std::uint16_t number, std::int32_t raw) {
  return access(ParameterAction::kWritePersistent, number, raw);
}

class ParameterSessionTest : public ::testing::Test {
 protected:
  /// Until nothing is asked any more.
  void settle() {
    for (int i = 0; i < 100; ++i) {
      const auto request = session_.pollRequest();
      if (!request.has_value()) return;
      EXPECT_FALSE(session_.pollRequest().has_value());  // one at a time
      session_.handleResult(inverter_.carryOut(*request));
    }
    FAIL() << "does not come to an end";
  }
  ParameterResult run(const ParameterRequest& what) {
    inverter_.asked.clear();
    EXPECT_TRUE(session_.submit(what));
    settle();
    const auto result = session_.pollResult();
    EXPECT_TRUE(result.has_value());
    EXPECT_FALSE(session_.pollResult().has_value());
    return result.value_or(ParameterResult{});
  }
  /// Hands the next `count` requests to the inverter.
  void steps(int count) {
    for (int i = 0; i < count; ++i) session_.handleResult(inverter_.carryOut(session_.pollRequest().value()));
  }

  FakeParameters inverter_;
  ParameterSession session_;
};

TEST_F(ParameterSessionTest, Reads) {
  const ParameterResult result = run(read(105));
  EXPECT_EQ(7u, result.id);
  EXPECT_EQ(ParameterOutcome::kDone, result.outcome);
  EXPECT_EQ(500, result.raw);
  EXPECT_THAT(inverter_.asked, ElementsAre("P105?"));
}

TEST_F(ParameterSessionTest, TellsWhatTheInverterRefuses) {
  const ParameterResult result = run(read(999));
  EXPECT_EQ(ParameterOutcome::kRefused, result.outcome);
  EXPECT_EQ(ParameterReason::kNoSuchParameter, result.reason);
  EXPECT_EQ("its own words", result.text.str());
  EXPECT_EQ(999, result.refused_number);
}

// Write to the RAM: compared before, by the order that spares the EEPROM, read back after.
TEST_F(ParameterSessionTest, WritesToTheRam) {
  const ParameterResult result = run(writeRam(102, 1000));
  EXPECT_EQ(ParameterOutcome::kDone, result.outcome);
  EXPECT_EQ(1000, result.raw);
  EXPECT_FALSE(result.eeprom_written);
  EXPECT_THAT(inverter_.asked, ElementsAre("P102?", "P102~1000", "P102?"));
  EXPECT_EQ(200, inverter_.eeprom[102]);
  EXPECT_EQ(0u, session_.eepromWrites());
}

TEST_F(ParameterSessionTest, WritesNothingThatIsThereAlready) {
  for (const ParameterRequest& same : {writeRam(102, 200), writePersistent(102, 200)}) {
    const ParameterResult result = run(same);
    EXPECT_EQ(ParameterOutcome::kDone, result.outcome);
    EXPECT_EQ(200, result.raw);
    EXPECT_THAT(result.note, HasSubstr("nothing was written"));
    EXPECT_THAT(inverter_.asked, ElementsAre("P102?"));
  }
}

// One EEPROM cycle per persistent change (BU 2700 6.5), and P560 looked at: with 0 the value would be lost.
TEST_F(ParameterSessionTest, WritesPersistently) {
  const ParameterResult result = run(writePersistent(102, 1000));
  EXPECT_EQ(ParameterOutcome::kDone, result.outcome);
  EXPECT_TRUE(result.eeprom_written);
  EXPECT_THAT(inverter_.asked, ElementsAre("P102?", "P560?", "P102=1000", "P102?"));
  EXPECT_EQ(1000, inverter_.eeprom[102]);
  EXPECT_EQ(1, inverter_.eeprom_cycles);
  EXPECT_EQ(1u, session_.eepromWrites());
}

TEST_F(ParameterSessionTest, RefusesAPersistentWriteThatWouldBeLost) {
  inverter_.ram[560] = 0;
  const ParameterResult result = run(writePersistent(102, 1000));
  EXPECT_EQ(ParameterOutcome::kRefused, result.outcome);
  EXPECT_EQ(ParameterReason::kDriver, result.reason);
  EXPECT_THAT(result.note, HasSubstr("P560 = 0"));
  EXPECT_EQ(200, inverter_.ram[102]);
  EXPECT_EQ(ParameterOutcome::kDone, run(writePersistent(560, 1)).outcome);
  EXPECT_EQ(ParameterOutcome::kDone, run(writePersistent(102, 1000)).outcome);
}

// Equal in the RAM is not yet equal in the EEPROM when it was this session that wrote the RAM.
TEST_F(ParameterSessionTest, MakesARamWritePersistent) {
  run(writeRam(102, 1000));
  EXPECT_TRUE(run(writePersistent(102, 1000)).eeprom_written);
  EXPECT_EQ(1000, inverter_.eeprom[102]);
  EXPECT_FALSE(run(writePersistent(102, 1000)).eeprom_written);
  EXPECT_EQ(1u, session_.eepromWrites());
}

// ... nor when somebody else may have written it: then the request says so.
TEST_F(ParameterSessionTest, SavesWhatSomebodyElseMayHavePutIntoTheRam) {
  ParameterRequest write = writePersistent(102, 200);
  write.even_if_same = true;
  EXPECT_TRUE(run(write).eeprom_written);
  EXPECT_EQ(200, inverter_.eeprom[102]);
  write.action = ParameterAction::kWriteRam;
  EXPECT_FALSE(run(write).eeprom_written) << "a RAM write is compared all the same";
  EXPECT_THAT(inverter_.asked, ElementsAre("P102?"));
}

// A write that was refused has not put anything into the RAM.
TEST_F(ParameterSessionTest, TakesARefusedRamWriteForNone) {
  inverter_.scripted["P102~1000"] = FakeParameters::refusal(ParameterReason::kOutOfLimits);
  const ParameterResult refused = run(writeRam(102, 1000));
  EXPECT_EQ(ParameterReason::kOutOfLimits, refused.reason);
  EXPECT_EQ(102, refused.refused_number);
  EXPECT_FALSE(run(writePersistent(102, 200)).eeprom_written);
}

// A set is a value of its own, and more values than can be remembered are all held to be in the RAM only.
TEST_F(ParameterSessionTest, RemembersRamWritesBySet) {
  ParameterRequest what = writeRam(102, 1000);
  what.shape = ParameterShape::kPerSet;
  what.parameter_set = 2;
  run(what);
  what.action = ParameterAction::kWritePersistent;
  what.parameter_set = 3;
  EXPECT_FALSE(run(what).eeprom_written);
  what.parameter_set = 2;
  EXPECT_TRUE(run(what).eeprom_written);
  for (std::uint16_t number = 300; number < 333; ++number) {
    inverter_.ram[number] = 0;
    run(writeRam(number, 1));
  }
  EXPECT_TRUE(run(writePersistent(105, 500)).eeprom_written);
}

// No write that spares the EEPROM here: P560 = 0 for the time of a plain write, and back; remembered for the next write.
TEST_F(ParameterSessionTest, FallsBackToP560) {
  inverter_.ram_orders = false;
  const ParameterResult result = run(writeRam(102, 1000));
  EXPECT_EQ(ParameterOutcome::kDone, result.outcome);
  EXPECT_THAT(inverter_.asked,
              ElementsAre("P102?", "P102~1000", "P560?", "P560=0", "P560?", "P102=1000", "P560=1", "P560?", "P102?"));
  EXPECT_THAT(result.note, HasSubstr("put back"));
  EXPECT_EQ(200, inverter_.eeprom[102]);
  EXPECT_EQ(1, inverter_.ram[560]);
  EXPECT_TRUE(result.eeprom_written);
  EXPECT_EQ(2u, session_.eepromWrites());
  run(writeRam(102, 1100));
  EXPECT_EQ("P560?", inverter_.asked.at(1));
  EXPECT_TRUE(run(writePersistent(102, 1100)).eeprom_written);
}

// P560 = 0 that somebody else set stays: it belongs to that client, and nothing reaches the EEPROM meanwhile.
TEST_F(ParameterSessionTest, LeavesP560AsItWas) {
  inverter_.ram_orders = false;
  inverter_.ram[560] = 0;
  const ParameterResult result = run(writeRam(102, 1000));
  EXPECT_EQ(ParameterOutcome::kDone, result.outcome);
  EXPECT_THAT(inverter_.asked, ElementsAre("P102?", "P102~1000", "P560?", "P102=1000", "P102?"));
  EXPECT_THAT(result.note, HasSubstr("P560 = 0"));
  EXPECT_FALSE(result.eeprom_written);
  EXPECT_EQ(0u, session_.eepromWrites());
}

// Whatever becomes of the write: P560 goes back.
TEST_F(ParameterSessionTest, PutsP560BackWhenTheWriteFails) {
  inverter_.ram_orders = false;
  inverter_.scripted["P102=1000"] = FakeParameters::refusal(ParameterReason::kOutOfLimits);
  ParameterResult result = run(writeRam(102, 1000));
  EXPECT_EQ(ParameterOutcome::kRefused, result.outcome);
  EXPECT_EQ(ParameterReason::kOutOfLimits, result.reason);
  EXPECT_EQ(102, result.refused_number);
  EXPECT_EQ(1, inverter_.ram[560]);
  inverter_.scripted["P102=1000"] = FakeParameters::failure(ParameterOutcome::kTimeout);
  result = run(writeRam(102, 1000));
  EXPECT_EQ(ParameterOutcome::kTimeout, result.outcome);
  EXPECT_THAT(result.note, HasSubstr("not known"));
  EXPECT_EQ(1, inverter_.ram[560]);
  EXPECT_FALSE(session_.owesEepromSwitch());
}

// Set, and no answer: it may be 0 now.
TEST_F(ParameterSessionTest, PutsP560BackWhenItsOwnAnswerIsMissing) {
  inverter_.ram_orders = false;
  inverter_.scripted["P560=0"] = FakeParameters::failure(ParameterOutcome::kTimeout);
  const ParameterResult result = run(writeRam(102, 1000));
  EXPECT_EQ(ParameterOutcome::kTimeout, result.outcome);
  EXPECT_THAT(result.note, HasSubstr("not written"));
  EXPECT_EQ("P560=1", inverter_.asked.at(4));
  EXPECT_EQ(200, inverter_.ram[102]);
  inverter_.scripted["P560=0"] = FakeParameters::refusal(ParameterReason::kReadOnly);
  EXPECT_EQ(ParameterOutcome::kRefused, run(writeRam(102, 1000)).outcome);
  EXPECT_EQ("P560=0", inverter_.asked.back()) << "refused, it is what it was";
}

// It cannot be put back: said, and tried again before the next task and after the inverter has come back.
TEST_F(ParameterSessionTest, SaysWhenP560CannotBePutBack) {
  inverter_.ram_orders = false;
  inverter_.scripted["P560=1"] = FakeParameters::failure(ParameterOutcome::kTimeout);
  const ParameterResult result = run(writeRam(102, 1000));
  EXPECT_EQ(ParameterOutcome::kTimeout, result.outcome);
  EXPECT_THAT(result.note, HasSubstr("could not be put back"));
  EXPECT_TRUE(session_.owesEepromSwitch());
  EXPECT_THAT(run(writePersistent(105, 700)).note, HasSubstr("could not be put back"));
  EXPECT_TRUE(session_.owesEepromSwitch());
  inverter_.scripted.clear();
  run(read(105));
  EXPECT_THAT(inverter_.asked, ElementsAre("P560?", "P560=1", "P560?", "P105?"));
  EXPECT_FALSE(session_.owesEepromSwitch());
}

TEST_F(ParameterSessionTest, PutsP560BackWhenTheInverterReturns) {
  inverter_.ram_orders = false;
  session_.submit(writeRam(102, 1000));
  steps(5);  // up to P560 = 0, read back
  session_.pollRequest();
  session_.handleOffline();
  const auto result = session_.pollResult();
  EXPECT_EQ(ParameterOutcome::kOffline, result.value().outcome);
  EXPECT_THAT(result->note, HasSubstr("could not be put back"));
  inverter_.asked.clear();
  settle();
  EXPECT_THAT(inverter_.asked, ElementsAre("P560?", "P560=1", "P560?"));
  EXPECT_FALSE(session_.owesEepromSwitch());
  EXPECT_FALSE(session_.pollResult().has_value());
}

// P560 = 0 is out when the inverter goes: it may have been stored, so it counts.
TEST_F(ParameterSessionTest, CountsP560WhenTheInverterGoes) {
  inverter_.ram_orders = false;
  session_.submit(writeRam(102, 1000));
  steps(3);
  session_.pollRequest();
  session_.handleOffline();
  EXPECT_EQ(1u, session_.eepromWrites());
  EXPECT_TRUE(session_.pollResult().value().eeprom_written);
  EXPECT_TRUE(session_.owesEepromSwitch());
}

TEST_F(ParameterSessionTest, TellsWhenAnotherValueIsReadBack) {
  inverter_.scripted["P102~1000"] = FakeParameters::failure(ParameterOutcome::kDone);
  const ParameterResult result = run(writeRam(102, 1000));
  EXPECT_EQ(ParameterOutcome::kRefused, result.outcome);
  EXPECT_EQ(ParameterReason::kDriver, result.reason);
  EXPECT_EQ(200, result.raw);
  EXPECT_THAT(result.note, HasSubstr("reads back another"));
}

// Who carries the answer says what to do about it; the session adds what became of the write.
TEST_F(ParameterSessionTest, PassesTheTransportsWordsOn) {
  inverter_.scripted["P102?"] = FakeParameters::refusal(ParameterReason::kUnreadable);
  ParameterResult result = run(read(102));
  EXPECT_EQ(ParameterReason::kUnreadable, result.reason);
  EXPECT_EQ("its own words", result.text.str());
  EXPECT_STREQ("", result.note);
  result = run(writeRam(102, 5));
  EXPECT_EQ("its own words", result.text.str());
  EXPECT_THAT(result.note, HasSubstr("nothing was written"));
}

// Said beforehand by the transport, also after the inverter has been exchanged: no order is tried that it cannot send.
TEST_F(ParameterSessionTest, NeverAsksForWhatTheTransportCannotDo) {
  session_ = ParameterSession{profile::ParameterCapabilities{false, true}};
  for (int i = 0; i < 2; ++i) {
    const ParameterResult result = run(writeRam(102, 1000 + i));
    EXPECT_EQ(ParameterOutcome::kDone, result.outcome);
    EXPECT_THAT(inverter_.asked, ElementsAre("P102?", "P560?", "P560=0", "P560?", "P102=" + std::to_string(1000 + i),
                                             "P560=1", "P560?", "P102?"));
    session_.handleOffline();
  }
}

// "Not indexed" to a write with an index: the parameter has no sets here; plain orders from then on.
TEST_F(ParameterSessionTest, WritesWithoutIndexWhatHasNoSets) {
  ParameterRequest what = writeRam(102, 1000);
  what.shape = ParameterShape::kPerSet;
  what.parameter_set = 3;
  session_.submit(what);
  steps(1);
  const auto indexed = session_.pollRequest();
  EXPECT_EQ(ParameterShape::kPerSet, indexed->shape);
  EXPECT_EQ(3, indexed->parameter_set);
  session_.handleResult(FakeParameters::refusal(ParameterReason::kNotIndexed));
  EXPECT_EQ(ParameterShape::kPlain, session_.pollRequest()->shape);
  session_.handleResult(FakeParameters::refusal(ParameterReason::kNotIndexed));
  EXPECT_EQ(ParameterReason::kNotIndexed, session_.pollResult().value().reason);
}

// A word may come back signed or not; a wider value is not equal because its low word is.
TEST_F(ParameterSessionTest, ComparesWordsAsWords) {
  inverter_.ram[513] = 0xFFFF;
  EXPECT_THAT(run(writeRam(513, -1)).note, HasSubstr("nothing was written"));
  inverter_.ram[613] = 0x10005;
  run(writeRam(613, 5));
  EXPECT_EQ("P613~5", inverter_.asked.at(1));
  ParameterRequest wide = writeRam(613, 0x20005);
  wide.double_word = true;
  run(wide);
  EXPECT_EQ("P613~131077", inverter_.asked.at(1));
}

TEST_F(ParameterSessionTest, EndsEverythingWhenTheInverterIsGone) {
  for (std::uint32_t i = 0; i < 8; ++i) {
    ParameterRequest what = writePersistent(102, 1000);
    what.id = i;
    EXPECT_TRUE(session_.submit(what));
  }
  EXPECT_FALSE(session_.submit(read(102)));
  steps(2);
  session_.pollRequest();  // P102=1000 is out: nobody knows whether it arrived
  session_.handleOffline();
  EXPECT_EQ(1u, session_.eepromWrites());
  for (std::uint32_t i = 0; i < 8; ++i) {
    const ParameterResult result = session_.pollResult().value();
    EXPECT_EQ(i, result.id);
    EXPECT_EQ(ParameterOutcome::kOffline, result.outcome);
    EXPECT_EQ(i == 0, result.eeprom_written);
  }
  session_.handleResult(FakeParameters::failure(ParameterOutcome::kDone));  // late: belongs to nobody
  EXPECT_FALSE(session_.pollRequest().has_value());
  EXPECT_FALSE(session_.pollResult().has_value());
}

// Whatever fails on the way: a task ends, no cycle goes uncounted, and P560 stands at 1 again or is owed.
RC_GTEST_PROP(ParameterSessionProperty, NeverForgetsP560, ()) {
  ParameterSession session;
  FakeParameters inverter;
  inverter.ram_orders = *rc::gen::arbitrary<bool>();
  const auto kinds = *rc::gen::container<std::vector<int>>(5, rc::gen::inRange(0, 3));
  for (const int kind : kinds) {
    RC_ASSERT(session.submit(access(static_cast<ParameterAction>(kind), 102, *rc::gen::inRange(0, 4))));
  }
  for (int i = 0; i < 400; ++i) {
    const auto request = session.pollRequest();
    if (!request.has_value()) break;
    const auto fate = *rc::gen::weightedElement<int>({{20, 0}, {1, 1}, {1, 2}, {1, 3}, {1, 4}});
    if (fate == 0) {
      session.handleResult(inverter.carryOut(*request));
    } else if (fate == 1) {
      session.handleResult(FakeParameters::refusal(ParameterReason::kOutOfLimits));
    } else if (fate == 2) {  // carried out, but the answer is lost
      inverter.carryOut(*request);
      session.handleResult(FakeParameters::failure(ParameterOutcome::kTimeout));
    } else if (fate == 3) {
      session.handleResult(FakeParameters::failure(ParameterOutcome::kTimeout));
    } else {
      inverter.carryOut(*request);
      session.handleOffline();
    }
  }
  RC_ASSERT(!session.pollRequest().has_value());
  for (std::size_t i = 0; i < kinds.size(); ++i) RC_ASSERT(session.pollResult().has_value());
  RC_ASSERT(static_cast<std::uint64_t>(inverter.eeprom_cycles) <= session.eepromWrites());
  RC_ASSERT(inverter.ram[560] == 1 || session.owesEepromSwitch());
}

}  // namespace
}  // namespace nord_driver::drive
