#include "transport/devicenet/devicenet_scanner.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <vector>

#include "config/setting_checks.h"
#include "devicenet/scanner.h"
#include "transport/can/can_scan_line.h"
#include "transport/devicenet/devicenet_config.h"
#include "transport/devicenet/devicenet_listening.h"

namespace nord_driver {

namespace {

using devicenet::NodeState;
using devicenet::NodeStatus;

constexpr Duration kCheck = std::chrono::seconds{5};   // the duplicate-MAC check takes two
constexpr Duration kAnswer = std::chrono::seconds{4};  // for all devices: they are asked side by side
constexpr Duration kRelease = std::chrono::milliseconds{500};

bool isSettled(const NodeStatus& status) noexcept {
  return status.state == NodeState::kExchanging || status.state == NodeState::kRefused;
}

std::string format(const char* pattern, unsigned a, unsigned b) {
  char text[64];
  std::snprintf(text, sizeof text, pattern, a, b);
  return text;
}

// Of the first inverter: class 107 has P700 to P799, the instance is the element (BU 0280 4.3.9).
struct Parameter {
  std::uint8_t instance;
  std::uint8_t attribute;
};
constexpr std::array<Parameter, 4> kParameters{Parameter{1, 7}, Parameter{2, 7}, Parameter{1, 42}, Parameter{1, 43}};
enum : std::size_t { kVersion, kSubversion, kDatabase, kPower };
constexpr std::uint16_t kParameterClass = 107;
using Values = std::array<std::optional<std::uint32_t>, kParameters.size()>;

void addInverter(const Values& values, FoundStation& station) {
  if (values[kDatabase]) station.series = "P742 = " + std::to_string(*values[kDatabase]);
  if (values[kPower]) {
    station.series += (station.series.empty() ? "" : ", ") + ("P743 = " + std::to_string(*values[kPower]));
  }
  if (!values[kVersion]) return;
  station.version += ", inverter P707 = " + std::to_string(*values[kVersion]);
  if (values[kSubversion]) station.version += " R" + std::to_string(*values[kSubversion]);
}

FoundStation stationOf(std::uint8_t mac, const NodeStatus& status) {
  FoundStation station;
  station.number = mac;
  if (status.vendor_id != 0) {
    station.module = format("vendor %u, product %u", status.vendor_id, status.product_code);
    station.version = format("device V%u.%u", status.major_revision, status.minor_revision);
    station.note = "device type " + std::to_string(status.device_type);
  }
  if (status.state == NodeState::kRefused) {
    station.note += (station.note.empty() ? "" : "; ") + status.reason.str();
    if (status.owner) station.note += " (of the scanner with MAC id " + std::to_string(*status.owner) + ")";
  }
  return station;
}

devicenet::ScannerConfig everyMac(devicenet::ScannerConfig config, std::optional<Duration> packet_rate) {
  config.nodes.clear();
  for (std::uint8_t mac = 0; mac < devicenet::kMacIds; ++mac) {
    if (mac == config.mac) continue;
    devicenet::NodeConfig node;
    node.mac = mac;
    node.io.kind = devicenet::IoKind::kNone;
    node.io.expected_packet_rate = packet_rate;
    config.nodes.push_back(node);
  }
  return devicenet::completed(config);
}

}  // namespace

std::string devicenetScanIsQuiet(const Settings& bus) {
  constexpr Duration kQuiet = std::chrono::seconds{3};
  const devicenet::ScannerConfig every = everyMac(readDevicenetBus(bus, 100.0).scanner, readPacketRate(bus));
  const Duration own = devicenet::longestOwnTimeOut(*every.nodes.front().io.expected_packet_rate);
  if (own <= kQuiet) return {};
  return "no device is asked for " + shortNumber(toSeconds(own)) +
         " s: by expected_packet_rate its own time-out must have run out, whoever had it before may have left its "
         "motor "
         "turning";
}

ScanReport scanDevicenet(const Settings& bus,
                         const std::function<std::unique_ptr<link::CanLink>(const link::CanSettings&)>& make_link,
                         const std::atomic<bool>& end_asked) {
  const DevicenetConfig config = readDevicenetBus(bus, 100.0);
  ScanReport report;
  report.bus = "DeviceNet";
  report.number_name = "MAC id";
  const std::unique_ptr<link::CanLink> link = make_link({config.interface, {}, config.bit_rate});
  CanScanLine line{*link, end_asked};
  report.trouble = line.open(kDevicenetListening, [](const CanFrame&, Instant) {});
  if (!report.trouble.empty()) return report;

  const devicenet::ScannerConfig every = everyMac(config.scanner, readPacketRate(bus));
  devicenet::Scanner scanner{every};
  // Before that no device is asked, see NodeConnect.
  const Instant asked_from = line.now() + devicenet::longestOwnTimeOut(*every.nodes.front().io.expected_packet_rate);
  scanner.restart(line.now());
  std::string other;
  const auto next_frame = [&](CanFrame& frame) { return scanner.pollTransmit(frame); };
  const auto next_look = [&](Instant seen) {
    scanner.poll(seen);
    while (const auto event = scanner.pollEvent()) {
      if (event->kind == devicenet::DevicenetEventKind::kSecondScanner && other.empty()) {
        other = "another scanner began to work with the bus: ended";
      }
    }
    return scanner.nextDeadline().value_or(Instant::max());
  };
  const auto handle = [&](const CanFrame& frame, Instant at) { scanner.handleFrame(frame, at); };
  const auto talk = [&](Duration limit, const std::function<bool()>& done) {
    line.talk(line.now() + limit, next_frame, next_look, handle, [&] { return !other.empty() || done(); });
  };
  std::vector<Values> values(scanner.nodeCount());
  talk(kCheck, [&] { return scanner.busState() != devicenet::BusState::kCheckingMac; });
  if (scanner.busState() == devicenet::BusState::kOnline) {
    // A device that is absent is never settled: the time ends it.
    talk(std::max(asked_from - line.now(), Duration::zero()) + kAnswer, [] { return false; });
    std::size_t awaited = 0;
    for (std::size_t i = 0; i < scanner.nodeCount(); ++i) {
      for (std::size_t k = 0; scanner.status(i).state == NodeState::kExchanging && k < kParameters.size(); ++k) {
        const Parameter& parameter = kParameters[k];
        const auto id = static_cast<std::uint32_t>(k);
        if (scanner.submit(i, devicenet::getAttribute(id, kParameterClass, parameter.instance, parameter.attribute))) {
          ++awaited;
        }
      }
    }
    talk(kAnswer, [&] {
      while (const auto answer = scanner.pollAnswer()) {
        values[answer->node][answer->answer.id] = answer->answer.number();
        --awaited;
      }
      return awaited == 0;
    });
  } else if (other.empty()) {
    report.trouble = scanner.busReason().empty() ? line.trouble() : scanner.busReason().str();
    if (report.trouble.empty()) report.trouble = "the duplicate-MAC check did not end";
  }
  for (std::size_t i = 0; i < scanner.nodeCount(); ++i) {
    const NodeStatus& status = scanner.status(i);
    const auto mac = static_cast<std::uint8_t>(i < config.scanner.mac ? i : i + 1);
    if (isSettled(status) || status.vendor_id != 0) {
      report.stations.push_back(stationOf(mac, status));
      addInverter(values[i], report.stations.back());
    }
  }
  if (other.empty()) {
    scanner.releaseAll(line.now());
    talk(kRelease, [&] { return scanner.released(); });
  }
  if (!other.empty()) report.trouble = other;
  if (report.trouble.empty() && end_asked) report.trouble = "ended before every MAC id was asked";
  if (report.trouble.empty() && (report.stations.empty() || line.failed())) report.trouble = line.trouble();
  return report;
}

}  // namespace nord_driver
