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

// However long the names are, no reason is cut off in its middle.
TEST(EnableRefusal, EachReasonIsThereAsAWholeOrNotAtAll) {
  const std::vector<Refusal> refusals{Refusal::kOffline, Refusal::kLocalControl, Refusal::kBusy};
  const std::vector<drive::Drive> drives(3, drive::Drive{drive::DriveConfig{}});
  int whole = 0, shortened = 0;
  for (std::size_t length = 1; length <= 60; ++length) {
    std::vector<std::string> names;
    for (const char letter : {'a', 'b', 'c'}) names.emplace_back(length, letter);
    const std::string text = enableRefusalMessage(names, drives, refusals, Sentence{}).str();
    std::vector<std::string> possible;
    std::string begin;
    for (std::size_t i = 0; i < 3; ++i) {
      begin += (i == 0 ? "drive " : "; drive ") + names[i] + ": " + drive::toString(refusals[i]);
      possible.push_back(i == 2 ? begin : begin + "; and more");
    }
    EXPECT_THAT(possible, ::testing::Contains(text));
    (text == begin ? whole : shortened) += 1;
  }
  EXPECT_GT(whole, 5);
  EXPECT_GT(shortened, 5);
}

// What to set is said with its number; of others with the same reason it is not said again.
TEST(EnableRefusal, AReasonWithAValueIsSaidOnce) {
  std::vector<drive::Drive> drives(3, drive::Drive{drive::DriveConfig{}});
  for (drive::Drive& drive : drives) {
    drive.setMinimumFrequency(1, Hertz{5.0});
    drive.setUnexpectedFunction(1, drive::UnexpectedFunction{543, true, 0, 1, 1, nullptr, false});
    drive.setUnexpectedSource(drive::UnexpectedSource{510, true, 4, false, false});
    profile::ProcessInput input;
    input.status_word = 0x0B31;
    drive.handleInput(input, true, Instant{std::chrono::hours{1}});
  }
  const std::vector<std::string> names{"left", "right", "lift"};
  for (const Refusal refusal : {Refusal::kMinimumFrequency, Refusal::kUnexpectedFunction, Refusal::kUnexpectedSource}) {
    const std::string first = refusalMessage("right", refusal, drives[1].report()).str();
    const std::string two = enableRefusalMessage(names, drives, {Refusal::kNone, refusal, refusal}, Sentence{}).str();
    EXPECT_EQ(first.substr(0, 190) + "; drive lift: the same", two);
    const std::string one = enableRefusalMessage(names, drives, {Refusal::kBusy, refusal, Refusal::kNone}, {}).str();
    EXPECT_THAT(one, EndsWith("; " + first.substr(0, 190)));
  }
}

}  // namespace
}  // namespace nord_driver::cycle
