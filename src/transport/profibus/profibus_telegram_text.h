// A PROFIBUS telegram in a few words: the service, who to whom, and the process data by the manual's names.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "nord_driver/trace/telegram_trace.h"
#include "profibus/telegram.h"
#include "transport/profibus/ppo.h"
#include "transport/profibus/profibus_dp_config.h"

namespace nord_driver {

/// "DX 3 <- 1 STW 047F SW1 2000": data exchange to station 3 from station 1. Addresses, as PROFIBUS counts them, are
/// decimal, words hexadecimal; words of the parameter channel are left out while they are all zero.
class ProfibusTelegramText {
 public:
  explicit ProfibusTelegramText(const ProfibusDpConfig& config);

  std::string operator()(const TraceRecord& record) const;

 private:
  std::string request(const profibus::Telegram& telegram) const;
  std::string answer(const profibus::Telegram& telegram) const;
  std::string processData(std::uint8_t station, ByteView data, bool to_drive) const;

  struct Part {
    std::size_t offset = 0;
    profile::PpoLayout layout;
    std::string name;  // "" where a station has one inverter
  };
  struct Layout {
    std::size_t length = 0;
    bool io_byte = false;
    std::vector<Part> parts;
  };
  static std::string partText(const Part& part, ByteView data, bool to_drive);

  std::map<std::uint8_t, Layout> layouts_;  // by station
};

}  // namespace nord_driver
