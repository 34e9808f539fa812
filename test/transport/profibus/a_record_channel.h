// The parameters of one unit as records: the channel, and the unit typed in hexadecimal.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "transport/profibus/record_parameter_channel.h"

namespace nord_driver {

using profibus::RecordOutcome;
using profibus::RecordRequest;
using profibus::RecordResult;
using profile::ParameterOutcome;

constexpr const char* kNone = "00 00 00 00 00 00 00 00";  // "no order" and "no answer"

/// Of the module: its answers are awaited for two seconds.
class Records : public ::testing::Test {
 protected:
  RecordParameterChannel channel_{RecordParameterChannel::kModule, {}, std::chrono::seconds{2}};
  Instant now_{std::chrono::seconds{100}};

  bool submit(std::uint16_t number, std::uint32_t id = 7) {
    profile::ParameterRequest request;
    request.id = id;
    request.number = number;
    return channel_.submit(request, now_);
  }
  bool submitElement(std::uint16_t number, std::uint8_t element) {
    profile::ParameterRequest request;
    request.id = 7;
    request.number = number;
    request.shape = profile::ParameterShape::kArray;
    request.index = element;
    return channel_.submit(request, now_);
  }
  /// Polls cycle by cycle; none within five: no request.
  std::optional<RecordRequest> next() {
    for (int i = 0; i < 5; ++i, now_ += std::chrono::milliseconds{10}) {
      if (auto request = channel_.pollRecord(now_)) return request;
    }
    return std::nullopt;
  }
  void expectWrite(const std::string& hex) {
    const auto request = next();
    ASSERT_TRUE(request);
    EXPECT_TRUE(request->write);
    EXPECT_EQ(hex, toHex(request->data));
    last_ = *request;
  }
  void expectRead() {
    const auto request = next();
    ASSERT_TRUE(request);
    EXPECT_FALSE(request->write);
    EXPECT_EQ(8, request->length);
    last_ = *request;
  }
  void answer(RecordOutcome outcome, const std::string& hex = "", std::uint8_t code1 = 0) {
    RecordResult result;
    result.write = last_.write;
    result.outcome = outcome;
    if (code1 != 0) result.error = {0x80, code1, 0};
    for (const std::uint8_t byte : fromHex(hex)) result.data.push_back(byte);
    channel_.handleRecord(result, now_);
  }
  /// Between two orders that could be taken for each other: eight zeros, and read until there is no answer any more.
  void expectTakenBack(const std::string& stale_answer = "") {
    expectWrite(kNone);
    answer(RecordOutcome::kDone);
    EXPECT_TRUE(channel_.holdsStation());
    if (!stale_answer.empty()) {
      expectRead();
      answer(RecordOutcome::kDone, stale_answer);
      EXPECT_TRUE(channel_.holdsStation());
      EXPECT_FALSE(channel_.pollResult()) << "that was the answer to the order before";
    }
    expectRead();
    answer(RecordOutcome::kDone, kNone);
  }
  profile::ParameterResult result() {
    const auto result = channel_.pollResult();
    EXPECT_TRUE(result) << "no result";
    return result.value_or(profile::ParameterResult{});
  }

  RecordRequest last_;
};

}  // namespace nord_driver
