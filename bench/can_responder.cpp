#include "can_responder.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <utility>

#include "measure.h"

namespace nord_driver::bench {

namespace {

constexpr canid_t kEndId = 0x7FF;  // of no node

}  // namespace

CanResponder::CanResponder(CanEnds& ends, CanAnswers answers, unsigned processor)
    : ends_(ends), answers_(std::move(answers)) {
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
  const CanSay say = [this](const can_frame& frame) {
    return ::write(ends_.far(), &frame, sizeof frame) == static_cast<ssize_t>(sizeof frame);
  };
  can_frame frame{};
  while (::read(ends_.far(), &frame, sizeof frame) == static_cast<ssize_t>(sizeof frame) && frame.can_id != kEndId &&
         answers_(frame, say)) {
  }
}

}  // namespace nord_driver::bench
