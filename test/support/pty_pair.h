// A pty for tests: the far end as a file descriptor, the near end as a path a serial port opens.
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <chrono>
#include <stdexcept>
#include <string>
#include <vector>

namespace nord_driver::test {

class PtyPair {
 public:
  PtyPair() : far_(posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)) {
    char name[128];
    if (far_ < 0 || grantpt(far_) != 0 || unlockpt(far_) != 0 || ptsname_r(far_, name, sizeof name) != 0) {
      throw std::runtime_error("no pty to be had");
    }
    path_ = name;
  }
  ~PtyPair() { hangUp(); }
  PtyPair(const PtyPair&) = delete;
  PtyPair& operator=(const PtyPair&) = delete;

  const std::string& path() const { return path_; }
  void hangUp() {
    if (far_ >= 0) ::close(far_);
    far_ = -1;
  }
  void send(const std::vector<std::uint8_t>& bytes) {
    if (::write(far_, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size())) {
      throw std::runtime_error("short write to a pty");
    }
  }
  /// What one read brings; empty when nothing comes within ten seconds.
  std::vector<std::uint8_t> receive() {
    pollfd descriptor{far_, POLLIN, 0};
    if (poll(&descriptor, 1, 10000) <= 0) return {};
    std::vector<std::uint8_t> bytes(512);
    const ssize_t count = ::read(far_, bytes.data(), bytes.size());
    bytes.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
    return bytes;
  }

 private:
  int far_;
  std::string path_;
};

}  // namespace nord_driver::test
