#include "config/drive_common.h"

#include "config/setting_checks.h"
#include "config/setting_note.h"

namespace nord_driver {

namespace {

constexpr const char* kAddress = "address";
// P105 has steps of 0.1 Hz; 400 Hz is the most any of the series turns.
constexpr double kMinMaxFrequency = 0.1, kMaxMaxFrequency = 400.0;

profile::Series readSeries(const Settings& settings) {
  std::string names;
  for (const profile::Series series : profile::kAllSeries) {
    names += (names.empty() ? "" : ", ") + std::string(profile::toString(series));
  }
  noteSetting(settings, "series", {"one of " + names, "", "", ""});
  const std::string text = requiredText(settings, "series", "one of " + names);
  const auto series = profile::seriesFrom(text);
  if (!series) throw wrongSetting(settings, "series", "\"" + text + "\"", "one of " + names);
  return *series;
}

}  // namespace

DriveCommon readDriveCommon(const DriveSettings& source) {
  const Settings& settings = *source.settings;
  DriveCommon drive;
  drive.name = source.name;
  drive.joint = textOr(settings, "joint", drive.joint);
  drive.series = readSeries(settings);
  drive.scaling.gear_ratio = numberOr(settings, "gear_ratio", drive.scaling.gear_ratio, 1e-3, 1e5, "");
  drive.scaling.pole_pairs = static_cast<int>(requiredInteger(settings, "pole_pairs", 1, 64));
  drive.scaling.inverted = booleanOr(settings, "inverted", drive.scaling.inverted);
  if (settings.has("max_frequency")) {
    drive.typed_max_frequency =
        Hertz{requiredNumber(settings, "max_frequency", kMinMaxFrequency, kMaxMaxFrequency, "Hz")};
  }
  drive.allow_minimum_frequency = booleanOr(settings, "allow_minimum_frequency", drive.allow_minimum_frequency);
  if (settings.has("rated_current")) {
    drive.rated_current = requiredNumber(settings, "rated_current", 0.01, 10'000.0, "A");
  }
  drive.address = settings.integer(kAddress);
  drive.inverter = static_cast<std::uint8_t>(integerOr(settings, "inverter", drive.inverter, 1, 4));
  return drive;
}

std::int64_t requiredAddress(const DriveSettings& source, std::int64_t min, std::int64_t max) {
  return requiredInteger(*source.settings, kAddress, min, max);
}

}  // namespace nord_driver
