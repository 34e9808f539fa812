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
  request.read = {choices.byte(), static_cast<std::uint16_t>(1 + choices.below(kMostReadRegisters))};
  request.write = {choices.byte(), static_cast<std::uint16_t>(1 + choices.below(kMostReadWriteWrites))};
  request.values = values;
  return request;
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
  // Half of the answers begin with the header of a good one.
  if (choices.below(2) == 0) {
    const ModbusAdu sent = toBytes(request);
    for (const std::uint8_t byte : ByteView{sent}.sub(0, kHeader)) bytes.push_back(byte);
    bytes[5] = choices.byte();
  }
  for (const std::uint8_t byte : choices.bytes(256)) bytes.push_back(byte);
  check(request, ByteView{bytes});
  const ModbusAdu taken = read(bytes);
  check(request, ByteView{taken});
  return 0;
}
