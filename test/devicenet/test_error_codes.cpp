#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "devicenet/connect_requests.h"
#include "devicenet/error_codes.h"
#include "devicenet/explicit_message.h"

namespace nord_driver::devicenet {
namespace {

// Facts 3.3: every code that is known says something of its own.
TEST(ErrorCodes, EachHasASentence) {
  std::set<std::string> texts;
  for (unsigned code = 0; code <= 0x2A; ++code) {
    const char* meaning = generalErrorMeaning(static_cast<std::uint8_t>(code));
    ASSERT_NE(nullptr, meaning) << code;
    EXPECT_TRUE(texts.insert(meaning).second) << meaning;
  }
  for (std::uint8_t code = 1; code <= 4; ++code) {
    const char* meaning = additionalErrorMeaning(service::kAllocate, code);
    ASSERT_NE(nullptr, meaning);
    EXPECT_STREQ(meaning, additionalErrorMeaning(service::kRelease, code));
    EXPECT_TRUE(texts.insert(meaning).second) << meaning;
  }
  EXPECT_EQ(nullptr, generalErrorMeaning(0x2B));
  EXPECT_EQ(nullptr, additionalErrorMeaning(service::kGetAttributeSingle, 1));
}

// The table of facts 3.3, each code by its own words: a row that slipped would tell something else.
TEST(ErrorCodes, SayWhatTheyAre) {
  const struct {
    std::uint8_t code;
    const char* words;
  } kTable[] = {{0x02, "resource"},
                {0x08, "service is not supported"},
                {0x09, "value of the attribute is invalid"},
                {0x0B, "in that state already"},
                {0x0C, "object cannot do that in its present state"},
                {0x0E, "cannot be set"},
                {0x0F, "privilege"},
                {0x10, "device cannot do that in its present state"},
                {0x11, "reply is too large"},
                {0x13, "not enough data"},
                {0x14, "attribute is not supported"},
                {0x15, "too much data"},
                {0x16, "object does not exist"},
                {0x19, "store operation"},
                {0x1F, "manufacturer"},
                {0x20, "parameter of the request is invalid"},
                {0x2A, "Group-2-only"}};
  for (const auto& row : kTable) {
    EXPECT_THAT(generalErrorMeaning(row.code), testing::HasSubstr(row.words)) << unsigned{row.code};
    EXPECT_THAT(errorText(service::kGetAttributeSingle, row.code, kNoAdditionalCode).c_str(),
                testing::HasSubstr(row.words));
  }
  const char* const kAllocate[] = {"allocated already", "does not have these connections", "only allocate and release",
                                   "no room"};
  for (std::uint8_t code = 1; code <= 4; ++code) {
    EXPECT_THAT(errorText(service::kAllocate, 0x02, code).c_str(), testing::HasSubstr(kAllocate[code - 1]));
  }
}

TEST(ErrorCodes, Sentences) {
  EXPECT_STREQ("refuses: the attribute is not supported (14h)",
               errorText(service::kGetAttributeSingle, 0x14, 0xFF).c_str());
  EXPECT_STREQ(
      "refuses: a resource that is needed is unavailable (02h): allocation conflict, it is allocated already "
      "(additional code 01h)",
      errorText(service::kAllocate, 0x02, 0x01).c_str());
  EXPECT_STREQ("refuses: an error of the manufacturer's own (1Fh), additional code 05h",
               errorText(service::kSetAttributeSingle, 0x1F, 0x05).c_str());
  EXPECT_STREQ("refuses: an error code that is reserved (C3h)", errorText(0x10, 0xC3, 0xFF).c_str());
}

TEST(ErrorCodes, OfEveryEnd) {
  std::set<std::string> texts;
  for (const ExplicitEnd end : {ExplicitEnd::kDone, ExplicitEnd::kRefused, ExplicitEnd::kTimedOut,
                                ExplicitEnd::kTooLong, ExplicitEnd::kNotConnected}) {
    ExplicitAnswer answer;
    answer.end = end;
    EXPECT_TRUE(texts.insert(explicitText(answer, service::kGetAttributeSingle).str()).second);
  }
}

// Class 5, attribute 1.
TEST(ErrorCodes, StatesOfAConnection) {
  const char* const texts[] = {"nonexistent", "configuring", "waiting for its identifier",
                               "established", "timed out",   "deferred for deletion",
                               "unknown"};
  for (std::uint8_t state = 0; state < 7; ++state) EXPECT_STREQ(texts[state], connectionStateText(state));
  EXPECT_STREQ("unknown", connectionStateText(0xFF));
}

// One byte that is a state, or that there is no such object: nothing else tells that a connection is lost.
TEST(ErrorCodes, WhatSaysThatAConnectionIsLost) {
  const auto says = [](ExplicitEnd end, std::uint8_t general, const ExplicitData& data) {
    ExplicitAnswer answer;
    answer.end = end;
    answer.general = general;
    answer.data = data;
    return lostStateText(answer);
  };
  EXPECT_STREQ("nonexistent", says(ExplicitEnd::kDone, 0, {0}));
  EXPECT_STREQ("timed out", says(ExplicitEnd::kDone, 0, {4}));
  EXPECT_STREQ("deferred for deletion", says(ExplicitEnd::kDone, 0, {5}));
  EXPECT_STREQ("gone", says(ExplicitEnd::kRefused, 0x16, {}));
  EXPECT_EQ(nullptr, says(ExplicitEnd::kDone, 0, {3}));
  EXPECT_EQ(nullptr, says(ExplicitEnd::kDone, 0, {6}));
  EXPECT_EQ(nullptr, says(ExplicitEnd::kDone, 0, {}));
  EXPECT_EQ(nullptr, says(ExplicitEnd::kDone, 0, {4, 0}));
  EXPECT_EQ(nullptr, says(ExplicitEnd::kRefused, 0x14, {}));
  EXPECT_EQ(nullptr, says(ExplicitEnd::kTimedOut, 0x16, {}));
}

// Additional code 01h, or the two general ones of an object that is not in the state for it; only in a refusal.
TEST(ErrorCodes, WhatSaysThatItIsAllocated) {
  const auto says = [](ExplicitEnd end, std::uint8_t general, std::uint8_t additional) {
    ExplicitAnswer answer;
    answer.end = end;
    answer.general = general;
    answer.additional = additional;
    return saysAllocated(answer);
  };
  EXPECT_TRUE(says(ExplicitEnd::kRefused, 0x02, 0x01));
  EXPECT_TRUE(says(ExplicitEnd::kRefused, 0x0B, 0xFF));
  EXPECT_TRUE(says(ExplicitEnd::kRefused, 0x0C, 0xFF));
  EXPECT_FALSE(says(ExplicitEnd::kRefused, 0x02, 0x02));
  EXPECT_FALSE(says(ExplicitEnd::kDone, 0x0B, 0x01));
  EXPECT_FALSE(says(ExplicitEnd::kTimedOut, 0x0C, 0x01));
}

}  // namespace
}  // namespace nord_driver::devicenet
