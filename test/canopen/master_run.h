// A master and scripted nodes on one bus with one clock; a minute of bus time takes milliseconds.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "canopen/master.h"
#include "canopen/scripted_node.h"
#include "support/can_text.h"

namespace nord_driver::canopen {

/// A node as BU 0060 has it, with one PDO each way and a heartbeat of 100 ms.
inline NodeConfig nodeConfig(std::uint8_t id) {
  NodeConfig config;
  config.id = id;
  PdoConfig receive;
  receive.cob_id = 0x200u + id;
  receive.mapping = {{0x3000, 0, 16}, {0x3002, 1, 16}};
  PdoConfig transmit;
  transmit.cob_id = 0x180u + id;
  transmit.mapping = {{0x3001, 0, 16}, {0x3003, 1, 16}};
  config.receive_pdos.push_back(receive);
  config.transmit_pdos.push_back(transmit);
  return config;
}

inline MasterConfig busConfig(std::size_t nodes, std::uint8_t first_id = 1) {
  MasterConfig config;
  for (std::size_t i = 0; i < nodes; ++i) config.nodes.push_back(nodeConfig(static_cast<std::uint8_t>(first_id + i)));
  return config;
}

class MasterRun {
 public:
  static constexpr Duration kStep = std::chrono::milliseconds{1};
  static constexpr int kStepsPerCycle = 10;

  explicit MasterRun(const MasterConfig& config) : master{config} {
    for (const NodeConfig& node : config.nodes) {
      if (!node.receive_pdos.empty()) with_receive_pdo_.push_back(nodes.size());
      nodes.push_back(std::make_unique<ScriptedNode>(node.id));
    }
  }

  void powerAll() {
    for (auto& node : nodes) node->powerOn(now);
  }
  /// Opens the bus with every node on.
  void begin() {
    powerAll();
    master.restart(now);
  }
  void step() {
    now += kStep;
    for (auto& node : nodes) {
      node->tick(now);
      CanFrame frame;
      while (node->next(now, frame)) deliver(frame);
    }
    if (steps_++ % kStepsPerCycle == 0) cycle();
    master.poll(now);
    pump();
    while (const auto event = master.pollEvent()) events.push_back(*event);
  }
  void run(Duration span) {
    for (const Instant end = now + span; now < end;) step();
  }
  /// Until `done`; false after `limit`.
  bool runUntil(const std::function<bool()>& done, Duration limit) {
    for (const Instant end = now + limit; now < end && !done();) step();
    return done();
  }
  bool allOperational() const {
    for (std::size_t i = 0; i < master.nodeCount(); ++i) {
      if (master.status(i).state != NodeState::kOperational) return false;
    }
    return true;
  }
  bool reaches(NodeState state, Duration limit, std::size_t node = 0) {
    return runUntil([&] { return master.status(node).state == state; }, limit);
  }
  void runToNextCycle() {
    while (steps_ % kStepsPerCycle != 0) step();
  }
  void say(const std::string& candump) { master.handleFrame(frame(candump), now); }

  std::size_t count(CanopenEventKind kind) const {
    std::size_t found = 0;
    for (const CanopenEvent& event : events) found += event.kind == kind ? 1 : 0;
    return found;
  }
  std::string eventText(CanopenEventKind kind) const {
    for (const CanopenEvent& event : events) {
      if (event.kind == kind) return event.text.str();
    }
    return "";
  }
  std::vector<std::string> violations() const {
    std::vector<std::string> all;
    for (const auto& node : nodes) all.insert(all.end(), node->violations.begin(), node->violations.end());
    return all;
  }

  Master master;
  std::vector<std::unique_ptr<ScriptedNode>> nodes;
  std::vector<CanopenEvent> events;
  std::vector<std::string> sent;
  Instant now{std::chrono::hours{1}};
  bool link_full = false;
  std::optional<std::size_t> room;               ///< frames the link takes in a cycle
  std::function<bool(const CanFrame&)> loses;    ///< of both directions
  std::function<bool(const CanFrame&)> refuses;  ///< what the link does not take
  /// What the master is given before each cycle: the idle control word for every node that has an RPDO.
  std::function<void(Master&)> before_cycle = [this](Master& to) {
    for (const std::size_t node : with_receive_pdo_) to.setReceivePdo(node, 0, fromHex("7E 04 00 00"));
  };

 private:
  void cycle() {
    taken_ = 0;
    before_cycle(master);
    master.startCycle(now);
  }
  void deliver(const CanFrame& frame) {
    if (!loses || !loses(frame)) master.handleFrame(frame, now);
  }
  void pump() {
    CanFrame frame;
    while (master.pollTransmit(frame)) {
      if (link_full || (room && taken_ >= *room) || (refuses && refuses(frame))) return master.notSent();
      ++taken_;
      sent.push_back(text(frame));
      if (loses && loses(frame)) continue;
      for (auto& node : nodes) node->receive(frame, now);
    }
  }

  std::vector<std::size_t> with_receive_pdo_;
  int steps_ = 0;
  std::size_t taken_ = 0;  // in this cycle
};

}  // namespace nord_driver::canopen
