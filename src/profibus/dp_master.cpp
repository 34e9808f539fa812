#include "profibus/dp_master.h"

#include <algorithm>

namespace nord_driver::profibus {

namespace {

constexpr Duration kListenSlice = std::chrono::milliseconds{2};
constexpr int kRestAfterProbe = 9;        // slots without a probe after one that nobody answered
constexpr int kRestAfterUrgentProbe = 1;  // likewise, for a slave whose watchdog still runs
constexpr Duration kTellForeignAgain = std::chrono::seconds{10};
constexpr const char* kForeign = "another master is on this segment: this driver must be the only one";
constexpr const char* kLeads = "another master leads this segment: nothing is sent for as long as it is heard";
constexpr const char* kOwnAddress =
    "a second master has our address, or the adapter hands our own bytes back: switch its echo off";
constexpr const char* kReleased = "a slave of the synchronised group did not exchange: SYNC and FREEZE are taken back";
constexpr const char* kBusy =
    "the line never falls silent: check polarity, termination and biasing, or another station babbles";

}  // namespace

DpMaster::DpMaster(const BusParameters& bus, const std::vector<SlaveConfig>& slaves)
    : bus_(bus), requester_(bus), listen_(bus.listen_first) {
  bus.validate();
  validate(slaves, bus);
  slaves_.reserve(slaves.size());
  for (std::size_t i = 0; i < slaves.size(); ++i) slaves_.emplace_back(i, slaves[i], bus);
  const DpServices services{bus};
  services.operate(operate_);
  services.synchronise(sync_, true);
  services.synchronise(unsync_, false);
}

void DpMaster::restart(Instant now) noexcept {
  requester_.restart(now);
  for (SlaveHandler& slave : slaves_) slave.restart(now, events_);
  turn_ = Turn::kDone;
  timers_.stopAll();
  told_busy_ = false;
  synchronised_ = false;
  listen_.restart(now);
  given_way_ = false;
}

void DpMaster::startCycle(Instant now) noexcept {
  if (!cycleDone()) return;
  ++requester_.counters().cycles;
  for (SlaveHandler& slave : slaves_) slave.startCycle();
  turn_ = Turn::kListen;
  timers_.set(Timer::kListenSlice, std::min(now + kListenSlice, listen_.end()));
  cursor_ = 0;
  advance(now);
}

void DpMaster::handleBytes(ByteView bytes, Instant now) noexcept {
  requester_.handleBytes(
      bytes, now, [&](const FdlAnswer& answer) { slaves_[asked_].handleAnswer(answer, now, events_); },
      [&](std::uint8_t master, bool certain, bool echo) { onForeign(master, certain, echo, now); });
  if (yield_due_) giveWay(now);
  advance(now);
}

void DpMaster::handleTimeout(Instant now) noexcept {
  if (turn_ == Turn::kListen && timers_.isOver(Timer::kListenSlice, now) && !listen_.mayTalk(now)) turn_ = Turn::kDone;
  switch (requester_.handleTimeout(now)) {
    case Requester::Outcome::kNone:
      break;
    case Requester::Outcome::kNoAnswer:
      if (turn_ == Turn::kProbe) {
        timers_.set(Timer::kNextProbe, now + kRestAfterProbe * bus_.slotTime());
        timers_.set(Timer::kNextUrgentProbe, now + kRestAfterUrgentProbe * bus_.slotTime());
      }
      slaves_[asked_].handleNoAnswer(requester_.lastMismatch(), now, events_);
      break;
    case Requester::Outcome::kLineBusy:
      abandonCycle();
      break;
  }
  advance(now);
}

ByteView DpMaster::pollTransmit(Instant now) noexcept {
  const ByteView bytes = requester_.pollTransmit(now);
  if (bytes.empty()) return bytes;
  told_busy_ = false;
  if (const auto slot_end = requester_.nextDeadline()) slaves_[asked_].handleSent(*slot_end);
  advance(now);  // a broadcast has ended with its sending; its bytes stay where they are
  return bytes;
}

// The cycle in turns; each asks the slaves that want to be asked in it, one request at a time.
void DpMaster::advance(Instant now) noexcept {
  while (!requester_.busy() && turn_ != Turn::kDone) {
    if (turn_ == Turn::kListen && !listen_.mayTalk(now)) break;
    if (!askNext(now)) nextTurn();
  }
  requester_.counters().events_lost = events_.overflow();
}

bool DpMaster::askNext(Instant now) noexcept {
  switch (turn_) {
    case Turn::kListen:
      return false;
    case Turn::kOperate:
      return askOperate(now);
    case Turn::kExchange:
      return askFirst(now, [](const SlaveHandler& slave) { return slave.wantsExchange(); });
    case Turn::kSynchronise:
      return askSynchronise(now);
    case Turn::kStartUp:
      return askFirst(now, [now](const SlaveHandler& slave) { return slave.wantsStartUpStep(now); });
    case Turn::kDiagnosis:
      return askFirst(now, [](const SlaveHandler& slave) { return slave.wantsDiagnosis(); });
    case Turn::kAcyclic:
      return askAcyclic(now);
    case Turn::kProbe:
      return askProbe(now);
    case Turn::kDone:
      break;
  }
  return false;
}

bool DpMaster::askOperate(Instant now) noexcept {
  const bool wanted = bus_.operate_interval > Duration::zero();
  if (!wanted || timers_.isRunning(Timer::kNextOperate, now) || !mayBroadcast()) return false;
  timers_.set(Timer::kNextOperate, now + bus_.operate_interval);
  requester_.begin(operate_, nullptr, now);
  return true;
}

// Whether a broadcast starts the watchdog of a slave anew no manual says. None is left to its own by a master that brings
// watchdogs: a driver's UNSYNC is never held back.
bool DpMaster::mayBroadcast() const noexcept {
  return std::none_of(slaves_.begin(), slaves_.end(),
                      [](const SlaveHandler& slave) { return slave.isLeftToItsWatchdog(); });
}

bool DpMaster::setSynchronised(bool on) noexcept {
  const bool used = bus_.sync_outputs || bus_.freeze_inputs;
  if (on && (!used || !groupExchanged())) return false;
  synchronised_ = on;
  return true;
}

bool DpMaster::groupExchanged() const noexcept {
  return std::all_of(slaves_.begin(), slaves_.end(), [](const SlaveHandler& slave) {
    return !slave.isSynchronised() || slave.status().exchanged_this_cycle;
  });
}

// SYNC is a broadcast nobody acknowledges: it comes in every cycle, and so does UNSYNC, so that a lost one does no
// harm.
bool DpMaster::askSynchronise(Instant now) noexcept {
  if ((!bus_.sync_outputs && !bus_.freeze_inputs) || cursor_ != 0 || !mayBroadcast()) return false;
  cursor_ = slaves_.size() + 1;
  if (synchronised_ && !groupExchanged()) {
    synchronised_ = false;
    DpEvent released;
    released.kind = DpEventKind::kSyncReleased;
    released.text = kReleased;
    events_.push(released);
  }
  requester_.begin(synchronised_ ? sync_ : unsync_, nullptr, now);
  return true;
}

template <typename Wants>
bool DpMaster::askFirst(Instant now, Wants&& wants) noexcept {
  while (cursor_ < slaves_.size()) {
    const std::size_t slave = cursor_++;
    if (!wants(slaves_[slave])) continue;
    ask(slave, now);
    return true;
  }
  return false;
}

// One acyclic telegram per cycle, in turns: the exchange must not wait longer than that.
bool DpMaster::askAcyclic(Instant now) noexcept {
  for (std::size_t i = 0; i < slaves_.size() && cursor_ == 0; ++i) {
    const std::size_t slave = (acyclic_cursor_ + i) % slaves_.size();
    if (!slaves_[slave].wantsAcyclic(now)) continue;
    acyclic_cursor_ = slave + 1;
    cursor_ = slaves_.size();
    asked_ = slave;
    slaves_[slave].prepareAcyclic(request_, now);
    requester_.begin(request_, &slaves_[slave].counters(), now);
    return true;
  }
  return false;
}

std::optional<RecordResult> DpMaster::pollRecord() noexcept {
  for (std::size_t i = 0; i < slaves_.size(); ++i) {
    const auto result = slaves_[record_cursor_].pollRecord();
    record_cursor_ = (record_cursor_ + 1) % slaves_.size();
    if (result) return result;
  }
  return std::nullopt;
}

// One silent slave per cycle, in turns. Each costs a whole slot, which is long where the adapter is slow: however many
// are silent, the others keep nine tenths of the time; half of it, for as long as a lost slave's watchdog may be saved.
bool DpMaster::askProbe(Instant now) noexcept {
  if (cursor_ != 0) return false;
  if (!timers_.isRunning(Timer::kNextUrgentProbe, now) && askProbe(true, now)) return true;
  return !timers_.isRunning(Timer::kNextProbe, now) && askProbe(false, now);
}

bool DpMaster::askProbe(bool urgent, Instant now) noexcept {
  for (std::size_t i = 0; i < slaves_.size(); ++i) {
    const std::size_t slave = (probe_cursor_ + i) % slaves_.size();
    if (!slaves_[slave].wantsProbe(now) || slaves_[slave].isUrgent(now) != urgent) continue;
    probe_cursor_ = slave + 1;
    cursor_ = slaves_.size();
    ask(slave, now);
    return true;
  }
  return false;
}

void DpMaster::ask(std::size_t slave, Instant now) noexcept {
  asked_ = slave;
  slaves_[slave].prepare(request_, now);
  requester_.begin(request_, &slaves_[slave].counters(), now);
}

void DpMaster::nextTurn() noexcept {
  turn_ = static_cast<Turn>(static_cast<std::uint8_t>(turn_) + 1);
  cursor_ = 0;
}

// Nothing was sent: what the slaves did is not known, and the next cycle asks them again.
void DpMaster::abandonCycle() noexcept {
  turn_ = Turn::kDone;
  timers_.stop(Timer::kNextOperate);
  synchronised_ = false;
  if (told_busy_) return;
  told_busy_ = true;
  DpEvent busy;
  busy.kind = DpEventKind::kLineBusy;
  busy.text = kBusy;
  events_.push(busy);
}

// What was to be sent is not, and each slave is begun with anew once the line has been listened to.
void DpMaster::giveWay(Instant now) noexcept {
  yield_due_ = false;
  given_way_ = true;
  requester_.restart(now);
  for (SlaveHandler& slave : slaves_) slave.giveWay(now, events_);
  turn_ = Turn::kDone;
  timers_.stop(Timer::kNextOperate);
  synchronised_ = false;
  listen_.giveWay(now);
}

void DpMaster::onForeign(std::uint8_t master, bool certain, bool echo, Instant now) noexcept {
  const bool yields = bus_.gives_way && certain && !echo;
  yield_due_ = yield_due_ || (yields && !listen_.isListening());
  listen_.handleForeign(master, certain, now);
  if (!certain) return;
  if (foreign_ == master && timers_.isRunning(Timer::kTellForeignAgain, now)) return;
  timers_.set(Timer::kTellForeignAgain, now + kTellForeignAgain);
  foreign_ = master;
  DpEvent foreign;
  foreign.kind = DpEventKind::kForeignMaster;
  foreign.master = master;
  foreign.text = yields ? kLeads : master == bus_.master.value() ? kOwnAddress : kForeign;
  events_.push(foreign);
}

}  // namespace nord_driver::profibus
