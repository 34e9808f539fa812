// A CAN interface of the kernel (can0, vcan0): one CAN_RAW socket that takes only what concerns us.
#pragma once

#include <cstdint>
#include <string>

#include "link/can/can_health.h"
#include "link/can/can_link.h"
#include "link/can/can_settings.h"
#include "link/can/can_system.h"

namespace nord_driver::link {

/// The interface itself (bit rate, up, restart-ms) is set by the system's administrator; what does not fit is refused
/// in words. No allocation after construction.
///
/// Few frames are ever on their way: the send buffer is as small as the kernel allows (8 frames), so that a bus that
/// does not move is seen as kQueueFull at once and almost nothing old leaves when it moves again.
class SocketCan final : public CanLink {
 public:
  /// The most that is granted without privileges: 556 frames, 60 ms of a full bus at 1 Mbit/s.
  static constexpr int kReceiveBuffer = 212'992;
  static constexpr int kSmallestSendBuffer = 0;
  /// The controller is not asked more often to leave bus-off.
  static constexpr std::chrono::seconds kRestartPeriod{1};
  /// A full queue of the interface wakes nobody when it has room again: it is looked at again after this time.
  static constexpr std::chrono::microseconds kQueueRetry{500};

  /// `system` is kept by reference: Linux' own, or one a test made.
  explicit SocketCan(const CanSettings& settings, CanSystem& system = linuxCanSystem());
  ~SocketCan() override;
  SocketCan(const SocketCan&) = delete;
  SocketCan& operator=(const SocketCan&) = delete;

  bool open() noexcept override;
  void close() noexcept override;
  bool isOpen() const noexcept override { return descriptor_ >= 0; }
  CanSend send(const CanFrame& frame) noexcept override;
  bool receive(ReceivedCanFrame& received) noexcept override;
  bool waitReadable(Instant until) noexcept override;
  bool waitWritable(Instant until) noexcept override;
  void sleepUntil(Instant when) noexcept override { system_.sleepUntil(when); }
  Instant now() const noexcept override { return system_.now(); }
  CanState state() const noexcept override { return health_.state(); }
  CanCounters counters() const noexcept override;
  const std::string& lastError() const noexcept override { return error_; }
  const char* advice() const noexcept override { return isOpen() ? health_.advice() : ""; }

 private:
  bool fail(const char* what, int error = 0) noexcept;
  bool setUp(int index) noexcept;
  bool accept(const CanInterface& interface) noexcept;
  void failedCall(const char* what, int error) noexcept;
  void wentDown() noexcept;
  bool takeNext(ReceivedCanFrame& received) noexcept;
  Instant arrival(const CanReceipt& receipt) const noexcept;
  void takeInterfaceMessages() noexcept;
  void tendBusOff() noexcept;
  void readDropCount() const noexcept;

  CanSettings settings_;
  CanSystem& system_;
  Sentence problem_;  // with the settings
  std::string error_;
  int descriptor_ = -1;
  int interface_messages_ = -1;
  bool has_pending_ = false;
  bool queue_full_ = false;  // the interface's, which wakes nobody
  ReceivedCanFrame pending_;
  Instant empty_at_{};  // nothing was there: what comes later was received later
  Instant next_restart_{};
  mutable CanHealth health_;  // dropped frames are asked of the kernel when somebody wants to know
  mutable std::uint32_t drop_count_ = 0;
};

}  // namespace nord_driver::link
