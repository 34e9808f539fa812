// The simulated bus module SK CU4-PBR or SK TU4-PBR, ident number 0BA8h: its own inputs and outputs in slot 1, up to
// four inverters on its system bus in slots 2 to 5, its own 24 V, its own parameters.
//
// BU 0220 4.2 and 5.2, BU 2700 7.1 and 8.1.
#pragma once

#include <array>
#include <cstdint>

#include "sim/inverter/pkw_server.h"
#include "sim/module_parameters.h"
#include "sim/profibus/dp_config.h"
#include "sim/profibus/dp_station.h"

namespace nord_driver::sim {

class ModuleStation final : public DpStation, private RecordDevices {
 public:
  /// `referee` may be null and must outlive the station.
  ModuleStation(const ModuleSettings& settings, Referee* referee);

  Supply supply() const noexcept override { return Supply::kOwn; }
  ExchangeCounters countersOf(unsigned place) const noexcept override;

  /// DO1 and DO2 in bits 0 and 1: by the bus, by P150, 0 in a time-out.
  std::uint8_t outputs() const noexcept override;
  bool setInputs(std::uint8_t inputs) noexcept override {
    settings_.inputs = inputs & 0x0Fu;
    return true;
  }
  /// In the time-out: until the cause is gone and every inverter there is acknowledged (BU 0220 4.2.3.2).
  bool timedOut() const noexcept { return timed_out_; }
  ParameterStore& parameters() noexcept { return parameters_; }
  RecordSettings& recordSettings() noexcept { return records_.settings(); }
  Class2Server& connections() noexcept { return class2_; }

 private:
  /// FI1 to FI4; a broken link to one of them is E10.9 in the inverter (P120), diagnosis 02 04 in the module.
  struct Place {
    int ppo_type = 1;   // what Get_Cfg says before a master has chosen
    bool seen = false;  // was there since the module has its 24 V
    bool valid_data_seen = false;
    PkwWords refused;  // what the module answers itself to an order for an inverter that is not there
    ExchangeCounters counters;
  };
  /// What lies in a telegram for one slot.
  struct Slot {
    PkwWords order;
    bool has_order = false;
    ProcessData process;
  };

  void connected(unsigned place) noexcept override;
  bool takeConfiguration(ByteView identifiers) noexcept override;
  Configuration configuration() const noexcept override { return configuration_; }
  std::size_t dataLength() const noexcept override;
  void appendInputs(Data& data) const noexcept override;
  void outputsArrived(ByteView data) noexcept override;
  void takeOutputs(ByteView data) noexcept override;
  void clearOutputs() noexcept override;
  void enterDataExchange() noexcept override;
  bool inverterMissing() const noexcept override;
  void masterLost() noexcept override;
  void supplyChanged(bool on) noexcept override;
  void watch(Duration span) noexcept override;
  void showStatus() noexcept override;
  RecordServer* records() noexcept override { return &records_; }
  Class2Server* class2() noexcept override { return &class2_; }
  PkwWords executeRecord(unsigned device, const PkwWords& order) noexcept override;
  std::optional<std::uint8_t> recordRefusal(unsigned device, const PkwWords& order, bool at_answer) noexcept override;

  bool hasIoByte() const noexcept { return !configuration_.empty() && configuration_[0] != 0; }
  bool configured(unsigned place) const noexcept {
    return place + 1 < configuration_.size() && configuration_[place + 1] != 0;
  }
  static Slot readSlot(std::uint8_t identifier, ByteReader& reader) noexcept;
  void command(unsigned place, const Slot& slot) noexcept;
  void order(unsigned place, const PkwWords& order) noexcept;
  Word absence(unsigned place) const noexcept;
  void timeOut(std::int32_t error) noexcept;
  void endTimeOut() noexcept;
  void beginAsBuilt() noexcept;
  std::int32_t moduleStatus() const noexcept;

  ModuleSettings settings_;
  ParameterStore parameters_;
  PkwServer own_pkw_;
  RecordServer records_;
  Class2Server class2_;
  std::array<Place, kPlaces> places_{};
  Configuration configuration_;
  std::uint8_t output_byte_ = 0;

  bool valid_data_seen_ = false;  // P151 watches from the first valid control word on
  Duration since_valid_{0};
  bool cause_stands_ = false;
  bool timed_out_ = false;
  std::int32_t error_ = 0;  // what P170[-01] shows
};

}  // namespace nord_driver::sim
