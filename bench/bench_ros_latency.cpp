// From a publisher's publish() to the setpoint at a simulated inverter: through roscpp, the real node in its own
// process, and a pty, with a ROS master of its own. The setpoint counts from the moment it is looked up, every 0.1 ms.
#include <arpa/inet.h>
#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <signal.h>
#include <std_srvs/SetBool.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <random>
#include <stdexcept>
#include <string>

#include "measure.h"
#include "rostest/node_process.h"
#include "sim/profibus/pty_bus.h"

namespace {

using namespace nord_driver;
using namespace nord_driver::bench;
using Clock = std::chrono::steady_clock;
using test::NodeProcess;

constexpr std::size_t kSamples = 1000;
constexpr double kCycle = 10.0;  // ms
constexpr double kRos = 1.0;     // ms: publish, serialize, two threads and a socket of this machine; looking it up
constexpr std::uint8_t kFirstStation = 3;
constexpr std::chrono::seconds kPatience{20};

/// A TCP port nobody uses at this moment.
std::string freePort() {
  const int descriptor = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  auto* const any = reinterpret_cast<sockaddr*>(&address);
  const bool found = ::bind(descriptor, any, size) == 0 && ::getsockname(descriptor, any, &size) == 0;
  ::close(descriptor);
  if (!found) throw std::runtime_error("no free TCP port");
  return std::to_string(ntohs(address.sin_port));
}

template <typename Condition>
void waitFor(const char* what, Condition&& condition) {
  const auto end = Clock::now() + kPatience;
  while (!condition()) {
    if (Clock::now() > end) throw std::runtime_error(std::string("waited in vain for ") + what);
    std::this_thread::sleep_for(std::chrono::milliseconds{10});
  }
}

sim::SimConfig simulated() {
  sim::SimConfig config;
  for (const char* name : {"left", "right"}) {
    sim::DriveConfig drive;
    drive.name = name;
    drive.address = static_cast<std::uint8_t>(kFirstStation + config.drives.size());
    config.drives.push_back(drive);
  }
  return config;
}

void configureDriver(const std::string& device) {
  const std::string node = "/nord_driver/";
  ros::param::set(node + "cycle_rate", 1e3 / kCycle);
  ros::param::set(node + "bus/device", device);
  ros::param::set(node + "bus/slot_time", 0.05);
  ros::param::set(node + "bus/watchdog", 1.0);  // a base that stops has no latency
  ros::param::set(node + "drive_timeout", 1.0);
  ros::param::set(node + "cmd_vel_timeout", 1.0);
  for (const char* name : {"left", "right"}) {
    const std::string drive = node + "drives/" + name + "/";
    ros::param::set(drive + "address", name == std::string("left") ? kFirstStation : kFirstStation + 1);
    ros::param::set(drive + "series", "sk5xxe");
    ros::param::set(drive + "pole_pairs", 2);
    ros::param::set(drive + "gear_ratio", 20.0);
    ros::param::set(drive + "joint", name);
    ros::param::set(node + name + "_wheel", name);
  }
  ros::param::set(node + "wheel_separation", 0.5);
  ros::param::set(node + "wheel_radius", 0.1);
}

class Robot {
 public:
  Robot() {
    configureDriver(bus_.linkPath());
    driver_ = std::make_unique<NodeProcess>(
        "/bin/sh",
        std::vector<std::string>{"-c", "exec \"$0\" \"$@\" >/dev/null", test::kDriverProgram, "__name:=nord_driver"});
    publisher_ = node_.advertise<geometry_msgs::Twist>("cmd_vel", 1);
    std_srvs::SetBool enable;
    enable.request.data = true;
    try {
      waitFor("the driver to listen", [&] { return publisher_.getNumSubscribers() > 0; });
      waitFor("the base to be enabled",
              [&] { return ros::service::call("/nord_driver/enable", enable) && enable.response.success; });
    } catch (const std::exception& error) {
      throw std::runtime_error(error.what() + (": " + enable.response.message) + "\n" + driver_->errorText());
    }
  }
  ~Robot() {
    driver_->signal(SIGTERM);
    driver_->waitEnd(kPatience);
  }

  /// Milliseconds from this command to its setpoint.
  double command(double velocity) {
    geometry_msgs::Twist twist;
    twist.linear.x = velocity;
    const int before = setpoint();
    const auto given = Clock::now();
    publisher_.publish(twist);
    while (setpoint() == before) {
      if (Clock::now() - given > std::chrono::seconds{2}) throw std::runtime_error("no setpoint");
      std::this_thread::sleep_for(std::chrono::microseconds{100});
    }
    return toSeconds(Clock::now() - given) * 1e3;
  }

 private:
  int setpoint() {
    return bus_.withModel([](sim::RobotSim& robot) { return int{robot.drives()[0]->inverter().setpoint1()}; });
  }

  sim::PtyBus bus_{simulated(), "/tmp/nord_bench_bus." + std::to_string(::getpid())};
  ros::NodeHandle node_;
  ros::Publisher publisher_;
  std::unique_ptr<NodeProcess> driver_;
};

double percentile(std::vector<double> values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// How late a sleep of one cycle ends on this machine, ms, 99th percentile.
double bareTimer() {
  std::vector<double> late;
  for (std::size_t i = 0; i < kSamples / 4; ++i) {
    const auto end =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double, std::milli>(kCycle));
    std::this_thread::sleep_until(end);
    late.push_back(toSeconds(Clock::now() - end) * 1e3);
  }
  return percentile(late, 0.99);
}

int measure() {
  Robot robot;
  std::mt19937 random{1};
  std::uniform_real_distribution<double> pause{kCycle, 2.0 * kCycle};  // any moment of a cycle
  std::vector<double> latencies;
  for (std::size_t i = 0; i < kSamples; ++i) {
    std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(pause(random)));
    latencies.push_back(robot.command(0.1 + 0.001 * static_cast<double>(i % 7)));
  }
  const double timer = bareTimer();
  std::printf("%zu commands, cycle %.1f ms, 2 drives, driver in its own process; a bare timer is late by %.3f ms\n",
              latencies.size(), kCycle, timer);
  const bool median = report("publish() to setpoint, median", percentile(latencies, 0.5), "ms", kCycle / 2.0 + kRos);
  const bool most =
      report("publish() to setpoint, 99th percentile", percentile(latencies, 0.99), "ms", kCycle + kRos + timer);
  return median && most ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::string port = freePort();
    ::setenv("ROS_MASTER_URI", ("http://localhost:" + port).c_str(), 1);
    ::setenv("ROS_HOSTNAME", "localhost", 1);
    NodeProcess master("/usr/bin/env", {"rosmaster", "--core", "-p", port});
    ros::init(argc, argv, "bench", ros::init_options::NoSigintHandler | ros::init_options::NoRosout);
    waitFor("the ROS master", [] { return ros::master::check(); });
    return measure();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_ros_latency: %s\n", error.what());
    return 2;
  }
}
