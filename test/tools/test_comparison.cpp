// What differs between dumps and drives, and what deviates from the factory.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "catalogue/shipped.h"
#include "tools/changed_dump.h"
#include "tools/comparison.h"
#include "tools/linked_drive.h"
#include "tools/parameter_json.h"
#include "tools/parameter_name.h"

namespace nord_driver::tools {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

Dump dumpOf(const std::vector<std::pair<std::string, std::int32_t>>& values) {
  Dump dump;
  for (const auto& [name, raw] : values) dump.values.push_back({parseParameterName(name), raw});
  return dump;
}

const catalogue::DriveCatalogue& known() {
  static const catalogue::DriveCatalogue kKnown = knownOf(catalogue::shippedCatalogues(), profile::Series::kSk5xxe, "");
  return kKnown;
}

std::vector<std::string> texts(const Dump& first, const Dump& second) {
  std::vector<std::string> result;
  for (const Difference& difference : differencesOf(first, second, known()).found) {
    result.push_back(differenceText(difference, known(), "a.yaml", "b.yaml"));
  }
  return result;
}

TEST(Comparison, TellsBothSidesWithTheirNames) {
  EXPECT_THAT(
      texts(dumpOf({{"P102 set 1", 200}, {"P102 set 2", 200}}), dumpOf({{"P102 set 1", 250}, {"P102 set 2", 200}})),
      ElementsAre("P102 set 1 Acceleration time: 2.00 s in a.yaml, 2.50 s in b.yaml"));
}

// A file may have been made of an inverter that has more, or by --changed.
TEST(Comparison, NamesWhatOnlyOneSideHas) {
  const Dump first = dumpOf({{"P102 set 1", 200}}), second = dumpOf({{"P513", 0}});
  EXPECT_THAT(texts(first, second), ElementsAre("P102 set 1 Acceleration time: 2.00 s in a.yaml, not in b.yaml",
                                                "P513 Telegram timeout: not in a.yaml, 0.0 s Off in b.yaml"));
  EXPECT_EQ(2u, differencesOf(first, second, known()).compared);
}

// -1 comes as FFFFh over one channel and with its sign over another.
TEST(Comparison, TakesTheSameWordForTheSameValue) {
  EXPECT_THAT(texts(dumpOf({{"P513", -1}}), dumpOf({{"P513", 0xFFFF}})), IsEmpty());
}

TEST(Comparison, LeavesInformationOut) {
  const Differences differences = differencesOf(dumpOf({{"P701[-01]", 0}}), dumpOf({{"P701[-01]", 102}}), known());
  EXPECT_THAT(differences.found, IsEmpty());
  EXPECT_EQ(0u, differences.compared);
}

TEST(Comparison, AsJson) {
  const Differences differences = differencesOf(dumpOf({{"P102 set 1", 200}}), dumpOf({{"P102 set 1", 250}}), known());
  EXPECT_EQ(
      "{\"first\": \"a\", \"second\": \"b\", \"compared\": 1, \"differences\": [{\"parameter\": \"P102 set 1\", "
      "\"number\": "
      "102, \"set\": 1, \"name\": \"Acceleration time\", \"first\": {\"raw\": 200, \"value\": 2, \"unit\": \"s\", "
      "\"text\": "
      "\"2.00 s\"}, \"second\": {\"raw\": 250, \"value\": 2.5, \"unit\": \"s\", \"text\": \"2.50 s\"}}]}\n",
      differencesJson(differences, known(), "a", "b"));
}

// What the drive refuses to read is missing there, and no trouble; silence is.
TEST(Comparison, ReadsOfADriveWhatADumpHas) {
  LinkedDrive drive;
  drive.connect();
  const Dump alike =
      readAlike(drive.link(), dumpOf({{"P102 set 3", 0}, {"P210", 0}, {"P700[-01]", 0}}), drive.notAsked());
  ASSERT_EQ(1u, alike.values.size());
  EXPECT_EQ(200, alike.values[0].raw);
  EXPECT_EQ(1u, alike.missing.size());
  drive.left().pkw().setSilent(true);
  EXPECT_THROW(readAlike(drive.link(), dumpOf({{"P102 set 3", 0}}), drive.notAsked()), Trouble);
  const std::atomic<bool> asked{true};
  EXPECT_THROW(readAlike(drive.link(), dumpOf({{"P102 set 3", 0}}), asked), Trouble);
}

// Settings only: a fault of yesterday is no difference.
TEST(Comparison, FindsInADriveWhatWasChangedSinceItsDump) {
  LinkedDrive drive;
  drive.connect();
  const Dump taken = takeDump(drive.link(), drive.notAsked());
  const auto differences = [&] {
    return differencesOf(taken, readAlike(drive.link(), taken, drive.notAsked()), drive.link().known());
  };
  drive.left().parameters().preset(701, 0, 0, 102);
  EXPECT_TRUE(differences().found.empty());
  EXPECT_GT(differences().compared, 30u);
  drive.left().parameters().preset(102, 2, 0, 250);
  drive.left().parameters().preset(513, 0, 0, -1);
  std::vector<std::string> texts;
  for (const Difference& difference : differences().found) {
    texts.push_back(differenceText(difference, drive.link().known(), "the file", "the drive"));
  }
  EXPECT_THAT(texts, ElementsAre("P102 set 3 Acceleration time: 2.00 s in the file, 2.50 s in the drive",
                                 "P513 Telegram timeout: 0.0 s Off in the file, -0.1 s No error in the drive"));
}

// P509 = 8 means one thing in an SK 300E and another in an SK 5xxE.
TEST(Comparison, IsRefusedBetweenSeries) {
  EXPECT_NO_THROW(refuseOtherSeries("a", profile::Series::kSk5xxe, "b", profile::Series::kSk5xxe));
  EXPECT_THROW(refuseOtherSeries("a", profile::Series::kSk300e, "b", profile::Series::kSk5xxe), UsageError);
}

// P509: factory setting 0; P102: the bus manuals name none.
TEST(ChangedDump, HasDeviationsOnlyAndNamesWhatNobodyKnows) {
  const ChangedDump changed =
      changedOnly(dumpOf({{"P102 set 1", 999}, {"P509", 4}, {"P513", 0}, {"P700[-01]", 102}}), known());
  ASSERT_EQ(1u, changed.dump.values.size());
  EXPECT_EQ("P509", parameterName(changed.dump.values[0].address));
  ASSERT_EQ(1u, changed.unknown.size());
  EXPECT_EQ("P102 set 1", parameterName(changed.unknown[0]));
  const std::string text = changedText(changed, known(), "left", "here");
  EXPECT_THAT(text, HasSubstr("# Only what deviates from the factory setting.\n"));
  EXPECT_THAT(text, HasSubstr("\"P509\": {raw: 4"));
  EXPECT_THAT(text, HasSubstr("# factory setting not known, not in here: P102 set 1\n"));
  EXPECT_THAT(text, Not(HasSubstr("P513")));
}

}  // namespace
}  // namespace nord_driver::tools
