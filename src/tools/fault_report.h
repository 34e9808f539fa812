// What a drive tells of its faults: the one that stands, warning and switch-on block, and the last five.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/drive_parameters.h"

namespace nord_driver::tools {

struct FaultReport {
  /// What the inverter stored with a fault, as far as the catalogue knows the parameter.
  struct Value {
    std::string name;  ///< in the catalogue
    std::string text;  ///< with its unit
    double value = 0.0;
    std::string unit;
  };
  struct Item {
    std::string title;                 ///< "current error", "last fault 2"
    std::optional<std::uint16_t> raw;  ///< ten times the number on the display; nothing: the inverter does not tell
    std::string label;                 ///< "E10.2" of faults, "10.2" of warnings and blocks; empty for 0
    std::string name;                  ///< these three are empty where nobody says
    std::string cause;
    std::string remedy;
    std::string why_not;  ///< why it could not be read, a sentence
    std::vector<Value> values;
  };

  Item error;              ///< P700[-01]
  Item warning;            ///< P700[-02]
  Item block;              ///< P700[-03], the reason of a switch-on block
  std::vector<Item> last;  ///< P701[-01] to [-05], the newest first
  std::string note;        ///< what reading has changed, a sentence; empty: nothing
};

/// P700, P701, and what P702 to P706 and P799 keep of each fault where the catalogue knows these. What the inverter
/// refuses is left out with its reason. Throws Trouble when it does not answer, or when `end_asked`.
FaultReport readFaults(DriveParameters& drive, const std::atomic<bool>& end_asked);

std::string faultText(const FaultReport& report, const DriveParameters& drive);
/// One object, one line.
std::string faultJson(const FaultReport& report, const DriveParameters& drive);

}  // namespace nord_driver::tools
