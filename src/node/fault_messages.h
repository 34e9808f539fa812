// ~<drive>/fault: when a message is due, and what is in it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "catalogue/fault_words.h"
#include "cycle/snapshot.h"
#include "node/stamps.h"
#include "nord_driver/Fault.h"

namespace nord_driver::node {

/// Of one drive. Polled with the newest snapshot; a fault that came and went between two of them is told all the same.
class FaultMessages {
 public:
  FaultMessages(std::string drive, catalogue::FaultWords words);

  /// The messages that are due, in their order: that there is no fault, once the drive has answered; a fault when it is
  /// first seen, again with each thing that has become known of it; and that it is gone, when the inverter does not
  /// report it any more and it is acknowledged.
  std::vector<Fault> poll(const cycle::DriveSnapshot& drive, const Stamps& stamps);

 private:
  /// What a message tells: another one is due when it changes.
  struct Told {
    std::uint64_t faults = 0;
    std::uint16_t number = 0;
    bool active = false;
    bool history = false;
  };

  /// A message about the fault there is, or was last.
  Fault fault(const cycle::DriveSnapshot& drive, std::uint16_t number) const;
  Fault noFault(ros::Time stamp) const;
  void begin(const cycle::DriveSnapshot& drive, const Stamps& stamps);

  std::string drive_;
  catalogue::FaultWords words_;
  bool met_ = false;  // the drive has answered
  Told told_;
  Fault begun_;  // what of the message does not change while the fault stands
};

}  // namespace nord_driver::node
