#include "transport/canopen/canopen_drive.h"

#include <algorithm>

#include "profile/control_word.h"
#include "profile/status_word.h"
#include "transport/canopen/canopen_map.h"
#include "transport/canopen/emergency.h"

namespace nord_driver {

namespace {

// An inverter that two command does what the last one said. It is ours again when the other was silent for so long.
constexpr Duration kContested = std::chrono::seconds{1};

// Bits 0 to 3 of a word that keeps an inverter running; every one that stops has one of them at 0 (BU 2700 6.4.1).
constexpr Word kRuns = 0x000F;

// A drive found enabled that sends at intervals and was not heard for so long, or for as long as ours may be: its node is
// gone. Another driver may have given it longer intervals than ours; one with still longer ones counts as gone while its
// words do not change.
constexpr Duration kFoundIsOld = std::chrono::seconds{1};

}  // namespace

CanopenDriveState::CanopenDriveState(const CanopenDrive& config, std::uint16_t tag)
    : config_(config), parameters_(config, tag), scaling_(config.scaling.pole_pairs) {
  scaling_.setMaxFrequency(config.typed_max_frequency);
}

// In CiA 402 no word says "ignore me": then the master repeats what it was given before, or sends nothing yet. A node that
// fell silent may hear words that stop its drive, as long as the drive layer gives any; never an old one.
void CanopenDriveState::put(const profile::ProcessOutput& output, canopen::Master& master) noexcept {
  if (config_.drive_profile == DriveProfile::kNord) {
    master.setReceivePdo(config_.node, config_.receive_pdo, packPdo(config_, output));
  } else if (const auto words = scaling_.toCia402(output)) {
    master.setReceivePdo(config_.node, config_.receive_pdo, packCia402(*words));
  } else {
    return;
  }
  const bool valid = (output.control_word & profile::control_bit::kDataValid) != 0;
  if (valid && (output.control_word & kRuns) != kRuns) master.tellUnheard(config_.node, config_.receive_pdo);
}

// Only an enabled one: the word that takes the enable away would acknowledge a fault that nobody has seen.
// Setpoints 2 and 3 are 0, a limit among them, too: nobody has read yet which function they have, and bits could start a
// motor.
void CanopenDriveState::putOutput(const profile::ProcessOutput& output, canopen::Master& master) noexcept {
  if (!master.status(config_.node).stops_first) return put(output, master);
  const profile::StatusWord status = foundStatus(master);
  if (status.state() != profile::DriveState::kOperationEnabled) return;
  profile::ProcessOutput stop;
  stop.control_word = profile::controlWord(profile::Command::kShutdown, status.parameterSet());
  put(stop, master);
}

canopen::FoundMotion CanopenDriveState::foundMotion(const canopen::Master& master, bool asked,
                                                    Instant now) const noexcept {
  const canopen::PdoValue& pdo = master.transmitPdo(config_.node, config_.transmit_pdo);
  const Duration limit = config_.transmit_limit;
  const bool old = limit > Duration::zero() && now - pdo.at > std::max<Duration>(kFoundIsOld, limit);
  if (pdo.count == 0 || old) return asked ? canopen::FoundMotion::kUnknown : canopen::FoundMotion::kRests;
  const bool enabled = foundStatus(master).state() == profile::DriveState::kOperationEnabled;
  return enabled ? canopen::FoundMotion::kDriven : canopen::FoundMotion::kRests;
}

// In every layout, of either profile, the status word comes first; what the rest is may be changed by the start-up.
profile::StatusWord CanopenDriveState::foundStatus(const canopen::Master& master) const noexcept {
  const ByteView bytes = master.transmitPdo(config_.node, config_.transmit_pdo).bytes;
  if (bytes.size() < 2) return {};
  return profile::StatusWord{static_cast<Word>(bytes[0] | bytes[1] << 8)};
}

bool CanopenDriveState::decode(ByteView bytes, profile::ProcessInput& input) const noexcept {
  if (config_.drive_profile == DriveProfile::kNord) return unpackPdo(config_, bytes, input);
  profile::Cia402Input words;
  if (!unpackCia402(bytes, words)) return false;
  input = scaling_.fromCia402(words);
  return true;
}

void CanopenDriveState::takeInput(const canopen::Master& master, bool bus_works, Instant now,
                                  DriveExchange& input) noexcept {
  const canopen::NodeStatus& status = master.status(config_.node);
  const canopen::PdoValue& pdo = master.transmitPdo(config_.node, config_.transmit_pdo);
  takeEmergencies(status);
  input = {};
  input.interruption = takeInterruption(status, bus_works);
  module_answers_ = bus_works && status.state == canopen::NodeState::kOperational;
  const bool ever_sent = pdo.count != 0;
  const bool was_contested = contested_;
  contested_ = status.other_commands_at && now - *status.other_commands_at < kContested;
  if (contested_ && !was_contested && input.interruption == Interruption::kNone) {
    input.interruption = Interruption::kContested;
  }
  const bool overdue = config_.transmit_limit > Duration::zero() && now - pdo.at > config_.transmit_limit;
  inverter_answers_ = module_answers_ && !contested_ && !status.doubled && ever_sent && !overdue &&
                      decode(pdo.bytes, input.input) &&
                      // A module with its own supply answers for an inverter that is off.
                      profile::StatusWord{input.input.status_word}.isUseful();
  const Word status_word = inverter_answers_ ? input.input.status_word : Word{0};
  if (moduleMissesInverter(status, pdo, status_word, now)) inverter_answers_ = false;
  input.module_answers = module_answers_;
  input.inverter_answers = inverter_answers_;
  // To a node that another one commands, or that is there twice, nothing is said that acts.
  input.inverter_missing = module_answers_ && !contested_ && !status.doubled && !inverter_answers_;
  // The dictionary can be read before the node is operational, but nobody asks before the drive is online.
  if (!module_answers_) parameters_.handleOffline();
  explain(status, bus_works, ever_sent, overdue);
}

// Behind a gateway byte 3 names the inverter, from 0 (BU 0260 p. 78).
void CanopenDriveState::takeEmergencies(const canopen::NodeStatus& status) noexcept {
  const std::uint64_t count = status.emergencies.count();
  // After its initialisation a node is free of errors, and need not say so (CiA 301 7.2.7.1).
  if (emergency_code_ != 0 && status.booted_up_at && *status.booted_up_at > emergency_at_) forgetEmergency();
  if (count == emergencies_seen_) return;
  const std::uint64_t fresh = count < emergencies_seen_ ? count : count - emergencies_seen_;
  emergencies_seen_ = count;
  if (count == 0) return forgetEmergency();
  const bool gateway = config_.connection == CanopenConnection::kGateway;
  for (std::size_t i = 0; i < status.emergencies.size() && i < fresh; ++i) {
    const canopen::Emergency& emergency = status.emergencies.back(i);
    if (gateway && emergency.manufacturer[0] != config_.inverter - 1) continue;
    emergency_code_ = emergency.code;
    emergency_at_ = emergency.at;
    if (gateway) module_link_.handleEmergency(emergency.code, emergency.at);
    break;
  }
  emergency_text_.clear();
  if (emergency_code_ == 0) return;
  const char* faults = profile::emergencyFaults(emergency_code_);
  emergency_text_.format("EMCY %04Xh (%s%s%s)", emergency_code_, faults, faults[0] != '\0' ? ", " : "",
                         profile::emergencyText(emergency_code_));
}

void CanopenDriveState::forgetEmergency() noexcept {
  emergency_code_ = 0;
  emergency_text_.clear();
  module_link_.forget();
}

// A gateway that has lost an inverter says so, and may go on sending what it heard last. An inverter that reports a
// fault itself is there.
bool CanopenDriveState::moduleMissesInverter(const canopen::NodeStatus& status, const canopen::PdoValue& pdo,
                                             Word status_word, Instant now) noexcept {
  if (!module_link_.missing()) return false;
  module_link_.handleBootUp(status.booted_up_at);
  module_link_.handleWords(status_word, pdo.bytes, pdo.at, now);
  if (!module_link_.missing()) forgetEmergency();
  return module_link_.missing() && !profile::StatusWord{status_word}.fault();
}

// Said once, when a start the drive layer has seen is over, or two nodes turn out to answer: no silence to be waited out.
Interruption CanopenDriveState::takeInterruption(const canopen::NodeStatus& status, bool bus_works) noexcept {
  const std::optional<std::uint64_t> before = start_;
  start_.reset();
  if (status.state == canopen::NodeState::kOperational && !status.doubled) start_ = status.counters.boots;
  if (!before || start_ == before) return Interruption::kNone;
  // Without a bus nothing is known of the node, and nobody has asked it for anything.
  return status.fellSilent() || !bus_works ? Interruption::kSilent : Interruption::kUnasked;
}

void CanopenDriveState::explain(const canopen::NodeStatus& status, bool bus_works, bool ever_sent,
                                bool overdue) noexcept {
  note_.clear();
  if (inverter_answers_) return;
  if (!bus_works) {
    note_ = "the CAN bus does not work";
  } else if (status.state == canopen::NodeState::kRefused && config_.drive_profile == DriveProfile::kCia402) {
    note_.format("%s; profile cia402 needs P551 = 1", status.reason.c_str());
  } else if (!status.reason.empty()) {
    note_ = status.reason;
  } else if (!module_answers_) {
    note_ = canopen::toText(status.state);
  } else if (contested_) {
    note_ = "another master commands it, too: end one of the two";
  } else {
    const char* text =
        !ever_sent || overdue
            ? "the node is operational, but sends no process data: is its mains supply on, does P509 select "
              "CANopen?"
            : "the bus module answers, but the inverter behind it does not: is its mains supply on?";
    // A drive that is not there is commanded nothing, so that nothing of what it could tell changes.
    const char* only_on_change = !ever_sent && config_.transmit_limit == Duration::zero()
                                     ? " With event_time 0 it must send once when it becomes operational."
                                     : "";
    const char* joint = emergency_text_.empty() ? "" : " It reports ";
    note_.format("%s%s%s%s", text, only_on_change, joint, emergency_text_.c_str());
  }
}

bool CanopenDriveState::submit(const profile::ParameterRequest& request) noexcept {
  if (!parameters_.submit(request)) return false;
  if (max_frequency_reads_.begins(request)) scaling_.setMaxFrequency(config_.typed_max_frequency);
  return true;
}

std::optional<profile::ParameterResult> CanopenDriveState::pollResult() noexcept {
  const auto result = parameters_.pollResult();
  if (!result) return std::nullopt;
  if (const auto frequency = max_frequency_reads_.taken(*result)) scaling_.setMaxFrequency(*frequency);
  return result;
}

void CanopenDriveState::handleRestart() noexcept {
  parameters_.handleOffline();
  module_answers_ = false;
  inverter_answers_ = false;
  emergencies_seen_ = 0;
  forgetEmergency();
}

}  // namespace nord_driver
