#include "sim/canopen/can_emergency.h"

#include <algorithm>

namespace nord_driver::sim {

namespace {

constexpr std::uint16_t kUnknownToTheModule = 0x1000;  // "read P700"

struct Row {
  std::uint16_t first;  // P700, ten times the printed number
  std::uint16_t last;
  std::uint16_t code;
};

// BU 0060 p. 93; the rows after 11.0 are known from the sister EtherCAT option only (BU 0570 p. 37).
constexpr std::array<Row, 24> kRows{{
    {10, 11, 0x4210},   {20, 22, 0x4310},   {30, 30, 0x2310},   {31, 31, 0x7112},   {32, 32, 0x2211},
    {33, 33, 0x2212},   {40, 41, 0x2200},   {50, 50, 0x3210},   {51, 51, 0x3110},   {60, 60, 0x3230},
    {61, 61, 0x3120},   {70, 70, 0x3130},   {80, 80, 0x6310},   {81, 82, 0x5530},   {100, 107, 0x8100},
    {108, 108, 0x5000}, {110, 110, 0x5110}, {130, 130, 0x7305}, {160, 161, 0x7120}, {170, 170, 0x5300},
    {200, 200, 0x5510}, {201, 207, 0x6000}, {208, 208, 0x5520}, {213, 213, 0x6000},
}};

}  // namespace

std::uint16_t emergencyCode(std::uint16_t fault) noexcept {
  const auto row =
      std::find_if(kRows.begin(), kRows.end(), [&](const Row& r) { return fault >= r.first && fault <= r.last; });
  return row == kRows.end() ? kUnknownToTheModule : row->code;
}

void CanEmergencyState::remember(std::uint16_t code) noexcept {
  std::copy_backward(history_.begin(), history_.end() - 1, history_.end());
  history_[0] = code;
  if (count_ < kHistory) ++count_;
}

}  // namespace nord_driver::sim
