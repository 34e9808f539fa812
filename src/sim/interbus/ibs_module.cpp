#include "sim/interbus/ibs_module.h"

#include "sim/cia402_words.h"

namespace nord_driver::sim {

namespace {

constexpr IbsIdentity kWithoutInverter{};  // BU 0070 4.2: five words, and no profile
constexpr std::uint8_t kDrivecom = 0xE3;
constexpr std::uint8_t kNoProfile = 0xF3;
constexpr Word kRelay = 1u << 10;

// BU 0070 4.1: the profile is effective with three words only.
IbsIdentity identityFor(bool three_words, bool profile) noexcept {
  return {three_words ? 3u : 5u, three_words && profile ? kDrivecom : kNoProfile};
}

}  // namespace

IbsModule::IbsModule(DriveUnit& drive) : drive_(drive) {}

void IbsModule::setPowered(bool on) noexcept {
  if (on && !powered_) {
    restarted_ = true;
    inverter_on_ = false;
    settings_ = kWithoutInverter;
  }
  powered_ = on;
  showLinks();
}

void IbsModule::look() noexcept {
  const bool on = powered_ && present(0);
  if (on && !inverter_on_) {
    const ParameterStore& parameters = drive_.parameters();
    const IbsIdentity before = settings_;
    settings_ = identityFor(parameters.value(507) == 1, parameters.value(551) == 1);
    if (!(settings_ == before)) restarted_ = true;
    valid_seen_ = false;
  }
  inverter_on_ = on;
}

IbsIdentity IbsModule::identity() const noexcept {
  return inverter_on_ ? settings_ : kWithoutInverter;
}

IbsIdentity IbsModule::expected() const noexcept {
  const auto& config = drive_.config().bus.as<IbsDriveConfig>();
  return identityFor(config.ppo_type == 1, config.drivecom);
}

void IbsModule::ringStarts() noexcept {
  restarted_ = false;
  in_ring_ = true;
  masterBegins();
}

IbsWords IbsModule::exchange(const IbsWords& words) noexcept {
  ++counters_.telegrams;
  ++counters_.data_exchanges;
  const IbsWords from = answer();  // does not yet contain the reaction to the words that come with it (BU 0070 6.2)
  take(words);
  return from;
}

void IbsModule::take(const IbsWords& words) noexcept {
  counters_.last_control = words[0];
  if (!present(0)) return;
  if (settings_.code == kDrivecom) {
    rpm_setpoint_ = toSigned(words[1]);
    drive_.inverter().receive(fromCia402(words[0], rpm_setpoint_, drive_));
    return;
  }
  ProcessData data;
  data.control = words[0];
  data.setpoints[0] = words[1];
  if (settings_.words == 5) {
    data.setpoints[swapsWords() ? 2 : 1] = words[2];
    data.setpoints[swapsWords() ? 1 : 2] = words[3];
  } else {
    data.carried = 1;
  }
  const bool valid = (data.control & stw::kDataValid) != 0;
  if (!valid && valid_seen_) ++counters_.zero_control_words;
  valid_seen_ = valid_seen_ || valid;
  drive_.inverter().receive(data);
}

IbsWords IbsModule::answer() const noexcept {
  IbsWords words{};
  if (!present(0) || mute()) return words;
  const InverterModel& inverter = drive_.inverter();
  if (settings_.code == kDrivecom) {
    words[0] = cia402Status(drive_, rpm_setpoint_);
    words[1] = toWord(actualSpeed(drive_));
    return words;
  }
  words[0] = static_cast<Word>(inverter.statusWord() | (relay_ ? kRelay : Word{0}));
  words[1] = inverter.actualValue(0);
  if (settings_.words == 5) {
    words[2] = inverter.actualValue(swapsWords() ? 2 : 1);
    words[3] = inverter.actualValue(swapsWords() ? 1 : 2);
  }
  return words;
}

}  // namespace nord_driver::sim
