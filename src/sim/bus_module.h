// What stands between a bus and its inverters: a bus module with one inverter or up to four, a gateway, or the bus port
// of an inverter.
//
// Here is what an experimenter switches on all of them: supply, links to the inverters, lost and late answers. A kind
// of module derives from it, in the folder of its bus, and adds what it says on the wire.
#pragma once

#include <array>
#include <cstdint>

#include "nord_driver/core/time.h"
#include "sim/inverter/words.h"

namespace nord_driver::sim {

class DriveUnit;

/// What an observer wants to know of the exchange with one inverter.
struct ExchangeCounters {
  std::uint64_t telegrams = 0;       ///< requests to this station
  std::uint64_t data_exchanges = 0;  ///< executed ones
  std::uint64_t watchdog_trips = 0;
  std::uint64_t zero_control_words = 0;  ///< bit 10 = 0 after valid process data
  Word last_control = 0;
  Word control_before_loss = 0;  ///< last control word before the watchdog expired
  Word status_at_loss = 0;       ///< status word at that moment
};

/// Where the power of a module comes from.
enum class Supply : std::uint8_t {
  kOwn,             ///< 24 V of its own: it lives while its inverters are off
  kInverter,        ///< plugged and unplugged together with its one inverter
  kPartOfInverter,  ///< the inverter's own bus port
};

class BusModule {
 public:
  static constexpr unsigned kPlaces = 4;  ///< inverters behind one module at most (BU 2700 4, BU 0260, BU 0280)

  virtual ~BusModule() = default;
  BusModule(const BusModule&) = delete;
  BusModule& operator=(const BusModule&) = delete;

  /// Puts a drive behind the module; it must outlive the module. `place`: 0-3.
  void connect(DriveUnit& drive, unsigned place) noexcept;

  virtual Supply supply() const noexcept = 0;
  /// Its own 24 V. Without them it says and hears nothing, and its inverters miss it.
  virtual void setPowered(bool on) noexcept = 0;
  virtual bool powered() const noexcept = 0;
  /// One of its inverters was plugged in or unplugged.
  virtual void inverterPlugged(bool /*plugged*/) noexcept {}

  /// The connection to one of its inverters.
  void setInverterLink(unsigned place, bool intact) noexcept;
  /// The connection to all of them.
  void setInverterLink(bool intact) noexcept;
  bool inverterLink(unsigned place) const noexcept { return places_[place].link; }
  /// The inverter there is connected and has its mains.
  bool present(unsigned place) const noexcept;

  /// It works, its answers are lost.
  void setMute(bool mute) noexcept { mute_ = mute; }
  bool mute() const noexcept { return mute_; }
  /// Answers come later by this much than the bus makes them.
  void setAnswerDelay(Duration delay) noexcept { answer_delay_ = delay; }
  Duration answerDelay() const noexcept { return answer_delay_; }

  /// Its own digital outputs, DO1 in bit 0; 0 where it has none.
  virtual std::uint8_t outputs() const noexcept { return 0; }
  /// Its own digital inputs, DI1 in bit 0. False: it has none.
  virtual bool setInputs(std::uint8_t /*inputs*/) noexcept { return false; }

  /// Process data move: in data exchange, operational.
  virtual bool inDataExchange() const noexcept = 0;
  /// Of the module, and of what came for this inverter.
  virtual ExchangeCounters countersOf(unsigned place) const noexcept = 0;

 protected:
  BusModule() = default;

  /// Null: nothing is connected there.
  DriveUnit* driveAt(unsigned place) noexcept { return places_[place].drive; }
  const DriveUnit* driveAt(unsigned place) const noexcept { return places_[place].drive; }
  /// Lets the inverters see whether their module is there; after its supply changed.
  void showLinks() noexcept;

 private:
  /// A drive has been put there.
  virtual void connected(unsigned /*place*/) noexcept {}
  void showLink(unsigned place) noexcept;

  struct Place {
    DriveUnit* drive = nullptr;
    bool link = true;
  };
  std::array<Place, kPlaces> places_{};
  bool mute_ = false;
  Duration answer_delay_{0};
};

}  // namespace nord_driver::sim
