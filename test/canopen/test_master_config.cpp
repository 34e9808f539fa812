#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>

#include "canopen/master_run.h"

namespace nord_driver::canopen {
namespace {

using std::chrono::milliseconds;

/// The sentence with which the configuration of two nodes, changed so, is refused.
std::string refusal(const std::function<void(MasterConfig&)>& change) {
  MasterConfig config = busConfig(2);
  change(config);
  try {
    const Master master{config};
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(MasterConfig, AcceptsTwoPlainNodes) {
  EXPECT_EQ("", refusal([](MasterConfig&) {}));
}

// Every mistake has its sentence, with node and value.
TEST(MasterConfig, NamesEveryMistake) {
  const auto first = [](const std::function<void(NodeConfig&)>& change) {
    return refusal([&](MasterConfig& config) { change(config.nodes[0]); });
  };
  EXPECT_EQ("a CANopen master needs 1 to 126 nodes", refusal([](MasterConfig& c) { c.nodes.clear(); }));
  EXPECT_EQ("node 2 is configured twice", first([](NodeConfig& n) { n.id = 2; }));
  EXPECT_EQ("node id 128 is not 1 to 127", first([](NodeConfig& n) { n.id = 128; }));
  EXPECT_EQ("node id 0 is not 1 to 127", first([](NodeConfig& n) { n.id = 0; }));
  EXPECT_EQ("COB-ID 701h is used by our own heartbeat and by node 1", refusal([](MasterConfig& c) { c.own_id = 1; }));
  EXPECT_EQ("COB-ID 202h is used by node 1, RPDO 1 and by node 2, RPDO 1",
            first([](NodeConfig& n) { n.receive_pdos[0].cob_id = 0x202; }));
  EXPECT_EQ("COB-ID 081h is used by SYNC and by node 1, EMCY", refusal([](MasterConfig& c) { c.sync_cob_id = 0x81; }));
  EXPECT_EQ("node 1, TPDO 1: COB-ID 581h is reserved", first([](NodeConfig& n) { n.transmit_pdos[0].cob_id = 0x581; }));
  EXPECT_EQ("node 1, RPDO 1: configured twice",
            first([](NodeConfig& n) { n.receive_pdos.push_back(n.receive_pdos[0]); }));
  EXPECT_EQ("node 1, RPDO 0: its number must be 1 to 512", first([](NodeConfig& n) { n.receive_pdos[0].number = 0; }));
  EXPECT_EQ("node 1, RPDO 1: more than 8 bytes are mapped", first([](NodeConfig& n) {
              n.receive_pdos[0].mapping = {{0x3000, 0, 64}, {0x3002, 1, 16}};
            }));
  EXPECT_EQ("node 1, RPDO 1: more than 8 bytes are mapped", first([](NodeConfig& n) {
              n.receive_pdos[0].mapping = {{0x3000, 0, 64}, {0x3002, 1, 8}};
            }));
  EXPECT_EQ("node 1, RPDO 1: mapped objects must have whole bytes", first([](NodeConfig& n) {
              n.receive_pdos[0].mapping = {{0x3000, 0, 1}};
            }));
  EXPECT_EQ("node 1, TPDO 1: transmission type 252 is not 0..240, 254 or 255",
            first([](NodeConfig& n) { n.transmit_pdos[0].transmission_type = 252; }));
  EXPECT_EQ("node 1, TPDO 1: it is synchronous, but no SYNC is sent",
            first([](NodeConfig& n) { n.transmit_pdos[0].transmission_type = 1; }));
  EXPECT_EQ("node 1, RPDO 1: only a TPDO has an inhibit time",
            first([](NodeConfig& n) { n.receive_pdos[0].inhibit_time = std::uint16_t{1}; }));
  EXPECT_EQ("node 1: the heartbeat time must be whole milliseconds, 1 to 65535",
            first([](NodeConfig& n) { n.error_control.heartbeat_time = std::chrono::microseconds{1500}; }));
  EXPECT_EQ("node 1: the heartbeat time-out must be longer than the heartbeat time",
            first([](NodeConfig& n) { n.error_control.heartbeat_timeout = milliseconds{100}; }));
  EXPECT_EQ("node 1: it shall watch our heartbeat, but we send none",
            first([](NodeConfig& n) { n.error_control.master_timeout = milliseconds{100}; }));
  EXPECT_EQ("node 1: the life time factor must be 1 to 255", first([](NodeConfig& n) {
              n.error_control.mode = ErrorControlMode::kGuarding;
              n.error_control.life_time_factor = 0;
            }));
  EXPECT_EQ("node 1: the SDO time-out must be above 0", first([](NodeConfig& n) { n.sdo_timeout = Duration{}; }));
  EXPECT_EQ("node 1: set-up of 2066h: the size must be 1, 2 or 4 bytes", first([](NodeConfig& n) {
              n.setup = {{0x2066, 1, 0, 3}};
            }));
  EXPECT_EQ("node 1: more than 4 SDO servers", first([](NodeConfig& n) { n.sdo_servers.resize(5); }));
  EXPECT_EQ("COB-ID 602h is used by node 1, SDO server 1 and by node 2, SDO server 1", first([](NodeConfig& n) {
              n.sdo_servers = {{0x602, 0x581}};
            }));
  EXPECT_EQ("our heartbeat needs a node id of our own",
            refusal([](MasterConfig& c) { c.heartbeat_time = milliseconds{100}; }));
}

// Each limit from both sides.
TEST(MasterConfig, Limits) {
  const auto first = [](const std::function<void(NodeConfig&)>& change) {
    return refusal([&](MasterConfig& config) { change(config.nodes[0]); });
  };
  const auto nodes = [](std::size_t count) { return refusal([&](MasterConfig& c) { c = busConfig(count); }); };
  EXPECT_EQ("", nodes(126));
  EXPECT_EQ("a CANopen master needs 1 to 126 nodes", nodes(127));
  EXPECT_EQ("", refusal([](MasterConfig& c) { c.own_id = 127; }));
  EXPECT_EQ("our own node id must be 1 to 127", refusal([](MasterConfig& c) { c.own_id = 128; }));
  EXPECT_EQ("our own node id must be 1 to 127", refusal([](MasterConfig& c) { c.own_id = 0; }));
  EXPECT_EQ("the interval of questions to absent nodes must be above 0",
            refusal([](MasterConfig& c) { c.ask_interval = Duration{}; }));
  EXPECT_EQ("", first([](NodeConfig& n) { n.receive_pdos[0].number = 512; }));
  EXPECT_EQ("node 1, RPDO 513: its number must be 1 to 512",
            first([](NodeConfig& n) { n.receive_pdos[0].number = 513; }));
  const auto type = [](int value) {
    return refusal([&](MasterConfig& c) {
      c.sync_cob_id = 0x80;
      c.nodes[0].transmit_pdos[0].transmission_type = static_cast<std::uint8_t>(value);
    });
  };
  for (const int good : {0, 240, 254, 255}) EXPECT_EQ("", type(good)) << good;
  for (const int bad : {241, 253}) EXPECT_NE("", type(bad)) << bad;
  const auto setup = [&first](std::uint8_t size) {
    return first([size](NodeConfig& n) { n.setup = {{0x2066, 1, 0, size}}; });
  };
  EXPECT_EQ("", setup(1) + setup(2) + setup(4));
  EXPECT_EQ("node 1: set-up of 2066h: the size must be 1, 2 or 4 bytes", setup(0));
  EXPECT_EQ("node 1, RPDO 1: mapped objects must have whole bytes", first([](NodeConfig& n) {
              n.receive_pdos[0].mapping = {{0x3000, 0, 0}};
            }));
}

// CiA 301, table of the CAN identifiers whose use is restricted.
TEST(MasterConfig, IdentifiersOfPdos) {
  const auto pdo = [](std::uint32_t id) {
    return refusal([&](MasterConfig& c) { c.nodes[0].transmit_pdos[0].cob_id = id; });
  };
  for (const std::uint32_t id : {0x000u, 0x07Fu, 0x101u, 0x180u, 0x581u, 0x5FFu, 0x601u, 0x67Fu, 0x6E0u, 0x6FFu, 0x701u,
                                 0x77Fu, 0x780u, 0x7FFu}) {
    EXPECT_NE(std::string::npos, pdo(id).find("is reserved")) << std::hex << id;
  }
  for (const std::uint32_t id : {0x080u, 0x100u, 0x181u, 0x580u, 0x600u, 0x680u, 0x6DFu, 0x700u}) {
    EXPECT_EQ("", pdo(id)) << std::hex << id;
  }
  EXPECT_EQ("SYNC: COB-ID 800h has more than 11 bits", refusal([](MasterConfig& c) { c.sync_cob_id = 0x800; }));
  EXPECT_EQ("", refusal([](MasterConfig& c) { c.sync_cob_id = 0x7FF; }));
  EXPECT_EQ("COB-ID 000h is used by NMT and by node 1, SDO server 1", refusal([](MasterConfig& c) {
              c.nodes[0].sdo_servers = {{0x000, 0x581}};
            }));
  EXPECT_EQ("COB-ID 582h is used by node 1, SDO server 1 and by node 2, SDO server 1", refusal([](MasterConfig& c) {
              c.nodes[0].sdo_servers = {{0x601, 0x582}};
            }));
}

TEST(MasterConfig, Times) {
  const auto first = [](const std::function<void(NodeConfig&)>& change) {
    return refusal([&](MasterConfig& config) { change(config.nodes[0]); });
  };
  EXPECT_EQ("node 1: the boot-up time-out must be above 0",
            first([](NodeConfig& n) { n.boot_up_timeout = Duration{}; }));
  EXPECT_EQ("node 1: the start time-out must be above 0", first([](NodeConfig& n) { n.start_timeout = Duration{}; }));
  EXPECT_EQ("node 1: the time-out of its first answer is negative",
            first([](NodeConfig& n) { n.first_answer_timeout = milliseconds{-1}; }));
  EXPECT_EQ("node 1: the longest pause between two TPDOs is negative",
            first([](NodeConfig& n) { n.silence = milliseconds{-1}; }));
  EXPECT_EQ("node 1: the heartbeat time-out must be whole milliseconds, 1 to 65535",
            first([](NodeConfig& n) { n.error_control.heartbeat_timeout = milliseconds{65536}; }));
  EXPECT_EQ("", first([](NodeConfig& n) { n.error_control.heartbeat_timeout = milliseconds{65535}; }));
  EXPECT_EQ("node 1: the guard time must be whole milliseconds, 1 to 65535", first([](NodeConfig& n) {
              n.error_control.mode = ErrorControlMode::kGuarding;
              n.error_control.guard_time = Duration{};
            }));
  EXPECT_EQ("our heartbeat time must be whole milliseconds, 1 to 65535", refusal([](MasterConfig& c) {
              c.own_id = 127;
              c.heartbeat_time = std::chrono::microseconds{1500};
            }));
  const auto watched = [](Duration timeout, Duration heartbeat, ErrorControlMode mode = ErrorControlMode::kHeartbeat) {
    return refusal([&](MasterConfig& c) {
      c.own_id = 127;
      c.heartbeat_time = heartbeat;
      c.nodes[0].error_control.mode = mode;
      c.nodes[0].error_control.master_timeout = timeout;
    });
  };
  EXPECT_EQ("", watched(milliseconds{101}, milliseconds{100}));
  EXPECT_EQ("node 1: its time-out for our heartbeat must be longer than our heartbeat time",
            watched(milliseconds{100}, milliseconds{100}));
  EXPECT_EQ("node 1: it shall watch our heartbeat, but we send none", watched(milliseconds{300}, Duration{}));
  EXPECT_EQ("node 1: the time-out for our heartbeat must be whole milliseconds, 1 to 65535",
            watched(milliseconds{65536}, milliseconds{100}));
  EXPECT_EQ("node 1: a guarded node watches the master by guarding, not by its heartbeat",
            watched(milliseconds{300}, milliseconds{100}, ErrorControlMode::kGuarding));
}

}  // namespace
}  // namespace nord_driver::canopen
