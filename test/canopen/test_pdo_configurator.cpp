#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "canopen/master_run.h"

namespace nord_driver::canopen {
namespace {

using std::chrono::seconds;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Node 1 with no PDO but those a test adds, and without error control: nothing else is written.
MasterConfig bareConfig() {
  MasterConfig config = busConfig(1);
  config.sync_cob_id = 0x80;
  config.nodes[0].receive_pdos.clear();
  config.nodes[0].transmit_pdos.clear();
  config.nodes[0].error_control.mode = ErrorControlMode::kNone;
  return config;
}

PdoConfig pdo(std::uint16_t number, std::uint32_t cob_id, const FixedVector<PdoMapping, kMaxMappedObjects>& mapping) {
  PdoConfig config;
  config.number = number;
  config.cob_id = cob_id;
  config.mapping = mapping;
  return config;
}

// BU 0060 p. 63: TPDO 2 is off as C0000281h and switched on as 40000281h.
TEST(PdoConfigurator, SwitchesTransmitPdo2On) {
  MasterConfig config = bareConfig();
  config.nodes[0].transmit_pdos = {pdo(2, 0x281, {{0x3001, 0, 16}, {0x3003, 1, 16}})};
  MasterRun run{config};
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{1}));
  EXPECT_THAT(run.nodes[0]->writes, ElementsAre("1801:01=40000281"));
  EXPECT_THAT(run.violations(), IsEmpty());
}

// The order of CiA 301 7.5.2.36; the frames of its first and last step as they are on the wire.
TEST(PdoConfigurator, RemapsInTheOrderOfTheStandard) {
  MasterConfig config = bareConfig();
  config.nodes[0].transmit_pdos = {pdo(1, 0x1C1, {{0x3001, 0, 16}, {0x3003, 1, 16}, {0x3003, 2, 16}})};
  config.nodes[0].transmit_pdos[0].transmission_type = 1;
  config.nodes[0].transmit_pdos[0].inhibit_time = std::uint16_t{50};
  config.nodes[0].transmit_pdos[0].event_timer = std::uint16_t{100};
  MasterRun run{config};
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{1})) << run.master.status(0).reason.c_str();
  EXPECT_THAT(run.nodes[0]->writes,
              ElementsAre("1800:01=C0000181", "1A00:00=0", "1A00:01=30010010", "1A00:02=30030110", "1A00:03=30030210",
                          "1A00:00=3", "1800:02=1", "1800:03=32", "1800:05=64", "1800:01=400001C1"));
  EXPECT_THAT(run.sent, Contains("601#23001801810100C0"));
  EXPECT_THAT(run.sent, Contains("601#23001801C1010040"));
  EXPECT_THAT(run.violations(), IsEmpty());
}

TEST(PdoConfigurator, SwitchesAnUnwantedPdoOff) {
  MasterConfig config = bareConfig();
  config.nodes[0].receive_pdos = {pdo(2, 0, {})};
  config.nodes[0].receive_pdos[0].enabled = false;
  config.nodes[0].transmit_pdos = {pdo(2, 0, {})};  // is off already
  config.nodes[0].transmit_pdos[0].enabled = false;
  MasterRun run{config};
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{1}));
  EXPECT_THAT(run.nodes[0]->writes, ElementsAre("1401:01=C0000301"));
}

// A device with a fixed mapping is fine as long as it is the wanted one.
TEST(PdoConfigurator, AcceptsAFixedMappingThatMatches) {
  MasterRun run{busConfig(1)};
  for (const std::uint16_t index : {std::uint16_t{0x1600}, std::uint16_t{0x1A00}}) {
    for (std::uint8_t sub = 0; sub <= 2; ++sub) run.nodes[0]->object(index, sub).read_only = true;
  }
  run.nodes[0]->object(0x1400, 1).read_only = true;
  run.nodes[0]->object(0x1800, 1).read_only = true;
  run.begin();
  EXPECT_TRUE(run.reaches(NodeState::kOperational, seconds{1}));
}

TEST(PdoConfigurator, NamesAFixedMappingThatDiffers) {
  MasterConfig config = bareConfig();
  config.nodes[0].transmit_pdos = {pdo(1, 0x181, {{0x3001, 0, 16}})};
  MasterRun run{config};
  run.nodes[0]->object(0x1A00, 0).read_only = true;
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kRefused, seconds{1}));
  EXPECT_THAT(run.master.status(0).reason.str(),
              HasSubstr("mapping of TPDO 1 (1A00h:0) cannot be written: abort 0601 0002h"));
}

TEST(PdoConfigurator, NamesACobIdThatCannotBeChanged) {
  MasterConfig config = bareConfig();
  config.nodes[0].receive_pdos = {pdo(1, 0x1C1, {})};
  MasterRun run{config};
  run.nodes[0]->object(0x1400, 1).read_only = true;
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kRefused, seconds{1}));
  EXPECT_THAT(run.master.status(0).reason.str(),
              HasSubstr("COB-ID of RPDO 1 (1400h:1) cannot be written: abort 0601 0002h"));
}

// A COB-ID that is right and read-only does not keep the transmission type from being set.
TEST(PdoConfigurator, SetsTheTypeOfAPdoThatCannotBeSwitchedOff) {
  MasterConfig config = bareConfig();
  config.nodes[0].transmit_pdos = {pdo(1, 0x181, {})};
  config.nodes[0].transmit_pdos[0].transmission_type = 1;
  MasterRun run{config};
  run.nodes[0]->object(0x1800, 1).read_only = true;
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{1}));
  EXPECT_EQ(1u, run.nodes[0]->object(0x1800, 2).value);
}

// 254 and 255 both act at once (CiA 301 tables 66 and 69; BU 0060 p. 58): neither is rewritten as the other.
TEST(PdoConfigurator, LeavesTheOtherTypeThatActsAtOnce) {
  const std::pair<std::uint8_t, std::uint8_t> held_and_wanted[] = {{254, 255}, {255, 254}};
  for (const auto& [held, wanted] : held_and_wanted) {
    for (const bool read_only : {true, false}) {
      MasterConfig config = bareConfig();
      config.nodes[0].transmit_pdos = {pdo(1, 0x181, {})};
      config.nodes[0].transmit_pdos[0].transmission_type = wanted;
      MasterRun run{config};
      run.nodes[0]->object(0x1800, 2).value = held;
      run.nodes[0]->object(0x1800, 2).read_only = read_only;
      run.begin();
      ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{1})) << int{held} << read_only;
      EXPECT_THAT(run.nodes[0]->writes, IsEmpty()) << int{held};
    }
  }
}

// 253 waits for a remote frame, 240 for SYNC.
TEST(PdoConfigurator, RewritesEveryOtherType) {
  for (const std::uint32_t held : {0u, 1u, 240u, 252u, 253u}) {
    MasterConfig config = bareConfig();
    config.nodes[0].transmit_pdos = {pdo(1, 0x181, {})};
    MasterRun run{config};
    run.nodes[0]->object(0x1800, 2).value = held;
    run.begin();
    ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{1})) << held;
    EXPECT_EQ(255u, run.nodes[0]->object(0x1800, 2).value) << held;
  }
}

// A time the device has not is as good as 0, and nothing else.
TEST(PdoConfigurator, MissingTimes) {
  for (const std::uint16_t wanted : {std::uint16_t{0}, std::uint16_t{10}}) {
    MasterConfig config = bareConfig();
    config.nodes[0].transmit_pdos = {pdo(1, 0x181, {})};
    config.nodes[0].transmit_pdos[0].event_timer = wanted;
    MasterRun run{config};
    run.nodes[0]->remove(0x1800, 5);
    run.begin();
    run.run(seconds{1});
    EXPECT_EQ(wanted == 0 ? NodeState::kOperational : NodeState::kRefused, run.master.status(0).state);
  }
}

TEST(PdoConfigurator, NamesWhichOfItsObjectsWasRefused) {
  const std::pair<std::uint8_t, const char*> named[] = {{2, "transmission type of TPDO 1 (1800h:2)"},
                                                        {3, "inhibit time of TPDO 1 (1800h:3)"},
                                                        {5, "event timer of TPDO 1 (1800h:5)"}};
  for (const auto& [sub_index, text] : named) {
    for (const bool missing : {true, false}) {
      MasterConfig config = bareConfig();
      config.nodes[0].transmit_pdos = {pdo(1, 0x181, {})};
      config.nodes[0].transmit_pdos[0].transmission_type = 1;
      config.nodes[0].transmit_pdos[0].inhibit_time = std::uint16_t{20};
      config.nodes[0].transmit_pdos[0].event_timer = std::uint16_t{10};
      MasterRun run{config};
      if (missing) run.nodes[0]->remove(0x1800, sub_index);
      if (!missing) run.nodes[0]->object(0x1800, sub_index).read_only = true;
      run.begin();
      ASSERT_TRUE(run.reaches(NodeState::kRefused, seconds{1})) << text;
      EXPECT_THAT(run.master.status(0).reason.str(), HasSubstr(text)) << missing;
    }
  }
}

// Whatever a device holds and whatever is wanted: the referee sees the order kept, the device ends as wanted, a second
// start-up writes nothing.
RC_GTEST_PROP(PdoConfiguratorProperty, EndsAsWantedInTheRightOrder, ()) {
  const auto objects =
      *rc::gen::container<std::vector<int>>(*rc::gen::inRange<std::size_t>(1, 5), rc::gen::inRange(0, 4));
  const std::vector<PdoMapping> pool{{0x3001, 0, 16}, {0x3003, 1, 16}, {0x3003, 2, 16}, {0x3003, 3, 16}};
  PdoConfig wanted = pdo(1, *rc::gen::element(0x181u, 0x1C1u), {});
  for (const int i : objects) wanted.mapping.push_back(pool[static_cast<std::size_t>(i)]);
  wanted.transmission_type = *rc::gen::element(std::uint8_t{0}, std::uint8_t{1}, std::uint8_t{254}, std::uint8_t{255});
  if (*rc::gen::arbitrary<bool>()) wanted.inhibit_time = *rc::gen::element(std::uint16_t{0}, std::uint16_t{100});
  if (*rc::gen::arbitrary<bool>()) wanted.event_timer = *rc::gen::element(std::uint16_t{0}, std::uint16_t{250});
  MasterConfig config = bareConfig();
  config.nodes[0].reset = BootReset::kNone;
  config.nodes[0].transmit_pdos = {wanted};
  MasterRun run{config};
  ScriptedNode& node = *run.nodes[0];
  const bool off = *rc::gen::arbitrary<bool>();
  node.object(0x1800, 1).value = off ? 0xC0000181 : 0x40000181;
  const std::uint32_t held_type = *rc::gen::element(1u, 254u, 255u);
  node.object(0x1800, 2).value = held_type;
  node.object(0x1A00, 0).value = *rc::gen::inRange(0u, 5u);
  for (std::uint8_t sub = 1; sub <= 4; ++sub) {
    node.object(0x1A00, sub).value = pool[*rc::gen::inRange<std::size_t>(0, 4)].value();
  }
  run.begin();
  RC_ASSERT(run.reaches(NodeState::kOperational, seconds{1}));
  RC_ASSERT(run.violations() == std::vector<std::string>{});
  RC_ASSERT(node.object(0x1800, 1).value == (0x40000000u | wanted.cob_id));
  const std::uint32_t type = node.object(0x1800, 2).value;
  RC_ASSERT(type == wanted.transmission_type ||
            (type == held_type && std::min<std::uint32_t>(type, wanted.transmission_type) >= 254));
  RC_ASSERT(node.object(0x1A00, 0).value == wanted.mapping.size());
  for (std::size_t i = 0; i < wanted.mapping.size(); ++i) {
    RC_ASSERT(node.object(0x1A00, static_cast<std::uint8_t>(i + 1)).value == wanted.mapping[i].value());
  }
  RC_ASSERT(node.object(0x1800, 3).value == wanted.inhibit_time.value_or(std::uint16_t{100}));
  RC_ASSERT(node.object(0x1800, 5).value == wanted.event_timer.value_or(std::uint16_t{250}));
  node.writes.clear();
  run.master.restart(run.now);
  RC_ASSERT(run.reaches(NodeState::kOperational, seconds{1}));
  RC_ASSERT(node.writes == std::vector<std::string>{});
}

}  // namespace
}  // namespace nord_driver::canopen
