// What a write to a drive costs of the budget, and which writes are refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "state/drive_eeprom.h"
#include "support/temporary_folder.h"

namespace nord_driver::state {
namespace {

using Storage = DriveEeprom::Storage;
using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const WallTime kNow = WallTime{} + std::chrono::hours{24} * 20'780;
const DrivePlace kPlace{"can0", 5, 2, "sk2xxe"};
constexpr char kName[] = "can0, address 5, inverter 2, sk2xxe";

constexpr DriveEeprom::Outcome outcome(bool success, bool eeprom_written, bool by_ram_order = false) {
  return {success, eeprom_written, by_ram_order, true};
}
/// Nobody was told what became of it.
constexpr DriveEeprom::Outcome kUnanswered{false, true, false, false};

class OneDrive : public ::testing::Test {
 protected:
  std::uint64_t count() const { return budget_.countOf(kName).writes; }
  /// Refused, or ended like that: the sentence.
  std::string write(Storage storage, const DriveEeprom::Outcome& ended) {
    const auto permission = drive_.ask(storage, kNow);
    if (!permission.refusal.empty()) return permission.refusal;
    during_ = count();
    return drive_.settle(storage, permission, ended, kNow);
  }

  test::TemporaryFolder folder_;
  EepromBudget budget_{folder_.path("counts.yaml"), 5};
  DriveEeprom drive_{budget_, kPlace, "left", true};
  std::uint64_t during_ = 0;  // counted while the last write was under way
};

TEST_F(OneDrive, IsNamedByItsPlace) {
  EXPECT_EQ(kName, nameOf(kPlace));
}

TEST_F(OneDrive, CountsAWriteToTheEepromBeforeItIsDone) {
  EXPECT_EQ("", write(Storage::kEeprom, outcome(true, true)));
  EXPECT_EQ(1u, during_);
  EXPECT_EQ(1u, count());
}

TEST_F(OneDrive, GetsBackWhatWasNotWritten) {
  EXPECT_EQ("", write(Storage::kEeprom, outcome(true, false)));
  EXPECT_EQ(1u, during_);
  EXPECT_EQ(0u, count());
}

TEST_F(OneDrive, IsRefusedByNameWhenTheBudgetIsUsedUp) {
  for (int i = 0; i < 5; ++i) EXPECT_EQ("", write(Storage::kEeprom, outcome(true, true)));
  EXPECT_THAT(write(Storage::kEeprom, outcome(true, true)),
              AllOf(StartsWith("drive left: its EEPROM has had 5 writes"),
                    EndsWith("raise eeprom_budget, or wait until 2026-11-24 00:00 UTC, or write to the RAM")));
  EXPECT_EQ("", write(Storage::kRam, outcome(true, false, true))) << "the RAM can be written";
  EXPECT_EQ(5u, count());
}

// The first write to RAM shows whether it costs anything.
TEST_F(OneDrive, CountsNothingOnceItHasTakenAnOrderForTheRam) {
  EXPECT_EQ("", write(Storage::kRam, outcome(true, false, true)));
  EXPECT_EQ(3u, during_);
  EXPECT_EQ(0u, count());
  EXPECT_EQ("", write(Storage::kRam, outcome(true, false, true)));
  EXPECT_EQ(0u, during_);
}

// What was there already has shown nothing.
TEST_F(OneDrive, StaysUnknownWhereNothingHadToBeWritten) {
  EXPECT_EQ("", write(Storage::kRam, outcome(true, false)));
  EXPECT_EQ("", write(Storage::kRam, outcome(true, false)));
  EXPECT_EQ(3u, during_);
  EXPECT_EQ(0u, count());
}

TEST_F(OneDrive, CountsWritesToRamThatGoThroughP560AndRefusesThemPastTheBudget) {
  EXPECT_EQ("", write(Storage::kRam, outcome(true, true)));
  EXPECT_EQ(3u, count());
  EXPECT_THAT(write(Storage::kRam, outcome(true, true)),
              EndsWith("its RAM is written through P560, which counts, too"));
  EXPECT_EQ("", write(Storage::kEeprom, outcome(true, true)));
}

// P560 may have to be put back when the drive has come back.
TEST_F(OneDrive, CountsMoreOfASwitchThatFailed) {
  EXPECT_EQ("", write(Storage::kRam, outcome(false, true)));
  EXPECT_EQ(5u, count());
}

// No answer does not show that P560 had a part in it: the RAM is not refused for it.
TEST_F(OneDrive, OfAWriteToRamWithoutAnswerCountsWhatItMayHaveWrittenAndRefusesNothing) {
  budget_.add(kName, 5, kNow);
  for (std::uint64_t i = 1; i <= 2; ++i) {
    EXPECT_EQ("", write(Storage::kRam, kUnanswered));
    EXPECT_EQ(5u + 5u * i, count());
  }
  EXPECT_EQ("", write(Storage::kRam, outcome(true, false, true)));
}

TEST_F(OneDrive, OfADriveThatTakesOrdersForTheRamAWriteWithoutAnswerCountsNothing) {
  EXPECT_EQ("", write(Storage::kRam, outcome(true, false, true)));
  EXPECT_EQ("", write(Storage::kRam, kUnanswered));
  EXPECT_EQ(0u, count());
  EXPECT_EQ("", write(Storage::kRam, outcome(true, false, true)));
  EXPECT_EQ(0u, during_) << "it still takes them";
}

TEST_F(OneDrive, StillNeedsP560AfterAWriteWithoutAnswer) {
  EXPECT_EQ("", write(Storage::kRam, outcome(true, true)));
  EXPECT_EQ("", write(Storage::kEeprom, kUnanswered));
  EXPECT_EQ(4u, count()) << "or it was written";
  budget_.add(kName, 1, kNow);
  EXPECT_THAT(write(Storage::kRam, kUnanswered), HasSubstr("P560"));
}

// Another inverter may have come in its place.
TEST_F(OneDrive, CountsAfterwardsWhatNobodyExpected) {
  EXPECT_EQ("", write(Storage::kRam, outcome(true, false, true)));
  EXPECT_EQ("", write(Storage::kRam, outcome(true, true)));
  EXPECT_EQ(0u, during_);
  EXPECT_EQ(3u, count());
}

TEST_F(OneDrive, BehindABusWithoutSuchOrdersIsRefusedFromTheStart) {
  DriveEeprom drive{budget_, kPlace, "left", false};
  budget_.add(kName, 4, kNow);
  EXPECT_THAT(drive.ask(Storage::kRam, kNow).refusal, HasSubstr("P560"));
}

TEST_F(OneDrive, OfABrokenFileIsWrittenInItsRamOnly) {
  folder_.write("counts.yaml", "?");
  EXPECT_THAT(drive_.ask(Storage::kEeprom, kNow).refusal,
              AllOf(StartsWith("drive left: nothing is written to its EEPROM"), HasSubstr(folder_.path("counts.yaml")),
                    EndsWith("mend or remove the file; the RAM can be written")));
  const auto permission = drive_.ask(Storage::kRam, kNow);
  EXPECT_EQ("", permission.refusal);
  EXPECT_EQ("", drive_.settle(Storage::kRam, permission, outcome(true, false, true), kNow));
  EXPECT_THAT(drive_.settle(Storage::kRam, permission, outcome(true, true), kNow), HasSubstr("could not be counted"));
}

}  // namespace
}  // namespace nord_driver::state
