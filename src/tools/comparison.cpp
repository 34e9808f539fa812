#include "tools/comparison.h"

#include <map>
#include <tuple>

#include "tools/parameter_name.h"
#include "tools/patient_access.h"

namespace nord_driver::tools {

namespace {

using Key = std::tuple<std::uint16_t, std::uint8_t, std::uint8_t>;

Key keyOf(const catalogue::ParameterAddress& address) {
  return {address.number, address.index, address.parameter_set};
}

unsigned indexOf(const catalogue::ParameterAddress& address) {
  return address.index == 0 ? 1u : address.index;
}

std::map<Key, std::int32_t> settingsOf(const Dump& dump) {
  std::map<Key, std::int32_t> settings;
  for (const Dump::Value& value : dump.values) {
    if (isSetting(value.address)) settings[keyOf(value.address)] = value.raw;
  }
  return settings;
}

bool meanSame(const catalogue::DriveCatalogue& known, const catalogue::ParameterAddress& address, std::int32_t first,
              std::int32_t second) {
  const catalogue::ParameterEntry* entry = known.find(address.number);
  if (entry == nullptr) return first == second;
  return entry->meant(first, indexOf(address)) == entry->meant(second, indexOf(address));
}

}  // namespace

Differences differencesOf(const Dump& first, const Dump& second, const catalogue::DriveCatalogue& known) {
  const auto in_first = settingsOf(first), in_second = settingsOf(second);
  Differences result;
  for (const Dump::Value& value : first.values) {
    if (!isSetting(value.address)) continue;
    ++result.compared;
    const auto other = in_second.find(keyOf(value.address));
    if (other == in_second.end()) {
      result.found.push_back({value.address, value.raw, std::nullopt});
    } else if (!meanSame(known, value.address, value.raw, other->second)) {
      result.found.push_back({value.address, value.raw, other->second});
    }
  }
  for (const Dump::Value& value : second.values) {
    if (!isSetting(value.address) || in_first.count(keyOf(value.address)) != 0) continue;
    ++result.compared;
    result.found.push_back({value.address, std::nullopt, value.raw});
  }
  return result;
}

Dump readAlike(DriveParameters& drive, const Dump& dump, const std::atomic<bool>& end_asked) {
  Dump result;
  result.series = drive.series();
  for (const Dump::Value& value : dump.values) {
    if (!isSetting(value.address)) continue;
    if (end_asked) throw Trouble("ended before all parameters were read");
    const ParameterAnswer answer = askPatiently(drive, [&] { return drive.read(value.address); });
    if (answer.success) {
      result.values.push_back({value.address, answer.raw});
    } else if (answer.refused) {
      result.missing.push_back(value.address);
    } else {
      throw Trouble(answer.message);
    }
  }
  return result;
}

void refuseOtherSeries(const std::string& first, profile::Series first_series, const std::string& second,
                       profile::Series second_series) {
  if (first_series == second_series) return;
  throw UsageError(first + " is of a " + profile::toString(first_series) + ", " + second + " of a " +
                   profile::toString(second_series) + ": their parameters differ");
}

catalogue::DriveCatalogue knownOf(const catalogue::Catalogues& catalogues, profile::Series series,
                                  const std::string& transport) {
  return catalogue::driveCatalogue(catalogues, series, transport, !transport.empty());
}

std::string parameterTitle(const catalogue::ParameterAddress& address, const catalogue::DriveCatalogue& known) {
  const catalogue::ParameterEntry* entry = known.find(address.number);
  return parameterName(address) + (entry != nullptr ? " " : "") + catalogue::fullName(entry, indexOf(address));
}

std::string differenceText(const Difference& difference, const catalogue::DriveCatalogue& known,
                           const std::string& first, const std::string& second) {
  const catalogue::ParameterEntry* entry = known.find(difference.address.number);
  const auto side = [&](const std::optional<std::int32_t>& raw, const std::string& where) {
    return (raw ? known.valueText(entry, *raw, indexOf(difference.address)) + " in " : "not in ") + where;
  };
  return parameterTitle(difference.address, known) + ": " + side(difference.first, first) + ", " +
         side(difference.second, second);
}

}  // namespace nord_driver::tools
