// Requests beside the images, over the same connection and over a second one.
#include <gmock/gmock.h>

#include <algorithm>

#include "link/modbus/link_fixture.h"

namespace nord_driver::link::test {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr std::size_t kFunctionAt = 7;

RegisterOrder readOrder(std::uint16_t first, std::uint16_t count, bool input_registers = false) {
  RegisterOrder order;
  order.input_registers = input_registers;
  order.registers = {first, count};
  return order;
}

RegisterOrder writeOrder(std::uint16_t first, std::initializer_list<Word> values) {
  RegisterOrder order;
  order.write = true;
  order.registers = {first, static_cast<std::uint16_t>(values.size())};
  std::copy(values.begin(), values.end(), order.values.begin());
  return order;
}

/// How many requests of this function for this register.
long countOf(const std::vector<Bytes>& requests, std::uint8_t function, std::uint16_t first) {
  return std::count_if(requests.begin(), requests.end(), [&](const Bytes& request) {
    return request[kFunctionAt] == function && (request[8] << 8 | request[9]) == first;
  });
}

class Orders : public ModbusLinkTest {
 protected:
  /// With another server for what is no image.
  void startWithDiagnosis(const std::function<void(ModbusSettings&)>& change = {}) {
    ModbusSettings settings = fourWords(server.address());
    settings.diagnosis = second.address();
    settings.first_pause = milliseconds{1};
    if (change) change(settings);
    start(settings);
  }
  /// The order's answer, while images go on.
  const RegisterAnswer& answerTo(const RegisterOrder& order) {
    const std::uint64_t number = link->order(order);
    EXPECT_TRUE(waitFor([&] { return link->answer().number >= number; }));
    return link->answer();
  }
  /// Gives images all the time.
  bool waitFor(const std::function<bool()>& condition) {
    const Instant until = link->now() + kPatience;
    while (!condition()) {
      if (link->now() >= until) return false;
      link->give({1, 2, 3, 4});
      link->waitAnswers(link->now() + milliseconds{2});
    }
    return true;
  }

  FakeModbusServer second;
};

TEST_F(Orders, AreCarriedOutBesideTheImages) {
  start();
  ASSERT_TRUE(waitConnected());
  EXPECT_TRUE(answerTo(writeOrder(200, {0x0081, 2, 0x2069})).good);
  EXPECT_EQ(0x2069, server.holding(202));
  server.setInput(300, 0x1234);
  const RegisterAnswer read = answerTo(readOrder(300, 2, true));
  EXPECT_TRUE(read.good) << read.text.c_str();
  EXPECT_EQ(0x1234, read.values[0]);
  const RegisterAnswer held = answerTo(readOrder(201, 2));
  EXPECT_EQ(2, held.values[0]);
  EXPECT_EQ(1, countOf(server.requests(), 16, 200)) << "once, however many images there are";
  EXPECT_EQ(1u, server.connections());
}

TEST_F(Orders, ARefusedOneStopsNoImages) {
  start();
  ASSERT_TRUE(waitConnected());
  const RegisterAnswer answer = answerTo(readOrder(FakeModbusServer::kRegisters, 1));
  EXPECT_FALSE(answer.good);
  EXPECT_THAT(answer.text.str(), HasSubstr("exception 2"));
  EXPECT_TRUE(exchange({1, 2, 3, 4}));
  EXPECT_EQ(1u, link->report().counters.exceptions);
  EXPECT_EQ("", link->report().text.str());
}

TEST_F(Orders, WithoutAConnectionAreGivenUp) {
  server.shut();
  start();
  const RegisterAnswer answer = answerTo(readOrder(1, 1));
  EXPECT_FALSE(answer.good);
  EXPECT_TRUE(answer.not_taken) << "it never left, so that it may be asked again";
  EXPECT_THAT(answer.text.str(), HasSubstr("refuses the connection"));
}

// The write of the image is held until the order waits; then the read of the image is refused.
TEST_F(Orders, OneThatWaitsWhileAnImageIsRefusedNeverLeft) {
  start();
  ASSERT_TRUE(waitConnected());
  server.next({Reaction::kHold});
  server.next({Reaction::kException, 6});
  link->give({1, 2, 3, 4});
  ASSERT_TRUE(server.waitForRequests(1));
  const std::uint64_t number = link->order(writeOrder(200, {7}));
  server.release();
  ASSERT_TRUE(waitUntil([&] { return link->answer().number >= number; }));
  EXPECT_FALSE(link->answer().good);
  EXPECT_TRUE(link->answer().not_taken);
  EXPECT_THAT(link->answer().text.str(), HasSubstr("exception 6"));
  EXPECT_EQ(0, countOf(server.requests(), 16, 200));
}

TEST_F(Orders, OneThatWaitsWhileTheRunningFlagIsRefusedNeverLeft) {
  second.always({Reaction::kException, 6});
  startWithDiagnosis([](ModbusSettings& settings) {
    settings.running = RunningFlag{ModbusFunction::kReadHoldingRegisters, 400, 1, 1};
  });
  const RegisterAnswer answer = answerTo(writeOrder(200, {7}));
  EXPECT_FALSE(answer.good);
  EXPECT_TRUE(answer.not_taken);
  EXPECT_EQ(0, countOf(second.requests(), 16, 200));
}

TEST_F(Orders, GoOverTheSecondConnection) {
  startWithDiagnosis();
  EXPECT_TRUE(answerTo(writeOrder(200, {7})).good);
  EXPECT_EQ(7, second.holding(200));
  EXPECT_EQ(0, server.holding(200));
}

// Running flag, read back and orders go over the second connection: on the first one there are images, and the one write
// of the watchdog.
TEST_F(Orders, TheFirstConnectionCarriesImagesOnly) {
  second.setHolding(300, 250);
  second.setHolding(400, 1);
  startWithDiagnosis([](ModbusSettings& settings) {
    settings.running = RunningFlag{ModbusFunction::kReadHoldingRegisters, 400, 1, 1};
    settings.watchdog = WatchdogRegister{300, 250};
  });
  ASSERT_TRUE(waitFor([&] { return link->take().number >= 20; })) << link->report().text.c_str();
  EXPECT_TRUE(link->take().bus_runs);
  EXPECT_TRUE(answerTo(readOrder(300, 1)).good);
  EXPECT_EQ(1, countOf(server.requests(), 16, 300));
  for (const Bytes& request : server.requests()) {
    const int first = request[8] << 8 | request[9];
    EXPECT_TRUE(first == 0 || first == 100 || first == 300) << first;
    EXPECT_TRUE(request[kFunctionAt] == 4 || request[kFunctionAt] == 16) << int{request[kFunctionAt]};
  }
  EXPECT_EQ(2, countOf(second.requests(), 3, 300)) << "the read back, and the order";
  EXPECT_GE(countOf(second.requests(), 3, 400), 1);
  second.setHolding(400, 0);
  EXPECT_TRUE(waitFor([&] { return !link->take().bus_runs; }));
  EXPECT_EQ(0, link->take().running);
}

TEST_F(Orders, AWatchdogTheSecondConnectionDoesNotFindKeepsTheLinkAway) {
  second.setHolding(300, 249);
  startWithDiagnosis([](ModbusSettings& settings) { settings.watchdog = WatchdogRegister{300, 250}; });
  ASSERT_TRUE(waitUntil([&] { return link->report().state == LinkState::kPausing; }));
  EXPECT_THAT(link->report().text.str(), HasSubstr("holds 249 in its watchdog register 300 after 250 was written"));
  link->give({1, 2, 3, 4});
  second.setHolding(300, 250);
  ASSERT_TRUE(waitFor([&] { return link->take().number > 0; })) << link->report().text.c_str();
}

// The images wait for the answer, and nobody else asks: not even those of a cycle, which go out behind it.
TEST_F(Orders, ARefusedReadBackIsAskedForAgain) {
  second.setHolding(300, 250);
  second.setHolding(400, 1);
  second.next({Reaction::kException, 6});
  startWithDiagnosis([](ModbusSettings& settings) {
    settings.watchdog = WatchdogRegister{300, 250};
    settings.running = RunningFlag{ModbusFunction::kReadHoldingRegisters, 400, 1, 1};
    settings.longest_pause = milliseconds{1};
  });
  ASSERT_TRUE(waitConnected()) << link->report().text.c_str();
  EXPECT_EQ(1u, link->report().counters.exceptions);
  // The same of a new connection, where the register of the watchdog is busy and nothing else is.
  second.refuse(300);
  server.next({Reaction::kClose});
  link->give({1, 2, 3, 4});
  ASSERT_TRUE(server.waitForConnections(2));
  ASSERT_TRUE(second.waitForRequests(second.requests().size() + 6))
      << "it is asked, and the register of `running` before";
  second.refuse(FakeModbusServer::kRegisters);
  ASSERT_TRUE(waitConnected()) << link->report().text.c_str();
  EXPECT_EQ(2u, server.connections());
  EXPECT_EQ(2, countOf(server.requests(), 16, 300)) << "written once over each connection";
}

// Whether the ring runs is then not known any more: the inputs grow old with it.
TEST_F(Orders, ASecondConnectionThatFailsMakesTheInputsOld) {
  second.setHolding(400, 1);
  startWithDiagnosis([](ModbusSettings& settings) {
    settings.running = RunningFlag{ModbusFunction::kReadHoldingRegisters, 400, 1, 1};
  });
  ASSERT_TRUE(waitFor([&] { return link->take().number > 0; })) << link->report().text.c_str();
  second.shut();
  ASSERT_TRUE(waitFor([&] { return link->report().counters.connect_failures > 0; }));
  const Instant asked = link->take().asked;
  const std::uint64_t number = link->take().number;
  ASSERT_TRUE(waitFor([&] { return link->take().number > number + 5; })) << "the images go on";
  EXPECT_EQ(asked, link->take().asked);
  EXPECT_THAT(link->report().text.str(), StartsWith("diagnosis: " + second.address() + " refuses the connection"));
  EXPECT_EQ(0u, link->report().counters.lost) << "of the images' connection";
  second.listenAgain();
  EXPECT_TRUE(waitFor([&] { return link->take().asked > asked; }));
}

TEST_F(Orders, OneRefusalByTheSecondConnectionCostsOneAnswer) {
  second.setHolding(400, 1);
  startWithDiagnosis([](ModbusSettings& settings) {
    settings.running = RunningFlag{ModbusFunction::kReadHoldingRegisters, 400, 1, 1};
    settings.first_pause = settings.longest_pause = 2 * kPatience;
  });
  ASSERT_TRUE(waitFor([&] { return link->take().number > 0; })) << link->report().text.c_str();
  for (unsigned i = 1; i <= 2; ++i) {
    second.next({Reaction::kException, 6});
    ASSERT_TRUE(waitFor([&] { return link->report().counters.exceptions == i; }));
    const Instant refused = link->now();
    ASSERT_TRUE(waitFor([&] { return link->take().asked > refused; }));
  }
}

// One that is silent holds up neither the images nor the end.
TEST_F(Orders, ASecondConnectionThatIsSilentHoldsNothingUp) {
  second.always({Reaction::kSilent});
  startWithDiagnosis();
  ASSERT_TRUE(waitFor([&] { return link->take().number >= 20; }));
  link->order(readOrder(1, 1));
  const std::uint64_t number = link->take().number;
  ASSERT_TRUE(waitFor([&] { return link->take().number >= number + 20; }));
  EXPECT_EQ(0u, link->answer().number);
  const Instant before = link->now();
  link->close();
  EXPECT_LT(link->now() - before, kPatience / 4);
}

// Where no register tells whether the bus runs, the second connection says nothing of it: not reached either.
TEST_F(Orders, WithoutARegisterThatTellsItTheBusRuns) {
  second.shut();
  startWithDiagnosis();
  ASSERT_TRUE(waitFor([&] { return link->take().number >= 5; }));
  EXPECT_TRUE(link->take().bus_runs);
}

/// Takes down what it hears.
class Ear final : public TelegramListener {
 public:
  struct Heard {
    bool sent;
    Bytes bytes;
    std::uint16_t first;
    std::uint32_t before;
    std::uint16_t server_port;
  };
  void handleTelegram(const HeardTelegram& telegram) noexcept override {
    const std::lock_guard<std::mutex> lock(mutex_);
    heard_.push_back({telegram.sent, Bytes(telegram.bytes.begin(), telegram.bytes.end()), telegram.first_register,
                      telegram.sent ? telegram.bytes_sent : telegram.bytes_received, telegram.server_port});
  }
  std::vector<Heard> heard() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return heard_;
  }

 private:
  std::mutex mutex_;
  std::vector<Heard> heard_;
};

TEST_F(Orders, AListenerHearsEveryTelegram) {
  Ear ear;
  ModbusSettings settings = fourWords(server.address());
  settings.listener = &ear;
  start(settings);
  ASSERT_TRUE(waitConnected());
  ASSERT_TRUE(exchange({1, 2, 3, 4}));
  link->close();
  const auto heard = ear.heard();
  ASSERT_EQ(4u, heard.size());
  EXPECT_EQ(server.requests()[0], heard[0].bytes);
  EXPECT_TRUE(heard[0].sent && !heard[1].sent && heard[2].sent && !heard[3].sent);
  EXPECT_EQ(100, heard[1].first) << "the answer to the write";
  EXPECT_EQ(0, heard[3].first);
  EXPECT_EQ(17u, heard[3].bytes.size());
  EXPECT_EQ(0u, heard[0].before);
  EXPECT_EQ(heard[0].bytes.size(), heard[2].before);
  EXPECT_EQ(heard[1].bytes.size(), heard[3].before);
  EXPECT_THAT(server.address(), HasSubstr(":" + std::to_string(heard[0].server_port)));
}

}  // namespace
}  // namespace nord_driver::link::test
