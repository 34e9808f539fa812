#include "can_responder.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "measure.h"

namespace nord_driver::bench {

namespace {

constexpr canid_t kEndId = 0x7FF;  // of no node

std::uint32_t valueOf(unsigned index, unsigned sub_index, unsigned node) {
  if (index == 0x1400 && sub_index == 1) return 0x40000200u + node;
  if (index == 0x1800 && sub_index == 1) return 0x40000180u + node;
  if (index == 0x1400 || index == 0x1800) return 1;  // transmission type: with every SYNC
  return 103;
}

}  // namespace

CanResponder::CanResponder(CanEnds& ends, std::size_t nodes, unsigned processor) : ends_(ends) {
  for (std::size_t node = 1; node <= nodes; ++node) {
    can_frame frame{};
    frame.can_id = static_cast<canid_t>(0x180 + node);
    frame.can_dlc = 4;
    frame.data[0] = 0x31;  // BU 0060 p. 96
    frame.data[1] = 0x0B;
    transmit_pdos_.push_back(frame);
  }
  thread_ = std::thread{[this, processor] {
    pinTo(processor);
    runUntilWaiting();
    run();
  }};
}

CanResponder::~CanResponder() {
  // Nothing else wakes a thread that reads from a CAN_RAW socket.
  can_frame end{};
  end.can_id = kEndId;
  if (::write(ends_.near(), &end, sizeof end) != static_cast<ssize_t>(sizeof end)) {
    std::perror("the far end cannot be told to end");
    std::abort();
  }
  thread_.join();
}

void CanResponder::run() {
  can_frame frame{};
  while (::read(ends_.far(), &frame, sizeof frame) == static_cast<ssize_t>(sizeof frame) && answer(frame)) {
  }
}

bool CanResponder::answer(const can_frame& frame) const {
  if (frame.can_id == kEndId) return false;
  if (frame.can_id == 0x080) {
    for (const can_frame& pdo : transmit_pdos_) {
      if (!send(pdo)) return false;
    }
  } else if (frame.can_id > 0x600 && frame.can_id <= 0x67F) {
    can_frame response{};
    answerSdo(frame, response);
    return send(response);
  }
  return true;
}

bool CanResponder::send(const can_frame& frame) const {
  return ::write(ends_.far(), &frame, sizeof frame) == static_cast<ssize_t>(sizeof frame);
}

void CanResponder::answerSdo(const can_frame& request, can_frame& response) {
  response = request;
  response.can_id = request.can_id - 0x80;
  std::fill(response.data + 4, response.data + 8, std::uint8_t{0});
  if ((request.data[0] & 0xE0u) != 0x40) {
    response.data[0] = 0x60;
    return;
  }
  const unsigned index = request.data[1] | static_cast<unsigned>(request.data[2]) << 8;
  const std::uint32_t value = valueOf(index, request.data[3], request.can_id & 0x7Fu);
  response.data[0] = index < 0x2000 ? 0x43 : 0x4B;
  for (unsigned i = 0; i < 4; ++i) response.data[4 + i] = static_cast<std::uint8_t>(value >> 8 * i);
}

}  // namespace nord_driver::bench
