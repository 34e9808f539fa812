// A simulated PROFIBUS DP-V0 slave: the bus module SK TU3-PBR(-24V), ident number 7531h, with one inverter behind it.
//
// EN 50170 / profibus DP: POWER_ON -> WAIT_PRM -> WAIT_CFG -> DATA_EXCH; BU 0020 7.2 and 8.2 for what NORD says of it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "nord_driver/core/time.h"
#include "nord_driver/sim/inverter_model.h"
#include "nord_driver/sim/pkw_server.h"
#include "nord_driver/sim/referee.h"
#include "nord_driver/sim/telegram.h"

namespace nord_driver::sim {

enum class SlaveState : std::uint8_t { kOff, kWaitParameters, kWaitConfiguration, kDataExchange };

struct SlaveSettings {
  std::uint8_t address = 126;
  int ppo_type = 1;              ///< 1-4, set by switch or P507
  bool swap_words_3_4 = false;   ///< SK 300E/7x0E: SW3 and IW3 come before SW2 and IW2 (BU 0020 7.2.2)
  std::uint16_t ident = 0x7531;  ///< BU 0020 10.2
};

/// What an observer wants to know of the exchange.
struct SlaveCounters {
  std::uint64_t telegrams = 0;       ///< requests to this station
  std::uint64_t data_exchanges = 0;  ///< executed ones
  std::uint64_t repeated = 0;        ///< answered from the store: same FCB again
  std::uint64_t global_controls = 0;
  std::uint64_t watchdog_trips = 0;
  std::uint64_t zero_control_words = 0;  ///< bit 10 = 0 after valid process data
  Word last_control = 0;
  Word control_before_loss = 0;  ///< last control word before the watchdog expired
  Word status_at_loss = 0;       ///< status word at that moment
};

class DpSlave {
 public:
  /// All must outlive the slave; `referee` may be null.
  DpSlave(const SlaveSettings& settings, ParameterStore& parameters, InverterModel& inverter, PkwServer& pkw,
          Referee* referee);

  /// The master's telegram has arrived. The answer, or nothing.
  std::optional<WireBytes> handle(const Telegram& request) noexcept;
  /// Lets time pass for the watchdog.
  void advance(Duration span) noexcept;
  /// Until the watchdog expires; none when it is not running.
  std::optional<Duration> untilWatchdog() const noexcept;

  /// The module's own supply. Off: it answers nothing and forgets everything.
  void setPowered(bool on) noexcept;
  /// The module works, its answers are lost.
  void setMute(bool mute) noexcept { mute_ = mute; }
  /// The connection between module and inverter: E10.8 in the inverter, diagnosis 02 04 in the module.
  void setInverterLink(bool intact) noexcept;

  SlaveState state() const noexcept { return state_; }
  const SlaveCounters& counters() const noexcept { return counters_; }
  const SlaveSettings& settings() const noexcept { return settings_; }

 private:
  WireBytes execute(const Telegram& request) noexcept;
  WireBytes diagnosis(const Telegram& request) noexcept;
  WireBytes setParameters(const Telegram& request) noexcept;
  WireBytes checkConfiguration(const Telegram& request) noexcept;
  WireBytes getConfiguration(const Telegram& request) const noexcept;
  WireBytes exchangeData(const Telegram& request) noexcept;
  WireBytes answerWithout(const Telegram& request, std::uint8_t code) const noexcept;
  Telegram answerTo(const Telegram& request, std::uint8_t code) const noexcept;

  bool inverterReachable() const noexcept { return inverter_link_ && inverter_.powered(); }
  FixedBytes<2> configuration() const noexcept;
  std::size_t dataLength() const noexcept;
  void appendInputs(FixedBytes<246>& data) const noexcept;
  void takeOutputs(ByteView data) noexcept;
  void clearOutputs() noexcept;
  void toWaitParameters() noexcept;
  void showStatus() noexcept;
  unsigned displayElement(unsigned value) const noexcept;

  SlaveSettings settings_;
  ParameterStore& parameters_;
  InverterModel& inverter_;
  PkwServer& pkw_;
  Referee* referee_;

  SlaveState state_ = SlaveState::kOff;
  bool mute_ = false;
  bool inverter_link_ = true;
  bool parameter_fault_ = false;
  bool configuration_fault_ = false;
  bool valid_data_seen_ = false;
  bool reported_unreachable_ = false;  // as the last diagnosis said
  std::uint8_t owner_ = 0xFF;
  Duration watchdog_{0};  // 0 = off
  Duration silence_{0};

  // Frame count bit: EN 50170-4, "responder".
  bool frame_count_known_ = false;
  bool frame_count_ = false;
  std::uint8_t frame_count_master_ = 0xFF;
  WireBytes stored_answer_;

  SlaveCounters counters_;
};

}  // namespace nord_driver::sim
