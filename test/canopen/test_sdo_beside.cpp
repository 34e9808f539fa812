#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "canopen/master_run.h"
#include "canopen/sdo_abort.h"

namespace nord_driver::canopen {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// The answer within `limit`.
std::optional<NodeSdoAnswer> answerWithin(MasterRun& run, Duration limit) {
  std::optional<NodeSdoAnswer> answer;
  run.runUntil(
      [&] {
        if (!answer) answer = run.master.pollSdo();
        return answer.has_value();
      },
      limit);
  return answer;
}

// P102 set 1 = 1.03 s (BU 0060 p. 61), beside the exchange.
TEST(SdoBeside, WritesAParameter) {
  MasterRun run{busConfig(1, 0x32)};
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{1}));
  run.sent.clear();
  ASSERT_TRUE(run.master.submitSdo(0, 0, sdoWrite(5, 0x2066, 1, 103, 2)));
  EXPECT_FALSE(run.master.submitSdo(0, 0, sdoRead(6, 0x2066, 1))) << "one at a time";
  const auto answer = answerWithin(run, milliseconds{100});
  ASSERT_TRUE(answer);
  EXPECT_TRUE(answer->answer.ok());
  EXPECT_EQ(5u, answer->answer.id);
  EXPECT_THAT(run.sent, testing::Contains("632#2B66200167000000"));
  EXPECT_TRUE(run.master.submitSdo(0, 0, sdoRead(6, 0x2066, 1)));
}

// Its time begins with what was heard last: after a pause of the link it is not over before it was sent.
TEST(SdoBeside, TheTimeOfARequestBeginsWithTheLastFrame) {
  MasterRun run{busConfig(1, 0x32)};
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{1}));
  run.nodes[0]->hears_sdo = false;
  run.now += seconds{1};
  run.master.handleFrame(dataFrame(0x7FF, {}), run.now);
  ASSERT_TRUE(run.master.submitSdo(0, 0, sdoRead(6, 0x2066, 1)));
  run.master.poll(run.now);
  EXPECT_FALSE(run.master.pollSdo());
}

// In the start-up of the node the two take turns; neither starves.
TEST(SdoBeside, TakesTurnsWithTheStartUp) {
  MasterRun run{busConfig(1)};
  run.nodes[0]->sdo_delay = milliseconds{5};
  run.begin();
  int answers = 0;
  const bool done = run.runUntil(
      [&] {
        while (run.master.pollSdo()) ++answers;
        run.master.submitSdo(0, 0, sdoRead(1, 0x2066, 1));
        return run.allOperational();
      },
      seconds{2});
  EXPECT_TRUE(done);
  EXPECT_GE(answers, 10);
}

TEST(SdoBeside, TellsAbortsAndTimeOuts) {
  MasterRun run{busConfig(1)};
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{1}));
  run.master.submitSdo(0, 0, sdoRead(1, 0x2999, 0));
  const auto refused = answerWithin(run, milliseconds{100});
  ASSERT_TRUE(refused);
  EXPECT_EQ(SdoEnd::kAbortedByServer, refused->answer.end);
  EXPECT_EQ(sdo_abort::kNoObject, refused->answer.abort_code);
  run.nodes[0]->hears_sdo = false;
  run.master.submitSdo(0, 0, sdoRead(2, 0x2066, 1));
  const auto silent = answerWithin(run, milliseconds{310});
  ASSERT_TRUE(silent);
  EXPECT_EQ(SdoEnd::kTimedOut, silent->answer.end);
  EXPECT_EQ(1u, run.master.counters().sdo_timeouts);
  EXPECT_EQ(1u, run.master.counters().sdo_aborts);
  EXPECT_EQ(NodeState::kOperational, run.master.status(0).state) << "an SDO alone loses no node";
}

// A gateway has one server per inverter, each with an access of its own (1200h to 1203h, BU 0260).
TEST(SdoBeside, ServersOfAGatewayWorkSideBySide) {
  MasterConfig config = busConfig(1);
  config.nodes[0].sdo_servers = {{0x601, 0x581}, {0x611, 0x591}, {0x621, 0x5A1}, {0x631, 0x5B1}};
  MasterRun run{config};
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{1}));
  run.sent.clear();
  for (std::uint32_t server = 0; server < 4; ++server) {
    ASSERT_TRUE(run.master.submitSdo(0, server, sdoRead(server, 0x2066, 1)));
  }
  run.step();
  for (const char* sent :
       {"601#4066200100000000", "611#4066200100000000", "621#4066200100000000", "631#4066200100000000"}) {
    EXPECT_THAT(run.sent, testing::Contains(sent));
  }
  run.say("5A1#4B66200167000000");
  std::vector<std::size_t> servers;
  while (const auto answer = run.master.pollSdo()) servers.push_back(answer->server);
  EXPECT_THAT(servers, testing::Contains(2u));
}

// An answer nobody waited for is counted, and changes nothing.
TEST(SdoBeside, CountsStrayAnswers) {
  MasterRun run{busConfig(1)};
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{1}));
  run.say("581#4B66200167000000");
  EXPECT_EQ(1u, run.master.counters().stray_sdo);
  EXPECT_FALSE(run.master.pollSdo());
}

// An answer is fetched by asking until there is none: the access of the start-up that waited for the server is not
// forgotten by that.
TEST(SdoBeside, FetchingAnAnswerDoesNotStrandTheStartUp) {
  MasterConfig config = busConfig(1);
  config.nodes[0].reset = BootReset::kNone;
  Master master{config};
  Instant now{std::chrono::hours{1}};
  CanFrame sent;
  master.restart(now);
  ASSERT_TRUE(master.pollTransmit(sent));
  EXPECT_EQ("601#4000100000000000", text(sent));
  ASSERT_TRUE(master.submitSdo(0, 0, sdoRead(1, 0x2066, 1)));
  master.handleFrame(frame("581#4300100000000000"), now);
  ASSERT_TRUE(master.pollTransmit(sent));
  EXPECT_EQ("000#8001", text(sent));
  ASSERT_TRUE(master.pollTransmit(sent));
  EXPECT_EQ("601#4066200100000000", text(sent));
  EXPECT_FALSE(master.pollTransmit(sent));
  master.handleFrame(frame("581#4B66200167000000"), now);
  EXPECT_TRUE(master.pollSdo());
  EXPECT_FALSE(master.pollSdo());
  ASSERT_TRUE(master.nextDeadline());
  EXPECT_LE(*master.nextDeadline(), now);
  master.poll(now);
  ASSERT_TRUE(master.pollTransmit(sent));
  EXPECT_EQ("601#4018100100000000", text(sent));
}

// The bus was opened again: what was under way is over, and the server is free.
TEST(SdoBeside, RestartEndsWhatWasUnderWay) {
  MasterRun run{busConfig(1)};
  run.master.restart(run.now);
  ASSERT_TRUE(run.master.submitSdo(0, 0, sdoRead(1, 0x2066, 1)));
  run.master.restart(run.now);
  EXPECT_TRUE(run.master.submitSdo(0, 0, sdoRead(2, 0x2066, 1)));
  run.run(seconds{1});
  const auto answer = run.master.pollSdo();
  ASSERT_TRUE(answer);
  EXPECT_EQ(2u, answer->answer.id);
  EXPECT_FALSE(run.master.pollSdo());
}

}  // namespace
}  // namespace nord_driver::canopen
