// The two blocks of registers by which a gateway offers Compact PCP, and what stands in them.
//
// No gateway's blocks are like another's, so each field has its place by configuration. What is written into the invoke
// block is carried out once; the result block shows what became of it until service 0 is written. Services and results
// are numbered as masters of generation 4 have them (ABB NIBA-01, chapter 6; SEW UFI11A, chapter 9).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "nord_driver/core/bytes.h"

namespace nord_driver::interbus {

/// The services Compact PCP has (BU 0070 6.3), and the one this driver uses for "no order".
enum class PcpService : std::uint16_t { kNone = 0, kRead = 0x0081, kWrite = 0x0082, kInitiate = 0x008B };

/// The object of parameter P000; P999 is 23E7h (BU 0070 5.1).
constexpr std::uint16_t kFirstParameterObject = 0x2000;

/// Blocks end before this word.
constexpr unsigned kMostBlockWords = 32;
constexpr std::size_t kMostPcpBytes = 4;
constexpr unsigned kDataWords = kMostPcpBytes / 2;

/// The place of each field: words from the block's start. Values are two words, the high one first.
struct PcpInvokeLayout {
  unsigned service = 0;
  unsigned reference = 1;
  unsigned index = 2;
  unsigned sub_index = 3;
  unsigned length = 4;  ///< of the data, in bytes
  unsigned data = 5;
};
struct PcpResultLayout {
  unsigned service = 0;  ///< that of the confirmation
  unsigned reference = 1;
  unsigned error = 2;  ///< class in the high byte, code in the low one; 0: done
  unsigned additional = 3;
  unsigned length = 4;
  unsigned data = 5;
};

struct PcpInvocation {
  PcpService service = PcpService::kNone;
  std::uint16_t reference = 2;  ///< communication reference
  std::uint16_t index = 0;
  std::uint8_t sub_index = 0;
  unsigned length = 0;  ///< 0, 2 or 4 bytes to write
  std::uint32_t value = 0;
};

struct PcpError {
  std::uint8_t error_class = 0;
  std::uint8_t code = 0;
  std::uint16_t additional = 0;
};

struct PcpResult {
  std::uint16_t service = 0;
  std::uint16_t reference = 0;
  PcpError error{};
  unsigned length = 0;
  std::uint32_t value = 0;  ///< of 1, 2 or 4 bytes

  bool good() const noexcept { return error.error_class == 0 && error.code == 0; }
};

using PcpBlock = std::array<Word, kMostBlockWords>;

/// How many words a block has.
unsigned blockWords(const PcpInvokeLayout& layout) noexcept;
unsigned blockWords(const PcpResultLayout& layout) noexcept;
/// Empty when every field lies in the block and none in another one; otherwise which, and what was expected.
std::string layoutFault(const PcpInvokeLayout& layout);
std::string layoutFault(const PcpResultLayout& layout);

PcpBlock toBlock(const PcpInvocation& invocation, const PcpInvokeLayout& layout) noexcept;
PcpResult fromBlock(const PcpBlock& block, const PcpResultLayout& layout) noexcept;

enum class PcpAnswer : std::uint8_t {
  kNotYet,   ///< nothing, or what belongs to something else
  kHere,     ///< confirms this service, well or with an error
  kAborted,  ///< the device, or the master, has ended the connection
};

/// What the result block says to an invocation. 018xh and 808xh are the same confirmation of two generations of masters.
PcpAnswer answerTo(const PcpInvocation& invocation, const PcpResult& result) noexcept;

}  // namespace nord_driver::interbus
