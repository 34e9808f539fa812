// The measure of things: the same bytes with nothing but write() and read().
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace nord_driver::bench {

class PingPong {
 public:
  PingPong(const std::string& device, std::vector<std::uint8_t> request, std::size_t answer_size)
      : descriptor_(::open(device.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC)),
        request_(std::move(request)),
        answer_size_(answer_size) {
    if (descriptor_ < 0) throw std::runtime_error("cannot open " + device);
  }
  ~PingPong() { ::close(descriptor_); }
  PingPong(const PingPong&) = delete;
  PingPong& operator=(const PingPong&) = delete;

  void exchange() const {
    std::uint8_t buffer[512];
    if (::write(descriptor_, request_.data(), request_.size()) != static_cast<ssize_t>(request_.size())) {
      throw std::runtime_error("short write");
    }
    for (std::size_t have = 0; have < answer_size_;) {
      const ssize_t count = ::read(descriptor_, buffer, sizeof buffer);
      if (count <= 0) throw std::runtime_error("the far end is gone");
      have += static_cast<std::size_t>(count);
    }
  }

 private:
  int descriptor_;
  std::vector<std::uint8_t> request_;
  std::size_t answer_size_;
};

}  // namespace nord_driver::bench
