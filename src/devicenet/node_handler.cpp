#include "devicenet/node_handler.h"

#include "devicenet/device_message.h"

namespace nord_driver::devicenet {
namespace {

bool answersBy(std::uint8_t code, const CanFrame& response) noexcept {
  const bool whole = response.size > 1 && (response.data[0] & explicit_header::kFragmented) == 0;
  return whole && response.data[1] == (code | service::kResponse);
}

}  // namespace

NodeHandler::NodeHandler(std::size_t index, const ScannerConfig& bus, Counters& counters,
                         DevicenetEvents& events) noexcept
    : config_(bus.nodes[index]),
      report_(index, counters, events),
      channel_(bus.mac, config_.mac, config_.request_timeout),
      io_(config_, bus.cycle_time, report_),
      connect_(config_, bus, report_, channel_) {}

void NodeHandler::start(Instant now) noexcept {
  report_.status().device_state.reset();
  report_.status().fault_flags.reset();
  connect_.start(now);
  settle(now);
}

void NodeHandler::stop(const Sentence& why, Instant now) noexcept {
  connect_.stop(why, now);
  settle(now);
}

void NodeHandler::release(Instant now) noexcept {
  connect_.release(now);
  settle(now);
}

bool NodeHandler::submit(const ExplicitRequest& request, Instant now) noexcept {
  return channel_.submit(request, now);
}

void NodeHandler::handleIo(std::uint8_t message, const CanFrame& frame, Instant now) noexcept {
  io_.handle(message, frame, now);
}

void NodeHandler::handleExplicit(const CanFrame& frame, Instant now) noexcept {
  if (isDeviceMessage(frame, config_.mac)) {
    handleDeviceMessage(frame, now);
    return settle(now);
  }
  if (frame.remote) return report_.malformed(frame, "DeviceNet has no remote frames", now);
  switch (channel_.handle(frame, now)) {
    case Heard::kTaken:
      report_.status().heard_at = now;
      break;
    case Heard::kStale:
      ++report_.busCounters().stray_answers;
      break;
    case Heard::kForeign:
      // The header names whom it answers.
      ++report_.busCounters().second_scanner;
      ++report_.status().counters.foreign_requests;
      if (!answersBy(service::kError, frame)) ++report_.status().counters.foreign_use;
      connect_.handleForeignMaster(static_cast<std::uint8_t>(frame.data[0] & explicit_header::kMac), now);
      if (answersBy(service::kAllocate, frame)) connect_.handleForeignGrant(now);
      break;
    case Heard::kMalformed:
      report_.malformed(frame, "no explicit response", now);
      break;
  }
  settle(now);
}

void NodeHandler::handleDeviceMessage(const CanFrame& frame, Instant now) noexcept {
  NodeStatus& status = report_.status();
  if (const auto heartbeat = readHeartbeat(frame)) {
    ++status.counters.heartbeats;
    status.heard_at = now;
    const bool changed = status.device_state != heartbeat->state || status.fault_flags != heartbeat->fault_flags;
    status.device_state = heartbeat->state;
    status.fault_flags = heartbeat->fault_flags;
    if (changed) {
      report_.tell(DevicenetEventKind::kHeartbeat, heartbeatText(*heartbeat),
                   static_cast<std::uint32_t>(heartbeat->state) << 8u | heartbeat->fault_flags, now);
    }
    return connect_.handleSign(now);
  }
  const auto shutdown = readShutdown(frame);
  if (!shutdown) return report_.malformed(frame, "a heartbeat or shutdown message has eight bytes", now);
  Sentence why;
  why.format("says that it shuts down: class %u, instance %u, code %04Xh", unsigned{shutdown->class_id},
             unsigned{shutdown->instance}, unsigned{shutdown->code});
  report_.tell(DevicenetEventKind::kShutdown, why, shutdown->code, now);
  connect_.handleLoss(why, now);
}

void NodeHandler::handleDuplicateMac(const DuplicateMacMessage& message, Instant now) noexcept {
  // A question is asked by a device that starts: this one, or a second one, which this one then answers.
  if (!message.response) {
    connect_.handleSign(now);
    connect_.checkSoon(now);
    return settle(now);
  }
  Sentence text;
  text.format("a second device with MAC id %u was told that it is taken, by vendor %u, serial number %08Xh",
              unsigned{config_.mac}, unsigned{message.sender.vendor_id}, message.sender.serial_number);
  report_.tell(DevicenetEventKind::kDoubleMac, text, message.sender.serial_number, now);
}

void NodeHandler::handleForeignRequest(const CanFrame& frame, Group2 message, Instant now) noexcept {
  ++report_.status().counters.foreign_requests;
  if (message != Group2::kUnconnected) ++report_.status().counters.foreign_use;
  const bool is_explicit = message == Group2::kMasterExplicit || message == Group2::kUnconnected;
  if (is_explicit && frame.size > 0) {
    connect_.handleForeignMaster(static_cast<std::uint8_t>(frame.data[0] & explicit_header::kMac), now);
  }
  if (message == Group2::kMasterIo || message == Group2::kMasterAcknowledge) connect_.handleForeignIo(now);
  // It may have taken our connection away.
  if (message == Group2::kUnconnected) connect_.checkSoon(now);
  settle(now);
}

void NodeHandler::poll(Instant now) noexcept {
  channel_.poll(now);
  report_.status().counters.repeated = channel_.repeated();
  if (!io_.poll(now)) handleSilence(now);
  settle(now);
}

// It may hear us all the same. One that was let move gets its outputs until they stop it.
void NodeHandler::handleSilence(Instant now) noexcept {
  if (io_.ending()) return connect_.endOutputs(now);
  const bool must_stop = io_.mustStop();
  connect_.handleLoss(io_.lossText(), now, must_stop ? NodeConnect::Loss::kSilentMoving : NodeConnect::Loss::kSilent);
  if (must_stop) io_.beginEnding(now);
}

void NodeHandler::settle(Instant now) noexcept {
  connect_.poll(now);
  if (config_.io.kind == IoKind::kNone || connect_.sendsOutputs() == io_.established()) return;
  if (connect_.sendsOutputs()) {
    io_.establish(connect_.rate(), now);
  } else {
    io_.close();
  }
}

std::optional<Instant> NodeHandler::nextDeadline() const noexcept {
  std::optional<Instant> earliest = connect_.nextDeadline();
  earliest = earlier(earliest, channel_.nextDeadline());
  earliest = earlier(earliest, io_.nextDeadline());
  return earliest;
}

}  // namespace nord_driver::devicenet
