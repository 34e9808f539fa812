// The accesses of a job, as the bus cycle is asked for them and as its answers are taken.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <deque>

#include "catalogue/shipped.h"
#include "node/broker_parameters.h"
#include "support/temporary_folder.h"

namespace nord_driver::node {
namespace {

using profile::ParameterOutcome;
using profile::ParameterReason;
using ::testing::HasSubstr;

class OneDrive : public ::testing::Test {
 protected:
  OneDrive() { setup_.name = "left"; }

  /// What the cycle answers next.
  static cycle::Completion answer(ParameterOutcome outcome, std::int32_t raw = 0) {
    cycle::Completion completion;
    completion.success = outcome == ParameterOutcome::kDone;
    completion.message = completion.success ? "" : "drive left says why not";
    completion.parameter.outcome = outcome;
    completion.parameter.raw = raw;
    return completion;
  }
  static catalogue::ParameterAddress p102(std::uint8_t set) {
    catalogue::ParameterAddress address;
    address.number = 102;
    address.parameter_set = set;
    return address;
  }

  test::TemporaryFolder folder_;
  cycle::DriveSetup setup_;
  DriveIdentity identity_;
  catalogue::DriveCatalogue known_{catalogue::shippedCatalogues(), profile::Series::kSk5xxe, {}};
  state::EepromBudget budget_{folder_.path("counts.yaml"), 1};
  state::DriveEeprom eeprom_{budget_, {"can0", 5, 1, "sk5xxe"}, "left", true};
  std::deque<cycle::Request> asked_;
  cycle::Completion next_;
  BrokerParameters parameters_{
      {3, setup_, identity_, known_, eeprom_}, std::chrono::seconds{7}, [this](const cycle::Request& request) {
        asked_.push_back(request);
        return next_;
      }};
};

TEST_F(OneDrive, IsReadWithThePatienceOfEachAccess) {
  next_ = answer(ParameterOutcome::kDone, 250);
  const tools::ParameterAnswer read = parameters_.read(p102(4));
  EXPECT_TRUE(read.success);
  EXPECT_EQ(250, read.raw);
  EXPECT_DOUBLE_EQ(2.5, read.value);
  EXPECT_EQ(4, read.set);
  ASSERT_EQ(1u, asked_.size());
  EXPECT_EQ(cycle::RequestKind::kReadParameter, asked_[0].kind);
  EXPECT_EQ(3u, asked_[0].drive);
  EXPECT_EQ(Duration{std::chrono::seconds{7}}, asked_[0].patience);
  EXPECT_EQ(102, asked_[0].parameter.number);
}

// Refused, a parameter is not there and a dump goes on; without an answer it ends.
TEST_F(OneDrive, TellsRefusedFromSilent) {
  next_ = answer(ParameterOutcome::kRefused);
  next_.parameter.reason = ParameterReason::kNoSuchParameter;
  next_.parameter.refused_number = 102;
  const tools::ParameterAnswer refused = parameters_.read(p102(1));
  EXPECT_TRUE(refused.refused);
  EXPECT_TRUE(refused.unknown);
  EXPECT_FALSE(refused.passing);
  next_.parameter.reason = ParameterReason::kNotNow;
  EXPECT_TRUE(parameters_.read(p102(1)).passing);
  for (const auto outcome : {ParameterOutcome::kOffline, ParameterOutcome::kTimeout, ParameterOutcome::kBusy}) {
    next_ = answer(outcome);
    const tools::ParameterAnswer silent = parameters_.read(p102(1));
    EXPECT_FALSE(silent.success);
    EXPECT_FALSE(silent.refused);
    EXPECT_EQ("drive left says why not", silent.message);
  }
}

TEST_F(OneDrive, IsWrittenWithinTheBudgetOfItsEeprom) {
  catalogue::ParameterAccess access = catalogue::accessTo(p102(1), known_);
  ASSERT_EQ("", catalogue::setRaw(access, 250, true));
  next_ = answer(ParameterOutcome::kDone, 250);
  next_.parameter.eeprom_written = true;
  EXPECT_TRUE(parameters_.write(access).success);
  const tools::ParameterAnswer refused = parameters_.write(access);
  EXPECT_FALSE(refused.success);
  EXPECT_TRUE(refused.refused);
  EXPECT_THAT(refused.message, HasSubstr("eeprom_budget"));
  EXPECT_EQ(1u, asked_.size()) << "the second one has reached no bus";
}

}  // namespace
}  // namespace nord_driver::node
