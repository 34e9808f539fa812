// The parameter accesses of one inverter, in the steps that spare its EEPROM and prove that a write has arrived.
//
// Sans-IO: hands out one parameter request at a time and is told its result; the transport does the rest. Its rules:
//  - Nothing is written that is there already: each write first reads. The exception is a persistent write of what this
//    session has only put into the RAM, or somebody else may have (`even_if_same`).
//  - A RAM write uses the order that spares the EEPROM, where the transport has one (`ram_writes`). Not every inverter
//    knows it: BU 0020 7.5.1 grants it to SK 2xxE and bus modules, BU 2700 6.5.1.1 to all. Refused with kNotSupported,
//    the session remembers that, and writes with the plain orders while P560 = 0, reading P560 before and putting it
//    back after, also when the write fails.
//  - A persistent write needs P560 = 1; with 0 it would look right and be lost at power off, so it is refused.
//  - After each write the value is read back and compared.
//  - Every write that may reach the EEPROM is counted. No manual says where P560 itself is stored: it counts, too.
#pragma once

#include <cstdint>
#include <optional>

#include "core/request_queue.h"
#include "drive/ram_only_values.h"
#include "nord_driver/core/fixed_vector.h"
#include "nord_driver/profile/parameter_request.h"

namespace nord_driver::drive {

/// Each cycle: pollRequest(), and handleResult() when the transport has the answer; pollResult() at any time.
///
/// Several accesses may be under way, each in a lane of its own: a user's read, and ahead of their turn the reads behind
/// it, so that the way to the inverter never waits for the next question. Nothing is read ahead of a write, or behind
/// one.
class ParameterSession {
 public:
  /// The most requests waiting, running, or finished and not fetched.
  static constexpr std::size_t kCapacity = 8;
  /// So many answers of a quick drive come within a bus cycle of usual length.
  static constexpr unsigned kLanes = 4;

  explicit ParameterSession(const profile::ParameterCapabilities& capabilities = {}) noexcept
      : capabilities_(capabilities), ram_writes_(capabilities.ram_writes) {}

  /// A user's request, its set 1..4 where it has one. False: full.
  bool submit(const profile::ParameterRequest& request) noexcept;
  /// What a write that nobody waits for any more has done, or will do.
  enum class Withdrawn : std::uint8_t {
    kNothing,     ///< it had not begun, and is not carried out any more; or it is a read
    kRamOnly,     ///< an order that spares the EEPROM is under way, or was answered: no other one follows
    kMayBeSaved,  ///< the value, or P560, may reach the EEPROM
  };
  /// Whoever asked waits no longer: what has not begun to be written is not written.
  Withdrawn withdraw(std::uint32_t id) noexcept;
  /// The next access, when this lane, below kLanes, is free and something may go out by it; its id is for the caller to
  /// choose.
  std::optional<profile::ParameterRequest> pollRequest(unsigned lane = 0) noexcept;
  /// The result of the request handed out last by this lane.
  void handleResult(const profile::ParameterResult& result, unsigned lane = 0) noexcept;
  /// Of a user's request, by its id: the transport's, and what this session adds to it.
  std::optional<profile::ParameterResult> pollResult() noexcept { return requests_.pollResult(); }
  /// Ends all requests as offline. The inverter that comes back may be another one: what was learned of it is
  /// forgotten.
  void handleOffline() noexcept;

  /// Writes that reached the EEPROM, or may have, since construction.
  std::uint64_t eepromWrites() const noexcept { return eeprom_writes_; }
  /// P560 stands at 0 because of this session and could not be put back yet. Tried again before the next request, and
  /// when the inverter has come back.
  bool owesEepromSwitch() const noexcept { return switch_ != EepromSwitch::kNotOurs; }

 private:
  static constexpr std::uint16_t kSaveInEeprom = 560;

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
  /// What becomes of P560.
  enum class EepromSwitch : std::uint8_t {
    kNotOurs,   // it stands as its owner wants it
    kOwed,      // 0 because of us, or it may be
    kRetryDue,  // ... and is put back before anything else is begun
  };
  /// One way through the steps, begun with defaults.
  struct Run {
    bool recovery = false;        // puts P560 back, for no request
    bool failed = false;          // only P560 is still to be put back
    bool withdrawn = false;       // nobody waits for it any more
    bool no_index = false;        // the parameter turned out to have no sets
    bool switch_was_off = false;  // P560 = 0 was there before us
    std::uint8_t switch_tries = 0;
    profile::ParameterResult result;  // as far as it is known
  };

  /// The read of a request behind the running one.
  struct Ahead {
    unsigned lane = 0;
    std::optional<profile::ParameterResult> result;  // it came before that of one ahead of it
  };

  void begin() noexcept;
  void beginAhead() noexcept;
  std::optional<profile::ParameterRequest> readAhead(unsigned lane) noexcept;
  profile::ParameterRequest requestFor(Step step) const noexcept;
  void handleValue(const profile::ParameterResult& result) noexcept;
  void handleRamWrite(const profile::ParameterResult& result) noexcept;
  void handleSwitch(const profile::ParameterResult& result) noexcept;
  void handleRecoverySwitch(const profile::ParameterResult& result) noexcept;
  void handleSwitchOff(const profile::ParameterResult& result) noexcept;
  void handleWrite(const profile::ParameterResult& result) noexcept;
  void handleSwitchOn(const profile::ParameterResult& result) noexcept;
  void handleReadBack(const profile::ParameterResult& result) noexcept;
  void writePlainly() noexcept;
  /// Written by the plain orders, its value reaches the EEPROM.
  bool isSaved() const noexcept;
  bool retryWithoutIndex(const profile::ParameterResult& result) noexcept;
  void putBackOrFinish() noexcept;
  void fail(const profile::ParameterResult& result, std::uint16_t number, const char* note) noexcept;
  void refuse(const char* note) noexcept;
  void finish() noexcept;
  void countWrite(const profile::ParameterResult& result) noexcept;
  void countValueWrite(const profile::ParameterResult& result) noexcept;

  profile::ParameterCapabilities capabilities_;
  RequestQueue<profile::ParameterRequest, profile::ParameterResult, kCapacity> requests_;
  Step step_ = Step::kNone;
  bool under_way_ = false;                // the request of this step is handed out
  unsigned lane_ = 0;                     // by which
  FixedVector<Ahead, kLanes - 1> ahead_;  // in the order of their requests
  Run run_;                               // while step_ is not kNone
  EepromSwitch switch_ = EepromSwitch::kNotOurs;
  bool ram_writes_;  // false: this inverter, or the way to it, knows no write that spares the EEPROM
  RamOnlyValues ram_only_;
  std::uint64_t eeprom_writes_ = 0;
};

}  // namespace nord_driver::drive
