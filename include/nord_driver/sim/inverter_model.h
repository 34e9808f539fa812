// A simulated frequency inverter: status machine, ramps, parameter sets, faults and time-outs.
//
// Written from BU 2700 6.4 and 7.1.1 and BU 0020 7.3 and 8. It is fed with control words and time, and knows no bus:
// the module (DpSlave) hands it what arrived, and says when its master or its link is gone.
#pragma once

#include <array>
#include <cstdint>

#include "nord_driver/core/time.h"
#include "nord_driver/sim/motor.h"
#include "nord_driver/sim/parameter_store.h"
#include "nord_driver/sim/words.h"

namespace nord_driver::sim {

/// BU 2700 6.4.3, A to H; kOff: no mains.
enum class InverterState : std::uint8_t {
  kOff,
  kNotReadyToSwitchOn,
  kSwitchOnDisabled,
  kReadyToSwitchOn,
  kSwitchedOn,
  kOperationEnabled,
  kQuickStopActive,
  kFaultReactionActive,
  kFault,
};

const char* toString(InverterState state) noexcept;

/// Control word and setpoints 1-3 of one telegram.
struct ProcessData {
  Word control = 0;
  std::array<Word, 3> setpoints{};
};

/// Fault numbers as P700 shows them, ten times the printed number: BU 2700 8.3.
namespace fault {
constexpr std::uint16_t kMasterLost = 102;  ///< E10.2 PROFIBUS watchdog
constexpr std::uint16_t kTimeout = 103;     ///< E10.3 time-out by P151/P513
constexpr std::uint16_t kModuleLink = 108;  ///< E10.8 connection to the bus interface interrupted
}  // namespace fault

class InverterModel {
 public:
  /// Both must outlive the model. `charging_time`: from mains on until the charging relay has engaged.
  InverterModel(ParameterStore& parameters, Motor& motor, Duration charging_time);

  /// Lets `span` pass, in steps of at most a millisecond.
  void advance(Duration span) noexcept;

  void setPowered(bool on) noexcept;
  bool powered() const noexcept { return state_ != InverterState::kOff; }

  /// Process data from the bus module. With bit 10 = 0 they are not evaluated (BU 2700 6.4.1 note 2).
  void receive(const ProcessData& data) noexcept;
  /// The module's watchdog expired: E10.2, unless P513 = -0.1 (BU 2700 7.1.1).
  void masterLost() noexcept;
  /// The connection to the module broke (E10.8, unless P513 = -0.1) or is back.
  void setModuleLink(bool intact) noexcept;

  /// A fault by number (102 = E10.2). With `cause_stays` it cannot be acknowledged before `clearCause()`.
  void trip(std::uint16_t number, bool cause_stays) noexcept;
  void clearCause() noexcept { tripped_cause_ = false; }
  /// A warning's number in P700[-02]; 0 ends it.
  void setWarning(std::uint16_t number) noexcept;

  /// Control by the terminals (status bit 9 = 0). They enable the drive when `setpoint` is not zero, else they say
  /// OFF1.
  void setLocalControl(bool on, double setpoint_hz = 0.0) noexcept;

  Word statusWord() const noexcept;
  /// Actual value 1-3 (`n` = 0-2) by the function in P543-P545.
  Word actualValue(unsigned n) const noexcept;

  InverterState state() const noexcept { return state_; }
  double frequency() const noexcept { return frequency_; }        ///< output frequency, Hz, signed
  unsigned parameterSet() const noexcept { return set_; }         ///< 0-3
  std::uint16_t faultNumber() const noexcept { return fault_; }   ///< 0 = none
  Word setpoint1() const noexcept { return data_.setpoints[0]; }  ///< the last valid one
  std::uint64_t setSwitches() const noexcept { return set_switches_; }
  bool busControl() const noexcept;

 private:
  void step(double dt) noexcept;
  void evaluate() noexcept;
  void follow(double dt) noexcept;
  void watchTimeout(double dt) noexcept;
  void enter(InverterState next) noexcept;
  void selectParameterSet(unsigned set) noexcept;
  bool acknowledge() noexcept;
  void acknowledgeByItself() noexcept;
  bool causeStands() const noexcept;
  bool inputAcknowledges() const noexcept;
  bool ignoresBusErrors() const noexcept;
  Word command() const noexcept;
  double setpointFrequency() const noexcept;
  Word functionValue(std::int32_t function) const noexcept;

  ParameterStore& parameters_;
  Motor& motor_;
  double charging_time_;

  InverterState state_ = InverterState::kOff;
  double in_state_ = 0.0;  // s
  bool commanded_ = false;
  ProcessData data_;  // the last ones with bit 10 = 1
  unsigned set_ = 0;
  double frequency_ = 0.0;
  double target_ = 0.0;

  bool local_ = false;
  double local_setpoint_ = 0.0;

  std::uint16_t fault_ = 0;
  std::uint16_t warning_ = 0;
  bool tripped_cause_ = false;
  bool master_lost_ = false;
  bool timed_out_ = false;
  bool link_broken_ = false;
  double since_valid_ = 0.0;  // s since the last word with bit 10 = 1
  int automatic_acknowledgements_ = 0;
  std::uint64_t set_switches_ = 0;
};

}  // namespace nord_driver::sim
