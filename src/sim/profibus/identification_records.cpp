#include "sim/profibus/identification_records.h"

#include <cstring>

namespace nord_driver::sim {

namespace {

constexpr std::uint8_t kCall = 0x08;
constexpr std::uint16_t kTypePlate = 65'000;  // FDE8h: I&M0
constexpr std::uint8_t kWriteLength = 0xB1;
constexpr std::uint8_t kInvalidIndex = 0xB0;
constexpr std::uint8_t kFeatureNotSupported = 0xA9;

void addText(ByteWriter<68>& writer, const char* text, std::size_t length) noexcept {
  const std::size_t used = std::strlen(text);
  for (std::size_t i = 0; i < length; ++i) writer.u8(i < used ? static_cast<std::uint8_t>(text[i]) : std::uint8_t{' '});
}

}  // namespace

std::optional<std::uint8_t> IdentificationRecords::write(ByteView data) noexcept {
  called_ = false;
  if (data.size() < 4) return kWriteLength;
  ByteReader reader{data};
  if (reader.u8() != kCall || reader.u8() != 0) return kFeatureNotSupported;
  if (!settings_.active || reader.u16be() != kTypePlate) return kInvalidIndex;
  if (reader.remaining() > 0) return kFeatureNotSupported;  // the type plate cannot be written
  called_ = true;
  return std::nullopt;
}

std::optional<IdentificationRecords::Data> IdentificationRecords::read() noexcept {
  if (!called_) return std::nullopt;
  called_ = false;
  Data data;
  ByteWriter<68> writer{data};
  writer.u8(kCall);
  writer.u8(0);
  writer.u16be(kTypePlate);
  for (int i = 0; i < 10; ++i) writer.u8(' ');  // the manufacturer's own
  writer.u16be(settings_.manufacturer);
  addText(writer, settings_.order_number, 20);
  addText(writer, settings_.serial_number, 16);
  writer.u16be(settings_.hardware);
  writer.u8('V');
  for (const std::uint8_t part : settings_.software) writer.u8(part);
  writer.u16be(0);       // revision counter
  writer.u16be(0x3A00);  // PROFIdrive
  writer.u16be(0);       // no specific type
  writer.u16be(0x0101);  // version 1.1 of I&M
  writer.u16be(0x0001);  // I&M0
  return data;
}

}  // namespace nord_driver::sim
