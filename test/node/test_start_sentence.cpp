// The line of the log that says what the node has understood: a drive of an earlier start is seen there.
#include <gtest/gtest.h>

#include "node/parameters.h"
#include "node/ros_settings.h"
#include "node/start_sentence.h"

namespace nord_driver::node {
namespace {

std::vector<DriveIdentity> identitiesOf(const NodeConfig& config) {
  std::vector<DriveIdentity> identities(config.drives.size());
  for (std::size_t i = 0; i < identities.size(); ++i) {
    identities[i].address = "station " + std::to_string(config.cycle.drives[i].address.value_or(0));
  }
  return identities;
}

TEST(StartSentence, NamesTransportBusAndDrives) {
  const NodeConfig config = readNodeConfig(RosSettings{"~", robotParameters()});
  EXPECT_EQ("transport profibus_dp at /dev/ttyUSB0, 2 drives: left (station 3), right (station 4), base differential",
            startSentence(config, identitiesOf(config), "/dev/ttyUSB0"));
}

TEST(StartSentence, SaysThatItWillAcknowledge) {
  XmlRpc::XmlRpcValue value = robotParameters();
  value["acknowledge_at_start"] = std::string{"bus_timeouts"};
  const NodeConfig config = readNodeConfig(RosSettings{"~", value});
  EXPECT_EQ(
      "transport profibus_dp, 2 drives: left (station 3), right (station 4), base differential, bus time-outs (E10) "
      "found at start are acknowledged (acknowledge_at_start)",
      startSentence(config, identitiesOf(config), ""));
}

TEST(StartSentence, ATransportThatOpensNothingIsNowhere) {
  XmlRpc::XmlRpcValue value;
  value["transport"] = std::string{"my_package/my_card"};
  value["drives"]["belt"] = robotParameters()["drives"]["left"];
  const NodeConfig config = readNodeConfig(RosSettings{"~", value});
  EXPECT_EQ("transport my_package/my_card, 1 drive: belt (station 3), no base",
            startSentence(config, identitiesOf(config), ""));
}

}  // namespace
}  // namespace nord_driver::node
