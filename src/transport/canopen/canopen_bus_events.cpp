#include "transport/canopen/canopen_bus_events.h"

namespace nord_driver {

namespace {

constexpr Duration kShown = std::chrono::seconds{10};
constexpr Duration kLossPause = std::chrono::seconds{1};

}  // namespace

void CanopenBusEvents::take(const canopen::CanopenEvent& event, unsigned node_id) noexcept {
  using Kind = canopen::CanopenEventKind;
  Sentence text;
  if (event.node == canopen::kNoNode) {
    text = event.text;
  } else if (event.kind == Kind::kToggleError || event.kind == Kind::kBootUpRepeated || event.kind == Kind::kDoubleId ||
             event.kind == Kind::kMalformed) {
    text.format("node %u: %s", node_id, event.text.c_str());
  } else {
    return;
  }
  tell(text);
  const bool explains = event.kind == Kind::kSecondMaster || event.kind == Kind::kDoubleId;
  if (!explains && isExplained(event.at)) return;
  if (explains) explained_at_ = event.at;
  text_ = text;
  text_at_ = event.at;
}

void CanopenBusEvents::noteLostFrames(const char* interface, std::uint64_t lost, Instant now) noexcept {
  if (lost == lost_told_ || now - lost_told_at_ < kLossPause) return;
  lost_told_ = lost;
  lost_told_at_ = now;
  text_.format("%s: received frames were lost, %llu since the start: this computer took them too late", interface,
               static_cast<unsigned long long>(lost));
  text_at_ = now;
  tell(text_);
}

void CanopenBusEvents::tell(const Sentence& text) noexcept {
  BusEvent event;
  event.text = text;
  events_.push_back(event);
}

Sentence CanopenBusEvents::text(Instant now) const noexcept {
  return now - text_at_ < kShown ? text_ : Sentence{};
}

bool CanopenBusEvents::isExplained(Instant now) const noexcept {
  return explained_at_ && now - *explained_at_ < kShown;
}

}  // namespace nord_driver
