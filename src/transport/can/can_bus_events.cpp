#include "transport/can/can_bus_events.h"

#include <cstring>

namespace nord_driver {

namespace {

constexpr Duration kShown = std::chrono::seconds{10};
constexpr Duration kLossPause = std::chrono::seconds{1};

}  // namespace

void CanBusEvents::warn(const Sentence& text, Instant at, bool explains) noexcept {
  tell(text, true);
  if (!explains && isExplained(at)) return;
  if (explains) explained_at_ = at;
  text_ = text;
  text_at_ = at;
}

void CanBusEvents::mention(const Sentence& text, Instant at) noexcept {
  if (std::strcmp(text.c_str(), this->text(at).c_str()) != 0) tell(text, true);
}

void CanBusEvents::noteLostFrames(const char* interface, std::uint64_t lost, Instant now) noexcept {
  if (lost == lost_told_ || now - lost_told_at_ < kLossPause) return;
  lost_told_ = lost;
  lost_told_at_ = now;
  text_.format("%s: received frames were lost, %llu since the start: this computer took them too late", interface,
               static_cast<unsigned long long>(lost));
  text_at_ = now;
  tell(text_, true);
}

void CanBusEvents::tell(const Sentence& text, bool warning) noexcept {
  BusEvent event;
  event.warning = warning;
  event.text = text;
  events_.push_back(event);
}

Sentence CanBusEvents::text(Instant now) const noexcept {
  return now - text_at_ < kShown ? text_ : Sentence{};
}

bool CanBusEvents::isExplained(Instant now) const noexcept {
  return explained_at_ && now - *explained_at_ < kShown;
}

}  // namespace nord_driver
