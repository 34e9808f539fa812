// What the trace says beside each CANopen frame.
#include <gtest/gtest.h>

#include "core/can_trace.h"
#include "transport/canopen/canopen_frame_text.h"
#include "transport/canopen/canopen_map.h"

namespace nord_driver {
namespace {

CanopenConfig config() {
  CanopenConfig result;
  canopen::NodeConfig node;
  node.id = 50;
  node.sdo_servers.push_back(canopen::defaultSdoChannel(50));
  CanopenDrive drive;
  addPdos(drive, {}, node);
  canopen::NodeConfig speed_node;
  speed_node.id = 51;
  CanopenDrive speed_drive;
  speed_drive.drive_profile = DriveProfile::kCia402;
  speed_drive.node = 1;
  addPdos(speed_drive, {}, speed_node);
  canopen::NodeConfig module;
  module.id = 10;
  CanopenDrive third;
  third.connection = CanopenConnection::kGateway;
  third.inverter = 3;
  third.process_values = 3;
  third.node = 2;
  addPdos(third, {}, module);
  result.master.nodes = {node, speed_node, module};
  result.drives = {drive, speed_drive, third};
  return result;
}

std::string textOf(const CanFrame& frame) {
  TraceRecord record;
  const CanPacket packet = toPacket(frame);
  const ByteView bytes{packet};
  record.length = static_cast<std::uint8_t>(bytes.size());
  std::copy(bytes.begin(), bytes.end(), record.bytes.begin());
  return CanopenFrameText{config()}(record);
}
std::string textOf(std::uint32_t id, const FixedBytes<8>& data) {
  return textOf(dataFrame(id, ByteView{data}));
}

// BU 0060 p. 96.
TEST(CanopenFrameTextTest, ProcessDataAreToldByTheManualsNames) {
  EXPECT_EQ("RPDO 50 STW 047F SW1 2000", textOf(0x232, {0x7F, 0x04, 0x00, 0x20}));
  EXPECT_EQ("TPDO 50 ZSW 0B37 IW1 2000", textOf(0x1B2, {0x37, 0x0B, 0x00, 0x20}));
  EXPECT_EQ("RPDO 10/3 STW 047F SW1 0001 SW2 0002 SW3 0003", textOf(0x40A, {0x7F, 0x04, 1, 0, 2, 0, 3, 0}));
  EXPECT_EQ("TPDO 50 too short", textOf(0x1B2, {0x37, 0x0B}));
}

TEST(CanopenFrameTextTest, Cia402CountsInRpm) {
  EXPECT_EQ("RPDO 51 6040h 007F 6042h -1500 rpm", textOf(0x233, {0x7F, 0x00, 0x24, 0xFA}));
  EXPECT_EQ("TPDO 51 6041h 0637 6044h 750 rpm", textOf(0x1B3, {0x37, 0x06, 0xEE, 0x02}));
}

TEST(CanopenFrameTextTest, NetworkManagementIsTold) {
  EXPECT_EQ("NMT start 50", textOf(0x000, {0x01, 0x32}));
  EXPECT_EQ("NMT enter pre-operational all nodes", textOf(0x000, {0x80, 0x00}));
  EXPECT_EQ("guarding 50", textOf(remoteFrame(0x732, 1)));
  EXPECT_EQ("node 50 operational", textOf(0x732, {0x85}));
  EXPECT_EQ("SYNC", textOf(0x080, {}));
}

// BU 0060 p. 93.
TEST(CanopenFrameTextTest, EmergenciesHaveTheirWords) {
  EXPECT_EQ("EMCY 50 8100h (E10.0 .. E10.7): bus time-out or bus module",
            textOf(0x0B2, {0x00, 0x81, 1, 0, 0, 0, 0, 0}));
}

// BU 0060 p. 61 and 62.
TEST(CanopenFrameTextTest, SdoAccessesNameTheirObject) {
  EXPECT_EQ("SDO 50 write 2066h:1 = 0067h", textOf(0x632, {0x2B, 0x66, 0x20, 0x01, 0x67, 0, 0, 0}));
  EXPECT_EQ("SDO 50 written 2066h:1", textOf(0x5B2, {0x60, 0x66, 0x20, 0x01, 0, 0, 0, 0}));
  EXPECT_EQ("SDO 50 read 2066h:1", textOf(0x632, {0x40, 0x66, 0x20, 0x01, 0, 0, 0, 0}));
  EXPECT_EQ("SDO 50 answer 2066h:1 = 0067h", textOf(0x5B2, {0x4B, 0x66, 0x20, 0x01, 0x67, 0, 0, 0}));
  EXPECT_NE(std::string::npos, textOf(0x5B2, {0x80, 0x66, 0x20, 0x05, 0x11, 0, 0x09, 0x06}).find("abort 2066h:5"));
}

TEST(CanopenFrameTextTest, LongTransfersAreToldAsSuch) {
  EXPECT_EQ("SDO 50 write 2066h:1 in segments", textOf(0x632, {0x21, 0x66, 0x20, 0x01, 9, 0, 0, 0}));
  EXPECT_EQ("SDO 50 answer 2066h:1 in segments", textOf(0x5B2, {0x41, 0x66, 0x20, 0x01, 9, 0, 0, 0}));
  EXPECT_EQ("SDO 50 answer 2066h:1 = 04030201h", textOf(0x5B2, {0x42, 0x66, 0x20, 0x01, 1, 2, 3, 4}))
      << "no size is told";
  EXPECT_EQ("SDO 50 segment", textOf(0x632, {0x00, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ("SDO 50 segment", textOf(0x632, {0x60, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ("SDO 50 segment", textOf(0x5B2, {0x00, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ("SDO 50 segment", textOf(0x5B2, {0x20, 1, 2, 3, 4, 5, 6, 7}));
}

// What a length forbids to read is not read.
TEST(CanopenFrameTextTest, WrongLengthsAreNamed) {
  const FixedBytes<3> three{1, 2, 3};
  const auto said = [&three](std::uint32_t id) { return textOf(dataFrame(id, ByteView{three})); };
  EXPECT_EQ("NMT of a wrong length", said(0x000));
  EXPECT_EQ("EMCY of a wrong length", said(0x0B2));
  EXPECT_EQ("error control of a wrong length, 50", said(0x732));
  EXPECT_EQ("SDO 50 of a wrong length", said(0x632));
  EXPECT_EQ("of no node of ours", said(0x700)) << "there is no node 0";
  EXPECT_EQ("no frame", CanopenFrameText{config()}(TraceRecord{}));
}

TEST(CanopenFrameTextTest, WhatIsNotOursIsSaidToBeSo) {
  EXPECT_EQ("of no node of ours", textOf(0x1B9, {1, 2}));
  EXPECT_EQ("remote frame", textOf(remoteFrame(0x1B2, 4)));
  CanFrame extended = dataFrame(0x18DAF110, {});
  extended.extended = true;
  EXPECT_EQ("29 bit identifier: not CANopen", textOf(extended));
}

}  // namespace
}  // namespace nord_driver
