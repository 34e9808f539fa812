// One request of the master to one station, and the answer to it, as the data link layer (FDL) sees them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "nord_driver/core/bytes.h"
#include "profibus/function_code.h"
#include "profibus/telegram.h"

namespace nord_driver::profibus {

/// What is sent, and what a legal answer looks like. Anything else that arrives is counted and ignored.
struct FdlRequest {
  Frame frame;           ///< sent as it is, also when it is repeated
  bool answered = true;  ///< false: SDN, nobody answers
  std::uint8_t station = 0;
  std::optional<std::uint8_t> dsap, ssap;  ///< of the request; the answer carries them the other way round
  bool short_acknowledge_legal = false;    ///< SC completes the request
  bool acknowledge_legal = false;          ///< OK or NR without data completes the request
  bool data_legal = true;                  ///< DL or DH completes the request
  bool any_station_type = false;           ///< the station may be a master
  std::size_t min_data = 0, max_data = 0;  ///< length of such data
  std::uint8_t retries = 0;
};

struct FdlAnswer {
  enum class Kind : std::uint8_t {
    kAcknowledge,  ///< SC, OK or NR: taken, nothing to say
    kData,         ///< DL or DH, with data (or without, where none are expected)
    kRefusal       ///< RS, UE, RR, NR where data are due, RDL, RDH: see `code`
  };
  Kind kind = Kind::kAcknowledge;
  ResponseCode code = ResponseCode::kOk;
  StationType station_type = StationType::kSlave;
  ByteView data;  ///< valid during the call that hands it out
};

/// Why a telegram that arrived in the slot did not count as the answer.
enum class Mismatch : std::uint8_t {
  kNone,
  kStranger,     ///< from or to another station, or a request
  kAcknowledge,  ///< SC where data are due
  kAccessPoint,  ///< other service access points
  kLength,       ///< data of another length
  kFunction      ///< a function code that answers nothing
};

/// Judges a telegram against the request it should answer. `answer` is set when it fits (Mismatch::kNone).
Mismatch matchAnswer(const FdlRequest& request, std::uint8_t master, const Telegram& telegram,
                     FdlAnswer& answer) noexcept;

}  // namespace nord_driver::profibus
