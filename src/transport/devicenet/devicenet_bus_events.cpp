#include "transport/devicenet/devicenet_bus_events.h"

namespace nord_driver {

namespace {

constexpr Duration kShown = std::chrono::seconds{10};
constexpr Duration kLossPause = std::chrono::seconds{1};

}  // namespace

void DevicenetBusEvents::take(const devicenet::DevicenetEvent& event, unsigned mac) noexcept {
  using Kind = devicenet::DevicenetEventKind;
  Sentence text;
  if (event.node == devicenet::kNoNode) {
    text = event.text;
  } else if (event.kind == Kind::kHeartbeat || event.kind == Kind::kShutdown || event.kind == Kind::kDoubleMac ||
             event.kind == Kind::kMalformed) {
    text.format("MAC id %u: %.220s", mac, event.text.c_str());
  } else {
    return;
  }
  const bool warning = event.kind != Kind::kOnline;
  tell(text, warning);
  if (!warning) return;
  const bool explains = event.kind == Kind::kSecondScanner || event.kind == Kind::kDoubleMac;
  if (!explains && isExplained(event.at)) return;
  if (explains) explained_at_ = event.at;
  text_ = text;
  text_at_ = event.at;
}

void DevicenetBusEvents::noteLostFrames(const char* interface, std::uint64_t lost, Instant now) noexcept {
  if (lost == lost_told_ || now - lost_told_at_ < kLossPause) return;
  lost_told_ = lost;
  lost_told_at_ = now;
  text_.format("%s: received frames were lost, %llu since the start: this computer took them too late", interface,
               static_cast<unsigned long long>(lost));
  text_at_ = now;
  tell(text_, true);
}

void DevicenetBusEvents::tell(const Sentence& text, bool warning) noexcept {
  BusEvent event;
  event.warning = warning;
  event.text = text;
  events_.push_back(event);
}

Sentence DevicenetBusEvents::text(Instant now) const noexcept {
  return now - text_at_ < kShown ? text_ : Sentence{};
}

bool DevicenetBusEvents::isExplained(Instant now) const noexcept {
  return explained_at_ && now - *explained_at_ < kShown;
}

}  // namespace nord_driver
