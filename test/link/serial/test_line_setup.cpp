#include "link/serial/port_fixture.h"

namespace nord_driver::link {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class LineSetup : public PortFixture {
 protected:
  std::string refusal() {
    SerialPort port = makePort();
    EXPECT_FALSE(port.open());
    EXPECT_FALSE(port.isOpen());
    EXPECT_EQ(0, system.open_descriptors) << "a refused device stays open";
    return port.lastError();
  }
  void expectOpens() {
    SerialPort port = makePort();
    EXPECT_TRUE(port.open()) << port.lastError();
    EXPECT_THAT(port.lastError(), IsEmpty());
    EXPECT_TRUE(port.keepsBaudRate());
  }
};

// A UART of a PC (1.8432 MHz / 16) does 115.2 kbit/s when asked for 93.75: 23 % off.
TEST_F(LineSetup, ARateThatIsOffIsRefusedWithWantedAndReal) {
  settings.baud_rate = BaudRate{93'750};
  system.real_rate = 115'200;
  EXPECT_THAT(refusal(), AllOf(HasSubstr("/dev/ttyUSB0"), HasSubstr("93750 bit/s"), HasSubstr("115200 bit/s"),
                               HasSubstr("+22.9 %"), HasSubstr("0.5 %")));
  system.real_rate = 57'600;
  EXPECT_THAT(refusal(), AllOf(HasSubstr("57600 bit/s"), HasSubstr("-38.6 %")));
}

// 0.5 % and not more, on both sides.
TEST_F(LineSetup, ARateOnTheEdgeIsTaken) {
  settings.baud_rate = BaudRate{500'000};
  for (const std::uint32_t real : {497'500u, 500'000u, 502'500u}) {
    system.real_rate = real;
    expectOpens();
  }
  for (const std::uint32_t real : {497'499u, 502'501u}) {
    system.real_rate = real;
    EXPECT_THAT(refusal(), HasSubstr(std::to_string(real)));
  }
}

TEST_F(LineSetup, EveryStandardRateIsAskedForAsItIs) {
  for (const std::uint32_t rate :
       {9'600u, 19'200u, 45'450u, 93'750u, 187'500u, 500'000u, 1'500'000u, 3'000'000u, 6'000'000u, 12'000'000u}) {
    settings.baud_rate = BaudRate{rate};
    expectOpens();
    EXPECT_EQ(rate, system.rate.bitsPerSecond());
  }
}

// The mini UART of a Raspberry Pi has no parity: every character would be wrong.
TEST_F(LineSetup, AUartWithoutParityIsRefused) {
  system.has_parity = false;
  EXPECT_THAT(refusal(), HasSubstr("even parity"));
}

TEST_F(LineSetup, OtherCharactersAreRefused) {
  system.has_eight_bits = false;
  EXPECT_THAT(refusal(), HasSubstr("eight data bits"));
}

TEST_F(LineSetup, ALineThatTakesNoSettingIsRefused) {
  system.set_line_error = EINVAL;
  EXPECT_THAT(refusal(), AllOf(HasSubstr("8E1 at 500000 bit/s"), HasSubstr("Invalid argument")));
}

// A pty takes every rate and reads parity back as off: named as a pty, not refused.
TEST_F(LineSetup, APtyIsNamedAndNotRefused) {
  system.devices["/dev/ttyUSB0"] = DeviceKind::kPty;
  system.real_rate = 38'400;
  system.has_parity = false;
  SerialPort port = makePort();
  ASSERT_TRUE(port.open()) << port.lastError();
  EXPECT_FALSE(port.keepsBaudRate());
}

// A robot whose UART switches by the kernel is driven in the simulator with its own configuration.
TEST_F(LineSetup, APtyHasNoRs485ToBeSwitched) {
  system.devices["/dev/ttyUSB0"] = DeviceKind::kPty;
  system.rs485_error = ENOTTY;
  settings.rs485.enabled = true;
  SerialPort port = makePort();
  EXPECT_TRUE(port.open()) << port.lastError();
  EXPECT_EQ(0, system.rs485_requests);
}

TEST_F(LineSetup, WhatIsNoSerialDeviceOrLockedIsRefused) {
  system.devices["/dev/ttyUSB0"] = DeviceKind::kNoSerialDevice;
  EXPECT_THAT(refusal(), HasSubstr("no serial device"));
  system.devices["/dev/ttyUSB0"] = DeviceKind::kSerial;
  system.lock_error = EWOULDBLOCK;
  EXPECT_THAT(refusal(), HasSubstr("is in use by another process"));
  system.lock_owner = "nord_driver_node (process 4242)";
  EXPECT_THAT(refusal(), HasSubstr("is in use by nord_driver_node (process 4242)"));
}

// Low latency is asked for at every opening; a driver without the knob is no worse for it.
TEST_F(LineSetup, LowLatencyIsAskedForAndItsRefusalHarmless) {
  expectOpens();
  EXPECT_EQ(1, system.low_latency_requests);
  system.has_low_latency = false;
  expectOpens();
  EXPECT_EQ(2, system.low_latency_requests);
}

// 16 ms per answer would be the largest part of a cycle: said, though it works.
TEST_F(LineSetup, ASlowLatencyTimerIsWarnedAbout) {
  system.latency_timers["/dev/ttyUSB0"] = 16;
  SerialPort port = makePort();
  ASSERT_TRUE(port.open());
  EXPECT_THAT(port.warning(), AllOf(HasSubstr("/dev/ttyUSB0"), HasSubstr("16 ms"), HasSubstr("latency_timer")));
  system.latency_timers["/dev/ttyUSB0"] = 1;
  ASSERT_TRUE(port.open());
  EXPECT_STREQ("", port.warning());
}

TEST_F(LineSetup, Rs485IsLeftAloneUnlessWanted) {
  expectOpens();
  EXPECT_EQ(0, system.rs485_requests);
}

TEST_F(LineSetup, Rs485IsToldEverything) {
  settings.rs485 = {true, false, true, true, 2, 3};
  expectOpens();
  EXPECT_EQ(1, system.rs485_requests);
  EXPECT_TRUE(system.rs485.enabled);
  EXPECT_FALSE(system.rs485.rts_on_send);
  EXPECT_TRUE(system.rs485.rts_after_send);
  EXPECT_TRUE(system.rs485.rx_during_tx);
  EXPECT_EQ(2u, system.rs485.delay_before_ms);
  EXPECT_EQ(3u, system.rs485.delay_after_ms);
}

TEST_F(LineSetup, AnAdapterWithoutRs485IsRefusedInWords) {
  settings.rs485.enabled = true;
  system.rs485_error = ENOTTY;
  EXPECT_THAT(refusal(), AllOf(HasSubstr("RS-485"), HasSubstr("needs no bus/rs485")));
}

// Linux takes what it can of these settings and says nothing: read back.
TEST_F(LineSetup, Rs485IsReadBack) {
  settings.rs485 = {true, true, false, true, 0, 0};
  system.rs485_mask.rx_during_tx = false;
  EXPECT_THAT(refusal(), HasSubstr("bus/rs485/rx_during_tx as false, not as true"));
  settings.rs485 = {true, true, false, false, 5, 0};
  system.rs485_mask.delay_before_ms = 1;
  EXPECT_THAT(refusal(), HasSubstr("as 1 and 0 ms, not as 5 and 0 ms"));
}

}  // namespace
}  // namespace nord_driver::link
