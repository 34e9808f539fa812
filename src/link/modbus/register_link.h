// What a gateway looks like to the transport above: an output image goes in, the newest input image comes out, and
// neither waits.
#pragma once

#include <cstdint>

#include "core/register_image.h"
#include "link/modbus/register_order.h"
#include "nord_driver/core/fixed_text.h"
#include "nord_driver/core/time.h"

namespace nord_driver::link {

/// The newest inputs of the server.
struct RegisterInputs {
  std::uint64_t number = 0;   ///< of exchanges; 0: none yet
  std::uint64_t outputs = 0;  ///< number of the output image that had been written before these were read
  Instant asked{};            ///< when the first of them was asked for: they are not older than this
  Instant received{};         ///< when the last of them had come
  RegisterImage words;        ///< words outside the parts that are read are 0
  bool bus_runs = false;      ///< the register that says so says so; true where none is configured
  Word running = 0;           ///< that register

  /// At most so old: the server read them from its ring before it was asked, how long before nobody knows.
  Duration age(Instant now) const noexcept { return now - asked; }
};

enum class LinkState : std::uint8_t {
  kClosed,
  kConnecting,  ///< at it for the first time, or again after a pause
  kConnected,
  kPausing,  ///< after a failure
};

struct LinkCounters {
  std::uint64_t exchanges = 0;    ///< good ones
  std::uint64_t requests = 0;     ///< answered well
  std::uint64_t connections = 0;  ///< made
  std::uint64_t connect_failures = 0;
  std::uint64_t closed = 0;  ///< by the other side
  std::uint64_t timeouts = 0;
  std::uint64_t late = 0;  ///< of the time-outs, those whose answer came afterwards
  std::uint64_t partial = 0;
  std::uint64_t unasked = 0;
  std::uint64_t bad_answers = 0;
  std::uint64_t exceptions = 0;
  std::uint64_t skipped_outputs = 0;    ///< output images a newer one took the place of
  std::uint64_t refused_exchanges = 0;  ///< of images, and looks, by exceptions other than "server device busy"
  std::uint64_t lost = 0;               ///< `closed` and `connect_failures` of the images' connection alone
};

struct LinkReport {
  LinkState state = LinkState::kClosed;
  Sentence text;  ///< what is wrong; empty when nothing is
  LinkCounters counters;
};

/// Life: closed -> open() -> works and reconnects by itself -> close(). All of it from one thread, the bus cycle's.
class RegisterLink {
 public:
  virtual ~RegisterLink() = default;

  /// False: `report().text`.
  virtual bool open() noexcept = 0;
  /// Ends within the longest time-out of a request.
  virtual void close() noexcept = 0;

  /// Hands over the newest output image and asks for one exchange. Each image is written at most once: a cycle that
  /// hangs feeds no watchdog. One handed over before the connection stood is not written at all. Returns its number.
  virtual std::uint64_t give(const RegisterImage& outputs) noexcept = 0;
  /// As give(), of an exchange that reads and writes nothing: the outputs of the server stay what they are.
  virtual std::uint64_t look() noexcept = 0;
  /// Hands over an order, which takes the place of one that still waits; its number. It is carried out once, beside the
  /// images, and given up when the connection is not there. Default: 0, such a link carries none.
  virtual std::uint64_t order(const RegisterOrder& /*order*/) noexcept { return 0; }
  /// The answer to the order carried out last. The reference holds until the next call.
  virtual const RegisterAnswer& answer() noexcept {
    static const RegisterAnswer kNone;
    return kNone;
  }
  /// The newest inputs, however old. The reference holds until the next call.
  virtual const RegisterInputs& take() noexcept = 0;
  virtual const LinkReport& report() noexcept = 0;
  /// For who may wait: until there are newer inputs or a newer report than at the last return, or `until` has come.
  /// False: it has come.
  virtual bool waitAnswers(Instant until) noexcept = 0;
  virtual Instant now() const noexcept = 0;
  /// Waits until `when`, whatever comes meanwhile.
  virtual void sleepUntil(Instant when) noexcept = 0;
};

}  // namespace nord_driver::link
