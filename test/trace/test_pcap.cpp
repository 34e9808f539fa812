#include <gtest/gtest.h>

#include <vector>

#include "trace/pcap.h"

namespace nord_driver::trace {
namespace {

std::string hexOf(const std::string& bytes) {
  return toHex(std::vector<std::uint8_t>(bytes.begin(), bytes.end()));
}

// The 24 bytes of the file header: magic number, version 2.4, two reserved words, longest packet, link type 257.
TEST(Pcap, BeginsWithItsHeader) {
  EXPECT_EQ("D4 C3 B2 A1 02 00 04 00 00 00 00 00 00 00 00 00 FF FF 00 00 01 01 00 00", hexOf(Pcap{257}.bytes()));
}

// A record: seconds since 1970, microseconds, length in the file, length on the line, the bytes.
TEST(Pcap, AddsARecordPerPacket) {
  Pcap pcap{257};
  const std::vector<std::uint8_t> token{0xDC, 0x02, 0x01};
  pcap.add(std::chrono::microseconds{1'700'000'000'000'250}, token);
  EXPECT_EQ("00 F1 53 65 FA 00 00 00 03 00 00 00 03 00 00 00 DC 02 01", hexOf(pcap.bytes().substr(24)));
}

}  // namespace
}  // namespace nord_driver::trace
