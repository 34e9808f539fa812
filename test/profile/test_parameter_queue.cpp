// The requests of one parameter channel: which is the running one, how it ends, and what is not asked at all.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "profile/parameter_queue.h"

namespace nord_driver::profile {
namespace {

ParameterRequest request(std::uint16_t number, ParameterShape shape = ParameterShape::kPlain, std::uint32_t id = 7) {
  ParameterRequest request;
  request.id = id;
  request.number = number;
  request.shape = shape;
  return request;
}

std::string refusalOf(const ParameterRequest& request, ParameterReason reason) {
  ParameterQueue queue;
  EXPECT_TRUE(queue.submit(request));
  EXPECT_TRUE(queue.empty()) << "not the inverter's";
  const auto result = queue.pollResult().value_or(ParameterResult{});
  EXPECT_EQ(request.id, result.id);
  EXPECT_EQ(ParameterOutcome::kRefused, result.outcome);
  EXPECT_EQ(reason, result.reason);
  return result.text.str();
}

TEST(ParameterQueue, EachEndIsTheOneOfTheRunningRequest) {
  ParameterQueue queue;
  for (std::uint32_t id = 1; id <= 3; ++id) ASSERT_TRUE(queue.submit(request(105, ParameterShape::kPerSet, id)));
  queue.done(500);
  queue.refuse(ParameterReason::kReadOnly, "its own words");
  queue.fail(ParameterOutcome::kTimeout);
  EXPECT_TRUE(queue.empty());
  const auto done = queue.pollResult().value_or(ParameterResult{});
  EXPECT_EQ(1u, done.id);
  EXPECT_EQ(ParameterOutcome::kDone, done.outcome);
  EXPECT_EQ(500, done.raw);
  const auto refused = queue.pollResult().value_or(ParameterResult{});
  EXPECT_EQ(2u, refused.id);
  EXPECT_EQ(ParameterReason::kReadOnly, refused.reason);
  EXPECT_STREQ("its own words", refused.text.c_str());
  const auto failed = queue.pollResult().value_or(ParameterResult{});
  EXPECT_EQ(3u, failed.id);
  EXPECT_EQ(ParameterOutcome::kTimeout, failed.outcome);
  EXPECT_EQ(ParameterReason::kNone, failed.reason);
  EXPECT_FALSE(queue.pollResult());
}

TEST(ParameterQueue, AllEndWhenTheDriveIsGone) {
  ParameterQueue queue;
  while (queue.submit(request(105))) {
  }
  EXPECT_EQ(ParameterQueue::kCapacity, queue.size());
  queue.failAll(ParameterOutcome::kOffline);
  EXPECT_TRUE(queue.empty());
  EXPECT_FALSE(queue.submit(request(105))) << "their results wait";
  for (std::size_t i = 0; i < ParameterQueue::kCapacity; ++i) {
    EXPECT_EQ(ParameterOutcome::kOffline, queue.pollResult().value().outcome);
  }
  EXPECT_TRUE(queue.submit(request(105)));
}

// BU 0020 7.5.2: four sets, elements from 1, and six bits for the element of a set-dependent array.
TEST(ParameterQueue, WhatNoInverterCanHaveIsNotAsked) {
  EXPECT_EQ("parameters are numbered up to 999", refusalOf(request(1000), ParameterReason::kNoSuchParameter));
  ParameterRequest set = request(102, ParameterShape::kPerSet);
  set.parameter_set = 5;
  EXPECT_EQ("there is no parameter set 5", refusalOf(set, ParameterReason::kNoSuchElement));
  ParameterRequest element = request(701, ParameterShape::kArray);
  element.index = 0;
  EXPECT_EQ("there is no array element 0", refusalOf(element, ParameterReason::kNoSuchElement));
  element = request(546, ParameterShape::kArrayPerSet);
  element.index = 65;
  EXPECT_EQ("there is no array element 65", refusalOf(element, ParameterReason::kNoSuchElement));
}

// What a transport without words of its own leaves to be said.
TEST(ParameterReason, EveryOneButNoneHasItsWords) {
  for (int i = 1; i < static_cast<int>(ParameterReason::kDriver); ++i) {
    EXPECT_STRNE("", toString(static_cast<ParameterReason>(i))) << i;
  }
  EXPECT_STREQ("", toString(ParameterReason::kNone));
  EXPECT_STREQ("", toString(ParameterReason::kDriver)) << "its note says it";
}

}  // namespace
}  // namespace nord_driver::profile
