#include "transport/canopen/canopen_scanner.h"

#include <array>
#include <cstdio>
#include <map>
#include <utility>
#include <vector>

#include "canopen/nmt.h"
#include "canopen/sdo_client.h"
#include "transport/can/can_scan_line.h"
#include "transport/canopen/canopen_config.h"
#include "transport/canopen/canopen_listening.h"

namespace nord_driver {

namespace {

constexpr unsigned kLastNode = 127;
constexpr Duration kAnswer = std::chrono::milliseconds{300};
constexpr Duration kLongest = std::chrono::seconds{20};  // of the whole scan

struct Object {
  std::uint16_t index;
  std::uint8_t sub_index;
};
constexpr Object kDeviceType{0x1000, 0};
// Parameters are at 2000h and their number (BU 0060 p. 61): P707, P742, P743.
constexpr std::array<Object, 8> kObjects{Object{0x1008, 0}, Object{0x1018, 1}, Object{0x1018, 2}, Object{0x1018, 3},
                                         Object{0x22C3, 1}, Object{0x22C3, 2}, Object{0x22E6, 0}, Object{0x22E7, 0}};
enum : std::size_t { kName, kVendor, kProduct, kRevision, kVersion, kSubversion, kDatabase, kPower };

// Frames only a master sends: NMT, SYNC, RPDOs and SDO requests of the pre-defined connection set (CiA 301 7.3.3).
bool isOfMaster(const CanFrame& frame) noexcept {
  if (frame.extended) return false;
  const std::uint32_t type = frame.id & 0x780u;
  const bool of_all = frame.id == 0x000 || frame.id == 0x080;
  return of_all || type == 0x200 || type == 0x300 || type == 0x400 || type == 0x500 || type == 0x600;
}

/// One node id, asked object by object.
class Node {
 public:
  explicit Node(std::uint8_t id) : id_(id), client_(canopen::defaultSdoChannel(id), kAnswer) {}

  bool done() const { return done_; }
  bool answered() const { return answered_; }
  /// Its time begins when its first frame leaves: on a slow bus that of the last one does so seconds after the first.
  bool poll(CanFrame& frame, Instant now) {
    if (!std::exchange(started_, true)) ask(kDeviceType, now);
    return !done_ && client_.pollTransmit(frame);
  }
  std::optional<Instant> deadline() const { return done_ ? std::nullopt : client_.nextDeadline(); }

  void handle(const CanFrame& frame, Instant now) {
    client_.handle(frame, now);
    take(now);
  }
  void handleTime(Instant now) {
    client_.poll(now);
    take(now);
  }
  void handleErrorControl(std::uint8_t state) { state_ = static_cast<std::uint8_t>(state & 0x7Fu); }

  FoundStation station() const {
    FoundStation station;
    station.number = id_;
    const bool is_inverter = numbers_.count(kVersion) > 0 || numbers_.count(kDatabase) > 0;
    station.module = name_.empty() ? format("device type %08lXh", device_type_) : name_;
    if (is_inverter && station.module.find("NORD") == std::string::npos) station.module += ", with NORD's parameters";
    if (numbers_.count(kDatabase) > 0) station.series = format("P742 = %lu", numbers_.at(kDatabase));
    if (numbers_.count(kPower) > 0) {
      station.series += (station.series.empty() ? "" : ", ") + format("P743 = %lu", numbers_.at(kPower));
    }
    if (numbers_.count(kVersion) > 0) {
      station.version = format("inverter P707 = %lu", numbers_.at(kVersion));
      if (numbers_.count(kSubversion) > 0) station.version += format(" R%lu", numbers_.at(kSubversion));
    }
    if (numbers_.count(kVendor) > 0) {
      station.note = format("vendor %08lXh", numbers_.at(kVendor));
      if (numbers_.count(kProduct) > 0) station.note += format(", product %08lXh", numbers_.at(kProduct));
      if (numbers_.count(kRevision) > 0) station.note += format(", revision %08lXh", numbers_.at(kRevision));
    }
    if (state_) {
      station.note +=
          std::string(station.note.empty() ? "" : ", ") + "heard: " + canopen::toText(canopen::nmtStateOf(*state_));
    }
    return station;
  }
  bool heard() const { return state_.has_value(); }

 private:
  static std::string format(const char* pattern, unsigned long value) {
    char text[64];
    std::snprintf(text, sizeof text, pattern, value);
    return text;
  }

  void ask(const Object& object, Instant now) {
    client_.start(canopen::sdoRead(0, object.index, object.sub_index), now);
  }

  void take(Instant now) {
    const auto answer = done_ ? std::nullopt : client_.takeAnswer();
    if (!answer) return;
    const bool silent = answer->end == canopen::SdoEnd::kTimedOut;
    if (!answered_) {
      answered_ = !silent;
      device_type_ = answer->number().value_or(0);
    } else if (next_ - 1 == kName) {
      for (const std::uint8_t letter : answer->data) {
        if (answer->ok() && letter >= 0x20 && letter < 0x7F) name_ += static_cast<char>(letter);
      }
    } else if (const auto number = answer->number()) {
      numbers_[next_ - 1] = *number;
    }
    if (silent || next_ == kObjects.size()) {
      done_ = true;  // what is left in the client, an abort, has no one to hear it
      return;
    }
    ask(kObjects[next_++], now);
  }

  std::uint8_t id_;
  canopen::SdoClient client_;
  bool started_ = false;
  bool answered_ = false;
  bool done_ = false;
  std::size_t next_ = 0;  // of kObjects
  unsigned long device_type_ = 0;
  std::string name_;
  std::map<std::size_t, unsigned long> numbers_;
  std::optional<std::uint8_t> state_;  // of its error control
};

}  // namespace

ScanReport scanCanopen(const Settings& bus,
                       const std::function<std::unique_ptr<link::CanLink>(const link::CanSettings&)>& make_link,
                       const std::atomic<bool>& end_asked) {
  ScanReport report;
  report.bus = "CANopen";
  report.number_name = "node";
  const std::unique_ptr<link::CanLink> link = make_link(readCanopenLink(bus));
  CanScanLine line{*link, end_asked};
  std::vector<Node> nodes;
  nodes.reserve(kLastNode);
  for (unsigned id = 1; id <= kLastNode; ++id) nodes.emplace_back(static_cast<std::uint8_t>(id));
  const auto heed = [&](const CanFrame& frame, Instant) {
    const std::uint32_t id = frame.id & 0x7Fu;
    if (frame.extended || frame.remote || id == 0 || frame.size != 1) return;
    if ((frame.id & 0x780u) == canopen::kErrorControlBase) nodes[id - 1].handleErrorControl(frame.data[0]);
  };
  report.trouble = line.open(kCanopenListening, heed);
  std::string other;
  if (report.trouble.empty()) {
    const auto all_done = [&] {
      return !other.empty() || std::all_of(nodes.begin(), nodes.end(), [](const Node& node) { return node.done(); });
    };
    const auto next_frame = [&](CanFrame& frame) {
      return std::any_of(nodes.begin(), nodes.end(), [&](Node& node) { return node.poll(frame, line.now()); });
    };
    const auto next_look = [&](Instant seen) {
      Instant next = Instant::max();
      for (Node& node : nodes) {
        node.handleTime(seen);
        if (const auto deadline = node.deadline()) next = std::min(next, *deadline);
      }
      return next;
    };
    const auto handle = [&](const CanFrame& frame, Instant at) {
      if (isOfMaster(frame) && other.empty()) {
        char text[96];
        std::snprintf(text, sizeof text, "another master began to work with the bus: %03Xh was seen; ended",
                      static_cast<unsigned>(frame.id));
        other = text;
      }
      heed(frame, at);
      const std::uint32_t id = frame.id & 0x7Fu;
      if ((frame.id & 0x780u) == 0x580 && id != 0) nodes[id - 1].handle(frame, at);
    };
    line.talk(line.now() + kLongest, next_frame, next_look, handle, all_done);
    report.trouble = other;
    if (report.trouble.empty() && (line.failed() || (!all_done() && !end_asked))) report.trouble = line.trouble();
    if (report.trouble.empty() && !all_done()) report.trouble = "ended before every node was asked";
  }
  for (const Node& node : nodes) {
    if (!node.answered() && !node.heard()) continue;
    report.stations.push_back(node.station());
    if (!node.answered()) report.stations.back().module = "does not answer SDO";
  }
  if (report.trouble.empty() && report.stations.empty()) report.trouble = line.trouble();
  return report;
}

}  // namespace nord_driver
