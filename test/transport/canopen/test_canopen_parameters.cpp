// A parameter access as the drive layer knows it, as SDO carries it.
#include <gtest/gtest.h>

#include "transport/canopen/canopen_parameters.h"

namespace nord_driver {
namespace {

using canopen::SdoAnswer;
using canopen::SdoEnd;
using profile::ParameterAction;
using profile::ParameterOutcome;
using profile::ParameterReason;
using profile::ParameterRequest;
using profile::ParameterShape;

ParameterRequest requestOf(std::uint16_t number, ParameterShape shape, ParameterAction action, std::int32_t raw = 0) {
  ParameterRequest request;
  request.id = 77;
  request.number = number;
  request.shape = shape;
  request.action = action;
  request.raw = raw;
  return request;
}
ParameterRequest readOf(std::uint16_t number, ParameterShape shape) {
  return requestOf(number, shape, ParameterAction::kRead);
}

struct Channel {
  canopen::SdoRequest start() {
    const auto access = parameters.pendingAccess();
    EXPECT_TRUE(access.has_value());
    parameters.handleStarted();
    return access.value_or(canopen::SdoRequest{});
  }
  void answer(const canopen::SdoRequest& to, const FixedBytes<8>& data) {
    SdoAnswer answer;
    answer.id = to.id;
    answer.data = ByteView{data};
    parameters.handleAnswer(answer);
  }
  void abort(const canopen::SdoRequest& to, std::uint32_t code) {
    SdoAnswer answer;
    answer.id = to.id;
    answer.end = SdoEnd::kAbortedByServer;
    answer.abort_code = code;
    parameters.handleAnswer(answer);
  }
  profile::ParameterResult result() {
    const auto result = parameters.pollResult();
    EXPECT_TRUE(result.has_value());
    return result.value_or(profile::ParameterResult{});
  }

  CanopenParameters parameters{CanopenDrive{}, 5};
};

// BU 0060 p. 61: P102 of set 1 = 1.03 s is 2066h:1 = 0067h, 16 bits wide.
TEST(CanopenParametersTest, AWriteIsTheManuals) {
  Channel channel;
  channel.parameters.submit(requestOf(102, ParameterShape::kPerSet, ParameterAction::kWritePersistent, 103));
  const canopen::SdoRequest access = channel.start();
  EXPECT_EQ(0x2066, access.index);
  EXPECT_EQ(1, access.sub_index);
  EXPECT_TRUE(access.write);
  EXPECT_EQ("67 00", toHex(ByteView{access.data}));
  EXPECT_EQ(5, CanopenParameters::tagOf(access.id));
  channel.answer(access, {});
  const auto result = channel.result();
  EXPECT_EQ(ParameterOutcome::kDone, result.outcome);
  EXPECT_EQ(77u, result.id);
  EXPECT_EQ(103, result.raw);
}

TEST(CanopenParametersTest, PositionsAreWrittenWithFourBytes) {
  Channel channel;
  ParameterRequest request = requestOf(613, ParameterShape::kArray, ParameterAction::kWritePersistent, -2);
  request.double_word = true;
  channel.parameters.submit(request);
  EXPECT_EQ("FE FF FF FF", toHex(ByteView{channel.start().data}));
}

TEST(CanopenParametersTest, AReadTellsTheValue) {
  Channel channel;
  channel.parameters.submit(readOf(105, ParameterShape::kPerSet));
  const canopen::SdoRequest access = channel.start();
  EXPECT_FALSE(access.write);
  channel.answer(access, {0xF4, 0x01});
  EXPECT_EQ(500, channel.result().raw);
  channel.parameters.submit(readOf(613, ParameterShape::kArray));
  channel.answer(channel.start(), {0xFE, 0xFF, 0xFF, 0xFF});
  EXPECT_EQ(-2, channel.result().raw);
}

// SDO has no order that spares the EEPROM: that is said beforehand, and who asks all the same is refused.
TEST(CanopenParametersTest, ARamWriteIsNoneOfItsCapabilities) {
  EXPECT_FALSE(CanopenParameters::capabilities().ram_writes);
  Channel channel;
  channel.parameters.submit(requestOf(102, ParameterShape::kPerSet, ParameterAction::kWriteRam, 103));
  EXPECT_FALSE(channel.parameters.pendingAccess().has_value());
  const auto result = channel.result();
  EXPECT_EQ(ParameterOutcome::kRefused, result.outcome);
  EXPECT_EQ(ParameterReason::kNotSupported, result.reason);
}

// One server, one access: the next starts when the first has ended.
TEST(CanopenParametersTest, OneAccessAtATime) {
  Channel channel;
  channel.parameters.submit(readOf(102, ParameterShape::kPerSet));
  channel.parameters.submit(readOf(103, ParameterShape::kPerSet));
  const canopen::SdoRequest first = channel.start();
  EXPECT_FALSE(channel.parameters.pendingAccess().has_value());
  channel.answer(first, {1, 0});
  EXPECT_EQ(0x2067, channel.start().index);
}

// P700 is an array from firmware V1.9 on only (BU 0020 8): its first element is then read without sub-index, its third
// not, which would come back as the number of a fault.
TEST(CanopenParametersTest, AMissingSubIndexIsTriedWithoutOne) {
  Channel channel;
  channel.parameters.submit(readOf(700, ParameterShape::kArray));
  const canopen::SdoRequest first = channel.start();
  EXPECT_EQ(1, first.sub_index);
  channel.abort(first, 0x06090011);
  EXPECT_FALSE(channel.parameters.pollResult().has_value());
  const canopen::SdoRequest second = channel.start();
  EXPECT_EQ(0, second.sub_index);
  EXPECT_NE(first.id, second.id);
  channel.answer(second, {100, 0});
  EXPECT_EQ(100, channel.result().raw);

  ParameterRequest third = readOf(700, ParameterShape::kArray);
  third.index = 3;
  channel.parameters.submit(third);
  channel.abort(channel.start(), 0x06090011);
  EXPECT_EQ(ParameterReason::kNoSuchElement, channel.result().reason);
}

TEST(CanopenParametersTest, AnAbortIsARefusalWithItsCode) {
  Channel channel;
  channel.parameters.submit(requestOf(102, ParameterShape::kPerSet, ParameterAction::kWritePersistent, 103));
  channel.abort(channel.start(), 0x06090031);
  const auto result = channel.result();
  EXPECT_EQ(ParameterOutcome::kRefused, result.outcome);
  EXPECT_EQ(ParameterReason::kOutOfLimits, result.reason);
  EXPECT_EQ("SDO abort 0609 0031h, the value is above the upper limit", result.text.str());
}

TEST(CanopenParametersTest, ASilentServerIsATimeOut) {
  Channel channel;
  channel.parameters.submit(readOf(102, ParameterShape::kPerSet));
  SdoAnswer answer;
  answer.id = channel.start().id;
  answer.end = SdoEnd::kTimedOut;
  channel.parameters.handleAnswer(answer);
  EXPECT_EQ(ParameterOutcome::kTimeout, channel.result().outcome);
}

// An answer from before a loss is not the answer to the question after it.
TEST(CanopenParametersTest, WhatWasGivenUpIsNotAnswered) {
  Channel channel;
  channel.parameters.submit(readOf(102, ParameterShape::kPerSet));
  const canopen::SdoRequest lost = channel.start();
  channel.parameters.handleOffline();
  EXPECT_EQ(ParameterOutcome::kOffline, channel.result().outcome);
  channel.parameters.submit(readOf(103, ParameterShape::kPerSet));
  const canopen::SdoRequest next = channel.start();
  channel.answer(lost, {9, 0});
  EXPECT_FALSE(channel.parameters.pollResult().has_value());
  channel.answer(next, {7, 0});
  EXPECT_EQ(7, channel.result().raw);
}

// A string is no parameter value.
TEST(CanopenParametersTest, AValueOfAnotherSizeIsRefused) {
  Channel channel;
  channel.parameters.submit(readOf(102, ParameterShape::kPerSet));
  channel.answer(channel.start(), {1, 2, 3, 4, 5});
  const auto result = channel.result();
  EXPECT_EQ(ParameterOutcome::kRefused, result.outcome);
  EXPECT_EQ(ParameterReason::kUnreadable, result.reason);
  EXPECT_EQ("the SDO answer is 5 bytes long, which no parameter's value is", result.text.str());
}

TEST(CanopenParametersTest, WhatIsNoParameterIsRefusedWithoutAsking) {
  Channel channel;
  channel.parameters.submit(readOf(1000, ParameterShape::kPlain));
  EXPECT_EQ(ParameterReason::kNoSuchParameter, channel.result().reason);
  ParameterRequest request = readOf(102, ParameterShape::kPerSet);
  request.parameter_set = 5;
  channel.parameters.submit(request);
  EXPECT_EQ(ParameterReason::kNoSuchElement, channel.result().reason);
  EXPECT_FALSE(channel.parameters.pendingAccess().has_value());
}

TEST(CanopenParametersTest, NoMoreThanItsCapacityIsTaken) {
  Channel channel;
  for (std::size_t i = 0; i < CanopenParameters::kCapacity; ++i) {
    EXPECT_TRUE(channel.parameters.submit(readOf(102, ParameterShape::kPerSet)));
  }
  EXPECT_FALSE(channel.parameters.submit(readOf(102, ParameterShape::kPerSet)));
}

}  // namespace
}  // namespace nord_driver
