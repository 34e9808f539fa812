// Reads from a drive what scaling and device information need, one parameter at a time, beside the process data.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "cycle/device_data.h"
#include "nord_driver/core/fixed_vector.h"
#include "nord_driver/profile/parameter_request.h"
#include "nord_driver/profile/series.h"
#include "nord_driver/transport/transport.h"

namespace nord_driver::cycle {

/// Begins again whenever the drive has come back: it may have been exchanged. A parameter that times out is asked for
/// three times (once, as long as nothing is answered at all), one the drive refuses is left out; a question that did
/// not reach the drive is put again. First come those that decide motion: P105, without which nothing can be driven,
/// P104, the functions of setpoint 1 and actual value 1, and P600, of all parameter sets. One of these that timed out, or was
/// refused for the moment, is asked for again whenever the owner wants to.
class DeviceReader {
 public:
  static constexpr unsigned kAwaitedRounds = 3;
  static constexpr std::uint16_t kModuleTimeout = 151, kEepromSwitch = 560;

  /// `owner`: whose time-outs are read; those of a module by requests the transport passes on to it.
  /// `further_words`: setpoints 2 and 3 or actual values 2 and 3 are in use: what they are decides motion, too.
  /// `positions`: so does P610, of a drive that positions. `out_bit`: the element of P481 whose function decides
  /// what is told of its reference; 0: none. P607 and P608 of such a drive come later: they decide nothing.
  explicit DeviceReader(profile::Series series, TimeoutOwner owner = TimeoutOwner::kInverter,
                        bool further_words = false, bool positions = false, std::uint8_t out_bit = 0) noexcept;

  /// The drive went away: what was read is kept until it is back.
  void handleOffline() noexcept;
  /// The next parameter to ask for, when none is under way; its id is for the caller to choose.
  std::optional<profile::ParameterRequest> pollRequest() noexcept;
  /// The result of the request handed out last.
  void handleResult(const profile::ParameterResult& result) noexcept;

  const DeviceData& data() const noexcept { return data_; }
  /// P105 of every set was asked for since the drive is back: what is absent will not come.
  bool maxFrequenciesAsked() const noexcept;
  /// The same of all parameters that decide motion.
  bool motionAsked() const noexcept;
  /// And what was refused for the moment, or timed out beside others that were answered or refused, was asked for again
  /// often enough (kAwaitedRounds): what is absent then refuses nothing.
  bool motionKnown() const noexcept;
  /// All has been asked for, and one that decides motion has only timed out, or was refused for the moment;
  /// `max_frequencies`: P105 counts, too.
  bool missesMotion(bool max_frequencies = true) const noexcept;
  /// Asks for P120, P151, P513 or P560 again: what stops the drive when this computer dies, and whether it saves what is written,
  /// may have become another. What was read of it stays until then, but P560, which is not known meanwhile. Of others nothing.
  void askAgain(std::uint16_t number) noexcept;
  /// Asks again, up to three times each, for those; what else was read stays.
  void askMissingAgain(bool max_frequencies = true) noexcept;

 private:
  struct Item {
    std::uint16_t number = 0;
    std::uint8_t set = 1;
    std::uint8_t index = 1;
    bool due = true;  // to be asked for, in this round or the next
  };

  void add(const Item& item) noexcept;
  void addElement(std::uint16_t number, std::uint8_t index) noexcept;
  void addFunction(std::uint16_t first_number, std::uint8_t place, std::uint8_t set) noexcept;
  void addFurtherFunctions(std::uint8_t set) noexcept;
  void addBusBits() noexcept;
  void store(const Item& item, std::int32_t raw) noexcept;
  /// Of P543 to P548, as many of them as there are places.
  void storeFunction(const Item& item, std::uint16_t function) noexcept;

  profile::Series series_;
  FixedVector<Item, 96> items_;
  std::size_t motion_items_ = 0;  // the first ones: those that decide motion
  std::size_t next_ = 0;
  std::size_t asked_ = 0;  // the one that was handed out last
  bool outdated_ = false;  // what is answered to it is not stored
  std::uint8_t attempts_ = 0;
  bool waiting_ = false;
  bool silent_ = false;  // the last question has timed out to its end
  bool restart_ = true;
  bool answered_ = false;    // the parameter channel lives
  std::uint8_t rounds_ = 0;  // in which the missing ones were asked for again
  DeviceData data_;
};

}  // namespace nord_driver::cycle
