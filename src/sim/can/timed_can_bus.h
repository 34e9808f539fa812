// A CAN bus in simulated time behind the link interface: a minute of bus time runs in milliseconds.
//
// Frames take their nominal 47 + 8 s bit times, the lowest identifier wins the bus, and `waitReadable()` jumps the
// clock to the next thing that happens. What goes wrong on a bus can be switched on: see the setters.
#pragma once

#include <cstdint>
#include <functional>
#include <random>
#include <string>

#include "link/can/can_link.h"
#include "sim/can/can_participants.h"

namespace nord_driver::sim {

struct CanBusSettings {
  Instant start{seconds(1000.0)};   ///< the time when the bus is built
  std::size_t send_queue = 8;       ///< frames the interface takes before it says "full"
  std::size_t receive_queue = 256;  ///< frames kept for the master; more are dropped and counted
};

/// What goes wrong on the bus, as a share of the frames; repeatable by its seed.
struct CanDisturbance {
  double lose = 0.0;       ///< nobody gets it, nobody knows
  double error = 0.0;      ///< an error frame: it is sent again, and counted
  double duplicate = 0.0;  ///< received twice (an error in the last bit but one: ISO 11898-1)
  double late = 0.0;       ///< the adapter of the master hands it over `late_by` later: others overtake it
  Duration late_by = std::chrono::milliseconds{5};
  bool requests = true;  ///< disturbs what the master sends
  bool answers = true;   ///< disturbs what the nodes send
  std::uint32_t seed = 1;
};

class TimedCanBus : public link::CanLink, private CanSink {
 public:
  enum class Sender : std::uint8_t { kMaster, kNode, kForeign };
  /// Sees every frame that went over the bus, at its end.
  using Tap = std::function<void(const CanFrame&, Sender, Instant)>;

  TimedCanBus(const TimedCanBus&) = delete;
  TimedCanBus& operator=(const TimedCanBus&) = delete;

  bool open() noexcept override;
  void close() noexcept override;
  bool isOpen() const noexcept override { return open_; }
  link::CanSend send(const CanFrame& frame) noexcept override;
  bool receive(link::ReceivedCanFrame& received) noexcept override;
  bool waitReadable(Instant until) noexcept override;
  void sleepUntil(Instant when) noexcept override { advanceTo(when); }
  Instant now() const noexcept override { return now_; }
  link::CanState state() const noexcept override { return state_; }
  link::CanCounters counters() const noexcept override { return counters_; }
  const std::string& lastError() const noexcept override { return last_error_; }
  const char* advice() const noexcept override;

  /// Lets simulated time pass without touching the link.
  void run(Duration span) noexcept { advanceTo(now_ + span); }

  /// How long a frame occupies the bus.
  Duration frameTime(const CanFrame& frame) const noexcept;

  /// Pulls or puts back the adapter: an open link closes itself, `open()` fails until it is back.
  void setInterfacePresent(bool present) noexcept;
  /// Sets the interface down or up; the link stays open.
  void setInterfaceUp(bool up) noexcept;
  /// Too many errors: the master's controller left the bus; what waited to be sent is lost.
  void setBusOff() noexcept;
  /// The controller is restarted.
  void restart() noexcept;
  /// Every `send()` finds the queue full.
  void setQueueFull(bool full) noexcept { queue_full_ = full; }
  /// `send()` finds a place once in this time only, and the queue full otherwise; zero: as the bus is.
  void setQueuePace(Duration pace) noexcept;
  void setDisturbance(const CanDisturbance& disturbance) noexcept;
  const CanDisturbance& disturbance() const noexcept { return disturbance_; }
  /// The next `count` frames of the master never reach the nodes; what nobody answers is no request.
  void loseRequests(unsigned count) noexcept { lose_requests_ = count; }
  /// The next `count` frames of the nodes never reach the master.
  void loseAnswers(unsigned count) noexcept { lose_answers_ = count; }
  /// The next `count` received frames find no room.
  void overflow(unsigned count) noexcept { overflow_ = count; }
  /// Someone else sends this as soon as the bus is free.
  void inject(const CanFrame& frame) noexcept;
  void setTap(Tap tap) { tap_ = std::move(tap); }

 protected:
  /// At `bit_rate` bit/s.
  TimedCanBus(std::uint32_t bit_rate, const CanBusSettings& settings);
  /// Lets the stations begin, before anything else is asked of the bus. They must outlive it.
  void start(CanParticipants& stations) noexcept;

 private:
  struct Pending {
    CanFrame frame;
    Sender sender = Sender::kNode;
    Instant given{};  ///< to the interface, where it is the master's
  };

  void transmit(const CanFrame& frame) noexcept override;
  void advanceTo(Instant when) noexcept;
  bool startFrame() noexcept;
  void endFrame() noexcept;
  void deliverFromMaster(const CanFrame& frame, unsigned times) noexcept;
  void deliverToMaster(const CanFrame& frame, unsigned times) noexcept;
  bool controllerOnBus() const noexcept;
  bool toQueue(const CanFrame& frame) noexcept;
  /// False: it is not held back.
  bool holdBack(const CanFrame& frame) noexcept;
  void handOverLate() noexcept;
  bool acknowledged() const noexcept;
  bool happens(double probability) noexcept;
  std::size_t queuedOfMaster() const noexcept;
  void forgetOfMaster() noexcept;

  CanParticipants* stations_ = nullptr;
  CanBusSettings settings_;
  Duration bit_time_;
  Instant now_;

  bool open_ = false;
  bool present_ = true;
  bool up_ = true;
  bool queue_full_ = false;
  Duration queue_pace_{};
  Instant next_place_{};
  link::CanState state_ = link::CanState::kActive;
  link::CanCounters counters_;
  std::string last_error_;

  FixedVector<Pending, 256> waiting_;
  Pending current_;
  bool busy_ = false;
  Instant current_end_{};
  FixedVector<link::ReceivedCanFrame, 512> received_;
  FixedVector<link::ReceivedCanFrame, 64> late_;  // `at`: when it is handed over
  unsigned unacknowledged_ = 0;

  CanDisturbance disturbance_;
  std::mt19937 random_;
  unsigned lose_requests_ = 0;
  unsigned lose_answers_ = 0;
  unsigned overflow_ = 0;
  bool foreign_ = false;  // somebody else is there, and acknowledges
  Tap tap_;
};

}  // namespace nord_driver::sim
