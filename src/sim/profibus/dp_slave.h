// A simulated PROFIBUS DP-V0 slave: the bus module SK TU3-PBR(-24V), ident number 7531h, with one inverter behind it.
//
// BU 0020 7.2 and 8.2.
#pragma once

#include <array>
#include <cstdint>

#include "sim/drive_unit.h"
#include "sim/profibus/dp_config.h"
#include "sim/profibus/dp_station.h"

namespace nord_driver::sim {

class DpSlave final : public DpStation {
 public:
  /// For this drive, which is to be connected to it; both must outlive the slave. `referee` may be null.
  DpSlave(DriveUnit& drive, Referee* referee);

  Supply supply() const noexcept override { return Supply::kInverter; }
  void inverterPlugged(bool plugged) noexcept override { setPowered(plugged); }

 private:
  bool takeConfiguration(ByteView identifiers) noexcept override;
  Configuration configuration() const noexcept override;
  std::size_t dataLength() const noexcept override;
  void appendInputs(Data& data) const noexcept override;
  void takeOutputs(ByteView data) noexcept override;
  void clearOutputs() noexcept override;
  void enterDataExchange() noexcept override { valid_data_seen_ = false; }
  /// E10.8 in an inverter whose link is broken, diagnosis 02 04 in the module.
  bool inverterMissing() const noexcept override { return !present(0); }
  void masterLost() noexcept override;
  void supplyChanged(bool /*on*/) noexcept override { valid_data_seen_ = false; }
  void showStatus() noexcept override;
  unsigned displayElement(unsigned value) const noexcept;
  /// SK 300E/7x0E: SW3 and IW3 come before SW2 and IW2 (BU 0020 7.2.2).
  void display(unsigned number, bool wide, const std::array<Word, 3>& values) noexcept;
  bool swapsWords() const noexcept { return parameters_.device().isOlderSeries(); }

  DpDriveConfig settings_;
  ParameterStore& parameters_;
  InverterModel& inverter_;
  PkwServer& pkw_;
  bool valid_data_seen_ = false;
};

}  // namespace nord_driver::sim
