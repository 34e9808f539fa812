// A network that can be spoilt: a proxy on the loopback between a client and a server, in a thread of its own.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "nord_driver/core/time.h"

namespace nord_driver::test {

class TcpProxy {
 public:
  using Bytes = std::vector<std::uint8_t>;

  /// To a server on the loopback. Throws std::runtime_error where there is no port left.
  explicit TcpProxy(std::uint16_t server_port);
  ~TcpProxy();
  TcpProxy(const TcpProxy&) = delete;
  TcpProxy& operator=(const TcpProxy&) = delete;

  /// "127.0.0.1:40123".
  std::string address() const { return "127.0.0.1:" + std::to_string(port_); }

  /// Ends the connections there are, with a reset.
  void reset();
  /// Ends them, and takes no new ones until it is opened again.
  void setPortOpen(bool open);
  /// False: what comes from the client is swallowed, and nothing comes back; connections stay, and new ones are taken.
  void setCarries(bool carries);
  /// Answers come so much later.
  void setDelay(Duration delay);
  /// Changes each answer; empty: none. Runs in the thread of the proxy.
  void setSpoiler(std::function<void(Bytes&)> spoiler);

 private:
  struct Late {
    Instant due;
    Bytes bytes;
  };
  struct Pair {
    int client = -1, server = -1;
    std::deque<Late> answers;
  };

  void serve();
  void accept();
  bool carry(Pair& pair, bool client_readable, bool server_readable);
  void sendDue(Pair& pair, Instant now);
  static void close(Pair& pair, bool reset);
  void closeAll(bool reset);

  std::uint16_t server_port_;
  std::uint16_t port_ = 0;
  int listener_ = -1;
  std::vector<Pair> pairs_;
  std::mutex mutex_;
  bool carries_ = true;
  Duration delay_{};
  std::function<void(Bytes&)> spoiler_;
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

}  // namespace nord_driver::test
