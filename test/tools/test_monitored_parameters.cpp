// drives/<name>/monitor: what may stand there.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "catalogue/shipped.h"
#include "config/yaml_settings.h"
#include "tools/monitored_parameters.h"

namespace nord_driver::tools {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

DriveSettings drive() {
  return {"left", std::make_shared<YamlSettings>("drives/left", YAML::Node{})};
}

catalogue::DriveCatalogue known(profile::Series series = profile::Series::kSk5xxe) {
  return {catalogue::shippedCatalogues(), series, std::nullopt};
}

DriveIdentity identity(const char* channel = "PKW") {
  DriveIdentity identity;
  identity.parameter_channel = channel;
  return identity;
}

std::vector<MonitoredParameter> monitored(const std::vector<std::string>& words) {
  static const catalogue::DriveCatalogue kKnown = known();
  return monitoredParameters(drive(), words, kKnown, identity());
}

std::vector<std::string> labels(const std::vector<std::string>& words) {
  std::vector<std::string> list;
  for (const MonitoredParameter& parameter : monitored(words)) list.push_back(parameter.label);
  return list;
}

std::string refusal(const std::vector<std::string>& words, const DriveIdentity& of = identity()) {
  try {
    monitoredParameters(drive(), words, known(), of);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(MonitoredParameters, AreNumbersOrNamesWithIndexAndSet) {
  EXPECT_THAT(labels({"746", "P700[-02]", "p105 set 2", "Maximum frequency", "Current error[-03]"}),
              ElementsAre("P746", "P700[-02]", "P105 set 2", "P105", "P700[-03]"));
  EXPECT_THAT(labels({}), IsEmpty());
}

// The set in force where none is given; the first element of an array, which the label then names.
TEST(MonitoredParameters, HaveTheirDefaults) {
  const auto list = monitored({"P105", "P700"});
  EXPECT_EQ(0, list[0].access.request.parameter_set);
  EXPECT_EQ(profile::ParameterShape::kPerSet, list[0].access.request.shape);
  EXPECT_EQ("P700[-01]", list[1].label);
  EXPECT_EQ(1, list[1].access.request.index);
}

// Nobody has described it here; the drive may know it all the same.
TEST(MonitoredParameters, ANumberOfNoCatalogueIsReadRawAndWarnedAbout) {
  const auto list = monitored({"P719", "P746"});
  EXPECT_EQ("P719", list[0].label);
  EXPECT_EQ(nullptr, list[0].access.entry);
  EXPECT_THAT(notInCatalogue(drive(), list),
              ElementsAre("drives/left/monitor: P719 is not in the catalogue: its raw value is shown, without a name "
                          "and a unit, unless a file of parameter_files describes it"));
}

TEST(MonitoredParameters, WhatIsNoneIsRefused) {
  EXPECT_EQ("drives/left/monitor: \"P1719\" is no parameter, expected the manual's number: 105, P105 or P700[-01]",
            refusal({"P1719"}));
  EXPECT_EQ("drives/left/monitor: \"Maximum frequenzy\" is not valid, expected perhaps \"Maximum frequency\"",
            refusal({"Maximum frequenzy"}));
  EXPECT_EQ("drives/left/monitor: \"P701[-06]\" is not valid, expected an element [-01] to [-5] of this array",
            refusal({"P701[-06]"}));
  EXPECT_EQ("drives/left/monitor: P105 is no array, expected index 0, not 2", refusal({"P105[-02]"}));
  EXPECT_EQ(
      "drives/left/monitor: \"P746 set 2\" is not valid, expected no set: this parameter is the same in all of them",
      refusal({"P746 set 2"}));
  EXPECT_EQ("drives/left/monitor: \"746\" is not valid, expected each parameter once: P746 stands there",
            refusal({"P746", "746"}));
}

TEST(MonitoredParameters, AreReadOverAParameterChannelOrNotAtAll) {
  EXPECT_EQ(
      "drives/left/monitor: \"P746\" is not valid, expected none: this drive has no parameter channel to read it "
      "from",
      refusal({"P746"}, identity("none")));
  EXPECT_EQ("accepted", refusal({}, identity("none")));
}

TEST(MonitoredParameters, AreNotTooMany) {
  std::vector<std::string> words;
  for (unsigned i = 0; i < kMaxMonitored; ++i) words.push_back(std::to_string(100 + i));
  EXPECT_EQ("accepted", refusal(words));
  words.emplace_back("P746");
  EXPECT_EQ("drives/left/monitor: a list of 33 parameters is not valid, expected at most 32", refusal(words));
}

}  // namespace
}  // namespace nord_driver::tools
