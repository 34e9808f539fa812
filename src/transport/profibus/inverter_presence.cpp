#include "transport/profibus/inverter_presence.h"

namespace nord_driver {

namespace {

constexpr Duration kAskAgain = std::chrono::milliseconds{250};
constexpr Duration kAbsenceLasts = std::chrono::seconds{1};  // where nobody can be asked
constexpr Duration kMayTell = std::chrono::seconds{5};  // P173 behind other records, and the time of a record itself

}  // namespace

void InverterPresence::handleExchange(bool link_broken, const std::array<bool, kMaxInverters>& useful,
                                      Instant now) noexcept {
  link_broken_ = link_broken;
  for (std::size_t i = 0; i < count_; ++i) {
    Inverter& inverter = inverters_[i];
    inverter.useful = useful[i];
    const bool believed = asks_ ? unanswered_since_ && now - *unanswered_since_ >= kMayTell
                                : now - inverter.absent_since >= kAbsenceLasts;
    if (!inverter.useful || believed) inverter.absent = false;  // the status word says it itself from here on
  }
  if (!isOpen()) {
    for (Inverter& inverter : inverters_) inverter.online = inverter.online && inverter.absent;
  }
}

void InverterPresence::handleSilence() noexcept {
  link_broken_ = false;
  inverters_ = {};
  unanswered_since_.reset();
}

void InverterPresence::handleAbsence(std::size_t inverter, Instant now) noexcept {
  inverters_[inverter].absent = true;
  inverters_[inverter].absent_since = now;
  inverters_[inverter].online = false;
}

void InverterPresence::handleModuleStatus(Word status, const std::array<std::uint8_t, kMaxInverters>& number) noexcept {
  constexpr unsigned kOnline = 2;  // bits 10: online; 00 offline, 01 unknown, 11 lost or switched off (P173)
  unanswered_since_.reset();
  for (std::size_t i = 0; i < count_; ++i) {
    inverters_[i].online = (status >> (8u + 2u * (number[i] - 1u)) & 3u) == kOnline;
    if (inverters_[i].online) inverters_[i].absent = false;
  }
}

// A broken link, and every status word looks well: one of several is old.
bool InverterPresence::isOpen() const noexcept {
  if (!link_broken_) return false;
  for (std::size_t i = 0; i < count_; ++i) {
    if (!inverters_[i].useful) return false;
  }
  return true;
}

bool InverterPresence::wantsModuleStatus(Instant now) noexcept {
  bool wanted = isOpen();
  for (std::size_t i = 0; i < count_; ++i) wanted = wanted || inverters_[i].absent;
  if (!wanted) unanswered_since_.reset();
  if (!asks_ || !wanted || now < next_status_) return false;
  if (!unanswered_since_) unanswered_since_ = now;
  next_status_ = now + kAskAgain;
  return true;
}

bool InverterPresence::doubtsDiagnosis(Instant now) noexcept {
  if (!isOpen() || now < next_diagnosis_) return false;
  next_diagnosis_ = now + kAskAgain;
  return true;
}

bool InverterPresence::answers(std::size_t inverter) const noexcept {
  const Inverter& it = inverters_[inverter];
  if (!it.useful || it.absent) return false;
  if (!isOpen()) return true;
  if (count_ == 1) return false;
  // Without P173 the status words are all there is.
  return asks_ ? it.online : true;
}

}  // namespace nord_driver
