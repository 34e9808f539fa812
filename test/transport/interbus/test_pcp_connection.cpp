// Connections by Compact PCP that are lost or refused, and confirmations that come too late.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "transport/interbus/pcp_gateway.h"

namespace nord_driver::test {
namespace {

using profile::ParameterAction;
using profile::ParameterOutcome;
using profile::ParameterReason;
using profile::ParameterRequest;
using profile::ParameterResult;
using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::ElementsAre;
using ::testing::Pair;
using ::testing::StartsWith;

constexpr Word kGone = 0x0101;

/// One cycle each 10 ms.
class PcpConnection : public ::testing::Test {
 protected:
  explicit PcpConnection(bool initiate = true) : parameters(PcpGateway::map(initiate), {{2}, {3}}) {}

  static ParameterRequest read(std::uint16_t number) {
    ParameterRequest request;
    request.id = number;
    request.number = number;
    return request;
  }
  static ParameterRequest write(std::uint16_t number) {
    ParameterRequest request = read(number);
    request.action = ParameterAction::kWritePersistent;
    request.raw = 1;
    return request;
  }
  void cycle() {
    now += milliseconds{10};
    gateway.advance();
    const auto order = parameters.pollOrder(now);
    if (!order) return;
    ++orders;
    parameters.handleAnswer(gateway.carryOut(*order));
  }
  void cycles(int count) {
    for (int i = 0; i < count; ++i) cycle();
  }
  ParameterResult ask(const ParameterRequest& request, std::size_t drive = 0) {
    EXPECT_TRUE(parameters.submit(drive, request));
    for (int i = 0; i < 500; ++i) {
      if (const auto result = parameters.pollResult(drive)) return *result;
      cycle();
    }
    ADD_FAILURE() << "no result";
    return {};
  }

  Instant now{std::chrono::hours{1}};
  PcpGateway gateway;
  InterbusParameters parameters;
  int orders = 0;
};

class HeldPcpConnection : public PcpConnection {
 protected:
  HeldPcpConnection() : PcpConnection(false) {}
  /// Its order is under way then.
  void runUntilInvoked() {
    for (int i = 0; i < 100; ++i) {
      now += milliseconds{10};
      gateway.advance();
      const auto order = parameters.pollOrder(now);
      ASSERT_TRUE(order);
      if (order->write && order->values[0] != 0) return;
      parameters.handleAnswer(gateway.carryOut(*order));
    }
    FAIL() << "nothing is invoked";
  }
  static link::RegisterAnswer neverLeft() {
    link::RegisterAnswer answer;
    answer.not_taken = true;
    return answer;
  }
};

TEST_F(PcpConnection, AReadIsAskedForAgainOnANewOne) {
  ASSERT_EQ(1050, ask(read(105)).raw);
  gateway.served.clear();
  gateway.refusals = {{kPcpRead, kGone}};
  const ParameterResult result = ask(read(104));
  EXPECT_EQ(ParameterOutcome::kDone, result.outcome) << result.text.c_str();
  EXPECT_EQ(1040, result.raw);
  EXPECT_THAT(gateway.served, ElementsAre(Pair(kPcpRead, 104u), Pair(kPcpInitiate, 0u), Pair(kPcpRead, 104u)));
}

// Lost again and again: that is no answer of the inverter, and the next access begins anew.
TEST_F(PcpConnection, ALossThatStaysMayPass) {
  gateway.refusals = {{kPcpInitiate, 0}, {kPcpRead, kGone}, {kPcpInitiate, 0}, {kPcpRead, kGone}};
  const ParameterResult result = ask(read(104));
  EXPECT_EQ(ParameterOutcome::kRefused, result.outcome);
  EXPECT_TRUE(mayPass(result.reason));
  EXPECT_THAT(result.text.str(), StartsWith("PCP error 1/1"));
  EXPECT_EQ(2, gateway.count(kPcpInitiate));
  EXPECT_EQ(1040, ask(read(104)).raw);
}

// The write may have been done before its connection was lost: it is neither repeated nor told as refused.
TEST_F(PcpConnection, AWriteIsNotRepeated) {
  gateway.refusals = {{kPcpWrite, kGone}};
  ASSERT_EQ(1050, ask(read(105)).raw);
  const ParameterResult result = ask(write(102));
  EXPECT_EQ(ParameterOutcome::kTimeout, result.outcome);
  EXPECT_THAT(result.text.str(), StartsWith("PCP error 1/1"));
  EXPECT_EQ(1, gateway.count(kPcpWrite));
  EXPECT_EQ(ParameterOutcome::kDone, ask(write(102)).outcome);
  EXPECT_EQ(2, gateway.count(kPcpInitiate));
}

TEST_F(PcpConnection, OneThatIsRefusedIsInitiatedAgain) {
  gateway.refusals = {{kPcpInitiate, 0x0003}};
  EXPECT_EQ(1050, ask(read(105)).raw);
  EXPECT_EQ(2, gateway.count(kPcpInitiate));
}

// The gateway does carry parameters: that is no "no channel", and is asked again.
TEST_F(PcpConnection, ARefusalThatStaysIsNoFinalNo) {
  gateway.refusals = {{kPcpInitiate, 0x0003}, {kPcpInitiate, 0x0003}};
  const ParameterResult result = ask(read(105));
  EXPECT_EQ(ParameterOutcome::kRefused, result.outcome) << "in words: the channel lives";
  EXPECT_EQ(ParameterReason::kNotNow, result.reason);
  EXPECT_THAT(result.text.str(),
              StartsWith("its PCP connection (communication reference 2) was refused: PCP error 0/3"));
  EXPECT_EQ(2, gateway.count(kPcpInitiate));
  gateway.refusals = {{kPcpInitiate, 0x0003}, {kPcpInitiate, 0x0003}};
  const ParameterResult written = ask(write(102));
  EXPECT_EQ(ParameterOutcome::kRefused, written.outcome) << "surely not done";
  EXPECT_EQ(ParameterReason::kNotNow, written.reason);
  EXPECT_EQ(0, gateway.count(kPcpWrite));
  EXPECT_EQ(1050, ask(read(105)).raw);
}

// Nor is an abort. Behind a write nobody knows whether it was done.
TEST_F(PcpConnection, AnAbortIsNoFinalNo) {
  ASSERT_EQ(1050, ask(read(105)).raw);
  gateway.aborts = true;
  const ParameterResult written = ask(write(102));
  EXPECT_EQ(ParameterOutcome::kTimeout, written.outcome);
  EXPECT_STREQ("its PCP connection was aborted", written.text.c_str());
  for (const ParameterRequest& request : {read(105), write(102)}) {
    const ParameterResult result = ask(request);
    EXPECT_EQ(ParameterOutcome::kRefused, result.outcome) << "of the initiation";
    EXPECT_EQ(ParameterReason::kNotNow, result.reason);
  }
  gateway.aborts = false;
  EXPECT_EQ(1050, ask(read(105)).raw);
}

TEST_F(HeldPcpConnection, WhatItsGatewayLosesMayPass) {
  gateway.refusals = {{kPcpRead, kGone}};
  const ParameterResult result = ask(read(104));
  EXPECT_EQ(ParameterOutcome::kRefused, result.outcome);
  EXPECT_TRUE(mayPass(result.reason));
  EXPECT_EQ(1040, ask(read(104)).raw);
  EXPECT_EQ(0, gateway.count(kPcpInitiate));
}

// --- A confirmation names the service and the drive, not the parameter ---

TEST_F(HeldPcpConnection, ALateConfirmationIsNotThatOfTheNextParameter) {
  gateway.stalls = true;
  EXPECT_EQ(ParameterOutcome::kTimeout, ask(read(102)).outcome);
  EXPECT_TRUE(parameters.submit(0, read(105)));
  cycles(20);
  gateway.stalls = false;
  cycles(30);
  const auto result = parameters.pollResult(0);
  ASSERT_TRUE(result);
  EXPECT_EQ(1050, result->raw);
  EXPECT_THAT(gateway.served, ElementsAre(Pair(kPcpRead, 102u), Pair(kPcpRead, 105u)));
  cycles(10);
  const int before = orders;
  cycles(10);
  EXPECT_EQ(before, orders) << "who asks nothing, asks nothing";
}

TEST_F(HeldPcpConnection, NorBehindADriveThatWasOffline) {
  for (int at = 0; at < 10; ++at) {
    gateway.stalls = true;
    EXPECT_TRUE(parameters.submit(0, read(102)));
    cycles(at);
    parameters.handleOffline(0);
    while (parameters.pollResult(0)) continue;
    EXPECT_TRUE(parameters.submit(0, read(105)));
    cycles(5);
    gateway.stalls = false;
    cycles(30);
    const auto result = parameters.pollResult(0);
    ASSERT_TRUE(result) << at;
    EXPECT_EQ(1050, result->raw) << at;
  }
}

// Its gateway has one pair of blocks for all drives: nor does another drive's service go out meanwhile.
TEST_F(HeldPcpConnection, AnotherDriveWaitsForItToo) {
  gateway.stalls = true;
  EXPECT_EQ(ParameterOutcome::kTimeout, ask(read(102)).outcome);
  const ParameterResult other = ask(read(104), 1);
  EXPECT_EQ(ParameterOutcome::kTimeout, other.outcome);
  EXPECT_STREQ("PCP service 0081h of the access before was not confirmed yet (communication reference 2)",
               other.text.c_str());
  gateway.stalls = false;
  EXPECT_EQ(1040, ask(read(104), 1).raw);
  EXPECT_EQ(1050, ask(read(105)).raw);
}

TEST_F(HeldPcpConnection, OneThatNeverComesIsNotWaitedForForEver) {
  gateway.stalls = gateway.drops = true;
  EXPECT_EQ(ParameterOutcome::kTimeout, ask(read(102)).outcome);
  cycles(2900);
  gateway.stalls = false;
  gateway.served.clear();
  cycles(200);
  EXPECT_EQ(1050, ask(read(105)).raw);
}

TEST_F(HeldPcpConnection, AServiceThatNeverLeftIsNotWaitedFor) {
  EXPECT_TRUE(parameters.submit(0, read(102)));
  runUntilInvoked();
  parameters.handleOffline(0);
  parameters.handleAnswer(neverLeft());
  EXPECT_EQ(ParameterOutcome::kOffline, parameters.pollResult(0)->outcome);
  EXPECT_EQ(1050, ask(read(105)).raw);
}

// Whether it leaves is not known yet when another drive is to be asked: an order more would take its place.
TEST_F(HeldPcpConnection, NorBeforeAnotherDriveIsAsked) {
  EXPECT_TRUE(parameters.submit(0, read(102)));
  runUntilInvoked();
  parameters.handleOffline(0);
  EXPECT_TRUE(parameters.submit(1, read(104)));
  EXPECT_FALSE(parameters.pollOrder(now));
  parameters.handleAnswer(neverLeft());
  cycles(20);
  const auto result = parameters.pollResult(1);
  ASSERT_TRUE(result);
  EXPECT_EQ(1040, result->raw);
}

// The time of an access is shorter than a request to the gateway may take.
TEST_F(HeldPcpConnection, NorBehindATimeOut) {
  EXPECT_TRUE(parameters.submit(0, read(102)));
  runUntilInvoked();
  now += seconds{3};
  EXPECT_FALSE(parameters.pollOrder(now));
  EXPECT_EQ(ParameterOutcome::kTimeout, parameters.pollResult(0)->outcome);
  parameters.handleAnswer(neverLeft());
  EXPECT_EQ(1050, ask(read(105)).raw);
}

TEST_F(HeldPcpConnection, AnOrderThatIsNeverAnsweredIsNotWaitedForForEver) {
  EXPECT_TRUE(parameters.submit(0, read(102)));
  runUntilInvoked();
  parameters.handleOffline(0);
  EXPECT_EQ(ParameterOutcome::kOffline, parameters.pollResult(0)->outcome);
  EXPECT_EQ(ParameterOutcome::kTimeout, ask(read(105)).outcome);
  now += seconds{40};
  EXPECT_EQ(1050, ask(read(105)).raw);
}

}  // namespace
}  // namespace nord_driver::test
