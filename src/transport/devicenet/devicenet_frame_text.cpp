#include "transport/devicenet/devicenet_frame_text.h"

#include <cstdio>

#include "core/can_trace.h"
#include "devicenet/device_message.h"
#include "devicenet/duplicate_mac.h"
#include "devicenet/explicit_message.h"
#include "devicenet/fragment.h"
#include "transport/devicenet/assembly.h"
#include "transport/devicenet/explicit_refusal.h"

namespace nord_driver {

using devicenet::Group1;
using devicenet::Group2;

namespace {

constexpr unsigned kFragmentBit = 0x80, kMacMask = 0x3F, kResponseBit = 0x80;
constexpr std::uint8_t kError = 0x14;

// Least significant byte first on the wire, most significant first for people.
std::string valueText(ByteView data) {
  std::string text;
  for (std::size_t i = data.size(); i > 0; --i) {
    char hex[4];
    std::snprintf(hex, sizeof hex, "%02X", data[i - 1]);
    text += hex;
  }
  return text + "h";
}

std::string parameterText(unsigned class_id, unsigned attribute) {
  if (class_id >= 100 && class_id < 140) {
    const unsigned number = (class_id - 100) % 10 * 100 + attribute;
    return " (P" + std::to_string(number) + " of inverter " + std::to_string((class_id - 100) / 10 + 1) + ")";
  }
  if (class_id == 181) return " (P" + std::to_string(100 + attribute) + " of the module)";
  return {};
}

std::string choiceText(unsigned choice) {
  static constexpr std::array<const char*, 7> kNames{"explicit",        "poll",   "bit strobe",     "multicast poll",
                                                     "change of state", "cyclic", "no acknowledges"};
  std::string text;
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if ((choice >> i & 1u) != 0) text += (text.empty() ? "" : ", ") + std::string(kNames[i]);
  }
  return text.empty() ? "nothing" : text;
}

std::string fragmentText(std::uint8_t byte) {
  static constexpr std::array<const char*, 4> kTypes{"first", "middle", "last", "acknowledge"};
  const devicenet::Fragment fragment = devicenet::Fragment::from(byte);
  const bool only = fragment.type == devicenet::FragmentType::kFirst && fragment.count == devicenet::kOnlyFragment;
  if (only) return "fragment, the only one";
  return "fragment " + std::to_string(fragment.count) + ", " + kTypes[static_cast<std::size_t>(fragment.type)];
}

std::string requestText(const std::string& who, ByteView body) {
  if (body.size() < 3) return who + "too short";
  const unsigned service = body[0], class_id = body[1], instance = body[2];
  if (service == devicenet::service::kAllocate && body.size() >= 5) {
    return who + "allocate " + choiceText(body[3]) + " for MAC id " + std::to_string(body[4]);
  }
  if (service == devicenet::service::kRelease && body.size() >= 4) return who + "release " + choiceText(body[3]);
  std::string object = " class " + std::to_string(class_id) + " instance " + std::to_string(instance);
  if (body.size() >= 4) object += " attribute " + std::to_string(body[3]) + parameterText(class_id, body[3]);
  if (service == devicenet::service::kGetAttributeSingle) return who + "read" + object;
  if (service == devicenet::service::kSetAttributeSingle) {
    return who + "write" + object + " = " + valueText(body.sub(4));
  }
  return who + "service " + std::to_string(service) + object;
}

std::string responseText(const std::string& who, ByteView body) {
  if (body.empty()) return who + "too short";
  const unsigned service = body[0] & ~kResponseBit;
  if (service == kError && body.size() >= 3) return who + errorSentence(body[1], body[2]).str();
  const std::string value = body.size() > 1 ? " " + valueText(body.sub(1)) : std::string{};
  if (service == devicenet::service::kAllocate) return who + "allocated";
  if (service == devicenet::service::kRelease) return who + "released";
  if (service == devicenet::service::kSetAttributeSingle) return who + "written" + value;
  return who + "answer" + value;
}

std::string explicitText(std::uint8_t mac, const CanFrame& frame) {
  const std::string who = "explicit " + std::to_string(mac) + " ";
  if (frame.size < 2) return who + "too short";
  if (devicenet::isDeviceMessage(frame, mac)) {
    if (const auto heartbeat = devicenet::readHeartbeat(frame)) {
      return "device " + std::to_string(mac) + " " + devicenet::heartbeatText(*heartbeat).str();
    }
    return "device " + std::to_string(mac) + " shuts down";
  }
  if ((frame.data[0] & kFragmentBit) != 0) return who + fragmentText(frame.data[1]);
  const ByteView body = frame.bytes().sub(1);
  return (body[0] & kResponseBit) != 0 ? responseText(who, body) : requestText(who, body);
}

std::string duplicateMacText(std::uint8_t mac, const CanFrame& frame) {
  const auto message = devicenet::readDuplicateMac(frame);
  const std::string who = std::to_string(mac);
  if (!message) return "duplicate-MAC message of a wrong length, " + who;
  char sender[48];
  std::snprintf(sender, sizeof sender, "vendor %u serial %08X", unsigned{message->sender.vendor_id},
                message->sender.serial_number);
  return (message->response ? "MAC id " + who + " is taken, " : "is MAC id " + who + " free? ") + sender;
}

}  // namespace

DevicenetFrameText::DevicenetFrameText(const DevicenetConfig& config) {
  for (std::size_t i = 0; i < config.modules.size(); ++i) {
    Module& module = modules_[config.modules[i].mac];
    for (const std::size_t drive : config.modules[i].drives) module.drives.push_back(config.drives[drive]);
    module.output_bytes = config.scanner.nodes[i].io.output_bytes;
    module.input_bytes = config.scanner.nodes[i].io.input_bytes;
  }
}

std::string DevicenetFrameText::operator()(const TraceRecord& record) const {
  const auto frame = fromPacket(record.view());
  return frame ? describe(*frame) : "no frame";
}

std::string DevicenetFrameText::describe(const CanFrame& frame) const {
  if (frame.extended) return "29 bit identifier: not DeviceNet";
  const auto id = devicenet::readIdentifier(frame.id);
  if (!id) return "no identifier of DeviceNet";
  if (frame.remote) return "remote frame: DeviceNet has none";
  if (id->group == 2) return group2(*id, frame);
  if (id->group == 1 && id->message >= static_cast<std::uint8_t>(Group1::kMulticastPollResponse)) {
    const std::string who = std::to_string(id->mac);
    const bool answer = id->message == static_cast<std::uint8_t>(Group1::kPollResponse);
    if (answer && frame.size == 0) return "acknowledge or empty answer " + who;
    const char* kind = answer                                                              ? "answer "
                       : id->message == static_cast<std::uint8_t>(Group1::kStrobeResponse) ? "strobe answer "
                                                                                           : "data ";
    return kind + who + processData(id->mac, frame.bytes(), false);
  }
  return "group " + std::to_string(id->group) + " message " + std::to_string(id->message) + ": of no device of ours";
}

std::string DevicenetFrameText::group2(const devicenet::Identifier& id, const CanFrame& frame) const {
  const std::string who = std::to_string(id.mac);
  switch (static_cast<Group2>(id.message)) {
    case Group2::kStrobeCommand:
      return "strobe by MAC id " + who;
    case Group2::kMulticastPoll:
      return "multicast poll " + who;
    case Group2::kMasterAcknowledge:
      return "acknowledge to " + who;
    case Group2::kSlaveExplicit:
    case Group2::kMasterExplicit:
    case Group2::kUnconnected:
      return explicitText(id.mac, frame);
    case Group2::kMasterIo:
      return "poll " + who + processData(id.mac, frame.bytes(), true);
    case Group2::kDuplicateMac:
      return duplicateMacText(id.mac, frame);
  }
  return "unknown";
}

std::string DevicenetFrameText::processData(std::uint8_t mac, ByteView bytes, bool to_device) const {
  const Module& module = modules_[mac & kMacMask];
  const std::size_t size = to_device ? module.output_bytes : module.input_bytes;
  if (module.drives.empty()) return " of no device of ours";
  if (size > kCanDataLength) return bytes.empty() ? " empty" : " " + fragmentText(bytes[0]);
  std::string text;
  for (const DevicenetDrive& drive : module.drives) {
    DevicenetDrive place = drive;
    if (to_device) {
      place.status_offset = drive.control_offset;  // the way there is laid out as the way back
      place.status_bytes = drive.control_bytes;
    }
    if (module.drives.size() > 1) text += " inverter " + std::to_string(drive.inverter);
    profile::ProcessInput values;
    profile::AcDriveInput ac;
    if (drive.drive_profile == DevicenetProfile::kNord && unpackWords(place, bytes, values)) {
      text += (to_device ? " STW " : " ZSW ") + toHexWord(values.status_word);
      for (std::size_t i = 0; i + 1 < place.status_bytes / 2; ++i) {
        text += (to_device ? " SW" : " IW") + std::to_string(i + 1) + " " + toHexWord(toWord(values.actual_values[i]));
      }
    } else if (drive.drive_profile != DevicenetProfile::kNord && unpackAcDrive(place, bytes, ac)) {
      char hex[32];
      std::snprintf(hex, sizeof hex, " bits %02X state %u ", unsigned{ac.status}, unsigned{ac.state});
      text += hex + std::to_string(ac.speed) + " rpm";
    } else {
      text += " too short";
    }
  }
  return text;
}

}  // namespace nord_driver
