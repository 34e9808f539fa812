#include <gtest/gtest.h>

#include "sim/profibus/conversation.h"
#include "sim/profibus/referee.h"

namespace nord_driver::sim {
namespace {

using std::chrono::milliseconds;

// Each test breaks one rule once and sees that one counted, and no other.
class RefereeTest : public ::testing::Test {
 protected:
  void expectOnly(Rule rule) {
    EXPECT_EQ(1u, bus.referee().count(rule)) << bus.referee().report();
    EXPECT_EQ(1u, bus.referee().total()) << bus.referee().report();
  }
  std::vector<std::uint8_t> dataExchange(unsigned function, const std::string& data = "0000 0000 0000 0000 047E 0000") {
    return Conversation::variable(0x08, 0x01, function, fromHex(data));
  }

  Conversation bus;
};

// A correct conversation with start-up, parameters, retries, a lost drive and its return breaks nothing.
TEST_F(RefereeTest, IsContentWithACorrectMaster) {
  bus.ask("10 08 01 49 52 16");
  bus.startUp();
  bus.pzdFor("047E 0000", milliseconds(20));
  bus.pzdFor("047F 2000", milliseconds(500));
  bus.exchange("744E 0200 0000 03E8", "047F 2000");
  bus.exchange("744E 0200 0000 03E8", "047F 2000");
  bus.pzd("047F 2000");
  bus.ask("68 07 07 68 FF 81 46 3A 3E 00 00 3E 16");
  // A retry with the same FCB.
  bus.segment.loseAnswers(1);
  const auto telegram = dataExchange(bus.frameCount(), "0000 0000 0000 0000 047F 2000");
  EXPECT_EQ("", bus.askBytes(telegram));
  EXPECT_NE("", bus.askBytes(telegram));
  // The station loses its power: silence, then a first request, and the start-up again.
  bus.drive().setPlugged(false);
  EXPECT_EQ("", bus.pzd("047F 2000"));
  bus.restartFrameCount();
  EXPECT_EQ("", bus.service(60, {}));
  bus.drive().setPlugged(true);
  bus.restartFrameCount();
  bus.startUp();
  bus.pzdFor("047E 0000", milliseconds(20));
  EXPECT_EQ("no rule broken", bus.referee().report());
}

TEST_F(RefereeTest, ShortPause) {
  bus.ask("10 08 01 49 52 16");
  bus.ask("10 08 01 49 52 16", 33);
  EXPECT_TRUE(bus.referee().content());
  bus.ask("10 08 01 49 52 16", 32);
  expectOnly(Rule::kShortPause);
}

TEST_F(RefereeTest, Collision) {
  bus.segment.write(fromHex("10 08 01 49 52 16"));
  bus.segment.run(bus.segment.baudRate().bits(66 + 32 + 20));  // the answer is on the line
  bus.segment.write(fromHex("10 08 01 49 52 16"));
  expectOnly(Rule::kCollision);
}

TEST_F(RefereeTest, EarlyAnswer) {
  bus.segment.setAnswerTime(11);
  bus.ask("10 08 01 49 52 16");
  EXPECT_TRUE(bus.referee().content());
  bus.segment.setAnswerTime(10);
  bus.ask("10 08 01 49 52 16");
  expectOnly(Rule::kEarlyAnswer);
}

TEST_F(RefereeTest, NoTelegram) {
  bus.ask("10 08 01 49 53 16");  // wrong checksum
  expectOnly(Rule::kNoTelegram);
}

TEST_F(RefereeTest, HalfATelegram) {
  bus.ask("68 05 05 68 88 81 6D");
  expectOnly(Rule::kNoTelegram);
  EXPECT_EQ("10 01 08 00 09 16", bus.ask("10 08 01 49 52 16"));
}

TEST_F(RefereeTest, NotARequest) {
  bus.ask("E5");
  expectOnly(Rule::kNotARequest);
}

TEST_F(RefereeTest, UnknownFunction) {
  bus.ask("10 08 01 41 4A 16");
  expectOnly(Rule::kUnknownFunction);
}

TEST_F(RefereeTest, FrameCountInAStatusRequest) {
  bus.ask("10 08 01 69 72 16");
  expectOnly(Rule::kFrameCountOnUnacknowledged);
}

TEST_F(RefereeTest, FirstRequestWithoutFcb) {
  bus.ask("68 05 05 68 88 81 4D 3C 3E D0 16");
  expectOnly(Rule::kFirstRequestWithoutFcb);
}

TEST_F(RefereeTest, FcvBeforeTheFirstRequest) {
  bus.ask("68 05 05 68 88 81 5D 3C 3E E0 16");
  expectOnly(Rule::kFcvBeforeFirstRequest);
}

TEST_F(RefereeTest, SameFcbWithAnotherTelegram) {
  bus.startUp();  // ends with 7D... the next is 5D or 7D; the last one is used again
  const unsigned function = bus.frameCount();
  bus.askBytes(dataExchange(function));
  bus.askBytes(dataExchange(function, "0000 0000 0000 0000 047F 2000"));
  expectOnly(Rule::kFcbReused);
}

TEST_F(RefereeTest, FcbToggledWithoutAnswer) {
  bus.startUp();
  bus.segment.loseAnswers(1);
  bus.pzd("047E 0000");
  bus.pzd("047E 0000");
  expectOnly(Rule::kFcbToggledWithoutAnswer);
}

TEST_F(RefereeTest, DiagnosisWithData) {
  bus.service(60, {0x00});
  expectOnly(Rule::kDiagnosisWithData);
}

TEST_F(RefereeTest, ShortSetPrm) {
  bus.service(60, {});
  bus.service(61, {0x88, 10, 1, 11, 0x75, 0x31});
  expectOnly(Rule::kWrongParameterLength);
}

TEST_F(RefereeTest, SetPrmWithoutLock) {
  bus.service(60, {});
  bus.service(61, {0x08, 10, 1, 11, 0x75, 0x31, 0});
  expectOnly(Rule::kParameterisedWithoutLock);
}

TEST_F(RefereeTest, ChkCfgBeforeSetPrm) {
  bus.service(60, {});
  bus.service(62, {0xF3, 0xF1});
  expectOnly(Rule::kConfiguredBeforeParameterised);
}

TEST_F(RefereeTest, DataExchangeWithoutAskingWhetherReady) {
  bus.service(60, {});
  bus.service(61, {0x88, 10, 1, 11, 0x75, 0x31, 0});
  bus.service(62, {0xF3, 0xF1});
  bus.pzd("047E 0000");
  expectOnly(Rule::kDataExchangeBeforeReady);
}

TEST_F(RefereeTest, WrongDataLength) {
  bus.startUp();
  bus.askBytes(dataExchange(bus.frameCount(), "047E 0000"));
  expectOnly(Rule::kWrongDataLength);
  EXPECT_EQ(SlaveState::kWaitParameters, bus.station().state());
}

TEST_F(RefereeTest, WriteOrderLeftStanding) {
  bus.startUp();
  for (int i = 0; i < 4; ++i) bus.exchange("744E 0200 0000 03E8", "047E 0000");
  EXPECT_TRUE(bus.referee().content());
  for (int i = 0; i < 10; ++i) bus.exchange("744E 0200 0000 03E8", "047E 0000");
  expectOnly(Rule::kWriteOrderLeftStanding);
}

// Before the first valid word one with bit 10 = 0 is allowed: it tells the master the set without commanding any.
TEST_F(RefereeTest, ZeroControlWord) {
  bus.startUp();
  bus.pzd("0000 0000");
  bus.pzd("047E 0000");
  EXPECT_TRUE(bus.referee().content());
  bus.pzd("0000 0000");
  expectOnly(Rule::kZeroControlWord);
  EXPECT_EQ(1u, bus.station().counters().zero_control_words);
}

TEST_F(RefereeTest, ReportsInWords) {
  bus.ask("E5");
  bus.ask("E5");
  EXPECT_EQ("2 x an answer was sent where only requests may come", bus.referee().report());
  bus.referee().forget();
  EXPECT_EQ("no rule broken", bus.referee().report());
}

}  // namespace
}  // namespace nord_driver::sim
