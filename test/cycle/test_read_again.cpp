// What a device told once is asked for again when somebody has written it.
#include <gtest/gtest.h>

#include "cycle/device_reader.h"

namespace nord_driver::cycle {
namespace {

profile::ParameterResult done(std::int32_t raw) {
  profile::ParameterResult result;
  result.outcome = profile::ParameterOutcome::kDone;
  result.raw = raw;
  return result;
}

// An answer that was under way when it was written may be the one of before.
TEST(ReadAgain, WhatWasWrittenIs) {
  DeviceReader reader{profile::Series::kSk5xxe};
  while (reader.pollRequest()) reader.handleResult(done(5));
  ASSERT_TRUE(reader.data().complete);
  reader.askAgain(513);
  EXPECT_TRUE(reader.data().complete && reader.motionKnown());
  auto request = reader.pollRequest();
  ASSERT_TRUE(request);
  EXPECT_EQ(513, request->number);
  reader.askAgain(513);
  reader.handleResult(done(7));
  EXPECT_DOUBLE_EQ(0.5, reader.data().telegram_timeout.value()) << "of before";
  request = reader.pollRequest();
  ASSERT_TRUE(request);
  EXPECT_EQ(513, request->number);
  reader.handleResult(done(9));
  EXPECT_DOUBLE_EQ(0.9, reader.data().telegram_timeout.value());
  EXPECT_FALSE(reader.pollRequest());
  EXPECT_TRUE(reader.data().saves_in_eeprom.has_value());
  reader.askAgain(560);
  EXPECT_FALSE(reader.data().saves_in_eeprom.has_value());
  request = reader.pollRequest();
  ASSERT_TRUE(request);
  EXPECT_EQ(560, request->number);
  reader.handleResult(done(1));
  EXPECT_FALSE(reader.pollRequest());
  EXPECT_TRUE(reader.data().saves_in_eeprom.value());
}

}  // namespace
}  // namespace nord_driver::cycle
