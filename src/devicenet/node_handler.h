// One device of the bus: how it is connected, its process data, its explicit messages and what it says unasked, put
// together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/can_frame.h"
#include "devicenet/explicit_channel.h"
#include "devicenet/io_connection.h"
#include "devicenet/node_connect.h"
#include "devicenet/node_report.h"
#include "devicenet/scanner_config.h"
#include "nord_driver/core/time.h"

namespace nord_driver::devicenet {

/// Never moves: its parts refer to each other.
class NodeHandler {
 public:
  /// `bus` is complete, see `completed()`; it and the other references live longer than this.
  NodeHandler(std::size_t index, const ScannerConfig& bus, Counters& counters, DevicenetEvents& events) noexcept;
  NodeHandler(const NodeHandler&) = delete;
  NodeHandler& operator=(const NodeHandler&) = delete;

  void start(Instant now) noexcept;
  void stop(const Sentence& why, Instant now) noexcept;
  void release(Instant now) noexcept;
  bool released() const noexcept { return connect_.released(); }
  bool isLeftAlone() const noexcept { return connect_.awaitsOwnTimeOut(); }

  /// Group 1 messages Dh, Eh, Fh.
  void handleIo(std::uint8_t message, const CanFrame& frame, Instant now) noexcept;
  /// Group 2 message 3.
  void handleExplicit(const CanFrame& frame, Instant now) noexcept;
  /// Group 2 message 7 with its MAC id.
  void handleDuplicateMac(const DuplicateMacMessage& message, Instant now) noexcept;
  /// A frame on an identifier on which only its master sends.
  void handleForeignRequest(const CanFrame& frame, Group2 message, Instant now) noexcept;
  void poll(Instant now) noexcept;
  std::optional<Instant> nextDeadline() const noexcept;

  IoConnection& io() noexcept { return io_; }
  const IoConnection& io() const noexcept { return io_; }
  ExplicitChannel& channel() noexcept { return channel_; }
  bool submit(const ExplicitRequest& request, Instant now) noexcept;
  NodeReport& report() noexcept { return report_; }
  const NodeStatus& status() const noexcept { return report_.status(); }
  std::uint8_t mac() const noexcept { return config_.mac; }

 private:
  void handleDeviceMessage(const CanFrame& frame, Instant now) noexcept;
  void handleSilence(Instant now) noexcept;
  /// The connecting goes on with what came; the process data follow it.
  void settle(Instant now) noexcept;

  const NodeConfig& config_;
  NodeReport report_;
  ExplicitChannel channel_;
  IoConnection io_;
  NodeConnect connect_;
};

}  // namespace nord_driver::devicenet
