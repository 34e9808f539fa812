#include "canopen/eds_check.h"

#include <algorithm>
#include <cstdio>
#include <optional>

namespace nord_driver::canopen {

namespace {

constexpr std::uint32_t kOff = 0x80000000;  // bit 31 of a COB-ID entry
constexpr std::uint32_t kIdMask = 0x7FF;
constexpr std::uint16_t kReceiveParameters = 0x1400, kTransmitParameters = 0x1800;
constexpr std::uint16_t kMappingOffset = 0x0200;
constexpr std::uint16_t kLastDummy = 0x0007;
constexpr std::uint8_t kCobId = 1, kType = 2, kInhibitTime = 3, kEventTimer = 5;
constexpr std::uint8_t kLastMappedObject = 64;

std::string hex(std::uint64_t value, int digits) {
  char text[24];
  std::snprintf(text, sizeof text, "%0*llXh", digits, static_cast<unsigned long long>(value));
  return text;
}

std::string place(std::uint16_t index, unsigned sub_index) {
  return hex(index, 4) + ":" + std::to_string(sub_index);
}

/// Where the file does not tell, the node is given the benefit of the doubt.
bool mayWrite(const EdsObject& object) {
  return object.access == EdsAccess::kUnknown || object.writable();
}

/// The mapping a node has by itself; nothing when the file does not tell, or when it does not fit a PdoConfig.
std::optional<decltype(PdoConfig::mapping)> defaultMapping(const EdsFile& file, std::uint16_t index,
                                                           std::uint8_t node) {
  const auto count = file.value(index, 0, node);
  if (!count || *count > kMaxMappedObjects) return std::nullopt;
  decltype(PdoConfig::mapping) mapping;
  for (std::uint8_t i = 1; i <= *count; ++i) {
    const auto entry = file.value(index, i, node);
    if (!entry || *entry % 8 != 0 || *entry > 0xFFFFFFFF) return std::nullopt;
    mapping.push_back({static_cast<std::uint16_t>(*entry >> 16), static_cast<std::uint8_t>(*entry >> 8 & 0xFFu),
                       static_cast<std::uint8_t>(*entry & 0xFFu)});
  }
  return mapping;
}

class EdsCheck {
 public:
  EdsCheck(const NodeConfig& config, const EdsFile& file) : config_(config), file_(file) {}

  std::vector<std::string> run(std::uint32_t bits_per_second) {
    identity("device type", config_.device_type, file_.device_type);
    identity("vendor id", config_.vendor_id, file_.vendor_id);
    identity("product code", config_.product_code, file_.product_code);
    identity("revision number", config_.revision_number, file_.revision_number);
    const auto& rates = file_.bit_rates;
    if (bits_per_second != 0 && !rates.empty() && std::count(rates.begin(), rates.end(), bits_per_second) == 0) {
      say("the EDS does not list " + std::to_string(bits_per_second) + " bit/s");
    }
    errorControl();
    for (const SetupWrite& write : config_.setup) setup(write);
    pdos("RPDO", config_.receive_pdos, file_.receive_pdos, true);
    pdos("TPDO", config_.transmit_pdos, file_.transmit_pdos, false);
    return std::move(sentences_);
  }

 private:
  void identity(const char* what, std::optional<std::uint32_t> demanded, std::optional<std::uint32_t> told) {
    if (!demanded || !told || *demanded == *told) return;
    say(std::string{what} + " " + hex(*demanded, 8) + " is demanded, the EDS says " + hex(*told, 8));
  }

  void errorControl() {
    const ErrorControl& control = config_.error_control;
    if (control.mode == ErrorControlMode::kHeartbeat) needs(0x1017, 0, "a heartbeat");
    if (control.mode == ErrorControlMode::kGuarding) {
      needs(0x100C, 0, "node guarding");
      needs(0x100D, 0, "node guarding");
    }
    if (control.master_timeout) needs(0x1016, 1, "watching our heartbeat");
  }
  void needs(std::uint16_t index, std::uint8_t sub_index, const char* purpose) {
    if (file_.object(index, sub_index) == nullptr) {
      say(std::string{"for "} + purpose + " the EDS has no object " + place(index, sub_index));
    }
  }

  void setup(const SetupWrite& write) {
    const EdsObject* object = file_.object(write.index, write.sub_index);
    const std::string name = "the write to " + place(write.index, write.sub_index);
    if (object == nullptr) return say(name + ": the EDS has no such object");
    if (!mayWrite(*object)) say(name + ": it cannot be written");
    const auto bits = object->data_type ? edsBits(*object->data_type) : std::nullopt;
    if (bits && (*bits + 7) / 8 != write.size) {
      say(name + ": it has " + std::to_string(*bits) + " bits, not " + std::to_string(8 * write.size));
    }
  }

  void pdos(const char* kind, const std::vector<PdoConfig>& configs, std::optional<unsigned> told, bool received) {
    const auto enabled =
        std::count_if(configs.begin(), configs.end(), [](const PdoConfig& pdo) { return pdo.enabled; });
    if (told && static_cast<unsigned>(enabled) > *told) {
      say(std::to_string(enabled) + " " + kind + "s are configured, the EDS has " + std::to_string(*told));
    }
    for (const PdoConfig& pdo : configs) {
      title_ = std::string{kind} + " " + std::to_string(pdo.number) + ": ";
      const auto offset = static_cast<std::uint16_t>(pdo.number - 1);
      const auto parameters =
          static_cast<std::uint16_t>((received ? kReceiveParameters : kTransmitParameters) + offset);
      if (pdo.enabled) check(pdo, parameters, received);
      title_.clear();
    }
  }

  void check(const PdoConfig& pdo, std::uint16_t parameters, bool received) {
    const EdsObject* cob_id = file_.object(parameters, kCobId);
    if (cob_id == nullptr) return say("the EDS has no object " + place(parameters, kCobId));
    if (!mayWrite(*cob_id) && cob_id->value) {
      const std::uint64_t fixed = cob_id->value->at(config_.id);
      if ((fixed & kOff) != 0) {
        say("it is off and cannot be switched on");
      } else if ((fixed & kIdMask) != pdo.cob_id) {
        say("its COB-ID is fixed at " + hex(fixed & kIdMask, 3) + ", configured is " + hex(pdo.cob_id, 3));
      }
    }
    parameter(parameters, kType, "transmission type", pdo.transmission_type);
    parameter(parameters, kInhibitTime, "inhibit time", pdo.inhibit_time);
    parameter(parameters, kEventTimer, "event timer", pdo.event_timer);
    if (!pdo.mapping.empty()) mapping(pdo, static_cast<std::uint16_t>(parameters + kMappingOffset), received);
  }

  void parameter(std::uint16_t index, std::uint8_t sub_index, const char* what, std::optional<std::uint16_t> wanted) {
    if (!wanted) return;
    const EdsObject* object = file_.object(index, sub_index);
    // A PDO without a time behaves as if it were 0.
    if (object == nullptr && *wanted == 0 && sub_index != kType) return;
    if (object == nullptr) return say("the EDS has no " + std::string{what} + " (" + place(index, sub_index) + ")");
    if (mayWrite(*object) || !object->value) return;
    const std::uint64_t fixed = object->value->at(config_.id);
    if (sub_index == kType ? isSameTransmissionType(fixed, *wanted) : fixed == *wanted) return;
    say(std::string{what} + " is fixed at " + std::to_string(fixed) + ", configured is " + std::to_string(*wanted));
  }

  void mapping(const PdoConfig& pdo, std::uint16_t index, bool received) {
    const EdsObject* count = file_.object(index, 0);
    if (count == nullptr) return say("the EDS has no object " + place(index, 0));
    if (!mayWrite(*count)) {
      const auto fixed = defaultMapping(file_, index, config_.id);
      if (fixed && *fixed != pdo.mapping) say("its mapping is fixed, and another than the one configured");
      return;
    }
    if (pdo.mapping.size() > room(index)) {
      say(std::to_string(pdo.mapping.size()) + " objects are mapped, the EDS has room for " +
          std::to_string(room(index)));
    }
    for (const PdoMapping& entry : pdo.mapping) mapped(entry, received);
  }

  std::size_t room(std::uint16_t index) const {
    std::size_t last = 0;
    for (std::uint8_t i = 1; i <= kLastMappedObject; ++i) {
      if (file_.object(index, i) != nullptr) last = i;
    }
    return last;
  }

  void mapped(const PdoMapping& entry, bool received) {
    const std::string name = place(entry.index, entry.sub_index);
    if (entry.index <= kLastDummy) {
      const auto& dummies = file_.dummies;
      if (!received || std::count(dummies.begin(), dummies.end(), entry.index) == 0) {
        say("the data type " + hex(entry.index, 4) + " cannot fill a gap in it");
      }
      return;
    }
    const EdsObject* object = file_.object(entry.index, entry.sub_index);
    if (object == nullptr) return say("the EDS has no object " + name);
    const EdsAccess wrong_way = received ? EdsAccess::kReadWriteInput : EdsAccess::kReadWriteOutput;
    const bool told = object->access != EdsAccess::kUnknown;
    if (!object->pdo_mapping || object->access == wrong_way ||
        (told && !(received ? object->writable() : object->readable()))) {
      say(name + " cannot be mapped into it");
    }
    const auto bits = object->data_type ? edsBits(*object->data_type) : std::nullopt;
    if (bits && *bits != entry.bits) {
      say(name + " has " + std::to_string(*bits) + " bits, mapped are " + std::to_string(entry.bits));
    }
  }

  void say(const std::string& text) {
    sentences_.push_back("node " + std::to_string(config_.id) + ": " + title_ + text);
  }

  const NodeConfig& config_;
  const EdsFile& file_;
  std::string title_;
  std::vector<std::string> sentences_;
};

void fill(std::optional<std::uint32_t>& open, std::optional<std::uint32_t> told) {
  if (!open && told.value_or(0) != 0) open = told;
}

void fillPdos(std::vector<PdoConfig>& pdos, std::uint16_t first, const EdsFile& file, std::uint8_t node) {
  for (PdoConfig& pdo : pdos) {
    if (!pdo.enabled) continue;
    const auto index = static_cast<std::uint16_t>(first + pdo.number - 1);
    if (pdo.cob_id == 0) {
      pdo.cob_id = static_cast<std::uint32_t>(file.value(index, kCobId, node).value_or(0) & kIdMask);
    }
    if (!pdo.mapping.empty()) continue;
    pdo.mapping = defaultMapping(file, static_cast<std::uint16_t>(index + kMappingOffset), node).value_or(pdo.mapping);
  }
}

}  // namespace

std::vector<std::string> checkAgainstEds(const NodeConfig& config, const EdsFile& file, std::uint32_t bits_per_second) {
  return EdsCheck{config, file}.run(bits_per_second);
}

NodeConfig filledFromEds(NodeConfig config, const EdsFile& file) {
  fill(config.device_type, file.device_type);
  fill(config.vendor_id, file.vendor_id);
  fill(config.product_code, file.product_code);
  fillPdos(config.receive_pdos, kReceiveParameters, file, config.id);
  fillPdos(config.transmit_pdos, kTransmitParameters, file, config.id);
  return config;
}

}  // namespace nord_driver::canopen
