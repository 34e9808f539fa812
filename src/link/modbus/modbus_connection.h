// One connection to a Modbus/TCP server: a request goes out, its answer comes in, and nothing else is taken for it.
//
// libmodbus waits for and reads the answer (no error recovery of its own, which may hang; one time-out for the whole
// answer), this class owns the socket. After a time-out the connection is of no use: the late answer would be taken for
// the next one.
#pragma once

#include <cstdint>
#include <memory>

#include "link/modbus/host_resolver.h"
#include "link/modbus/modbus_telegram.h"
#include "link/modbus/telegram_listener.h"
#include "link/modbus/wakeup.h"

struct _modbus;  // NOLINT(bugprone-reserved-identifier): the name libmodbus gives it

namespace nord_driver::link {

enum class ModbusTrouble : std::uint8_t {
  kNone,
  kNoConnection,  ///< unknown host, refused, unreachable, silent
  kClosed,        ///< by the server, or by the network
  kSilent,        ///< no answer in time
  kPartial,       ///< the beginning of an answer in time
  kUnasked,       ///< bytes before there was a request: a doubled or late answer
  kBadAnswer,     ///< an answer that does not fit the request
  kException,     ///< refused in due form; the connection is good
  kCancelled,     ///< `stop` was signalled
};

class ModbusConnection {
 public:
  /// `settings` have been checked.
  explicit ModbusConnection(const ModbusSettings& settings, LookUp look_up = ::getaddrinfo);
  ~ModbusConnection();
  ModbusConnection(const ModbusConnection&) = delete;
  ModbusConnection& operator=(const ModbusConnection&) = delete;

  /// Within `connect_timeout`. Every call that fails leaves its reason, a sentence that begins with the server, and its
  /// trouble.
  bool open(const Wakeup& stop) noexcept;
  bool isOpen() const noexcept { return socket_ >= 0; }
  /// Sends a request (its unit and transaction are filled in) and waits for the answer, `response_timeout` at most.
  bool exchange(ModbusRequest request, const Wakeup& stop) noexcept;
  /// Register `i` of the last good answer to a reading request.
  Word answered(std::size_t i) const noexcept { return answerRegister(ByteView{answer_}, i); }
  /// After kSilent: waits until `until` for the answer that is late, to tell it from none. Its bytes are never used.
  bool isLate(Instant until, const Wakeup& stop) noexcept;
  void close() noexcept;
  /// Closes so that the server forgets the connection at once, whatever it still has to send.
  void abandon() noexcept;

  const Sentence& reason() const noexcept { return reason_; }
  ModbusTrouble trouble() const noexcept { return trouble_; }
  /// The code of the last one, of kException.
  unsigned exception() const noexcept { return exception_; }
  int descriptor() const noexcept { return socket_; }

 private:
  struct Release {
    void operator()(_modbus* context) const noexcept;
  };

  bool fail(ModbusTrouble trouble, const char* what) noexcept;
  bool isQuiet() noexcept;
  bool send(const ModbusAdu& bytes) noexcept;
  void noteEnds() noexcept;
  void hear(bool sent, const ModbusRequest& request, ByteView bytes, Instant time) noexcept;
  bool waitAnswer(const ModbusRequest& request, Instant until, const Wakeup& stop) noexcept;
  bool readAnswer(const ModbusRequest& request, Instant until) noexcept;

  ModbusSettings settings_;
  HostResolver resolver_;
  std::unique_ptr<_modbus, Release> context_;
  int socket_ = -1;
  std::uint16_t transaction_ = 0;
  bool has_answered_ = false;  // on this connection
  Instant sent_{};
  ModbusAdu answer_;
  HeardTelegram heard_;  // what is the same for all telegrams of this connection
  Sentence reason_;
  ModbusTrouble trouble_ = ModbusTrouble::kNone;
  unsigned exception_ = 0;
};

}  // namespace nord_driver::link
