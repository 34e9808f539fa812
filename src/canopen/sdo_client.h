// The client of one SDO server: one transfer at a time, expedited, segmented or in blocks (CiA 301 7.2.4).
//
// Deterministic: frames and the time go in, frames and answers come out. Nothing is allocated after construction.
// What the protocol cannot know: an answer carries no number, so that one that comes after its time-out is taken for
// the answer to a repetition of the same access to the same object. Every other late answer is told apart by its
// object, its toggle bit or its sequence number, and counted as stale.
#pragma once

#include <cstdint>
#include <optional>

#include "canopen/sdo_block_download.h"
#include "canopen/sdo_block_upload.h"
#include "canopen/sdo_request.h"
#include "canopen/sdo_segments.h"
#include "canopen/sdo_transfer.h"
#include "core/can_frame.h"
#include "nord_driver/core/time.h"

namespace nord_driver::canopen {

/// Since construction.
struct SdoCounters {
  std::uint64_t done = 0;
  std::uint64_t aborted_by_server = 0;
  std::uint64_t aborted_by_us = 0;  ///< the server broke a rule
  std::uint64_t timed_out = 0;
  std::uint64_t stale = 0;      ///< answers nobody waited for: late, repeated, or to another client
  std::uint64_t malformed = 0;  ///< frames of the server that are not eight bytes long
};

/// `start()`, then in turns: send what `pollTransmit()` gives, `handle()` what the server sends, `poll()` at
/// `nextDeadline()`; until `takeAnswer()` has something.
class SdoClient {
 public:
  /// `timeout`: for each answer of the server, not for the whole transfer.
  SdoClient(SdoChannel channel, Duration timeout) noexcept : channel_(channel), timeout_(timeout) {}

  /// False when busy, or when it is a write of no bytes. Otherwise exactly one answer follows, unless cancelled.
  bool start(const SdoRequest& request, Instant now) noexcept;
  /// A write of `data` instead of `request.data`; copied. False too when it is longer than `kSdoCapacity`.
  bool start(const SdoRequest& request, ByteView data, Instant now) noexcept;
  /// From `start()` until the answer was taken.
  bool busy() const noexcept { return active() || answer_.has_value(); }

  /// Any frame: those of other identifiers are ignored.
  void handle(const CanFrame& frame, Instant now) noexcept;
  /// Ends what is over its time.
  void poll(Instant now) noexcept;
  /// The next frame to send. It is given out once: the caller keeps it until the link took it.
  bool pollTransmit(CanFrame& frame) noexcept;
  std::optional<SdoAnswer> takeAnswer() noexcept;
  std::optional<Instant> nextDeadline() const noexcept {
    return active() ? std::optional<Instant>{deadline_} : std::nullopt;
  }

  /// Ends the transfer without an answer (an answer not yet taken is dropped) and tells the server, if it knows of it.
  void cancel() noexcept;

  const SdoCounters& counters() const noexcept { return counters_; }

 private:
  enum class Phase : std::uint8_t {
    kIdle,
    kToAsk,  ///< the initiation has not been given out
    kAsked,
    kSegmentedUpload,
    kSegmentedDownload,
    kBlockUpload,
    kBlockDownload
  };

  bool active() const noexcept { return phase_ != Phase::kIdle; }
  bool awaitsAnswer() const noexcept { return active() && phase_ != Phase::kToAsk; }
  void arm(Instant now) noexcept;
  bool pollRequest(SdoBytes& bytes) noexcept;
  SdoStep handleResponse(const SdoBytes& response) noexcept;
  SdoStep handleInitiated(const SdoBytes& response) noexcept;
  SdoStep beginUpload(const SdoBytes& response) noexcept;
  SdoStep beginDownload(const SdoBytes& response) noexcept;
  void handleAbort(const SdoBytes& response, Instant now) noexcept;
  void apply(SdoStep step, Instant now) noexcept;
  bool goesOnWithoutAnswer() noexcept;
  void abort(SdoEnd end, std::uint32_t code) noexcept;
  void finish(SdoEnd end, std::uint32_t code) noexcept;

  SdoChannel channel_;
  Duration timeout_;
  SdoRequest request_;
  SdoBuffer buffer_;
  Phase phase_ = Phase::kIdle;
  // What goes on in the phase of that name.
  SegmentedUpload segmented_upload_{std::nullopt};
  SegmentedDownload segmented_download_;
  BlockUpload block_upload_{std::nullopt, false};
  BlockDownload block_download_{1, false};
  bool size_told_ = true;
  bool known_to_server_ = false;   // a frame of this transfer was given out
  std::size_t segments_seen_ = 0;  // of a block download, sent when its deadline was set
  Instant deadline_;
  std::optional<SdoBytes> closing_frame_;  // the last frame of a transfer that is over here: nobody answers it
  std::optional<SdoAnswer> answer_;
  SdoCounters counters_;
};

}  // namespace nord_driver::canopen
