// A server that has gone mad, over the loopback: whatever it sends, inputs are either those it meant or none.
#include <random>

#include "link/modbus/link_fixture.h"

namespace nord_driver::link::test {
namespace {

// Input register i of the server, so that what was not meant is seen.
std::uint16_t meant(std::size_t i) {
  return static_cast<std::uint16_t>(0xA500 + i);
}

Reaction garbled(std::mt19937& random) {
  const auto below = [&](unsigned limit) { return static_cast<std::uint16_t>(random() % limit); };
  switch (below(10)) {
    case 0:
      return {Reaction::kPart, below(13)};
    case 1:
      return {Reaction::kTransaction, static_cast<std::uint16_t>(1 + below(255))};
    case 2:
      return {Reaction::kUnit, static_cast<std::uint16_t>(2 + below(250))};
    case 3:
      return {Reaction::kFunction, static_cast<std::uint16_t>(24 + below(100))};
    case 4:
      return {Reaction::kLength, static_cast<std::uint16_t>(1 + below(200))};
    case 5:
      return {Reaction::kTwice};
    case 6:
      return {Reaction::kClose};
    case 7:
      return {Reaction::kReset};
    case 8:
      return {Reaction::kException, below(256)};
    default: {
      Reaction raw{Reaction::kRaw};
      raw.bytes.resize(1 + below(600));
      for (auto& byte : raw.bytes) byte = static_cast<std::uint8_t>(below(256));
      if (raw.bytes.size() > 7 && below(2) == 0) {  // at least the looks of an answer
        raw.bytes[2] = raw.bytes[3] = raw.bytes[4] = 0;
        raw.bytes[6] = 1;
        raw.bytes[7] = 4;
      }
      return raw;
    }
  }
}

class GarbledAnswers : public ModbusLinkTest, public ::testing::WithParamInterface<unsigned> {};

TEST_P(GarbledAnswers, NoneIsTakenForInputs) {
  std::mt19937 random{GetParam()};
  ModbusSettings settings = fourWords(server.address());
  settings.response_timeout = std::chrono::milliseconds{20};
  settings.first_pause = settings.longest_pause = std::chrono::milliseconds{1};
  for (std::size_t i = 0; i < 4; ++i) server.setInput(i, meant(i));
  start(settings);
  for (int round = 0; round < 40; ++round) {
    // Good answers to some requests, then a garbled one.
    for (auto good = random() % 3; good > 0; --good) server.next({Reaction::kAnswer});
    server.next(garbled(random));
    const std::uint64_t number = link->take().number;
    ASSERT_TRUE(waitUntil([&] {
      if (link->report().state == LinkState::kConnected) link->give({1, 2, 3, 4});
      const RegisterInputs& inputs = link->take();
      for (std::size_t i = 0; i < inputs.words.size(); ++i) EXPECT_EQ(meant(i), inputs.words[i]);
      return inputs.number > number + 2;
    })) << link->report().text.c_str();
  }
  const LinkCounters& counters = link->report().counters;
  const std::uint64_t failures = counters.closed + counters.timeouts + counters.partial + counters.unasked +
                                 counters.bad_answers + counters.exceptions;
  EXPECT_GE(failures, 30u);
}

INSTANTIATE_TEST_SUITE_P(Seeds, GarbledAnswers, ::testing::Values(1u, 2u, 3u));

}  // namespace
}  // namespace nord_driver::link::test
