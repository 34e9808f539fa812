#include "transport/canopen/canopen_frame_text.h"

#include <cstdio>

#include "canopen/emergency.h"
#include "canopen/nmt.h"
#include "canopen/sdo_abort.h"
#include "core/can_trace.h"
#include "transport/canopen/canopen_map.h"
#include "transport/canopen/emergency.h"

namespace nord_driver {

namespace {

constexpr std::uint32_t kTypeMask = 0x780, kNodeMask = 0x07F;  // CiA 301 7.3.5: four bits function, seven bits node

std::string objectText(std::uint16_t index, std::uint8_t sub_index) {
  return toHexWord(index) + "h:" + std::to_string(sub_index);
}

std::string nmtText(ByteView data) {
  if (data.size() != 2) return "NMT of a wrong length";
  const std::string whom = data[1] == 0 ? "all nodes" : std::to_string(data[1]);
  return std::string("NMT ") + canopen::toText(static_cast<canopen::NmtCommand>(data[0])) + " " + whom;
}

std::string emergencyText(std::uint8_t node, ByteView data) {
  if (data.size() != 8) return "EMCY of a wrong length";
  const auto code = static_cast<std::uint16_t>(data[0] | data[1] << 8);
  const std::string faults = profile::emergencyFaults(code);
  return "EMCY " + std::to_string(node) + " " + toHexWord(code) + "h" + (faults.empty() ? "" : " (" + faults + ")") +
         ": " + profile::emergencyText(code);
}

std::string errorControlText(std::uint8_t node, const CanFrame& frame) {
  const std::string who = std::to_string(node);
  if (frame.remote) return "guarding " + who;
  if (frame.size != 1) return "error control of a wrong length, " + who;
  const canopen::NmtState state = canopen::nmtStateOf(frame.data[0] & 0x7Fu);
  return "node " + who + " " + canopen::toText(state);
}

// Of an expedited transfer: bits 2 and 3 tell how many of the four bytes carry nothing (CiA 301 7.2.4.3.3).
std::string valueText(ByteView data) {
  const std::size_t count = (data[0] & 1u) != 0 ? 4u - (data[0] >> 2 & 3u) : 4u;
  std::string text;
  for (std::size_t i = count; i > 0; --i) {
    char hex[4];
    std::snprintf(hex, sizeof hex, "%02X", data[3 + i]);
    text += hex;
  }
  return text + "h";
}

std::string sdoText(std::uint8_t node, bool to_drive, ByteView data) {
  const std::string who = "SDO " + std::to_string(node) + " ";
  if (data.size() != 8) return who + "of a wrong length";
  const auto index = static_cast<std::uint16_t>(data[1] | data[2] << 8);
  const std::string object = objectText(index, data[3]);
  const unsigned command = data[0] >> 5;
  const bool expedited = (data[0] & 2u) != 0;
  if (command == 4) {
    ByteReader reader{data.sub(4)};
    return who + "abort " + object + ": " + canopen::abortText(reader.u32le());
  }
  if (to_drive && command == 2) return who + "read " + object;
  if (to_drive && command == 1) return who + "write " + object + (expedited ? " = " + valueText(data) : " in segments");
  if (!to_drive && command == 2)
    return who + "answer " + object + (expedited ? " = " + valueText(data) : " in segments");
  if (!to_drive && command == 3) return who + "written " + object;
  return who + "segment";
}

}  // namespace

CanopenFrameText::CanopenFrameText(const CanopenConfig& config) {
  for (const CanopenDrive& drive : config.drives) {
    const canopen::NodeConfig& node = config.master.nodes[drive.node];
    pdos_[node.receive_pdos[drive.receive_pdo].cob_id] = Pdo{drive, node.id, true};
    pdos_[node.transmit_pdos[drive.transmit_pdo].cob_id] = Pdo{drive, node.id, false};
    for (const canopen::SdoChannel& channel : node.sdo_servers) {
      sdos_[channel.request_id] = Sdo{node.id, true};
      sdos_[channel.response_id] = Sdo{node.id, false};
    }
  }
}

std::string CanopenFrameText::operator()(const TraceRecord& record) const {
  const auto frame = fromPacket(record.view());
  return frame ? describe(*frame) : "no frame";
}

std::string CanopenFrameText::describe(const CanFrame& frame) const {
  if (frame.extended) return "29 bit identifier: not CANopen";
  const auto node = static_cast<std::uint8_t>(frame.id & kNodeMask);
  if ((frame.id & kTypeMask) == canopen::kErrorControlBase && node != 0) return errorControlText(node, frame);
  if (frame.remote) return "remote frame";
  if (frame.id == canopen::kNmtCobId) return nmtText(frame.bytes());
  if (frame.id == 0x080) return "SYNC";
  if ((frame.id & kTypeMask) == canopen::kEmergencyBase) return emergencyText(node, frame.bytes());
  if (const auto pdo = pdos_.find(frame.id); pdo != pdos_.end()) return processData(pdo->second, frame.bytes());
  if (const auto sdo = sdos_.find(frame.id); sdo != sdos_.end()) {
    return sdoText(sdo->second.node, sdo->second.to_drive, frame.bytes());
  }
  return "of no node of ours";
}

std::string CanopenFrameText::processData(const Pdo& pdo, ByteView bytes) const {
  std::string text = (pdo.to_drive ? "RPDO " : "TPDO ") + std::to_string(pdo.node);
  if (pdo.drive.connection == CanopenConnection::kGateway) text += "/" + std::to_string(pdo.drive.inverter);
  profile::ProcessInput values;  // the way there is laid out as the way back
  if (!unpackPdo(pdo.drive, bytes, values)) return text + " too short";
  if (pdo.drive.drive_profile == DriveProfile::kCia402) {
    return text + (pdo.to_drive ? " 6040h " : " 6041h ") + toHexWord(values.status_word) +
           (pdo.to_drive ? " 6042h " : " 6044h ") + std::to_string(values.actual_values[0]) + " rpm";
  }
  text += (pdo.to_drive ? " STW " : " ZSW ") + toHexWord(values.status_word);
  for (std::size_t i = 0; i < pdo.drive.process_values; ++i) {
    text += (pdo.to_drive ? " SW" : " IW") + std::to_string(i + 1) + " " + toHexWord(toWord(values.actual_values[i]));
  }
  return text;
}

}  // namespace nord_driver
