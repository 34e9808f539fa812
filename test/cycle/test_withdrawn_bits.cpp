// What a stop takes away from whoever commands a signal that may move a drive.
#include <gtest/gtest.h>

#include "cycle/withdrawn_bits.h"

namespace nord_driver::cycle {
namespace {

constexpr Instant kStart{std::chrono::hours{1}};
constexpr Duration kCycle = std::chrono::milliseconds{10};

// The first "on" after a stop is an order for afterwards where the signal was off all the time.
TEST(WithdrawnBitsTest, AStopTakesNothingFromASignalThatIsOff) {
  WithdrawnBits bits{1};
  WordCommands commands;
  commands.outputs[0] = {false, kStart, true, kStart};
  WithdrawnBits::State state;
  state.stopping = true;
  bits.update(state, commands, kStart + kCycle);
  state.stopping = false;
  commands.outputs[0] = {true, kStart + 2 * kCycle, true, kStart};
  bits.update(state, commands, kStart + 2 * kCycle);
  EXPECT_FALSE(bits.has(0, false));
}

TEST(WithdrawnBitsTest, AStopTakesASignalThatIsOnUntilItWasOff) {
  WithdrawnBits bits{1};
  WordCommands commands;
  commands.outputs[0] = {true, kStart, true};
  WithdrawnBits::State state;
  state.stopping = true;
  bits.update(state, commands, kStart + kCycle);
  state.stopping = false;
  bits.update(state, commands, kStart + 2 * kCycle);
  EXPECT_TRUE(bits.has(0, false));
  commands.outputs[0].off = kStart + 3 * kCycle;
  bits.update(state, commands, kStart + 3 * kCycle);
  EXPECT_FALSE(bits.has(0, false));
}

// Whether it may end the stop is asked when that is known: here after the stop has ended.
TEST(WithdrawnBitsTest, AnOffWhileAStopStandsCountsForWhatMayEndItOnly) {
  WithdrawnBits bits{1};
  WordCommands commands;
  commands.outputs[0] = {true, kStart, true};
  WithdrawnBits::State state;
  state.stops = 1;
  state.stands = true;
  bits.update(state, commands, kStart + kCycle);
  EXPECT_TRUE(bits.has(0, true));
  EXPECT_TRUE(bits.has(0, false));
  commands.outputs[0].off = kStart + 2 * kCycle;
  bits.update(state, commands, kStart + 2 * kCycle);
  state.stands = false;
  bits.update(state, commands, kStart + 3 * kCycle);
  EXPECT_FALSE(bits.has(0, true));
  EXPECT_TRUE(bits.has(0, false));
}

}  // namespace
}  // namespace nord_driver::cycle
