#include <gtest/gtest.h>

#include "canopen/master_run.h"
#include "canopen/scripted_sdo_server.h"
#include "canopen/sdo_client.h"
#include "support/count_allocations.h"

namespace nord_driver::canopen {
namespace {

/// Counts what is allocated while it lives.
struct Counted {
  Counted() { test::countThisThread(true); }
  ~Counted() { test::countThisThread(false); }
};

/// Counts what one call allocates.
template <typename Call>
auto counted(Call&& call) {
  const Counted here;
  return call();
}

// The other tests prove nothing unless this counts.
TEST(NoAllocation, IsCounted) {
  if (!test::kCanCountAllocations) GTEST_SKIP() << "the sanitizers have replaced malloc";
  test::allocations = 0;
  void* memory = counted([] { return ::operator new(1); });
  ::operator delete(memory);
  EXPECT_EQ(1u, test::allocations);
}

// From its construction on the master takes no memory: start-up, exchange, emergencies, malformed and foreign frames,
// refusals, losses, return, restart and a full link included.
TEST(NoAllocation, AfterConstruction) {
  if (!test::kCanCountAllocations) GTEST_SKIP() << "the sanitizers have replaced malloc";
  MasterConfig config = busConfig(4);
  config.sync_cob_id = 0x80;
  config.own_id = 127;
  config.heartbeat_time = std::chrono::milliseconds{100};
  config.nodes[1].product_code = 1;
  config.nodes[2].error_control.mode = ErrorControlMode::kGuarding;
  config.nodes[3].transmit_pdos[0].mapping.push_back({0x3003, 2, 16});
  Master master{config};
  std::vector<std::unique_ptr<ScriptedNode>> nodes;
  for (const NodeConfig& node : config.nodes) nodes.push_back(std::make_unique<ScriptedNode>(node.id));
  const std::vector<CanFrame> noise{frame("081#0081010000000000"),
                                    frame("081#00"),
                                    frame("709#05"),
                                    frame("000#0100"),
                                    frame("181#00"),
                                    frame("77F#05"),
                                    frame("581#4B66200167000000")};
  Instant now{std::chrono::hours{1}};
  std::array<bool, 4> was_operational{};
  test::allocations = 0;
  for (int i = 0; i < 12000; ++i, now += std::chrono::milliseconds{1}) {
    if (i == 0 || i == 5000) {
      for (auto& node : nodes) node->powerOn(now);
    }
    if (i == 3000) nodes[0]->powerOff();
    if (i == 3500) nodes[2]->powerOff();
    for (auto& node : nodes) {
      node->tick(now);
      CanFrame received;
      while (node->next(now, received)) {
        const Counted counted;
        master.handleFrame(received, now);
      }
    }
    std::vector<CanFrame> sent;
    sent.reserve(64);
    {
      const Counted counted;
      if (i == 0 || i == 9000) master.restart(now);
      if (i % 100 == 50) master.handleFrame(noise[static_cast<std::size_t>(i / 100) % noise.size()], now);
      if (i % 10 == 0) {
        const std::array<std::uint8_t, 4> idle{0x7E, 0x04, 0x00, 0x00};
        for (std::size_t node = 0; node < 4; ++node) master.setReceivePdo(node, 0, idle);
        master.startCycle(now);
        master.submitSdo(0, 0, sdoRead(1, 0x2066, 1));
      }
      master.poll(now);
      CanFrame out;
      while (sent.size() < 64 && master.pollTransmit(out)) {
        if (i % 70 == 0) {
          master.notSent();
          break;
        }
        sent.push_back(out);
      }
      while (master.pollSdo()) {
      }
      while (master.pollEvent()) {
      }
      for (std::size_t node = 0; node < 4; ++node) {
        was_operational[node] = was_operational[node] || master.status(node).state == NodeState::kOperational;
      }
    }
    for (const CanFrame& out : sent) {
      for (auto& node : nodes) node->receive(out, now);
    }
  }
  EXPECT_EQ(0u, test::allocations);
  // It did what it was to be watched at.
  EXPECT_EQ((std::array<bool, 4>{true, false, true, true}), was_operational);
  EXPECT_EQ(NodeState::kRefused, master.status(1).state);
  EXPECT_GE(master.status(0).counters.losses, 1u);
  EXPECT_GE(master.status(2).counters.losses, 1u);
  EXPECT_GT(master.counters().not_sent, 0u);
}

// The client takes none either: every kind of transfer, both ways, aborted and timed out.
TEST(NoAllocation, OfAnSdoClient) {
  if (!test::kCanCountAllocations) GTEST_SKIP() << "the sanitizers have replaced malloc";
  ScriptedSdoServer server;
  SdoClient client{defaultSdoChannel(1), std::chrono::milliseconds{50}};
  Instant now{std::chrono::hours{1}};
  const std::vector<std::uint8_t> data(300, 0x55);
  test::allocations = 0;
  std::size_t good = 0, ended = 0;
  for (unsigned kind = 0; kind < 16; ++kind) {
    SdoRequest request = sdoRead(kind, 0x2000, static_cast<std::uint8_t>(kind & 1u));
    request.write = (kind & 2u) == 0;
    request.block = (kind & 4u) != 0;
    const bool silent = (kind & 8u) != 0 && (kind & 1u) != 0;
    const ByteView bytes = ByteView{data}.sub(0, (kind & 1u) != 0 ? 4 : 300);
    ASSERT_TRUE(counted([&] { return client.start(request, bytes, now); }));
    bool over = false;
    for (int step = 0; !over; ++step) {
      ASSERT_LT(step, 10'000) << "transfer " << kind << " does not end";
      CanFrame frame;
      std::vector<SdoBytes> answers;
      while (counted([&] { return client.pollTransmit(frame); })) {
        if (silent) continue;
        for (const auto& answer : server.handle(frame.data)) answers.push_back(answer);
      }
      for (const SdoBytes& answer : answers) {
        const CanFrame made = dataFrame(0x581, answer);
        counted([&] { client.handle(made, now); });
      }
      now += std::chrono::milliseconds{10};
      counted([&] { client.poll(now); });
      const auto answer = counted([&] { return client.takeAnswer(); });
      over = answer.has_value();
      if (over) good += answer->ok() ? 1 : 0;
      if (over) ++ended;
    }
  }
  EXPECT_EQ(16u, ended);
  EXPECT_EQ(12u, good);
  EXPECT_EQ(0u, test::allocations);
}

}  // namespace
}  // namespace nord_driver::canopen
