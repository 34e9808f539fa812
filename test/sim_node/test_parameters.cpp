#include <nord_driver/SimSetParameter.h>

#include "sim_node/sim_node_fixture.h"

namespace nord_driver::sim_node {
namespace {

class Parameters : public SimNodeTest {
 protected:
  /// The answer to an order: what stands in the second telegram.
  std::string order(const std::string& pkw) {
    bus->pzd("047E 0000");
    bus->exchange(pkw, "047E 0000");
    return bus->exchange(pkw, "047E 0000").substr(0, 23);
  }
};

// Set at the device: seen over the bus, not counted as a write.
TEST_F(Parameters, AreSetAtTheDevice) {
  SimSetParameter::Request request;
  request.number = 105;
  request.parameter_set = 3;
  request.raw = 700;
  EXPECT_EQ("left: P105 is 700", call<SimSetParameter>("left/set_parameter", request).message);
  bus->startUp();
  EXPECT_EQ("44 51 02 00 00 00 02 BC", order("6451 0200 0000 0000"));
  EXPECT_EQ("44 51 01 00 00 00 01 F4", order("6451 0100 0000 0000"));
  EXPECT_EQ(0u, truth().eeprom_writes);

  request.number = 999;
  const auto refused = call<SimSetParameter>("left/set_parameter", request);
  EXPECT_FALSE(refused.success);
  EXPECT_EQ("left: no parameter P999 with set 3 and index 0", refused.message);
}

// A write over the bus counts, unless it is for RAM only.
TEST_F(Parameters, CountTheirWrites) {
  bus->startUp();
  const std::uint64_t before = truth().eeprom_writes;
  EXPECT_EQ("44 4E 02 00 00 00 03 E8", order("C44E 0200 0000 03E8"));
  EXPECT_EQ(before, truth().eeprom_writes);
  EXPECT_EQ("44 4E 02 00 00 00 03 E8", order("744E 0200 0000 03E8"));
  EXPECT_EQ(before + 1, truth().eeprom_writes);
}

// Any error number for one parameter or for all, and a channel that never answers.
TEST_F(Parameters, ChannelCanBeSpoilt) {
  bus->startUp();
  SimParameterChannel::Request request;
  request.refuse = true;
  request.error = 101;
  request.number = 105;
  EXPECT_EQ("left: P105 is refused with error 101",
            call<SimParameterChannel>("left/parameter_channel", request).message);
  EXPECT_EQ("74 51 00 00 00 00 00 65", order("1451 0000 0000 0000"));
  EXPECT_EQ("14 4F 00 00 00 00 00 C8", order("144F 0000 0000 0000"));  // P103
  request.number = 0;
  request.error = 103;
  EXPECT_EQ("left: every order is refused with error 103",
            call<SimParameterChannel>("left/parameter_channel", request).message);
  EXPECT_EQ("74 4F 00 00 00 00 00 67", order("144F 0000 0000 0000"));

  SimParameterChannel::Request silent;
  silent.silent = true;
  EXPECT_EQ("left: the parameter channel is silent",
            call<SimParameterChannel>("left/parameter_channel", silent).message);
  EXPECT_EQ("74 4F 00 00 00 00 00 67", order("1451 0000 0000 0000"));
  EXPECT_EQ("left: the parameter channel answers", call<SimParameterChannel>("left/parameter_channel", {}).message);
  EXPECT_EQ("14 51 00 00 00 00 01 F4", order("1451 0000 0000 0000"));
}

}  // namespace
}  // namespace nord_driver::sim_node
