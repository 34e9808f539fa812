// The trace of a gateway's telegrams: in words, as bytes of a packet, and as tshark reads it.
#include <gmock/gmock.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "transport/interbus/gateway_ring.h"
#include "transport/interbus/modbus_packet.h"
#include "transport/interbus/modbus_text.h"

namespace nord_driver::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

link::HeardTelegram heard(bool sent, const std::vector<std::uint8_t>& bytes, std::uint16_t first = 0) {
  link::HeardTelegram telegram;
  telegram.sent = sent;
  telegram.bytes = bytes;
  telegram.first_register = first;
  telegram.own_address = 0x0A000001;
  telegram.server_address = 0x0A000002;
  telegram.own_port = 40000;
  telegram.server_port = 502;
  return telegram;
}

TraceRecord recordOf(const ModbusPacket& packet, bool sent) {
  TraceRecord record;
  record.kind = sent ? TraceKind::kSent : TraceKind::kReceived;
  record.length = static_cast<std::uint8_t>(packet.size());
  std::copy(packet.begin(), packet.end(), record.bytes.begin());
  return record;
}

std::string textOf(const InterbusConfig& config, bool sent, const std::vector<std::uint8_t>& bytes,
                   std::uint16_t first = 0) {
  return ModbusText{config}(recordOf(toPacket(heard(sent, bytes, first), 0), sent));
}

// RFC 791 3.1, RFC 9293 3.1; the sums by the arithmetic of RFC 1071 in another language.
TEST(ModbusPacket, HasTheHeadersOfTheNetwork) {
  const std::vector<std::uint8_t> bytes{0, 1, 0, 0, 0, 6, 1, 4, 0, 0, 0, 4};
  link::HeardTelegram telegram = heard(true, bytes, 0x0102);
  telegram.bytes_sent = 10;
  telegram.bytes_received = 20;
  const ModbusPacket packet = toPacket(telegram, 0);
  EXPECT_EQ(
      "45 00 00 34 01 02 40 00 40 06 25 C0 0A 00 00 01 0A 00 00 02 "
      "9C 40 01 F6 00 00 00 0B 00 00 00 15 50 18 FF FF FC 58 00 00 "
      "00 01 00 00 00 06 01 04 00 00 00 04",
      toHex(ByteView{packet}));
  const auto content = packetContent(ByteView{packet});
  ASSERT_TRUE(content);
  EXPECT_EQ(toHex(ByteView{bytes}), toHex(content->bytes));
  EXPECT_EQ(0x0102, content->first_register);
  EXPECT_FALSE(packetContent(ByteView{bytes}));
}

TEST(ModbusPacket, ALongTelegramIsTwoSegments) {
  const std::vector<std::uint8_t> bytes(259, 7);
  const link::HeardTelegram telegram = heard(false, bytes);
  const ModbusPacket first = toPacket(telegram, 0), second = toPacket(telegram, 215);
  EXPECT_EQ(255u, first.size());
  EXPECT_EQ(kPacketHeader + 44, second.size());
  EXPECT_EQ(1, first[27]);
  EXPECT_EQ(216, second[27]) << "sequence number";
  EXPECT_EQ(215u, packetContent(ByteView{second})->at);
  EXPECT_EQ("the rest of the telegram before it, from byte 215 on",
            ModbusText{InterbusSettings{}.read()}(recordOf(second, false)));
}

TEST(ModbusText, NamesWhatIsAskedAndAnswered) {
  InterbusSettings settings;
  settings.bus.set("outputs/address", 100);
  const InterbusConfig config = settings.read();
  EXPECT_EQ("#258 read input registers 0 to 3", textOf(config, true, {1, 2, 0, 0, 0, 6, 1, 4, 0, 0, 0, 4}));
  EXPECT_EQ("#258 read 0 to 3: drive0 ZSW 0B37 IW1 2000, drive1 ZSW 0B31 IW1 0000",
            textOf(config, false, {1, 2, 0, 0, 0, 11, 1, 4, 8, 0x0B, 0x37, 0x20, 0, 0x0B, 0x31, 0, 0}));
  EXPECT_EQ(
      "#1 write 100 to 103: drive0 STW 047F SW1 2000, drive1 STW 047E SW1 0000",
      textOf(config, true, {0, 1, 0, 0, 0, 15, 1, 16, 0, 100, 0, 4, 8, 0x04, 0x7F, 0x20, 0, 0x04, 0x7E, 0, 0}, 100));
  EXPECT_EQ("#1 written 100 to 103", textOf(config, false, {0, 1, 0, 0, 0, 6, 1, 16, 0, 100, 0, 4}, 100));
  EXPECT_EQ("#2 read 200: 0001", textOf(config, false, {0, 2, 0, 0, 0, 5, 1, 4, 2, 0, 1}, 200));
  EXPECT_EQ("#2 read 0 to 3 and write 100 to 101: drive0 STW 047E SW1 0000",
            textOf(config, true, {0, 2, 0, 0, 0, 15, 1, 23, 0, 0, 0, 4, 0, 100, 0, 2, 4, 0x04, 0x7E, 0, 0}));
  EXPECT_EQ("#3 function 4 refused, exception 6: server device busy",
            textOf(config, false, {0, 3, 0, 0, 0, 3, 1, 0x84, 6}));
  EXPECT_EQ("#3 function 43", textOf(config, true, {0, 3, 0, 0, 0, 6, 1, 43, 14, 1, 0, 0}));
  EXPECT_EQ("too short for Modbus/TCP", textOf(config, true, {0, 3}));
  EXPECT_EQ("no packet of Modbus/TCP", ModbusText{config}(TraceRecord{}));
}

TEST(ModbusText, BytesAreReadAsConfigured) {
  InterbusSettings settings{1};
  settings.bus.set("word_order", std::string{"swapped"});
  EXPECT_EQ("#1 read 0 to 1: drive0 ZSW 0B31 IW1 2000",
            textOf(settings.read(), false, {0, 1, 0, 0, 0, 7, 1, 4, 4, 0x31, 0x0B, 0, 0x20}));
}

class ModbusTraceOnAGateway : public GatewayRing {
 protected:
  ModbusTraceOnAGateway() {
    settings.bus.set("pcp/invoke/address", 500).set("pcp/result/address", 600).set("diagnosis", sim.where());
  }
  void live() {
    start();
    ASSERT_TRUE(allAnswer()) << transport.busText().c_str();
    outputs[0] = {0x047E, {}};
    ASSERT_TRUE(runUntil([&] { return inputs[0].inverter_answers && inputs[0].input.status_word == 0x0B31; }));
    profile::ParameterRequest read;
    read.number = 999;
    EXPECT_EQ(profile::ParameterOutcome::kRefused, ask(read).outcome);
    transport.close();
  }
};

std::vector<std::string> linesOf(const std::string& command) {
  std::vector<std::string> lines;
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return lines;
  char line[4096];
  while (std::fgets(line, sizeof line, pipe) != nullptr) lines.emplace_back(line);
  EXPECT_EQ(0, pclose(pipe)) << command;
  return lines;
}

// A pcap file, by the draft (draft-ietf-opsawg-pcap); written here because trace/ knows no transport.
void writePcap(const TelegramTrace& trace, const std::string& path) {
  std::ofstream file{path, std::ios::binary};
  const auto u32 = [&](std::uint32_t value) { file.write(reinterpret_cast<const char*>(&value), 4); };
  for (const std::uint32_t word : {0xA1B2C3D4u, 0x00040002u, 0u, 0u, 65535u, trace.linkType()}) u32(word);
  for (const TraceRecord& record : trace.copy()) {
    const auto time = std::chrono::floor<std::chrono::microseconds>(record.time.time_since_epoch()).count();
    u32(static_cast<std::uint32_t>(time / 1'000'000));
    u32(static_cast<std::uint32_t>(time % 1'000'000));
    u32(record.length);
    u32(record.length);
    file.write(reinterpret_cast<const char*>(record.bytes.data()), record.length);
  }
}

TEST_F(ModbusTraceOnAGateway, TsharkKnowsEveryTelegram) {
  if (std::system("tshark --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "tshark is not installed";
  live();
  const TelegramTrace& trace = *transport.trace();
  ASSERT_GT(trace.recorded(), 20u);
  const std::string path = "/tmp/nord_modbus_" + std::to_string(getpid()) + ".pcap";
  writePcap(trace, path);
  const std::string port = sim.where().substr(sim.where().find(':') + 1);
  const auto lines = linesOf("tshark -n -r " + path + " -o mbtcp.tcp.port:" + port +
                             " -o tcp.check_checksum:TRUE -o ip.check_checksum:TRUE -T fields -e _ws.col.Protocol -e "
                             "_ws.malformed -e tcp.checksum.status"
                             " -e ip.checksum.status -e _ws.col.Info 2>/dev/null");
  std::remove(path.c_str());
  ASSERT_EQ(trace.recorded(), lines.size());
  std::size_t queries = 0, responses = 0;
  for (const std::string& line : lines) {
    ASSERT_THAT(line, StartsWith("Modbus/TCP\t\t1\t1\t")) << "protocol, not malformed, both checksums good";
    queries += line.find("Query") != std::string::npos ? 1 : 0;
    responses += line.find("Response") != std::string::npos ? 1 : 0;
  }
  EXPECT_EQ(lines.size(), queries + responses);
  EXPECT_GT(responses, lines.size() / 3);
}

TEST_F(ModbusTraceOnAGateway, EveryTelegramHasItsWords) {
  live();
  std::string all;
  for (const TraceRecord& record : transport.trace()->copy()) all += transport.trace()->describe(record) + "\n";
  for (const char* part :
       {"drive0 STW 047E SW1 0000", "drive0 ZSW 0B31 IW1 0000", "read input registers 200", "write 300: 07D0",
        "written 300", "write 500 to 506: 0081 0002 23E7", "read 600 to 606: 0181 0002 0607"}) {
    EXPECT_THAT(all, HasSubstr(part));
  }
  const auto records = transport.trace()->copy();
  EXPECT_THAT(transport.trace()->raw(records.front()), HasSubstr(" 00 00 00 "));
  EXPECT_EQ(0u, all.find('#'));
}

}  // namespace
}  // namespace nord_driver::test
