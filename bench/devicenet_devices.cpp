#include "devicenet_devices.h"

#include <algorithm>
#include <initializer_list>

namespace nord_driver::bench {

namespace {

// Message ids of Group 2 (400h and on); the poll response is of Group 1.
constexpr canid_t kGroup2 = 0x400, kPollResponse = 0x3C0;
constexpr canid_t kExplicitResponse = 3, kExplicitRequest = 4, kPoll = 5, kUnconnected = 6;
constexpr std::uint8_t kResponse = 0x80, kAllocate = 0x4B, kGet = 0x0E, kSet = 0x10;
constexpr std::uint8_t kConnection = 5, kProduced = 7, kConsumed = 8, kAssemblyBytes = 5;

can_frame frameOf(canid_t id, std::initializer_list<std::uint8_t> bytes) {
  can_frame frame{};
  frame.can_id = id;
  frame.can_dlc = static_cast<std::uint8_t>(bytes.size());
  std::copy(bytes.begin(), bytes.end(), frame.data);
  return frame;
}

can_frame answerTo(const can_frame& request, canid_t id) {
  const std::uint8_t header = request.data[0], service = request.data[1];
  const auto response = static_cast<std::uint8_t>(service | kResponse);
  if (service == kAllocate) return frameOf(id, {header, response, 0});
  if (service == kSet) return frameOf(id, {header, response, request.data[5], request.data[6]});
  if (service != kGet) return frameOf(id, {header, response});
  const bool size = request.data[2] == kConnection && (request.data[4] == kProduced || request.data[4] == kConsumed);
  return frameOf(id, {header, response, size ? kAssemblyBytes : std::uint8_t{200}, 0});
}

}  // namespace

bool DevicenetDevices::operator()(const can_frame& frame, const CanSay& say) const {
  const canid_t mac = frame.can_id >> 3 & 0x3F, message = frame.can_id & 7;
  if (frame.can_id < kGroup2 || mac == 0 || mac > devices_) return true;
  if (message == kPoll) return say(frameOf(kPollResponse | mac, {0x00, 0x31, 0x0B, 0x00, 0x00}));  // BU 0280 4.2.4
  if (message != kExplicitRequest && message != kUnconnected) return true;
  return say(answerTo(frame, kGroup2 | mac << 3 | kExplicitResponse));
}

}  // namespace nord_driver::bench
