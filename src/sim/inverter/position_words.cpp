#include "sim/inverter/position_words.h"

namespace nord_driver::sim {

namespace {

constexpr bool kActual = false, kSet = true;
constexpr bool kThousandths = false, kIncrements = true;

// P546 of SK 700E and 750E: BU 0020 6.1.2.
PositionFunction olderFirstSetpoint(std::int32_t code) noexcept {
  switch (code) {
    case 2:
      return {PositionWord::kWhole, kSet, kThousandths};
    case 3:
      return {PositionWord::kWide, kSet, kThousandths};
    case 4:
      return {PositionWord::kControlBits, kSet, kThousandths};
    case 5:
      return {PositionWord::kWhole, kSet, kIncrements};
    case 6:
      return {PositionWord::kWide, kSet, kIncrements};
    default:
      return {};
  }
}

}  // namespace

bool hasPosicon(Series series) noexcept {
  return series != Series::kSk300e && series != Series::kSk1x0e;
}

PositionFunction positionSetpoint(const Device& device, unsigned n, std::int32_t code) noexcept {
  if (!hasPosicon(device.series)) return {};
  if (device.isOlderSeries()) {
    if (n == 0) return olderFirstSetpoint(code);
    return code == 12 ? PositionFunction{PositionWord::kControlBits, kSet, kThousandths} : PositionFunction{};
  }
  switch (code) {  // BU 0020 7.3.5; 23 and 24 with "incl.": BU 2700 5.3
    case 21:
      return {PositionWord::kLow, kSet, kThousandths};
    case 22:
      return {PositionWord::kHigh, kSet, kThousandths};
    case 23:
      return {PositionWord::kLow, kSet, kIncrements};
    case 24:
      return {PositionWord::kHigh, kSet, kIncrements};
    default:
      return {};
  }
}

PositionFunction positionActual(const Device& device, std::int32_t code) noexcept {
  if (!hasPosicon(device.series)) return {};
  const bool older = device.isOlderSeries();
  const PositionWord low = older ? PositionWord::kWhole : PositionWord::kLow;
  switch (code) {  // 6, 7, 10 and 11 of the older series: BU 0020 6.1.2; 10 and 15 of the others: BU 2700 5.3
    case 6:
      return {low, kActual, kThousandths};
    case 7:
      return {low, kSet, kThousandths};
    case 10:
      return {low, kActual, kIncrements};
    case 11:
      return {low, kSet, kIncrements};
    default:
      break;
  }
  if (older) return {};
  switch (code) {  // 13, 14 and 16 complete the others: BU 0020 6.2.2 has them reserved for BU 0510
    case 13:
      return {PositionWord::kHigh, kActual, kThousandths};
    case 14:
      return {PositionWord::kHigh, kSet, kThousandths};
    case 15:
      return {PositionWord::kHigh, kActual, kIncrements};
    case 16:
      return {PositionWord::kHigh, kSet, kIncrements};
    default:
      return {};
  }
}

}  // namespace nord_driver::sim
