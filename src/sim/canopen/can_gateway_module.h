// What a gateway SK CU4/TU4-CAO has of its own: its parameters and the watch over its master.
//
// P151 stops the inverters behind it, P513 does not (BU 2700 8.1, BU 0220 5.1.1); the table of BU 2700 7.1.1 rules.
// Both are printed for the sister modules; that this one does the same is inferred.
#pragma once

#include "nord_driver/core/time.h"
#include "sim/canopen/can_parameter_objects.h"
#include "sim/canopen/can_process_objects.h"

namespace nord_driver::sim {

class CanGatewayModule {
 public:
  using Drives = CanProcessObjects::Drives;

  CanGatewayModule();

  /// P150 to P199 as objects 2000h + P, with any of its SDO servers.
  static bool hasParameter(std::uint16_t index) noexcept { return index >= 0x2000 + 150 && index < 0x2000 + 200; }
  CanObjects& objects() noexcept { return objects_; }
  ParameterStore& parameters() noexcept { return parameters_; }

  /// A control word with bit 10 = 1 has come for one of the inverters.
  void validWord() noexcept;
  /// P151 > 0: no such word for that long is E10.3 in every inverter (BU 2700 7.1.1).
  void watch(Duration span, const Drives& drives) noexcept;
  /// Guarding or heartbeat is lost: E10.2 in every inverter, unless P151 = -1.
  void masterLost(const Drives& drives) noexcept;
  /// In the time-out: until the cause is gone and every inverter there is acknowledged (BU 0220 4.2.3.2).
  bool timedOut() const noexcept { return timed_out_; }
  void restart() noexcept;

 private:
  void timeOut(std::int32_t error) noexcept;

  ParameterStore parameters_;
  CanParameterObjects objects_;
  bool valid_seen_ = false;
  Duration since_valid_{0};
  bool timed_out_ = false;
  bool cause_stands_ = false;
  std::int32_t error_ = 0;
};

}  // namespace nord_driver::sim
