#include "canopen/cob_id_table.h"

#include "canopen/emergency.h"
#include "canopen/nmt.h"

namespace nord_driver::canopen {
namespace {

using Kind = CobIdUse::Kind;

class Table {
 public:
  Table() : uses_(kCobIds) {}

  void set(std::uint32_t id, Kind kind, std::size_t node = 0, std::size_t item = 0) {
    uses_[id] = {kind, static_cast<std::uint8_t>(node), static_cast<std::uint16_t>(item)};
  }
  bool isFree(std::uint32_t id) const { return uses_[id].kind == Kind::kForeign; }
  std::vector<CobIdUse> take() { return std::move(uses_); }

 private:
  std::vector<CobIdUse> uses_;
};

void addNode(Table& table, std::size_t index, const NodeConfig& node) {
  table.set(kEmergencyBase + node.id, Kind::kEmergency, index);
  table.set(kErrorControlBase + node.id, Kind::kErrorControl, index);
  for (std::size_t i = 0; i < node.transmit_pdos.size(); ++i) {
    if (node.transmit_pdos[i].enabled) table.set(node.transmit_pdos[i].cob_id, Kind::kTransmitPdo, index, i);
  }
  for (std::size_t i = 0; i < node.receive_pdos.size(); ++i) {
    if (node.receive_pdos[i].enabled) table.set(node.receive_pdos[i].cob_id, Kind::kReceivePdo, index, i);
  }
  for (std::size_t i = 0; i < node.sdo_servers.size(); ++i) {
    table.set(node.sdo_servers[i].request_id, Kind::kSdoRequest, index, i);
    table.set(node.sdo_servers[i].response_id, Kind::kSdoAnswer, index, i);
  }
}

// Whoever sends them commands the node.
void addPredefinedPdos(Table& table, std::size_t index, std::uint8_t id) {
  for (const std::uint32_t first : {0x200u, 0x300u, 0x400u, 0x500u}) {
    if (table.isFree(first + id)) table.set(first + id, Kind::kReceivePdo, index);
  }
}

}  // namespace

std::vector<CobIdUse> cobIdTable(const MasterConfig& config) {
  Table table;
  for (std::uint8_t id = 1; id <= kMaxNodeId; ++id) {
    table.set(kEmergencyBase + id, Kind::kForeignNode, 0, id);
    table.set(kErrorControlBase + id, Kind::kForeignNode, 0, id);
  }
  table.set(kNmtCobId, Kind::kNmt);
  table.set(kTimeCobId, Kind::kIgnored);
  table.set(kEmergencyBase, Kind::kIgnored);  // the usual SYNC
  if (config.sync_cob_id) table.set(*config.sync_cob_id, Kind::kSync);
  for (std::size_t i = 0; i < config.nodes.size(); ++i) addNode(table, i, config.nodes[i]);
  for (std::size_t i = 0; i < config.nodes.size(); ++i) {
    if (config.nodes[i].obeys_predefined_pdos) addPredefinedPdos(table, i, config.nodes[i].id);
  }
  if (config.own_id) table.set(kErrorControlBase + *config.own_id, Kind::kOwnHeartbeat);
  return table.take();
}

std::vector<std::uint32_t> receivedIdsOf(const std::vector<CobIdUse>& table) {
  std::vector<std::uint32_t> ids;
  for (std::uint32_t id = 0; id < table.size(); ++id) {
    const Kind kind = table[id].kind;
    const bool foreign_emergency = kind == Kind::kForeignNode && id < kErrorControlBase;
    if (kind != Kind::kForeign && kind != Kind::kIgnored && !foreign_emergency) ids.push_back(id);
  }
  return ids;
}

std::vector<std::uint32_t> receivedRemoteIdsOf(const std::vector<CobIdUse>& table) {
  std::vector<std::uint32_t> ids;
  for (std::uint32_t id = 0; id < table.size(); ++id) {
    if (table[id].kind == Kind::kErrorControl) ids.push_back(id);
  }
  return ids;
}

const char* toText(CobIdUse::Kind kind) noexcept {
  switch (kind) {
    case Kind::kNmt:
      return "NMT";
    case Kind::kSync:
      return "SYNC";
    case Kind::kReceivePdo:
      return "RPDO";
    case Kind::kSdoRequest:
      return "SDO request";
    case Kind::kErrorControl:
      return "guarding";
    default:
      return "frame";
  }
}

}  // namespace nord_driver::canopen
