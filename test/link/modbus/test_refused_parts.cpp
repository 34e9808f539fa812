// An output image of two requests, one of which the server refuses in due form.
#include <algorithm>

#include "link/modbus/link_fixture.h"

namespace nord_driver::link::test {
namespace {

using std::chrono::milliseconds;

constexpr Word kRuns = 0x047F, kDownTheRamp = 0x047E, kQuickStop = 0x047B;
constexpr std::size_t kLeft = 100, kRight = 102;  // registers of the control words

class RefusedParts : public ModbusLinkTest {
 protected:
  void startInParts(ModbusFunction function, const std::function<void(ModbusSettings&)>& change = {}) {
    ModbusSettings settings = fourWords(server.address());
    settings.outputs.function = function;
    if (function == ModbusFunction::kReadWriteRegisters) settings.inputs.function = function;
    settings.inputs.parts = settings.outputs.parts = {{0, 2}, {2, 2}};
    settings.control_words = {0, 2};
    settings.run_bits = 0x007F;
    settings.first_pause = settings.longest_pause = milliseconds{1};
    if (change) change(settings);
    start(settings);
    ASSERT_TRUE(waitConnected()) << link->report().text.c_str();
    ASSERT_TRUE(exchange({kRuns, 7, kRuns, 7}));
  }
  bool giveUntilRefused(const RegisterImage& outputs, std::uint64_t times = 1) {
    const std::uint64_t exceptions = link->report().counters.exceptions;
    link->give(outputs);
    return waitUntil([&] { return link->report().counters.exceptions >= exceptions + times; });
  }
  /// How many requests have written this register.
  long written(std::size_t address) const {
    const auto requests = server.requests();
    return std::count_if(requests.begin(), requests.end(), [&](const Bytes& request) {
      const std::size_t at = request[7] == 23 ? 12 : 8;
      return (request[7] == 23 || request[7] == 16) &&
             (request[at] << 8 | request[at + 1]) == static_cast<int>(address);
    });
  }
};

class BothFunctions : public RefusedParts, public ::testing::WithParamInterface<ModbusFunction> {};

TEST_P(BothFunctions, TheOtherDriveIsStopped) {
  startInParts(GetParam());
  const std::uint64_t number = link->take().number;
  server.refuse(kLeft);
  ASSERT_TRUE(giveUntilRefused({kDownTheRamp, 0, kDownTheRamp, 0}));
  EXPECT_EQ(kRuns, server.holding(kLeft));
  EXPECT_EQ(kDownTheRamp, server.holding(kRight));
  EXPECT_EQ(1u, link->report().counters.exceptions);
  EXPECT_NE(std::string::npos, link->report().text.str().find("write registers 100 to 101"))
      << link->report().text.c_str();
  EXPECT_EQ(number, link->take().number) << "inputs of an exchange that was refused";
  // From the ramp to the quick stop is a stop, too.
  ASSERT_TRUE(giveUntilRefused({kQuickStop, 0, kQuickStop, 0}));
  EXPECT_EQ(kQuickStop, server.holding(kRight));
  // With the cause gone both hear their words, over the same connection.
  server.refuse(FakeModbusServer::kRegisters);
  ASSERT_TRUE(waitConnected());
  EXPECT_TRUE(exchange({kQuickStop, 0, kQuickStop, 0}));
  EXPECT_EQ(kQuickStop, server.holding(kLeft));
  EXPECT_EQ(1u, server.connections());
}

// The server's watchdog stops the drive whose registers are refused, when nothing is written any more.
TEST_P(BothFunctions, WhatStopsNobodyDoesNotFeedTheWatchdog) {
  startInParts(GetParam());
  server.refuse(kLeft);
  const long before = written(kRight);
  ASSERT_TRUE(giveUntilRefused({kRuns, 8, kRuns, 8}));
  EXPECT_EQ(before, written(kRight));
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(giveUntilRefused({kDownTheRamp, 0, kDownTheRamp, 0}));
  EXPECT_EQ(kDownTheRamp, server.holding(kRight));
  EXPECT_EQ(before + 1, written(kRight));
}

TEST_P(BothFunctions, EachRefusalCounts) {
  startInParts(GetParam());
  server.always({Reaction::kException, 2});
  ASSERT_TRUE(giveUntilRefused({kDownTheRamp, 0, kDownTheRamp, 0}));
  EXPECT_EQ(2u, link->report().counters.exceptions);
  EXPECT_EQ(1u, link->report().counters.refused_exchanges);
}

INSTANTIATE_TEST_SUITE_P(RefusedParts, BothFunctions,
                         ::testing::Values(ModbusFunction::kWriteRegisters, ModbusFunction::kReadWriteRegisters));

// The refusal counts, and the connection is gone all the same.
TEST_F(RefusedParts, AConnectionThatEndsBehindARefusalIsMadeAgain) {
  startInParts(ModbusFunction::kWriteRegisters);
  server.next({Reaction::kException, 2});
  server.next({Reaction::kClose});
  link->give({kDownTheRamp, 0, kDownTheRamp, 0});
  ASSERT_TRUE(server.waitForConnections(2));
  ASSERT_TRUE(waitConnected());
  EXPECT_EQ(1u, link->report().counters.exceptions);
  EXPECT_EQ(1u, link->report().counters.closed);
}

// On a new connection, before its watchdog is set, too.
TEST_F(RefusedParts, NorDoesAStopOnANewConnectionWaitForTheOtherPart) {
  constexpr std::uint16_t kWatchdog = 300;
  startInParts(ModbusFunction::kWriteRegisters, [&](ModbusSettings& settings) {
    settings.watchdog = WatchdogRegister{kWatchdog, 500};
  });
  server.shut();
  link->give({kRuns, 8, kRuns, 8});
  ASSERT_TRUE(waitUntil([&] { return link->report().counters.closed == 1; }));
  server.refuse(kLeft);
  link->give({kDownTheRamp, 0, kDownTheRamp, 0});
  server.listenAgain();
  ASSERT_TRUE(waitConnected()) << link->report().text.c_str();
  EXPECT_EQ(kDownTheRamp, server.holding(kRight));
  EXPECT_EQ(kRuns, server.holding(kLeft));
  EXPECT_EQ(2u, server.connections());
}

}  // namespace
}  // namespace nord_driver::link::test
