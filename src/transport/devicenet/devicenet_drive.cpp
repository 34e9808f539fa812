#include "transport/devicenet/devicenet_drive.h"

#include "profile/status_word.h"
#include "transport/devicenet/assembly.h"

namespace nord_driver {

using devicenet::IoKind;
using devicenet::NodeState;
using devicenet::NodeStatus;

namespace {

// A module that two send process data to does what the last one said. It is ours again when the other was silent for so
// long.
constexpr Duration kContested = std::chrono::seconds{1};
// What may ask for the state of an inverter whose words do not tell whether it is there: assembly 70 is zero at rest.
bool needsProbe(const DevicenetDrive& drive) noexcept {
  return drive.drive_profile == DevicenetProfile::kAcDrive;
}

profile::AcDriveKind kindOf(DevicenetProfile profile) noexcept {
  return profile == DevicenetProfile::kAcDrive ? profile::AcDriveKind::kBasic : profile::AcDriveKind::kExtended;
}

}  // namespace

DevicenetDriveState::DevicenetDriveState(const DevicenetDrive& config, const devicenet::IoConfig& io, Duration period,
                                         std::uint16_t tag, bool guest)
    : config_(config),
      io_(io),
      period_(period),
      guest_(guest),
      parameters_(config, tag),
      probe_(config.inverter, static_cast<std::uint16_t>(tag | kProbeTag), guest || needsProbe(config)),
      motor_(config.inverter, static_cast<std::uint16_t>(tag | kMotorTag), config.scaling.pole_pairs),
      scaling_(kindOf(config.drive_profile), config.scaling.pole_pairs) {
  scaling_.setMaxFrequency(config.typed_max_frequency);
}

// On a new connection the first words are 0000, which the inverter ignores: a stop word takes the enable away, and so
// would acknowledge a fault that nobody has seen yet (BU 0020 8). A fault has to be told first: its status word may have
// come between two cycles, or the inverter be asked yet whether it is there. The AC drive profile has no such word: see
// faultFound().
void DevicenetDriveState::putOutput(const profile::ProcessOutput& output, const devicenet::Scanner& scanner,
                                    devicenet::IoBytes& bytes) const noexcept {
  if (config_.drive_profile == DevicenetProfile::kNord) {
    const devicenet::IoInput& data = scanner.input(config_.module);
    // It may be another connection by now than the one on which it was told.
    const bool told = told_ && connection_ == scanner.status(config_.module).counters.connections;
    if (data.count != 0 && (told || !tellsFault(data.bytes))) packWords(config_, output, bytes);
  } else {
    packAcDrive(config_, scaling_.toAcDrive(output), bytes);
  }
}

bool DevicenetDriveState::tellsFault(ByteView bytes) const noexcept {
  profile::ProcessInput input;
  return decode(bytes, input) && profile::StatusWord{input.status_word}.fault();
}

// What stood before the first word of the AC drive profile went out, which may have ended it. Once an inverter was met, a
// lost connection is a loss to the layers above; its words do not wait, for they may be those that stop.
std::optional<Word> DevicenetDriveState::faultFound(const NodeStatus& status) const noexcept {
  const std::optional<std::uint8_t> state = status.supervisors[config_.inverter - 1u];
  if (met_ || !state) return std::nullopt;
  const Word word = profile::statusOfSupervisor(*state);
  if (!profile::StatusWord{word}.fault()) return std::nullopt;
  return word;
}

// For one cycle, whatever comes of it: without words the time-out of the connection runs out.
bool DevicenetDriveState::holdsBack(const devicenet::Scanner& scanner) const noexcept {
  const NodeStatus& status = scanner.status(config_.module);
  const bool begins = status.state == NodeState::kExchanging && connection_ != status.counters.connections;
  return begins && faultFound(status).has_value();
}

bool DevicenetDriveState::decode(ByteView bytes, profile::ProcessInput& input) const noexcept {
  if (config_.drive_profile == DevicenetProfile::kNord) return unpackWords(config_, bytes, input);
  profile::AcDriveInput from;
  if (!unpackAcDrive(config_, bytes, from)) return false;
  input = scaling_.fromAcDrive(from);
  return true;
}

bool DevicenetDriveState::answered(const devicenet::Scanner& scanner, std::uint64_t count) const noexcept {
  if (guest_ || scanner.status(config_.module).state != NodeState::kExchanging) return true;
  return scanner.input(config_.module).count != count;
}

void DevicenetDriveState::takeInput(const devicenet::Scanner& scanner, bool bus_works, Instant now,
                                    DriveExchange& input) noexcept {
  const NodeStatus& status = scanner.status(config_.module);
  const bool was_contested = contested_;
  watchOthers(status, now);
  input = {};
  input.interruption = takeInterruption(status, bus_works, now);
  const bool connected = bus_works && status.state == NodeState::kExchanging;
  if (!connected) {
    parameters_.handleOffline();
    probe_.handleOffline();
    motor_.handleOffline();
  }
  module_answers_ = connected;
  inverter_answers_ = false;
  if (connected && guest_) {
    inverter_answers_ = probe_.present();
    // No process data are exchanged: where the module does not tell the state either, nothing is known but that it is
    // there.
    const Word word = profile::statusOfSupervisor(probe_.state().value_or(1));
    if (inverter_answers_) input.input.status_word = word != 0 ? word : profile::statusOfSupervisor(1);
  } else if (const auto found = connected && !contested_ ? faultFound(status) : std::nullopt) {
    inverter_answers_ = true;
    input.input.status_word = *found;
  } else if (connected) {
    module_answers_ = takeProcessData(scanner, status, now, input);
  }
  input.module_answers = module_answers_;
  input.inverter_answers = inverter_answers_;
  // To a module that another scanner works with nothing is said that acts.
  input.inverter_missing = module_answers_ && !contested_ && !inverter_answers_;
  if (!inverter_answers_) input.input = {};
  met_ = met_ || (inverter_answers_ && !guest_);
  told_ = connected && (told_ || inverter_answers_) && input.interruption == Interruption::kNone;
  if (contested_ && !was_contested && input.interruption == Interruption::kNone) {
    input.interruption = Interruption::kContested;
  }
  explain(status, bus_works);
}

// Whether the module takes part. A poll is answered in its cycle; one answer may be late, and one lost.
bool DevicenetDriveState::takeProcessData(const devicenet::Scanner& scanner, const NodeStatus& status, Instant now,
                                          DriveExchange& input) noexcept {
  const devicenet::IoInput& data = scanner.input(config_.module);
  const bool by_change = io_.kind == IoKind::kChangeOfState || io_.kind == IoKind::kCyclic;
  const Duration pause = by_change && status.packet_rate > period_ ? status.packet_rate : period_;
  if (data.count == 0 || now - data.at > pause * 5 / 2) return false;
  inverter_answers_ = decode(data.bytes, input.input) && !contested_ && probe_.present() &&
                      // A module with its own supply answers for an inverter that is off.
                      profile::StatusWord{input.input.status_word}.isUseful();
  return true;
}

// Said once. A module that was heard just now and yet is not connected any more has been reset, released or taken away;
// one that is not heard any more fell silent.
Interruption DevicenetDriveState::takeInterruption(const NodeStatus& status, bool bus_works, Instant now) noexcept {
  const std::optional<std::uint64_t> before = connection_;
  connection_.reset();
  if (status.state == NodeState::kExchanging) connection_ = status.counters.connections;
  if (!before || connection_ == before) return Interruption::kNone;
  const bool silent = !connection_ && now - status.heard_at > 2 * period_;
  return silent || !bus_works ? Interruption::kSilent : Interruption::kUnasked;
}

void DevicenetDriveState::watchOthers(const NodeStatus& status, Instant now) noexcept {
  if (status.counters.foreign_use != foreign_seen_) contested_at_ = now;
  foreign_seen_ = status.counters.foreign_use;
  contested_ = contested_at_ && now - *contested_at_ < kContested;
}

void DevicenetDriveState::explain(const NodeStatus& status, bool bus_works) noexcept {
  note_.clear();
  if (inverter_answers_) return;
  if (!bus_works) {
    note_ = "the DeviceNet bus does not work";
  } else if (!status.reason.empty()) {
    const bool sizes_differ = status.produced_size != 0 &&
                              (status.produced_size != io_.input_bytes || status.consumed_size != io_.output_bytes);
    note_.format("%.180s%s", status.reason.c_str(),
                 sizes_differ ? "; P160 selects the assembly, P161 to P165 its lengths" : "");
  } else if (status.state != NodeState::kExchanging) {
    note_ = devicenet::toText(status.state);
  } else if (contested_) {
    note_ = "another scanner works with it, too: end one of the two";
  } else if (!module_answers_) {
    note_ = "the module is connected, but sends no process data";
  } else {
    note_ = "the bus module answers, but the inverter behind it does not: is its mains supply on?";
  }
}

bool DevicenetDriveState::submit(const profile::ParameterRequest& request) noexcept {
  if (!parameters_.submit(request)) return false;
  if (max_frequency_reads_.begins(request)) scaling_.setMaxFrequency(config_.typed_max_frequency);
  return true;
}

std::optional<profile::ParameterResult> DevicenetDriveState::pollResult() noexcept {
  const auto result = parameters_.pollResult();
  if (!result) return std::nullopt;
  if (const auto frequency = max_frequency_reads_.taken(*result)) scaling_.setMaxFrequency(*frequency);
  return result;
}

// The scanner's queue is shared by the inverters behind one module: what it does not take now it takes later.
void DevicenetDriveState::runRequests(devicenet::Scanner& scanner, Instant now) noexcept {
  if (scanner.status(config_.module).state != NodeState::kExchanging) return;
  const auto probe = probe_.pendingRequest(now);
  if (probe && scanner.submit(config_.module, *probe)) probe_.handleStarted();
  const auto poles = guest_ || !inverter_answers_ ? std::nullopt : motor_.pendingRequest(now);
  if (poles && scanner.submit(config_.module, *poles)) motor_.handleStarted();
  const auto access = parameters_.pendingAccess();
  if (access && scanner.submit(config_.module, *access)) parameters_.handleStarted();
}

void DevicenetDriveState::handleAnswer(const devicenet::ExplicitAnswer& answer, Instant now) noexcept {
  const std::uint16_t tag = DevicenetParameters::tagOf(answer.id);
  if ((tag & kProbeTag) != 0) return probe_.handleAnswer(answer, now);
  if ((tag & kMotorTag) != 0) return motor_.handleAnswer(answer, now);
  if (parameters_.handleAnswer(answer)) probe_.handleAbsence();
}

void DevicenetDriveState::handleRestart() noexcept {
  parameters_.handleOffline();
  probe_.handleOffline();
  motor_.handleOffline();
  module_answers_ = false;
  inverter_answers_ = false;
}

}  // namespace nord_driver
