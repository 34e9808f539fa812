// The simulated segment on a pseudo-terminal, in real time: a driver opens it as if it were a serial port.
//
// A pty has no bit times: pauses and answer times cannot be judged here (SimulatedSegment can), the rest can.
#pragma once

#include <atomic>
#include <string>
#include <thread>

#include "sim/profibus/dp_stations.h"
#include "sim/running_bus.h"

namespace nord_driver::sim {

/// Serves from construction to destruction, in a thread of its own. What a client does not read is thrown away; a
/// client that closes is no hang-up, the next one may open.
class PtyBus : public RunningBus, private AnswerSink {
 public:
  /// Puts a symbolic link to the pty at `link_path`; a link that is there already is replaced. Throws
  /// std::runtime_error naming path and reason, and ConfigError as DpStations does.
  PtyBus(const SimConfig& config, const std::string& link_path);
  ~PtyBus() override;
  PtyBus(const PtyBus&) = delete;
  PtyBus& operator=(const PtyBus&) = delete;

  const std::string& linkPath() const noexcept { return link_path_; }
  /// The pty itself: /dev/pts/7.
  const std::string& devicePath() const noexcept { return device_path_; }

  std::string where() const override { return link_path_; }
  /// Runs `function(DpStations&)` while the models stand still. Any thread.
  template <typename Function>
  auto withStations(Function&& function) {
    const std::lock_guard<InheritingMutex> lock(mutex_);
    return std::forward<Function>(function)(stations_);
  }

 private:
  struct Delayed {
    Instant due;
    WireBytes bytes;
  };

  RobotSim& robot() noexcept override { return robot_; }
  std::string report() const override { return stations_.report(); }
  void answer(const WireBytes& bytes, Duration delay) noexcept override;
  void openPty();
  void putLink();
  void closePty() noexcept;
  void serve() noexcept;
  void takeInput(Instant model_now) noexcept;
  void send(const WireBytes& bytes) noexcept;
  void sendDue(Instant now) noexcept;

  RobotSim robot_;
  DpStations stations_;
  std::string link_path_;
  std::string device_path_;
  int master_ = -1;
  int slave_ = -1;  // held open, so that a client's closing is no hang-up
  std::atomic<bool> stop_{false};
  Instant answer_from_{};  // model time of the request being answered
  FixedVector<Delayed, 64> delayed_;
  std::thread thread_;
};

}  // namespace nord_driver::sim
