// A DeviceNet frame in a few words: what it is, of which device, and the process data by the manual's names.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/can_frame.h"
#include "devicenet/identifier.h"
#include "nord_driver/trace/telegram_trace.h"
#include "transport/devicenet/devicenet_config.h"

namespace nord_driver {

/// "poll 5 STW 047F SW1 2000". MAC ids, classes, instances and attributes are decimal, words and values hexadecimal.
class DevicenetFrameText {
 public:
  explicit DevicenetFrameText(const DevicenetConfig& config);

  std::string operator()(const TraceRecord& record) const;

 private:
  struct Module {
    std::vector<DevicenetDrive> drives;
    std::size_t output_bytes = 0, input_bytes = 0;
  };

  std::string describe(const CanFrame& frame) const;
  std::string group2(const devicenet::Identifier& id, const CanFrame& frame) const;
  std::string processData(std::uint8_t mac, ByteView bytes, bool to_device) const;

  std::array<Module, devicenet::kMacIds> modules_{};
};

}  // namespace nord_driver
