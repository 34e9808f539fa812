#include "transport/devicenet/devicenet_parameters.h"

#include <array>
#include <limits>

#include "devicenet/error_codes.h"
#include "transport/devicenet/explicit_refusal.h"

namespace nord_driver {

using devicenet::ExplicitAnswer;
using devicenet::ExplicitEnd;
using devicenet::ExplicitRequest;
namespace general_error = devicenet::general_error;
using profile::ParameterAction;
using profile::ParameterOutcome;
using profile::ParameterReason;
using profile::ParameterRequest;
using profile::ParameterShape;

namespace {

constexpr std::uint16_t kFirstModuleNumber = 150, kLastModuleNumber = 199;  // BU 0280 5.2
constexpr unsigned kFirstClass = 100, kClassesPerInverter = 10, kModuleClasses = 180;
constexpr std::uint8_t kIndexClass = 199;
constexpr std::uint8_t kNumberAttribute = 1, kIndexAttribute = 2, kWordAttribute = 3, kDoubleWordAttribute = 4;
constexpr unsigned kLastInstance = 255;
constexpr std::uint16_t kFaultNumber = 700;

// As on PKW (BU 0020 7.5.2): sets count fastest, then the elements.
unsigned subIndexOf(const ParameterRequest& request) noexcept {
  const unsigned set = request.parameter_set - 1u, element = request.index - 1u;
  switch (request.shape) {
    case ParameterShape::kPlain:
      return 0;
    case ParameterShape::kPerSet:
      return set;
    case ParameterShape::kArray:
      return element;
    case ParameterShape::kArrayPerSet:
      return 4 * element + set;
  }
  return 0;
}

// Values are 16 bits wide but for positions (BU 0050 p. 42).
devicenet::ExplicitData valueBytes(std::int32_t raw, bool double_word) noexcept {
  devicenet::ExplicitData data;
  const auto value = static_cast<std::uint32_t>(raw);
  for (unsigned i = 0; i < (double_word ? 4u : 2u); ++i)
    data.push_back(static_cast<std::uint8_t>(value >> 8u * i & 0xFFu));
  return data;
}

}  // namespace

bool isOfModule(std::uint16_t number) noexcept {
  return number >= kFirstModuleNumber && number <= kLastModuleNumber;
}

std::optional<ParameterObject> parameterObject(const DevicenetDrive& drive, const ParameterRequest& request) noexcept {
  const unsigned instance = subIndexOf(request) + 1u;
  if (instance > kLastInstance) return std::nullopt;
  const unsigned first =
      isOfModule(request.number) ? kModuleClasses : kFirstClass + kClassesPerInverter * (drive.inverter - 1u);
  ParameterObject object;
  object.class_id = static_cast<std::uint8_t>(first + request.number / 100u);
  object.instance = static_cast<std::uint8_t>(instance);
  object.attribute = static_cast<std::uint8_t>(request.number % 100u);
  return object;
}

bool DevicenetParameters::submit(const ParameterRequest& request) noexcept {
  const bool idle = requests_.empty();
  if (!requests_.submit(request)) return false;
  if (idle) next();
  return true;
}

// The running request's turn. What no device need be asked for is answered here.
void DevicenetParameters::next() noexcept {
  plain_ = false;
  other_width_ = false;
  ++sequence_;
  while (!requests_.empty()) {
    const ParameterRequest& request = requests_.front();
    const bool option = drive_.connection == DevicenetConnection::kOption;
    if (request.action == ParameterAction::kWriteRam) {
      requests_.refuse(ParameterReason::kNotSupported, "DeviceNet has no write that spares the EEPROM");
    } else if (!parameterObject(drive_, request)) {
      requests_.refuse(ParameterReason::kNoSuchElement, "no instance reaches this array element");
    } else if (isOfModule(request.number) && option) {
      requests_.refuse(ParameterReason::kNoSuchParameter, "SK TU1/2/3-DEV has no parameters of its own");
    } else {
      step_ = byIndexObject() ? Step::kNumber : Step::kValue;
      return;
    }
  }
}

// P000 in the index object is ignored and always answered well, whether there is an inverter or not (BU 0280 4.3.10).
bool DevicenetParameters::byIndexObject() const noexcept {
  const std::uint16_t number = requests_.front().number;
  return drive_.parameter_objects == ParameterObjects::kIndexObject && !isOfModule(number) && number != 0;
}

std::optional<ExplicitRequest> DevicenetParameters::pendingAccess() const noexcept {
  if (under_way_ || requests_.empty()) return std::nullopt;
  if (step_ == Step::kSupervisor) {
    return devicenet::getAttribute(accessId(), devicenet::object_class::kControlSupervisor, drive_.inverter,
                                   devicenet::supervisor_attribute::kFaultCode);
  }
  if (byIndexObject()) return indexAccess();
  ParameterObject object = *parameterObject(drive_, requests_.front());
  if (plain_) object.instance = 1;
  return valueAccess(object);
}

ExplicitRequest DevicenetParameters::valueAccess(const ParameterObject& object) const noexcept {
  const ParameterRequest& request = requests_.front();
  if (request.action == ParameterAction::kRead) {
    return devicenet::getAttribute(accessId(), object.class_id, object.instance, object.attribute);
  }
  return devicenet::setAttribute(accessId(), object.class_id, object.instance, object.attribute,
                                 valueBytes(request.raw, request.double_word != other_width_));
}

ExplicitRequest DevicenetParameters::indexAccess() const noexcept {
  const ParameterRequest& request = requests_.front();
  ParameterObject object{kIndexClass, drive_.inverter, kNumberAttribute};
  if (step_ == Step::kNumber) {
    const std::array<std::uint8_t, 2> number{static_cast<std::uint8_t>(request.number & 0xFFu),
                                             static_cast<std::uint8_t>(request.number >> 8u)};
    return devicenet::setAttribute(accessId(), object.class_id, object.instance, object.attribute, number);
  }
  if (step_ == Step::kIndex) {
    const std::array<std::uint8_t, 1> index{static_cast<std::uint8_t>(plain_ ? 0 : subIndexOf(request))};
    return devicenet::setAttribute(accessId(), object.class_id, object.instance, kIndexAttribute, index);
  }
  object.attribute = step_ == Step::kDoubleValue ? kDoubleWordAttribute : kWordAttribute;
  return valueAccess(object);
}

void DevicenetParameters::again(Step step) noexcept {
  step_ = step;
  ++sequence_;
}

bool DevicenetParameters::handleAnswer(const ExplicitAnswer& answer) noexcept {
  if (!under_way_ || requests_.empty() || answer.id != accessId()) return false;
  under_way_ = false;
  bool absent = false;
  switch (answer.end) {
    case ExplicitEnd::kDone:
      if (step_ == Step::kNumber) {
        again(Step::kIndex);
        return false;
      }
      if (step_ == Step::kIndex) {
        again(requests_.front().action != ParameterAction::kRead && requests_.front().double_word ? Step::kDoubleValue
                                                                                                  : Step::kValue);
        return false;
      }
      takeValue(answer);
      break;
    case ExplicitEnd::kRefused:
      if (step_ == Step::kSupervisor) {
        refuse(refusal_);
        break;
      }
      if (tryOtherWidth(answer.general) || fallBack(answer.general) || askSupervisor(answer)) return false;
      absent = answer.general == general_error::kResourceUnavailable && !isOfModule(requests_.front().number);
      refuse({answer.general, answer.additional});
      break;
    case ExplicitEnd::kTimedOut:
      requests_.fail(ParameterOutcome::kTimeout);
      break;
    case ExplicitEnd::kTooLong:
      requests_.refuse(ParameterReason::kUnreadable, "the DeviceNet message is longer than one side can take");
      break;
    case ExplicitEnd::kNotConnected:
      requests_.fail(ParameterOutcome::kOffline);
      break;
  }
  next();
  return absent;
}

// How wide a parameter is that no catalogue knows its value does not say. Refused so, it surely was not written.
bool DevicenetParameters::tryOtherWidth(std::uint8_t general) noexcept {
  const ParameterRequest& request = requests_.front();
  if (request.action == ParameterAction::kRead || other_width_) return false;
  if (step_ != Step::kValue && step_ != Step::kDoubleValue) return false;
  // Narrower only where the word is the same value with a sign and without: it is read back as one without.
  const bool fits =
      !request.double_word || (request.raw >= 0 && request.raw <= std::numeric_limits<std::int16_t>::max());
  const std::uint8_t wrong_size = request.double_word ? general_error::kTooMuchData : general_error::kNotEnoughData;
  if (general != wrong_size || !fits) return false;
  other_width_ = true;
  again(byIndexObject() && !request.double_word ? Step::kDoubleValue : Step::kValue);
  return true;
}

// As on PKW: a parameter without sets may be read without one, and so may the first element of what older firmware has
// as a plain parameter (P700: BU 0020 8). In the index object the width has to be tried.
bool DevicenetParameters::fallBack(std::uint8_t general) noexcept {
  const ParameterRequest& request = requests_.front();
  if (request.action != ParameterAction::kRead || general == general_error::kResourceUnavailable) return false;
  const bool wrong_size = general == 0x11 || general == general_error::kNotEnoughData ||
                          general == general_error::kTooMuchData || general == 0x1F;
  if (byIndexObject() && step_ == Step::kValue && wrong_size) {
    again(Step::kDoubleValue);
    return true;
  }
  const bool first = request.shape == ParameterShape::kPerSet || request.index == 1;
  const bool indexed = request.shape != ParameterShape::kPlain && subIndexOf(request) != 0;
  if (plain_ || general != devicenet::general_error::kNoObject || !first || !indexed) return false;
  plain_ = true;
  again(byIndexObject() ? Step::kNumber : Step::kValue);
  return true;
}

// "The current or last active error code" (BU 0280 4.3.6) is taken to be the number P700 shows: no manual says more.
bool DevicenetParameters::askSupervisor(const ExplicitAnswer& answer) noexcept {
  const ParameterRequest& request = requests_.front();
  const bool fault = request.action == ParameterAction::kRead && request.number == kFaultNumber;
  if (!fault || subIndexOf(request) != 0 || answer.general == general_error::kResourceUnavailable) return false;
  refusal_ = {answer.general, answer.additional};
  again(Step::kSupervisor);
  return true;
}

void DevicenetParameters::refuse(const Refusal& refusal) noexcept {
  requests_.refuse(reasonOfError(refusal.general, requests_.front()),
                   errorSentence(refusal.general, refusal.additional));
}

void DevicenetParameters::takeValue(const ExplicitAnswer& answer) noexcept {
  const ParameterRequest& request = requests_.front();
  // It has none to tell: the parameter may well have.
  if (step_ == Step::kSupervisor && answer.number().value_or(0) == 0) return refuse(refusal_);
  if (request.action != ParameterAction::kRead) return requests_.done(request.raw);
  if (const auto number = answer.number()) {
    // Whether a 16 bit word is signed only the parameter's own description knows.
    return requests_.done(static_cast<std::int32_t>(*number));
  }
  Sentence text;
  text.format("the DeviceNet answer is %u bytes long, which no parameter's value is",
              static_cast<unsigned>(answer.data.size()));
  requests_.refuse(ParameterReason::kUnreadable, text);
}

void DevicenetParameters::handleOffline() noexcept {
  under_way_ = false;
  requests_.failAll(ParameterOutcome::kOffline);
}

}  // namespace nord_driver
