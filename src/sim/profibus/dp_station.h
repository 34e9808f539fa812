// A simulated PROFIBUS DP station, whatever is behind it: the services and the state machine every slave shares.
//
// EN 50170: POWER_ON -> WAIT_PRM -> WAIT_CFG -> DATA_EXCH, the frame count bit, the watchdog, SYNC and FREEZE, and the
// records of DP-V1 for both classes of masters. What is exchanged and configured is the business of the derived
// classes.
#pragma once

#include <cstdint>
#include <optional>

#include "nord_driver/core/time.h"
#include "sim/bus_module.h"
#include "sim/inverter/words.h"
#include "sim/profibus/class2_server.h"
#include "sim/profibus/record_server.h"
#include "sim/profibus/referee.h"
#include "sim/profibus/telegram.h"

namespace nord_driver::sim {

enum class SlaveState : std::uint8_t { kOff, kWaitParameters, kWaitConfiguration, kDataExchange };

struct SlaveCounters : ExchangeCounters {
  std::uint64_t repeated = 0;  ///< answered from the store: same FCB again
  std::uint64_t global_controls = 0;
};

class DpStation : public BusModule {
 public:
  /// One identifier for each of the five slots at most.
  using Configuration = FixedBytes<8>;
  using Data = FixedBytes<246>;

  /// The master's telegram has arrived. The answer, or nothing.
  std::optional<WireBytes> handle(const Telegram& request) noexcept;
  /// Lets time pass for the watchdog, and for what the module watches itself.
  void advance(Duration span) noexcept;

  /// Off: it answers nothing and forgets everything.
  void setPowered(bool on) noexcept override;
  bool powered() const noexcept override { return state_ != SlaveState::kOff; }
  bool inDataExchange() const noexcept override { return state_ == SlaveState::kDataExchange; }
  ExchangeCounters countersOf(unsigned /*place*/) const noexcept override { return counters_; }

  std::uint8_t address() const noexcept { return address_; }
  /// Another kind of module has been put in its place.
  void setIdent(std::uint16_t ident) noexcept { ident_ = ident; }
  std::uint16_t ident() const noexcept { return ident_; }
  SlaveState state() const noexcept { return state_; }
  const SlaveCounters& counters() const noexcept { return counters_; }
  bool inSyncMode() const noexcept { return sync_; }
  bool inFreezeMode() const noexcept { return freeze_; }

 protected:
  /// `referee` may be null and must outlive the station.
  DpStation(std::uint8_t address, std::uint16_t ident, Referee* referee) noexcept
      : address_(address), ident_(ident), referee_(referee) {}

  Referee* referee() noexcept { return referee_; }
  SlaveCounters& counted() noexcept { return counters_; }

 private:
  /// Takes `identifiers` over when the module can be configured so.
  virtual bool takeConfiguration(ByteView identifiers) noexcept = 0;
  virtual Configuration configuration() const noexcept = 0;
  /// Bytes in each direction with the configuration in force.
  virtual std::size_t dataLength() const noexcept = 0;
  virtual void appendInputs(Data& data) const noexcept = 0;
  /// Outputs have arrived; with SYNC they do not act yet.
  virtual void outputsArrived(ByteView /*data*/) noexcept {}
  /// Outputs act.
  virtual void takeOutputs(ByteView data) noexcept = 0;
  /// "A safe state, in which all outputs are switched to 0" (BU 2700 8.1.1).
  virtual void clearOutputs() noexcept = 0;
  virtual void enterDataExchange() noexcept {}
  virtual bool inverterMissing() const noexcept = 0;
  /// The watchdog expired in data exchange.
  virtual void masterLost() noexcept = 0;
  virtual void supplyChanged(bool /*on*/) noexcept {}
  virtual void watch(Duration /*span*/) noexcept {}
  virtual void showStatus() noexcept {}
  /// The DP-V1 server; null: DP-V0 only.
  virtual RecordServer* records() noexcept { return nullptr; }
  /// Its connections of class 2; null: none.
  virtual Class2Server* class2() noexcept { return nullptr; }

  WireBytes execute(const Telegram& request) noexcept;
  WireBytes diagnosis(const Telegram& request) noexcept;
  WireBytes setParameters(const Telegram& request) noexcept;
  WireBytes checkConfiguration(const Telegram& request) noexcept;
  WireBytes getConfiguration(const Telegram& request) const noexcept;
  WireBytes exchangeData(const Telegram& request) noexcept;
  WireBytes record(const Telegram& request) noexcept;
  WireBytes class2Record(const Telegram& request) noexcept;
  void globalControl(const Telegram& request) noexcept;
  void endModes() noexcept;
  WireBytes answerWithout(const Telegram& request, std::uint8_t code) const noexcept;
  Telegram answerTo(const Telegram& request, std::uint8_t code) const noexcept;
  bool acceptsParameters(ByteView data) noexcept;
  void toWaitParameters() noexcept;

  std::uint8_t address_;
  std::uint16_t ident_;
  Referee* referee_;

  SlaveState state_ = SlaveState::kOff;
  bool parameter_fault_ = false;
  bool configuration_fault_ = false;
  bool reported_missing_ = false;  // as the last diagnosis said
  std::uint8_t owner_ = 0xFF;
  Duration watchdog_{0};  // 0 = off
  Duration silence_{0};
  bool records_enabled_ = false;

  // Global_Control.
  std::uint8_t groups_ = 0;
  bool sync_allowed_ = false;
  bool freeze_allowed_ = false;
  bool sync_ = false;
  bool freeze_ = false;
  bool outputs_wait_ = false;
  Data waiting_outputs_;
  Data frozen_inputs_;

  // Frame count bit: EN 50170-4, "responder".
  bool frame_count_known_ = false;
  bool frame_count_ = false;
  std::uint8_t frame_count_master_ = 0xFF;
  WireBytes stored_answer_;

  SlaveCounters counters_;
};

}  // namespace nord_driver::sim
