#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "canopen/eds_check.h"
#include "canopen/eds_samples.h"

namespace nord_driver::canopen {
namespace {

using Sentences = std::vector<std::string>;
using testing::ElementsAre;
using testing::IsEmpty;

class EdsCheckTest : public testing::Test {
 protected:
  /// BU 0060 p. 59: PDO 1 each way.
  EdsCheckTest() {
    config.id = 0x32;
    config.receive_pdos = {pdo(1, 0x232, {{0x3000, 0, 16}, {0x3002, 1, 16}})};
    config.transmit_pdos = {pdo(1, 0x1B2, {{0x3001, 0, 16}, {0x3003, 1, 16}})};
  }
  static PdoConfig pdo(std::uint16_t number, std::uint32_t cob_id, FixedVector<PdoMapping, 8> mapping) {
    PdoConfig made;
    made.number = number;
    made.cob_id = cob_id;
    made.mapping = mapping;
    return made;
  }
  Sentences check(std::uint32_t bits_per_second = 0) const { return checkAgainstEds(config, file, bits_per_second); }
  EdsObject& object(std::uint16_t index, std::uint8_t sub_index) {
    return const_cast<EdsObject&>(*file.object(index, sub_index));
  }

  NodeConfig config;
  EdsFile file = parseEds(kEds);
};

TEST_F(EdsCheckTest, WhatFitsIsNotComplainedAbout) {
  config.device_type = 0x00010192;
  config.vendor_id = 0x189;
  config.transmit_pdos[0].inhibit_time = std::uint16_t{100};
  config.transmit_pdos[0].event_timer = std::uint16_t{0};
  config.setup = {{0x2066, 1, 103, 2}};
  EXPECT_THAT(check(250'000), IsEmpty());
}

TEST_F(EdsCheckTest, IdentityAndBitRate) {
  config.device_type = 0x00020192;
  config.vendor_id = 1;
  config.product_code = 2;
  config.revision_number = 3;
  EXPECT_THAT(check(500'000), ElementsAre("node 50: device type 00020192h is demanded, the EDS says 00010192h",
                                          "node 50: vendor id 00000001h is demanded, the EDS says 00000189h",
                                          "node 50: product code 00000002h is demanded, the EDS says 00000014h",
                                          "node 50: revision number 00000003h is demanded, the EDS says 00010002h",
                                          "node 50: the EDS does not list 500000 bit/s"));
}

// The sample has a heartbeat producer, no consumer and no guarding.
TEST_F(EdsCheckTest, ErrorControl) {
  config.error_control.mode = ErrorControlMode::kGuarding;
  EXPECT_THAT(check(), ElementsAre("node 50: for node guarding the EDS has no object 100Ch:0",
                                   "node 50: for node guarding the EDS has no object 100Dh:0"));
  config.error_control = ErrorControl{};
  config.error_control.master_timeout = std::chrono::milliseconds{500};
  EXPECT_THAT(check(), ElementsAre("node 50: for watching our heartbeat the EDS has no object 1016h:1"));
  config.error_control.mode = ErrorControlMode::kNone;
  config.error_control.master_timeout.reset();
  EXPECT_THAT(check(), IsEmpty());
}

TEST_F(EdsCheckTest, WritesOfTheSetUp) {
  config.setup = {{0x2066, 1, 103, 4}, {0x2067, 1, 103, 2}, {0x1018, 1, 5, 4}};
  EXPECT_THAT(check(), ElementsAre("node 50: the write to 2066h:1: it has 16 bits, not 32",
                                   "node 50: the write to 2067h:1: the EDS has no such object",
                                   "node 50: the write to 1018h:1: it cannot be written"));
}

TEST_F(EdsCheckTest, PdosThatAreNotThere) {
  config.receive_pdos.push_back(pdo(3, 0x432, {}));
  config.transmit_pdos.push_back(pdo(2, 0x2B2, {}));
  EXPECT_THAT(check(), ElementsAre("node 50: RPDO 3: the EDS has no object 1402h:1",
                                   "node 50: 2 TPDOs are configured, the EDS has 1",
                                   "node 50: TPDO 2: the EDS has no object 1801h:1"));
  config.receive_pdos[1].enabled = config.transmit_pdos[1].enabled = false;
  EXPECT_THAT(check(), IsEmpty());
}

// All eleven bits of the identifier count, and none beside them.
TEST_F(EdsCheckTest, AFixedCobIdIsComparedWithoutItsFlags) {
  for (const std::uint32_t id : {0x000u, 0x001u, 0x555u, 0x7FFu}) {
    config.receive_pdos.resize(1);
    config.receive_pdos.push_back(pdo(2, static_cast<std::uint16_t>(id), {{0x3000, 0, 16}}));
    object(0x1401, 1).value = EdsNumber{0x40000000 | id, false};
    EXPECT_THAT(check(), IsEmpty()) << id;
  }
}

// RPDO 2 of the sample cannot be changed; its COB-ID depends on the node id.
TEST_F(EdsCheckTest, WhatIsFixed) {
  config.receive_pdos.push_back(pdo(2, 0x332, {{0x3000, 0, 16}}));
  EXPECT_THAT(check(), IsEmpty());
  config.receive_pdos[1] = pdo(2, 0x333, {{0x3000, 0, 16}, {0x3002, 1, 16}});
  config.receive_pdos[1].transmission_type = 1;
  EXPECT_THAT(check(), ElementsAre("node 50: RPDO 2: its COB-ID is fixed at 332h, configured is 333h",
                                   "node 50: RPDO 2: transmission type is fixed at 255, configured is 1",
                                   "node 50: RPDO 2: its mapping is fixed, and another than the one configured"));
  config.receive_pdos[1] = pdo(2, 0x332, {});
  object(0x1401, 1).value = EdsNumber{0xC0000300, true};
  EXPECT_THAT(check(), ElementsAre("node 50: RPDO 2: it is off and cannot be switched on"));
}

// CiA 301 tables 66 and 69.
TEST_F(EdsCheckTest, AFixedTypeThatActsAtOnceTooIsFine) {
  config.receive_pdos.push_back(pdo(2, 0x332, {{0x3000, 0, 16}}));
  object(0x1401, 2).value = EdsNumber{254, false};
  EXPECT_THAT(check(), IsEmpty());
  config.receive_pdos[1].transmission_type = 254;
  object(0x1401, 2).value = EdsNumber{255, false};
  EXPECT_THAT(check(), IsEmpty());
  object(0x1401, 2).value = EdsNumber{253, false};
  EXPECT_THAT(check(), ElementsAre("node 50: RPDO 2: transmission type is fixed at 253, configured is 254"));
}

TEST_F(EdsCheckTest, MappedObjects) {
  config.receive_pdos[0].mapping = {{0x3001, 0, 16}, {0x3002, 1, 32}};
  config.transmit_pdos[0].mapping = {{0x3000, 0, 16}, {0x4000, 0, 16}};
  EXPECT_THAT(check(), ElementsAre("node 50: RPDO 1: 3001h:0 cannot be mapped into it",
                                   "node 50: RPDO 1: 3002h:1 has 16 bits, mapped are 32",
                                   "node 50: TPDO 1: 3000h:0 cannot be mapped into it",
                                   "node 50: TPDO 1: the EDS has no object 4000h:0"));
  config.receive_pdos[0].mapping = {{0x2066, 1, 16}, {0x3000, 0, 16}, {0x3002, 1, 16}};
  config.transmit_pdos.clear();
  EXPECT_THAT(check(), ElementsAre("node 50: RPDO 1: 3 objects are mapped, the EDS has room for 2",
                                   "node 50: RPDO 1: 2066h:1 cannot be mapped into it"));
}

// CiA 306 [DummyUsage]: data types that may stand for a gap, in an RPDO.
TEST_F(EdsCheckTest, Dummies) {
  config.receive_pdos[0].mapping = {{0x3000, 0, 16}, {0x0006, 0, 16}};
  EXPECT_THAT(check(), IsEmpty());
  config.receive_pdos[0].mapping = {{0x3000, 0, 16}, {0x0007, 0, 32}};
  config.transmit_pdos[0].mapping = {{0x0006, 0, 16}};
  EXPECT_THAT(check(), ElementsAre("node 50: RPDO 1: the data type 0007h cannot fill a gap in it",
                                   "node 50: TPDO 1: the data type 0006h cannot fill a gap in it"));
}

TEST_F(EdsCheckTest, MissingParametersAndMapping) {
  config.receive_pdos[0].event_timer = std::uint16_t{100};
  EXPECT_THAT(check(), ElementsAre("node 50: RPDO 1: the EDS has no event timer (1400h:5)"));
  config.receive_pdos[0].event_timer = std::uint16_t{0};
  EXPECT_THAT(check(), IsEmpty()) << "as the start-up takes it";
  config.receive_pdos[0].event_timer.reset();
  EdsFile bare = parseEds("[DeviceInfo]\n[1000]\nDataType=7\nDefaultValue=0\n[1017]\n[1400sub1]\n[1400sub2]\n");
  config.transmit_pdos.clear();
  EXPECT_THAT(checkAgainstEds(config, bare), ElementsAre("node 50: RPDO 1: the EDS has no object 1600h:0"));
}

// What the file does not tell (no access types, no values) is no reason to complain.
TEST_F(EdsCheckTest, SilenceIsNoComplaint) {
  for (EdsObject& each : file.objects) {
    each.access = EdsAccess::kUnknown;
    each.value.reset();
    each.data_type.reset();
  }
  file.bit_rates.clear();
  file.receive_pdos.reset();
  config.setup = {{0x2066, 1, 103, 2}};
  config.receive_pdos.push_back(pdo(2, 0x333, {{0x3000, 0, 16}}));
  EXPECT_THAT(check(250'000), IsEmpty());
}

TEST_F(EdsCheckTest, FillsInWhatIsOpen) {
  config.receive_pdos = {pdo(1, 0, {}), pdo(2, 0x344, {})};
  config.transmit_pdos = {pdo(1, 0, {{0x3001, 0, 16}})};
  config.product_code = 5;
  const NodeConfig filled = filledFromEds(config, file);
  EXPECT_EQ(0x10192u, filled.device_type);
  EXPECT_EQ(0x189u, filled.vendor_id);
  EXPECT_EQ(5u, filled.product_code) << "configured";
  EXPECT_FALSE(filled.revision_number);
  EXPECT_EQ(0x232u, filled.receive_pdos[0].cob_id);
  ASSERT_EQ(2u, filled.receive_pdos[0].mapping.size());
  EXPECT_EQ(0x30000010u, filled.receive_pdos[0].mapping[0].value());
  EXPECT_EQ(0x30020110u, filled.receive_pdos[0].mapping[1].value());
  EXPECT_EQ(0x344u, filled.receive_pdos[1].cob_id);
  EXPECT_EQ(1u, filled.receive_pdos[1].mapping.size());
  EXPECT_EQ(0x1B2u, filled.transmit_pdos[0].cob_id);
  EXPECT_EQ(1u, filled.transmit_pdos[0].mapping.size());
}

// A mapping with single bits, with too many objects or without its values cannot be taken over.
TEST_F(EdsCheckTest, LeavesMappingsItCannotExpress) {
  config.receive_pdos = {pdo(1, 0x232, {})};
  object(0x1600, 2).value = EdsNumber{0x30020101, false};
  EXPECT_TRUE(filledFromEds(config, file).receive_pdos[0].mapping.empty());
  object(0x1600, 2).value.reset();
  EXPECT_TRUE(filledFromEds(config, file).receive_pdos[0].mapping.empty());
  object(0x1600, 0).value = EdsNumber{64, false};
  EXPECT_TRUE(filledFromEds(config, file).receive_pdos[0].mapping.empty());
}

}  // namespace
}  // namespace nord_driver::canopen
