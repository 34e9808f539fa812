#include "tools/restore/restore_plan.h"

#include <algorithm>
#include <iterator>
#include <tuple>

#include "cycle/drive_parameters.h"
#include "profile/module_parameters.h"
#include "tools/comparison.h"
#include "tools/parameter_name.h"
#include "tools/patient_access.h"

namespace nord_driver::tools {

namespace {

constexpr std::uint16_t kMaxFrequency = 105, kSaveInEeprom = 560;

// PPO type, address, source of the control word, baud rates and addresses of USS and CAN (BU 0020 6.2, BU 0280 5.1.3),
// drive profile (BU 0020 6.2); of the bus modules address, assemblies and objects (BU 2700 7.1, BU 0280 5.2).
constexpr std::uint16_t kReached[] = {507, 508, 509, 511, 512, 514, 515, 551};
constexpr std::uint16_t kFirstOfModule = 160, kLastOfModule = 169;
// The last of them: from then on it may answer elsewhere.
constexpr std::uint16_t kAddresses[] = {160, 508, 512, 515};

// Monitoring of the option, of the words and of the module (P120, P513, P151), system bus and inputs of the module
// (P153, P154), source of setpoints.
constexpr std::uint16_t kWords[] = {kMaxFrequency, 120, 151, 153, 154, 510, 513};
constexpr std::uint16_t kFirstFunction = 543, kLastFunction = 548;

template <std::size_t kSize>
bool isOneOf(const std::uint16_t (&numbers)[kSize], std::uint16_t number) noexcept {
  return std::find(std::begin(numbers), std::end(numbers), number) != std::end(numbers);
}

bool decidesMotion(std::uint16_t number) noexcept {
  cycle::Request request;
  request.kind = cycle::RequestKind::kWriteParameter;
  request.parameter.number = number;
  return cycle::decidesMotion(request);
}

auto orderOf(const RestoreChange& change) {
  const catalogue::ParameterAddress& address = change.address;
  const bool last = address.number == kMaxFrequency || isOneOf(kAddresses, address.number);
  return std::make_tuple(stageOf(address.number), last, address.number, address.index, address.parameter_set);
}

unsigned indexOf(const catalogue::ParameterAddress& address) noexcept {
  return std::max<unsigned>(address.index, 1);
}

// Empty: it may be written.
std::string whyNot(const DriveParameters& drive, const Dump::Value& value, const RestoreOptions& options) {
  const RestoreStage stage = stageOf(value.address.number);
  if (value.address.number == kSaveInEeprom) return "it decides where every write goes: write it by itself";
  if (stage >= RestoreStage::kProcessData && options.bus_settings == BusSettings::kNone) return "a bus setting";
  if (stage == RestoreStage::kReach && options.bus_settings != BusSettings::kAll) {
    return "the bus reaches the drive by it; --with-bus-settings writes it";
  }
  if (!options.persistent && profile::isOfModule(value.address.number) && drive.identity().module_saves) {
    return "the module has no order here that spares its EEPROM; --persistent writes it";
  }
  std::string forbidden = drive.whyNotWritten(value.address.number);
  if (!forbidden.empty()) return forbidden;
  catalogue::ParameterAccess access = catalogue::accessTo(value.address, drive.known());
  if (!access.error.empty()) return access.error;
  return catalogue::setRaw(access, value.raw, options.persistent);
}

std::string padded(std::string text, std::size_t width) {
  if (text.size() < width) text.resize(width, ' ');
  return text;
}

}  // namespace

RestoreStage stageOf(std::uint16_t number) noexcept {
  if (isOneOf(kReached, number) || (number >= kFirstOfModule && number <= kLastOfModule)) return RestoreStage::kReach;
  if (isOneOf(kWords, number) || (number >= kFirstFunction && number <= kLastFunction)) {
    return RestoreStage::kProcessData;
  }
  return decidesMotion(number) ? RestoreStage::kMotion : RestoreStage::kNeutral;
}

bool meansSame(const catalogue::DriveCatalogue& known, const catalogue::ParameterAddress& address, std::int32_t first,
               std::int32_t second) {
  const catalogue::ParameterEntry* entry = known.find(address.number);
  if (entry == nullptr) return first == second;
  return entry->meant(first, indexOf(address)) == entry->meant(second, indexOf(address));
}

std::string rawText(const catalogue::DriveCatalogue& known, const catalogue::ParameterAddress& address,
                    std::int32_t raw) {
  return known.valueText(known.find(address.number), raw, indexOf(address));
}

RestorePlan planRestore(DriveParameters& drive, const Dump& dump, const RestoreOptions& options,
                        const std::atomic<bool>& end_asked) {
  refuseOtherSeries("the dump", dump.series, "drive " + drive.name(), drive.series());
  const catalogue::DriveCatalogue& known = drive.known();
  RestorePlan plan;
  for (const Dump::Value& value : dump.values) {
    if (!isSetting(value.address) || catalogue::resetsDevice(value.address.number)) continue;
    if (end_asked) throw Trouble("ended before all parameters were read; nothing was written");
    const ParameterAnswer answer = askPatiently(drive, [&] { return drive.read(value.address); });
    if (!answer.success && !answer.refused) throw Trouble(answer.message + "; nothing was written");
    if (!answer.success) {
      plan.left_out.push_back({value.address, value.raw, std::nullopt, "not in this drive: " + answer.message});
      continue;
    }
    const bool same = meansSame(known, value.address, answer.raw, value.raw);
    if (same) plan.same.push_back({value.address, answer.raw});
    if (same && !(options.persistent && options.save_same)) continue;
    const std::string why = whyNot(drive, value, options);
    if (why.empty()) {
      plan.changes.push_back({value.address, answer.raw, value.raw});
    } else if (!same) {
      plan.left_out.push_back({value.address, value.raw, answer.raw, why});
    }
  }
  std::stable_sort(plan.changes.begin(), plan.changes.end(),
                   [](const RestoreChange& a, const RestoreChange& b) { return orderOf(a) < orderOf(b); });
  return plan;
}

std::string planText(const RestorePlan& plan, const catalogue::DriveCatalogue& known, bool persistent) {
  std::size_t title = 0, from = 0;
  for (const RestoreChange& change : plan.changes) {
    title = std::max(title, parameterTitle(change.address, known).size());
    from = std::max(from, rawText(known, change.address, change.before).size());
  }
  std::string text;
  for (const RestoreChange& change : plan.changes) {
    text += "  " + padded(parameterTitle(change.address, known), title) + "  " +
            padded(rawText(known, change.address, change.before), from) + "  ->  " +
            rawText(known, change.address, change.after) + "\n";
  }
  if (!plan.left_out.empty()) text += "left out:\n";
  for (const RestorePlan::LeftOut& left : plan.left_out) {
    text += "  " + parameterTitle(left.address, known);
    if (left.there) text += ": " + rawText(known, left.address, *left.there) + " in the drive";
    text +=
        (left.there ? ", " : ": ") + rawText(known, left.address, left.wanted) + " in the file (" + left.why + ")\n";
  }
  text += std::to_string(plan.changes.size()) + " to be written" +
          (persistent ? ", each one of the 100 000 writes of the EEPROM; " : ", in RAM: lost at power off; ") +
          std::to_string(plan.same.size()) + " have their value already, " + std::to_string(plan.left_out.size()) +
          " left out\n";
  return text;
}

}  // namespace nord_driver::tools
