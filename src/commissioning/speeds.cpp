// P105: whether the drive reaches the speeds that the configuration asks for.
#include <cmath>

#include "commissioning/rules.h"
#include "core/text.h"

namespace nord_driver::commissioning {

namespace {

constexpr std::uint16_t kMaxFrequency = 105;
constexpr double kHalfStep = 0.05;                     // Hz
constexpr double kHardlyUsed = 0.1, kFarBeyond = 3.0;  // shares that no robot is built for on purpose

std::string hertz(double value) {
  const double rounded = std::round(value * 10.0) / 10.0;
  std::string text = std::to_string(rounded);
  return text.substr(0, text.find('.') + 2) + " Hz";
}

}  // namespace

void maximumReachesTopSpeed(const Drives& drives, std::size_t index, Findings& to) {
  const DriveUnderCheck& drive = drives[index];
  const ParameterKey key = drive.key(kMaxFrequency);
  const auto maximum = drive.value(key);
  const double top = drive.asked().top_frequency;
  if (!maximum || *maximum <= 0.0 || top <= 0.0) return;
  const std::string figures = "gear_ratio and pole_pairs of this drive, and the radius of the wheel";
  if (top > *maximum + kHalfStep) {
    Finding finding =
        drive.finding(key, Severity::kWarning,
                      drive.asked().top_of + " asks " + hertz(top) + " of the motor, and the drive ends at " +
                          hertz(*maximum) + ": it is never that fast",
                      "BU 2700, 6.4.4");
    finding.advice = top > kFarBeyond * *maximum
                         ? "compare " + figures + " with the nameplates"
                         : "raise it as far as motor, gear and brake allow, or lower " + drive.asked().top_of;
    to.push_back(finding);
  } else if (top < kHardlyUsed * *maximum) {
    Finding finding = drive.finding(
        key, Severity::kNote, drive.asked().top_of + " asks only " + hertz(top) + " of the motor", "BU 2700, 6.4.4");
    finding.advice = "compare " + figures + " with the nameplates";
    to.push_back(finding);
  }
}

void maximumIsAsTyped(const Drives& drives, std::size_t index, Findings& to) {
  const DriveUnderCheck& drive = drives[index];
  const auto& typed = drive.asked().typed_max_frequency;
  if (!typed) return;
  for (std::uint8_t set = 1; set <= 4; ++set) {
    const ParameterKey key = drive.key(kMaxFrequency, set);
    const auto maximum = drive.value(key);
    if (!maximum || std::abs(*maximum - *typed) <= kHalfStep) continue;
    Finding finding = drive.finding(key, Severity::kWarning,
                                    "max_frequency is configured as " + hertz(*typed) + "; the drive's own counts");
    finding.advice = "correct the one that is wrong, or leave max_frequency out";
    to.push_back(finding);
  }
}

}  // namespace nord_driver::commissioning
