// The link of nord_param to drives of a simulated InterBus ring, over a TCP connection of the loopback.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "catalogue/shipped.h"
#include "sim/interbus/gateway_bus.h"
#include "sim/sim_config.h"
#include "tools/parameter_link.h"
#include "tools/write_value.h"
#include "transport/interbus/interbus.h"

namespace nord_driver::tools {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// Three SK 5xxE whose references and offsets follow from their places, P105 = 50, 60 and 70 Hz; one is asked for.
class RingedDrive : public ::testing::Test {
 protected:
  static YAML::Node file() {
    return YAML::Load(
        "{transport: interbus, cycle_rate: 100, bus: {gateway: '127.0.0.1:0', outputs: {address: 100},"
        " running: {address: 200}, watchdog: {address: 300, value: 500},"
        " pcp: {invoke: {address: 500}, result: {address: 600}}},"
        " drives: {left: {address: 1, series: sk5xxe, pole_pairs: 2},"
        "  lift: {address: 3, series: sk5xxe, pole_pairs: 2, parameters: {P105: 70.0}},"
        "  right: {address: 2, series: sk5xxe, pole_pairs: 2, parameters: {P105: 60.0}}}}");
  }
  static ToolConfig configOf(const std::string& gateway) {
    YAML::Node node = file();
    node["bus"]["gateway"] = gateway;
    return readToolConfig(node, "right");
  }

  void connect() { link_.connect(seconds{20}, not_asked_); }
  /// P105 of the first set, as the inverter has it.
  std::vector<int> maxFrequencies() {
    return sim_.withModel([](sim::RobotSim& robot) {
      std::vector<int> raw;
      for (DriveIndex i = 0; i < 3; ++i) raw.push_back(static_cast<int>(robot.drive(i).parameters().value(105, 0)));
      return raw;
    });
  }
  sim::InverterState stateOf(DriveIndex drive) {
    return sim_.withModel([drive](sim::RobotSim& robot) { return robot.drive(drive).inverter().state(); });
  }
  /// Until the reaction is over: before that it is not at rest.
  void trip(DriveIndex drive) {
    sim_.withModel([drive](sim::RobotSim& robot) { robot.drive(drive).inverter().trip(41, false); });
    const Instant end = transport_.now() + seconds{10};
    while (stateOf(drive) != sim::InverterState::kFault && transport_.now() < end) {
      transport_.sleepUntil(transport_.now() + milliseconds{1});
    }
    ASSERT_EQ(sim::InverterState::kFault, stateOf(drive));
  }
  /// By its terminals, as somebody beside this program does.
  void turn(DriveIndex drive) {
    sim_.withModel([drive](sim::RobotSim& robot) { robot.drive(drive).inverter().setLocalControl(true, 0.0); });
    link_.exchangeUntil(link_.now() + milliseconds{300}, not_asked_);
    sim_.withModel([drive](sim::RobotSim& robot) { robot.drive(drive).inverter().setLocalControl(true, 20.0); });
    link_.exchangeUntil(link_.now() + milliseconds{300}, not_asked_);
    ASSERT_EQ(sim::InverterState::kOperationEnabled, stateOf(drive));
  }

  sim::GatewayBus sim_{sim::readSimConfig(file())};
  ToolConfig config_ = configOf(sim_.where());
  InterbusTransport transport_;
  ParameterLink link_{config_, transport_, catalogue::shippedCatalogues()};
  std::atomic<bool> not_asked_{false};
};

catalogue::ParameterAddress maxFrequency() {
  catalogue::ParameterAddress address;
  address.number = 105;
  address.parameter_set = 1;
  return address;
}

TEST_F(RingedDrive, TheOneThatIsNamedIsReadAndWritten) {
  connect();
  const ParameterAnswer answer = link_.read(maxFrequency());
  ASSERT_TRUE(answer.success) << answer.message;
  EXPECT_DOUBLE_EQ(60.0, answer.value);
  catalogue::ParameterWrite write;
  write.value = 55.0;
  const ParameterAnswer written = writeValue(link_, maxFrequency(), write);
  EXPECT_TRUE(written.success) << written.message;
  EXPECT_THAT(maxFrequencies(), ::testing::ElementsAre(500, 700, 550));
}

// No word of this program gets into the image, so that none gets to it.
TEST_F(RingedDrive, AnotherOneMayRun) {
  turn(0);
  connect();
  const ParameterAnswer answer = link_.read(maxFrequency());
  EXPECT_TRUE(answer.success) << answer.message;
  EXPECT_EQ(sim::InverterState::kOperationEnabled, stateOf(0));
}

TEST_F(RingedDrive, TheOneThatIsNamedMayNot) {
  turn(2);
  try {
    connect();
    ADD_FAILURE() << "connected";
  } catch (const Trouble& trouble) {
    EXPECT_THAT(trouble.what(), ::testing::HasSubstr("drive right is not at rest (operation enabled)"));
  }
}

// Nothing watches for words that were never sent.
TEST_F(RingedDrive, ItsEndTripsNothing) {
  connect();
  catalogue::ParameterAddress timeout;
  timeout.number = 513;
  catalogue::ParameterWrite write;
  write.value = 1.0;
  const ParameterAnswer written = writeValue(link_, timeout, write);
  ASSERT_TRUE(written.success) << written.message;
  EXPECT_THAT(link_.finish(), ::testing::IsEmpty());
  EXPECT_EQ(0u, sim_.withGateway([](sim::IbsRing&, sim::RegisterGateway& gateway) { return gateway.watchdogTrips(); }));
}

// Somebody else has: the driver that has the gateway's outputs, or whoever stands before the drive.
TEST_F(RingedDrive, AFaultThatEndedMeanwhileWasNotAcknowledgedByThisProgram) {
  trip(2);
  connect();
  sim_.withModel([](sim::RobotSim& robot) { EXPECT_TRUE(robot.drive(2).inverter().acknowledge()); });
  link_.exchangeUntil(link_.now() + milliseconds{300}, not_asked_);
  ASSERT_FALSE(link_.snapshot(0).fault);
  EXPECT_EQ("", link_.changedByReading());
}

}  // namespace
}  // namespace nord_driver::tools
