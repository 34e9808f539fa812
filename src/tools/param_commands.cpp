#include "tools/param_commands.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "profile/parameter_catalogue.h"
#include "tools/parameter_name.h"

namespace nord_driver::tools {

namespace {

std::uint8_t oneOf(std::uint8_t in_name, int option, const char* what) {
  if (in_name != 0 && option != 0 && in_name != option) {
    throw UsageError("--" + std::string(what) + " " + std::to_string(option) + " contradicts the parameter's name");
  }
  return in_name != 0 ? in_name : static_cast<std::uint8_t>(option);
}

std::string rangeText(const profile::ParameterInfo& info) {
  return valueText(&info, info.minimum) + " to " + valueText(&info, info.maximum);
}

const char* shapeText(profile::ParameterShape shape) {
  switch (shape) {
    case profile::ParameterShape::kPlain:
      return "";
    case profile::ParameterShape::kPerSet:
      return "sets 1 to 4";
    case profile::ParameterShape::kArray:
      return "array";
    case profile::ParameterShape::kArrayPerSet:
      return "array, sets 1 to 4";
  }
  return "";
}

void printCatalogue(profile::Series series, const std::string& drives) {
  std::printf("\nParameters known of %s (%s); others are read and written raw:\n", profile::toString(series),
              drives.c_str());
  std::vector<std::uint16_t> printed;
  for (const cycle::ParameterAddress& address : knownParameters(series)) {
    if (!printed.empty() && printed.back() == address.number) continue;
    printed.push_back(address.number);
    const profile::ParameterInfo& info = *profile::findParameter(address.number, series);
    std::string shape = shapeText(info.shape);
    if (info.elements > 1) shape += " of " + std::to_string(info.elements);
    std::printf("  P%03u  %-33s %-22s %s\n", info.number, info.name, rangeText(info).c_str(), shape.c_str());
  }
}

// "P102 set 1 Acceleration time = 2.5 s (raw 250)"
std::string answerText(cycle::ParameterAddress address, const ParameterAnswer& answer) {
  address.parameter_set = answer.set;
  std::string text = parameterName(address);
  if (answer.info != nullptr) text += std::string(" ") + answer.info->name;
  return text + " = " + valueText(answer.info, answer.raw) + " (raw " + std::to_string(answer.raw) + ")";
}

void printRefusal(const ParameterAnswer& answer) {
  std::fprintf(stderr, "nord_param: %s\n", answer.message.c_str());
}

double valueOf(const WriteOptions& write, const profile::ParameterInfo* info) {
  const double value = parseValue(write.value);
  if (!write.raw) return value;
  if (std::trunc(value) != value) throw UsageError("--raw: " + write.value + " is no whole number");
  return info != nullptr ? value * info->resolution : value;
}

}  // namespace

cycle::ParameterAddress addressOf(const std::string& name, int set, int index) {
  cycle::ParameterAddress address = parseParameterName(name);
  address.parameter_set = oneOf(address.parameter_set, set, "set");
  address.index = oneOf(address.index, index, "index");
  return address;
}

void printList(const ToolConfig& config, const Transport& transport) {
  std::vector<profile::Series> seen;
  std::printf("Drives:\n");
  for (DriveIndex i = 0; i < config.drives.size(); ++i) {
    const cycle::DriveSetup& setup = config.cycle.drives[i];
    const DriveIdentity identity = transport.identity(i);
    std::printf("  %-12s %-24s %-8s parameter channel: %s\n", setup.name.c_str(), identity.address.c_str(),
                profile::toString(setup.series), identity.parameter_channel.c_str());
    if (std::find(seen.begin(), seen.end(), setup.series) == seen.end()) seen.push_back(setup.series);
  }
  for (const profile::Series series : seen) {
    std::string names;
    for (const cycle::DriveSetup& setup : config.cycle.drives) {
      if (setup.series == series) names += (names.empty() ? "" : ", ") + setup.name;
    }
    printCatalogue(series, names);
  }
}

bool readParameter(ParameterLink& link, const cycle::ParameterAddress& address) {
  const ParameterAnswer answer = link.read(address);
  if (!answer.success) {
    printRefusal(answer);
    return false;
  }
  std::printf("%s\n", answerText(address, answer).c_str());
  return true;
}

cycle::ParameterWrite checkedWrite(const WriteOptions& write, const cycle::ParameterAddress& address,
                                   profile::Series series) {
  cycle::Request request;
  const profile::ParameterInfo* info = nullptr;
  std::string wrong = cycle::addressParameter(address, series, request, info);
  if (!wrong.empty()) throw UsageError(wrong);
  if (info == nullptr && !write.raw) {
    throw UsageError(parameterName(address) +
                     " is not in the catalogue, its unit is not known: write the raw value with --raw");
  }
  cycle::ParameterWrite checked;
  checked.value = valueOf(write, info);
  checked.persistent = write.persistent;
  checked.allow_raw = write.raw;
  wrong = cycle::addValue(checked, info, request);
  if (!wrong.empty()) throw Trouble(wrong);
  return checked;
}

bool writeParameter(ParameterLink& link, const cycle::ParameterAddress& address, const cycle::ParameterWrite& write) {
  const ParameterAnswer answer = link.write(address, write);
  if (!answer.success) {
    printRefusal(answer);
    return false;
  }
  const char* where = write.persistent ? ", in the EEPROM" : ", in RAM: lost at power off";
  std::printf("%s%s\n", answerText(address, answer).c_str(), answer.message.empty() ? where : "");
  if (!answer.message.empty()) std::printf("%s\n", answer.message.c_str());
  return true;
}

bool dumpParameters(ParameterLink& link, const std::atomic<bool>& end_asked) {
  const Dump dump = takeDump(link, end_asked);
  std::printf("%s", dumpText(dump, link.drive().name, link.identity().address).c_str());
  return true;
}

bool compareParameters(ParameterLink& link, const Dump& reference, const std::atomic<bool>& end_asked) {
  const Comparison comparison = compare(link, reference, end_asked);
  for (const std::string& difference : comparison.differences) std::printf("%s\n", difference.c_str());
  std::printf("%zu of %zu settings differ\n", comparison.differences.size(), comparison.compared);
  return comparison.differences.empty();
}

}  // namespace nord_driver::tools
