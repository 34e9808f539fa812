// A CANopen master of a few lines for the tests of the simulator: it sends what it is told and notes what comes back.
#pragma once

#include <string>
#include <vector>

#include "sim/canopen/simulated_can_bus.h"
#include "support/can_text.h"

namespace nord_driver::sim {

/// Node 50 = 32h, as in the trace of BU 0060 p. 96.
inline SimConfig oneCanDrive(const CanDriveConfig& can = CanDriveConfig{}, int node = 50) {
  SimConfig config;
  config.bus = CanBusConfig{};
  DriveConfig drive;
  drive.name = "left";
  drive.address = static_cast<std::uint8_t>(node);
  drive.bus = can;
  config.drives.push_back(drive);
  return config;
}

class CanConversation {
 public:
  explicit CanConversation(const SimConfig& config = oneCanDrive(), const CanBusSettings& settings = CanBusSettings{})
      : bus{config, settings} {
    bus.open();
  }

  /// Lets the nodes boot and the charging relays engage; what they sent meanwhile is thrown away.
  void boot() {
    bus.run(std::chrono::milliseconds(500));
    take();
  }
  void send(const std::string& text) { bus.send(nord_driver::frame(text)); }
  /// All frames received so far.
  std::vector<std::string> take() {
    std::vector<std::string> texts;
    link::ReceivedCanFrame received;
    while (bus.receive(received)) texts.push_back(nord_driver::text(received.frame));
    return texts;
  }
  std::vector<std::string> takeAfter(Duration span) {
    bus.run(span);
    return take();
  }
  /// Sends and waits 20 ms; the first frame that came back, "" when none did.
  std::string ask(const std::string& text, Duration span = std::chrono::milliseconds(20)) {
    take();
    send(text);
    const std::vector<std::string> answers = takeAfter(span);
    return answers.empty() ? "" : answers.front();
  }
  /// The data of an SDO request to node 50 (hexadecimal, spaces allowed); those of the answer.
  std::string sdo(const std::string& data) {
    take();
    bus.send(dataFrame(0x632, ByteView{fromHex(data)}));
    for (const std::string& text : takeAfter(std::chrono::milliseconds(20))) {
      if (text.substr(0, 4) == "5B2#") return text.substr(4);
    }
    return "";
  }
  /// NMT start.
  void start() {
    send("000#0132");
    bus.run(std::chrono::milliseconds(5));
    take();
  }
  /// Sends `text` every 5 ms for `span`; the last frame with the identifier `id` that came.
  std::string repeat(const std::string& text, Duration span, const std::string& id) {
    std::string last;
    for (const Instant end = bus.now() + span; bus.now() < end;) {
      send(text);
      for (const std::string& answer : takeAfter(std::chrono::milliseconds(5))) {
        if (answer.substr(0, 3) == id) last = answer;
      }
    }
    return last;
  }

  DriveUnit& drive(std::size_t index = 0) { return bus.drive(index); }
  CanNode& node() { return bus.node(0); }
  CanReferee& referee() { return bus.referee(); }

  SimulatedCanBus bus;
};

}  // namespace nord_driver::sim
