#include "socketcan/network.h"

#include <gtest/gtest.h>
#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace nord_driver::link {

namespace {

void run(const std::string& command) {
  ASSERT_EQ(0, std::system(command.c_str())) << command;
}

}  // namespace

void ip(const std::string& words) {
  run("ip " + words);
}

void tc(const std::string& words) {
  run("tc " + words);
}

bool exists(const std::string& interface) {
  return ::if_nametoindex(interface.c_str()) != 0;
}

VcanInterface::VcanInterface(std::string name) : name_(std::move(name)) {
  add();
}

VcanInterface::~VcanInterface() {
  if (exists(name_)) remove();
}

CanSettings VcanInterface::settings(std::vector<std::uint32_t> ids) const {
  return settingsFor(name_, std::move(ids));
}

void VcanInterface::add() const {
  ip("link add dev " + name_ + " type vcan");
  ip("link set " + name_ + " up");
}

void VcanInterface::remove() const {
  ip("link del " + name_);
}

CanSettings settingsFor(const std::string& interface, std::vector<std::uint32_t> ids) {
  CanSettings settings;
  settings.interface = interface;
  settings.ids = std::move(ids);
  return settings;
}

BareSocket::BareSocket(const std::string& interface) : descriptor_(::socket(PF_CAN, SOCK_RAW, CAN_RAW)) {
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(::if_nametoindex(interface.c_str()));
  EXPECT_EQ(0, ::bind(descriptor_, reinterpret_cast<sockaddr*>(&address), sizeof address)) << interface;
}

BareSocket::~BareSocket() {
  ::close(descriptor_);
}

void BareSocket::sendError(std::uint32_t classes, const std::array<std::uint8_t, 8>& data) {
  write(classes | CAN_ERR_FLAG, data);
}

void BareSocket::sendZeros(std::uint32_t id) {
  write(id, std::array<std::uint8_t, 8>{});
}

void BareSocket::send(const CanFrame& frame) {
  write(frame.id, frame.bytes());
}

void BareSocket::write(std::uint32_t id, ByteView data) {
  can_frame raw{};
  raw.can_id = id;
  raw.can_dlc = static_cast<__u8>(data.size());
  std::copy(data.begin(), data.end(), raw.data);
  EXPECT_EQ(static_cast<ssize_t>(sizeof raw), ::write(descriptor_, &raw, sizeof raw));
}

void BareSocket::sendOutOnly() {
  const int loopback = 0;
  EXPECT_EQ(0, ::setsockopt(descriptor_, SOL_CAN_RAW, CAN_RAW_LOOPBACK, &loopback, sizeof loopback));
}

bool BareSocket::takesFilters(std::size_t count) {
  const std::vector<can_filter> filters(count, can_filter{1, CAN_SFF_MASK});
  return ::setsockopt(descriptor_, SOL_CAN_RAW, CAN_RAW_FILTER, filters.data(),
                      static_cast<socklen_t>(count * sizeof(can_filter))) == 0;
}

CanFrame numberedFrame(std::uint32_t id, std::uint16_t number) {
  return dataFrame(id, std::array<std::uint8_t, 2>{static_cast<std::uint8_t>(number & 0xFF),
                                                   static_cast<std::uint8_t>(number >> 8)});
}

std::uint16_t numberOf(const CanFrame& frame) {
  ByteReader reader{frame.bytes()};
  return reader.u16le();
}

bool next(CanLink& link, CanFrame& frame) {
  ReceivedCanFrame received;
  if (!link.waitReadable(link.now() + kPatience) || !link.receive(received)) return false;
  frame = received.frame;
  return true;
}

bool reaches(CanLink& link, CanState state) {
  const Instant end = link.now() + kPatience;
  ReceivedCanFrame received;
  while (link.isOpen() && link.state() != state && link.now() < end) {
    if (link.waitReadable(std::min(end, link.now() + std::chrono::milliseconds{5}))) link.receive(received);
  }
  return link.state() == state;
}

}  // namespace nord_driver::link
