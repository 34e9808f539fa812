// The parameters of drives/<name>/monitor as ~<drive>/values shows them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "catalogue/shipped.h"
#include "node/drive_values.h"
#include "node/ros_settings.h"

namespace nord_driver::node {
namespace {

using ::testing::IsEmpty;
using State = cycle::MonitoredValue::State;

class DriveValuesTest : public ::testing::Test {
 protected:
  DriveValuesTest() {
    DriveIdentity identity;
    identity.parameter_channel = "PKW";
    const DriveSettings drive{"left", std::make_shared<RosSettings>("~drives/left", XmlRpc::XmlRpcValue{})};
    parameters_ = tools::monitoredParameters(drive, {"P102", "P746", "P719"}, known_, identity);
    snapshot_.online = true;
    snapshot_.monitored.resize(3);
  }
  std::vector<ParameterValue> values() const { return DriveValues{known_, parameters_}.values(snapshot_); }
  void read(std::size_t index, std::int32_t raw) {
    snapshot_.monitored[index].state = State::kKnown;
    snapshot_.monitored[index].raw = raw;
  }

  const catalogue::DriveCatalogue known_{catalogue::shippedCatalogues(), profile::Series::kSk5xxe, std::nullopt};
  std::vector<tools::MonitoredParameter> parameters_;
  cycle::DriveSnapshot snapshot_;
};

TEST_F(DriveValuesTest, HaveNameValueUnitAndWords) {
  read(0, 150);
  read(1, 0x0603);
  read(2, 42);
  const auto list = values();
  ASSERT_EQ(3u, list.size());
  EXPECT_EQ("P102", list[0].parameter);
  EXPECT_EQ("Acceleration time", list[0].name);
  EXPECT_DOUBLE_EQ(1.5, list[0].value);
  EXPECT_EQ("s", list[0].unit);
  EXPECT_EQ("1.50 s", list[0].text);
  EXPECT_EQ("0603h: Bus interface ready, Connected to the master, Bus interface ID PROFIBUS", list[1].text);
  EXPECT_DOUBLE_EQ(0x0603, list[1].value);
}

// As read, and without words: nobody has described it.
TEST_F(DriveValuesTest, WhatIsInNoCatalogueIsRaw) {
  read(2, 42);
  const ParameterValue value = values()[2];
  EXPECT_EQ("P719", value.parameter);
  EXPECT_EQ("", value.name);
  EXPECT_DOUBLE_EQ(42.0, value.value);
  EXPECT_EQ("", value.unit);
  EXPECT_EQ("42", value.text);
}

TEST_F(DriveValuesTest, WhatIsNotKnownIsNoNumberAndSaysWhy) {
  snapshot_.monitored[0].state = State::kRefused;
  snapshot_.monitored[0].why = "drive left refuses P102: PKW error 0";
  snapshot_.monitored[1].state = State::kNoAnswer;
  snapshot_.monitored[1].why = "drive left gave no answer for P746";
  const auto list = values();
  for (const ParameterValue& value : list) EXPECT_TRUE(std::isnan(value.value)) << value.parameter;
  EXPECT_EQ("drive left refuses P102: PKW error 0", list[0].text);
  EXPECT_EQ("s", list[0].unit);
  EXPECT_EQ("drive left gave no answer for P746", list[1].text);
  EXPECT_EQ("not read yet", list[2].text);
}

TEST_F(DriveValuesTest, ADriveThatIsAwayHasNone) {
  read(0, 150);
  snapshot_.online = false;
  EXPECT_TRUE(std::isnan(values()[0].value));
  EXPECT_EQ("the drive does not answer", values()[0].text);
}

TEST_F(DriveValuesTest, WithoutAListThereAreNone) {
  const DriveValues none{known_, {}};
  EXPECT_TRUE(none.empty());
  EXPECT_THAT(none.values(snapshot_), IsEmpty());
}

}  // namespace
}  // namespace nord_driver::node
