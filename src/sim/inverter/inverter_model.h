// A simulated frequency inverter: status machine, ramps, parameter sets, faults and time-outs.
//
// Written from BU 2700 6.4 and 7.1.1 and BU 0020 7.3 and 8. It is fed with control words and time, and knows no bus:
// the module hands it what arrived, and says when its master or its link is gone.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "nord_driver/core/time.h"
#include "sim/inverter/motor.h"
#include "sim/inverter/parameter_store.h"
#include "sim/inverter/posicon.h"
#include "sim/inverter/position_words.h"
#include "sim/inverter/words.h"

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
  unsigned carried = 3;  ///< how many setpoints the telegram has; the others are 0
};

/// Fault numbers as P700 shows them, ten times the printed number: BU 2700 8.3.
namespace fault {
constexpr std::uint16_t kBusTimeout = 100;  ///< E10.0 bus time-out: P513, node guarding (BU 0020 8)
constexpr std::uint16_t kMasterLost = 102;  ///< E10.2 PROFIBUS watchdog
constexpr std::uint16_t kTimeout = 103;     ///< E10.3 time-out by P151/P513; not in the older series
constexpr std::uint16_t kModuleLink = 108;  ///< E10.8 connection to the bus interface interrupted
constexpr std::uint16_t kNoModule = 109;    ///< E10.9 the same with a module on the system bus, by P120
}  // namespace fault

/// Why "switch-on disabled" or "not ready" is not left: P700[-03]. The bus manuals say that there is a reason
/// (BU 0020 8), the list is in the inverters' own manuals: these numbers are the simulator's.
namespace block {
constexpr std::uint16_t kNone = 0;
constexpr std::uint16_t kVoltageByTerminals = 1;
constexpr std::uint16_t kQuickStopByTerminals = 2;
constexpr std::uint16_t kVoltageByBus = 3;
constexpr std::uint16_t kQuickStopByBus = 4;
constexpr std::uint16_t kStandingEnable = 5;  ///< bit 0 is 1 already: shut down comes first
constexpr std::uint16_t kCharging = 60;
}  // namespace block

struct InverterSettings {
  double charging_time = 0.3;  ///< s, from mains on until the charging relay has engaged
  /// s, a fault stands that long before P506 takes it. Not in the bus manuals: the simulator's.
  double automatic_acknowledgement_delay = 0.1;
  PosiconSettings posicon;
};

/// Which of the setpoints and actual values 1 to 3, as the telegram numbers them, are the halves of the 32-bit field of
/// SK 700E and 750E: PZD2 and PZD3 (BU 0020 7.3.5), where these series have SW1 and SW3 (7.3.6). The bus transfers the
/// high word first, or, little endian (BU 0280 4.2.1.1), the low word.
struct WideField {
  unsigned high = 0;
  unsigned low = 2;
  unsigned other() const noexcept { return 3 - high - low; }  ///< SW2 or IW2, in PZD4
};

/// How a bus is wired to the inverter.
struct BusWiring {
  /// Behind SK CU4/TU4: P120 watches the link to the module, not P513 alone (BU 2700 8.1).
  bool on_system_bus = false;
  /// The value of P509 that gives control to this bus; nothing: PROFIBUS, as the series numbers it.
  std::optional<std::int32_t> source;
  std::uint16_t master_lost_fault = fault::kMasterLost;  ///< how a lost master shows
  std::uint16_t timeout_fault = fault::kTimeout;         ///< how P513 shows, but in the older series
  WideField wide;
};

/// What is wired to the inverter. Coasting and quick stop act under bus control too (BU 0020 6, note).
struct Terminals {
  bool enable = false;
  double frequency = 0.0;   ///< Hz, signed; also what an analogue input would say
  bool coast = false;       ///< an input "disable voltage" is low
  bool quick_stop = false;  ///< an input "quick stop" is low
  /// 0-3: inputs choose it while the terminals control. The bus manuals say that the status word tells which set is active
  /// (BU 2700 6.4.2), and leave the functions of inputs to the inverters' own manuals (P420). Nothing: it stays.
  std::optional<unsigned> parameter_set = {};
};

/// What the inverter shows of its inputs and of its own messages, as somebody has switched it.
struct InverterInputs {
  Word digital_io = 0;             ///< "digital I/O status" as it travels: inputs from bit 0, relays from bit 12
  std::uint8_t bus_out_bits = 0;   ///< bus I/O out bits 0 to 7
  bool bit_10 = false;             ///< of the status word, by P481 [-09]
  bool bit_13 = false;             ///< of the status word, by P481 [-10]
  std::array<double, 2> analog{};  ///< 1 is 100 %
};

class InverterModel {
 public:
  /// Both must outlive the model.
  InverterModel(ParameterStore& parameters, Motor& motor, const InverterSettings& settings = InverterSettings{});

  /// Which bus it hangs on; PROFIBUS with a module of its own unless told otherwise.
  void wire(const BusWiring& wiring) noexcept { wiring_ = wiring; }

  /// Lets `span` pass, in steps of at most a millisecond.
  void advance(Duration span) noexcept;
  /// Of the time a control word may be away (P513) `span` more: nobody could have brought one.
  void forgive(Duration span) noexcept { since_valid_ -= toSeconds(span); }

  void setPowered(bool on) noexcept;
  bool powered() const noexcept { return state_ != InverterState::kOff; }

  /// Process data from the bus module. With bit 10 = 0 they are not evaluated (BU 2700 6.4.1 note 2).
  void receive(const ProcessData& data) noexcept;
  /// What another inverter says to all on the system bus; heard where P509 or P510 is broadcast.
  void hearLeader(const ProcessData& data) noexcept { led_ = data; }
  /// What this one would say as such a leader: its command, and its frequency after the ramp as setpoint 1 (BU 0020
  /// 6.2.2, P543 = 20). One that is not in operation says OFF1.
  ProcessData said() const noexcept;
  /// The module's watchdog expired: E10.2, unless P513 = -0.1 (BU 2700 7.1.1).
  void masterLost() noexcept;
  /// A module on the system bus says that P151 is over: E10.3 (BU 2700 7.1.1).
  void moduleTimeout() noexcept;
  /// The connection to the module broke (E10.8, on the system bus E10.9 unless P120[-01] = 0; never with P513 = -0.1)
  /// or is back.
  void setModuleLink(bool intact) noexcept;

  /// A fault by number (102 = E10.2). With `cause_stays` it cannot be acknowledged before `clearCause()`.
  void trip(std::uint16_t number, bool cause_stays) noexcept;
  void clearCause() noexcept { tripped_cause_ = false; }
  /// As an input with function 12 or the keypad does it. False: no fault, or its cause stands.
  bool acknowledge() noexcept;
  /// A warning's number in P700[-02]; 0 ends it, a fault too (BU 0020 8).
  void setWarning(std::uint16_t number) noexcept;

  /// Control by the terminals: an input "remote control" is low, status bit 9 = 0.
  void setLocalControl(bool on) noexcept { local_ = on; }
  /// The same with terminals that enable the drive when `setpoint_hz` is not zero, else say OFF1.
  void setLocalControl(bool on, double setpoint_hz) noexcept;
  void setTerminals(const Terminals& terminals) noexcept { terminals_ = terminals; }
  const Terminals& terminals() const noexcept { return terminals_; }
  void setInputs(const InverterInputs& inputs) noexcept { inputs_ = inputs; }
  const InverterInputs& inputs() const noexcept { return inputs_; }
  /// As the words that carry them say it.
  std::uint8_t busInBits() const noexcept;

  /// A gateway that does not keep the words of one telegram together: high words are those of the telegram before.
  void setTornWords(bool on) noexcept { torn_ = on; }
  const Posicon& posicon() const noexcept { return posicon_; }
  /// A 32-bit value is in two of the setpoints, or of the actual values (SK 700E and 750E).
  bool wideSetpoint() const noexcept;
  bool wideActual() const noexcept;
  const WideField& wideField() const noexcept { return wiring_.wide; }

  Word statusWord() const noexcept;
  /// Actual value 1-3 (`n` = 0-2) by the function in P543-P545.
  Word actualValue(unsigned n) const noexcept;

  InverterState state() const noexcept { return state_; }
  double frequency() const noexcept { return frequency_; }                 ///< output frequency, Hz, signed
  unsigned parameterSet() const noexcept { return set_; }                  ///< 0-3
  std::uint16_t faultNumber() const noexcept { return fault_; }            ///< 0 = none
  Word setpoint1() const noexcept { return data_.setpoints[0]; }           ///< the last valid one
  Word setpoint(unsigned n) const noexcept { return data_.setpoints[n]; }  ///< 0 to 2
  std::uint16_t warning() const noexcept { return warning_; }
  /// Why it cannot be switched on: one of `block`.
  std::uint16_t switchOnBlock() const noexcept;
  std::uint64_t setSwitches() const noexcept { return set_switches_; }
  /// The control word of the bus counts.
  bool busControl() const noexcept;

 private:
  void step(double dt) noexcept;
  void evaluate() noexcept;
  void follow(double dt) noexcept;
  void watchTimeout(double dt) noexcept;
  void enter(InverterState next) noexcept;
  void selectParameterSet(unsigned set) noexcept;
  void waitForStart() noexcept;
  void acknowledgeByItself() noexcept;
  bool causeStands() const noexcept;
  bool inputAcknowledges() const noexcept;
  std::int32_t busSource() const noexcept;
  bool ignoresBusErrors() const noexcept;
  bool watchesModule() const noexcept;
  bool busSetpoint() const noexcept;
  bool hearsBroadcast(std::int32_t source) const noexcept;
  std::int32_t setpointSource() const noexcept;
  Word command() const noexcept;
  double setpointFrequency() const noexcept;
  double busShare() const noexcept;
  bool busBitIs(std::int32_t function) const noexcept;
  bool carriesBits(unsigned n) const noexcept;
  bool busBitHasFunction(std::int32_t function) const noexcept;
  unsigned setpointPlace(unsigned n) const noexcept;
  PositionFunction positionSetpointAt(unsigned n) const noexcept;
  void watchPosition() noexcept;
  bool positioning() const noexcept;
  double positioningFrequency(double dt) noexcept;
  PositionCommand positionCommand() const noexcept;
  std::optional<double> positionTarget() const noexcept;
  double positionUnit(const PositionFunction& function) const noexcept;
  Word positionWord(const PositionFunction& function, bool high) const noexcept;
  bool setpointReached() const noexcept;
  bool outputIsOn(unsigned element) const noexcept;
  bool busBitsEnable() const noexcept;
  bool busBitsAcknowledge() const noexcept;
  double busBitFrequency() const noexcept;
  std::int32_t busFunction(unsigned first_number, unsigned n) const noexcept;
  Word functionValue(std::int32_t function) const noexcept;

  ParameterStore& parameters_;
  Motor& motor_;
  InverterSettings settings_;
  BusWiring wiring_;

  InverterState state_ = InverterState::kOff;
  double in_state_ = 0.0;  // s
  bool commanded_ = false;
  ProcessData data_;      // the last ones with bit 10 = 1
  ProcessData previous_;  // those before
  ProcessData led_;       // of the inverter that leads
  unsigned set_ = 0;
  double frequency_ = 0.0;
  double target_ = 0.0;

  Posicon posicon_;
  PositionCommand position_command_;  // of the last telegram
  bool torn_ = false;
  struct Found {  // revolutions
    double position = 0.0;
    double target = 0.0;
  };
  std::array<Found, 2> found_{};  // by the last two telegrams, the older one first

  bool local_ = false;
  Terminals terminals_;
  InverterInputs inputs_;

  std::uint16_t fault_ = 0;
  std::uint16_t warning_ = 0;
  bool tripped_cause_ = false;
  bool master_lost_ = false;
  bool timed_out_ = false;
  bool link_broken_ = false;
  bool link_fault_ = false;
  double since_valid_ = 0.0;  // s since the last word with bit 10 = 1
  int automatic_acknowledgements_ = 0;
  std::uint64_t set_switches_ = 0;
};

}  // namespace nord_driver::sim
