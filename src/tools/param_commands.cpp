#include "tools/param_commands.h"

#include <cstdio>

#include "catalogue/yaml_map.h"
#include "profile/parameter_shape.h"
#include "tools/parameter_json.h"
#include "tools/parameter_name.h"

namespace nord_driver::tools {

namespace {

std::uint8_t oneOf(std::uint8_t in_name, int option, const char* what) {
  if (in_name != 0 && option != 0 && in_name != option) {
    throw UsageError("--" + std::string(what) + " " + std::to_string(option) + " contradicts the parameter's name");
  }
  return in_name != 0 ? in_name : static_cast<std::uint8_t>(option);
}

catalogue::ParameterAddress addressOf(const catalogue::ParameterAccess& access) {
  catalogue::ParameterAddress address;
  address.number = access.request.number;
  if (profile::isArray(access.request.shape)) address.index = access.request.index;
  return address;
}

// "P102 set 1 Acceleration time = 2.50 s (raw 250)"
std::string answerText(catalogue::ParameterAddress address, const ParameterAnswer& answer,
                       const DriveParameters& drive) {
  address.parameter_set = answer.set;
  const unsigned index = address.index == 0 ? 1u : address.index;
  std::string text = parameterName(address);
  if (answer.entry != nullptr) text += " " + catalogue::fullName(answer.entry, index);
  return text + " = " + drive.known().valueText(answer.entry, answer.raw, index) + " (raw " +
         std::to_string(answer.raw) + ")";
}

void printRefusal(const ParameterAnswer& answer) {
  std::fprintf(stderr, "nord_param: %s\n", answer.message.c_str());
}

}  // namespace

catalogue::ParameterAddress addressOf(const std::string& name, int set, int index,
                                      const catalogue::DriveCatalogue& known) {
  catalogue::ParameterAddress address = findParameter(name, known);
  address.parameter_set = oneOf(address.parameter_set, set, "set");
  address.index = oneOf(address.index, index, "index");
  return address;
}

bool readParameter(DriveParameters& drive, const catalogue::ParameterAddress& address, bool json) {
  const ParameterAnswer answer = drive.read(address);
  if (!answer.success) {
    printRefusal(answer);
    return false;
  }
  if (json) {
    std::fputs(answerJson(address, answer, drive).c_str(), stdout);
    return true;
  }
  std::printf("%s\n", answerText(address, answer, drive).c_str());
  return true;
}

catalogue::ParameterAccess checkedWrite(const WriteOptions& write, const catalogue::ParameterAddress& address,
                                        const catalogue::DriveCatalogue& known) {
  catalogue::ParameterAccess access = catalogue::accessTo(address, known);
  if (!access.error.empty()) throw UsageError(access.error);
  const bool may_be = access.entry != nullptr ? access.entry->mayWrite() : !catalogue::resetsDevice(address.number);
  const std::string unknown = catalogue::whyUnitUnknown(access);
  if (!write.raw && may_be && !unknown.empty()) throw UsageError(unknown + ", write the raw value with --raw");
  if (write.raw) {
    const auto raw = catalogue::wholeNumber(write.value);
    if (!raw) throw UsageError("--raw: " + write.value + " is no whole number");
    const std::string wrong = catalogue::setRaw(access, *raw, write.persistent);
    if (!wrong.empty()) throw Trouble(wrong);
    return access;
  }
  const std::string wrong = catalogue::setText(access, write.value, write.persistent);
  if (wrong.empty()) return access;
  const bool may_be_written = access.entry != nullptr && access.entry->mayWrite();
  if (may_be_written && !catalogue::decimalNumber(write.value)) throw UsageError(wrong);
  throw Trouble(wrong);
}

bool writeParameter(DriveParameters& drive, const catalogue::ParameterAccess& access, bool json) {
  const ParameterAnswer answer = drive.write(access);
  if (!answer.success) {
    printRefusal(answer);
    return false;
  }
  if (json) {
    std::fputs(answerJson(addressOf(access), answer, drive).c_str(), stdout);
    return true;
  }
  const bool persistent = access.request.action == profile::ParameterAction::kWritePersistent;
  const char* where = persistent ? ", in the EEPROM" : ", in RAM: lost at power off";
  std::printf("%s%s\n", answerText(addressOf(access), answer, drive).c_str(), answer.message.empty() ? where : "");
  if (!answer.message.empty()) std::printf("%s\n", answer.message.c_str());
  return true;
}

}  // namespace nord_driver::tools
