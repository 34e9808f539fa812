// A driver that begins anew gets the answers to its own questions only, whatever number the one before gave to its own.
#include <gtest/gtest.h>

#include <memory>
#include <utility>

#include "campaign/reborn_transport.h"
#include "cycle/scripted_transport.h"

namespace nord_driver::test {
namespace {

TEST(RebornTransport, OwesNoAnswerToWhatWasAskedBefore) {
  auto scripted = std::make_unique<cycle::ScriptedTransport>(1);
  cycle::ScriptedTransport& bus = *scripted;
  bus.hold_answers = true;
  bus.parameters[105] = 500;
  bus.parameters[102] = 150;
  RebornTransport reborn{std::move(scripted)};
  profile::ParameterRequest request;
  request.id = 1;
  request.number = 105;
  ASSERT_TRUE(reborn.submit(0, request));
  bus.answerFirst();
  auto answer = reborn.pollResult();
  ASSERT_TRUE(answer);
  EXPECT_EQ(1u, answer->id);
  EXPECT_EQ(500, answer->raw);

  request.id = 2;
  ASSERT_TRUE(reborn.submit(0, request));
  reborn.beginAnew();
  request.number = 102;
  ASSERT_TRUE(reborn.submit(0, request));
  bus.answerAll();
  answer = reborn.pollResult();
  ASSERT_TRUE(answer);
  EXPECT_EQ(2u, answer->id);
  EXPECT_EQ(150, answer->raw);
  EXPECT_FALSE(reborn.pollResult());
}

}  // namespace
}  // namespace nord_driver::test
