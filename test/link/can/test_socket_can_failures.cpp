#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "link/can/fake_can_system.h"
#include "link/can/socket_can.h"

namespace nord_driver::link {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const CanFrame kFrame = dataFrame(0x232, std::array<std::uint8_t, 2>{0x7E, 0x04});

class SocketCanFailures : public ::testing::Test {
 protected:
  CanSettings settings() const {
    CanSettings all;
    all.interface = "can0";
    all.ids = {0x1B2};
    all.bit_rate = 500'000;
    return all;
  }
  std::string whyNot() {
    EXPECT_FALSE(link.open());
    EXPECT_FALSE(link.isOpen());
    EXPECT_EQ(0, kernel.open_descriptors);
    return link.lastError();
  }
  /// Lets the link see what happened.
  void look() { link.waitReadable(kernel.time + milliseconds{1}); }

  FakeCanSystem kernel;
  SocketCan link{settings(), kernel};
  ReceivedCanFrame received;
};

TEST_F(SocketCanFailures, AKernelWithoutCanIsNamed) {
  kernel.open_error = EAFNOSUPPORT;
  EXPECT_THAT(whyNot(), AllOf(StartsWith("can0: this kernel has no CAN"), HasSubstr("virtual:NAME")));
}

TEST_F(SocketCanFailures, AMissingInterfaceIsNamed) {
  kernel.interface.name = "can1";
  EXPECT_THAT(whyNot(), StartsWith("can0: there is no such interface"));
}

TEST_F(SocketCanFailures, AnInterfaceThatIsNoCanBusIsRefused) {
  kernel.interface.is_can = false;
  EXPECT_THAT(whyNot(), HasSubstr("is no CAN interface"));
}

TEST_F(SocketCanFailures, ListenOnlyIsRefusedInWords) {
  kernel.interface.listen_only = true;
  EXPECT_THAT(whyNot(), AllOf(HasSubstr("listens only"), HasSubstr("ip link set can0 type can listen-only off")));
}

// A wrong rate disturbs everybody on the bus.
TEST_F(SocketCanFailures, AnotherBitRateIsRefused) {
  kernel.interface.bit_rate = 250'000;
  EXPECT_THAT(whyNot(), AllOf(HasSubstr("runs at 250000 bit/s, and 500000 bit/s are configured"),
                              HasSubstr("type can bitrate 500000")));
}

// The kernel tells what the controller's clock makes of the rate: 38.4 MHz give 498701 bit/s for 500000.
TEST_F(SocketCanFailures, WhatTheClockMakesOfTheBitRateIsTaken) {
  const auto problem = [](std::uint32_t configured, std::uint32_t real) {
    FakeCanSystem system;
    system.interface.bit_rate = real;
    CanSettings all;
    all.interface = "can0";
    all.bit_rate = configured;
    SocketCan opened{all, system};
    return opened.open() ? std::string{} : opened.lastError();
  };
  EXPECT_EQ("", problem(500'000, 498'701));
  EXPECT_EQ("", problem(500'000, 502'500));
  EXPECT_EQ("", problem(250'000, 249'350));
  EXPECT_EQ("", problem(1'000'000, 997'402));
  EXPECT_THAT(problem(500'000, 497'499), HasSubstr("runs at 497499 bit/s, and 500000 bit/s are configured"));
  EXPECT_THAT(problem(500'000, 480'000), HasSubstr("runs at 480000 bit/s, and 500000 bit/s are configured"));
  EXPECT_THAT(problem(500'000, 4'294'967'295), HasSubstr("runs at 4294967295 bit/s"));
}

TEST_F(SocketCanFailures, AnInterfaceWithoutBitRateIsTaken) {
  kernel.interface.bit_rate = 0;
  kernel.interface.has_controller = false;
  EXPECT_TRUE(link.open()) << link.lastError();
}

TEST_F(SocketCanFailures, WhatTheKernelRefusesIsNamed) {
  kernel.filter_error = EINVAL;
  EXPECT_THAT(whyNot(), HasSubstr("filters: Invalid argument"));
  kernel.filter_error = 0;
  kernel.bind_error = EACCES;
  EXPECT_THAT(whyNot(), HasSubstr("cannot be bound: Permission denied"));
  kernel.bind_error = 0;
  kernel.read_interface_error = EPERM;
  EXPECT_THAT(whyNot(), HasSubstr("does not tell about the interface: Operation not permitted"));
  kernel.read_interface_error = 0;
  kernel.open_error = EMFILE;
  EXPECT_THAT(whyNot(), HasSubstr("Too many open files"));
}

// Down is not gone: the socket works again after "ip link set can0 up".
TEST_F(SocketCanFailures, DownKeepsTheLinkOpen) {
  ASSERT_TRUE(link.open());
  kernel.send_errors = {ENETDOWN};
  EXPECT_EQ(CanSend::kFailed, link.send(kFrame));
  EXPECT_TRUE(link.isOpen());
  EXPECT_EQ(CanState::kDown, link.state());
  EXPECT_THAT(link.advice(), HasSubstr("can0 is down"));
  kernel.tell();  // up
  look();
  EXPECT_EQ(CanState::kActive, link.state());
  kernel.interface.up = false;
  kernel.arrivals.push_back({ENETDOWN, {}});
  EXPECT_FALSE(link.receive(received));
  EXPECT_EQ(CanState::kDown, link.state());
  EXPECT_EQ(CanSend::kSent, link.send(kFrame));  // without messages this is the proof
  EXPECT_EQ(CanState::kUnknown, link.state());
}

// The socket keeps the error until it is read: the message that it is up again may have been read before.
TEST_F(SocketCanFailures, AnOldErrorDoesNotHideThatItIsUpAgain) {
  ASSERT_TRUE(link.open());
  kernel.arrivals.push_back({ENETDOWN, {}});
  kernel.tell();  // up
  look();
  EXPECT_EQ(CanState::kActive, link.state());
  kernel.arrivals.push_back({ENETDOWN, {}});
  kernel.read_interface_error = EPERM;  // nobody tells: the error counts
  look();
  EXPECT_EQ(CanState::kDown, link.state());
}

TEST_F(SocketCanFailures, AnInterfaceThatIsDownCanBeOpened) {
  kernel.interface.up = false;
  ASSERT_TRUE(link.open()) << link.lastError();
  EXPECT_EQ(CanState::kDown, link.state());
}

// A bit rate can only be changed while down: it is looked at again.
TEST_F(SocketCanFailures, AnInterfaceThatComesBackOtherwiseIsRefused) {
  ASSERT_TRUE(link.open());
  kernel.interface.bit_rate = 125'000;
  kernel.tell();
  look();
  EXPECT_FALSE(link.isOpen());
  EXPECT_THAT(link.lastError(), HasSubstr("125000 bit/s"));
}

TEST_F(SocketCanFailures, RemovedClosesAndReopensUnderTheSameName) {
  for (const int error : {ENODEV, ENXIO}) {
    ASSERT_TRUE(link.open());
    kernel.arrivals.push_back({error, {}});
    EXPECT_FALSE(link.receive(received));
    EXPECT_FALSE(link.isOpen());
    EXPECT_EQ("can0: was removed", link.lastError());
    ASSERT_TRUE(link.open());
    kernel.send_errors = {error};
    EXPECT_EQ(CanSend::kFailed, link.send(kFrame));
    EXPECT_FALSE(link.isOpen());
  }
  ASSERT_TRUE(link.open());
  EXPECT_EQ("", link.lastError());
  kernel.interface.removed = true;
  kernel.tell();
  look();
  EXPECT_FALSE(link.isOpen());
  EXPECT_EQ(0, kernel.open_descriptors);
}

TEST_F(SocketCanFailures, MessagesOfOtherInterfacesDoNotConcernUs) {
  ASSERT_TRUE(link.open());
  FakeCanSystem::Message other{0, kernel.interface};
  other.interface.index = 4;
  other.interface.removed = true;
  kernel.messages = {other, {EPROTO, {}}};
  look();
  EXPECT_TRUE(link.isOpen());
}

// Too many messages at once: the kernel threw some away, so it is asked.
TEST_F(SocketCanFailures, LostMessagesAreAskedFor) {
  ASSERT_TRUE(link.open());
  kernel.interface.up = false;
  kernel.messages = {{ENOBUFS, {}}};
  look();
  EXPECT_EQ(CanState::kDown, link.state());
  kernel.interface.name = "can1";
  kernel.messages = {{ENOBUFS, {}}};
  look();
  EXPECT_FALSE(link.isOpen());
}

TEST_F(SocketCanFailures, WithoutMessagesItWorksAllTheSame) {
  kernel.interface_messages_error = EPERM;
  ASSERT_TRUE(link.open());
  kernel.arrive(kFrame);
  EXPECT_TRUE(link.waitReadable(kernel.time + milliseconds{1}));
}

TEST_F(SocketCanFailures, AnyOtherFailureClosesAndIsNamed) {
  ASSERT_TRUE(link.open());
  kernel.arrivals.push_back({EIO, {}});
  EXPECT_FALSE(link.receive(received));
  EXPECT_EQ("can0: cannot be read: Input/output error", link.lastError());
  ASSERT_TRUE(link.open());
  kernel.send_errors = {EINVAL};
  EXPECT_EQ(CanSend::kFailed, link.send(kFrame));
  EXPECT_EQ("can0: cannot be written: Invalid argument", link.lastError());
  ASSERT_TRUE(link.open());
  kernel.poll_errors = {ENOMEM};
  look();
  EXPECT_EQ("can0: cannot be waited for: Cannot allocate memory", link.lastError());
}

// In bus-off the kernel would take a frame and lose it.
TEST_F(SocketCanFailures, NothingIsSentInBusOff) {
  ASSERT_TRUE(link.open());
  kernel.arriveError(0x040);
  EXPECT_FALSE(link.receive(received));
  EXPECT_EQ(CanSend::kFailed, link.send(kFrame));
  EXPECT_TRUE(kernel.sent.empty());
  EXPECT_TRUE(link.isOpen());
  kernel.arriveError(0x100);
  EXPECT_FALSE(link.receive(received));
  EXPECT_EQ(CanSend::kSent, link.send(kFrame));
}

// restart-ms 0: nobody but us restarts it, at most once a second.
TEST_F(SocketCanFailures, ARestartIsAskedForOnceASecond) {
  ASSERT_TRUE(link.open());
  kernel.restart_error = EBUSY;
  kernel.arriveError(0x040);
  look();
  EXPECT_EQ(1, kernel.restarts);
  for (int i = 0; i < 10; ++i) {
    link.send(kFrame);
    look();
  }
  EXPECT_EQ(1, kernel.restarts);
  kernel.time += seconds{1};
  look();
  EXPECT_EQ(2, kernel.restarts);
}

TEST_F(SocketCanFailures, ARefusedRestartIsNotAskedForAgain) {
  ASSERT_TRUE(link.open());
  kernel.restart_error = EPERM;
  kernel.arriveError(0x040);
  look();
  kernel.time += seconds{5};
  look();
  EXPECT_EQ(1, kernel.restarts);
  EXPECT_THAT(link.advice(), HasSubstr("sudo ip link set can0 type can restart"));
}

TEST_F(SocketCanFailures, AnAutomaticRestartIsNotAskedFor) {
  kernel.interface.restart_ms = 100;
  ASSERT_TRUE(link.open());
  kernel.arriveError(0x040);
  look();
  EXPECT_EQ(0, kernel.restarts);
  EXPECT_THAT(link.advice(), HasSubstr("restarts by itself after 100 ms"));
}

}  // namespace
}  // namespace nord_driver::link
