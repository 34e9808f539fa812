// A CANopen frame in a few words: what it is, of which node, and the process data by the manual's names.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "core/can_frame.h"
#include "nord_driver/trace/telegram_trace.h"
#include "transport/canopen/canopen_config.h"

namespace nord_driver {

/// "RPDO 50 STW 047F SW1 2000". Node ids, as CANopen counts them, are decimal, words and objects hexadecimal.
class CanopenFrameText {
 public:
  explicit CanopenFrameText(const CanopenConfig& config);

  std::string operator()(const TraceRecord& record) const;

 private:
  struct Pdo {
    CanopenDrive drive;
    std::uint8_t node = 0;
    bool to_drive = false;
  };
  struct Sdo {
    std::uint8_t node = 0;
    bool to_drive = false;
  };

  std::string describe(const CanFrame& frame) const;
  std::string processData(const Pdo& pdo, ByteView bytes) const;

  std::map<std::uint32_t, Pdo> pdos_;  // by COB-ID
  std::map<std::uint32_t, Sdo> sdos_;
};

}  // namespace nord_driver
