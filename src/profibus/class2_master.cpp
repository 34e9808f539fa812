#include "profibus/class2_master.h"

namespace nord_driver::profibus {

Class2Master::Class2Master(const BusParameters& bus, const std::vector<StationAddress>& stations,
                           const Class2Times& times)
    : bus_(bus), requester_(bus), services_(bus), listen_(bus.listen_first), stations_(stations) {
  bus.validate();
  frame_counts_.resize(stations.size());
  connections_.reserve(stations.size());
  for (std::size_t i = 0; i < stations.size(); ++i) connections_.emplace_back(i, times);
}

void Class2Master::restart(Instant now) noexcept {
  requester_.restart(now);
  dropAll("the line was opened anew");
  refused_by_.reset();
  listen_.restart(now);
}

bool Class2Master::submitRecord(std::size_t station, const RecordRequest& request) noexcept {
  if (!connections_[station].submit(request)) return false;
  if (refused_by_) connections_[station].drop(RecordOutcome::kOffline, refusal().c_str());
  return true;
}

std::optional<RecordResult> Class2Master::pollRecord() noexcept {
  for (std::size_t i = 0; i < connections_.size(); ++i) {
    const auto result = connections_[result_cursor_].pollResult();
    result_cursor_ = (result_cursor_ + 1) % connections_.size();
    if (result) return result;
  }
  return std::nullopt;
}

void Class2Master::close() noexcept {
  for (Class2Connection& connection : connections_) connection.close();
}

bool Class2Master::wantsBus(Instant now) noexcept {
  advance(now);
  if (requester_.busy()) return true;
  if (!listen_.isListening()) return false;
  for (const Class2Connection& connection : connections_) {
    if (!connection.isClosed()) return true;
  }
  return false;
}

void Class2Master::handleBytes(ByteView bytes, Instant now) noexcept {
  requester_.handleBytes(
      bytes, now,
      [&](const FdlAnswer& answer) {
        frame_counts_[asked_].answered();
        connections_[asked_].handleAnswer(answer, now);
      },
      [&](std::uint8_t master, bool certain, bool echo) { onForeign(master, certain && !echo, now); });
  if (refused_by_ && requester_.busy()) requester_.restart(now);  // what was to be sent is not
  advance(now);
}

void Class2Master::handleTimeout(Instant now) noexcept {
  switch (requester_.handleTimeout(now)) {
    case Requester::Outcome::kNone:
      break;
    case Requester::Outcome::kNoAnswer:
      frame_counts_[asked_].reset();
      connections_[asked_].handleNoAnswer(requester_.lastMismatch());
      break;
    case Requester::Outcome::kLineBusy:
      dropAll("the line never falls silent, so that nothing can be sent");
      break;
  }
  advance(now);
}

ByteView Class2Master::pollTransmit(Instant now) noexcept {
  advance(now);
  return requester_.pollTransmit(now);
}

std::optional<Instant> Class2Master::nextDeadline() const noexcept {
  if (requester_.busy()) return requester_.nextDeadline();
  if (listen_.isListening()) return listen_.end();
  std::optional<Instant> next;
  for (const Class2Connection& connection : connections_) next = earlier(next, connection.nextDeadline());
  return next;
}

void Class2Master::advance(Instant now) noexcept {
  if (requester_.busy() || refused_by_ || !listen_.mayTalk(now)) return;
  for (std::size_t i = 0; i < connections_.size(); ++i) {
    const std::size_t station = (cursor_ + i) % connections_.size();
    if (!connections_[station].wantsTelegram(now)) continue;
    const Class2Connection::Outgoing outgoing = connections_[station].pollTelegram(now);
    services_.class2(request_, stations_[station], outgoing.access_point, outgoing.pdu, frame_counts_[station].bits());
    if (outgoing.last) request_.retries = 0;
    asked_ = station;
    cursor_ = station + 1;
    requester_.begin(request_, &slave_counters_, now);
    return;
  }
}

void Class2Master::onForeign(std::uint8_t master, bool certain, Instant now) noexcept {
  listen_.handleForeign(master, certain, now);
  if (!certain || refused_by_) return;
  refused_by_ = master;
  dropAll(refusal().c_str());
}

Sentence Class2Master::refusal() const noexcept {
  Sentence text;
  if (!refused_by_) return text;
  if (*refused_by_ == bus_.master.value()) {
    text =
        "a second master has our address, or the adapter hands our own bytes back: switch its echo off, or choose "
        "another master_address";
  } else {
    text.format(
        "master %u is on this segment, and its token ring is not joined: a connection of class 2 (MS2) needs to be the "
        "only master here; end the other one, or unplug it",
        unsigned{*refused_by_});
  }
  return text;
}

void Class2Master::dropAll(const char* why) noexcept {
  for (Class2Connection& connection : connections_) connection.drop(RecordOutcome::kOffline, why);
  for (FrameCount& count : frame_counts_) count.reset();
}

}  // namespace nord_driver::profibus
