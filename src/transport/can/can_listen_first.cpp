#include "transport/can/can_listen_first.h"

#include <algorithm>

namespace nord_driver {

void CanListenFirst::restart(Instant now) noexcept {
  if (who_ == CanListener::kDriver) return postpone(now);
  heard_.reset();
  end_ = now + time_;
  listening_ = true;
}

void CanListenFirst::handle(const CanFrame& frame) noexcept {
  if (listening_ && !heard_ && rules_.shows_other(frame)) heard_ = frame.id;
}

void CanListenFirst::handleMaster(std::uint32_t id, Instant at) noexcept {
  if (who_ == CanListener::kGuest) {
    if (!heard_) heard_ = id;
  } else if (listening_) {
    heard_ = id;
    end_ = at + kGone;
  }
}

void CanListenFirst::postpone(Instant now) noexcept {
  if (!listening_) return;
  const bool waits = heard_ && who_ == CanListener::kDriver;
  end_ = std::max(end_, now + (waits ? Duration{kGone} : time_));
}

bool CanListenFirst::mayTalk(Instant now) noexcept {
  const auto end = nextDeadline();
  if (end && now >= *end) {
    listening_ = false;
    heard_.reset();
  }
  return !isSilent();
}

std::optional<Instant> CanListenFirst::nextDeadline() const noexcept {
  const bool for_good = heard_ && who_ == CanListener::kGuest;
  return listening_ && !for_good ? std::optional<Instant>{end_} : std::nullopt;
}

const char* CanListenFirst::note() const noexcept {
  return heard_ ? rules_.heard_note : rules_.listening_note;
}

Sentence CanListenFirst::text() const noexcept {
  Sentence text;
  if (heard_ && who_ == CanListener::kDriver) {
    text.format(
        "another master works with these nodes: %03Xh was seen; nothing is sent until it has been silent for %d s",
        static_cast<unsigned>(*heard_), static_cast<int>(kGone.count()));
  } else if (heard_) {
    text.format("the bus is in use: %03Xh was seen; nothing is sent beside %s", static_cast<unsigned>(*heard_),
                rules_.beside);
  } else if (listening_) {
    text = "listens for others on the bus before anything is sent";
  }
  return text;
}

}  // namespace nord_driver
