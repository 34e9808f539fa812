// A Modbus/TCP server with nothing behind it: functions 4 and 16, and when it did what.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <thread>

namespace nord_driver::bench {

/// Serves one client at a time on a free port of the loopback, in a thread of its own.
class RegisterServer {
 public:
  explicit RegisterServer(unsigned processor);
  ~RegisterServer();
  RegisterServer(const RegisterServer&) = delete;
  RegisterServer& operator=(const RegisterServer&) = delete;

  std::uint16_t port() const noexcept { return port_; }
  std::string address() const { return "127.0.0.1:" + std::to_string(port_); }
  /// Takes requests, and answers none of them.
  void stall(bool on) noexcept { stalled_ = on; }
  /// ns of the steady clock: when the last write was carried out, and the last inputs were taken.
  std::int64_t written() const noexcept { return written_; }
  std::int64_t read() const noexcept { return read_; }

 private:
  void serve(unsigned processor);
  void serve(int client);

  int listener_ = -1;
  std::uint16_t port_ = 0;
  std::atomic<bool> stop_{false}, stalled_{false};
  std::atomic<std::int64_t> written_{0}, read_{0};
  std::thread thread_;
};

}  // namespace nord_driver::bench
