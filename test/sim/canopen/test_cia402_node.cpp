#include <gtest/gtest.h>

#include <cmath>

#include "sim/canopen/can_conversation.h"

namespace nord_driver::sim {
namespace {

using std::chrono::milliseconds;
using Frames = std::vector<std::string>;

// The velocity mode with P551 on: objects 6040h-6044h instead of 3000h-3003h, rpm instead of shares of P105, set 1 only
// (BU 0060 p. 57; words and bits as BU 0070 6.4). Two pole pairs: 25 Hz are 750 rpm.
class Cia402Node : public testing::Test {
 protected:
  static SimConfig config() {
    CanDriveConfig can;
    can.cia402 = true;
    return oneCanDrive(can);
  }
  Cia402Node() { bus.boot(); }
  void enable() {
    bus.start();
    bus.repeat("232#06000000", milliseconds(50), "1B2");
    bus.repeat("232#07000000", milliseconds(50), "1B2");
  }
  CanConversation bus{config()};
};

TEST_F(Cia402Node, ObjectsReplaceTheOthers) {
  EXPECT_EQ("4B41600070060000", bus.sdo("40 41 60 00 00 00 00 00"));
  EXPECT_EQ("8001300000000206", bus.sdo("40 01 30 00 00 00 00 00"));
  EXPECT_EQ("4300100092010100", bus.sdo("40 00 10 00 00 00 00 00")) << "1000h: a drive of CiA 402";
  EXPECT_EQ("43001A0110004160", bus.sdo("40 00 1A 01 00 00 00 00"));
  EXPECT_EQ("43001A0210004460", bus.sdo("40 00 1A 02 00 00 00 00"));
  EXPECT_EQ("4300160210004260", bus.sdo("40 00 16 02 00 00 00 00"));
}

// Status: 0670 = switch-on disabled, remote, setpoint reached. Bit 10 of the control word is not asked for; operation
// needs bits 0-6 (BU 2700 6.4.3 no. 4).
TEST_F(Cia402Node, DrivesInRpm) {
  bus.send("000#0132");
  EXPECT_EQ(Frames{"1B2#70060000"}, bus.takeAfter(milliseconds(20)));
  EXPECT_EQ("1B2#31060000", bus.ask("232#06000000"));
  EXPECT_EQ("1B2#33060000", bus.ask("232#07000000"));
  bus.ask("232#0F000000");
  EXPECT_EQ(InverterState::kSwitchedOn, bus.drive().inverter().state()) << "bits 4-6 are missing";
  bus.repeat("232#7F00EE02", seconds(3.0), "1B2");  // 02EEh = 750 rpm
  EXPECT_EQ(InverterState::kOperationEnabled, bus.drive().inverter().state());
  EXPECT_NEAR(25.0, bus.drive().inverter().frequency(), 0.01);
  EXPECT_EQ("4B436000EE020000", bus.sdo("40 43 60 00 00 00 00 00")) << "behind the ramp";
  EXPECT_NEAR(bus.drive().shaftSpeed() * 30.0 / M_PI, 750.0, 20.0);
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
}

// Left: by the sign, or by bit 11 of the control word (0 = right); bit 14 of the status word tells it.
TEST_F(Cia402Node, Direction) {
  enable();
  bus.repeat("232#7F0012FD", seconds(3.0), "1B2");  // -750 rpm
  EXPECT_NEAR(-25.0, bus.drive().inverter().frequency(), 0.01);
  EXPECT_EQ("4B41600037460000", bus.sdo("40 41 60 00 00 00 00 00"));
  bus.repeat("232#7F08EE02", seconds(3.0), "1B2");
  EXPECT_NEAR(-25.0, bus.drive().inverter().frequency(), 0.01);
}

// Above P105 (1500 rpm) the setpoint is cut, and bit 11 says so.
TEST_F(Cia402Node, Limit) {
  enable();
  bus.repeat("232#7F00D007", seconds(4.0), "1B2");  // 2000 rpm
  EXPECT_NEAR(50.0, bus.drive().inverter().frequency(), 0.01);
  EXPECT_EQ("4B416000370E0000", bus.sdo("40 41 60 00 00 00 00 00"));
}

// The parameter set cannot be chosen: bits 14 and 15 are free.
TEST_F(Cia402Node, SetOneOnly) {
  enable();
  bus.repeat("232#7FC00000", milliseconds(50), "1B2");
  EXPECT_EQ(0u, bus.drive().inverter().parameterSet());
}

// 6046h, 6048h, 6049h: limits and ramps in rpm and s, over P104, P105, P102, P103 of set 1; 603Fh the fault's code.
TEST_F(Cia402Node, LimitsRampsAndErrorCode) {
  EXPECT_EQ("43466002DC050000", bus.sdo("40 46 60 02 00 00 00 00")) << "1500 rpm";
  EXPECT_EQ("6046600200000000", bus.sdo("23 46 60 02 EE 02 00 00"));
  EXPECT_EQ(250, bus.drive().parameters().value(105));
  EXPECT_EQ("43486001EE020000", bus.sdo("40 48 60 01 00 00 00 00"));
  EXPECT_EQ("6048600200000000", bus.sdo("2B 48 60 02 05 00 00 00"));
  EXPECT_EQ(500, bus.drive().parameters().value(102));
  EXPECT_EQ("4B49600202000000", bus.sdo("40 49 60 02 00 00 00 00"));
  bus.drive().inverter().trip(50, false);
  EXPECT_EQ("433F600010320000", bus.sdo("40 3F 60 00 00 00 00 00"));
}

// P551 counts from the next start of the module on.
TEST_F(Cia402Node, ProfileChangesWithAReset) {
  EXPECT_EQ("6027220000000000", bus.sdo("2B 27 22 00 00 00 00 00"));
  EXPECT_EQ("8001300000000206", bus.sdo("40 01 30 00 00 00 00 00"));
  bus.send("000#8132");
  bus.bus.run(milliseconds(200));
  EXPECT_EQ("4B013000700B0000", bus.sdo("40 01 30 00 00 00 00 00"));
}

}  // namespace
}  // namespace nord_driver::sim
