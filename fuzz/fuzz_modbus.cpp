// A Modbus/TCP server that answers anything: libmodbus reads it without writing beyond the buffer, and only an answer
// that fits the request in every field is good.
#include <modbus/modbus.h>
#include <sys/socket.h>
#include <unistd.h>

#include "fuzz.h"
#include "link/modbus/modbus_telegram.h"

namespace {

using namespace nord_driver;
using namespace nord_driver::link;

constexpr std::size_t kHeader = 8;  // with the function

ModbusRequest asked(fuzz::Choices& choices, const Word* values) {
  constexpr ModbusFunction kFunctions[] = {ModbusFunction::kReadHoldingRegisters, ModbusFunction::kReadInputRegisters,
                                           ModbusFunction::kWriteRegisters, ModbusFunction::kReadWriteRegisters};
  ModbusRequest request;
  request.function = kFunctions[choices.below(4)];
  request.unit = choices.byte();
  request.transaction = choices.byte();
  request.read = {choices.byte(), static_cast<std::uint16_t>(1 + choices.below(kMostReadRegisters - 2))};
  request.write = {choices.byte(), static_cast<std::uint16_t>(1 + choices.below(kMostReadWriteWrites))};
  request.values = values;
  return request;
}

/// The first `most` bytes of the answer a server gives whose registers are all 0.
FixedBytes<256> good(const ModbusRequest& request, std::size_t most) {
  const ModbusAdu sent = toBytes(request);
  FixedBytes<256> bytes;
  for (const std::uint8_t byte : ByteView{sent}.sub(0, kHeader)) bytes.push_back(byte);
  if (request.function == ModbusFunction::kWriteRegisters) {
    for (const std::uint8_t byte : ByteView{sent}.sub(kHeader, 4)) bytes.push_back(byte);
  } else {
    bytes.push_back(static_cast<std::uint8_t>(2 * request.read.count));
    bytes.resize(bytes.size() + 2u * request.read.count);
  }
  bytes[4] = 0;
  bytes[5] = static_cast<std::uint8_t>(bytes.size() - 6);
  if (bytes.size() > most) bytes.resize(most);
  return bytes;
}

/// The answer as libmodbus takes it from a socket; empty when it refuses.
ModbusAdu read(const FixedBytes<256>& bytes) {
  int ends[2];
  fuzz::require(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends) == 0);
  fuzz::require(::send(ends[1], bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size()));
  ::shutdown(ends[1], SHUT_WR);
  static modbus_t* const kContext = ::modbus_new_tcp(nullptr, 502);
  ::modbus_set_socket(kContext, ends[0]);
  ModbusAdu answer;
  answer.resize(kLongestAdu);
  const int size = ::modbus_receive_confirmation(kContext, answer.data());
  fuzz::require(size <= static_cast<int>(kLongestAdu));
  answer.resize(size < 0 ? 0 : static_cast<std::size_t>(size));
  ::close(ends[0]);
  ::close(ends[1]);
  return answer;
}

void check(const ModbusRequest& request, ByteView answer) {
  const AnswerVerdict verdict = judge(request, answer);
  if (!verdict.good()) {
    fuzz::require(!describe(request, verdict).empty());
    return;
  }
  const ModbusAdu sent = toBytes(request);
  fuzz::require(answer.size() > kHeader && answer[0] == sent[0] && answer[1] == sent[1]);
  fuzz::require(answer[6] == request.unit && answer[7] == sent[7]);
  fuzz::require(answer.size() == 6u + (answer[4] << 8 | answer[5]));
  if (request.function == ModbusFunction::kWriteRegisters) return;
  for (std::size_t i = 0; i < request.read.count; ++i) answerRegister(answer, i);
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Word values[kMostReadWriteWrites] = {};
  fuzz::Choices choices{data, size};
  const ModbusRequest request = asked(choices, values);
  FixedBytes<256> bytes;
  const std::uint8_t kind = choices.below(3);
  if (kind > 0) bytes = good(request, kind == 1 ? kHeader : 256);
  // A few bytes of a good answer are changed; behind its header alone follows anything, as it does behind nothing.
  unsigned changed = 0;
  for (; kind == 2 && changed < 3 && !choices.empty(); ++changed) {
    std::uint8_t& byte = bytes[choices.byte() % bytes.size()];
    byte = static_cast<std::uint8_t>(byte + 1 + choices.below(255));
  }
  if (kind < 2) {
    for (const std::uint8_t byte : choices.bytes(256)) bytes.push_back(byte);
  }
  fuzz::require(kind < 2 || changed > 0 || judge(request, ByteView{bytes}).good());
  check(request, ByteView{bytes});
  const ModbusAdu taken = read(bytes);
  check(request, ByteView{taken});
  return 0;
}
