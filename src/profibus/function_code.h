// The function code (FC) of a telegram: EN 50170-4, "function code".
#pragma once

#include <cstdint>

namespace nord_driver::profibus {

/// Requests have bit 6 set; bit 5 is FCB and bit 4 is FCV, added by FrameCount.
constexpr std::uint8_t kRequestBit = 0x40;
constexpr std::uint8_t kSendNoAcknowledgeHigh = 0x46;  ///< SDN high
constexpr std::uint8_t kRequestFdlStatus = 0x49;       ///< request FDL status; FCB = FCV = 0
/// SRD low, before FCB and FCV: acyclic requests. That these go at low priority is inferred, no source says so; answers
/// of both priorities are taken.
constexpr std::uint8_t kSendRequestDataLow = 0x4C;
constexpr std::uint8_t kSendRequestDataHigh = 0x4D;  ///< SRD high, before FCB and FCV

/// Responses: bits 0-3.
enum class ResponseCode : std::uint8_t {
  kOk = 0x0,                 ///< OK: positive acknowledge
  kUserError = 0x1,          ///< UE
  kNoResource = 0x2,         ///< RR
  kNotActivated = 0x3,       ///< RS: the service access point is not active
  kDataLow = 0x8,            ///< DL
  kNoData = 0x9,             ///< NR: no response data, but sent data taken
  kDataHigh = 0xA,           ///< DH: in data exchange, a diagnosis is waiting
  kDataLowNoResource = 0xC,  ///< RDL: response data, but sent data not taken
  kDataHighNoResource = 0xD  ///< RDH: likewise
};

/// Responses: bits 4-5.
enum class StationType : std::uint8_t { kSlave = 0, kMasterNotReady = 1, kMasterReady = 2, kMasterInRing = 3 };

constexpr bool isRequest(std::uint8_t fc) noexcept {
  return (fc & kRequestBit) != 0;
}
constexpr ResponseCode responseCode(std::uint8_t fc) noexcept {
  return static_cast<ResponseCode>(fc & 0x0Fu);
}
constexpr StationType stationType(std::uint8_t fc) noexcept {
  return static_cast<StationType>(fc >> 4 & 0x03u);
}

}  // namespace nord_driver::profibus
