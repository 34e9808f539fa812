// The faults that stand, for those who answer services: the cycle tells numbers and reads no catalogue.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "catalogue/fault_words.h"
#include "cycle/snapshot.h"

namespace nord_driver::node {

/// Written by the thread that reads the snapshots, read by any.
class FaultBoard {
 public:
  /// One name and one FaultWords per drive.
  FaultBoard(std::vector<std::string> names, std::vector<catalogue::FaultWords> words);

  /// Takes the number of each drive: of a fault that stands, or of one that is latched still.
  void post(const cycle::CycleSnapshot& snapshot) noexcept;

  /// "drive left: E2.1, motor overtemperature (I2t); remedy: let it cool down; ...", one sentence per drive with a known
  /// number; of all drives with kAllDrives. Empty when there is none.
  std::string text(DriveIndex drive) const;

 private:
  std::vector<std::string> names_;
  std::vector<catalogue::FaultWords> words_;
  std::deque<std::atomic<std::uint16_t>> numbers_;
};

}  // namespace nord_driver::node
