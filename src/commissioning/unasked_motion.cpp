// P104 and P480: what can turn the motor when nobody commands it.
#include <algorithm>

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
                              : "with setpoint 0 the motor would turn at that, and the driver does not enable it");
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
    const auto& position_bits = drive.asked().position_bits;
    const auto asked = std::find_if(position_bits.begin(), position_bits.end(), [bit](const cycle::AskedBit& other) {
      return other.number == kBusBits && other.element == bit;
    });
    // What somebody has accepted by name is told, and not taken away.
    const auto& accepted = drive.asked().may_move_bits;
    const bool may_move = std::find(accepted.begin(), accepted.end(), bit) != accepted.end();
    Finding finding = drive.finding(key, may_move ? Severity::kNote : Severity::kWarning,
                                    std::string("as ") + (*raw == kEnableRight ? "enable right" : "enable left") +
                                        " this bit starts the motor past the driver and its ~enable" +
                                        (may_move ? ", as a signal with may_move: true accepts" : ""),
                                    "BU 0280, 5.1.2, p. 48");
    if (may_move) {
      finding.advice = "leave it only where nobody is hurt by a motor that starts";
    } else {
      finding.remedy = drive.remedy(key, asked == position_bits.end() ? 0 : asked->function);
    }
    to.push_back(finding);
  }
}

}  // namespace nord_driver::commissioning
