#include "devicenet/scanner_config.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>

#include "devicenet/identifier.h"
#include "devicenet/io_fragments.h"
#include "nord_driver/core/fixed_text.h"

namespace nord_driver::devicenet {
namespace {

constexpr Duration kShortestRate = std::chrono::milliseconds{25};
constexpr std::size_t kMostNodes = 63;

[[noreturn]] void refuse(const std::string& sentence) {
  throw std::invalid_argument(sentence);
}

std::string milliseconds(Duration time) {
  FixedText<32> text;
  text.format("%.1f ms", toSeconds(time) * 1e3);
  return text.str();
}

std::uint32_t messageBits(std::size_t bytes, std::size_t connection_size) noexcept {
  const std::size_t frames = ioFrames(bytes, connection_size);
  const bool fragmented = connection_size > kUnfragmented;
  const std::size_t fragment_bytes = fragmented ? frames : 0;
  // One frame more costs its 55 bits; the data bytes are the same however they are shared out.
  return static_cast<std::uint32_t>(worstFrameBits(0) * frames + 10 * (bytes + fragment_bytes));
}

std::uint32_t nodeBits(const IoConfig& io) noexcept {
  const std::uint32_t in = messageBits(io.input_bytes, io.input_bytes);
  const std::uint32_t out = messageBits(io.output_bytes, io.output_bytes);
  switch (io.kind) {
    case IoKind::kNone:
      return 0;
    case IoKind::kPoll:
      return in + out;
    case IoKind::kStrobe:
      return isPolledBesideStrobe(io) ? in + out + in : in;
    case IoKind::kChangeOfState:
    case IoKind::kCyclic: {
      const std::uint32_t acknowledge = io.acknowledge ? worstFrameBits(0) : 0;
      return in + acknowledge + (io.output_bytes > 0 ? out + acknowledge : 0);
    }
  }
  return 0;
}

void checkSizes(const std::string& device, const IoConfig& io) {
  if (io.kind == IoKind::kNone) return;
  if (io.input_bytes == 0) {
    refuse(device + ": an input size of 0 bytes cannot be supervised; expected 1 to " + std::to_string(kIoCapacity));
  }
  const std::size_t most = io.kind == IoKind::kStrobe ? kStrobeCommandLength : kIoCapacity;
  if (io.input_bytes > most) {
    refuse(device + ": an input size of " + std::to_string(io.input_bytes) + " bytes; " + toText(io.kind) +
           " carries at most " + std::to_string(most));
  }
  if (io.output_bytes > kIoCapacity) {
    refuse(device + ": an output size of " + std::to_string(io.output_bytes) + " bytes; at most " +
           std::to_string(kIoCapacity) + " are carried");
  }
}

void checkTimes(const std::string& device, const NodeConfig& config, Duration cycle) {
  if (config.connect_timeout <= Duration::zero() || config.request_timeout <= Duration::zero()) {
    refuse(device + ": its time-outs must be above 0");
  }
  const IoConfig& io = config.io;
  if (io.kind == IoKind::kNone || !io.expected_packet_rate) return;
  const Duration rate = *io.expected_packet_rate;
  const auto count = rate / std::chrono::milliseconds{1};
  if (rate % std::chrono::milliseconds{1} != Duration::zero() || count < 1 || count > 0xFFFF) {
    refuse(device + ": an expected packet rate of " + milliseconds(rate) + "; expected whole milliseconds, 1 to 65535");
  }
  if (4 * rate < 2 * cycle) {
    refuse(device + ": with an expected packet rate of " + milliseconds(rate) + " it gives up after " +
           milliseconds(4 * rate) + ", but hears from us only every " + milliseconds(cycle));
  }
  if (io.timeout && *io.timeout < cycle) {
    refuse(device + ": a time-out of " + milliseconds(*io.timeout) + " is shorter than the cycle of " +
           milliseconds(cycle));
  }
}

void checkBus(const ScannerConfig& config) {
  if (config.mac >= kMacIds) refuse("our MAC id " + std::to_string(config.mac) + " is not 0 to 63");
  if (config.bit_rate != 125'000 && config.bit_rate != 250'000 && config.bit_rate != 500'000) {
    refuse("a bit rate of " + std::to_string(config.bit_rate) + " bit/s; DeviceNet has 125000, 250000 and 500000");
  }
  if (config.cycle_time <= Duration::zero()) refuse("the cycle time must be above 0");
  if (config.first_retry <= Duration::zero() || config.longest_retry < config.first_retry ||
      config.fault_pause <= Duration::zero()) {
    refuse("the pauses between two tries must be above 0, and the longest not shorter than the first");
  }
  if (config.nodes.empty() || config.nodes.size() > kMostNodes) {
    refuse(std::to_string(config.nodes.size()) + " devices; a DeviceNet scanner needs 1 to 63");
  }
}

}  // namespace

const char* toText(IoKind kind) noexcept {
  switch (kind) {
    case IoKind::kNone:
      return "explicit messaging";
    case IoKind::kPoll:
      return "poll";
    case IoKind::kStrobe:
      return "bit strobe";
    case IoKind::kChangeOfState:
      return "change of state";
    case IoKind::kCyclic:
      return "cyclic";
  }
  return "unknown";
}

Duration cycleOnWire(const ScannerConfig& config) noexcept {
  std::uint64_t bits = 0;
  bool strobe = false;
  for (const NodeConfig& node : config.nodes) {
    bits += nodeBits(node.io);
    strobe = strobe || node.io.kind == IoKind::kStrobe;
  }
  if (strobe) bits += worstFrameBits(kStrobeCommandLength);
  return Duration{static_cast<Duration::rep>(bits * 1'000'000'000ull / config.bit_rate)};
}

void checkConfig(const ScannerConfig& config) {
  checkBus(config);
  std::map<std::uint8_t, std::size_t> places;
  for (std::size_t i = 0; i < config.nodes.size(); ++i) {
    const NodeConfig& node = config.nodes[i];
    const std::string device = "MAC id " + std::to_string(node.mac);
    if (node.mac >= kMacIds) refuse(device + " is not 0 to 63");
    if (node.mac == config.mac) refuse(device + " is our own and that of a device");
    const auto [place, is_new] = places.emplace(node.mac, i);
    if (!is_new) {
      refuse(device + " is configured twice, as devices " + std::to_string(place->second + 1) + " and " +
             std::to_string(i + 1));
    }
    checkSizes(device, node.io);
    checkTimes(device, node, config.cycle_time);
  }
  const Duration needed = cycleOnWire(config);
  if (needed > config.cycle_time) {
    refuse("a cycle of " + milliseconds(config.cycle_time) + " is asked for, but " +
           std::to_string(config.nodes.size()) + " devices take up to " + milliseconds(needed) + " at " +
           std::to_string(config.bit_rate / 1000) + " kbit/s");
  }
}

ScannerConfig completed(ScannerConfig config) {
  const Duration wanted = std::max<Duration>(2 * config.cycle_time, kShortestRate);
  const auto whole = (wanted + std::chrono::milliseconds{1} - Duration{1}) / std::chrono::milliseconds{1};
  for (NodeConfig& node : config.nodes) {
    if (!node.io.expected_packet_rate) node.io.expected_packet_rate = std::chrono::milliseconds{whole};
  }
  return config;
}

}  // namespace nord_driver::devicenet
