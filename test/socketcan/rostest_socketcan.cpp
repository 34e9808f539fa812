// What happens to the kernel's CAN interface under a robot that drives: driver and simulator at the two ends of a pair
// of virtual interfaces, which this program makes, spoils and takes away.
#include <gmock/gmock.h>
#include <linux/can/error.h>
#include <signal.h>

#include <array>
#include <cmath>
#include <vector>

#include "link/can/socket_can.h"
#include "rostest/robot_under_test.h"
#include "rostest/write_parameter.h"
#include "socketcan/network.h"

namespace nord_driver::test {
namespace {

using link::BareSocket;
using link::ip;
using link::tc;
using ::testing::AllOf;
using ::testing::HasSubstr;

// The driver's end and the drives' end; the launch file has the names, too.
constexpr const char* kNear = "nord_near";
constexpr const char* kFar = "nord_far";
constexpr double kSpeed = 0.3;    // m/s
constexpr double kTurning = 1.0;  // rad/s at the wheel

/// What the bus of this run carries, beside `BusUnderTest`. The drives have the addresses 3 and 4.
struct OnTheWire {
  std::vector<std::uint32_t> of_driver;  ///< identifiers nobody but the driver sends on
  std::vector<std::uint32_t> first;      ///< on which it sends before anything else
  Seconds pause;                         ///< after each of these, at least
  CanFrame of_another_master;            ///< process data for the right drive; control word 0 changes nothing
};

const OnTheWire& wire() {
  static const OnTheWire canopen{
      {0x000, 0x203, 0x204, 0x603, 0x604}, {0x000}, Seconds{0}, dataFrame(0x204, std::array<std::uint8_t, 4>{})};
  // Explicit requests, polls and requests to allocate; the duplicate-MAC check of MAC id 0, one second twice, of which the
  // stamps may lack what the machine stood still before the first was sent.
  static const OnTheWire devicenet{{0x407, 0x41C, 0x41D, 0x41E, 0x424, 0x425, 0x426},
                                   {0x407, 0x407},
                                   Seconds{0.5},
                                   dataFrame(0x425, std::array<std::uint8_t, 5>{})};
  return ros::param::param("nord_driver/transport", std::string{}) == "nord_driver/devicenet" ? devicenet : canopen;
}

/// Each test finds the robot driving, takes the bus away, and leaves it at rest with a bus that works.
class SocketCanRobot : public RobotTest {
 protected:
  static void SetUpTestSuite() {
    addPair();
    // What is not read stays: the first frames are the start of the driver, whatever comes later.
    link::SocketCan beside{link::settingsFor(kFar, wire().of_driver)};
    ASSERT_TRUE(beside.open()) << beside.lastError();
    simulator = std::make_unique<NodeProcess>(kSimulatorProgram, std::vector<std::string>{"__name:=nord_sim"});
    driver = std::make_unique<NodeProcess>(kDriverProgram, std::vector<std::string>{"__name:=nord_driver"});
    // An emulated machine takes a minute to start them.
    EXPECT_TRUE(robot().waitForDrivesOnline(2.0 * kPatience)) << simulator->errorText() << driver->errorText();
    link::ReceivedCanFrame frame;
    while (start.size() <= wire().first.size() && beside.receive(frame)) start.push_back(frame);
  }
  static void TearDownTestSuite() {
    driver.reset();
    simulator.reset();
    if (link::exists(kNear)) removePair();
  }
  void SetUp() override {
    RobotTest::SetUp();
    ASSERT_TRUE(robot().waitForDrivesOnline());
    enableAndDrive(kSpeed);
    from_ = {robot().left.truth.mark(), robot().right.truth.mark()};
  }
  void TearDown() override {
    if (HasFailure()) std::fputs(driver->errorText().c_str(), stderr);
    // Not asked for: the referee. Over a bus that fails a master cannot know that a node has left its state.
    robot().silence();
  }

  static void addPair() {
    ip(std::string("link add dev ") + kNear + " type vxcan peer name " + kFar);
    ip(std::string("link set ") + kNear + " up");
    ip(std::string("link set ") + kFar + " up");
  }
  static void removePair() { ip(std::string("link del ") + kNear); }

  /// Nobody works with the nodes any more: the inverters trip E10.0 or E10.2, and the wheels coast to rest.
  void expectDrivesStopThemselves() {
    const std::array<DriveTopics*, 2> drives{&robot().left, &robot().right};
    for (std::size_t i = 0; i < drives.size(); ++i) {
      const auto off =
          drives[i]->truth.waitFrom(from_[i], [](const SimDrive& truth) { return !truth.operation_enabled; });
      ASSERT_TRUE(off);
      EXPECT_EQ(off->fault_number, bus().master_lost);
      EXPECT_GT(std::fabs(off->wheel_velocity), kTurning) << "it coasts";
    }
    EXPECT_TRUE(robot().waitForStandstill());
  }
  /// The bus does not work, and why is said where a technician looks.
  void expectBusLost(const std::string& why) {
    const auto status = robot().bus_status.waitNext([&](const BusStatus& bus) {
      return !bus.connected && bus.offline.size() == 2 && bus.text.find(why) != std::string::npos;
    });
    ASSERT_TRUE(status) << "nobody says: " << why << "; but: " << robot().bus_status.next()->text;
    EXPECT_THAT(robot().waitForDiagnostics("bus", isError), HasSubstr(why));
    EXPECT_THAT(robot().waitForDiagnostics("base", isError), AllOf(HasSubstr("stopped"), HasSubstr("silent")));
  }
  /// Both drives are online again, at rest though commands go on; the fault they were left with is said, and kept until
  /// somebody acknowledges it.
  void expectBackAtRest() {
    EXPECT_TRUE(robot().waitForDrivesOnline());
    EXPECT_TRUE(
        robot().bus_status.waitNext([](const BusStatus& bus) { return bus.connected && bus.online.size() == 2; }));
    robot().drive(0.0);
    EXPECT_THAT(refusalOfEnable(), HasSubstr("fault"));
    for (DriveTopics* drive : {&robot().left, &robot().right}) {
      const auto truth = drive->truth.next();
      EXPECT_FALSE(truth->operation_enabled);
      EXPECT_LT(std::fabs(truth->wheel_velocity), 1e-2);
    }
    acknowledge();
  }
  static void acknowledge() {
    Answer answer;
    EXPECT_TRUE(eventually([&] { return (answer = robot().trigger("acknowledge_faults")).success; })) << answer;
    EXPECT_TRUE(robot().waitForRest());
  }

  static std::unique_ptr<NodeProcess> simulator, driver;
  static std::vector<link::ReceivedCanFrame> start;  // of the driver, on the wire
  std::array<std::size_t, 2> from_{};                // in the truth of left and right
};
std::unique_ptr<NodeProcess> SocketCanRobot::simulator, SocketCanRobot::driver;
std::vector<link::ReceivedCanFrame> SocketCanRobot::start;

// On DeviceNet nothing but two questions for its MAC id, each followed by a second of silence.
TEST_F(SocketCanRobot, StartsAsItsBusDemands) {
  const std::vector<std::uint32_t>& first = wire().first;
  ASSERT_EQ(start.size(), first.size() + 1);
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(start[i].frame.id, first[i]);
    // Where no pause is demanded the times say nothing: they are of the wall clock, which may be set back a little.
    if (wire().pause.count() > 0.0) {
      EXPECT_GE(toSeconds(start[i + 1].at - start[i].at), wire().pause.count()) << "after frame " << i;
    }
  }
}

TEST_F(SocketCanRobot, AParameterIsWrittenUnderWay) {
  const std::uint64_t before = robot().left.truth.next()->eeprom_writes;
  const WrittenParameter written = writeToEeprom("left", 102, 2, 1.5);
  ASSERT_TRUE(written.answer.success) << written.answer;
  EXPECT_EQ(written.raw, 150) << "read back";
  EXPECT_TRUE(robot().left.truth.waitNext([&](const SimDrive& truth) { return truth.eeprom_writes == before + 1; }));
}

// It sends process data for one of our drives, which ignores them; the next ones may be others. The base stops, and does
// not start by itself when the other has ended.
TEST_F(SocketCanRobot, AnotherMasterIsNamedAndStopsTheBase) {
  const auto is_off = [](const SimDrive& truth) { return !truth.operation_enabled; };
  BareSocket other{kFar};
  const auto both_off = [&] {
    other.send(wire().of_another_master);
    const Seconds pause{0.1};
    return robot().left.truth.waitNext(is_off, pause) && robot().right.truth.waitNext(is_off, pause);
  };
  EXPECT_TRUE(eventually(both_off));
  other.send(wire().of_another_master);
  EXPECT_TRUE(robot().bus_status.waitNext([](const BusStatus& bus) {
    return bus.text.find("another master is on the bus: it sends") != std::string::npos;
  })) << robot().bus_status.next()->text;
  EXPECT_THAT(robot().waitForDiagnostics("base", isError), HasSubstr("drive right stopped"));
  EXPECT_TRUE(robot().waitForStandstill());
  EXPECT_TRUE(robot().waitForDrivesOnline());
  robot().drive(0.0);
  ASSERT_NO_FATAL_FAILURE(acknowledge());
  for (DriveTopics* drive : {&robot().left, &robot().right}) EXPECT_FALSE(drive->truth.next()->operation_enabled);
}

// As the driver of a controller reports it (linux/can/error.h).
TEST_F(SocketCanRobot, BusOffAndRestarted) {
  BareSocket controller{kFar};
  controller.sendOutOnly();
  controller.sendError(CAN_ERR_BUSOFF);
  ASSERT_NO_FATAL_FAILURE(expectBusLost("nord_near is bus-off"));
  ASSERT_NO_FATAL_FAILURE(expectDrivesStopThemselves());
  controller.sendError(CAN_ERR_RESTARTED);
  ASSERT_NO_FATAL_FAILURE(expectBackAtRest());
}

TEST_F(SocketCanRobot, InterfaceDownAndUp) {
  ip(std::string("link set ") + kNear + " down");
  ASSERT_NO_FATAL_FAILURE(expectBusLost("nord_near is down: sudo ip link set nord_near up"));
  ASSERT_NO_FATAL_FAILURE(expectDrivesStopThemselves());
  ip(std::string("link set ") + kNear + " up");
  ASSERT_NO_FATAL_FAILURE(expectBackAtRest());
}

// An adapter pulled out and plugged in again, under the same name.
TEST_F(SocketCanRobot, InterfaceRemovedAndBack) {
  removePair();
  ASSERT_NO_FATAL_FAILURE(expectBusLost("nord_near: there is no such interface: is the adapter plugged in?"));
  ASSERT_NO_FATAL_FAILURE(expectDrivesStopThemselves());
  addPair();
  ASSERT_NO_FATAL_FAILURE(expectBackAtRest());
}

std::uint64_t framesNotSent(const BusStatus& status) {
  for (const Counter& counter : status.counters) {
    if (counter.name == "not_sent") return counter.value;
  }
  return 0;
}

// ENOBUFS: about one frame a second leaves, the queue behind takes two, and every other one is refused. The drives are
// stopped by a word that gets through, or by themselves.
TEST_F(SocketCanRobot, AQueueThatStaysFull) {
  const std::uint64_t before = framesNotSent(*robot().bus_status.next());
  tc(std::string("qdisc add dev ") + kNear + " root tbf rate 128bit burst 16 limit 32");
  for (DriveTopics* drive : {&robot().left, &robot().right}) {
    EXPECT_TRUE(drive->truth.waitNext([](const SimDrive& truth) { return !truth.operation_enabled; }));
  }
  EXPECT_TRUE(robot().waitForStandstill());
  EXPECT_TRUE(robot().bus_status.waitNext([](const BusStatus& bus) {
    return bus.text.find("nord_near: frames do not leave, the send queue stays full") != std::string::npos;
  }));
  EXPECT_THAT(robot().waitForDiagnostics("base", isError), HasSubstr("stopped"));
  EXPECT_GT(framesNotSent(*robot().bus_status.next()), before + 50);
  tc(std::string("qdisc del dev ") + kNear + " root");
  EXPECT_TRUE(robot().waitForDrivesOnline());
  robot().drive(0.0);
  ASSERT_NO_FATAL_FAILURE(acknowledge());
}

// A computer that stands still while the bus goes on: what did not fit into the receive buffer is counted and told. The
// flood is of emergencies that say "no error", which do no other harm; SDO answers would look like a second node.
TEST_F(SocketCanRobot, FramesThatComeTooFastAreCounted) {
  constexpr int kFlood = 1500;  // the buffer takes about 550
  const std::uint64_t before = robot().bus_status.next()->overruns;
  driver->signal(SIGSTOP);
  BareSocket other{kFar};
  other.sendOutOnly();
  for (int i = 0; i < kFlood; ++i) other.sendZeros(0x083);
  ASSERT_NO_FATAL_FAILURE(expectDrivesStopThemselves());
  driver->signal(SIGCONT);
  // The status tells it for 10 s, once a node runs again: an emulated machine may be later. What is logged stays.
  const char* const lost = "nord_near: received frames were lost";
  EXPECT_TRUE(eventually([&] { return driver->errorText().find(lost) != std::string::npos; })) << driver->errorText();
  EXPECT_TRUE(robot().bus_status.waitNext([&](const BusStatus& bus) { return bus.overruns >= before + 500; }))
      << robot().bus_status.next()->overruns;
  ASSERT_NO_FATAL_FAILURE(expectBackAtRest());
}

// Last: nobody starts the driver again.
TEST_F(SocketCanRobot, KilledTheDrivesStopByThemselves) {
  driver->signal(SIGKILL);
  ASSERT_TRUE(driver->waitEnd(kPatience));
  ASSERT_NO_FATAL_FAILURE(expectDrivesStopThemselves());
  for (DriveTopics* drive : {&robot().left, &robot().right}) {
    const auto truth = drive->truth.next();
    EXPECT_EQ(truth->last_control_word_before_loss, 0x047F);
  }
}

}  // namespace
}  // namespace nord_driver::test
