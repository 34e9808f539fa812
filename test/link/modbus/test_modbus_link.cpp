#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include "link/modbus/link_fixture.h"

namespace nord_driver::link::test {
namespace {

using Link = ModbusLinkTest;

TEST_F(Link, WritesTheOutputsAndReadsTheInputs) {
  server.setInput(0, 0x0B31);
  server.setInput(3, 0xC000);
  start();
  ASSERT_TRUE(waitConnected());
  ASSERT_TRUE(exchange({0x047F, 0x2000, 0x047E, 0x0000}));
  EXPECT_EQ(0x047F, server.holding(100));
  EXPECT_EQ(0x2000, server.holding(101));
  EXPECT_EQ(0x047E, server.holding(102));
  EXPECT_EQ((RegisterImage{0x0B31, 0, 0, 0xC000}), link->take().words);
  EXPECT_EQ(1u, link->take().number);
  EXPECT_TRUE(link->take().bus_runs);
  EXPECT_TRUE(link->report().text.empty());
}

// The output is on the wire before the inputs are asked for.
TEST_F(Link, WritesFirst) {
  start();
  ASSERT_TRUE(waitConnected());
  ASSERT_TRUE(exchange({1, 2, 3, 4}));
  const auto requests = server.requests();
  ASSERT_EQ(2u, requests.size());
  EXPECT_EQ(16, requests[0][7]);
  EXPECT_EQ(4, requests[1][7]);
}

TEST_F(Link, FunctionThreeReadsHoldingRegisters) {
  ModbusSettings settings = fourWords(server.address());
  settings.inputs.function = ModbusFunction::kReadHoldingRegisters;
  settings.inputs.address = 2048;
  server.setHolding(2049, 77);
  start(settings);
  ASSERT_TRUE(waitConnected());
  ASSERT_TRUE(exchange({1, 2, 3, 4}));
  EXPECT_EQ((RegisterImage{0, 77, 0, 0}), link->take().words);
}

TEST_F(Link, FunctionTwentyThreeDoesBothInOneRequest) {
  ModbusSettings settings = fourWords(server.address());
  settings.inputs.function = settings.outputs.function = ModbusFunction::kReadWriteRegisters;
  settings.inputs.address = 100;  // so that what was just written is read
  start(settings);
  ASSERT_TRUE(waitConnected());
  ASSERT_TRUE(exchange({1, 2, 3, 4}));
  EXPECT_EQ((RegisterImage{1, 2, 3, 4}), link->take().words);
  ASSERT_EQ(1u, server.requests().size());
  EXPECT_EQ(23, server.requests()[0][7]);
}

// Function 23 cannot read without writing: function 3 reads the same registers.
TEST_F(Link, ALookWritesNothing) {
  ModbusSettings settings = fourWords(server.address());
  settings.inputs.function = settings.outputs.function = ModbusFunction::kReadWriteRegisters;
  settings.inputs.address = 100;
  server.setHolding(101, 77);
  start(settings);
  ASSERT_TRUE(waitConnected());
  const std::uint64_t number = link->look();
  ASSERT_TRUE(waitUntil([&] { return link->take().outputs >= number; }));
  EXPECT_EQ((RegisterImage{0, 77, 0, 0}), link->take().words);
  ASSERT_EQ(1u, server.requests().size());
  EXPECT_EQ(3, server.requests()[0][7]);
  ASSERT_TRUE(exchange({1, 2, 3, 4}));
  EXPECT_EQ((RegisterImage{1, 2, 3, 4}), link->take().words);
}

TEST_F(Link, TheUnitStandsInEachRequest) {
  ModbusSettings settings = fourWords(server.address());
  settings.unit = 17;
  start(settings);
  ASSERT_TRUE(waitConnected());
  ASSERT_TRUE(exchange({1, 2, 3, 4}));
  for (const Bytes& request : server.requests()) EXPECT_EQ(17, request[6]);
}

TEST_F(Link, EveryRequestHasANumberOfItsOwn) {
  start();
  ASSERT_TRUE(waitConnected());
  ASSERT_TRUE(exchange({1, 2, 3, 4}) && exchange({1, 2, 3, 4}));
  const auto requests = server.requests();
  for (std::size_t i = 1; i < requests.size(); ++i) EXPECT_NE(requests[i - 1][1], requests[i][1]);
}

// The age counts from the request, and does not grow while an exchange is under way.
TEST_F(Link, TheInputsAreAsOldAsTheRequestForThem) {
  start();
  ASSERT_TRUE(waitConnected());
  const Instant before = link->now();
  ASSERT_TRUE(exchange({1, 2, 3, 4}));
  const Instant after = link->now();
  const RegisterInputs inputs = link->take();
  EXPECT_LE(before, inputs.asked);
  EXPECT_LE(inputs.asked, inputs.received);
  EXPECT_LE(inputs.received, after);
  EXPECT_EQ(std::chrono::microseconds{1500}, inputs.age(inputs.asked + std::chrono::microseconds{1500}));
}

TEST_F(Link, ASilentServerLeavesTheOldInputsWithTheirAge) {
  start();
  ASSERT_TRUE(waitConnected());
  ASSERT_TRUE(exchange({1, 2, 3, 4}));
  const RegisterInputs before = link->take();
  server.always({Reaction::kSilent});
  link->give({1, 2, 3, 4});
  ASSERT_TRUE(server.waitForRequests(3));
  EXPECT_EQ(before.number, link->take().number);
  EXPECT_EQ(before.asked, link->take().asked);
}

// A bus cycle that hangs must not keep the watchdog of the gateway fed.
TEST_F(Link, WithoutNewOutputsNothingIsSent) {
  start();
  ASSERT_TRUE(waitConnected());
  ASSERT_TRUE(exchange({1, 2, 3, 4}));
  EXPECT_FALSE(link->waitAnswers(link->now() + std::chrono::milliseconds{50}) && link->take().number > 1);
  EXPECT_EQ(2u, server.requests().size());
}

// The cycle is faster than the gateway: the newest outputs go out, the others are counted.
TEST_F(Link, NewerOutputsTakeThePlaceOfOlderOnes) {
  start();
  ASSERT_TRUE(waitConnected());
  server.next({Reaction::kHold});
  link->give({1, 0, 0, 0});
  ASSERT_TRUE(server.waitForRequests(1));
  link->give({2, 0, 0, 0});
  link->give({3, 0, 0, 0});
  const std::uint64_t last = link->give({4, 0, 0, 0});
  server.release();
  ASSERT_TRUE(waitUntil([&] { return link->take().outputs == last; }));
  EXPECT_EQ(4, server.holding(100));
  EXPECT_EQ(4u, server.requests().size());
  EXPECT_EQ(2u, link->report().counters.skipped_outputs);
}

// What was meant for the time before the connection may be an old command.
TEST_F(Link, OutputsFromBeforeTheConnectionAreNotSent) {
  server.shut();
  start();
  link->give({9, 9, 9, 9});
  ASSERT_TRUE(waitUntil([&] { return link->report().counters.connect_failures > 0; }));
  server.listenAgain();
  ASSERT_TRUE(waitConnected());
  ASSERT_TRUE(exchange({1, 2, 3, 4}));
  EXPECT_EQ(1, server.holding(100));
  EXPECT_EQ(2u, server.requests().size());
}

// Words before the first part are others' and stay as they are.
TEST_F(Link, OnlyThePartsAreMoved) {
  ModbusSettings settings = fourWords(server.address());
  settings.outputs.parts = {{2, 2}};
  settings.inputs.parts = {{1, 1}, {3, 1}};
  server.setHolding(100, 7777);
  for (std::size_t i = 0; i < 4; ++i) server.setInput(i, static_cast<std::uint16_t>(10 + i));
  start(settings);
  ASSERT_TRUE(waitConnected());
  ASSERT_TRUE(exchange({1, 2, 3, 4}));
  EXPECT_EQ(7777, server.holding(100));
  EXPECT_EQ(3, server.holding(102));
  EXPECT_EQ((RegisterImage{0, 11, 0, 13}), link->take().words);
}

TEST_F(Link, AnImageThatIsShorterThanItsPartsIsNotSent) {
  start();
  ASSERT_TRUE(waitConnected());
  link->give({1, 2, 3});
  ASSERT_TRUE(waitUntil([&] { return !link->report().text.empty(); }));
  EXPECT_STREQ("the output image has 3 words, expected 4", link->report().text.c_str());
  EXPECT_TRUE(server.requests().empty());
}

TEST_F(Link, ReadsWithoutWriting) {
  ModbusSettings settings = fourWords(server.address());
  settings.outputs.parts.clear();
  server.setInput(0, 5);
  start(settings);
  ASSERT_TRUE(waitConnected());
  ASSERT_TRUE(exchange({}));
  EXPECT_EQ(5, link->take().words[0]);
  EXPECT_EQ(1u, server.requests().size());
}

// --- Whether the ring runs ---

TEST_F(Link, TheRunningRegisterIsReadWithTheImage) {
  ModbusSettings settings = fourWords(server.address());
  settings.running = RunningFlag{ModbusFunction::kReadInputRegisters, 50, 0x000F, 0x0004};
  server.setInput(50, 0xFFF4);
  start(settings);
  ASSERT_TRUE(waitConnected());
  ASSERT_TRUE(exchange({1, 2, 3, 4}));
  EXPECT_TRUE(link->take().bus_runs);
  EXPECT_EQ(0xFFF4, link->take().running);
  server.setInput(50, 0xFFF5);
  ASSERT_TRUE(exchange({1, 2, 3, 4}));
  EXPECT_FALSE(link->take().bus_runs);
}

// --- The watchdog of the gateway ---

TEST_F(Link, TheWatchdogIsWrittenAndReadBackBeforeAnythingElse) {
  ModbusSettings settings = fourWords(server.address());
  settings.watchdog = WatchdogRegister{2000, 500};
  start(settings);
  ASSERT_TRUE(waitConnected());
  EXPECT_EQ(500, server.holding(2000));
  const auto requests = server.requests();
  ASSERT_EQ(2u, requests.size());
  EXPECT_EQ(16, requests[0][7]);
  EXPECT_EQ(3, requests[1][7]);
}

// What was promised to stop the drives would not: such a gateway gets no outputs.
TEST_F(Link, AWatchdogThatIsNotHeldKeepsTheLinkAway) {
  ModbusSettings settings = fourWords(server.address());
  settings.watchdog = WatchdogRegister{2000, 500};
  server.setHolding(2000, 300);
  server.protect(2000);
  start(settings);
  link->give({1, 2, 3, 4});
  ASSERT_TRUE(waitUntil([&] { return !link->report().text.empty(); }));
  EXPECT_EQ(server.address() +
                " holds 300 in its watchdog register 2000 after 500 was written there: it would not stop the drives as "
                "configured",
            link->report().text.str());
  EXPECT_EQ(0, server.holding(100));
}

TEST_F(Link, AGatewayWithoutThatWatchdogIsNamed) {
  ModbusSettings settings = fourWords(server.address());
  settings.watchdog = WatchdogRegister{5000, 500};
  start(settings);
  ASSERT_TRUE(waitUntil([&] { return !link->report().text.empty(); }));
  const std::string text = link->report().text.str();
  EXPECT_EQ(0u, text.find("the watchdog of the gateway was not set: " + server.address() +
                          " refuses function 16 (write registers 5000 to 5000) with exception 2"))
      << text;
  EXPECT_EQ(1u, server.connections());
}

TEST_F(Link, TheWatchdogIsSetOnEveryConnection) {
  ModbusSettings settings = fourWords(server.address());
  settings.watchdog = WatchdogRegister{2000, 500};
  start(settings);
  ASSERT_TRUE(waitConnected());
  server.setHolding(2000, 0);
  server.next({Reaction::kClose});
  link->give({1, 2, 3, 4});
  ASSERT_TRUE(waitUntil([&] { return link->report().counters.connections == 2; }));
  ASSERT_TRUE(waitConnected());
  EXPECT_EQ(500, server.holding(2000));
}

// --- Images longer than a request ---

TEST_F(Link, TheRequestThatStopsGoesFirst) {
  ModbusSettings settings = fourWords(server.address());
  settings.outputs.parts = {{0, 2}, {2, 2}};
  settings.control_words = {0, 2};
  settings.run_bits = 0x007F;
  start(settings);
  ASSERT_TRUE(waitConnected());
  ASSERT_TRUE(exchange({0x047F, 100, 0x047F, 100}));
  ASSERT_TRUE(exchange({0x047F, 100, 0x047E, 0}));
  const auto requests = server.requests();
  ASSERT_EQ(6u, requests.size());
  EXPECT_EQ(100, requests[0][9]);
  EXPECT_EQ(102, requests[1][9]);
  EXPECT_EQ(102, requests[3][9]);
  EXPECT_EQ(100, requests[4][9]);
}

TEST_F(Link, FunctionTwentyThreeInSeveralRequests) {
  ModbusSettings settings = fourWords(server.address());
  settings.inputs.function = settings.outputs.function = ModbusFunction::kReadWriteRegisters;
  settings.outputs.parts = {{0, 121}};
  settings.inputs.address = 100;
  settings.inputs.parts = {{0, 125}, {125, 75}};
  server.setHolding(299, 1234);
  start(settings);
  ASSERT_TRUE(waitConnected());
  RegisterImage outputs;
  outputs.resize(121);
  outputs[120] = 99;
  ASSERT_TRUE(exchange(outputs));
  EXPECT_EQ(2u, server.requests().size());
  ASSERT_EQ(200u, link->take().words.size());
  EXPECT_EQ(99, link->take().words[120]);
  EXPECT_EQ(1234, link->take().words[199]);
}

// --- Life ---

TEST_F(Link, SettingsThatCannotBeAreNotOpened) {
  ModbusSettings settings = fourWords(server.address());
  settings.outputs.function = ModbusFunction::kReadWriteRegisters;
  link = std::make_unique<ModbusLink>(settings);
  EXPECT_FALSE(link->open());
  EXPECT_NE(std::string::npos, link->report().text.str().find("outputs/function: 23"));
}

TEST_F(Link, CanBeOpenedAgain) {
  start();
  ASSERT_TRUE(waitConnected());
  link->close();
  EXPECT_EQ(LinkState::kClosed, link->report().state);
  ASSERT_TRUE(link->open());
  ASSERT_TRUE(waitConnected());
  ASSERT_TRUE(exchange({1, 2, 3, 4}));
}

// Whoever waits for an answer of up to 20 s is not waited for.
TEST_F(Link, EndsWhileItWaitsForAnAnswer) {
  start();
  ASSERT_TRUE(waitConnected());
  server.always({Reaction::kSilent});
  link->give({1, 2, 3, 4});
  ASSERT_TRUE(server.waitForRequests(1));
  const Instant before = link->now();
  link->close();
  EXPECT_LT(link->now() - before, kPatience / 4);
}

}  // namespace
}  // namespace nord_driver::link::test
