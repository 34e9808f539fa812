#include "devicenet/node_report.h"

namespace nord_driver::devicenet {
namespace {

/// A broken device must not fill the queue of events.
constexpr Duration kMalformedPause = std::chrono::seconds{1};

}  // namespace

const char* toText(NodeState state) noexcept {
  switch (state) {
    case NodeState::kAbsent:
      return "absent";
    case NodeState::kConnecting:
      return "connecting";
    case NodeState::kExchanging:
      return "exchanging";
    case NodeState::kLost:
      return "lost";
    case NodeState::kRefused:
      return "refused";
    case NodeState::kReleased:
      return "released";
  }
  return "unknown";
}

void NodeReport::enter(NodeState state, const Sentence& reason, Instant now) noexcept {
  if (status_.state != state) status_.since = now;
  status_.state = state;
  status_.reason = reason;
}

void NodeReport::tell(DevicenetEventKind kind, const Sentence& text, std::uint32_t value, Instant now) noexcept {
  DevicenetEvent event;
  event.kind = kind;
  event.node = node_;
  event.value = value;
  event.at = now;
  event.text = text;
  events_.push(event);
}

void NodeReport::malformed(const CanFrame& frame, const char* what, Instant now) noexcept {
  ++status_.counters.malformed;
  ++counters_.malformed;
  if (told_malformed_ && now - *told_malformed_ < kMalformedPause) return;
  told_malformed_ = now;
  Sentence text;
  text.format("sent a malformed frame %03Xh: %s (%u bytes%s)", static_cast<unsigned>(frame.id), what,
              static_cast<unsigned>(frame.size), frame.remote ? ", remote" : "");
  tell(DevicenetEventKind::kMalformed, text, frame.id, now);
}

}  // namespace nord_driver::devicenet
