#include "link/can/virtual_can_end.h"

#include "link/can/packet_socket.h"
#include "link/waiting.h"

namespace nord_driver::link {

VirtualCanEnd::VirtualCanEnd(const CanSettings& settings)
    : settings_(settings), filter_(settings.ids, settings.remote_ids) {
  error_.reserve(packet_socket::kLongestError);  // so that naming an error in the bus cycle does not allocate
  static_cast<void>(checkCanSettings(settings_, problem_));
}

int VirtualCanEnd::openSocket() noexcept {
  if (!problem_.empty()) {
    error_.assign(problem_.c_str());
    return -1;
  }
  const int descriptor = packet_socket::open();
  if (descriptor >= 0) return descriptor;
  fail("no socket", -descriptor);
  return -1;
}

bool VirtualCanEnd::fail(const char* what, int error) noexcept {
  close();
  packet_socket::describe(error_, settings_.interface, what, error);
  return false;
}

bool VirtualCanEnd::receive(ReceivedCanFrame& received) noexcept {
  if (!has_kept_) return takeNext(received);
  received = kept_;
  has_kept_ = false;
  return true;
}

bool VirtualCanEnd::keepNext() noexcept {
  has_kept_ = takeNext(kept_);
  return has_kept_;
}

void VirtualCanEnd::sleepUntil(Instant when) noexcept {
  sleepUntilInstant(when);
}

Instant VirtualCanEnd::now() const noexcept {
  return std::chrono::steady_clock::now();
}

}  // namespace nord_driver::link
