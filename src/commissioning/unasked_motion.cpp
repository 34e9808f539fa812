// P104 and P480: what can turn the motor when nobody commands it.
#include "commissioning/rules.h"

namespace nord_driver::commissioning {

namespace {

constexpr std::uint16_t kMinFrequency = 104, kBusBits = 480;
constexpr std::int32_t kEnableRight = 1, kEnableLeft = 2;  // of the digital inputs, P420 (BU 0280 5.1.2)
constexpr std::uint8_t kMostBusBits = 12, kSets = 4;

}  // namespace

void minimumIsZero(const Drives& drives, std::size_t index, Findings& to) {
  const DriveUnderCheck& drive = drives[index];
  const bool allowed = drive.asked().allows_minimum_frequency;
  for (std::uint8_t set = 1; set <= kSets; ++set) {
    const ParameterKey key = drive.key(kMinFrequency, set);
    const auto minimum = drive.value(key);
    if (!minimum || *minimum <= 0.0) continue;
    const Severity refused = set == drive.setInForce() ? Severity::kError : Severity::kWarning;
    Finding finding =
        drive.finding(key, allowed ? Severity::kNote : refused,
                      allowed ? "allow_minimum_frequency: true; enabled, the motor turns no slower than that, and a "
                                "command of zero is OFF1"
                              : "enabled, the motor turns at that with setpoint 0: the drive is not enabled");
    finding.remedy = drive.remedy(key, 0);
    to.push_back(finding);
  }
}

void busBitsStartNothing(const Drives& drives, std::size_t index, Findings& to) {
  const DriveUnderCheck& drive = drives[index];
  for (std::uint8_t bit = 1; bit <= kMostBusBits; ++bit) {
    const ParameterKey key = drive.key(kBusBits, 0, bit);
    const auto raw = drive.raw(key);
    if (!raw || (*raw != kEnableRight && *raw != kEnableLeft)) continue;
    Finding finding = drive.finding(key, Severity::kWarning,
                                    std::string("as ") + (*raw == kEnableRight ? "enable right" : "enable left") +
                                        " this bit starts the motor past the driver and its ~enable",
                                    "BU 0280, 5.1.2, p. 48");
    finding.remedy = drive.remedy(key, 0);
    to.push_back(finding);
  }
}

}  // namespace nord_driver::commissioning
