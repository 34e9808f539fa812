// One SDO server of a node, shared by the start-up of the node and the accesses of the layer above. They take turns, so
// that neither can starve the other.
#pragma once

#include <cstdint>
#include <optional>

#include "canopen/sdo_client.h"
#include "canopen/sdo_request.h"
#include "core/can_frame.h"
#include "nord_driver/core/time.h"

namespace nord_driver::canopen {

enum class SdoOwner : std::uint8_t { kNobody, kBoot, kUser };

class SdoPort {
 public:
  SdoPort(SdoChannel channel, Duration timeout) noexcept : client_(channel, timeout) {}

  /// Queues an access. False while this owner has one queued, under way, or an answer not fetched.
  bool submit(SdoOwner owner, const SdoRequest& request, Instant now) noexcept;
  /// The answer; its data is valid until the next call that is not const. An answer not fetched keeps the others
  /// waiting.
  std::optional<SdoAnswer> take(SdoOwner owner) noexcept;
  /// Ends this owner's access without an answer.
  void cancel(SdoOwner owner, Instant now) noexcept;

  void handle(const CanFrame& frame, Instant now) noexcept;
  void poll(Instant now) noexcept;
  bool pollTransmit(CanFrame& frame) noexcept;
  /// The frame given out last was not sent: it comes again.
  void putBack(const CanFrame& frame) noexcept { put_back_ = frame; }
  std::optional<Instant> nextDeadline() const noexcept;
  const SdoCounters& counters() const noexcept { return client_.counters(); }

 private:
  std::optional<SdoRequest>& waiting(SdoOwner owner) noexcept { return owner == SdoOwner::kBoot ? boot_ : user_; }
  void startNext(Instant now) noexcept;
  bool start(SdoOwner owner, Instant now) noexcept;

  SdoClient client_;
  SdoOwner owner_ = SdoOwner::kNobody;  // of what the client does
  SdoOwner last_ = SdoOwner::kUser;     // whose turn it was
  std::optional<SdoRequest> boot_, user_;
  std::optional<CanFrame> put_back_;
};

}  // namespace nord_driver::canopen
