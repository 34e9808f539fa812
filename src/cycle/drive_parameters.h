// All parameter traffic of one drive: what the driver reads for itself and what users ask for share one channel.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cycle/completion_queue.h"
#include "cycle/device_reader.h"
#include "cycle/element_reader.h"
#include "cycle/fault_history.h"
#include "cycle/monitor_reader.h"
#include "cycle/request.h"
#include "cycle/word_needs.h"
#include "drive/drive.h"
#include "drive/fault_reader.h"
#include "drive/parameter_session.h"
#include "nord_driver/core/fixed_vector.h"
#include "nord_driver/core/time.h"
#include "nord_driver/profile/series.h"
#include "nord_driver/transport/transport.h"

namespace nord_driver::cycle {

/// A write of P105 (100 % of setpoint 1 and actual value 1) or of P543 to P548 (which setpoints and actual values these
/// are), afterwards the same process data are another speed; or of P104 or P480, which were read for the same reason.
bool changesProcessData(const Request& request) noexcept;
/// A write that decides whether and how the motor follows the process data, the ones above included, and whether they reach
/// it or it trips without them: nothing that may be written while the drive is enabled.
bool decidesMotion(const Request& request) noexcept;
/// Whether all inverters behind a bus module share it, and it acts on each of them: the function of the module's relay, which
/// may be a brake's (BU 0270 P150), its time-out, factory setting and system bus (P151 to P153), what connects its terminals
/// with the inverters (BU 2700 7.1.1, P154); its address, and what its telegrams carry and how often (P160 to P169).
constexpr bool isOfAllBehindModule(std::uint16_t number) noexcept {
  return (number >= 150 && number <= 154) || (number >= 160 && number <= 169);
}

/// The way to the parameters of one drive, and who uses it.
struct ParameterChannelUse {
  TimeoutOwner timeout_owner = TimeoutOwner::kInverter;
  profile::ParameterCapabilities capabilities;
  /// What somebody wants to look at; a set 0 is the one in force.
  std::vector<profile::ParameterRequest> monitor = {};
  WordNeeds needs;                                                    ///< of the words beside the first
  profile::FieldOrder field_order = profile::FieldOrder::kHighFirst;  ///< of a position of SK 700E and 750E
  bool follows = false;                                               ///< another inverter is to lead it
  bool told_by_telegram = false;  ///< P509 and P510 do not count: DriveIdentity::sources_by_telegram
  bool users_only = false;        ///< nothing is read that no user has asked for: neither faults nor what scaling needs
};

/// Each cycle, after the exchange: `handleState`, then `pollRequest` until it is empty, then the transport's results by
/// `handleResult`, and `pollRequest` again when there were any; then `endOverdue` and `pollCompletion`. Each asker has
/// one question under way at most, users several (ParameterSession); a result is given only to the one whose latest
/// question it answers. What is only looked at is asked for while no other question is under way.
class DriveParameters {
 public:
  DriveParameters(DriveIndex drive, std::string name, profile::Series series, std::optional<double> typed_max_frequency,
                  const ParameterChannelUse& channel = {});

  /// Looks whether the drive is there and whether it has a fault; hands it P105 as it is known. Offline: all ends.
  void handleState(drive::Drive& drive, Instant now) noexcept;
  /// It was lost, whether or not it answers again by now: all ends, and everything is read again.
  void handleLoss(drive::Drive& drive) noexcept;
  /// Why a write that `decidesMotion` is not carried out now.
  Sentence notWhileEnabled(const Request& request) const noexcept;
  /// kReadParameter and kWriteParameter; the answer comes as a completion, when the patience of its asker ends at the
  /// latest (`endOverdue`); a request without one (0, of a caller that limits the time itself) waits for the inverter. A
  /// write that changes what the process data mean (`changesProcessData`) takes P105 from the drive until all of them
  /// have been read again: it is not enabled before. Nor is it while another write that `decidesMotion` is under way.
  void handleRequest(const Request& request, drive::Drive& drive, Instant now) noexcept;
  /// Answers whoever waits no longer: what was not begun by then is not written.
  void endOverdue(Instant now) noexcept;

  /// The next access for the transport, with its id.
  std::optional<profile::ParameterRequest> pollRequest(Instant now) noexcept;
  /// True when the result was of this drive, wanted or not.
  bool handleResult(const profile::ParameterResult& result) noexcept;
  std::optional<Completion> pollCompletion() noexcept { return completions_.poll(); }

  /// A user's write that changes what the process data mean is under way, or its effect not read yet.
  bool wordsInDoubt() const noexcept { return writesProcessData() || !reader_.motionAsked(); }
  /// A user's write of what acts on every drive behind a module, isOfAllBehindModule(), waits or is under way.
  bool writesForModule() const noexcept;
  const DeviceData& device() const noexcept { return reader_.data(); }
  /// P151 was written since this was asked last: it is that of every drive behind the same module.
  bool takeModuleWrite() noexcept { return std::exchange(module_written_, false); }
  void readModuleAgain() noexcept;
  const drive::FaultReader& faults() const noexcept { return faults_; }
  const FaultHistory& faultHistory() const noexcept { return history_.history(); }
  /// What a user's choice of an element of the position array needs.
  void askElement(std::uint8_t element) noexcept;
  ElementReader& elements() noexcept { return elements_; }
  /// In the order of ParameterChannelUse::monitor.
  const std::vector<MonitoredValue>& monitored() const noexcept { return monitor_.values(); }
  std::uint64_t eepromWrites() const noexcept { return session_.eepromWrites(); }
  /// P560 was switched off for a user's write and could not be put back yet.
  bool owesEepromSwitch() const noexcept { return session_.owesEepromSwitch(); }

 private:
  enum class Asker : std::uint8_t {
    kFaults,
    kSession,  ///< its first lane; the others follow
    kReader = kSession + drive::ParameterSession::kLanes,
    kElement,
    kHistory,
    kMonitor,
    kCount
  };
  static constexpr std::size_t kAskers = static_cast<std::size_t>(Asker::kCount);
  /// The lane of the session an asker is; none: it is another one.
  static std::optional<unsigned> laneOf(Asker asker) noexcept;

  std::optional<profile::ParameterRequest> ask(Asker asker, Instant now) noexcept;
  bool nothingUnderWay() const noexcept;
  void answer(Asker asker, const profile::ParameterResult& result) noexcept;
  void askForReason(drive::Drive& drive, Instant now) noexcept;
  void scale(drive::Drive& drive) const noexcept;
  static void forgetScale(drive::Drive& drive) noexcept;
  void refuse(const Request& request, profile::ParameterOutcome outcome) noexcept;
  void collect() noexcept;
  void answer(const Request& request, const profile::ParameterResult& result) noexcept;
  void readDeviceAgain() noexcept;
  void readAgain(const Request& request) noexcept;
  void askMissingAgain(Instant now) noexcept;
  bool writesProcessData() const noexcept;
  bool writesMotion() const noexcept;
  bool awaitsMotion() const noexcept;

  DriveIndex drive_;
  std::string name_;
  profile::Series series_;
  std::optional<double> typed_max_frequency_;
  ParameterChannelUse channel_;
  DeviceReader reader_;
  drive::FaultReader faults_;
  drive::ParameterSession session_;
  FaultHistoryReader history_;
  MonitorReader monitor_;
  ElementReader elements_;
  std::array<std::uint32_t, kAskers> open_ids_{};  // of the question under way; 0: none
  std::uint32_t sequence_ = 0;
  bool module_written_ = false;
  bool switch_used_ = false;              // P560 was set to 0 for a user's write
  bool scale_due_ = false;                // the reader learned something the drive was not told yet
  std::uint8_t parameter_set_ = 0;        // in force; 0: not known
  bool bus_control_ = true;               // status bit 9, as seen last
  std::optional<Instant> held_since_;     // idle, and not ready to switch on
  std::optional<Instant> missing_since_;  // one that decides motion was asked for in vain
  struct Pending {
    Request request;
    std::optional<Instant> until;  // the end of its asker's patience; none: answered then, or without a limit
    bool answered = false;         // it was overdue
  };
  FixedVector<Pending, drive::ParameterSession::kCapacity> pending_;
  CompletionQueue<48> completions_;  // a full queue of requests refused, and every access ended
};

}  // namespace nord_driver::cycle
