#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "canopen/master_run.h"
#include "canopen/scripted_sdo_server.h"
#include "nord_driver/canopen/sdo_client.h"

namespace {

bool counting = false;
std::size_t allocations = 0;

void* allocate(std::size_t size) {
  if (counting) ++allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc{};
}

}  // namespace

// The whole test program runs on these; they count only where a test asks for it.
void* operator new(std::size_t size) {
  return allocate(size);
}
void* operator new[](std::size_t size) {
  return allocate(size);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace nord_driver::canopen {
namespace {

using namespace std::chrono_literals;

/// Counts what one call of the engine allocates; the nodes beside it may allocate what they like.
template <typename Call>
auto counted(Call&& call) {
  counting = true;
  struct Stop {
    ~Stop() { counting = false; }
  } stop;
  return call();
}

// The other tests prove nothing unless this counts.
TEST(NoAllocation, IsCounted) {
  allocations = 0;
  void* memory = counted([] { return ::operator new(1); });
  ::operator delete(memory);
  EXPECT_EQ(1u, allocations);
}

/// The engine's side of a bus of scripted nodes, with every call counted.
class CountedBus {
 public:
  explicit CountedBus(const MasterConfig& config) : master{config} {
    for (const NodeConfig& node : config.nodes) {
      nodes.push_back(std::make_unique<ScriptedNode>(node.id));
      nodes.back()->powerOn(now);
    }
    counted([&] { master.restart(now); });
  }

  void run(Duration span) {
    for (const Instant end = now + span; now < end;) step();
  }
  bool allOperational() const {
    for (std::size_t i = 0; i < master.nodeCount(); ++i) {
      if (master.status(i).state != NodeState::kOperational) return false;
    }
    return true;
  }

  Master master;
  std::vector<std::unique_ptr<ScriptedNode>> nodes;
  std::size_t events = 0, answers = 0, lost = 0;
  Instant now{std::chrono::hours{1}};
  bool link_full = false;

 private:
  void step() {
    now += 1ms;
    for (auto& node : nodes) {
      node->tick(now);
      CanFrame frame;
      while (node->next(now, frame)) counted([&] { master.handleFrame(frame, now); });
    }
    if (++steps_ % 10 == 0) counted([&] { cycle(); });
    counted([&] { master.poll(now); });
    CanFrame frame;
    while (counted([&] { return master.pollTransmit(frame); })) {
      if (link_full) {
        counted([&] { master.notSent(); });
        break;
      }
      for (auto& node : nodes) node->receive(frame, now);
    }
    counted([&] { collect(); });
  }
  void cycle() noexcept {
    constexpr std::array<std::uint8_t, 4> kStandby{0x7E, 0x04, 0x00, 0x00};
    for (std::size_t i = 0; i < master.nodeCount(); ++i) master.setReceivePdo(i, 0, kStandby);
    for (std::size_t i = 0; i < master.nodeCount(); ++i) master.submitSdo(i, 0, sdoRead(1, 0x1000, 0));
    master.startCycle(now);
  }
  void collect() noexcept {
    while (const auto event = master.pollEvent()) {
      ++events;
      if (event->kind == CanopenEventKind::kNodeLost) ++lost;
    }
    while (master.pollSdo()) ++answers;
  }

  int steps_ = 0;
};

// From its construction on the master takes no memory: start-up, process data, SDO accesses, emergencies, strangers, a
// full link, loss and return included.
TEST(NoAllocation, OfAMaster) {
  MasterConfig config = busConfig(3);
  config.sync_cob_id = 0x80;
  config.nodes[1].error_control.mode = ErrorControlMode::kGuarding;
  CountedBus bus{completed(config)};
  allocations = 0;
  bus.run(2s);
  ASSERT_TRUE(bus.allOperational());
  bus.nodes[0]->say("081#0081010000000000", bus.now);
  bus.nodes[0]->say("081#00", bus.now);
  bus.nodes[0]->say("000#8100", bus.now);
  bus.nodes[0]->say("77F#05", bus.now);
  bus.run(100ms);
  bus.link_full = true;
  bus.run(50ms);
  bus.link_full = false;
  bus.nodes[1]->powerOff();
  bus.nodes[2]->powerOff();
  bus.run(2s);
  EXPECT_EQ(2u, bus.lost);
  for (auto& node : bus.nodes) node->powerOn(bus.now);
  bus.run(5s);
  EXPECT_TRUE(bus.allOperational());
  EXPECT_GT(bus.answers, 300u);
  EXPECT_GT(bus.events, 8u);
  EXPECT_EQ(0u, allocations);
}

// The client takes none either: every kind of transfer, both ways, aborted and timed out.
TEST(NoAllocation, OfAnSdoClient) {
  ScriptedSdoServer server;
  SdoClient client{defaultSdoChannel(1), 50ms};
  Instant now{std::chrono::hours{1}};
  const std::vector<std::uint8_t> data(300, 0x55);
  allocations = 0;
  std::size_t good = 0, ended = 0;
  for (unsigned kind = 0; kind < 16; ++kind) {
    SdoRequest request = sdoRead(kind, 0x2000, static_cast<std::uint8_t>(kind & 1u));
    request.write = (kind & 2u) == 0;
    request.block = (kind & 4u) != 0;
    const bool silent = (kind & 8u) != 0 && (kind & 1u) != 0;
    const ByteView bytes = ByteView{data}.sub(0, (kind & 1u) != 0 ? 4 : 300);
    ASSERT_TRUE(counted([&] { return client.start(request, bytes, now); }));
    for (bool over = false; !over;) {
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
      now += 10ms;
      counted([&] { client.poll(now); });
      const auto answer = counted([&] { return client.takeAnswer(); });
      over = answer.has_value();
      if (over) good += answer->ok() ? 1 : 0;
      if (over) ++ended;
    }
  }
  EXPECT_EQ(16u, ended);
  EXPECT_EQ(12u, good);
  EXPECT_EQ(0u, allocations);
}

}  // namespace
}  // namespace nord_driver::canopen
