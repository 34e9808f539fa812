#include "sim_node/sim_node_fixture.h"

namespace nord_driver::sim_node {

void SimNodeTest::SetUp() {
  set("left/unplug", true);
  call<SimAnswerDelay>("left/answer_delay", {});
  call<SimParameterChannel>("left/parameter_channel", {});
  call<SimTerminals>("left/terminals", {});
  set("left/local_control", false);
  set("left/mute", false);
  set("left/module_link", true);
  set("left/unplug", false);
  std::string device;
  ASSERT_TRUE(ros::param::get("/nord_sim/bus/device", device));
  bus = std::make_unique<BusClient>(device);
  ASSERT_TRUE(eventually([](const SimDrive& drive) { return drive.status_word == 0x0B70; }));
}

std::string SimNodeTest::trigger(const std::string& service) {
  const std_srvs::Trigger::Response response = call<std_srvs::Trigger>(service, {});
  return (response.success != 0 ? "yes, " : "no, ") + response.message;
}

std::string SimNodeTest::set(const std::string& service, bool data) {
  std_srvs::SetBool::Request request;
  request.data = data;
  const std_srvs::SetBool::Response response = call<std_srvs::SetBool>(service, request);
  return (response.success != 0 ? "yes, " : "no, ") + response.message;
}

SimDrive SimNodeTest::truth() {
  const auto message = ros::topic::waitForMessage<SimDrive>("/nord_sim/truth/left", ros::Duration(10.0));
  EXPECT_TRUE(message != nullptr);
  return message != nullptr ? *message : SimDrive{};
}

bool SimNodeTest::eventually(const std::function<bool(const SimDrive&)>& likes) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (std::chrono::steady_clock::now() < end) {
    if (likes(truth())) return true;
  }
  return false;
}

}  // namespace nord_driver::sim_node
