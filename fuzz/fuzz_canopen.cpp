// A whole CANopen master against any frames: it never stops asking, never floods the bus, and every SDO access gets its
// answer.
#include "can_game.h"
#include "canopen/master.h"

namespace {

using namespace nord_driver;
using namespace nord_driver::canopen;
using namespace std::chrono_literals;

PdoConfig pdo(std::uint32_t cob_id, std::uint8_t type, std::uint16_t first) {
  PdoConfig made;
  made.cob_id = cob_id;
  made.transmission_type = type;
  if (first != 0) made.mapping = {{first, 0, 16}, {static_cast<std::uint16_t>(first + 2), 1, 16}};
  return made;
}

NodeConfig node(std::uint8_t id, ErrorControlMode mode) {
  NodeConfig made;
  made.id = id;
  made.error_control.mode = mode;
  made.receive_pdos = {pdo(0x200u + id, 255, 0x3000)};
  made.transmit_pdos = {pdo(0x180u + id, 1, 0)};
  return made;
}

MasterConfig bus(std::uint8_t options) {
  MasterConfig config;
  config.sync_cob_id = 0x80;
  if ((options & 1u) != 0) {
    config.own_id = std::uint8_t{127};
    config.heartbeat_time = 50ms;
  }
  config.nodes = {node(1, ErrorControlMode::kHeartbeat), node(2, ErrorControlMode::kGuarding),
                  node(3, ErrorControlMode::kNone)};
  config.nodes[0].device_type = 0x00010192;
  config.nodes[0].vendor_id = 0x189;
  config.nodes[0].setup = {{0x2066, 1, 103, 2}};
  config.nodes[1].reset = (options & 2u) != 0 ? BootReset::kResetNode : BootReset::kNone;
  config.nodes[2].sdo_servers = {defaultSdoChannel(3), {0x640, 0x5C0}};
  config.nodes[2].receive_pdos[0].transmission_type = 1;
  return completed(config);
}

class Game final : public fuzz::CanGame {
 public:
  Game(fuzz::Choices& choices, std::uint8_t options) : CanGame(choices, master_), master_(bus(options)) {
    begin(master_.receivedIds(), 0x7FF);
    if ((options & 4u) == 0) boot();
  }

 private:
  /// Nodes that do as they are told, until all run.
  void boot() {
    for (int i = 0; i < 500 && !fuzz::allAre(master_, NodeState::kOperational); ++i) {
      now_ += 5ms;
      settle();
      for (CanFrame& asked : asked_) {
        if (asked.size == 8) answer(asked);
      }
      const std::uint8_t state = states_[0];
      hear(dataFrame(0x701, ByteView{&state, 1}));
    }
    fuzz::require(fuzz::allAre(master_, NodeState::kOperational));
  }
  void act() override {
    const std::size_t which = choices_.below(3);
    switch (choices_.below(16)) {
      case 0:
        master_.setReceivePdo(which, 0, choices_.bytes(choices_.below(9)));
        break;
      case 1:
      case 2: {
        SdoRequest request = sdoRead(choices_.byte(), 0x2066, choices_.below(4));
        request.block = choices_.below(2) == 0;
        if (choices_.below(2) == 0) request = sdoWrite(choices_.byte(), 0x2066, 1, choices_.byte(), 2);
        if (master_.submitSdo(which, which == 2 ? choices_.below(2) : 0, request)) ++pending_;
        break;
      }
      case 3:
        if (choices_.below(16) != 0) break;
        master_.restart(now_);
        pending_ = 0;
        break;
      case 4:
      case 5:
      case 6:
        master_.startCycle(now_);
        break;
      case 7:
        hearAnything();
        break;
      case 8: {  // error control of one of ours
        constexpr std::uint8_t kStates[] = {0x00, 0x04, 0x05, 0x7F, 0x85, 0xFF, 0x84};
        const std::uint8_t state = kStates[choices_.below(sizeof kStates)];
        hear(dataFrame(0x701u + static_cast<std::uint32_t>(which), ByteView{&state, 1}));
        break;
      }
      case 9:  // process data and emergencies
        hear(dataFrame((choices_.below(2) == 0 ? 0x181u : 0x81u) + static_cast<std::uint32_t>(which),
                       choices_.bytes(choices_.below(9))));
        break;
      default:
        for (CanFrame& asked : asked_) {
          if (asked.size == 8 && choices_.below(4) != 3) answer(asked);
        }
    }
  }

  /// As a server would that is there; sometimes something else.
  void answer(CanFrame& asked) {
    CanFrame frame = asked;
    asked.size = 0;
    frame.id = frame.id == 0x640 ? 0x5C0 : frame.id - 0x80;
    const std::uint8_t command = frame.data[0] >> 5;
    frame.data[0] = command == 2 ? 0x43 : 0x60;
    const std::uint8_t kind = well_behaved_ ? 15 : choices_.below(16);
    if (kind == 0) frame.data[0] = choices_.byte();
    if (kind == 1) frame.data[0] = 0x80;
    if (kind == 2) frame.size = choices_.below(9);
    const unsigned index = frame.data[1] | static_cast<unsigned>(frame.data[2]) << 8;
    if (command == 2 && kind != 3) put(frame, valueOf(index, frame.data[3]));
    hear(frame);
  }
  static std::uint32_t valueOf(unsigned index, unsigned sub_index) {
    if (index == 0x1000) return 0x00010192;
    if (index == 0x1018) return 0x189;
    if (index == 0x1400) return sub_index == 1 ? 0x40000201u : 255u;
    return 0;
  }
  static void put(CanFrame& frame, std::uint32_t value) {
    for (std::size_t i = 0; i < 4; ++i) frame.data[4 + i] = static_cast<std::uint8_t>(value >> 8 * i);
  }

  void takeAnswers() override {
    while (const auto event = master_.pollEvent()) fuzz::require(event->node < 3 || event->node == kNoNode);
    while (const auto answer = master_.pollSdo()) {
      fuzz::require(pending_ > 0 && answer->node < 3 && answer->server < 2);
      --pending_;
    }
  }

  void checkEnd() override {
    for (std::size_t i = 0; i < master_.nodeCount(); ++i) {
      const NodeStatus& status = master_.status(i);
      fuzz::require(status.state != NodeState::kRefused || !status.reason.empty());
      fuzz::require(status.counters.losses <= status.counters.boots);
    }
  }

  void handleSent(const CanFrame& frame) override {
    const bool request = (frame.id >= 0x601 && frame.id <= 0x603) || frame.id == 0x640;
    if (request && frame.data[0] != 0x80) asked_[frame.id & 3u] = frame;
    if (frame.id == 0) command(frame);
    if (frame.remote && frame.id == 0x702 && well_behaved_) {
      const auto state = static_cast<std::uint8_t>(states_[1] | toggle_);
      toggle_ ^= 0x80u;
      hear(dataFrame(0x702, ByteView{&state, 1}));
    }
  }
  void command(const CanFrame& frame) {
    for (std::uint8_t i = 0; i < 3; ++i) {
      if (frame.data[1] != 0 && frame.data[1] != i + 1) continue;
      states_[i] = frame.data[0] == 0x01 ? 0x05 : 0x7F;
      if (i == 1) toggle_ = frame.data[0] > 0x80 ? 0 : toggle_;
      const std::uint8_t boot_up = 0;
      if (frame.data[0] > 0x80 && well_behaved_) hear(dataFrame(0x701u + i, ByteView{&boot_up, 1}));
    }
  }

  std::array<CanFrame, 4> asked_;  // SDO requests not answered, by server
  std::array<std::uint8_t, 3> states_{0x7F, 0x7F, 0x7F};
  unsigned toggle_ = 0;  // of node 2, which is guarded
  Master master_;
};

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Choices choices{data, size};
  const std::uint8_t options = choices.byte();
  Game{choices, options}.play();
  return 0;
}
