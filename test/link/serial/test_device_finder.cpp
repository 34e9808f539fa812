#include "link/serial/port_fixture.h"

namespace nord_driver::link {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* kOurs = "/dev/serial/by-id/usb-FTDI_FT232R_USB_UART_A50285BI-if00-port0";
constexpr const char* kOther = "/dev/serial/by-id/usb-FTDI_FT232R_USB_UART_A9999999-if00-port0";

class Adapter : public PortFixture {
 protected:
  Adapter() {
    system.devices.clear();
    system.plugIn("/dev/ttyUSB0", kOurs);
  }
  /// The port notices that its adapter is gone.
  static void notice(SerialPort& port) {
    EXPECT_FALSE(port.waitReadable(port.now() + std::chrono::milliseconds{1}));
    EXPECT_FALSE(port.isOpen());
  }
};

TEST_F(Adapter, ComesBackUnderItsName) {
  SerialPort port = makePort();
  ASSERT_TRUE(port.open());
  system.unplug("/dev/ttyUSB0");
  notice(port);
  EXPECT_FALSE(port.open());
  EXPECT_THAT(port.lastError(), AllOf(HasSubstr("/dev/ttyUSB0"), HasSubstr(kOurs), HasSubstr("not plugged in")));
  system.plugIn("/dev/ttyUSB0", kOurs);
  EXPECT_TRUE(port.open()) << port.lastError();
}

TEST_F(Adapter, ComesBackUnderAnotherName) {
  SerialPort port = makePort();
  ASSERT_TRUE(port.open());
  system.unplug("/dev/ttyUSB0");
  notice(port);
  system.plugIn("/dev/ttyUSB3", kOurs);
  EXPECT_TRUE(port.open()) << port.lastError();
  EXPECT_THAT(system.opened, ElementsAre("/dev/ttyUSB0", "/dev/ttyUSB3"));
  system.unplug("/dev/ttyUSB3");
  notice(port);
  EXPECT_THAT(port.lastError(), HasSubstr("/dev/ttyUSB0 (/dev/ttyUSB3): was unplugged"));
}

// Another adapter under our name leads to another bus.
TEST_F(Adapter, AStrangerUnderItsNameIsNotTaken) {
  SerialPort port = makePort();
  ASSERT_TRUE(port.open());
  system.unplug("/dev/ttyUSB0");
  notice(port);
  system.plugIn("/dev/ttyUSB0", kOther);
  EXPECT_FALSE(port.open());
  EXPECT_THAT(port.lastError(), HasSubstr("not plugged in"));
  system.plugIn("/dev/ttyUSB1", kOurs);
  EXPECT_TRUE(port.open());
  EXPECT_EQ("/dev/ttyUSB1", system.opened.back());
}

TEST_F(Adapter, WithoutFollowingTheNameIsAllThatCounts) {
  settings.follow_adapter = false;
  SerialPort port = makePort();
  ASSERT_TRUE(port.open());
  system.unplug("/dev/ttyUSB0");
  notice(port);
  system.plugIn("/dev/ttyUSB3", kOurs);
  EXPECT_FALSE(port.open());
  EXPECT_THAT(port.lastError(), HasSubstr("cannot be opened: No such file"));
  system.plugIn("/dev/ttyUSB0", kOther);
  EXPECT_TRUE(port.open());
}

// Adapters without a serial number share one name: there is nothing to follow.
TEST_F(Adapter, WithoutASerialNumberTheNameIsAllThereIs) {
  system.serial_links.clear();
  SerialPort port = makePort();
  ASSERT_TRUE(port.open());
  system.devices.clear();
  system.hung_up = true;
  notice(port);
  system.hung_up = false;
  system.devices["/dev/ttyUSB0"] = DeviceKind::kSerial;
  EXPECT_TRUE(port.open()) << port.lastError();
}

TEST_F(Adapter, AConfiguredLinkIsFollowedAtEveryOpening) {
  settings.device = kOurs;
  SerialPort port = makePort();
  ASSERT_TRUE(port.open());
  system.unplug("/dev/ttyUSB0");
  notice(port);
  EXPECT_FALSE(port.open());
  EXPECT_THAT(port.lastError(), AllOf(HasSubstr(kOurs), HasSubstr("No such file")));
  system.plugIn("/dev/ttyUSB2", kOurs);
  EXPECT_TRUE(port.open());
  EXPECT_THAT(system.opened, ElementsAre("/dev/ttyUSB0", "/dev/ttyUSB2"));
}

// A link of the user's own may lead to a spare adapter tomorrow: that is what it is for.
TEST_F(Adapter, AUsersOwnLinkMayLeadToAnotherAdapter) {
  settings.device = "/dev/profibus";
  system.links["/dev/profibus"] = "/dev/ttyUSB0";
  SerialPort port = makePort();
  ASSERT_TRUE(port.open());
  system.unplug("/dev/ttyUSB0");
  notice(port);
  system.plugIn("/dev/ttyUSB0", kOther);
  EXPECT_TRUE(port.open());
}

// Not there at the start: remembered at the first opening all the same.
TEST_F(Adapter, IsRememberedWhenItComesLate) {
  system.unplug("/dev/ttyUSB0");
  SerialPort port = makePort();
  EXPECT_FALSE(port.open());
  EXPECT_THAT(port.lastError(), HasSubstr("No such file"));
  system.plugIn("/dev/ttyUSB0", kOurs);
  ASSERT_TRUE(port.open());
  system.unplug("/dev/ttyUSB0");
  notice(port);
  system.plugIn("/dev/ttyUSB7", kOurs);
  EXPECT_TRUE(port.open());
}

TEST_F(Adapter, ANameTooLongIsRefusedAndNotCut) {
  settings.device = "/dev/" + std::string(300, 'x');
  SerialPort port = makePort();
  EXPECT_FALSE(port.open());
  EXPECT_THAT(port.lastError(), HasSubstr("more than 255 characters"));
}

}  // namespace
}  // namespace nord_driver::link
