// The parameter accesses of one inverter, in the steps that spare its EEPROM and prove that a write has arrived.
//
// Sans-IO: hands out one parameter request at a time and is told its result; the transport does the rest. Its rules:
//  - Nothing is written that is there already: each write first reads. The exception is a persistent write of what this
//    session has only put into the RAM, or somebody else may have (`even_if_same`).
//  - A RAM write uses the orders that spare the EEPROM (AK 11..14). Not every inverter has them: BU 0020 7.5.1 grants
//    them to SK 2xxE and bus modules, BU 2700 6.5.1.1 to all. On error 201 the session remembers that, and writes with
//    the plain orders while P560 = 0, reading P560 before and putting it back after, also when the write fails.
//  - A persistent write needs P560 = 1; with 0 it would look right and be lost at power off, so it is refused.
//  - After each write the value is read back and compared.
//  - Every write that may reach the EEPROM is counted. No manual says where P560 itself is stored: it counts, too.
#pragma once

#include <cstdint>
#include <optional>

#include "core/request_queue.h"
#include "drive/parameter_task.h"
#include "drive/ram_only_values.h"
#include "nord_driver/profile/parameter_request.h"

namespace nord_driver::drive {

/// Each cycle: pollRequest(), and handleResult() when the transport has the answer; pollResult() at any time.
class ParameterSession {
 public:
  /// The most tasks waiting, running, or finished and not fetched.
  static constexpr std::size_t kCapacity = 8;

  /// False: full.
  bool submit(const ParameterTask& task) noexcept;
  /// The next access, when none is under way; its id is for the caller to choose.
  std::optional<profile::ParameterRequest> pollRequest() noexcept;
  /// The result of the request handed out last.
  void handleResult(const profile::ParameterResult& result) noexcept;
  std::optional<ParameterTaskResult> pollResult() noexcept { return tasks_.pollResult(); }
  /// Ends all tasks as offline. The inverter that comes back may be another one: what was learned of it is forgotten.
  void handleOffline() noexcept;

  /// Writes that reached the EEPROM, or may have, since construction.
  std::uint64_t eepromWrites() const noexcept { return eeprom_writes_; }
  /// P560 stands at 0 because of this session and could not be put back yet. Tried again before the next task, and when
  /// the inverter has come back.
  bool owesEepromSwitch() const noexcept { return owes_switch_; }

 private:
  enum class Step : std::uint8_t {
    kNone,
    kReadValue,
    kWriteRam,
    kReadSwitch,      // P560
    kSwitchOff,       // P560 = 0
    kCheckSwitchOff,  // P560 read back
    kWrite,           // by the plain orders
    kSwitchOn,        // P560 = 1
    kCheckSwitchOn,
    kReadBack,
  };

  void begin() noexcept;
  profile::ParameterRequest requestFor(Step step) const noexcept;
  void handleValue(const profile::ParameterResult& result) noexcept;
  void handleRamWrite(const profile::ParameterResult& result) noexcept;
  void handleSwitch(const profile::ParameterResult& result) noexcept;
  void handleSwitchOff(const profile::ParameterResult& result) noexcept;
  void handleWrite(const profile::ParameterResult& result) noexcept;
  void handleSwitchOn(const profile::ParameterResult& result) noexcept;
  void handleReadBack(const profile::ParameterResult& result) noexcept;
  void writePlainly() noexcept;
  bool retryWithoutIndex(const profile::ParameterResult& result) noexcept;
  void putBackOrFinish() noexcept;
  void fail(const profile::ParameterResult& result, std::uint16_t number, const char* note) noexcept;
  void refuse(const char* note) noexcept;
  void finish() noexcept;
  void countWrite(const profile::ParameterResult& result) noexcept;
  void countValueWrite(const profile::ParameterResult& result) noexcept;

  RequestQueue<ParameterTask, ParameterTaskResult, kCapacity> tasks_;
  ParameterTaskResult result_;  // of the running task, as far as it is known
  Step step_ = Step::kNone;
  bool under_way_ = false;       // a request is handed out
  bool recovering_ = false;      // the steps put P560 back, for no task
  bool try_recovery_ = false;    // ... and shall, before the next task
  bool failed_ = false;          // the running task has failed; only P560 is still to be put back
  bool no_index_ = false;        // the running task's parameter turned out to have no sets
  bool ram_orders_ = true;       // false: this inverter answers AK 11..14 with error 201
  bool owes_switch_ = false;     // P560 = 0 may stand because of us
  bool switch_was_off_ = false;  // P560 = 0 was there before us
  std::uint8_t switch_tries_ = 0;
  RamOnlyValues ram_only_;
  std::uint64_t eeprom_writes_ = 0;
};

}  // namespace nord_driver::drive
