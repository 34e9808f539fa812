// How parameters are named, and which of them a dump has.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>

#include "catalogue/shipped.h"
#include "tools/parameter_name.h"

namespace nord_driver::tools {
namespace {

using ::testing::Each;
using ::testing::HasSubstr;

catalogue::ParameterAddress parsed(const std::string& name) {
  return parseParameterName(name);
}

catalogue::DriveCatalogue drive(profile::Series series, std::optional<catalogue::Module> module = std::nullopt) {
  return {catalogue::shippedCatalogues(), series, module};
}

std::string refusal(const std::string& name) {
  try {
    parseParameterName(name);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "accepted";
}

// As the manual writes it, with or without the P.
TEST(ParameterName, TakesTheManualsForms) {
  EXPECT_EQ(105, parsed("105").number);
  EXPECT_EQ(105, parsed("P105").number);
  EXPECT_EQ(105, parsed("p105").number);
  EXPECT_EQ(0, parsed("P105").index);
  EXPECT_EQ(0, parsed("P105").parameter_set);
  EXPECT_EQ(700, parsed("P700[-01]").number);
  EXPECT_EQ(1, parsed("P700[-01]").index);
  EXPECT_EQ(13, parsed("740[-13]").index);
  EXPECT_EQ(2, parsed("P546[-02] set 3").index);
  EXPECT_EQ(3, parsed("P546[-02] set 3").parameter_set);
}

TEST(ParameterName, RefusesWhatIsNone) {
  for (const char* name : {"", "P", "P1050", "105x", "P105[", "P105[]", "P105[-001]", "-105", "P105 set 5", "1e2"}) {
    EXPECT_THAT(refusal(name), HasSubstr("is no parameter, expected the manual's number")) << name;
  }
  EXPECT_THAT(refusal("P510[0]"), HasSubstr("array elements are counted from [-01]"));
}

// A dump is read by the names it was written with.
TEST(ParameterName, IsWrittenAsItIsRead) {
  for (const char* name : {"P105", "P006", "P105 set 4", "P700[-01]", "P546[-02] set 3"}) {
    EXPECT_EQ(name, parameterName(parseParameterName(name)));
  }
}

// By the name in the files, in any case, with element and set as of a number.
TEST(ParameterName, MayBeTheNameInTheCatalogue) {
  const catalogue::DriveCatalogue known = drive(profile::Series::kSk54xe);
  EXPECT_EQ(105, findParameter("Maximum frequency", known).number);
  EXPECT_EQ(105, findParameter("P105", known).number);
  EXPECT_EQ(3, findParameter("maximum FREQUENCY set 3", known).parameter_set);
  const auto element = findParameter("Bus actual value[-02] set 4", known);
  EXPECT_EQ("P543[-02] set 4", parameterName(element));
  for (const char* text : {"", "P", "1e2", "P1050", "P105 set 5"}) {
    EXPECT_THROW(findParameter(text, known), UsageError) << text;
  }
  try {
    findParameter("Maximum frequencies", known);
    FAIL() << "accepted";
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), HasSubstr("perhaps \"Maximum frequency\""));
  }
}

// Each set and each element once: P105 has four sets, P700 three elements, P509 neither.
TEST(ParameterName, KnowsEveryValueOfASeries) {
  std::vector<std::string> names;
  for (const auto& address : knownParameters(drive(profile::Series::kSk5xxe))) names.push_back(parameterName(address));
  EXPECT_THAT(names, ::testing::IsSupersetOf({"P105 set 1", "P105 set 4", "P509", "P700[-01]", "P700[-03]"}));
  for (const char* absent : {"P105", "P105 set 5", "P700", "P700[-04]", "P509 set 1"}) {
    EXPECT_THAT(names, Each(::testing::StrNe(absent)));
  }
}

// They reset the inverter to its factory settings: never read in a row with others, never in a file.
TEST(ParameterName, NeverListsWhatResetsTheInverter) {
  for (const profile::Series series : profile::kAllSeries) {
    for (const auto& address : knownParameters(drive(series, catalogue::Module::kProfibus))) {
      EXPECT_NE(152, address.number);
      EXPECT_NE(970, address.number);
    }
  }
}

TEST(ParameterName, TellsSettingsFromInformation) {
  EXPECT_TRUE(isSetting(parseParameterName("P105")));
  EXPECT_TRUE(isSetting(parseParameterName("P699")));
  EXPECT_FALSE(isSetting(parseParameterName("P700[-01]")));
  EXPECT_FALSE(isSetting(parseParameterName("P799")));
  EXPECT_TRUE(isSetting(parseParameterName("P800")));
  EXPECT_TRUE(isSetting(parseParameterName("P151")));
  EXPECT_FALSE(isSetting(parseParameterName("P176[-01]")));
}

}  // namespace
}  // namespace nord_driver::tools
