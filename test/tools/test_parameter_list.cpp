// What nord_param tells of parameters without a bus.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "catalogue/shipped.h"
#include "tools/parameter_list.h"
#include "tools/parameter_name.h"
#include "transport/profibus/profibus_dp.h"

namespace nord_driver::tools {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// Two drives behind one module SK CU4, and one with a technology unit.
class ParameterList : public ::testing::Test {
 protected:
  ParameterList() { transport_.configure(*config_.bus, config_.drives, config_.cycle.cycle_rate); }
  std::string describe(const std::string& name) {
    return descriptionText(config_, transport_, catalogue::shippedCatalogues(), name);
  }

  ProfibusDpTransport transport_;
  ToolConfig config_ =
      readToolConfig(YAML::Load("{bus: {device: here, baud_rate: 500000}, drives: {"
                                "front: {address: 5, series: sk2xxe, inverter: 1, ppo_type: 1, pole_pairs: 2},"
                                "rear: {address: 5, series: sk2xxe, inverter: 2, ppo_type: 1, pole_pairs: 2},"
                                "lift: {address: 6, series: sk5xxe, ppo_type: 1, pole_pairs: 2}}}"),
                     transport_.endPoint());
};

TEST_F(ParameterList, HasEveryKindOfDriveOnceWithItsModule) {
  const std::string text = listText(config_, transport_, catalogue::shippedCatalogues());
  EXPECT_THAT(text, StartsWith("Drives:\n  front "));
  EXPECT_THAT(text, HasSubstr("\nParameters known of sk2xxe (front, rear); others are read and written raw:\n"));
  EXPECT_THAT(text, HasSubstr("\nParameters known of sk5xxe (lift); others are read and written raw:\n"));
  EXPECT_THAT(text, HasSubstr("  P151  Timeout for external bus          -0.001 to 32.767 s     \n"));
  EXPECT_THAT(text, HasSubstr("  P152  Factory setting                   0 to 1                 never written\n"));
  EXPECT_THAT(text, HasSubstr("array of 3, read only\n"));
  EXPECT_THAT(text.substr(text.find("of sk5xxe")), Not(HasSubstr("P151")));
}

TEST_F(ParameterList, DescribesOneParameter) {
  const std::string text = describe("Source control word");
  EXPECT_THAT(text, HasSubstr("sk5xxe (lift): P509 Source control word\n  range      0 to 10\n"));
  EXPECT_THAT(describe("P509"), HasSubstr("sk2xxe (front, rear): P509 Control word source\n"));
  EXPECT_THAT(text, HasSubstr("    4        PROFIBUS\n"));
  EXPECT_THAT(text, HasSubstr("  source     BU 0020, 6.2.2"));
  EXPECT_THAT(describe("P740"), HasSubstr("    [-02]    Setpoint 1\n"));
  EXPECT_THAT(describe("P746"), HasSubstr("  bits\n    0        "));
  EXPECT_THROW(describe("P999"), UsageError);
}

TEST_F(ParameterList, AsJson) {
  const std::string text = listJson(config_, transport_, catalogue::shippedCatalogues(), "P509");
  EXPECT_THAT(text,
              StartsWith("{\"drives\": [{\"name\": \"front\", \"address\": \"PROFIBUS station 5, inverter 1\", "));
  EXPECT_THAT(text,
              HasSubstr("{\"series\": \"sk5xxe\", \"drives\": \"lift\", \"parameters\": [{\"parameter\": \"P509\", "
                        "\"number\": 509, \"name\": \"Source control word\", \"unit\": \"\", \"resolution\": 1, "
                        "\"lowest\": 0, \"highest\": 10, "));
  EXPECT_THAT(text, HasSubstr("{\"first\": 4, \"last\": 4, \"name\": \"PROFIBUS\"}"));
  EXPECT_THAT(listJson(config_, transport_, catalogue::shippedCatalogues(), ""), HasSubstr("\"parameter\": \"P105\""));
  EXPECT_THROW(listJson(config_, transport_, catalogue::shippedCatalogues(), "P999"), UsageError);
}

}  // namespace
}  // namespace nord_driver::tools
