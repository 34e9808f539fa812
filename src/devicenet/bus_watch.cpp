#include "devicenet/bus_watch.h"

namespace nord_driver::devicenet {
namespace {

constexpr Duration kPause = std::chrono::seconds{1};
constexpr std::uint8_t kMacMask = 0x3F;

const char* toText(Group2 message) noexcept {
  switch (message) {
    case Group2::kStrobeCommand:
      return "a bit strobe command";
    case Group2::kMasterAcknowledge:
      return "an acknowledge of process data";
    case Group2::kMasterExplicit:
      return "an explicit request";
    case Group2::kMasterIo:
      return "process data";
    case Group2::kUnconnected:
      return "a request to allocate or release";
    default:
      return "a frame";
  }
}

}  // namespace

void BusWatch::restart() noexcept {
  told_nodes_.reset();
  told_master_.reset();
  told_malformed_.reset();
}

void BusWatch::foreignNode(std::uint8_t mac, Instant now) noexcept {
  ++counters_.foreign;
  if (told_nodes_[mac]) return;
  told_nodes_[mac] = true;
  Sentence text;
  text.format("a device with MAC id %u is on the bus, but is not configured", unsigned{mac});
  tell(DevicenetEventKind::kForeignNode, text, mac, now);
}

void BusWatch::secondScanner(const CanFrame& frame, Group2 message, std::uint8_t mac, Instant now) noexcept {
  ++counters_.second_scanner;
  if (!again(told_master_, now)) return;
  Sentence text;
  const bool names_master = message == Group2::kMasterExplicit || message == Group2::kUnconnected;
  if (message == Group2::kStrobeCommand) {
    text.format("another master, MAC id %u, is on the bus: it sends %s (%03Xh)", unsigned{mac}, toText(message),
                static_cast<unsigned>(frame.id));
  } else if (names_master && frame.size > 0) {
    text.format("another master, MAC id %u, is on the bus: it sends %s to MAC id %u (%03Xh), which only we should",
                unsigned{frame.data[0]} & kMacMask, toText(message), unsigned{mac}, static_cast<unsigned>(frame.id));
  } else {
    text.format("another master is on the bus: it sends %s to MAC id %u (%03Xh), which only we should", toText(message),
                unsigned{mac}, static_cast<unsigned>(frame.id));
  }
  tell(DevicenetEventKind::kSecondScanner, text, frame.id, now);
}

void BusWatch::malformed(const CanFrame& frame, Instant now) noexcept {
  ++counters_.malformed;
  if (!again(told_malformed_, now)) return;
  Sentence text;
  text.format("somebody sent a malformed duplicate-MAC message %03Xh (%u bytes%s, expected 7)",
              static_cast<unsigned>(frame.id), unsigned{frame.size}, frame.remote ? ", remote" : "");
  tell(DevicenetEventKind::kMalformed, text, frame.id, now);
}

void BusWatch::tell(DevicenetEventKind kind, const Sentence& text, std::uint32_t value, Instant now) noexcept {
  DevicenetEvent event;
  event.kind = kind;
  event.value = value;
  event.at = now;
  event.text = text;
  events_.push(event);
}

bool BusWatch::again(std::optional<Instant>& told, Instant now) noexcept {
  if (told && now - *told < kPause) return false;
  told = now;
  return true;
}

}  // namespace nord_driver::devicenet
