// Why drives are not enabled, when there are more reasons than a sentence holds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "cycle/enable_refusal.h"
#include "cycle/user_messages.h"

namespace nord_driver::cycle {
namespace {

using drive::Refusal;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string refusalOf(const std::vector<Refusal>& refusals) {
  std::vector<std::string> names;
  std::vector<drive::Drive> drives;
  for (std::size_t i = 0; i < refusals.size(); ++i) {
    names.push_back("conveyor_" + std::to_string(i));
    drives.emplace_back(drive::DriveConfig{});
  }
  return enableRefusalMessage(names, drives, refusals, Sentence{}).str();
}

// A drive that is the only one to refuse has the whole sentence for itself, wherever it stands among them.
TEST(EnableRefusal, OfOneDriveIsItsOwnSentence) {
  const drive::Drive drive{drive::DriveConfig{}};
  for (const Refusal refusal : {Refusal::kFault, Refusal::kFaultLatched, Refusal::kOffline, Refusal::kBusy}) {
    EXPECT_EQ(refusalMessage("conveyor_0", refusal, drive.report()).str(), refusalOf({refusal, Refusal::kNone}));
    EXPECT_EQ(refusalMessage("conveyor_1", refusal, drive.report()).str(), refusalOf({Refusal::kNone, refusal}));
  }
}

// What is left out is said once, however much it is, and even where a shorter reason after it would find a place.
TEST(EnableRefusal, SaysThatThereIsMoreThanFits) {
  const std::string text =
      refusalOf({Refusal::kFault, Refusal::kOffline, Refusal::kLocalControl, Refusal::kParametersAwaited,
                 Refusal::kUnexpectedSource, Refusal::kMaxFrequencyUnknown, Refusal::kBusy});
  EXPECT_THAT(text, StartsWith("drive conveyor_0: the inverter reports a fault"));
  EXPECT_THAT(text, HasSubstr("drive conveyor_1: the inverter does not answer"));
  EXPECT_THAT(text, EndsWith("; and more"));
  EXPECT_EQ(text.find("and more"), text.rfind("and more"));
  EXPECT_LE(text.size(), 250u);
}

}  // namespace
}  // namespace nord_driver::cycle
