#include "sim/canopen/can_factory_settings.h"

namespace nord_driver::sim {

namespace {

constexpr unsigned kNodePdos = 4;
constexpr unsigned kInverters = 4;

PdoSettings pdo(std::uint32_t id, bool on, std::initializer_list<std::uint32_t> mapping) {
  PdoSettings settings;
  settings.cob_id = id | kCobIdNoRtr | (on ? 0u : kCobIdOff);
  for (const std::uint32_t entry : mapping) settings.mapping[settings.count++] = entry;
  return settings;
}

// All four RPDOs are active, of the TPDOs only the first (BU 0060 p. 59). SW3 comes before SW2 with the older series.
void addNordPdos(CanCommunication& communication, std::uint32_t node, bool swap_words_2_3) {
  const std::uint8_t third = swap_words_2_3 ? 3 : 2;
  const std::uint8_t fourth = swap_words_2_3 ? 2 : 3;
  for (const bool receive : {true, false}) {
    const std::uint32_t word = receive ? mappingEntry(0x3000, 0, 16) : mappingEntry(0x3001, 0, 16);
    const std::uint16_t values = receive ? 0x3002 : 0x3003;
    const auto value = [&](std::uint8_t sub) { return mappingEntry(values, sub, sub == 4 ? 32 : 16); };
    const std::uint32_t base = node + (receive ? 0x200u : 0x180u);
    auto& pdos = receive ? communication.rpdos : communication.tpdos;
    pdos.push_back(pdo(base, true, {word, value(1)}));
    pdos.push_back(pdo(base + 0x100, receive, {word, value(1), value(third), value(fourth)}));
    pdos.push_back(pdo(base + 0x200, receive, {word, value(4), value(2)}));
    pdos.push_back(pdo(base + 0x300, receive, {word}));
  }
}

// 6040h-6044h replace 3000h-3003h (BU 0060 p. 57); what the PDOs 2 and 3 carry then is in no text that could be read.
void addCia402Pdos(CanCommunication& communication, std::uint32_t node) {
  communication.rpdos.push_back(pdo(node + 0x200, true, {mappingEntry(0x6040, 0, 16), mappingEntry(0x6042, 0, 16)}));
  communication.rpdos.push_back(pdo(node + 0x300, false, {}));
  communication.rpdos.push_back(pdo(node + 0x400, false, {}));
  communication.rpdos.push_back(pdo(node + 0x500, true, {mappingEntry(0x6040, 0, 16)}));
  communication.tpdos.push_back(pdo(node + 0x180, true, {mappingEntry(0x6041, 0, 16), mappingEntry(0x6044, 0, 16)}));
  communication.tpdos.push_back(pdo(node + 0x280, false, {}));
  communication.tpdos.push_back(pdo(node + 0x380, false, {}));
  communication.tpdos.push_back(pdo(node + 0x480, false, {mappingEntry(0x6041, 0, 16)}));
}

// PDO n belongs to inverter n, the fifth to the module's own inputs and outputs. Whether the fifth is active as
// delivered, and under which identifier, is not printed: off here.
void addGatewayPdos(CanCommunication& communication, std::uint32_t node) {
  constexpr std::uint16_t kInhibit = 100;  // 10 ms and 250 ms: BU 0260 p. 41
  constexpr std::uint16_t kEvent = 250;
  for (unsigned n = 0; n < kInverters; ++n) {
    const auto word = static_cast<std::uint8_t>(n + 1);
    const auto value = static_cast<std::uint8_t>(3 * n + 1);
    const auto entry = [&](std::uint16_t index, unsigned offset) {
      return mappingEntry(index, static_cast<std::uint8_t>(value + offset), 16);
    };
    const std::uint32_t id = node + 0x100u * n;
    communication.rpdos.push_back(
        pdo(id + 0x200, true, {mappingEntry(0x3000, word, 16), entry(0x3002, 0), entry(0x3002, 1), entry(0x3002, 2)}));
    communication.tpdos.push_back(
        pdo(id + 0x180, true, {mappingEntry(0x3001, word, 16), entry(0x3003, 0), entry(0x3003, 1), entry(0x3003, 2)}));
  }
  communication.rpdos.push_back(pdo(0, false, {mappingEntry(0x3005, 1, 8)}));
  communication.tpdos.push_back(pdo(0, false, {mappingEntry(0x3004, 1, 8)}));
  for (PdoSettings& settings : communication.tpdos) {
    settings.inhibit = kInhibit;
    settings.event = kEvent;
  }
}

}  // namespace

CanCommunication factoryCommunication(std::uint8_t node, CanConnection connection, bool cia402, bool swap_words_2_3,
                                      bool servers_set) {
  CanCommunication communication;
  communication.emergency_cob_id = 0x80u + node;
  communication.servers.push_back({0x600u + node, 0x580u + node});
  if (connection == CanConnection::kGateway) {
    for (unsigned n = 1; n < kInverters; ++n) {  // one server for each inverter
      communication.servers.push_back(servers_set ? SdoCobIds{0x600u + node + n, 0x580u + node + n} : SdoCobIds{});
    }
    addGatewayPdos(communication, node);
  } else if (cia402) {
    addCia402Pdos(communication, node);
  } else {
    addNordPdos(communication, node, swap_words_2_3);
  }
  static_assert(CanCommunication::kPdos > kNodePdos, "room for the PDOs of every kind of node");
  return communication;
}

}  // namespace nord_driver::sim
