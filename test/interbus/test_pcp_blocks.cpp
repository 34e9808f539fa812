// Compact PCP in register blocks: words by hand, layouts, and the words of its errors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "interbus/pcp_blocks.h"
#include "interbus/pcp_error.h"

namespace nord_driver::interbus {
namespace {

using ::testing::HasSubstr;

std::string wordsOf(const PcpBlock& block, unsigned count) {
  std::string text;
  for (unsigned i = 0; i < count; ++i) text += (i == 0 ? "" : " ") + toHexWord(block[i]);
  return text;
}

// P508 is object 21FCh (BU 0070 5.1).
TEST(PcpBlocks, ARead) {
  const PcpInvocation read{PcpService::kRead, 2, kFirstParameterObject + 508, 1};
  EXPECT_EQ("0081 0002 21FC 0001 0000 0000 0000", wordsOf(toBlock(read, {}), blockWords(PcpInvokeLayout{})));
}

TEST(PcpBlocks, AWriteHasTwoOrFourBytes) {
  const PcpInvocation word{PcpService::kWrite, 3, 0x2066, 3, 2, 1000};
  EXPECT_EQ("0082 0003 2066 0003 0002 03E8 0000", wordsOf(toBlock(word, {}), 7));
  const PcpInvocation minus{PcpService::kWrite, 3, 0x2066, 3, 2, 0xFFFFFFFFu};
  EXPECT_EQ("0082 0003 2066 0003 0002 FFFF 0000", wordsOf(toBlock(minus, {}), 7));
  const PcpInvocation wide{PcpService::kWrite, 3, 0x2265, 1, 4, 0x12345678};
  EXPECT_EQ("0082 0003 2265 0001 0004 1234 5678", wordsOf(toBlock(wide, {}), 7));
}

// What an initiate does not say of an object is 0.
TEST(PcpBlocks, AnInitiateNamesItsReferenceOnly) {
  PcpInvocation initiate;
  initiate.service = PcpService::kInitiate;
  EXPECT_EQ("008B 0002 0000 0000 0000 0000 0000", wordsOf(toBlock(initiate, {}), 7));
}

TEST(PcpBlocks, NoOrderIsAllZero) {
  EXPECT_EQ("0000 0000 0000 0000 0000 0000 0000", wordsOf(toBlock({PcpService::kNone, 5, 1, 1, 2, 3}, {}), 7));
}

TEST(PcpBlocks, FieldsHaveTheirConfiguredPlaces) {
  const PcpInvokeLayout layout{1, 0, 3, 2, 8, 5};
  EXPECT_EQ(9u, blockWords(layout));
  EXPECT_EQ("0003 0082 0001 2066 0000 03E8 0000 0000 0002",
            wordsOf(toBlock({PcpService::kWrite, 3, 0x2066, 1, 2, 1000}, layout), 9));
  PcpResultLayout result;
  result.error = 6;
  result.data = 4;
  result.length = 3;
  result.additional = 3;
  EXPECT_EQ("", layoutFault(result)) << "a bad result has another meaning for the word of the length";
  const PcpResult found = fromBlock(PcpBlock{0x0181, 2, 0, 2, 500, 0, 0}, result);
  EXPECT_EQ(500u, found.value);
  EXPECT_EQ(7u, blockWords(PcpResultLayout{}));
  EXPECT_EQ(7u, blockWords(result));
  result.data = 9;
  EXPECT_EQ(11u, blockWords(result)) << "a value has two words";
}

TEST(PcpBlocks, ResultsHaveOneTwoOrFourBytes) {
  EXPECT_EQ(0xFF38u, fromBlock(PcpBlock{0x0181, 2, 0, 0, 2, 0xFF38, 0}, {}).value);
  EXPECT_EQ(0x12345678u, fromBlock(PcpBlock{0x0181, 2, 0, 0, 4, 0x1234, 0x5678}, {}).value);
  const PcpResult byte = fromBlock(PcpBlock{0x0181, 2, 0, 0x31, 1, 0x1200, 0}, {});
  EXPECT_EQ(0x12u, byte.value);
  EXPECT_EQ(1u, byte.length);
  EXPECT_EQ(0, byte.error.additional) << "a good result has no error";
  const PcpResult bad = fromBlock(PcpBlock{0x0182, 2, 0x0800, 0x31, 0, 0, 0}, {});
  EXPECT_FALSE(bad.good());
  EXPECT_EQ(8, bad.error.error_class);
  EXPECT_EQ(0, bad.error.code);
  EXPECT_EQ(0x31, bad.error.additional);
  EXPECT_EQ(0x0182, bad.service);
  EXPECT_EQ(2, bad.reference);
}

// Behind an error nothing is a value, whatever an earlier answer has left there.
TEST(PcpBlocks, ABadResultHasNoValue) {
  const PcpResult bad = fromBlock(PcpBlock{0x0181, 5, 0x0607, 0, 2, 0x1234, 0}, {});
  EXPECT_EQ(5, bad.reference);
  EXPECT_EQ(6, bad.error.error_class);
  EXPECT_EQ(7, bad.error.code);
  EXPECT_EQ(0u, bad.length);
  EXPECT_EQ(0u, bad.value);
}

// 0181h (ABB NIBA-01) and 8081h (SEW UFI11A) are the same confirmation.
TEST(PcpBlocks, WhatAnswersWhat) {
  const PcpInvocation read{PcpService::kRead, 2, 0x2069, 1};
  const auto answer = [&](Word service, Word reference) { return answerTo(read, {service, reference, {}, 0, 0}); };
  EXPECT_EQ(PcpAnswer::kHere, answer(0x0181, 2));
  EXPECT_EQ(PcpAnswer::kHere, answer(0x8081, 2));
  EXPECT_EQ(PcpAnswer::kNotYet, answer(0x0081, 2)) << "the order itself";
  EXPECT_EQ(PcpAnswer::kNotYet, answer(0, 2));
  EXPECT_EQ(PcpAnswer::kNotYet, answer(0x0182, 2)) << "another service";
  EXPECT_EQ(PcpAnswer::kNotYet, answer(0x0181, 3)) << "another drive";
  EXPECT_EQ(PcpAnswer::kAborted, answer(0x01AD, 2));
  EXPECT_EQ(PcpAnswer::kAborted, answer(0x018D, 2));
  const PcpInvocation initiate{PcpService::kInitiate, 2};
  EXPECT_EQ(PcpAnswer::kHere, answerTo(initiate, {0x018C, 2, {1, 0, 0}, 0, 0})) << "initiate error";
  EXPECT_EQ(PcpAnswer::kHere, answerTo(initiate, {0x808B, 2, {}, 0, 0}));
  EXPECT_EQ(PcpAnswer::kNotYet, answerTo(initiate, {0x0181, 2, {}, 0, 0}));
  EXPECT_EQ(PcpAnswer::kNotYet, answer(0x018C, 2)) << "a connection that was refused to somebody else";
}

TEST(PcpBlocks, FieldsThatMeetAreNamed) {
  PcpInvokeLayout invoke;
  invoke.length = 6;
  EXPECT_EQ("data: 5 lies in length, expected a word of its own", layoutFault(invoke));
  PcpResultLayout result;
  result.data = 31;
  EXPECT_EQ("data: 31, expected at most 30", layoutFault(result));
  result = {};
  result.additional = result.error;
  EXPECT_EQ("additional: 2 lies in error, expected a word of its own", layoutFault(result));
  EXPECT_EQ("", layoutFault(PcpInvokeLayout{}));
  EXPECT_EQ("", layoutFault(PcpResultLayout{}));
}

TEST(PcpError, EachHasItsWords) {
  const auto meaning = [](unsigned error_class, unsigned code, unsigned additional) {
    return std::string(pcpErrorMeaning({static_cast<std::uint8_t>(error_class), static_cast<std::uint8_t>(code),
                                        static_cast<std::uint16_t>(additional)}));
  };
  EXPECT_EQ("the inverter has no parameter of this number", meaning(6, 7, 0));
  EXPECT_THAT(meaning(6, 3, 0), HasSubstr("read-only, or P509"));
  EXPECT_EQ("the sub-index is wrong", meaning(6, 5, 0x11));
  EXPECT_EQ("the service has an invalid parameter", meaning(6, 5, 0x10));
  EXPECT_EQ("the value is above the upper limit", meaning(8, 0, 0x31));
  EXPECT_EQ("the value is below the lower limit", meaning(8, 0, 0x32));
  EXPECT_THAT(meaning(8, 0, 0x21), HasSubstr("local control"));
  EXPECT_EQ("the device cannot do it", meaning(8, 0, 0x99));
  EXPECT_THAT(meaning(1, 7, 0), HasSubstr("connection"));
  EXPECT_THAT(meaning(9, 0x12, 0), HasSubstr("master in the gateway"));
  EXPECT_EQ("an error no document lists", meaning(7 + 4, 1, 0));
}

}  // namespace
}  // namespace nord_driver::interbus
