// Ends the waiting of another thread, and counts nothing: an eventfd.
#pragma once

#include <sys/eventfd.h>
#include <unistd.h>

#include <cstdint>

namespace nord_driver::link {

class Wakeup {
 public:
  Wakeup() noexcept : descriptor_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {}
  ~Wakeup() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  Wakeup(const Wakeup&) = delete;
  Wakeup& operator=(const Wakeup&) = delete;

  /// Any thread. Never waits: a counter that is full is a call that was heard.
  void signal() noexcept {
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto written = ::write(descriptor_, &one, sizeof one);
  }
  /// Forgets the signals so far. True when there was one.
  bool take() noexcept {
    std::uint64_t count = 0;
    return ::read(descriptor_, &count, sizeof count) > 0;
  }
  /// For poll(): readable once signalled; -1 when the kernel had none left.
  int descriptor() const noexcept { return descriptor_; }

 private:
  int descriptor_;
};

}  // namespace nord_driver::link
