// A PROFIBUS DP class-1 master for one segment with one master. Sans-IO: bytes and the time go in, bytes, events and
// the next deadline come out. No thread, no clock, no device, no memory taken after construction.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/timer_table.h"
#include "nord_driver/core/bytes.h"
#include "nord_driver/core/time.h"
#include "profibus/bus_parameters.h"
#include "profibus/counters.h"
#include "profibus/dp_event.h"
#include "profibus/dp_services.h"
#include "profibus/listen_first.h"
#include "profibus/requester.h"
#include "profibus/slave_config.h"
#include "profibus/slave_handler.h"
#include "profibus/slave_status.h"

namespace nord_driver::profibus {

/// Calling order: `restart()` whenever the line was opened; then per bus cycle
///
///     master.setOutputs(...);                           // for each slave
///     master.startCycle(now);
///     while (!master.cycleDone()) {
///       link.write(master.pollTransmit(now));           // when not empty
///       wait for bytes until master.nextDeadline();
///       master.handleBytes(bytes, now);                 // when bytes came: before handleTimeout
///       master.handleTimeout(now);                      // harmless before the deadline
///     }
///     while (auto event = master.pollEvent()) ...
///
/// A cycle holds, in this order: Global_Control Operate when it is due; one exchange with each slave in data exchange;
/// SYNC or UNSYNC, where the bus uses it; one step with each slave in its start-up; the diagnosis a slave announced in
/// its exchange; at most one acyclic telegram; a look for one silent slave. Bytes that come between cycles are given to
/// `handleBytes()` too: they are counted, and the pause counts from them.
class DpMaster {
 public:
  /// Throws std::invalid_argument with a sentence: a value out of range, an address twice, a watchdog no slave can be
  /// told.
  DpMaster(const BusParameters& bus, const std::vector<SlaveConfig>& slaves);

  /// The line was (re)opened: every slave from the beginning.
  void restart(Instant now) noexcept;

  /// Begins a bus cycle. Ignored while one is running.
  void startCycle(Instant now) noexcept;
  bool cycleDone() const noexcept { return turn_ == Turn::kDone && !requester_.busy(); }

  void handleBytes(ByteView bytes, Instant now) noexcept;
  /// To be called when `now` has reached `nextDeadline()`; harmless before.
  void handleTimeout(Instant now) noexcept;
  /// Bytes to send now with one write, or none (yet). Valid until the next call that is not const.
  ByteView pollTransmit(Instant now) noexcept;
  /// The end of the slot, or the moment the pause is over and `pollTransmit()` has something; nothing between cycles.
  std::optional<Instant> nextDeadline() const noexcept {
    return turn_ == Turn::kListen ? timers_.at(Timer::kListenSlice) : requester_.nextDeadline();
  }
  std::optional<DpEvent> pollEvent() noexcept { return events_.pop(); }

  /// Reads or writes a record of a slave (DP-V1 class 1) beside data exchange. False when the slave has one under way
  /// or a result not fetched, or when the request is out of range; otherwise one result follows.
  bool submitRecord(std::size_t slave, const RecordRequest& request) noexcept {
    return slaves_[slave].submitRecord(request);
  }
  std::optional<RecordResult> pollRecord() noexcept;

  /// Asks a slave for its configuration (Get_Cfg) beside data exchange; the answer is told by an event. False when it
  /// is not in data exchange.
  bool requestConfiguration(std::size_t slave) noexcept { return slaves_[slave].requestConfiguration(); }
  /// Asks a slave in data exchange for its diagnosis, though it announced none.
  void requestDiagnosis(std::size_t slave) noexcept { slaves_[slave].requestDiagnosis(); }
  /// Configured and reported configuration in words, subject left out.
  Sentence configurationText(std::size_t slave) const noexcept { return slaves_[slave].configurationText(); }

  /// From the next cycle on: SYNC and FREEZE behind the exchanges of every cycle, or UNSYNC and UNFREEZE there. A layer
  /// that stops a drive, or sees a fault, calls this with false in the same cycle. Refused unless the bus is configured
  /// for it and every slave of the group exchanged in the last cycle. One that misses an exchange ends it by itself.
  bool setSynchronised(bool on) noexcept;
  bool isSynchronised() const noexcept { return synchronised_; }

  /// How long data exchange with a slave goes on, with the retries of each cycle, while it does not answer: a slave
  /// stays in it, too, until its watchdog runs out, which is why its time is the most there is. 0, the default: one
  /// exchange without an answer is a loss. Kept over `restart()`.
  void setSilenceLimit(std::size_t slave, Duration limit) noexcept { slaves_[slave].setSilenceLimit(limit); }

  /// Nothing has been sent yet: the line is listened to (`BusParameters::listen_first`).
  bool isListening() const noexcept { return listen_.isListening(); }
  /// Likewise, after it has led: for another master (`BusParameters::gives_way`).
  bool hasGivenWay() const noexcept { return given_way_ && isListening(); }

  std::size_t slaveCount() const noexcept { return slaves_.size(); }
  /// Kept, and sent with every exchange from now on. Cut or filled with zeros to the configured length.
  void setOutputs(std::size_t slave, ByteView outputs) noexcept { slaves_[slave].setOutputs(outputs); }
  /// The last valid ones, zeros before the first; fresh only with `status().exchanged_this_cycle`.
  ByteView inputs(std::size_t slave) const noexcept { return slaves_[slave].inputs(); }
  const SlaveStatus& status(std::size_t slave) const noexcept { return slaves_[slave].status(); }
  const Counters& counters() const noexcept { return requester_.counters(); }

 private:
  enum class Turn : std::uint8_t {
    kListen,
    kOperate,
    kExchange,
    kSynchronise,
    kStartUp,
    kDiagnosis,
    kAcyclic,
    kProbe,
    kDone
  };
  enum class Timer : std::uint8_t {
    kListenSlice,       ///< a cycle listens no longer than that
    kNextProbe,         ///< silent slaves take a tenth of the time at most
    kNextUrgentProbe,   ///< those whose watchdog has not run out yet: a half
    kNextOperate,       ///< until then Global_Control Operate need not be repeated
    kTellForeignAgain,  ///< until then the same foreign master is not told
    kCount
  };

  void advance(Instant now) noexcept;
  bool askNext(Instant now) noexcept;
  bool askSynchronise(Instant now) noexcept;
  bool groupExchanged() const noexcept;
  bool mayBroadcast() const noexcept;
  bool askOperate(Instant now) noexcept;
  template <typename Wants>
  bool askFirst(Instant now, Wants&& wants) noexcept;
  bool askAcyclic(Instant now) noexcept;
  bool askProbe(Instant now) noexcept;
  bool askProbe(bool urgent, Instant now) noexcept;
  void ask(std::size_t slave, Instant now) noexcept;
  void nextTurn() noexcept;
  void abandonCycle() noexcept;
  void onForeign(std::uint8_t master, bool certain, bool echo, Instant now) noexcept;
  void giveWay(Instant now) noexcept;

  BusParameters bus_;
  Requester requester_;
  std::vector<SlaveHandler> slaves_;
  DpEvents events_;
  FdlRequest operate_, sync_, unsync_;  // the same bytes every time
  ListenFirst listen_;
  TimerTable<Timer> timers_;
  bool synchronised_ = false;
  FdlRequest request_;
  Turn turn_ = Turn::kDone;
  std::size_t cursor_ = 0;  // next slave to look at in this turn
  std::size_t asked_ = 0;   // slave of `request_`
  std::size_t acyclic_cursor_ = 0;
  std::size_t record_cursor_ = 0;  // results are fetched in turns
  std::size_t probe_cursor_ = 0;   // silent slaves take turns
  std::uint8_t foreign_ = kNoOwner;
  bool told_busy_ = false;
  bool yield_due_ = false;  // when what was received has been looked at
  bool given_way_ = false;
};

}  // namespace nord_driver::profibus
