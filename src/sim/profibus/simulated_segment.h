// A PROFIBUS segment in simulated time behind the link interface: a minute of bus time runs in milliseconds.
//
// Bytes take eleven bit times each, stations answer after their Tsdr, and `waitReadable()` jumps the clock to the next
// thing that happens. Only here can pauses and answer times be judged: a pty has no time of its own.
#pragma once

#include <cstdint>
#include <random>
#include <string>

#include "core/baud_rate.h"
#include "link/serial/byte_link.h"
#include "sim/profibus/dp_stations.h"

namespace nord_driver::sim {

struct SegmentSettings {
  std::uint64_t tsdr_bits = 32;    ///< answer time of the stations, in bit times
  Instant start{seconds(1000.0)};  ///< the time when the segment is built
};

/// What goes wrong on the line, as a share of the bytes; repeatable by its seed.
struct Disturbance {
  double lose = 0.0;
  double flip = 0.0;
  double duplicate = 0.0;
  bool requests = true;  ///< disturbs what the master sends
  bool answers = true;   ///< disturbs what the stations send
  /// At most one bit of a telegram is turned: the line has no parity bit here, and two turned bits may leave the checksum
  /// as it was, which parity and checksum together never do (Hamming distance 4, IEC 870-5-1 format class FT 1.2).
  bool one_bit = false;
  std::uint32_t seed = 1;
};

class SimulatedSegment : public link::ByteLink, private AnswerSink {
 public:
  /// Throws ConfigError as DpStations does.
  explicit SimulatedSegment(const SimConfig& config, const SegmentSettings& settings = SegmentSettings{});

  bool open() noexcept override;
  void close() noexcept override;
  bool isOpen() const noexcept override { return open_; }
  bool write(ByteView telegram) noexcept override;
  std::size_t read(std::uint8_t* buffer, std::size_t capacity) noexcept override;
  void discardInput() noexcept override;
  bool waitReadable(Instant until) noexcept override;
  void sleepUntil(Instant when) noexcept override { advanceTo(when); }
  Instant now() const noexcept override { return now_; }
  bool keepsBaudRate() const noexcept override { return true; }
  const std::string& lastError() const noexcept override { return last_error_; }

  /// Lets simulated time pass without touching the link.
  void run(Duration span) noexcept { advanceTo(now_ + span); }

  RobotSim& robot() noexcept { return robot_; }
  DpStations& stations() noexcept { return stations_; }
  Referee& referee() noexcept { return stations_.referee(); }
  DriveUnit& drive(std::size_t index) noexcept { return robot_.drive(index); }
  /// The station of drive `index`.
  DpStation& station(std::size_t index) noexcept { return stations_.stationOf(index); }
  BaudRate baudRate() const noexcept { return baud_rate_; }

  /// Pulls or puts back the adapter: an open link fails, `open()` fails until it is back.
  void setDevicePresent(bool present) noexcept;
  void setDisturbance(const Disturbance& disturbance) noexcept;
  /// The next `count` answers never reach the master.
  void loseAnswers(unsigned count) noexcept { lose_answers_ = count; }
  /// The next `count` requests that somebody answers never reach the stations.
  void loseRequests(unsigned count) noexcept { lose_requests_ = count; }
  /// Somebody else's telegram: the master hears it from now on, the stations do not.
  void foreign(ByteView telegram) noexcept;
  /// One bit of the first byte of each of the next `count` answers is turned.
  void spoilAnswers(unsigned count) noexcept { spoil_answers_ = count; }
  void setAnswerTime(std::uint64_t tsdr_bits) noexcept { tsdr_bits_ = tsdr_bits; }

 private:
  struct ArrivingByte {
    Instant at;
    std::uint8_t value = 0;
  };

  void answer(const WireBytes& bytes, Duration delay) noexcept override;
  void advanceTo(Instant when) noexcept;
  void deliverRequest() noexcept;
  FixedBytes<512> disturbed(ByteView bytes, bool enabled) noexcept;
  bool happens(double probability) noexcept;

  RobotSim robot_;
  DpStations stations_;
  BaudRate baud_rate_;
  std::uint64_t tsdr_bits_;
  Instant now_;
  bool open_ = false;
  bool device_present_ = true;
  std::string last_error_;

  FixedBytes<512> request_;  // on its way to the stations
  Instant request_end_{};
  bool request_pending_ = false;
  FixedVector<ArrivingByte, 1024> arriving_;
  Instant answer_start_{};
  Instant answer_end_{};
  bool line_used_ = false;

  Disturbance disturbance_;
  std::mt19937 random_;
  unsigned lose_answers_ = 0;
  unsigned lose_requests_ = 0;
  unsigned spoil_answers_ = 0;
};

}  // namespace nord_driver::sim
