#include "canopen/scripted_node.h"

#include <cstdio>

#include "support/can_text.h"

namespace nord_driver::canopen {
namespace {

std::string accessText(std::uint16_t index, std::uint8_t sub, std::uint32_t value) {
  char text[32];
  std::snprintf(text, sizeof text, "%04X:%02X=%X", unsigned{index}, unsigned{sub}, static_cast<unsigned>(value));
  return text;
}

}  // namespace

// The defaults of BU 0060 1.4: RPDO 1 = control word and setpoint 1, TPDO 1 = status word and actual value 1.
ScriptedNode::ScriptedNode(std::uint8_t id) : id_{id} {
  object(0x1000, 0) = {0x00000000, 4, true};
  object(0x1001, 0) = {0x00, 1, true};
  object(0x1003, 0) = {0x00, 1, false};
  object(0x100C, 0) = {0, 2, false};
  object(0x100D, 0) = {0, 1, false};
  object(0x1016, 1) = {0, 4, false};
  object(0x1017, 0) = {0, 2, false};
  object(0x1018, 1) = {0x000001E2, 4, true};
  object(0x1018, 2) = {0x0000000C, 4, true};
  object(0x1018, 3) = {0x00010002, 4, true};
  object(0x1018, 4) = {0x12345678, 4, true};
  object(0x1400, 1) = {0x40000200u + id, 4, false};
  object(0x1400, 2) = {255, 1, false};
  object(0x1401, 1) = {0x40000300u + id, 4, false};
  object(0x1401, 2) = {255, 1, false};
  object(0x1600, 0) = {2, 1, false};
  object(0x1600, 1) = {0x30000010, 4, false};
  object(0x1600, 2) = {0x30020110, 4, false};
  object(0x1601, 0) = {4, 1, false};
  object(0x1601, 1) = {0x30000010, 4, false};
  object(0x1601, 2) = {0x30020110, 4, false};
  object(0x1601, 3) = {0x30020210, 4, false};
  object(0x1601, 4) = {0x30020310, 4, false};
  object(0x1800, 1) = {0x40000180u + id, 4, false};
  object(0x1800, 2) = {255, 1, false};
  object(0x1800, 3) = {100, 2, false};
  object(0x1800, 5) = {250, 2, false};
  object(0x1801, 1) = {0xC0000280u + id, 4, false};
  object(0x1801, 2) = {255, 1, false};
  object(0x1801, 3) = {100, 2, false};
  object(0x1801, 5) = {250, 2, false};
  for (const std::uint16_t mapping : {std::uint16_t{0x1A00}, std::uint16_t{0x1A01}}) {
    object(mapping, 0) = {2, 1, false};
    object(mapping, 1) = {0x30010010, 4, false};
    object(mapping, 2) = {0x30030110, 4, false};
    object(mapping, 3) = {0, 4, false};
    object(mapping, 4) = {0, 4, false};
  }
  object(0x2066, 1) = {103, 2, false};
}

void ScriptedNode::powerOn(Instant now) {
  powered = true;
  state = 0x7F;
  toggle_ = 0;
  guards = 0;
  char text[16];
  std::snprintf(text, sizeof text, "7%02X#00", unsigned{id_});
  if (sends_boot_up) say(text, now + boot_time);
}

void ScriptedNode::powerOff() {
  powered = false;
  out_.clear();
}

void ScriptedNode::say(const std::string& candump, Instant at) {
  auto place = out_.end();
  while (place != out_.begin() && std::prev(place)->first > at) --place;
  out_.insert(place, {at, frame(candump)});
}

bool ScriptedNode::next(Instant now, CanFrame& frame) {
  if (!powered || out_.empty() || out_.front().first > now) return false;
  frame = out_.front().second;
  out_.pop_front();
  return true;
}

void ScriptedNode::tick(Instant now) {
  const auto producer = dictionary_.find({0x1017, 0});
  const std::uint32_t period = producer == dictionary_.end() ? 0 : producer->second.value;
  if (!powered || period == 0 || !sends_heartbeat || now < next_heartbeat_) return;
  next_heartbeat_ = now + std::chrono::milliseconds{period};
  char text[16];
  std::snprintf(text, sizeof text, "7%02X#%02X", unsigned{id_}, unsigned{state});
  say(text, now);
}

void ScriptedNode::receive(const CanFrame& frame, Instant now) {
  if (!powered) return;
  if (frame.id == 0x000 && frame.size == 2 && (frame.data[1] == 0 || frame.data[1] == id_)) {
    handleNmt(frame.data[0], now);
  } else if (frame.remote && frame.id == 0x700u + id_) {
    ++guards;
    if (!answers_guarding) return;
    char text[16];
    std::snprintf(text, sizeof text, "7%02X#%02X", unsigned{id_}, unsigned{toggle_} | unsigned{state});
    say(text, now + std::chrono::milliseconds{1});
    if (toggles) toggle_ ^= 0x80;
  } else if (frame.id == 0x600u + id_) {
    if (hears_sdo && state != 0x04) handleSdo(frame, now);  // stopped: NMT and error control only (CiA 301)
  } else if (frame.id == 0x080) {
    ++syncs;
    if (state == 0x05 && object(0x1800, 2).value <= 240) sendTransmitPdo(now + std::chrono::milliseconds{1});
  } else {
    handlePdo(frame);
  }
}

void ScriptedNode::handleNmt(std::uint8_t command, Instant now) {
  if (command == 0x01 && !refuses_start) state = 0x05;
  if (command == 0x02) state = 0x04;
  if (command == 0x80) state = 0x7F;
  if (command == 0x81 || command == 0x82) {
    ++resets;
    out_.clear();
    powerOn(now);
  }
  if (state == 0x05) sendTransmitPdo(now + std::chrono::milliseconds{1});
}

void ScriptedNode::sendTransmitPdo(Instant at) {
  if ((object(0x1800, 1).value & 0x80000000) != 0) return;
  char text[32];
  std::snprintf(text, sizeof text, "%03X#310B0000", static_cast<unsigned>(object(0x1800, 1).value & 0x7FF));
  say(text, at);
}

void ScriptedNode::handlePdo(const CanFrame& frame) {
  for (const std::uint16_t parameter : {std::uint16_t{0x1400}, std::uint16_t{0x1401}}) {
    const std::uint32_t entry = object(parameter, 1).value;
    if ((entry & 0x80000000) != 0 || (entry & 0x7FF) != frame.id) continue;
    received_pdos.push_back(text(frame));
    if (state != 0x05) violations.push_back("RPDO while not operational: " + text(frame));
  }
}

void ScriptedNode::handleSdo(const CanFrame& frame, Instant now) {
  if (frame.size != 8) return violations.push_back("an SDO of another length: " + text(frame));
  const std::array<std::uint8_t, 8>& d = frame.data;
  const auto index = static_cast<std::uint16_t>(d[1] | d[2] << 8);
  const auto value = static_cast<std::uint32_t>(d[4]) | static_cast<std::uint32_t>(d[5]) << 8 |
                     static_cast<std::uint32_t>(d[6]) << 16 | static_cast<std::uint32_t>(d[7]) << 24;
  switch (d[0]) {
    case 0x40:
      return read(index, d[3], now);
    case 0x2F:
      return write(index, d[3], value, 1, now);
    case 0x2B:
      return write(index, d[3], value, 2, now);
    case 0x23:
      return write(index, d[3], value, 4, now);
    default:
      return;  // an abort
  }
}

void ScriptedNode::read(std::uint16_t index, std::uint8_t sub, Instant now) {
  ++reads;
  const auto found = dictionary_.find({index, sub});
  if (found == dictionary_.end()) return abort(index, sub, sub == 0 ? 0x06020000 : 0x06090011, now);
  const Entry& entry = found->second;
  const unsigned command = entry.size == 1 ? 0x4F : entry.size == 2 ? 0x4B : 0x43;
  char text[32];
  std::snprintf(text, sizeof text, "%03X#%02X%02X%02X%02X%02X%02X%02X%02X", 0x580u + id_, command, index & 0xFFu,
                static_cast<unsigned>(index >> 8), unsigned{sub}, static_cast<unsigned>(entry.value & 0xFF),
                static_cast<unsigned>(entry.value >> 8 & 0xFF), static_cast<unsigned>(entry.value >> 16 & 0xFF),
                static_cast<unsigned>(entry.value >> 24));
  say(text, now + sdo_delay);
}

void ScriptedNode::write(std::uint16_t index, std::uint8_t sub, std::uint32_t value, std::uint8_t size, Instant now) {
  writes.push_back(accessText(index, sub, value));
  const auto found = dictionary_.find({index, sub});
  if (found == dictionary_.end()) return abort(index, sub, sub == 0 ? 0x06020000 : 0x06090011, now);
  if (found->second.read_only) return abort(index, sub, 0x06010002, now);
  if (found->second.size != size) return abort(index, sub, 0x06070010, now);
  judge(index, sub, value);
  found->second.value = value;
  char text[32];
  std::snprintf(text, sizeof text, "%03X#60%02X%02X%02X00000000", 0x580u + id_, index & 0xFFu,
                static_cast<unsigned>(index >> 8), unsigned{sub});
  say(text, now + sdo_delay);
}

void ScriptedNode::abort(std::uint16_t index, std::uint8_t sub, std::uint32_t code, Instant now) {
  char text[32];
  std::snprintf(text, sizeof text, "%03X#80%02X%02X%02X%02X%02X%02X%02X", 0x580u + id_, index & 0xFFu,
                static_cast<unsigned>(index >> 8), unsigned{sub}, static_cast<unsigned>(code & 0xFF),
                static_cast<unsigned>(code >> 8 & 0xFF), static_cast<unsigned>(code >> 16 & 0xFF),
                static_cast<unsigned>(code >> 24));
  say(text, now + sdo_delay);
}

// The order of CiA 301 7.5.2.36 and 7.5.2.35, and BU 0060 p. 63: changes in pre-operational only, bit 30 always 1.
void ScriptedNode::judge(std::uint16_t index, std::uint8_t sub, std::uint32_t value) {
  const std::uint16_t kind = index & 0xFE00;
  const bool parameter = kind == 0x1400 || kind == 0x1800;
  const bool mapping = kind == 0x1600 || kind == 0x1A00;
  if (!parameter && !mapping) return;
  const std::string what = accessText(index, sub, value);
  if (state != 0x7F) violations.push_back("not in pre-operational: " + what);
  const auto parameter_index = static_cast<std::uint16_t>(parameter ? index : index - 0x200);
  const std::uint32_t present = object(parameter_index, 1).value;
  const bool exists = (present & 0x80000000) == 0;
  if (parameter && sub == 1) {
    if ((value & 0x40000000) == 0) violations.push_back("bit 30 taken away: " + what);
    if (exists && (value & 0x3FFFFFFF) != (present & 0x3FFFFFFF)) violations.push_back("changed while on: " + what);
  } else if (exists) {
    violations.push_back("written while the PDO exists: " + what);
  }
  if (mapping && sub != 0 && object(index, 0).value != 0)
    violations.push_back("entry while the count is not 0: " + what);
}

}  // namespace nord_driver::canopen
