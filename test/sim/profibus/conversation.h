// A master of a few lines for the tests of the simulator: it sends what it is told and reads what comes back.
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "sim/profibus/simulated_segment.h"

namespace nord_driver::sim {

inline SimConfig oneDrive(int address = 8) {
  SimConfig config;
  config.bus.as<DpBusConfig>().baud_rate = 500000;
  DriveConfig drive;
  drive.name = "left";
  drive.address = static_cast<std::uint8_t>(address);
  drive.pkw.delay = 0;
  config.drives.push_back(drive);
  return config;
}

/// An SK CU4-PBR with so many inverters of the series SK 2xxE behind it.
inline SimConfig oneModule(unsigned inverters, int address = 8) {
  SimConfig config;
  config.bus.as<DpBusConfig>().baud_rate = 500000;
  for (unsigned place = 1; place <= inverters; ++place) {
    DriveConfig drive;
    drive.name = "fi" + std::to_string(place);
    drive.address = static_cast<std::uint8_t>(address);
    drive.device.series = Series::kSk2xxe;
    drive.place = place;
    drive.pkw.delay = 0;
    config.drives.push_back(drive);
  }
  return config;
}

/// Station 1 talking to station 8 over a simulated segment, one telegram after the other, with proper pauses.
class Conversation {
 public:
  explicit Conversation(const SimConfig& config = oneDrive(), const SegmentSettings& settings = SegmentSettings{})
      : segment{config, settings} {
    segment.open();
    segment.run(std::chrono::milliseconds(500));  // the charging relay has engaged
  }

  /// The telegram exactly as written; the answer in hexadecimal, "" when none came within `slot_bits`.
  std::string ask(const std::string& hex, std::uint64_t pause_bits = 40, std::uint64_t slot_bits = 3000) {
    return askBytes(fromHex(hex), pause_bits, slot_bits);
  }

  /// An SRD to station 8 with SAPs; FCB and FCV are counted here.
  std::string service(unsigned sap, const std::vector<std::uint8_t>& data) {
    std::vector<std::uint8_t> unit{static_cast<std::uint8_t>(sap), 0x3E};
    for (const std::uint8_t byte : data) unit.push_back(byte);
    return askBytes(variable(0x88, 0x81, frameCount(), unit));
  }
  /// Data_Exchange with PPO 1: parameter channel and process data in hexadecimal; the data of the answer.
  std::string exchange(const std::string& pkw, const std::string& pzd) {
    std::string answer = askBytes(variable(0x08, 0x01, frameCount(), fromHex(pkw + pzd)));
    // 68 LE LE 68 DA SA FC data FCS 16
    return answer.size() > 27 ? answer.substr(21, answer.size() - 27) : answer;
  }
  /// Data_Exchange with whatever is configured, in hexadecimal; the data of the answer.
  std::string outputs(const std::string& hex) {
    const std::string answer = askBytes(variable(0x08, 0x01, frameCount(), fromHex(hex)));
    return answer.size() > 27 ? answer.substr(21, answer.size() - 27) : answer;
  }
  /// Sends `hex` every 2 ms for `span`; the last answer.
  std::string outputsFor(const std::string& hex, Duration span) {
    const Instant end = segment.now() + span;
    while (segment.now() < end) {
      outputs(hex);
      segment.run(std::chrono::milliseconds(2));
    }
    return outputs(hex);
  }
  /// The process data of the answer to `pzd`, without any parameter order.
  std::string pzd(const std::string& words) {
    const std::string answer = exchange("0000 0000 0000 0000", words);
    return answer.size() == 35 ? answer.substr(24) : answer;
  }
  /// Sends `words` every 2 ms for `span`; the last answer.
  std::string pzdFor(const std::string& words, Duration span) {
    const Instant end = segment.now() + span;
    while (segment.now() < end) {
      pzd(words);
      segment.run(std::chrono::milliseconds(2));
    }
    return pzd(words);
  }

  /// Slave_Diag, Set_Prm with a watchdog of factor * 10 ms (0: off), Chk_Cfg, Slave_Diag.
  void startUp(unsigned watchdog_factor = 10) {
    service(60, {});
    const std::uint8_t flags = watchdog_factor > 0 ? 0x88 : 0x80;
    service(61, {flags, static_cast<std::uint8_t>(watchdog_factor), 1, 11, 0x75, 0x31, 0});
    service(62, {0xF3, 0xF1});
    service(60, {});
  }

  /// The same with a module with slots; DP-V1 as asked for.
  void startUpModule(const std::vector<std::uint8_t>& identifiers, unsigned watchdog_factor = 10, bool dpv1 = true) {
    service(60, {});
    const std::uint8_t flags = watchdog_factor > 0 ? 0x88 : 0x80;
    std::vector<std::uint8_t> parameters{flags, static_cast<std::uint8_t>(watchdog_factor), 1, 11, 0x0B, 0xA8, 0};
    if (dpv1) parameters.insert(parameters.end(), {0x80, 0, 0});
    service(61, parameters);
    service(62, identifiers);
    service(60, {});
  }

  std::string askBytes(const std::vector<std::uint8_t>& bytes, std::uint64_t pause_bits = 40,
                       std::uint64_t slot_bits = 3000) {
    segment.run(segment.baudRate().bits(pause_bits));
    segment.write(bytes);
    const Instant until =
        segment.now() + segment.baudRate().characters(bytes.size()) + segment.baudRate().bits(slot_bits);
    std::vector<std::uint8_t> answer;
    while (segment.waitReadable(until)) {
      std::uint8_t byte = 0;
      if (segment.read(&byte, 1) == 1) answer.push_back(byte);
      if (answer.size() == 1 && answer[0] == 0xE5) break;
      if (answer.size() == 6 && answer[0] == 0x10) break;
      if (answer.size() > 4 && answer[0] == 0x68 && answer.size() == answer[1] + 6u) break;
    }
    return toHex(answer);
  }

  static std::vector<std::uint8_t> variable(unsigned da, unsigned sa, unsigned fc,
                                            const std::vector<std::uint8_t>& data) {
    const unsigned length = static_cast<unsigned>(data.size()) + 3;
    std::vector<std::uint8_t> bytes{0x68,
                                    static_cast<std::uint8_t>(length),
                                    static_cast<std::uint8_t>(length),
                                    0x68,
                                    static_cast<std::uint8_t>(da),
                                    static_cast<std::uint8_t>(sa),
                                    static_cast<std::uint8_t>(fc)};
    for (const std::uint8_t byte : data) bytes.push_back(byte);
    unsigned sum = 0;
    for (std::size_t i = 4; i < bytes.size(); ++i) sum += bytes[i];
    bytes.push_back(static_cast<std::uint8_t>(sum));
    bytes.push_back(0x16);
    return bytes;
  }

  /// The next FC of an SRD: 6D first, then 5D and 7D in turn.
  unsigned frameCount() {
    const unsigned function = first_ ? 0x6D : fcb_ ? 0x7D : 0x5D;
    fcb_ = !first_ && !fcb_;
    first_ = false;
    return function;
  }
  /// The next request is a first one again.
  void restartFrameCount() {
    first_ = true;
    fcb_ = false;
  }

  DriveUnit& drive() { return segment.drive(0); }
  DpStation& station() { return segment.station(0); }
  Referee& referee() { return segment.referee(); }

  SimulatedSegment segment;

 private:
  bool first_ = true;
  bool fcb_ = false;
};

}  // namespace nord_driver::sim
