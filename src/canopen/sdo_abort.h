// The codes with which an SDO transfer is aborted (CiA 301 table 22), and their texts.
#pragma once

#include <cstdint>
#include <string>

namespace nord_driver::canopen {

namespace sdo_abort {
constexpr std::uint32_t kToggleBit = 0x05030000;
constexpr std::uint32_t kTimedOut = 0x05040000;
constexpr std::uint32_t kCommand = 0x05040001;
constexpr std::uint32_t kBlockSize = 0x05040002;
constexpr std::uint32_t kSequenceNumber = 0x05040003;
constexpr std::uint32_t kCrc = 0x05040004;
constexpr std::uint32_t kMemory = 0x05040005;
constexpr std::uint32_t kUnsupportedAccess = 0x06010000;
constexpr std::uint32_t kWriteOnly = 0x06010001;
constexpr std::uint32_t kReadOnly = 0x06010002;
constexpr std::uint32_t kNoObject = 0x06020000;
constexpr std::uint32_t kLength = 0x06070010;
constexpr std::uint32_t kTooLong = 0x06070012;
constexpr std::uint32_t kTooShort = 0x06070013;
constexpr std::uint32_t kNoSubIndex = 0x06090011;
constexpr std::uint32_t kValueRange = 0x06090030;
constexpr std::uint32_t kGeneral = 0x08000000;
}  // namespace sdo_abort

/// What the code means, without a full stop; null for a code CiA 301 does not know.
const char* abortMeaning(std::uint32_t code) noexcept;

/// "0609 0011h (the sub-index does not exist)"; an unknown code as its number alone.
std::string abortText(std::uint32_t code);

}  // namespace nord_driver::canopen
