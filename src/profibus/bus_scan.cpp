#include "profibus/bus_scan.h"

#include <algorithm>

#include "profibus/frame_count.h"

namespace nord_driver::profibus {

Sentence describe(std::uint8_t address, const ScannedStation& station) noexcept {
  Sentence text;
  switch (station.kind) {
    case ScannedStation::Kind::kSilent:
      return "does not answer";
    case ScannedStation::Kind::kSelf:
      return "is the address of this master";
    case ScannedStation::Kind::kMaster:
      return "is a master";
    case ScannedStation::Kind::kGarbled:
      return "answers garbled: two stations with this address, or a bad line";
    case ScannedStation::Kind::kSlave:
      break;
  }
  const char* const unnamed =
      address == StationAddress::kUnnamed ? ", not addressed yet: set its address to 3 to 125" : "";
  if (!station.ident) {
    text.format("is a slave that does not tell its diagnosis%s", unnamed);
  } else if (station.owner == kNoOwner) {
    text.format("is a slave with the ident number %04Xh%s", *station.ident, unnamed);
  } else {
    text.format("is a slave with the ident number %04Xh, parameterised by master %u%s", *station.ident, station.owner,
                unnamed);
  }
  return text;
}

BusScan::BusScan(const BusParameters& bus) : bus_(bus), requester_(bus), services_(bus), listen_(bus.listen_first) {
  bus.validate();
}

void BusScan::start(Instant now) noexcept {
  requester_.restart(now);
  stations_ = {};
  stations_[bus_.master.value()].kind = ScannedStation::Kind::kSelf;
  refused_by_.reset();
  line_busy_ = false;
  listen_.restart(now);
  step_ = Step::kListen;
  if (listen_.mayTalk(now)) begin(now);
}

void BusScan::handleBytes(ByteView bytes, Instant now) noexcept {
  requester_.handleBytes(
      bytes, now, [&](const FdlAnswer& answer) { onAnswer(answer, now); },
      [&](std::uint8_t master, bool certain, bool echo) { onForeign(master, certain, echo, now); });
  if (done() && requester_.busy()) requester_.restart(now);  // what was to be sent is not
}

void BusScan::handleTimeout(Instant now) noexcept {
  if (step_ == Step::kListen && listen_.mayTalk(now)) return begin(now);
  switch (requester_.handleTimeout(now)) {
    case Requester::Outcome::kNone:
      return;
    case Requester::Outcome::kNoAnswer:
      // A slave that does not tell its diagnosis is still a slave.
      if (step_ == Step::kStatus && requester_.lastMismatch() != Mismatch::kNone) {
        stations_[address_].kind = ScannedStation::Kind::kGarbled;
      }
      return askNext(now);
    case Requester::Outcome::kLineBusy:
      line_busy_ = true;
      step_ = Step::kDone;
      return;
  }
}

ByteView BusScan::pollTransmit(Instant now) noexcept {
  return requester_.pollTransmit(now);
}

std::optional<Instant> BusScan::nextDeadline() const noexcept {
  return step_ == Step::kListen ? listen_.end() : requester_.nextDeadline();
}

void BusScan::begin(Instant now) noexcept {
  began_ = now;
  first_round_ = true;
  askFrom(0, now);
}

// The next silent one.
void BusScan::askFrom(std::uint8_t address, Instant now) noexcept {
  while (address < kAddresses && stations_[address].kind != ScannedStation::Kind::kSilent) ++address;
  if (address >= kAddresses) return endRound(now);
  address_ = address;
  step_ = Step::kStatus;
  services_.fdlStatus(request_, *StationAddress::from(address_));
  requester_.begin(request_, &slave_counters_, now);
}

void BusScan::endRound(Instant now) noexcept {
  const bool silent = std::any_of(stations_.begin(), stations_.end(), [](const ScannedStation& station) {
    return station.kind == ScannedStation::Kind::kSilent;
  });
  const bool again = first_round_ || found_ || now - began_ < kSearch;
  first_round_ = found_ = false;
  if (silent && again) return askFrom(0, now);
  step_ = Step::kDone;
}

void BusScan::askNext(Instant now) noexcept {
  askFrom(static_cast<std::uint8_t>(address_ + 1), now);
}

void BusScan::onAnswer(const FdlAnswer& answer, Instant now) noexcept {
  if (done()) return;  // another master was heard in the same bytes
  ScannedStation& station = stations_[address_];
  found_ = true;
  if (step_ == Step::kDiagnosis) {
    const auto diagnosis = answer.kind == FdlAnswer::Kind::kData ? Diagnosis::from(answer.data) : std::nullopt;
    if (diagnosis) {
      station.ident = diagnosis->ident();
      station.owner = diagnosis->owner();
    }
    return askNext(now);
  }
  if (answer.station_type != StationType::kSlave) {
    station.kind = ScannedStation::Kind::kMaster;
    return askNext(now);
  }
  station.kind = ScannedStation::Kind::kSlave;
  step_ = Step::kDiagnosis;
  services_.slaveDiag(request_, *StationAddress::from(address_), FrameCount{}.bits());
  requester_.begin(request_, &slave_counters_, now);
}

void BusScan::onForeign(std::uint8_t master, bool certain, bool echo, Instant now) noexcept {
  listen_.handleForeign(master, certain, now);
  const bool yields = bus_.gives_way && !echo && !done();
  if (!certain || (step_ != Step::kListen && !yields)) return;
  refused_by_ = master;
  step_ = Step::kDone;
}

}  // namespace nord_driver::profibus
