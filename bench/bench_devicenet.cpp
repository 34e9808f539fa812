// What the driver adds to a bare exchange of DeviceNet's frames: explicit reads, and cycles of polls; and what a wire would
// take for them.
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "can_course.h"
#include "devicenet/explicit_client.h"
#include "devicenet/scanner.h"
#include "devicenet_devices.h"

namespace {

using namespace nord_driver;
using namespace nord_driver::bench;
using namespace std::chrono_literals;

constexpr std::array<std::uint8_t, 5> kStandby{0x00, 0x7E, 0x04, 0x00, 0x00};  // BU 0280 4.2.4
constexpr std::uint8_t kMac = 1;
constexpr std::uint16_t kParameterClass = 101;  // P102

class ExplicitReader {
 public:
  explicit ExplicitReader(CanEnds& ends) : line_(ends, {0x403u | kMac << 3u}) {}

  void read() {
    CanFrame frame;
    client_.start(devicenet::getAttribute(1, kParameterClass, 1, 2), devicenet::ExplicitPort::kConnected,
                  devicenet::BodyFormat::k8Over8, 1s, line_.port.now());
    while (client_.pollTransmit(frame, line_.port.now())) line_.port.send(frame);
    while (!(answer_ = client_.takeAnswer())) {
      line_.port.waitReadable(*client_.nextDeadline());
      link::ReceivedCanFrame received;
      if (line_.port.receive(received)) client_.handle(received.frame, received.at);
      client_.poll(line_.port.now());
    }
    if (answer_->end != devicenet::ExplicitEnd::kDone || answer_->data[0] != 200) {
      throw std::runtime_error("a wrong value was read");
    }
  }

 private:
  Line line_;
  devicenet::ExplicitClient client_{0, kMac};
  std::optional<devicenet::ExplicitAnswer> answer_;
};

bool explicitReads(const Course& course) {
  const FarEnd of_driver{course.of_driver, DevicenetDevices{1}}, of_bare{course.of_bare, DevicenetDevices{1}};
  ExplicitReader reader{*of_driver.ends};
  const Bare bare{*of_bare.ends, {dataFrame(0x40C, fromHex("00 0E 65 01 02"))}, 1};
  const double ratio = ratioOf(
      course, 5000, "explicit read", [&reader] { reader.read(); }, [&bare] { bare.exchange(); });
  return course.judge("explicit read over bare ping-pong (0.8 of its rate)", ratio, 1.0 / 0.8);
}

devicenet::ScannerConfig busOf(std::size_t drives) {
  devicenet::ScannerConfig config;
  config.cycle_time = 100ms;
  for (std::size_t mac = 1; mac <= drives; ++mac) {
    devicenet::NodeConfig node;
    node.mac = static_cast<std::uint8_t>(mac);
    node.io.input_bytes = kStandby.size();
    node.io.output_bytes = kStandby.size();
    node.io.expected_packet_rate = 10s;  // nothing but the cycle on the bus
    config.nodes.push_back(node);
  }
  return devicenet::completed(config);
}

/// The driver's side of a bus, turned as the transport turns it; what that does between two cycles is not timed here.
class ScannerBus {
 public:
  ScannerBus(CanEnds& ends, std::size_t drives)
      : scanner_(busOf(drives)), line_(ends, scanner_.receivedIds()), counts_(drives) {
    scanner_.restart(line_.port.now());
    for (const Instant until = line_.port.now() + 60s; !allExchange() && line_.port.now() < until;) turn(1ms);
    if (!allExchange()) throw std::runtime_error("the devices do not come to exchange");
    late_ = 0;  // while they were connected, nobody was to answer
  }

  void cycle() {
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      scanner_.setOutput(i, kStandby);
      counts_[i] = scanner_.input(i).count;
    }
    scanner_.startCycle(line_.port.now());
    turn(1s);
  }
  void check() const {
    if (!allExchange()) throw std::runtime_error("a device was lost during the measurement");
    if (late_ > 0) throw std::runtime_error("a device did not answer in time");
  }

 private:
  /// Until every device has answered its poll. The last answer ends it: no look whether there is more.
  void turn(Duration longest) {
    const Instant until = line_.port.now() + longest;
    Instant now = line_.port.now();
    while (true) {
      scanner_.poll(now);
      send();
      while (scanner_.pollEvent()) {
      }
      if (line_.port.waitReadable(std::min(until, scanner_.nextDeadline().value_or(until)))) {
        link::ReceivedCanFrame received;
        while (line_.port.receive(received)) {
          scanner_.handleFrame(received.frame, received.at);
          if (allAnswered()) return;
        }
      }
      now = line_.port.now();
      if (now < until) continue;
      ++late_;
      return;
    }
  }
  void send() {
    CanFrame frame;
    while (scanner_.pollTransmit(frame)) {
      if (line_.port.send(frame) == link::CanSend::kSent) continue;
      scanner_.notSent();
      return;
    }
  }
  bool allAnswered() const {
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      if (scanner_.input(i).count == counts_[i]) return false;
    }
    return true;
  }
  bool allExchange() const {
    for (std::size_t i = 0; i < scanner_.nodeCount(); ++i) {
      if (scanner_.status(i).state != devicenet::NodeState::kExchanging) return false;
    }
    return true;
  }

  devicenet::Scanner scanner_;
  Line line_;
  std::vector<std::uint64_t> counts_;  // messages of each device when the cycle began
  std::uint64_t late_ = 0;
};

std::vector<CanFrame> pollsOf(std::size_t drives) {
  std::vector<CanFrame> frames;
  for (std::uint32_t mac = 1; mac <= drives; ++mac) frames.push_back(dataFrame(0x405u | mac << 3u, kStandby));
  return frames;
}

void printWire(std::size_t drives) {
  std::printf("  %zu drive(s) on the wire, every frame stuffed worst:", drives);
  for (const std::uint32_t rate : {125'000u, 250'000u, 500'000u}) {
    devicenet::ScannerConfig config = busOf(drives);
    config.bit_rate = rate;
    std::printf(" %.2f ms at %u kbit/s%s", toSeconds(devicenet::cycleOnWire(config)) * 1e3, rate / 1000,
                rate == 500'000 ? "\n" : ",");
  }
}

bool cycleOf(const Course& course, std::size_t drives) {
  printWire(drives);
  const FarEnd of_driver{course.of_driver, DevicenetDevices{drives}}, of_bare{course.of_bare, DevicenetDevices{drives}};
  ScannerBus bus{*of_driver.ends, drives};
  const Bare bare{*of_bare.ends, pollsOf(drives), drives};
  const std::string what = std::to_string(drives) + " drive(s): cycle";
  const double ratio = ratioOf(
      course, 5000 / (1 + drives / 4), what.c_str(), [&bus] { bus.cycle(); }, [&bare] { bare.exchange(); });
  bus.check();
  return course.judge("DeviceNet cycle over the bare exchange of the same frames", ratio, 1.25);
}

bool measure(const Course& course) {
  bool kept = explicitReads(course);
  for (const std::size_t drives : {1u, 4u, 16u, 32u}) kept = cycleOf(course, drives) && kept;
  return kept;
}

}  // namespace

int main(int argc, char** argv) {
  return runOnCan(argc, argv, "bench_devicenet", measure);
}
