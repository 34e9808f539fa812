#include "sim/interbus/register_gateway.h"

#include <algorithm>

namespace nord_driver::sim {

namespace {

constexpr std::size_t kHeader = 7;  // transaction, protocol, length, unit
constexpr std::uint8_t kReadHolding = 3, kReadInput = 4, kWriteOne = 6, kWrite = 16, kReadWrite = 23;
constexpr std::uint8_t kGood = 0, kIllegalFunction = 1, kIllegalAddress = 2, kIllegalValue = 3;
constexpr unsigned kMostRead = 125, kMostWritten = 123, kMostWrittenWithRead = 121;

}  // namespace

std::size_t modbusLength(ByteView bytes) noexcept {
  if (bytes.size() < kHeader) return 0;
  ByteReader reader{bytes};
  reader.u32be();
  const std::size_t length = 6u + reader.u16be();
  return bytes.size() < length ? 0 : length;
}

RegisterGateway::RegisterGateway(const IbsBusConfig& config, IbsRing& ring) : config_(config), ring_(ring) {
  if (config.pcp) pcp_.emplace(*config.pcp, ring);
}

Word RegisterGateway::turned(Word word) const noexcept {
  return config_.swapped ? static_cast<Word>(word << 8 | word >> 8) : word;
}

void RegisterGateway::advance(Instant now) noexcept {
  if (pcp_) pcp_->advance(now);
  if (watchdog_ == 0 || !last_write_ || now - *last_write_ <= std::chrono::milliseconds(watchdog_)) return;
  std::fill(ring_.outputs().begin(), ring_.outputs().end(), Word{0});
  ring_.masterBegins();
  last_write_.reset();
  ++watchdog_trips_;
}

ModbusBytes RegisterGateway::handle(ByteView request, Instant now) noexcept {
  ByteReader reader{request};
  const std::uint16_t transaction = reader.u16be();
  const std::uint16_t protocol = reader.u16be();
  const std::uint16_t length = reader.u16be();
  const std::uint8_t unit = reader.u8();
  const std::uint8_t function = reader.u8();
  ModbusBytes answer;
  if (!reader.ok() || protocol != 0 || length + 6u != request.size() || unit != config_.unit) return answer;
  ByteWriter<kLongestModbus> writer{answer};
  writer.u16be(static_cast<std::uint16_t>(transaction + switches_.wrong_transaction));
  writer.u16be(0);
  writer.u16be(0);  // set below
  writer.u8(unit);
  writer.u8(function);
  const std::uint8_t code = switches_.exception ? *switches_.exception : execute(reader, function, writer, now);
  if (code != kGood) {
    answer.resize(kHeader);
    writer.u8(static_cast<std::uint8_t>(function | 0x80u));
    writer.u8(code);
  }
  answer[5] = static_cast<std::uint8_t>(answer.size() - 6);
  if (switches_.silent) answer.clear();
  return answer;
}

std::uint8_t RegisterGateway::execute(ByteReader& request, std::uint8_t function, ByteWriter<kLongestModbus>& answer,
                                      Instant now) noexcept {
  if (function != kReadHolding && function != kReadInput && function != kWriteOne && function != kWrite &&
      function != kReadWrite) {
    return kIllegalFunction;
  }
  const unsigned first = request.u16be();
  if (function == kWriteOne) {
    ByteReader value = request;
    const std::uint8_t code = write(first, 1, request, now);
    answer.u16be(static_cast<Word>(first));
    answer.u16be(value.u16be());
    return code;
  }
  const unsigned count = request.u16be();
  if (function == kReadHolding || function == kReadInput) {
    if (count == 0 || count > kMostRead || !request.ok()) return kIllegalValue;
    return read(first, count, function == kReadHolding, answer);
  }
  unsigned write_first = first, write_count = count;
  if (function == kReadWrite) {
    write_first = request.u16be();
    write_count = request.u16be();
  }
  const unsigned most = function == kWrite ? kMostWritten : kMostWrittenWithRead;
  const unsigned bytes = request.u8();
  if (write_count == 0 || write_count > most || bytes != 2 * write_count || request.remaining() != bytes) {
    return kIllegalValue;
  }
  const std::uint8_t code = write(write_first, write_count, request, now);
  if (code != kGood) return code;
  if (function == kReadWrite) {
    if (count == 0 || count > kMostRead) return kIllegalValue;
    return read(first, count, true, answer);
  }
  answer.u16be(static_cast<Word>(first));
  answer.u16be(static_cast<Word>(count));
  return kGood;
}

std::optional<Word> RegisterGateway::registerAt(unsigned address, bool holding) const noexcept {
  const auto in = [address](unsigned start, std::size_t size) { return address >= start && address - start < size; };
  if (config_.running && address == config_.running->address) {
    return ring_.runs() ? config_.running->value : static_cast<Word>(config_.running->mask & ~config_.running->value);
  }
  if (pcp_ && pcp_->hasResult(address)) return turned(pcp_->resultAt(address));
  if (in(config_.input_address, ring_.inputs().size())) return turned(ring_.inputs()[address - config_.input_address]);
  if (!holding) return std::nullopt;
  if (in(config_.output_address, ring_.outputs().size())) {
    return turned(ring_.outputs()[address - config_.output_address]);
  }
  if (config_.watchdog && address == *config_.watchdog) return watchdog_;
  if (pcp_ && pcp_->hasInvoke(address)) return turned(pcp_->invokeAt(address));
  return std::nullopt;
}

std::uint8_t RegisterGateway::read(unsigned first, unsigned count, bool holding,
                                   ByteWriter<kLongestModbus>& answer) noexcept {
  ++reads_;
  answer.u8(static_cast<std::uint8_t>(2 * count));
  for (unsigned i = 0; i < count; ++i) {
    const auto word = registerAt(first + i, holding);
    if (!word) return kIllegalAddress;
    answer.u16be(*word);
  }
  return kGood;
}

std::uint8_t RegisterGateway::write(unsigned first, unsigned count, ByteReader& values, Instant now) noexcept {
  ++writes_;
  if (pcp_ && count > 0 && pcp_->hasInvoke(first) && pcp_->hasInvoke(first + count - 1)) {
    for (unsigned i = 0; i < count; ++i) pcp_->write(first + i, turned(values.u16be()));
    if (!values.ok()) return kIllegalValue;
    pcp_->invoked(now);
    return kGood;
  }
  if (config_.watchdog && count == 1 && first == *config_.watchdog) {
    watchdog_ = values.u16be();
    return values.ok() ? kGood : kIllegalValue;
  }
  std::vector<Word>& outputs = ring_.outputs();
  if (first < config_.output_address || first - config_.output_address + count > outputs.size()) return kIllegalAddress;
  for (unsigned i = 0; i < count; ++i) outputs[first - config_.output_address + i] = turned(values.u16be());
  last_write_ = now;
  return values.ok() ? kGood : kIllegalValue;
}

}  // namespace nord_driver::sim
