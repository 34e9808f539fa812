// A DeviceNet scanner of a few lines for the tests of the simulator: it sends what it is told and notes what comes
// back.
// Scanner 0Ah and slave 9 are those of the golden vectors.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sim/devicenet/simulated_dn_bus.h"
#include "support/can_text.h"

namespace nord_driver::sim {

/// A drive with a technology unit at MAC id 9.
inline SimConfig oneDnDrive(unsigned assembly = 100) {
  SimConfig config;
  config.bus = DnBusConfig{};
  DriveConfig drive;
  drive.name = "left";
  drive.address = 9;
  DnDriveConfig dn;
  dn.assembly = assembly;
  drive.bus = dn;
  config.drives.push_back(drive);
  return config;
}

/// `inverters` SK 2xxE behind an SK TU4-DEV at MAC id 9.
inline SimConfig dnGateway(unsigned inverters = 1, unsigned assembly = 100) {
  SimConfig config;
  config.bus = DnBusConfig{};
  for (unsigned i = 1; i <= inverters; ++i) {
    DriveConfig drive;
    drive.name = "fi" + std::to_string(i);
    drive.address = 9;
    drive.place = i;
    drive.device.series = Series::kSk2xxe;
    DnDriveConfig dn;
    dn.kind = DnModuleKind::kGateway;
    dn.assembly = assembly;
    drive.bus = dn;
    config.drives.push_back(drive);
  }
  return config;
}

class DnConversation {
 public:
  using Texts = std::vector<std::string>;

  explicit DnConversation(const SimConfig& config = oneDnDrive()) : bus{config} { bus.open(); }

  /// The duplicate-MAC checks of the scanner and of the modules end.
  void goOnline() {
    for (int i = 0; i < 2; ++i) {
      send("457#00 FF FF 01 00 00 00");
      bus.run(std::chrono::milliseconds(1010));
    }
    bus.run(std::chrono::milliseconds(200));
    take();
  }
  /// Allocates explicit and poll, reads both sizes, sets a packet rate of 100 ms (64h).
  void connect() {
    goOnline();
    ask("44E#0A 4B 03 01 03 0A");
    ask("44C#0A 0E 05 02 07");
    ask("44C#0A 0E 05 02 08");
    ask("44C#0A 10 05 02 09 64 00");
  }
  void send(const std::string& text) { bus.send(nord_driver::frame(text)); }
  /// All frames received so far.
  Texts take() {
    Texts texts;
    link::ReceivedCanFrame received;
    while (bus.receive(received)) texts.push_back(nord_driver::text(received.frame));
    return texts;
  }
  Texts takeAfter(Duration span) {
    bus.run(span);
    return take();
  }
  Texts askAll(const std::string& text, Duration span = std::chrono::milliseconds(20)) {
    take();
    send(text);
    return takeAfter(span);
  }
  /// Sends and waits 20 ms; the first frame that came back, "" when none did.
  std::string ask(const std::string& text) {
    const Texts answers = askAll(text);
    return answers.empty() ? "" : answers.front();
  }
  /// An explicit request to slave 9, and the data of its answer without the scanner's MAC id: "0E 01 01 01".
  std::string request(const std::string& body) {
    const std::string answer = ask("44C#0A " + body);
    return answer.substr(0, 6) == "44B#0A" ? answer.substr(6) : answer;
  }
  /// Polls every 10 ms for `span`; the last answer.
  std::string poll(const Texts& frames, Duration span) {
    std::string last;
    for (const Instant end = bus.now() + span; bus.now() < end;) {
      for (const std::string& frame : frames) send(frame);
      const Texts answers = takeAfter(std::chrono::milliseconds(10));
      if (!answers.empty()) last = answers.back();
    }
    return last;
  }
  std::string poll(const std::string& frame, Duration span) { return poll(Texts{frame}, span); }

  DriveUnit& drive(std::size_t index = 0) { return bus.drive(index); }
  DnModule& module() { return bus.module(0); }
  DnReferee& referee() { return bus.referee(); }

  SimulatedDnBus bus;
};

}  // namespace nord_driver::sim
