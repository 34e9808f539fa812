// What a network does while the wheels turn, on real connections of the loopback: the driver below ROS and its link in
// real time, a proxy that spoils the network, and the simulated gateway behind it. The bounds are held to the cycle in
// test_interbus_network.cpp, where time is simulated; here is what only sockets, threads and processes show.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <cmath>
#include <fstream>
#include <memory>
#include <string>

#include "cycle/cycle_config.h"
#include "sim/interbus/gateway_bus.h"
#include "support/map_settings.h"
#include "support/second_try.h"
#include "system/driven_robot.h"
#include "system/tcp_proxy.h"
#include "tools/program.h"
#include "transport/interbus/interbus.h"

namespace nord_driver::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::AnyOf;
using ::testing::HasSubstr;

constexpr milliseconds kDriveTimeout{300}, kWatchdog{500}, kP513{200}, kPeriod{10};
/// The base stops two cycles after drive_timeout at most, the inverters when both of their times are over.
constexpr Duration kBaseStops = kDriveTimeout + 2 * kPeriod;
constexpr Duration kWheelsStop = kBaseStops + kWatchdog + kP513 + 2 * kPeriod;
constexpr Duration kBack = seconds{2};
/// A machine that stood still for longer may have spoilt a try.
constexpr std::chrono::duration<double> kStoodStill{0.01};

/// The driver below ROS, two wheels, with a real link.
class LinkedRobot : public DrivenRobot {
 public:
  explicit LinkedRobot(const std::string& gateway) {
    std::vector<DriveSettings> drives;
    for (int i = 0; i < 2; ++i) {
      const std::string name = i == 0 ? "left" : "right";
      auto settings = std::make_shared<MapSettings>("~drives/" + name + "/");
      settings->set("address", 1 + i).set("series", "sk5xxe").set("joint", name + "_wheel_joint");
      settings->set("gear_ratio", 20.0).set("pole_pairs", 2).set("max_frequency", 50.0).set("inverted", i == 1);
      drives.push_back({name, settings});
    }
    const MapSettings node{"~",
                           {{"cycle_rate", 100.0},
                            {"cmd_vel_timeout", 0.2},
                            {"drive_timeout", toSeconds(kDriveTimeout)},
                            {"left_wheel", std::string{"left_wheel_joint"}},
                            {"right_wheel", std::string{"right_wheel_joint"}},
                            {"wheel_separation", 0.5},
                            {"wheel_radius", 0.1}}};
    const MapSettings bus{"~bus/",
                          {{"gateway", gateway},
                           {"outputs/address", 100},
                           {"running/address", 200},
                           {"watchdog/address", 300},
                           {"watchdog/value", static_cast<int>(kWatchdog.count())}}};
    const cycle::CycleConfig config = cycle::readCycleConfig(node, drives);
    auto transport = std::make_unique<InterbusTransport>();
    transport->configure(bus, drives, config.cycle_rate);
    start(config, std::move(transport), false);
  }
  ~LinkedRobot() { transport().close(); }

  bool online() { return snapshot().drives[0].online && snapshot().drives[1].online; }
  bool isOffline() { return !snapshot().drives[0].online && !snapshot().drives[1].online; }
  /// Acknowledges what there is, enables and drives.
  void enableAndDrive() {
    ASSERT_TRUE(runUntil([this] { return online(); })) << transport().busText().c_str();
    run(milliseconds{250});  // the last command is too old by then
    cycle::Completion answer;
    for (const Instant end = transport().now() + seconds{20}; !answer.success && transport().now() < end;) {
      ask(cycle::RequestKind::kAcknowledge);
      answer = ask(cycle::RequestKind::kEnable);  // not before the inverters have charged, and are down their ramps
    }
    ASSERT_TRUE(answer.success) << answer.message.c_str();
    drive(kHalfSpeed, 0.0, milliseconds{500});
    ASSERT_TRUE(snapshot().base.enabled) << snapshot().base.text.c_str();
  }
  void stepCommanded() {
    command(kHalfSpeed);
    step();
  }
};

sim::SimConfig ring() {
  sim::IbsBusConfig bus;
  bus.output_address = 100;
  bus.running = sim::IbsRunning{200, 1, 1};
  bus.watchdog = 300;
  sim::SimConfig config;
  config.bus = bus;
  for (std::uint8_t place = 1; place <= 2; ++place) {
    sim::DriveConfig drive;
    drive.name = place == 1 ? "left" : "right";
    drive.address = place;
    drive.inverted = place == 2;
    drive.parameters = {{102, 0, 0, 30}, {103, 0, 0, 30}, {513, 0, 0, static_cast<std::int32_t>(kP513.count() / 100)}};
    drive.bus = sim::IbsDriveConfig{};
    config.drives.push_back(drive);
  }
  return config;
}

struct Network {
  Network() : proxy(static_cast<std::uint16_t>(std::stoi(bus.where().substr(bus.where().find(':') + 1)))) {}

  bool inverterEnabled() {
    return bus.withModel([](sim::RobotSim& robot) {
      const auto runs = [&](std::size_t i) {
        return robot.drive(i).inverter().state() == sim::InverterState::kOperationEnabled;
      };
      return runs(0) || runs(1);
    });
  }

  sim::GatewayBus bus{ring()};
  TcpProxy proxy;
};

struct Fault {
  const char* name;
  void (*begin)(TcpProxy&);
  void (*end)(TcpProxy&);
  const char* named;  ///< by the bus, when the inverters have stopped
  const char* counter;
};

void PrintTo(const Fault& fault, std::ostream* out) {
  *out << fault.name;
}

void answerOtherTransactions(TcpProxy::Bytes& answer) {
  if (answer.size() > 1) ++answer[1];
}
// Exception 6, "server device busy" (MODBUS Application Protocol V1.1b3, 7).
void answerBusy(TcpProxy::Bytes& answer) {
  if (answer.size() < 8) return;
  answer.resize(9);
  answer[4] = 0;
  answer[5] = 3;
  answer[7] = static_cast<std::uint8_t>(answer[7] | 0x80u);
  answer[8] = 6;
}
void mend(TcpProxy& proxy) {
  proxy.setSpoiler({});
}

constexpr Fault kFaults[] = {
    {"PortClosedAndOpened", [](TcpProxy& proxy) { proxy.setPortOpen(false); },
     [](TcpProxy& proxy) { proxy.setPortOpen(true); }, "refuses the connection", "connect_failures"},
    {"HalfOpen", [](TcpProxy& proxy) { proxy.setCarries(false); }, [](TcpProxy& proxy) { proxy.setCarries(true); },
     "never answered on it", "timeouts"},
    {"HalfASecondOfLatency", [](TcpProxy& proxy) { proxy.setDelay(milliseconds{500}); },
     [](TcpProxy& proxy) { proxy.setDelay({}); }, "too late for the response time-out of 0.300 s", "stale"},
    {"WrongTransactions", [](TcpProxy& proxy) { proxy.setSpoiler(answerOtherTransactions); }, mend,
     "an answer to another request", "bad_answers"},
    {"Exceptions", [](TcpProxy& proxy) { proxy.setSpoiler(answerBusy); }, mend, "exception 6", "exceptions"},
};

class GatewayNetwork : public ::testing::TestWithParam<Fault> {
 protected:
  static void SetUpTestSuite() {
    network_ = new Network;
    robot_ = new LinkedRobot{network_->proxy.address()};
  }
  static void TearDownTestSuite() {
    delete robot_;
    delete network_;
  }
  static LinkedRobot& robot() { return *robot_; }
  static Network& network() { return *network_; }

  void attempt() {
    ASSERT_NO_FATAL_FAILURE(robot().enableAndDrive());
    const Instant begun = robot().transport().now();
    GetParam().begin(network().proxy);
    bool named = false;
    const auto step = [&] {
      robot().stepCommanded();
      named = named || robot().transport().busText().str().find(GetParam().named) != std::string::npos;
    };
    const auto sinceBegun = [&] { return robot().transport().now() - begun; };
    while (robot().snapshot().base.enabled && sinceBegun() < seconds{10}) step();
    base_stopped_ = sinceBegun();
    while (network().inverterEnabled() && sinceBegun() < seconds{10}) step();
    wheels_stopped_ = sinceBegun();
    while (!named && sinceBegun() < seconds{10}) step();
    EXPECT_TRUE(named) << robot().transport().busText().c_str();
    EXPECT_TRUE(robot().isOffline());
    EXPECT_FALSE(robot().snapshot().base.enabled || network().inverterEnabled());

    GetParam().end(network().proxy);
    const Instant ended = robot().transport().now();
    while (!robot().online() && robot().transport().now() - ended < seconds{10}) robot().stepCommanded();
    back_ = robot().transport().now() - ended;
    const Instant until = robot().transport().now() + milliseconds{300};
    while (robot().transport().now() < until) {
      robot().stepCommanded();
      ASSERT_FALSE(robot().snapshot().base.enabled || network().inverterEnabled()) << "nobody has enabled it";
    }
  }
  bool isInTime() const { return base_stopped_ <= kBaseStops && wheels_stopped_ <= kWheelsStop && back_ <= kBack; }

  Duration base_stopped_{}, wheels_stopped_{}, back_{};

 private:
  static LinkedRobot* robot_;
  static Network* network_;
};

LinkedRobot* GatewayNetwork::robot_ = nullptr;
Network* GatewayNetwork::network_ = nullptr;

TEST_P(GatewayNetwork, StopsAndIsBackDisabled) {
  const std::uint64_t counted = robot().transport().counters().value(GetParam().counter);
  tryAgainOnlyIfStoodStill(
      kStoodStill, [this] { attempt(); }, [this] { return isInTime(); });
  EXPECT_LE(toSeconds(base_stopped_), toSeconds(kBaseStops));
  EXPECT_LE(toSeconds(wheels_stopped_), toSeconds(kWheelsStop));
  EXPECT_LE(toSeconds(back_), toSeconds(kBack));
  EXPECT_GT(robot().transport().counters().value(GetParam().counter), counted);
  EXPECT_EQ("no rule broken", network().bus.refereeReport());
}

INSTANTIATE_TEST_SUITE_P(All, GatewayNetwork, ::testing::ValuesIn(kFaults),
                         [](const auto& test) { return std::string{test.param.name}; });

// A reset costs less than drive_timeout: a new connection stands within 50 ms, and nothing stops.
TEST_F(GatewayNetwork, AResetShorterThanDriveTimeoutStopsNothing) {
  ASSERT_NO_FATAL_FAILURE(robot().enableAndDrive());
  const std::uint64_t connections = robot().transport().counters().value("connections");
  bool drives_on = false;
  tryAgainOnlyIfStoodStill(
      kStoodStill,
      [&] {
        network().proxy.reset();
        robot().drive(kHalfSpeed, 0.0, milliseconds{500});
        drives_on = robot().snapshot().base.enabled && network().inverterEnabled();
      },
      [&] { return drives_on; }, [] { robot().enableAndDrive(); });
  EXPECT_TRUE(drives_on) << robot().snapshot().base.text.c_str();
  EXPECT_GT(robot().transport().counters().value("connections"), connections);
  EXPECT_GT(robot().transport().counters().value("closed_connections"), 0u);
}

// The process of the gateway is stopped and goes on (SIGSTOP, SIGCONT): its kernel takes what is sent, nobody answers.
TEST(GatewayProcess, StoppedAndContinued) {
  const std::string file = ::testing::TempDir() + "gateway_" + std::to_string(::getpid()) + ".yaml";
  std::ofstream(file) << R"(
transport: nord_driver/interbus
bus: {outputs: {address: 100}, running: {address: 200}, watchdog: {address: 300}}
drives:
  left: {address: 1, series: sk5xxe, parameters: {P102: 0.3, P103: 0.3, P513: 0.2}}
  right: {address: 2, series: sk5xxe, inverted: true, parameters: {P102: 0.3, P103: 0.3, P513: 0.2}}
)";
  Program gateway{{NORD_SIM_PROGRAM, "--config", file}};
  ASSERT_TRUE(gateway.saysSomething(seconds{10})) << gateway.errors();
  const std::string address = gateway.output().substr(0, gateway.output().find('\n'));
  ASSERT_THAT(address, HasSubstr("127.0.0.1:"));
  LinkedRobot robot{address};
  Duration stopped{}, back{};
  tryAgainOnlyIfStoodStill(
      kStoodStill,
      [&] {
        ASSERT_NO_FATAL_FAILURE(robot.enableAndDrive());
        gateway.signal(SIGSTOP);
        const Instant begun = robot.transport().now();
        while (robot.snapshot().base.enabled && robot.transport().now() - begun < seconds{10}) robot.stepCommanded();
        stopped = robot.transport().now() - begun;
        bool named = false;
        while (!named && robot.transport().now() - begun < seconds{10}) {
          robot.stepCommanded();
          const std::string text = robot.transport().busText().str();
          named = text.find("answer") != std::string::npos && text.find(address) == 0;
        }
        EXPECT_TRUE(named) << robot.transport().busText().c_str();
        gateway.signal(SIGCONT);
        const Instant ended = robot.transport().now();
        while (!robot.online() && robot.transport().now() - ended < seconds{10}) robot.stepCommanded();
        back = robot.transport().now() - ended;
        // The models stood still as well: told to stop by the first words, they come down their ramp.
        robot.drive(kHalfSpeed, 0.0, milliseconds{800});
        EXPECT_FALSE(robot.snapshot().base.enabled);
        for (int i = 0; i < 20; ++i) {
          robot.stepCommanded();
          ASSERT_EQ(0, robot.statusWord(0) & 0x0004) << "operation enabled";
          ASSERT_EQ(0, robot.statusWord(1) & 0x0004) << "operation enabled";
        }
      },
      [&] { return stopped <= kBaseStops && back <= kBack; });
  EXPECT_LE(toSeconds(stopped), toSeconds(kBaseStops));
  EXPECT_LE(toSeconds(back), toSeconds(kBack));
  ASSERT_NO_FATAL_FAILURE(robot.enableAndDrive());
  gateway.signal(SIGTERM);
  EXPECT_EQ(0, gateway.wait(seconds{10}));
  EXPECT_THAT(gateway.output(), HasSubstr("referee: no rule broken"));
  ::unlink(file.c_str());
}

}  // namespace
}  // namespace nord_driver::test
