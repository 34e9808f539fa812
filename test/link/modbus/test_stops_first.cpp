#include <gtest/gtest.h>

#include "link/modbus/modbus_exchange.h"

namespace nord_driver::link {
namespace {

// Three parts of two drives each; a drive is a control word and a setpoint.
ModbusSettings sixDrives() {
  ModbusSettings settings;
  settings.outputs.parts = {{0, 4}, {4, 4}, {8, 4}};
  settings.control_words = {0, 2, 4, 6, 8, 10};
  settings.run_bits = 0x007F;
  return settings;
}

RegisterImage all(Word control_word) {
  RegisterImage image;
  for (int i = 0; i < 6; ++i) {
    image.push_back(control_word);
    image.push_back(0x2000);
  }
  return image;
}

TEST(StopsFirst, WithoutAStopTheOrderIsThatOfTheParts) {
  EXPECT_EQ((PartOrder{0, 1, 2}), stopsFirst(sixDrives(), all(0x047F), all(0x047F)));
  EXPECT_EQ((PartOrder{0, 1, 2}), stopsFirst(sixDrives(), all(0x047E), all(0x047F)));
  EXPECT_EQ((PartOrder{0, 1, 2}), stopsFirst(sixDrives(), all(0x047E), all(0x047E)));
}

TEST(StopsFirst, EveryStopWordCounts) {
  for (const Word stop : std::initializer_list<Word>{0x047E, 0x047B, 0x047D, 0x046F, 0x007E}) {
    RegisterImage next = all(0x047F);
    next[10] = stop;
    EXPECT_EQ((PartOrder{2, 0, 1}), stopsFirst(sixDrives(), all(0x047F), next)) << stop;
  }
}

// Its bit 10 says "no valid data" (BU 2700 7.1.1).
TEST(StopsFirst, AWordThatIsIgnoredIsNoStop) {
  RegisterImage next = all(0x047F);
  next[10] = 0x0000;
  EXPECT_EQ((PartOrder{0, 1, 2}), stopsFirst(sixDrives(), all(0x047F), next));
}

TEST(StopsFirst, ThePartWithMoreStopsComesBeforeTheOther) {
  RegisterImage next = all(0x047F);
  next[0] = 0x047E;
  next[8] = next[10] = 0x047E;
  EXPECT_EQ((PartOrder{2, 0, 1}), stopsFirst(sixDrives(), all(0x047F), next));
}

// One that stood before does not stop.
TEST(StopsFirst, AStandingDriveDoesNotHurry) {
  RegisterImage before = all(0x047F), next = all(0x047F);
  before[0] = next[0] = 0x047E;
  next[4] = 0x047E;
  EXPECT_EQ((PartOrder{1, 0, 2}), stopsFirst(sixDrives(), before, next));
}

// Down the ramp it turns still.
TEST(StopsFirst, AQuickStopBehindTheRampIsAStop) {
  RegisterImage next = all(0x047E);
  next[8] = 0x047B;
  EXPECT_EQ((PartOrder{2, 0, 1}), stopsFirst(sixDrives(), all(0x047E), next));
}

// Nobody knows yet what the drives have been told.
TEST(StopsFirst, TheFirstImageHasTheOrderOfTheParts) {
  EXPECT_EQ((PartOrder{0, 1, 2}), stopsFirst(sixDrives(), {}, all(0x047E)));
}

TEST(StopsFirst, SwappedBytesAreLookedAtAsTheyLie) {
  ModbusSettings settings = sixDrives();
  settings.run_bits = 0x7F00;
  RegisterImage next = all(0x7F04);
  next[4] = 0x7E04;
  EXPECT_EQ((PartOrder{1, 0, 2}), stopsFirst(settings, all(0x7F04), next));
}

}  // namespace
}  // namespace nord_driver::link
