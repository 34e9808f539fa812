#include "transport/devicenet/assembly.h"

#include <array>
#include <utility>

namespace nord_driver {

namespace {

// BU 0280 4.2.2.
constexpr std::array<AssemblyLayout, 6> kAssemblies{{
    {20, 70, 1, 4, false, 1, 4, DevicenetProfile::kAcDrive},
    {21, 71, 2, 4, false, 1, 4, DevicenetProfile::kAcDriveExtended},
    {100, 110, 3, 5, true, 1, 4, DevicenetProfile::kNord},
    {101, 111, 4, 8, false, 1, 8, DevicenetProfile::kNord},
    {102, 112, 5, 33, true, 4, 8, DevicenetProfile::kNord},
    {kVariableAssembly, 130, 0, 0, false, 4, 0, DevicenetProfile::kNord},
}};

std::size_t placeOf(std::size_t value, bool third_before_second, std::size_t values) noexcept {
  if (!third_before_second || values < 3 || value == 0) return value;
  return 3 - value;
}

void putWord(devicenet::IoBytes& bytes, std::size_t at, Word word) noexcept {
  bytes[at] = static_cast<std::uint8_t>(word & 0xFFu);
  bytes[at + 1] = static_cast<std::uint8_t>(word >> 8u);
}

}  // namespace

const AssemblyLayout* findAssembly(unsigned output) noexcept {
  for (const AssemblyLayout& layout : kAssemblies) {
    if (layout.output == output) return &layout;
  }
  return nullptr;
}

void layOut(DevicenetConfig& config) {
  for (std::size_t i = 0; i < config.modules.size(); ++i) {
    DevicenetModule& module = config.modules[i];
    const AssemblyLayout& layout = *findAssembly(module.assembly);
    std::size_t output = module.output_byte ? 1 : 0;
    std::size_t input = module.input_byte ? 1 : 0;
    for (std::uint8_t inverter = 1; inverter <= layout.inverters; ++inverter) {
      std::size_t control = layout.inverter_bytes, status = layout.inverter_bytes;
      for (const std::size_t index : module.drives) {
        DevicenetDrive& drive = config.drives[index];
        if (drive.inverter != inverter) continue;
        drive.control_offset = output;
        drive.status_offset = input;
        control = drive.control_bytes;
        status = drive.status_bytes;
      }
      output += control;
      input += status;
    }
    config.scanner.nodes[i].io.output_bytes = output;
    config.scanner.nodes[i].io.input_bytes = input;
  }
}

void packWords(const DevicenetDrive& drive, const profile::ProcessOutput& output, devicenet::IoBytes& bytes) noexcept {
  putWord(bytes, drive.control_offset, output.control_word);
  const std::size_t values = drive.control_bytes / 2 - 1;
  for (std::size_t i = 0; i < values; ++i) {
    const std::size_t place = placeOf(i, drive.third_before_second, values);
    putWord(bytes, drive.control_offset + 2 + 2 * place, toWord(output.setpoints[i]));
  }
}

bool unpackWords(const DevicenetDrive& drive, ByteView bytes, profile::ProcessInput& input) noexcept {
  ByteReader reader{bytes.sub(drive.status_offset, drive.status_bytes)};
  if (reader.remaining() != drive.status_bytes) return false;
  input = {};
  input.status_word = reader.u16le();
  const std::size_t values = drive.status_bytes / 2 - 1;
  std::array<Word, profile::kMaxProcessValues> words{};
  for (std::size_t i = 0; i < values; ++i) words[i] = reader.u16le();
  for (std::size_t i = 0; i < values; ++i) {
    input.actual_values[i] = toSigned(words[placeOf(i, drive.third_before_second, values)]);
  }
  return true;
}

void packAcDrive(const DevicenetDrive& drive, const profile::AcDriveOutput& output,
                 devicenet::IoBytes& bytes) noexcept {
  bytes[drive.control_offset] = output.control;
  bytes[drive.control_offset + 1] = 0;
  putWord(bytes, drive.control_offset + 2, toWord(output.speed));
}

bool unpackAcDrive(const DevicenetDrive& drive, ByteView bytes, profile::AcDriveInput& input) noexcept {
  ByteReader reader{bytes.sub(drive.status_offset, drive.status_bytes)};
  if (reader.remaining() < 4) return false;
  input.status = reader.u8();
  input.state = reader.u8();
  input.speed = toSigned(reader.u16le());
  return true;
}

}  // namespace nord_driver
