#include "devicenet/bus_watch.h"

#include "devicenet/explicit_message.h"

namespace nord_driver::devicenet {
namespace {

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

void BusWatch::foreignNode(std::uint8_t mac, Instant now) noexcept {
  ++counters_.foreign;
  if (!findings_.isNew(mac)) return;
  Sentence text;
  text.format("a device with MAC id %u is on the bus, but is not configured", unsigned{mac});
  findings_.tell(DevicenetEventKind::kForeignNode, text, mac, now);
}

void BusWatch::secondScanner(const CanFrame& frame, Group2 message, std::uint8_t mac, Instant now) noexcept {
  ++counters_.second_scanner;
  if (!findings_.mayTell(Finding::kSecondScanner, now)) return;
  Sentence text;
  const bool names_master = message == Group2::kMasterExplicit || message == Group2::kUnconnected;
  if (message == Group2::kStrobeCommand) {
    text.format("another master, MAC id %u, is on the bus: it sends %s (%03Xh)", unsigned{mac}, toText(message),
                static_cast<unsigned>(frame.id));
  } else if (names_master && frame.size > 0) {
    text.format("another master, MAC id %u, is on the bus: it sends %s to MAC id %u (%03Xh), which only we should",
                unsigned{frame.data[0]} & explicit_header::kMac, toText(message), unsigned{mac},
                static_cast<unsigned>(frame.id));
  } else {
    text.format("another master is on the bus: it sends %s to MAC id %u (%03Xh), which only we should", toText(message),
                unsigned{mac}, static_cast<unsigned>(frame.id));
  }
  findings_.tell(DevicenetEventKind::kSecondScanner, text, frame.id, now);
}

void BusWatch::malformed(const CanFrame& frame, Instant now) noexcept {
  ++counters_.malformed;
  if (!findings_.mayTell(Finding::kMalformed, now)) return;
  Sentence text;
  text.format("somebody sent a malformed duplicate-MAC message %03Xh (%u bytes%s, expected 7)",
              static_cast<unsigned>(frame.id), unsigned{frame.size}, frame.remote ? ", remote" : "");
  findings_.tell(DevicenetEventKind::kMalformed, text, frame.id, now);
}

}  // namespace nord_driver::devicenet
