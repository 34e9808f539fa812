#include "canopen/master_config.h"

#include <map>
#include <set>
#include <stdexcept>
#include <string>

#include "canopen/cob_id_table.h"
#include "canopen/emergency.h"
#include "canopen/nmt.h"
#include "nord_driver/core/fixed_text.h"

namespace nord_driver::canopen {
namespace {

constexpr std::uint16_t kMostPdos = 512;
constexpr std::size_t kMostNodes = 126;
constexpr std::uint8_t kLastSynchronous = 240;

[[noreturn]] void refuse(const std::string& sentence) {
  throw std::invalid_argument(sentence);
}

std::string hex(std::uint32_t id) {
  FixedText<12> text;
  text.format("%03Xh", static_cast<unsigned>(id));
  return text.str();
}

/// Whole milliseconds in 16 bits, as the objects of error control hold them.
void checkTime(const std::string& what, Duration time) {
  const auto count = time / std::chrono::milliseconds{1};
  if (time % std::chrono::milliseconds{1} != Duration::zero() || count < 1 || count > 0xFFFF) {
    refuse(what + " must be whole milliseconds, 1 to 65535");
  }
}

void checkPositive(const std::string& what, Duration time) {
  if (time <= Duration::zero()) refuse(what + " must be above 0");
}

/// Identifiers that CiA 301 table 40 keeps from being used for PDOs.
bool isReserved(std::uint32_t id) {
  return id <= 0x07F || (id >= 0x101 && id <= 0x180) || (id >= 0x581 && id <= 0x5FF) || (id >= 0x601 && id <= 0x67F) ||
         (id >= 0x6E0 && id <= 0x6FF) || (id >= 0x701 && id <= 0x77F) || id >= 0x780;
}

/// Who uses which identifier.
class Users {
 public:
  void claim(std::uint32_t id, const std::string& user) {
    if (id >= kCobIds) refuse(user + ": COB-ID " + hex(id) + " has more than 11 bits");
    const auto [place, is_new] = users_.emplace(id, user);
    if (!is_new) refuse("COB-ID " + hex(id) + " is used by " + place->second + " and by " + user);
  }

 private:
  std::map<std::uint32_t, std::string> users_;
};

void checkErrorControl(const std::string& node, const ErrorControl& control, const MasterConfig& config) {
  if (control.mode == ErrorControlMode::kHeartbeat) {
    checkTime(node + ": the heartbeat time", control.heartbeat_time);
    checkTime(node + ": the heartbeat time-out", control.heartbeat_timeout);
    if (control.heartbeat_timeout <= control.heartbeat_time) {
      refuse(node + ": the heartbeat time-out must be longer than the heartbeat time");
    }
  }
  if (control.mode == ErrorControlMode::kGuarding) {
    checkTime(node + ": the guard time", control.guard_time);
    if (control.life_time_factor == 0) refuse(node + ": the life time factor must be 1 to 255");
  }
  if (!control.master_timeout) return;
  checkTime(node + ": the time-out for our heartbeat", *control.master_timeout);
  if (control.mode == ErrorControlMode::kGuarding) {
    refuse(node + ": a guarded node watches the master by guarding, not by its heartbeat");
  }
  if (!config.own_id || config.heartbeat_time <= Duration::zero()) {
    refuse(node + ": it shall watch our heartbeat, but we send none");
  }
  if (*control.master_timeout <= config.heartbeat_time) {
    refuse(node + ": its time-out for our heartbeat must be longer than our heartbeat time");
  }
}

void checkMapping(const std::string& pdo, const PdoConfig& config) {
  std::size_t bits = 0;
  for (const PdoMapping& entry : config.mapping) {
    if (entry.bits == 0 || entry.bits % 8 != 0) refuse(pdo + ": mapped objects must have whole bytes");
    bits += entry.bits;
  }
  if (bits > 8 * kCanDataLength) refuse(pdo + ": more than 8 bytes are mapped");
}

void checkPdo(const std::string& pdo, const PdoConfig& config, bool received, const MasterConfig& master) {
  if (config.number == 0 || config.number > kMostPdos) refuse(pdo + ": its number must be 1 to 512");
  if (!config.enabled) return;
  if (isReserved(config.cob_id)) refuse(pdo + ": COB-ID " + hex(config.cob_id) + " is reserved");
  checkMapping(pdo, config);
  const bool synchronous = config.transmission_type <= kLastSynchronous;
  if (!synchronous && config.transmission_type < kFirstAtOnce) {
    refuse(pdo + ": transmission type " + std::to_string(config.transmission_type) + " is not 0..240, 254 or 255");
  }
  if (synchronous && !master.sync_cob_id) refuse(pdo + ": it is synchronous, but no SYNC is sent");
  if (received && config.inhibit_time) refuse(pdo + ": only a TPDO has an inhibit time");
}

void checkPdos(const std::string& node, const char* kind, const std::vector<PdoConfig>& pdos, bool received,
               const MasterConfig& config, Users& users) {
  std::set<std::uint16_t> numbers;
  for (const PdoConfig& pdo : pdos) {
    const std::string name = node + ", " + kind + " " + std::to_string(pdo.number);
    if (!numbers.insert(pdo.number).second) refuse(name + ": configured twice");
    checkPdo(name, pdo, received, config);
    if (pdo.enabled) users.claim(pdo.cob_id, name);
  }
}

void checkServers(const std::string& node, const NodeConfig& config, Users& users) {
  if (config.sdo_servers.size() > kMaxSdoServers) {
    refuse(node + ": more than " + std::to_string(kMaxSdoServers) + " SDO servers");
  }
  for (std::size_t i = 0; i < config.sdo_servers.size(); ++i) {
    const std::string name = node + ", SDO server " + std::to_string(i + 1);
    users.claim(config.sdo_servers[i].request_id, name);
    users.claim(config.sdo_servers[i].response_id, name);
  }
}

void checkNode(const NodeConfig& config, const MasterConfig& master, Users& users) {
  if (config.id == 0 || config.id > kMaxNodeId) refuse("node id " + std::to_string(config.id) + " is not 1 to 127");
  const std::string node = "node " + std::to_string(config.id);
  users.claim(kErrorControlBase + config.id, node);
  users.claim(kEmergencyBase + config.id, node + ", EMCY");
  checkServers(node, config, users);
  checkErrorControl(node, config.error_control, master);
  checkPositive(node + ": the SDO time-out", config.sdo_timeout);
  checkPositive(node + ": the boot-up time-out", config.boot_up_timeout);
  checkPositive(node + ": the start time-out", config.start_timeout);
  if (config.first_answer_timeout < Duration::zero()) refuse(node + ": the time-out of its first answer is negative");
  if (config.silence < Duration::zero()) refuse(node + ": the longest pause between two TPDOs is negative");
  for (const SetupWrite& write : config.setup) {
    if (write.size != 1 && write.size != 2 && write.size != 4) {
      refuse(node + ": set-up of " + hex(write.index) + ": the size must be 1, 2 or 4 bytes");
    }
  }
  checkPdos(node, "RPDO", config.receive_pdos, true, master, users);
  checkPdos(node, "TPDO", config.transmit_pdos, false, master, users);
}

}  // namespace

void checkConfig(const MasterConfig& config) {
  if (config.nodes.empty() || config.nodes.size() > kMostNodes) refuse("a CANopen master needs 1 to 126 nodes");
  Users users;
  users.claim(kNmtCobId, "NMT");
  if (config.sync_cob_id) users.claim(*config.sync_cob_id, "SYNC");
  if (config.own_id) {
    if (*config.own_id == 0 || *config.own_id > kMaxNodeId) refuse("our own node id must be 1 to 127");
    users.claim(kErrorControlBase + *config.own_id, "our own heartbeat");
  }
  if (config.heartbeat_time != Duration::zero()) {
    checkTime("our heartbeat time", config.heartbeat_time);
    if (!config.own_id) refuse("our heartbeat needs a node id of our own");
  }
  checkPositive("the interval of questions to absent nodes", config.ask_interval);
  std::set<std::uint8_t> ids;
  for (const NodeConfig& node : config.nodes) {
    if (!ids.insert(node.id).second) refuse("node " + std::to_string(node.id) + " is configured twice");
    checkNode(node, config, users);
  }
}

MasterConfig completed(MasterConfig config) {
  for (NodeConfig& node : config.nodes) {
    if (node.sdo_servers.empty()) node.sdo_servers.push_back(defaultSdoChannel(node.id));
  }
  return config;
}

std::size_t receivePdosOf(const MasterConfig& config) noexcept {
  std::size_t count = 0;
  for (const NodeConfig& node : config.nodes) count += node.receive_pdos.size();
  return count;
}

}  // namespace nord_driver::canopen
