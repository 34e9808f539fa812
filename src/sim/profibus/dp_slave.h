// A simulated PROFIBUS DP-V0 slave: the bus module SK TU3-PBR(-24V), ident number 7531h, with one inverter behind it.
//
// BU 0020 7.2 and 8.2.
#pragma once

#include <cstdint>

#include "sim/inverter/inverter_model.h"
#include "sim/profibus/dp_station.h"
#include "sim/profibus/pkw_server.h"

namespace nord_driver::sim {

struct SlaveSettings {
  std::uint8_t address = 126;
  int ppo_type = 1;              ///< 1-4, set by switch or P507; behind a module with slots the master chooses
  bool swap_words_3_4 = false;   ///< SK 300E/7x0E: SW3 and IW3 come before SW2 and IW2 (BU 0020 7.2.2)
  std::uint16_t ident = 0x7531;  ///< BU 0020 10.2
};

class DpSlave final : public DpStation {
 public:
  /// All must outlive the slave; `referee` may be null.
  DpSlave(const SlaveSettings& settings, ParameterStore& parameters, InverterModel& inverter, PkwServer& pkw,
          Referee* referee);

  /// The connection between module and inverter: E10.8 in the inverter, diagnosis 02 04 in the module.
  void setInverterLink(bool intact) noexcept override;

  const SlaveSettings& settings() const noexcept { return settings_; }

 private:
  bool takeConfiguration(ByteView identifiers) noexcept override;
  Configuration configuration() const noexcept override;
  std::size_t dataLength() const noexcept override;
  void appendInputs(Data& data) const noexcept override;
  void takeOutputs(ByteView data) noexcept override;
  void clearOutputs() noexcept override;
  void enterDataExchange() noexcept override { valid_data_seen_ = false; }
  bool inverterMissing() const noexcept override { return !inverter_link_ || !inverter_.powered(); }
  void masterLost() noexcept override;
  void supplyChanged(bool /*on*/) noexcept override { valid_data_seen_ = false; }
  void showStatus() noexcept override;
  unsigned displayElement(unsigned value) const noexcept;

  SlaveSettings settings_;
  ParameterStore& parameters_;
  InverterModel& inverter_;
  PkwServer& pkw_;
  bool inverter_link_ = true;
  bool valid_data_seen_ = false;
};

}  // namespace nord_driver::sim
