// From a velocity command to its setpoint word in a telegram: the whole driver below ROS on the simulator's pty, in
// real time. The command counts from the moment a callback hands it over, the word from the moment its telegram is
// written.
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>

#include "cycle/bus_cycle.h"
#include "cycle/cycle_thread.h"
#include "link/serial/serial_port.h"
#include "measure.h"
#include "sim/profibus/pty_bus.h"
#include "support/map_settings.h"
#include "transport/profibus/profibus_dp.h"

namespace {

using namespace nord_driver;
using namespace nord_driver::bench;
using test::MapSettings;

constexpr std::size_t kSamples = 1000;
constexpr std::uint8_t kFirstStation = 3;

/// The newest setpoint 1 written to the first station, and when.
struct Written {
  std::atomic<int> setpoint{0};
  std::atomic<std::int64_t> time{0};  ///< ns
};

class WatchingLink final : public link::ByteLink {
 public:
  WatchingLink(const link::SerialSettings& settings, Written& written) : port_(settings), written_(written) {}

  bool open() noexcept override { return port_.open(); }
  void close() noexcept override { port_.close(); }
  bool isOpen() const noexcept override { return port_.isOpen(); }
  bool write(ByteView telegram) noexcept override {
    // SD2, 3 bytes of head, DA, SA, FC, then PPO 1: 8 bytes PKW, control word, setpoint 1.
    if (telegram.size() == 21 && telegram[4] == kFirstStation) {
      const auto setpoint = static_cast<std::int16_t>(telegram[17] << 8 | telegram[18]);
      if (setpoint != written_.setpoint) {
        written_.time = port_.now().time_since_epoch().count();
        written_.setpoint = setpoint;
      }
    }
    return port_.write(telegram);
  }
  std::size_t read(std::uint8_t* buffer, std::size_t capacity) noexcept override {
    return port_.read(buffer, capacity);
  }
  void discardInput() noexcept override { port_.discardInput(); }
  bool waitReadable(Instant until) noexcept override { return port_.waitReadable(until); }
  void sleepUntil(Instant when) noexcept override { port_.sleepUntil(when); }
  Instant now() const noexcept override { return port_.now(); }
  bool keepsBaudRate() const noexcept override { return port_.keepsBaudRate(); }
  link::LineCounters lineCounters() const noexcept override { return port_.lineCounters(); }
  const std::string& lastError() const noexcept override { return port_.lastError(); }

 private:
  link::SerialPort port_;
  Written& written_;
};

double percentile(std::vector<double> values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Lateness of the same kind of sleep the cycle's thread sleeps, ms, 99th percentile.
double bareTimer(const link::SerialSettings& settings, Duration period) {
  link::SerialPort clock{settings};
  std::vector<double> late;
  std::thread thread{[&] {
    Instant next = clock.now();
    for (std::size_t i = 0; i < kSamples; ++i) {
      next += period;
      clock.sleepUntil(next);
      late.push_back(toSeconds(clock.now() - next) * 1e3);
    }
  }};
  thread.join();
  return percentile(late, 0.99);
}

std::vector<DriveSettings> drives() {
  std::vector<DriveSettings> all;
  for (int i = 0; i < 2; ++i) {
    const std::string name = i == 0 ? "left" : "right";
    auto settings = std::make_shared<MapSettings>("drives/" + name + "/");
    settings->set("address", kFirstStation + i).set("series", "sk5xxe").set("pole_pairs", 2);
    settings->set("gear_ratio", 20.0).set("joint", name);
    all.push_back({name, settings});
  }
  return all;
}

class Robot {
 public:
  Robot() {
    MapSettings node{""};
    node.set("left_wheel", "left").set("right_wheel", "right").set("wheel_separation", 0.5).set("wheel_radius", 0.1);
    config_ = cycle::readCycleConfig(node, drives());
    const MapSettings bus{"bus/", {{"device", bus_.linkPath()}, {"baud_rate", 500'000}, {"slot_time", 0.05}}};
    transport_.configure(bus, drives(), config_.cycle_rate);
    ports_ = std::make_unique<cycle::CyclePorts>(2);
    cycle_ = std::make_unique<cycle::BusCycle>(config_, transport_, *ports_, true);
    thread_ = std::make_unique<cycle::CycleThread>(*cycle_, transport_, config_.real_time);
    const Instant end = std::chrono::steady_clock::now() + std::chrono::seconds{20};
    while (!ports_->readSnapshot().base.enabled) {
      if (std::chrono::steady_clock::now() > end) throw std::runtime_error("the base is not enabled");
      std::this_thread::sleep_for(std::chrono::milliseconds{10});
    }
  }

  /// Milliseconds from this command to its word.
  double command(double velocity) {
    const int before = written_.setpoint;
    const Instant given = std::chrono::steady_clock::now();
    ports_->commandBase({{velocity, 0.0}, given, true});
    while (written_.setpoint == before) {
      if (std::chrono::steady_clock::now() - given > std::chrono::seconds{2}) throw std::runtime_error("no setpoint");
      std::this_thread::sleep_for(std::chrono::microseconds{200});
    }
    return static_cast<double>(written_.time - given.time_since_epoch().count()) * 1e-6;
  }
  Duration period() const { return config_.period(); }
  const link::SerialSettings& line() const { return line_; }

 private:
  static sim::SimConfig simulated() {
    sim::SimConfig config;
    for (std::uint8_t i = 0; i < 2; ++i) {
      sim::DriveConfig drive;
      drive.name = i == 0 ? "left" : "right";
      drive.address = static_cast<std::uint8_t>(kFirstStation + i);
      config.drives.push_back(drive);
    }
    return config;
  }

  sim::PtyBus bus_{simulated(), "/tmp/nord_bench_bus." + std::to_string(::getpid())};
  Written written_;
  link::SerialSettings line_;
  ProfibusDpTransport transport_{[this](const link::SerialSettings& settings) {
    line_ = settings;
    return std::make_unique<WatchingLink>(settings, written_);
  }};
  cycle::CycleConfig config_;
  std::unique_ptr<cycle::CyclePorts> ports_;
  std::unique_ptr<cycle::BusCycle> cycle_;
  std::unique_ptr<cycle::CycleThread> thread_;
};

}  // namespace

int main() {
  try {
    Robot robot;
    const double cycle = toSeconds(robot.period()) * 1e3;
    std::mt19937 random{1};
    std::uniform_real_distribution<double> pause{cycle, 2.0 * cycle};  // any moment of a cycle
    std::vector<double> latencies;
    for (std::size_t i = 0; i < kSamples; ++i) {
      std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(pause(random)));
      latencies.push_back(robot.command(0.1 + 0.001 * static_cast<double>(i % 7)));
    }
    const double timer = bareTimer(robot.line(), robot.period());
    std::printf("%zu commands, cycle %.1f ms, 2 drives; a bare timer is late by %.3f ms (99th percentile)\n",
                latencies.size(), cycle, timer);
    bool kept = report("cmd_vel to setpoint word, median", percentile(latencies, 0.5), "ms", cycle / 2.0 + 0.2);
    kept =
        report("cmd_vel to setpoint word, 99th percentile", percentile(latencies, 0.99), "ms", cycle + 0.2 + timer) &&
        kept;
    return kept ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_command_latency: %s\n", error.what());
    return 2;
  }
}
