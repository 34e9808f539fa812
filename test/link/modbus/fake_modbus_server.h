// A Modbus/TCP server on the loopback with a mind of its own: written from the Modbus specification (MODBUS Application
// Protocol V1.1b3, MODBUS Messaging on TCP/IP V1.0b), it answers well, or in the way it is told.
#pragma once

#include <array>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "link/modbus/wakeup.h"

namespace nord_driver::link::test {

using Bytes = std::vector<std::uint8_t>;

/// What the server does with one request.
struct Reaction {
  enum Way : std::uint8_t {
    kAnswer,
    kSilent,       ///< never answers
    kHold,         ///< answers when release() is called
    kPart,         ///< only the first `value` bytes of the answer
    kTransaction,  ///< the number of the request plus `value`
    kProtocol,     ///< protocol `value`
    kUnit,         ///< unit `value`
    kFunction,     ///< function `value`
    kLength,       ///< a length in the header that is `value` too long
    kException,    ///< with code `value`
    kTwice,        ///< the same answer two times
    kClose,
    kReset,
    kRaw,  ///< `bytes`, whatever was asked
  };
  Way way = kAnswer;
  std::uint16_t value = 0;
  Bytes bytes{};
};

class FakeModbusServer {
 public:
  static constexpr std::size_t kRegisters = 4096;  ///< more are no legal address

  FakeModbusServer();
  ~FakeModbusServer();
  FakeModbusServer(const FakeModbusServer&) = delete;
  FakeModbusServer& operator=(const FakeModbusServer&) = delete;

  /// "127.0.0.1:40123".
  std::string address() const { return "127.0.0.1:" + std::to_string(port_); }

  /// The reaction to the next request that has none yet.
  void next(Reaction reaction);
  /// The reaction to all requests next() says nothing about.
  void always(Reaction reaction);
  void release();
  /// Takes no more connections, and those there are end.
  void shut();
  void listenAgain();

  void setInput(std::size_t address, std::uint16_t value);
  void setHolding(std::size_t address, std::uint16_t value);
  std::uint16_t holding(std::size_t address) const;
  /// What is written there is not kept.
  void protect(std::size_t address);
  /// Requests that touch this register get exception 6, server device busy, until another one is refused.
  void refuse(std::size_t address);

  std::vector<Bytes> requests() const;
  std::size_t connections() const;
  /// Waits for `condition`, which is asked whenever something has happened; false when that took 20 s.
  bool waitFor(const std::function<bool()>& condition) const;
  bool waitForRequests(std::size_t count) const {
    return waitFor([&] { return requests_.size() >= count; });
  }
  bool waitForConnections(std::size_t count) const {
    return waitFor([&] { return connections_ >= count; });
  }

 private:
  void run();
  void accept();
  void receive(int client);
  void handle(int client, const Bytes& request);
  void react(int client, const Bytes& request, const Reaction& reaction);
  void drop(int client, bool reset);
  void send(int client, const Bytes& bytes);
  Bytes answer(const Bytes& request);
  Bytes answerData(const Bytes& pdu);

  mutable std::mutex mutex_;
  mutable std::condition_variable happened_;
  std::uint16_t port_ = 0;
  int listener_ = -1;
  std::map<int, Bytes> clients_;  // and what they have sent
  std::deque<Reaction> next_;
  Reaction always_;
  std::vector<std::pair<int, Bytes>> held_;
  std::vector<Bytes> requests_;
  std::size_t connections_ = 0;
  bool ending_ = false, listening_ = true;
  std::array<std::uint16_t, kRegisters> inputs_{}, holdings_{};
  std::size_t protected_ = kRegisters, refused_ = kRegisters;
  Wakeup wakeup_;
  std::thread thread_;
};

}  // namespace nord_driver::link::test
