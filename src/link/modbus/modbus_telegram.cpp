#include "link/modbus/modbus_telegram.h"

namespace nord_driver::link {

namespace {

constexpr std::size_t kHeader = 6;  // transaction, protocol, length: what the length does not count
constexpr std::size_t kUnitAt = 6;
constexpr std::size_t kFunctionAt = 7;
constexpr std::size_t kDataAt = 8;
constexpr std::uint8_t kExceptionBit = 0x80;

bool reads(ModbusFunction function) noexcept {
  return function != ModbusFunction::kWriteRegisters;
}
bool writes(ModbusFunction function) noexcept {
  return function == ModbusFunction::kWriteRegisters || function == ModbusFunction::kReadWriteRegisters;
}

unsigned u16(ByteView bytes, std::size_t at) noexcept {
  return static_cast<unsigned>(bytes[at]) << 8 | bytes[at + 1];
}

AnswerVerdict wrong(AnswerFault fault, unsigned found, unsigned expected) noexcept {
  return {fault, found, expected};
}

AnswerVerdict judgeBody(const ModbusRequest& request, ByteView answer) noexcept {
  const auto length = static_cast<unsigned>(answer.size());
  if (!reads(request.function)) {
    const unsigned expected = kDataAt + 4;
    if (length != expected) return wrong(AnswerFault::kLength, length, expected);
    if (u16(answer, kDataAt) != request.write.first) {
      return wrong(AnswerFault::kEcho, u16(answer, kDataAt), request.write.first);
    }
    if (u16(answer, kDataAt + 2) != request.write.count) {
      return wrong(AnswerFault::kCount, u16(answer, kDataAt + 2), request.write.count);
    }
    return {};
  }
  const unsigned bytes = 2u * request.read.count;
  if (length < kDataAt + 1) return wrong(AnswerFault::kTooShort, length, static_cast<unsigned>(kDataAt) + 1 + bytes);
  if (answer[kDataAt] != bytes) return wrong(AnswerFault::kCount, answer[kDataAt] / 2u, request.read.count);
  const unsigned expected = static_cast<unsigned>(kDataAt) + 1 + bytes;
  if (length != expected) return wrong(AnswerFault::kLength, length, expected);
  return {};
}

}  // namespace

ModbusAdu toBytes(const ModbusRequest& request) noexcept {
  ModbusAdu bytes;
  ByteWriter writer{bytes};
  writer.u16be(request.transaction);
  writer.u16be(0);  // protocol: Modbus
  writer.u16be(0);  // length: below
  writer.u8(request.unit);
  writer.u8(static_cast<std::uint8_t>(request.function));
  if (reads(request.function)) {
    writer.u16be(request.read.first);
    writer.u16be(request.read.count);
  }
  if (writes(request.function)) {
    writer.u16be(request.write.first);
    writer.u16be(request.write.count);
    writer.u8(static_cast<std::uint8_t>(2 * request.write.count));
    for (std::uint16_t i = 0; i < request.write.count; ++i) writer.u16be(request.values[i]);
  }
  const std::size_t length = bytes.size() - kHeader;
  bytes[4] = static_cast<std::uint8_t>(length >> 8);
  bytes[5] = static_cast<std::uint8_t>(length & 0xFFu);
  return bytes;
}

AnswerVerdict judge(const ModbusRequest& request, ByteView answer) noexcept {
  const auto length = static_cast<unsigned>(answer.size());
  if (length < kDataAt) return wrong(AnswerFault::kTooShort, length, kDataAt + 1);
  if (u16(answer, 2) != 0) return wrong(AnswerFault::kProtocol, u16(answer, 2), 0);
  if (u16(answer, 0) != request.transaction) {
    return wrong(AnswerFault::kTransaction, u16(answer, 0), request.transaction);
  }
  if (u16(answer, 4) + kHeader != length) {
    return wrong(AnswerFault::kLength, length, u16(answer, 4) + static_cast<unsigned>(kHeader));
  }
  if (answer[kUnitAt] != request.unit) return wrong(AnswerFault::kUnit, answer[kUnitAt], request.unit);
  const auto function = static_cast<std::uint8_t>(request.function);
  if (answer[kFunctionAt] == (function | kExceptionBit) && length == kDataAt + 1) {
    return wrong(AnswerFault::kException, answer[kDataAt], 0);
  }
  if (answer[kFunctionAt] != function) return wrong(AnswerFault::kFunction, answer[kFunctionAt], function);
  return judgeBody(request, answer);
}

Word answerRegister(ByteView answer, std::size_t i) noexcept {
  return static_cast<Word>(u16(answer, kDataAt + 1 + 2 * i));
}

const char* exceptionMeaning(unsigned code) noexcept {
  switch (code) {
    case 1:
      return "illegal function: it does not know this function, choose another one";
    case 2:
      return "illegal data address: it has no such registers, look at address and length of the image";
    case 3:
      return "illegal data value: it takes fewer registers in one request";
    case 4:
      return "server device failure: look at the gateway's own display";
    case 5:
      return "acknowledge: it needs long for this";
    case 6:
      return "server device busy";
    case 8:
      return "memory parity error";
    case 10:
      return "gateway path unavailable: it is set up wrongly or overloaded";
    case 11:
      return "gateway target device failed to respond: nobody behind it has this unit number";
    default:
      return "a code the Modbus specification does not know";
  }
}

Sentence describe(const ModbusRequest& request) noexcept {
  Sentence text;
  const auto function = static_cast<unsigned>(request.function);
  const unsigned read = request.read.first, read_end = request.read.end();
  const unsigned write = request.write.first, write_end = request.write.end();
  if (!writes(request.function)) {
    text.format("function %u (read registers %u to %u)", function, read, read_end - 1);
  } else if (!reads(request.function)) {
    text.format("function %u (write registers %u to %u)", function, write, write_end - 1);
  } else {
    text.format("function %u (write registers %u to %u, read %u to %u)", function, write, write_end - 1, read,
                read_end - 1);
  }
  return text;
}

Sentence describe(const ModbusRequest& request, const AnswerVerdict& verdict) noexcept {
  Sentence text;
  const Sentence asked = describe(request);
  const unsigned found = verdict.found, expected = verdict.expected;
  switch (verdict.fault) {
    case AnswerFault::kNone:
      break;
    case AnswerFault::kTooShort:
      text.format("answers %s with %u bytes, expected at least %u", asked.c_str(), found, expected);
      break;
    case AnswerFault::kProtocol:
      text.format("answers with protocol %u, expected 0: this is no Modbus/TCP server", found);
      break;
    case AnswerFault::kLength:
      text.format("answers %s with %u bytes, expected %u", asked.c_str(), found, expected);
      break;
    case AnswerFault::kTransaction:
      text.format("answers transaction %u, expected %u: an answer to another request", found, expected);
      break;
    case AnswerFault::kUnit:
      text.format("answers as unit %u, expected %u", found, expected);
      break;
    case AnswerFault::kFunction:
      text.format("answers %s with function %u", asked.c_str(), found);
      break;
    case AnswerFault::kException:
      text.format("refuses %s with exception %u, %s", asked.c_str(), found, exceptionMeaning(found));
      break;
    case AnswerFault::kCount:
      text.format("answers %s with %u registers, expected %u", asked.c_str(), found, expected);
      break;
    case AnswerFault::kEcho:
      text.format("answers %s for register %u on, expected %u", asked.c_str(), found, expected);
      break;
  }
  return text;
}

}  // namespace nord_driver::link
