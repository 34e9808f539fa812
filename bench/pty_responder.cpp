#include "pty_responder.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "measure.h"

namespace nord_driver::bench {

namespace {

constexpr auto kSpin = std::chrono::microseconds{100};

}  // namespace

PtyResponder::PtyResponder(Answers answers, unsigned processor)
    : answers_(std::move(answers)), far_(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)) {
  char name[128];
  if (far_ < 0 || ::grantpt(far_) != 0 || ::unlockpt(far_) != 0 || ::ptsname_r(far_, name, sizeof name) != 0) {
    throw std::runtime_error("no pty to be had");
  }
  path_ = name;
  last_request_.reserve(256);
  thread_ = std::thread([this, processor] {
    pinTo(processor);
    ::prctl(PR_SET_TIMERSLACK, 1);
    run();
  });
}

PtyResponder::~PtyResponder() {
  stop_ = true;
  // A byte from the near end wakes the thread.
  const int near = ::open(path_.c_str(), O_WRONLY | O_NOCTTY);
  if (near >= 0 && ::write(near, "\n", 1) == 1) thread_.join();
  ::close(near);
  ::close(far_);
}

void PtyResponder::run() {
  std::uint8_t buffer[512];
  std::size_t held = 0;
  while (!stop_) {
    const ssize_t count = ::read(far_, buffer + held, sizeof buffer - held);
    if (count <= 0) {  // nobody has the near end open
      ::usleep(1000);
      continue;
    }
    const auto arrived = std::chrono::steady_clock::now();
    held += static_cast<std::size_t>(count);
    std::size_t used = 0;
    for (;;) {
      const ByteView rest = ByteView{buffer, held}.sub(used);
      const std::size_t length = Answers::lengthOf(rest);
      if (length == 0 || rest.size() < length) break;
      answer(rest.sub(0, length), arrived);
      used += length;
    }
    held -= used;
    std::memmove(buffer, buffer + used, held);
  }
}

void PtyResponder::answer(ByteView request, Instant arrived) {
  const ByteView answer = answers_.to(request);
  if (answer.empty()) return;
  last_request_.assign(request.begin(), request.end());
  last_answer_size_ = answer.size();
  if (const std::uint32_t rate = wire_) {
    const BaudRate baud{rate};
    const Instant due = arrived + baud.characters(request.size() + answer.size()) + baud.bits(11);
    std::this_thread::sleep_until(due - kSpin);
    while (std::chrono::steady_clock::now() < due) {
    }
  }
  if (::write(far_, answer.data(), answer.size()) < 0) stop_ = true;
}

}  // namespace nord_driver::bench
