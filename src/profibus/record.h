// A data record of DP-V1, class 1 (MS1) or class 2 (MS2): what is asked, what comes back, and its bytes.
#pragma once

#include <cstddef>
#include <cstdint>

#include "nord_driver/core/bytes.h"
#include "nord_driver/core/fixed_text.h"

namespace nord_driver::profibus {

/// Longest data of one record (EN 50170-8 and its extension DP-V1).
constexpr std::size_t kMaxRecordLength = 240;

/// NORD: slot 0, index 100 for the bus module and 101 to 104 for its inverters, eight bytes laid out like a PKW
/// (BU 0220 4.2.1, 8.3.4.4; BU 2700 6.5 numbers slots instead: both are only numbers here).
struct RecordRequest {
  std::uint8_t slot = 0;   ///< 0..254
  std::uint8_t index = 0;  ///< 0..254; 255 calls I&M
  bool write = false;
  std::uint8_t length = 0;              ///< read: the longest answer wanted, 1..240
  FixedBytes<kMaxRecordLength> data{};  ///< write: 1..240 bytes
};

enum class RecordOutcome : std::uint8_t {
  kDone,
  kRefused,       ///< a negative response: see `error`
  kTimedOut,      ///< no response in time, or busy all the time; RS to a write that had been taken
  kNoAnswer,      ///< the access point did not answer at all, retries included
  kNotSupported,  ///< the slave is configured without DP-V1
  kNotActivated,  ///< the slave answered RS: its access point is not active, and nothing was written
  kOffline        ///< the slave is not in data exchange, or left it
};

/// The three bytes behind the function number of a negative response.
struct RecordError {
  std::uint8_t decode = 0;  ///< 80h: DP-V1, the codes below are the standard's
  std::uint8_t code1 = 0;   ///< class in the high nibble, reason in the low one
  std::uint8_t code2 = 0;   ///< of the device

  bool isOfDpv1() const noexcept { return decode == 0x80; }
  /// State conflict, or its means are in use: ask again.
  bool isBusy() const noexcept { return isOfDpv1() && (code1 == 0xB5 || code1 == 0xC2); }
};

/// What the codes mean, as a clause.
const char* meaningOf(const RecordError& error) noexcept;

struct RecordResult {
  std::size_t slave = 0;  ///< index as configured
  std::uint8_t slot = 0;
  std::uint8_t index = 0;
  bool write = false;
  RecordOutcome outcome = RecordOutcome::kDone;
  RecordError error;                    ///< kRefused; kTimedOut when busy to the end
  FixedBytes<kMaxRecordLength> data{};  ///< kDone of a read
};

using RecordPdu = FixedBytes<kMaxRecordLength + 4>;

/// Read.req and Write.req. False (and `pdu` is empty) when a number or a length is out of range.
bool encodeRecord(const RecordRequest& request, RecordPdu& pdu) noexcept;

/// What a response PDU says about a request.
enum class RecordAnswer : std::uint8_t {
  kPositive,
  kNegative,
  kOther  ///< the answer to something else, or none at all
};

/// `result` gets data or error. A positive response repeats slot and index of its request, a negative one does not.
RecordAnswer parseRecordAnswer(ByteView pdu, const RecordRequest& request, RecordResult& result) noexcept;

}  // namespace nord_driver::profibus
