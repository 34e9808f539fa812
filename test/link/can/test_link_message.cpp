// Messages of rtnetlink about interfaces, put together as the kernel does (uapi linux/rtnetlink.h, linux/if_link.h,
// linux/can/netlink.h); the numbers are typed here by hand.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "link/can/can_interface.h"
#include "link/can/can_system.h"

namespace nord_driver::link {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes operator+(Bytes left, const Bytes& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

/// In the byte order of this machine, as the kernel's are.
template <typename T>
Bytes number(T value) {
  const auto* first = reinterpret_cast<const std::uint8_t*>(&value);
  return {first, first + sizeof value};
}

Bytes attribute(std::uint16_t type, const Bytes& value) {
  Bytes all = number(static_cast<std::uint16_t>(4 + value.size())) + number(type) + value;
  while (all.size() % 4 != 0) all.push_back(0);
  return all;
}

Bytes text(const std::string& word) {
  Bytes bytes(word.begin(), word.end());
  bytes.push_back(0);
  return bytes;
}

constexpr std::uint16_t kNewLink = 16;
constexpr std::uint16_t kDelLink = 17;
constexpr std::uint16_t kCanType = 280;
constexpr std::uint32_t kUp = 1;

Bytes message(std::uint16_t type, std::uint16_t device_type, std::uint32_t flags, const Bytes& attributes) {
  const Bytes body = Bytes{0, 0} + number(device_type) + number(std::int32_t{5}) + number(flags) +
                     number(std::uint32_t{0}) + attributes;
  return number(static_cast<std::uint32_t>(16 + body.size())) + number(type) + number(std::uint16_t{0}) +
         number(std::uint32_t{0}) + number(std::uint32_t{0}) + body;
}

Bytes controller(std::uint32_t state, std::uint32_t control_mode, std::uint32_t restart_ms) {
  const Bytes timing = number(std::uint32_t{250'000}) + Bytes(28, 0);
  return attribute(18,
                   attribute(1, text("can")) + attribute(2, attribute(1, timing) + attribute(4, number(state)) +
                                                                attribute(5, number(0xFFFFu) + number(control_mode)) +
                                                                attribute(6, number(restart_ms))));
}

Bytes nameAndQueue() {
  return attribute(3, text("can0")) + attribute(6, text("pfifo_fast"));
}

TEST(LinkMessage, TellsEverythingAboutAController) {
  CanInterface interface;
  ASSERT_TRUE(parseLinkMessage(message(kNewLink, kCanType, kUp, nameAndQueue() + controller(1, 0, 100)), interface));
  EXPECT_EQ(5, interface.index);
  EXPECT_STREQ("can0", interface.name.c_str());
  EXPECT_STREQ("can", interface.kind.c_str());
  EXPECT_STREQ("pfifo_fast", interface.queue.c_str());
  EXPECT_TRUE(interface.is_can);
  EXPECT_TRUE(interface.up);
  EXPECT_FALSE(interface.removed);
  EXPECT_TRUE(interface.has_controller);
  EXPECT_FALSE(interface.listen_only);
  EXPECT_EQ(250'000u, interface.bit_rate);
  EXPECT_EQ(100u, interface.restart_ms);
  EXPECT_EQ(CanState::kWarning, interface.state);
}

TEST(LinkMessage, KnowsEveryStateOfAController) {
  const CanState expected[] = {CanState::kActive, CanState::kWarning, CanState::kPassive, CanState::kBusOff,
                               CanState::kDown,   CanState::kDown,    CanState::kUnknown};
  for (std::uint32_t state = 0; state < 7; ++state) {
    CanInterface interface;
    ASSERT_TRUE(parseLinkMessage(message(kNewLink, kCanType, kUp, controller(state, 0, 0)), interface));
    EXPECT_EQ(expected[state], interface.state) << state;
  }
}

// CAN_CTRLMODE_LISTENONLY is 02h.
TEST(LinkMessage, SeesListenOnly) {
  CanInterface interface;
  ASSERT_TRUE(parseLinkMessage(message(kNewLink, kCanType, 0, controller(4, 0x12, 0)), interface));
  EXPECT_TRUE(interface.listen_only);
  EXPECT_FALSE(interface.up);
}

TEST(LinkMessage, AVirtualInterfaceHasNoController) {
  CanInterface interface;
  ASSERT_TRUE(parseLinkMessage(message(kNewLink, kCanType, kUp, attribute(18, attribute(1, text("vcan")))), interface));
  EXPECT_TRUE(interface.is_can);
  EXPECT_FALSE(interface.has_controller);
  EXPECT_EQ(0u, interface.bit_rate);
  EXPECT_EQ(CanState::kUnknown, interface.state);
}

TEST(LinkMessage, ARemovalAndAnOtherKindOfInterface) {
  CanInterface interface;
  ASSERT_TRUE(parseLinkMessage(message(kDelLink, kCanType, 0, nameAndQueue()), interface));
  EXPECT_TRUE(interface.removed);
  ASSERT_TRUE(parseLinkMessage(message(kNewLink, 1, kUp, nameAndQueue()), interface));
  EXPECT_FALSE(interface.is_can);
  EXPECT_FALSE(parseLinkMessage(message(20, kCanType, kUp, nameAndQueue()), interface));
}

// Every cut is refused or read as far as it goes, never beyond its end (watched by AddressSanitizer).
TEST(LinkMessage, SurvivesEveryCut) {
  const Bytes whole = message(kNewLink, kCanType, kUp, nameAndQueue() + controller(1, 0, 100));
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
    CanInterface interface;
    EXPECT_FALSE(parseLinkMessage(cut, interface)) << length;
  }
}

TEST(LinkMessage, ALengthThatLiesIsRefused) {
  CanInterface interface;
  Bytes too_short = attribute(3, text("can0"));
  too_short[0] = 3;  // less than its own header
  EXPECT_FALSE(parseLinkMessage(message(kNewLink, kCanType, kUp, too_short), interface));
  Bytes too_long = attribute(3, text("can0"));
  too_long[0] = 200;
  EXPECT_FALSE(parseLinkMessage(message(kNewLink, kCanType, kUp, too_long), interface));
  Bytes inside = attribute(18, too_long);
  EXPECT_FALSE(parseLinkMessage(message(kNewLink, kCanType, kUp, inside), interface));
}

// The kernel this test runs on has no CAN as a rule, but it has a loopback interface.
TEST(LinuxCanSystem, ReadsAnInterfaceOfThisKernel) {
  CanInterface interface;
  ASSERT_EQ(0, linuxCanSystem().readInterface("lo", interface));
  EXPECT_STREQ("lo", interface.name.c_str());
  EXPECT_GT(interface.index, 0);
  EXPECT_FALSE(interface.is_can);
  EXPECT_EQ(-ENODEV, linuxCanSystem().readInterface("nord_nowhere", interface));
}

}  // namespace
}  // namespace nord_driver::link
