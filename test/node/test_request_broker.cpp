// Service calls that wait for the cycle: each gets its own answer, and nobody waits for ever.
#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "node/request_broker.h"

namespace nord_driver::node {
namespace {

/// In the place of the bus cycle: answers what it is told to, in a thread of its own.
class Cycle {
 public:
  explicit Cycle(cycle::CyclePorts& ports, bool reversed = false) : ports_(ports), reversed_(reversed) {
    thread_ = std::thread([this] { run(); });
  }
  ~Cycle() {
    stop_ = true;
    thread_.join();
  }

 private:
  void run() {
    std::vector<cycle::Request> pending;
    while (!stop_) {
      while (const auto request = ports_.pollRequest()) pending.push_back(*request);
      if (reversed_ && pending.size() < 4) {  // all four callers first, then the last one first
        std::this_thread::yield();
        continue;
      }
      for (auto at = pending.rbegin(); at != pending.rend(); ++at) {
        cycle::Completion completion;
        completion.id = at->id;
        completion.success = true;
        completion.message = std::to_string(at->drive).c_str();
        ports_.complete(completion);
      }
      pending.clear();
      ports_.publish(cycle::CycleSnapshot{4});
      std::this_thread::yield();
    }
  }

  cycle::CyclePorts& ports_;
  bool reversed_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

cycle::Request request(DriveIndex drive, Duration patience = std::chrono::seconds{5}) {
  cycle::Request request;
  request.drive = drive;
  request.patience = patience;
  return request;
}

TEST(RequestBrokerTest, SaysWhenItWasAsked) {
  cycle::CyclePorts ports{4};
  RequestBroker broker{ports};
  const Instant before = std::chrono::steady_clock::now();
  broker.call(request(0, -std::chrono::seconds{1}));
  const auto asked = ports.pollRequest();
  ASSERT_TRUE(asked);
  EXPECT_GE(asked->asked, before);
  EXPECT_LE(asked->asked, std::chrono::steady_clock::now());
}

TEST(RequestBrokerTest, EachOfSeveralCallersGetsItsOwnAnswer) {
  cycle::CyclePorts ports{4};
  RequestBroker broker{ports};
  Cycle cycle{ports, true};
  std::vector<std::string> answers(4);
  std::vector<std::thread> callers;
  for (DriveIndex i = 0; i < 4; ++i) {
    callers.emplace_back([&, i] { answers[i] = broker.call(request(i)).message.str(); });
  }
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ((std::vector<std::string>{"0", "1", "2", "3"}), answers);
}

// A cycle that does not answer costs a caller its patience and a second, not the node.
TEST(RequestBrokerTest, ACallerGivesUpAndALateAnswerDisturbsNobody) {
  cycle::CyclePorts ports{4};
  RequestBroker broker{ports};
  const cycle::Completion none = broker.call(request(0, std::chrono::seconds{-1}));
  EXPECT_FALSE(none.success);
  EXPECT_STREQ("the bus cycle did not answer", none.message.c_str());
  EXPECT_TRUE(none.unanswered);
  Cycle cycle{ports};  // answers the forgotten request first
  const cycle::Completion answer = broker.call(request(3));
  EXPECT_TRUE(answer.success);
  EXPECT_FALSE(answer.unanswered);
  EXPECT_STREQ("3", answer.message.c_str());
}

TEST(RequestBrokerTest, AFullQueueIsSaidAtOnce) {
  cycle::CyclePorts ports{1};
  RequestBroker broker{ports};
  int taken = 0;
  while (taken < 1000 && ports.submit({})) ++taken;
  ASSERT_LT(taken, 1000) << "the queue of requests is never full";
  const cycle::Completion answer = broker.call(request(0));
  EXPECT_FALSE(answer.success);
  EXPECT_STREQ("too many requests are waiting already", answer.message.c_str());
  EXPECT_EQ(0u, answer.id) << "it may be asked again";
}

// 0 says that nobody waits for an answer.
TEST(RequestBrokerTest, NumbersAreNeverZero) {
  cycle::CyclePorts ports{1};
  RequestBroker broker{ports};
  for (int i = 0; i < 3; ++i) {
    broker.call(request(0, std::chrono::seconds{-1}));
    const auto seen = ports.pollRequest();
    ASSERT_TRUE(seen.has_value());
    EXPECT_NE(0u, seen->id);
  }
}

// A log line takes milliseconds where the disk is slow: the stop is to be with the cycle before.
TEST(RequestBrokerTest, TellsThatTheCycleHasTheRequestBeforeItWaits) {
  cycle::CyclePorts ports{4};
  RequestBroker broker{ports};
  int told = 0;
  const cycle::Completion answer = broker.call(request(2), [&] {
    ++told;
    const auto asked = ports.pollRequest();
    ASSERT_TRUE(asked) << "the cycle does not have it yet";
    EXPECT_EQ(2u, asked->drive);
    cycle::Completion completion;
    completion.id = asked->id;
    completion.success = true;
    ports.complete(completion);
    ports.publish(cycle::CycleSnapshot{4});
  });
  EXPECT_TRUE(answer.success);
  EXPECT_EQ(1, told);
}

TEST(RequestBrokerTest, TellsNothingOfARequestThatTheCycleDoesNotGet) {
  cycle::CyclePorts ports{4};
  RequestBroker broker{ports};
  broker.end();
  broker.call(request(2), [] { FAIL() << "it did not reach the cycle"; });
}

// The node ends when the drives are at rest: a write that begins then would be cut off, and leave P560 = 0.
TEST(RequestBrokerTest, RefusesWritesAndCountsThoseUnderWay) {
  cycle::CyclePorts ports{4};
  RequestBroker broker{ports};
  cycle::Request write = request(0, std::chrono::minutes{1});
  write.kind = cycle::RequestKind::kWriteParameter;
  EXPECT_EQ(0u, broker.writesUnderWay());
  std::thread writer{[&] { EXPECT_TRUE(broker.call(write).success) << "it was under way before"; }};
  std::optional<cycle::Request> taken;
  while (!(taken = ports.pollRequest())) std::this_thread::yield();
  EXPECT_EQ(1u, broker.writesUnderWay());
  broker.refuseWrites();
  const cycle::Completion refused = broker.call(write);
  EXPECT_FALSE(refused.success);
  EXPECT_STREQ("the node is ending", refused.message.c_str());
  EXPECT_FALSE(refused.parameter.eeprom_written);
  EXPECT_FALSE(refused.unanswered) << "it is known not to be done";
  EXPECT_FALSE(ports.pollRequest()) << "the cycle does not get it";
  EXPECT_EQ(1u, broker.writesUnderWay());
  cycle::Completion completion;
  completion.id = taken->id;
  completion.success = true;
  ports.complete(completion);
  ports.publish(cycle::CycleSnapshot{4});
  writer.join();
  EXPECT_EQ(0u, broker.writesUnderWay());
  Cycle cycle{ports};
  EXPECT_TRUE(broker.call(request(1)).success) << "what is no write is carried out";
}

// With a minute of patience, and nobody in the place of the cycle.
TEST(RequestBrokerTest, WhoWaitsIsAnsweredWhenTheCycleHasEnded) {
  cycle::CyclePorts ports{1};
  RequestBroker broker{ports};
  cycle::Completion answer;
  std::thread caller{[&] { answer = broker.call(request(0, std::chrono::minutes{1})); }};
  while (!ports.pollRequest()) std::this_thread::yield();
  const auto asked = std::chrono::steady_clock::now();
  broker.end();
  caller.join();
  EXPECT_LT(std::chrono::steady_clock::now() - asked, std::chrono::seconds{30});
  EXPECT_STREQ("the node is ending", answer.message.c_str());
  EXPECT_STREQ("the node is ending", broker.call(request(0)).message.c_str());
}

}  // namespace
}  // namespace nord_driver::node
