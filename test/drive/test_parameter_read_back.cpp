// What is read back after a write, and what that says of the write.
#include <gtest/gtest.h>

#include "drive/parameter_notes.h"
#include "drive/parameter_session.h"

namespace nord_driver::drive {
namespace {

using profile::ParameterAction;
using profile::ParameterOutcome;
using profile::ParameterRequest;
using profile::ParameterResult;

class ParameterReadBack : public ::testing::Test {
 protected:
  void SetUp() override {
    ParameterRequest request;
    request.id = 7;
    request.action = ParameterAction::kWriteRam;
    request.number = 102;
    request.raw = -5;
    ASSERT_TRUE(session_.submit(request));
  }
  /// The next question, which has to be of this kind, is answered.
  void answer(ParameterAction asked, ParameterOutcome outcome, std::int32_t raw) {
    const auto request = session_.pollRequest();
    ASSERT_TRUE(request.has_value());
    ASSERT_EQ(asked, request->action);
    ParameterResult result;
    result.id = request->id;
    result.outcome = outcome;
    result.raw = raw;
    session_.handleResult(result);
  }

  ParameterSession session_;
};

// A channel of words hands a negative one on with its sign.
TEST_F(ParameterReadBack, IsTheNegativeWordWritten) {
  answer(ParameterAction::kRead, ParameterOutcome::kDone, 3);
  answer(ParameterAction::kWriteRam, ParameterOutcome::kDone, -5);
  answer(ParameterAction::kRead, ParameterOutcome::kDone, -5);
  const auto result = session_.pollResult();
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ(ParameterOutcome::kDone, result->outcome);
  EXPECT_EQ(-5, result->raw);
  EXPECT_STREQ("", result->note);
}

TEST_F(ParameterReadBack, CannotBeHad) {
  answer(ParameterAction::kRead, ParameterOutcome::kDone, 3);
  answer(ParameterAction::kWriteRam, ParameterOutcome::kDone, -5);
  answer(ParameterAction::kRead, ParameterOutcome::kTimeout, 0);
  const auto result = session_.pollResult();
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ(ParameterOutcome::kTimeout, result->outcome);
  EXPECT_STREQ(kNotReadBack, result->note);
}

}  // namespace
}  // namespace nord_driver::drive
