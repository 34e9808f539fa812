#include "sim/devicenet/dn_layout.h"

#include <algorithm>

namespace nord_driver::sim {

namespace {

// P160 = 0 to 5.
constexpr std::array<unsigned, 6> kInstances{120, 20, 21, 100, 101, 102};
constexpr unsigned kVariable = 120;

std::uint8_t lengthOf(const ParameterStore& module, unsigned number, unsigned element) noexcept {
  return static_cast<std::uint8_t>(std::clamp(module.value(number, 0, element), 0, 8));
}

DnLayout oneInverter(unsigned instance, bool module_byte, std::uint8_t length, DnProfile profile) noexcept {
  DnLayout layout;
  layout.instance = instance;
  layout.input_byte = layout.output_byte = module_byte;
  layout.areas[0] = {length, length, profile};
  return layout;
}

}  // namespace

std::size_t DnLayout::inputs() const noexcept {
  std::size_t length = input_byte ? 1 : 0;
  for (const DnArea& area : areas) length += area.status_length;
  return length;
}

std::size_t DnLayout::outputs() const noexcept {
  std::size_t length = output_byte ? 1 : 0;
  for (const DnArea& area : areas) length += area.control_length;
  return length;
}

DnLayout DnLayout::ofInstance(unsigned instance, const ParameterStore& module) noexcept {
  switch (instance) {
    case 20:
      return oneInverter(instance, false, 4, DnProfile::kAcDrive);
    case 21:
      return oneInverter(instance, false, 4, DnProfile::kAcDriveExtended);
    case 100:
      return oneInverter(instance, true, 4, DnProfile::kNord);
    case 101:
      return oneInverter(instance, false, 8, DnProfile::kNord);
    case 102: {
      DnLayout layout = oneInverter(instance, true, 8, DnProfile::kNord);
      layout.areas.fill(layout.areas[0]);
      return layout;
    }
    default:
      break;
  }
  DnLayout layout;
  layout.instance = instance;
  if (instance != kVariable) return layout;
  layout.input_byte = module.value(161, 0, 0) == 1;
  layout.output_byte = module.value(161, 0, 1) == 1;
  for (unsigned place = 0; place < kInverters; ++place) {
    const unsigned number = 162 + place;
    const std::int32_t profile = module.value(number, 0, 2);
    layout.areas[place] = {lengthOf(module, number, 0), lengthOf(module, number, 1),
                           profile == 0   ? DnProfile::kAcDrive
                           : profile == 1 ? DnProfile::kAcDriveExtended
                                          : DnProfile::kNord};
  }
  return layout;
}

unsigned dnInstanceOfSelection(std::int32_t p160) noexcept {
  return p160 >= 0 && p160 < static_cast<std::int32_t>(kInstances.size()) ? kInstances[static_cast<std::size_t>(p160)]
                                                                          : kInstances[3];
}

int dnSelectionOfInstance(unsigned instance) noexcept {
  const auto at = std::find(kInstances.begin(), kInstances.end(), instance);
  return at == kInstances.end() ? -1 : static_cast<int>(at - kInstances.begin());
}

unsigned dnInputInstanceOf(unsigned output_instance) noexcept {
  return output_instance < 100 ? output_instance + 50 : output_instance + 10;
}

}  // namespace nord_driver::sim
