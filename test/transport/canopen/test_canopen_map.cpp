// Objects and PDO layouts of the four ways an inverter sits on CAN.
#include <gtest/gtest.h>

#include "transport/canopen/canopen_map.h"

namespace nord_driver {
namespace {

using canopen::NodeConfig;
using canopen::PdoConfig;
using profile::ParameterRequest;
using profile::ParameterShape;
using std::chrono::milliseconds;

CanopenDrive drive(std::uint8_t process_values = 1) {
  CanopenDrive config;
  config.process_values = process_values;
  return config;
}

CanopenDrive swapped() {
  CanopenDrive config = drive(3);
  config.series = profile::Series::kSk700e;
  config.third_before_second = true;
  return config;
}

CanopenDrive behindGateway(std::uint8_t inverter) {
  CanopenDrive config = drive(3);
  config.series = profile::Series::kSk2xxe;
  config.connection = CanopenConnection::kGateway;
  config.inverter = inverter;
  return config;
}

std::string hex(const PdoBytes& bytes) {
  return toHex(ByteView{bytes});
}

ByteView bytes(const FixedBytes<8>& of) {
  return ByteView{of};
}

NodeConfig node50() {
  NodeConfig node;
  node.id = 50;
  return node;
}

// --- Process data ----------------------------------------------------------------------------------------------------

// BU 0060 p. 96: 232#7F040020.
TEST(CanopenMap, OneValueIsLittleEndian) {
  EXPECT_EQ("7E 04 00 00", hex(packPdo(drive(), {0x047E, {0, 7, 7}})));
  EXPECT_EQ("7F 04 00 20", hex(packPdo(drive(), {0x047F, {0x2000, 7, 7}})));
  profile::ProcessInput input;
  ASSERT_TRUE(unpackPdo(drive(), bytes({0x37, 0x0B, 0x00, 0x20}), input));
  EXPECT_TRUE((profile::ProcessInput{0x0B37, {0x2000, 0, 0}} == input));
}

// BU 0060 p. 59: word 3 is value 2 on SK 5xxE, value 3 on SK 300E, 700E and 750E.
TEST(CanopenMap, ThreeValuesStandInTheOrderOfTheSeries) {
  EXPECT_EQ("7F 04 01 00 02 00 03 00", hex(packPdo(drive(3), {0x047F, {1, 2, 3}})));
  EXPECT_EQ("7F 04 01 00 03 00 02 00", hex(packPdo(swapped(), {0x047F, {1, 2, 3}})));
  profile::ProcessInput input;
  ASSERT_TRUE(unpackPdo(swapped(), bytes({0x37, 0x0B, 1, 0, 3, 0, 2, 0}), input));
  EXPECT_TRUE((profile::ProcessInput{0x0B37, {1, 2, 3}} == input));
  ASSERT_TRUE(unpackPdo(drive(3), bytes({0x37, 0x0B, 1, 0, 2, 0, 3, 0}), input));
  EXPECT_TRUE((profile::ProcessInput{0x0B37, {1, 2, 3}} == input));
}

// A PDO whose mapping was changed by somebody must not be read as something else.
TEST(CanopenMap, AShortPdoIsRefused) {
  profile::ProcessInput input{0x0B37, {1, 2, 3}};
  EXPECT_FALSE(unpackPdo(drive(3), bytes({0x37, 0x0B, 0x00, 0x20}), input));
  EXPECT_EQ(0x0B37, input.status_word);
  profile::Cia402Input words;
  EXPECT_FALSE(unpackCia402(bytes({0x37, 0x06, 0x00}), words));
}

TEST(CanopenMap, Cia402WordsAreLittleEndianToo) {
  EXPECT_EQ("7F 00 24 FA", hex(packCia402({0x007F, -1500})));
  profile::Cia402Input words;
  ASSERT_TRUE(unpackCia402(bytes({0x37, 0x06, 0x24, 0xFA}), words));
  EXPECT_EQ(0x0637, words.status_word);
  EXPECT_EQ(-1500, words.actual_velocity);
}

// --- PDOs ------------------------------------------------------------------------------------------------------------

// BU 0060 p. 58, 59, 96: 200h + N and 180h + N, 3000h and 3002h:1 there, 3001h and 3003h:1 back, sent at once.
TEST(CanopenMap, OneValueUsesPdoOne) {
  CanopenDrive config = drive();
  NodeConfig node = node50();
  CanopenPdoOptions pdo;
  pdo.write_mapping = true;
  pdo.inhibit_time = milliseconds{10};
  pdo.event_time = milliseconds{50};
  addPdos(config, pdo, node);
  ASSERT_EQ(1u, node.receive_pdos.size());
  ASSERT_EQ(1u, node.transmit_pdos.size());
  const PdoConfig& receive = node.receive_pdos[config.receive_pdo];
  EXPECT_EQ(1, receive.number);
  EXPECT_EQ(0x232u, receive.cob_id);
  EXPECT_EQ(255, receive.transmission_type);
  ASSERT_EQ(2u, receive.mapping.size());
  EXPECT_EQ(0x30000010u, receive.mapping[0].value());
  EXPECT_EQ(0x30020110u, receive.mapping[1].value());
  const PdoConfig& transmit = node.transmit_pdos[config.transmit_pdo];
  EXPECT_EQ(0x1B2u, transmit.cob_id);
  EXPECT_EQ(0x30010010u, transmit.mapping[0].value());
  EXPECT_EQ(0x30030110u, transmit.mapping[1].value());
  EXPECT_EQ(100, transmit.inhibit_time.value()) << "units of 100 us";
  EXPECT_EQ(50, transmit.event_timer.value()) << "ms";
}

// BU 0060 p. 59: TPDO 1 off, then TPDO 2 on; all RPDOs are on as delivered.
TEST(CanopenMap, ThreeValuesSwitchToPdoTwo) {
  CanopenDrive config = drive(3);
  NodeConfig node = node50();
  addPdos(config, {}, node);
  ASSERT_EQ(2u, node.transmit_pdos.size());
  EXPECT_EQ(1, node.transmit_pdos[0].number);
  EXPECT_FALSE(node.transmit_pdos[0].enabled);
  EXPECT_EQ(0x1B2u, node.transmit_pdos[0].cob_id);
  EXPECT_EQ(1u, config.transmit_pdo);
  EXPECT_EQ(2, node.transmit_pdos[1].number);
  EXPECT_TRUE(node.transmit_pdos[1].enabled);
  EXPECT_EQ(0x2B2u, node.transmit_pdos[1].cob_id);
  ASSERT_EQ(1u, node.receive_pdos.size());
  EXPECT_EQ(0x332u, node.receive_pdos[0].cob_id);
  EXPECT_TRUE(node.transmit_pdos[1].mapping.empty()) << "the mapping as delivered";
}

TEST(CanopenMap, AMappingThatIsWrittenFollowsTheSeries) {
  CanopenDrive config = swapped();
  NodeConfig node = node50();
  CanopenPdoOptions pdo;
  pdo.write_mapping = true;
  addPdos(config, pdo, node);
  const auto& mapping = node.receive_pdos[0].mapping;
  ASSERT_EQ(4u, mapping.size());
  EXPECT_EQ(0x30020110u, mapping[1].value());
  EXPECT_EQ(0x30020310u, mapping[2].value());
  EXPECT_EQ(0x30020210u, mapping[3].value());
}

// BU 0260 p. 40 to 42: the n-th PDOs are inverter n's, 3000h:n its control word, three setpoints each.
TEST(CanopenMap, BehindAGatewayPdoNumberNIsInverterNs) {
  CanopenDrive second = behindGateway(2), fourth = behindGateway(4);
  NodeConfig node = node50();
  CanopenPdoOptions pdo;
  pdo.write_mapping = true;
  addPdos(second, pdo, node);
  addPdos(fourth, pdo, node);
  ASSERT_EQ(2u, node.receive_pdos.size());
  ASSERT_EQ(2u, node.transmit_pdos.size());
  EXPECT_EQ(1u, fourth.receive_pdo);
  EXPECT_EQ(2, node.receive_pdos[0].number);
  EXPECT_EQ(0x332u, node.receive_pdos[0].cob_id);
  EXPECT_EQ(0x532u, node.receive_pdos[1].cob_id);
  EXPECT_EQ(0x4B2u, node.transmit_pdos[1].cob_id);
  EXPECT_EQ(0x30000410u, node.receive_pdos[1].mapping[0].value());
  EXPECT_EQ(0x30020A10u, node.receive_pdos[1].mapping[1].value());
  EXPECT_EQ(0x30020C10u, node.receive_pdos[1].mapping[3].value());
  EXPECT_EQ(0x30030410u, node.transmit_pdos[0].mapping[1].value());
}

// BU 0060 p. 57: with P551 on, 6040h to 6044h stand in for 3000h to 3003h.
TEST(CanopenMap, Cia402MapsItsOwnObjects) {
  CanopenDrive config = drive();
  config.drive_profile = DriveProfile::kCia402;
  NodeConfig node = node50();
  CanopenPdoOptions pdo;
  pdo.write_mapping = true;
  addPdos(config, pdo, node);
  EXPECT_EQ(0x60400010u, node.receive_pdos[0].mapping[0].value());
  EXPECT_EQ(0x60420010u, node.receive_pdos[0].mapping[1].value());
  EXPECT_EQ(0x60410010u, node.transmit_pdos[0].mapping[0].value());
  EXPECT_EQ(0x60440010u, node.transmit_pdos[0].mapping[1].value());
}

// With SYNC every inverter answers every cycle: its own timers have no say.
TEST(CanopenMap, SynchronousPdosHaveNoTimers) {
  CanopenDrive config = drive();
  NodeConfig node = node50();
  CanopenPdoOptions pdo;
  pdo.synchronous = true;
  pdo.event_time = milliseconds{50};
  addPdos(config, pdo, node);
  EXPECT_EQ(1, node.receive_pdos[0].transmission_type);
  EXPECT_EQ(1, node.transmit_pdos[0].transmission_type);
  EXPECT_FALSE(node.transmit_pdos[0].event_timer.has_value());
}

// --- Parameters ------------------------------------------------------------------------------------------------------

ParameterRequest request(std::uint16_t number, ParameterShape shape, std::uint8_t set = 1, std::uint8_t index = 1) {
  ParameterRequest result;
  result.number = number;
  result.shape = shape;
  result.parameter_set = set;
  result.index = index;
  return result;
}

std::pair<int, int> object(const ParameterRequest& of, const CanopenDrive& config = drive()) {
  const auto address = parameterObject(config, of);
  return address ? std::pair<int, int>{address->index, address->sub_index} : std::pair<int, int>{-1, -1};
}

// BU 0060 p. 61: 2000h + number; P102 of set 1 is 2066h:1; sub-index 4 (n - 1) + p for elements of sets.
TEST(CanopenMap, ParametersAreObjectsFrom2000h) {
  EXPECT_EQ(std::make_pair(0x2066, 1), object(request(102, ParameterShape::kPerSet, 1)));
  EXPECT_EQ(std::make_pair(0x2066, 4), object(request(102, ParameterShape::kPerSet, 4)));
  EXPECT_EQ(std::make_pair(0x2201, 0), object(request(513, ParameterShape::kPlain)));
  EXPECT_EQ(std::make_pair(0x221F, 7), object(request(543, ParameterShape::kArrayPerSet, 3, 2)));
  EXPECT_EQ(std::make_pair(0x23E7, 0), object(request(999, ParameterShape::kPlain)));
}

// BU 0060 contradicts itself on arrays without sets (p. 54 against p. 61): the element, unless configured otherwise.
TEST(CanopenMap, ArraysWithoutSetsAreSwitchable) {
  EXPECT_EQ(std::make_pair(0x22BC, 3), object(request(700, ParameterShape::kArray, 1, 3)));
  CanopenDrive table = drive();
  table.array_sub_index = ArraySubIndex::kTable;
  EXPECT_EQ(std::make_pair(0x22BC, 9), object(request(700, ParameterShape::kArray, 1, 3), table));
  EXPECT_EQ(std::make_pair(0x22BC, 1), object(request(700, ParameterShape::kArray, 1, 1), table));
}

// BU 0270 p. 43 (the EtherCAT sibling): an offset of 0800h per inverter, where it is configured so.
TEST(CanopenMap, AnIndexOffsetIsAdded) {
  CanopenDrive config = behindGateway(1);
  config.parameter_base = 0x2800;
  EXPECT_EQ(std::make_pair(0x2866, 1), object(request(102, ParameterShape::kPerSet, 1), config));
}

// The EtherCAT module's own parameters are at 2000h, without an offset (BU 0570 p. 25).
TEST(CanopenMap, TheModulesOwnParametersHaveNoOffset) {
  CanopenDrive config = behindGateway(2);
  config.parameter_base = 0x3000;
  EXPECT_EQ(std::make_pair(0x3000 + 149, 0), object(request(149, ParameterShape::kPlain), config));
  EXPECT_EQ(std::make_pair(0x2000 + 150, 0), object(request(150, ParameterShape::kPlain), config));
  EXPECT_EQ(std::make_pair(0x2000 + 173, 2), object(request(173, ParameterShape::kArray, 1, 2), config));
  EXPECT_EQ(std::make_pair(0x2000 + 199, 0), object(request(199, ParameterShape::kPlain), config));
  EXPECT_EQ(std::make_pair(0x3000 + 200, 0), object(request(200, ParameterShape::kPlain), config));
}

TEST(CanopenMap, WhatIsNoParameterHasNoObject) {
  EXPECT_EQ(-1, object(request(1000, ParameterShape::kPlain)).first);
  EXPECT_EQ(-1, object(request(102, ParameterShape::kPerSet, 0)).first);
  EXPECT_EQ(-1, object(request(102, ParameterShape::kPerSet, 5)).first);
  EXPECT_EQ(-1, object(request(700, ParameterShape::kArray, 1, 0)).first);
  EXPECT_EQ(-1, object(request(700, ParameterShape::kArrayPerSet, 1, 65)).first) << "sub-index 257";
}

}  // namespace
}  // namespace nord_driver
