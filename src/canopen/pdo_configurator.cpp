#include "canopen/pdo_configurator.h"

#include "canopen/sdo_abort.h"

namespace nord_driver::canopen {
namespace {

constexpr std::uint32_t kOff = 0x80000000;  // bit 31: the PDO does not exist
// Bit 30: no RTR (TPDO). NORD fixes it at 1 (BU 0060): it is sent back as it was read.
constexpr std::uint32_t kNoRemote = 0x40000000;

constexpr std::uint16_t kReceiveParameter = 0x1400;
constexpr std::uint16_t kReceiveMapping = 0x1600;
constexpr std::uint16_t kTransmitParameter = 0x1800;
constexpr std::uint16_t kTransmitMapping = 0x1A00;

constexpr std::uint8_t kSubCobId = 1;
constexpr std::uint8_t kSubType = 2;
constexpr std::uint8_t kSubInhibit = 3;
constexpr std::uint8_t kSubEvent = 5;

}  // namespace

void PdoConfigurator::begin(PdoDirection direction, const PdoConfig& config) noexcept {
  *this = PdoConfigurator{};
  direction_ = direction;
  config_ = &config;
}

SdoRequest PdoConfigurator::request() const noexcept {
  const std::uint16_t parameter = parameterIndex();
  const std::uint16_t mapping = mappingIndex();
  switch (step_) {
    case Step::kReadCobId:
      return sdoRead(0, parameter, kSubCobId);
    case Step::kReadCount:
      return sdoRead(0, mapping, 0);
    case Step::kReadEntry:
      return sdoRead(0, mapping, entry_);
    case Step::kReadType:
      return sdoRead(0, parameter, kSubType);
    case Step::kReadInhibit:
      return sdoRead(0, parameter, kSubInhibit);
    case Step::kReadEvent:
      return sdoRead(0, parameter, kSubEvent);
    // Bits 0 to 29 must not change while the PDO exists (CiA 301 7.5.2.35): it is switched off under its old COB-ID.
    case Step::kSwitchOff:
      return sdoWrite(0, parameter, kSubCobId, present_ | kOff, 4);
    case Step::kClearCount:
      return sdoWrite(0, mapping, 0, 0, 1);
    case Step::kWriteEntry:
      return sdoWrite(0, mapping, entry_, config_->mapping[entry_ - std::size_t{1}].value(), 4);
    case Step::kWriteCount:
      return sdoWrite(0, mapping, 0, static_cast<std::uint32_t>(config_->mapping.size()), 1);
    case Step::kWriteType:
      return sdoWrite(0, parameter, kSubType, config_->transmission_type, 1);
    case Step::kWriteInhibit:
      return sdoWrite(0, parameter, kSubInhibit, *config_->inhibit_time, 2);
    case Step::kWriteEvent:
      return sdoWrite(0, parameter, kSubEvent, *config_->event_timer, 2);
    case Step::kSwitchOn:
      break;
  }
  return sdoWrite(0, parameter, kSubCobId, cobIdOn(), 4);
}

Progress PdoConfigurator::handle(const SdoAnswer& answer) noexcept {
  return step_ < Step::kSwitchOff ? compare(answer) : written(answer);
}

Progress PdoConfigurator::compare(const SdoAnswer& answer) noexcept {
  if (step_ == Step::kReadInhibit) {
    const Progress progress = compareTime(answer, *config_->inhibit_time, inhibit_differs_);
    return progress == Progress::kFailed ? progress : afterInhibit();
  }
  if (step_ == Step::kReadEvent) {
    const Progress progress = compareTime(answer, *config_->event_timer, event_differs_);
    return progress == Progress::kFailed ? progress : decide();
  }
  const bool one_byte = step_ == Step::kReadCount || step_ == Step::kReadType;
  const std::optional<std::uint32_t> value = numberOf(answer, one_byte ? 1 : 4);
  if (!value) return fail(answer);
  switch (step_) {
    case Step::kReadCobId:
      return compareCobId(*value);
    case Step::kReadCount:
      mapping_differs_ = *value != config_->mapping.size();
      return mapping_differs_ ? afterMapping() : goTo(Step::kReadEntry);
    case Step::kReadEntry:
      mapping_differs_ = *value != config_->mapping[entry_ - std::size_t{1}].value();
      if (mapping_differs_ || entry_ == config_->mapping.size()) return afterMapping();
      ++entry_;
      return Progress::kGoOn;
    default:
      type_differs_ = !isSameTransmissionType(*value, config_->transmission_type);
      return afterType();
  }
}

Progress PdoConfigurator::compareCobId(std::uint32_t value) noexcept {
  present_ = value;
  if (!config_->enabled) return (value & kOff) != 0 ? Progress::kDone : goTo(Step::kSwitchOff);
  cob_id_differs_ = value != cobIdOn();
  return config_->mapping.empty() ? afterMapping() : goTo(Step::kReadCount);
}

Progress PdoConfigurator::compareTime(const SdoAnswer& answer, std::uint16_t wanted, bool& differs) noexcept {
  const bool missing = answer.abort_code == sdo_abort::kNoObject || answer.abort_code == sdo_abort::kNoSubIndex;
  // A PDO without this time behaves as if it were 0.
  if (!answer.ok() && missing && wanted == 0) return Progress::kGoOn;
  const std::optional<std::uint32_t> value = numberOf(answer, 2);
  if (!value) return fail(answer);
  differs = *value != wanted;
  return Progress::kGoOn;
}

Progress PdoConfigurator::written(const SdoAnswer& answer) noexcept {
  if (!answer.ok()) {
    // A COB-ID that is right and cannot be written does not matter as long as the mapping is right too.
    const bool needed = !config_->enabled || cob_id_differs_ || mapping_differs_;
    if (step_ != Step::kSwitchOff || needed) return fail(answer);
    stays_on_ = true;
    return writeType();
  }
  switch (step_) {
    case Step::kSwitchOff:
      return config_->enabled ? beginWrites() : Progress::kDone;
    case Step::kClearCount:
      entry_ = 1;
      return goTo(Step::kWriteEntry);
    case Step::kWriteEntry:
      if (entry_ == config_->mapping.size()) return goTo(Step::kWriteCount);
      ++entry_;
      return Progress::kGoOn;
    case Step::kWriteCount:
      return writeType();
    case Step::kWriteType:
      return writeInhibit();
    case Step::kWriteInhibit:
      return writeEvent();
    case Step::kWriteEvent:
      return switchOn();
    default:
      return Progress::kDone;
  }
}

Progress PdoConfigurator::goTo(Step step) noexcept {
  step_ = step;
  return Progress::kGoOn;
}

Progress PdoConfigurator::afterMapping() noexcept {
  return goTo(Step::kReadType);
}

Progress PdoConfigurator::afterType() noexcept {
  return config_->inhibit_time ? goTo(Step::kReadInhibit) : afterInhibit();
}

Progress PdoConfigurator::afterInhibit() noexcept {
  return config_->event_timer ? goTo(Step::kReadEvent) : decide();
}

Progress PdoConfigurator::decide() noexcept {
  if (!cob_id_differs_ && !mapping_differs_ && !type_differs_ && !inhibit_differs_ && !event_differs_) {
    return Progress::kDone;
  }
  return (present_ & kOff) != 0 ? beginWrites() : goTo(Step::kSwitchOff);
}

Progress PdoConfigurator::beginWrites() noexcept {
  return mapping_differs_ ? goTo(Step::kClearCount) : writeType();
}

Progress PdoConfigurator::writeType() noexcept {
  return type_differs_ ? goTo(Step::kWriteType) : writeInhibit();
}

Progress PdoConfigurator::writeInhibit() noexcept {
  return inhibit_differs_ ? goTo(Step::kWriteInhibit) : writeEvent();
}

Progress PdoConfigurator::writeEvent() noexcept {
  return event_differs_ ? goTo(Step::kWriteEvent) : switchOn();
}

Progress PdoConfigurator::switchOn() noexcept {
  return stays_on_ ? Progress::kDone : goTo(Step::kSwitchOn);
}

Progress PdoConfigurator::fail(const SdoAnswer& answer) noexcept {
  const SdoRequest failed = request();
  const char* what = "COB-ID";
  if (failed.index == mappingIndex()) what = "mapping";
  if (step_ == Step::kReadType || step_ == Step::kWriteType) what = "transmission type";
  if (step_ == Step::kReadInhibit || step_ == Step::kWriteInhibit) what = "inhibit time";
  if (step_ == Step::kReadEvent || step_ == Step::kWriteEvent) what = "event timer";
  FixedText<40> name;
  name.format("%s of %s %u", what, direction_ == PdoDirection::kReceive ? "RPDO" : "TPDO", unsigned{config_->number});
  reason_ = refusalText(name.c_str(), failed, answer);
  return Progress::kFailed;
}

std::uint16_t PdoConfigurator::parameterIndex() const noexcept {
  const std::uint16_t first = direction_ == PdoDirection::kReceive ? kReceiveParameter : kTransmitParameter;
  return static_cast<std::uint16_t>(first + config_->number - 1);
}

std::uint16_t PdoConfigurator::mappingIndex() const noexcept {
  const std::uint16_t first = direction_ == PdoDirection::kReceive ? kReceiveMapping : kTransmitMapping;
  return static_cast<std::uint16_t>(first + config_->number - 1);
}

std::uint32_t PdoConfigurator::cobIdOn() const noexcept {
  return config_->cob_id | (present_ & kNoRemote);
}

}  // namespace nord_driver::canopen
