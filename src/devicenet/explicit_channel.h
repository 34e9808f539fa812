// The explicit messages with one device, shared by the engine (allocation, checks, keep-alive) and the requests of the
// layer above, which wait in a queue. They take turns, so that neither can starve the other.
#pragma once

#include <cstdint>
#include <optional>

#include "core/can_frame.h"
#include "core/request_queue.h"
#include "devicenet/explicit_client.h"
#include "devicenet/explicit_message.h"
#include "nord_driver/core/time.h"

namespace nord_driver::devicenet {

/// Most requests of the layer above that wait, run or are answered and not fetched, per device.
constexpr std::size_t kRequestQueueLength = 8;

class ExplicitChannel {
 public:
  /// `timeout`: for an answer to a request of the layer above, each of two times.
  ExplicitChannel(std::uint8_t own_mac, std::uint8_t device_mac, Duration timeout) noexcept
      : client_(own_mac, device_mac), timeout_(timeout) {}

  /// Of the explicit connection, as the device chose when it was allocated.
  void setFormat(BodyFormat format) noexcept { format_ = format; }
  /// The device had no explicit connection with us, and was allocated one.
  void handleNewConnection(Instant now) noexcept;
  /// Whether requests of the layer above are taken. Otherwise each is answered kNotConnected: while a device is being
  /// connected they would hold it up.
  void open() noexcept { open_ = true; }
  void close() noexcept;
  bool isOpen() const noexcept { return open_; }

  /// False when kRequestQueueLength are under way. Otherwise exactly one answer follows.
  bool submit(const ExplicitRequest& request, Instant now) noexcept;
  std::optional<ExplicitAnswer> pollAnswer() noexcept { return users_.pollResult(); }

  /// The engine's own request; one at a time, a new one takes the place of the old.
  void ask(const ExplicitRequest& request, ExplicitPort port, Duration timeout, Instant now) noexcept;
  std::optional<ExplicitAnswer> takeOwnAnswer() noexcept;
  /// Ends the engine's request without an answer.
  void cancelOwn() noexcept;
  /// Closed, and nothing that is left is sent.
  void silence() noexcept;

  Heard handle(const CanFrame& frame, Instant now) noexcept;
  void poll(Instant now) noexcept;
  bool pollTransmit(CanFrame& frame, Instant now) noexcept { return client_.pollTransmit(frame, now); }
  void notSent(const CanFrame& frame) noexcept { client_.notSent(frame); }
  std::optional<Instant> nextDeadline() const noexcept;
  std::uint64_t repeated() const noexcept { return client_.repeated(); }
  /// Last time the device answered on the explicit connection: what keeps it alive.
  Instant usedAt() const noexcept { return used_at_; }

 private:
  enum class Owner : std::uint8_t { kNobody, kEngine, kUser };
  struct Own {
    ExplicitRequest request;
    ExplicitPort port = ExplicitPort::kConnected;
    Duration timeout{};
  };

  void takeAnswer(Instant now) noexcept;
  void startNext(Instant now) noexcept;
  void startOwn(Instant now) noexcept;
  void startUser(Instant now) noexcept;
  void endUser(ExplicitEnd end) noexcept;
  void cancel() noexcept;

  ExplicitClient client_;
  Duration timeout_;
  BodyFormat format_ = BodyFormat::k8Over8;
  bool open_ = false;
  Owner owner_ = Owner::kNobody;  // of what the client does
  Owner last_ = Owner::kUser;     // whose turn it was
  std::optional<Own> own_;
  std::optional<ExplicitAnswer> own_answer_;
  RequestQueue<ExplicitRequest, ExplicitAnswer, kRequestQueueLength> users_;
  Instant used_at_{};
};

}  // namespace nord_driver::devicenet
