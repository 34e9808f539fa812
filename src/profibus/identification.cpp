#include "profibus/identification.h"

namespace nord_driver::profibus {

namespace {

constexpr std::uint8_t kCallIndex = 255;
constexpr std::uint8_t kCall = 0x08;             // Extended_Function_Num
constexpr std::uint16_t kFirstFiIndex = 65'000;  // I&M0; I&M1 is the next
constexpr std::size_t kCallHeader = 4;
constexpr std::size_t kDeviceHeader = 10;

/// Characters that print, without the blanks behind them.
template <std::size_t N>
FixedText<N> printed(ByteView bytes) noexcept {
  char text[N + 1] = {};
  std::size_t length = 0;
  for (std::size_t i = 0; i < bytes.size() && i < N; ++i) {
    const std::uint8_t byte = bytes[i];
    text[i] = byte > 0x20 && byte < 0x7F ? static_cast<char>(byte) : ' ';
    if (text[i] != ' ') length = i + 1;
  }
  text[length] = '\0';
  return FixedText<N>{text};
}

}  // namespace

Sentence describe(const TypePlate& plate) noexcept {
  Sentence text;
  FixedText<30> maker;
  maker.format(plate.manufacturer == kNordManufacturer ? "NORD (manufacturer %u)" : "manufacturer %u",
               unsigned{plate.manufacturer});
  text.format("%s, order number %s, serial number %s, hardware %u, software %c%u.%u.%u", maker.c_str(),
              plate.order_number.empty() ? "not told" : plate.order_number.c_str(),
              plate.serial_number.empty() ? "not told" : plate.serial_number.c_str(), unsigned{plate.hardware},
              plate.software_kind, unsigned{plate.software[0]}, unsigned{plate.software[1]},
              unsigned{plate.software[2]});
  return text;
}

std::optional<RecordRequest> IdentificationReader::pollRecord() noexcept {
  RecordRequest request;
  request.slot = slot_;
  request.index = kCallIndex;
  switch (step_) {
    case Step::kCall: {
      request.write = true;
      ByteWriter<kMaxRecordLength> writer{request.data};
      writer.u8(kCall);
      writer.u8(0);
      writer.u16be(static_cast<std::uint16_t>(kFirstFiIndex + number_));
      step_ = Step::kCalled;
      return request;
    }
    case Step::kFetch:
      request.length = static_cast<std::uint8_t>(kCallHeader + kLength);
      step_ = Step::kFetched;
      return request;
    case Step::kCalled:
    case Step::kFetched:
    case Step::kDone:
      break;
  }
  return std::nullopt;
}

void IdentificationReader::handleRecord(const RecordResult& result) noexcept {
  if (step_ != Step::kCalled && step_ != Step::kFetched) return;
  const bool called = step_ == Step::kCalled;
  outcome_ = result.outcome;
  step_ = Step::kDone;
  if (result.outcome == RecordOutcome::kRefused) {
    trouble_.format("it has no I&M%u record: DP-V1 error %02X, %s", unsigned{number_}, unsigned{result.error.code1},
                    meaningOf(result.error));
  }
  if (result.outcome != RecordOutcome::kDone) return;
  if (called) {
    step_ = Step::kFetch;
    return;
  }
  ByteReader reader{result.data};
  const std::uint8_t function = reader.u8();
  reader.u8();
  const std::uint16_t fi_index = reader.u16be();
  if (function != kCall || fi_index != kFirstFiIndex + number_ || reader.remaining() != kLength) {
    trouble_.format("its I&M%u record has %zu bytes, or is another one: expected %zu behind 08 00 %04X",
                    unsigned{number_}, reader.remaining(), kLength, unsigned{kFirstFiIndex} + number_);
    return;
  }
  for (const std::uint8_t byte : reader.rest()) data_.push_back(byte);
}

std::optional<TypePlate> IdentificationReader::typePlate() const noexcept {
  if (number_ != 0 || data_.empty()) return std::nullopt;
  const ByteView data{data_};
  constexpr std::size_t kOrder = kDeviceHeader + 2, kSerial = kOrder + 20, kNumbers = kSerial + 16;
  TypePlate plate;
  ByteReader reader{data.sub(kDeviceHeader)};
  plate.manufacturer = reader.u16be();
  plate.order_number = printed<20>(data.sub(kOrder, 20));
  plate.serial_number = printed<16>(data.sub(kSerial, 16));
  ByteReader numbers{data.sub(kNumbers)};
  plate.hardware = numbers.u16be();
  const std::uint8_t kind = numbers.u8();
  plate.software_kind = kind > 0x20 && kind < 0x7F ? static_cast<char>(kind) : '?';
  for (std::uint8_t& part : plate.software) part = numbers.u8();
  plate.revision = numbers.u16be();
  plate.profile = numbers.u16be();
  plate.profile_type = numbers.u16be();
  for (std::uint8_t& part : plate.version) part = numbers.u8();
  plate.supported = numbers.u16be();
  return plate;
}

FixedText<54> IdentificationReader::text() const noexcept {
  if (number_ == 0) return {};
  return printed<54>(ByteView{data_}.sub(kDeviceHeader));
}

}  // namespace nord_driver::profibus
