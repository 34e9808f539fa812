// Everything a server, or the network before it, can do wrong: named, and never taken for fresh inputs.
#include <sys/socket.h>

#include "link/modbus/link_fixture.h"

namespace nord_driver::link::test {
namespace {

using std::chrono::milliseconds;

class LinkFailures : public ModbusLinkTest {
 protected:
  /// Long enough for an answer of the fake server where the test needs one, even if the machine is loaded.
  ModbusSettings quick(milliseconds response_timeout = milliseconds{40}) {
    ModbusSettings settings = fourWords(server.address());
    settings.response_timeout = response_timeout;
    return settings;
  }
  /// With the cause gone the link comes back by itself, and only now has inputs.
  void expectComesBack() {
    EXPECT_EQ(0u, link->take().number);
    server.always({Reaction::kAnswer});
    server.setInput(0, 0x0B31);
    ASSERT_TRUE(waitUntil([&] {
      if (link->report().state == LinkState::kConnected) link->give({1, 2, 3, 4});
      return link->take().number > 0;
    }));
    EXPECT_EQ(0x0B31, link->take().words[0]);
    EXPECT_TRUE(link->report().text.empty()) << link->report().text.c_str();
  }
};

TEST_F(LinkFailures, Refused) {
  server.shut();
  start();
  ASSERT_TRUE(waitUntil([&] { return link->report().state == LinkState::kPausing; }));
  EXPECT_EQ(server.address() + " refuses the connection: is its Modbus/TCP server switched on, and is this its port?",
            link->report().text.str());
  EXPECT_EQ(1u, link->report().counters.connect_failures);
  EXPECT_EQ(1u, link->report().counters.lost);
  server.listenAgain();
  expectComesBack();
}

TEST_F(LinkFailures, NeverAnswers) {
  server.always({Reaction::kSilent});
  start(quick());
  EXPECT_EQ(
      "accepts the connection, but has never answered on it (function 16 (write registers 100 to 103), 0.040 s): is it "
      "a Modbus/TCP server, and is another client connected?",
      trouble());
  EXPECT_EQ(1u, link->report().counters.timeouts);
  EXPECT_EQ(0u, link->report().counters.late);
  expectComesBack();
}

TEST_F(LinkFailures, AnswersNoMore) {
  start(quick(milliseconds{500}));
  server.next({Reaction::kAnswer});
  server.next({Reaction::kSilent});
  EXPECT_EQ("has not answered function 4 (read registers 0 to 3) within 0.500 s", trouble());
  expectComesBack();
}

// The late answer is told from none, and is not used: the connection it came on is given up.
TEST_F(LinkFailures, AnswersLate) {
  ModbusSettings settings = quick();
  settings.first_pause = settings.longest_pause = kPatience;
  start(settings);
  server.next({Reaction::kHold});
  trouble();
  server.release();
  ASSERT_TRUE(waitUntil([&] { return link->report().counters.late == 1; }));
  const std::string text = link->report().text.str();
  EXPECT_NE(std::string::npos, text.find(" after the request, too late for the response time-out of 0.040 s")) << text;
  EXPECT_EQ(0u, link->take().number);
}

TEST_F(LinkFailures, AnswersInPart) {
  server.always({Reaction::kPart, 9});
  start(quick(milliseconds{500}));
  EXPECT_EQ("has answered function 16 (write registers 100 to 103) only in part within 0.500 s", trouble());
  EXPECT_EQ(1u, link->report().counters.partial);
  expectComesBack();
}

TEST_F(LinkFailures, AnswersAnotherTransaction) {
  server.always({Reaction::kTransaction, 1});
  start();
  EXPECT_EQ("answers transaction 2, expected 1: an answer to another request", trouble());
  EXPECT_EQ(1u, link->report().counters.bad_answers);
  EXPECT_EQ(0u, link->report().counters.lost) << "it was given up here";
  expectComesBack();
}

TEST_F(LinkFailures, AnswersAsAnotherUnit) {
  server.always({Reaction::kUnit, 9});
  start();
  EXPECT_EQ("answers as unit 9, expected 1", trouble());
  expectComesBack();
}

TEST_F(LinkFailures, IsNoModbusServer) {
  server.always({Reaction::kRaw, 0, {'H', 'T', 'T', 'P', '/', '1', '.', '1', ' ', '4', '0', '0'}});
  start();
  EXPECT_EQ("answers with protocol 21584, expected 0: this is no Modbus/TCP server", trouble());
  expectComesBack();
}

TEST_F(LinkFailures, AnswersWithAnotherFunction) {
  server.next({Reaction::kAnswer});
  server.next({Reaction::kFunction, 3});
  start();
  EXPECT_EQ("answers function 4 (read registers 0 to 3) with function 3", trouble());
  expectComesBack();
}

TEST_F(LinkFailures, AnswersWithAnotherLengthThanItSays) {
  server.next({Reaction::kAnswer});
  server.next({Reaction::kLength, 4});
  start();
  EXPECT_EQ("answers function 4 (read registers 0 to 3) with 17 bytes, expected 21", trouble());
  expectComesBack();
}

// An answer behind an answer would be taken for the next one's.
TEST_F(LinkFailures, AnswersTwice) {
  server.next({Reaction::kTwice});
  start();
  EXPECT_EQ("sent 12 bytes nobody asked for: an answer twice or too late", trouble());
  EXPECT_EQ(1u, link->report().counters.unasked);
  expectComesBack();
}

// The connection is kept: a gateway may have no room for a second one.
TEST_F(LinkFailures, RefusesWithAnException) {
  server.always({Reaction::kException, 2});
  start();
  ASSERT_TRUE(waitConnected());
  link->give({1, 2, 3, 4});
  ASSERT_TRUE(waitUntil([&] { return link->report().counters.exceptions == 1; }));
  EXPECT_EQ(
      "refuses function 16 (write registers 100 to 103) with exception 2, illegal data address: it has no such "
      "registers, look at address and length of the image",
      trouble());
  EXPECT_EQ(2u, link->report().counters.exceptions);
  ASSERT_TRUE(waitConnected());
  EXPECT_FALSE(link->report().text.empty());
  server.always({Reaction::kAnswer});
  ASSERT_TRUE(exchange({1, 2, 3, 4}));
  EXPECT_TRUE(link->report().text.empty());
  EXPECT_EQ(1u, server.connections());
}

// "Busy, ask later" is no reason to have the drives wait for their words; a second one in a row is.
TEST_F(LinkFailures, OneExceptionCostsOneExchange) {
  ModbusSettings settings = fourWords(server.address());
  settings.first_pause = settings.longest_pause = 2 * kPatience;
  start(settings);
  ASSERT_TRUE(waitConnected());
  for (int i = 0; i < 3; ++i) {
    server.next({Reaction::kException, 6});
    link->give({1, 2, 3, 4});
    ASSERT_TRUE(waitUntil([&] { return link->report().counters.exceptions == static_cast<unsigned>(i) + 1; }));
    ASSERT_TRUE(exchange({1, 2, 3, 4}));
    EXPECT_TRUE(link->report().text.empty());
  }
  server.always({Reaction::kException, 6});
  link->give({1, 2, 3, 4});
  ASSERT_TRUE(waitUntil([&] { return link->report().counters.exceptions == 4; }));
  EXPECT_EQ(0u, trouble().find("refuses function 16")) << "pauses";
}

// Who only reads has to know what of it was refused.
TEST_F(LinkFailures, ARefusedExchangeIsToldFromARefusedWatchdog) {
  ModbusSettings settings = fourWords(server.address());
  settings.watchdog = WatchdogRegister{300, 500};
  settings.first_pause = settings.longest_pause = milliseconds{1};
  server.next({Reaction::kException, 6});
  server.next({Reaction::kException, 6});
  start(settings);
  ASSERT_TRUE(waitConnected()) << link->report().text.c_str();
  EXPECT_EQ(2u, link->report().counters.exceptions);
  EXPECT_EQ(0u, link->report().counters.refused_exchanges);
  const auto lookAt = [&](std::uint8_t exception) {
    const std::uint64_t before = link->report().counters.exceptions;
    server.next({Reaction::kException, exception});
    link->look();
    return waitUntil([&] { return link->report().counters.exceptions == before + 1; });
  };
  ASSERT_TRUE(lookAt(6));
  EXPECT_EQ(0u, link->report().counters.refused_exchanges) << "busy: it may be read later";
  ASSERT_TRUE(lookAt(1));
  EXPECT_EQ(1u, link->report().counters.refused_exchanges);
}

// A gateway that refuses to be read takes words all the same: the one that stops does not wait for the end of a pause.
TEST_F(LinkFailures, AWordThatStopsEndsThePauseOfAConnectionThatIsKept) {
  ModbusSettings settings = fourWords(server.address());
  settings.control_words = {0};
  settings.run_bits = 0x007F;
  settings.first_pause = settings.longest_pause = 2 * kPatience;
  start(settings);
  ASSERT_TRUE(waitConnected());
  ASSERT_TRUE(exchange({0x047F, 2, 3, 4}));
  for (unsigned i = 1; i <= 2; ++i) {
    server.next({Reaction::kAnswer});  // the write
    server.next({Reaction::kException, 6});
    link->give({0x047F, 5, 3, 4});
    ASSERT_TRUE(waitUntil([&] { return link->report().counters.exceptions == i; }));
  }
  ASSERT_TRUE(waitUntil([&] { return link->report().state == LinkState::kPausing; }));
  link->give({0x047F, 6, 3, 4});
  EXPECT_TRUE(exchange({0x047E, 0, 3, 4}));
  EXPECT_EQ(0x047E, server.holding(100));
  EXPECT_EQ(1u, server.connections());
}

TEST_F(LinkFailures, ClosesTheConnection) {
  start();
  server.next({Reaction::kClose});
  EXPECT_EQ(
      "has closed the connection instead of answering function 16 (write registers 100 to 103) (Connection reset by "
      "peer)",
      trouble());
  EXPECT_EQ(1u, link->report().counters.closed);
  expectComesBack();
}

TEST_F(LinkFailures, ResetsTheConnection) {
  start();
  server.next({Reaction::kReset});
  EXPECT_EQ(0u, trouble().find("has closed the connection instead of answering"));
  EXPECT_EQ(1u, link->report().counters.lost);
  expectComesBack();
}

// Between two requests.
TEST_F(LinkFailures, IsSwitchedOffAndOn) {
  start();
  ASSERT_TRUE(waitConnected());
  server.waitForConnections(1);
  server.shut();
  EXPECT_EQ(0u, trouble().find("has closed the connection"));
  server.listenAgain();
  expectComesBack();
}

TEST_F(LinkFailures, FailsInTheMiddleOfAnExchange) {
  start();
  server.next({Reaction::kAnswer});
  server.next({Reaction::kClose});
  trouble();
  expectComesBack();
}

TEST_F(LinkFailures, AnUnknownHostIsNamed) {
  ModbusSettings settings = fourWords("no-such-gateway");
  link = std::make_unique<ModbusLink>(settings,
                                      [](const char*, const char*, const addrinfo*, addrinfo**) { return EAI_NONAME; });
  ASSERT_TRUE(link->open());
  ASSERT_TRUE(waitUntil([&] { return link->report().state == LinkState::kPausing; }));
  EXPECT_STREQ("the host name no-such-gateway is not known here (Name or service not known)",
               link->report().text.c_str());
}

// The pauses grow to the longest and are short again after a good exchange.
TEST_F(LinkFailures, ManyFailuresDoNotFloodTheServer) {
  ModbusSettings settings = fourWords(server.address());
  settings.first_pause = milliseconds{1};
  settings.longest_pause = milliseconds{64};
  server.shut();
  const Instant before = std::chrono::steady_clock::now();
  start(settings);
  ASSERT_TRUE(waitUntil([&] { return link->report().counters.connect_failures >= 9; }));
  EXPECT_GE(link->now() - before, milliseconds{1 + 2 + 4 + 8 + 16 + 32 + 64 + 64});
  server.listenAgain();
  expectComesBack();
}

}  // namespace
}  // namespace nord_driver::link::test
