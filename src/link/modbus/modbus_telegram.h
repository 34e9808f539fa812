// A request to a Modbus/TCP server as bytes, and whether what came back answers it.
//
// libmodbus (3.1.6) could do both. But it takes the answer of another unit, or one with another length than its header
// says, for a good one, and calls every other deviation "Invalid data"; and its function for requests of one's own
// gives all of them transaction 0. A technician needs to know which of them it was, and no drive may run on an answer
// to another question. So requests are made and answers are judged here, byte by byte (MODBUS Messaging on TCP/IP V1.0b
// 3.1.3; MODBUS Application Protocol V1.1b3, chapters 6 and 7).
#pragma once

#include <cstdint>

#include "core/register_image.h"
#include "link/modbus/modbus_settings.h"
#include "nord_driver/core/bytes.h"
#include "nord_driver/core/fixed_text.h"

namespace nord_driver::link {

/// Header (7 bytes) and at most 253 bytes.
constexpr std::size_t kLongestAdu = 260;
using ModbusAdu = FixedBytes<kLongestAdu>;

struct ModbusRequest {
  ModbusFunction function = ModbusFunction::kReadHoldingRegisters;
  std::uint8_t unit = 1;
  std::uint16_t transaction = 0;
  WordRange read{};              ///< registers (3, 4, 23)
  WordRange write{};             ///< registers (16, 23)
  const Word* values = nullptr;  ///< write.count of them
};

/// The bytes of a request. The ranges must be within what one request carries.
ModbusAdu toBytes(const ModbusRequest& request) noexcept;

enum class AnswerFault : std::uint8_t {
  kNone,
  kTooShort,     ///< not even a header and a function
  kProtocol,     ///< no Modbus at all
  kLength,       ///< not as long as its header says
  kTransaction,  ///< answers another request: a late or a doubled one
  kUnit,
  kFunction,
  kException,  ///< refused by the server
  kCount,      ///< not as many registers as asked for
  kEcho,       ///< confirms other registers than were written
};

struct AnswerVerdict {
  AnswerFault fault = AnswerFault::kNone;
  unsigned found = 0;
  unsigned expected = 0;

  bool good() const noexcept { return fault == AnswerFault::kNone; }
};

/// Judges a whole answer; only kNone lets its registers be used.
AnswerVerdict judge(const ModbusRequest& request, ByteView answer) noexcept;

/// Register `i` of the read.count of a good answer to a reading request.
Word answerRegister(ByteView answer, std::size_t i) noexcept;

/// "Server device busy": the request was not carried out, "the client should retransmit the message later" (chapter 7).
constexpr unsigned kServerBusy = 6;

/// What an exception code means, and what to look at (chapter 7).
const char* exceptionMeaning(unsigned code) noexcept;

/// "function 4 (read registers 0 to 3)".
Sentence describe(const ModbusRequest& request) noexcept;
/// One sentence, without a full stop, that begins behind the server's name: "answers with ...".
Sentence describe(const ModbusRequest& request, const AnswerVerdict& verdict) noexcept;

}  // namespace nord_driver::link
