#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "link/modbus/modbus_telegram.h"

namespace nord_driver::link {
namespace {

using Fault = AnswerFault;

ModbusRequest reading(ModbusFunction function, WordRange range) {
  ModbusRequest request;
  request.function = function;
  request.unit = 17;
  request.transaction = 0x1501;
  request.read = range;
  return request;
}

constexpr Word kWritten[] = {0x000A, 0x0102};

ModbusRequest writing() {
  ModbusRequest request;
  request.function = ModbusFunction::kWriteRegisters;
  request.unit = 17;
  request.transaction = 0x1501;
  request.write = {1, 2};
  request.values = kWritten;
  return request;
}

std::string bytes(const ModbusRequest& request) {
  return toHex(ByteView{toBytes(request)});
}

AnswerVerdict judged(const ModbusRequest& request, const std::string& answer) {
  const auto all = fromHex(answer);
  return judge(request, ByteView{all});
}

std::string told(const ModbusRequest& request, const std::string& answer) {
  return describe(request, judged(request, answer)).str();
}

// --- The examples of the MODBUS Application Protocol, V1.1b3, behind the header of the messaging guide, 3.1.3 ---

// 6.3: registers 108 to 110.
TEST(ModbusTelegram, ReadHoldingRegisters) {
  const ModbusRequest request = reading(ModbusFunction::kReadHoldingRegisters, {0x6B, 3});
  EXPECT_EQ("15 01 00 00 00 06 11 03 00 6B 00 03", bytes(request));
  const auto answer = fromHex("15 01 00 00 00 09 11 03 06 02 2B 00 00 00 64");
  ASSERT_TRUE(judge(request, ByteView{answer}).good());
  EXPECT_EQ(0x022B, answerRegister(ByteView{answer}, 0));
  EXPECT_EQ(0x0000, answerRegister(ByteView{answer}, 1));
  EXPECT_EQ(0x0064, answerRegister(ByteView{answer}, 2));
}

// 6.4: input register 9.
TEST(ModbusTelegram, ReadInputRegisters) {
  const ModbusRequest request = reading(ModbusFunction::kReadInputRegisters, {8, 1});
  EXPECT_EQ("15 01 00 00 00 06 11 04 00 08 00 01", bytes(request));
  EXPECT_TRUE(judged(request, "15 01 00 00 00 05 11 04 02 00 0A").good());
}

// 6.12: registers 2 and 3 get 000A and 0102.
TEST(ModbusTelegram, WriteMultipleRegisters) {
  EXPECT_EQ("15 01 00 00 00 0B 11 10 00 01 00 02 04 00 0A 01 02", bytes(writing()));
  EXPECT_TRUE(judged(writing(), "15 01 00 00 00 06 11 10 00 01 00 02").good());
}

// 6.17: reads six from register 4, writes three from register 15.
TEST(ModbusTelegram, ReadWriteMultipleRegisters) {
  constexpr Word kThree[] = {0x00FF, 0x00FF, 0x00FF};
  ModbusRequest request = reading(ModbusFunction::kReadWriteRegisters, {3, 6});
  request.write = {0x0E, 3};
  request.values = kThree;
  EXPECT_EQ("15 01 00 00 00 11 11 17 00 03 00 06 00 0E 00 03 06 00 FF 00 FF 00 FF", bytes(request));
  const auto answer = fromHex("15 01 00 00 00 0F 11 17 0C 00 FE 0A CD 00 01 00 03 00 0D 00 FF");
  ASSERT_TRUE(judge(request, ByteView{answer}).good());
  EXPECT_EQ(0x0ACD, answerRegister(ByteView{answer}, 1));
}

// The longest of each kind fit (260 bytes).
TEST(ModbusTelegram, TheLongestRequestsFit) {
  std::array<Word, kMostWriteRegisters> values{};
  ModbusRequest request = writing();
  request.write.count = kMostWriteRegisters;
  request.values = values.data();
  EXPECT_EQ(259u, toBytes(request).size());
  request = reading(ModbusFunction::kReadWriteRegisters, {0, kMostReadRegisters});
  request.write = {0, kMostReadWriteWrites};
  request.values = values.data();
  EXPECT_EQ(259u, toBytes(request).size());
}

// --- What is no answer to the request ---

const ModbusRequest kAsked = reading(ModbusFunction::kReadInputRegisters, {8, 1});

TEST(ModbusTelegram, EachDeviationIsNamed) {
  EXPECT_EQ("answers transaction 5378, expected 5377: an answer to another request",
            told(kAsked, "15 02 00 00 00 05 11 04 02 00 0A"));
  EXPECT_EQ("answers with protocol 1, expected 0: this is no Modbus/TCP server",
            told(kAsked, "15 01 00 01 00 05 11 04 02 00 0A"));
  EXPECT_EQ("answers as unit 18, expected 17", told(kAsked, "15 01 00 00 00 05 12 04 02 00 0A"));
  EXPECT_EQ("answers function 4 (read registers 8 to 8) with function 3",
            told(kAsked, "15 01 00 00 00 05 11 03 02 00 0A"));
  EXPECT_EQ("answers function 4 (read registers 8 to 8) with 2 registers, expected 1",
            told(kAsked, "15 01 00 00 00 07 11 04 04 00 0A 00 0B"));
  EXPECT_EQ("answers function 4 (read registers 8 to 8) with 11 bytes, expected 12",
            told(kAsked, "15 01 00 00 00 06 11 04 02 00 0A"));
  EXPECT_EQ("answers function 4 (read registers 8 to 8) with 12 bytes, expected 11",
            told(kAsked, "15 01 00 00 00 06 11 04 02 00 0A 00"));
  EXPECT_EQ("answers function 4 (read registers 8 to 8) with 7 bytes, expected at least 9",
            told(kAsked, "15 01 00 00 00 01 11"));
  EXPECT_EQ("answers function 16 (write registers 1 to 2) for register 3 on, expected 1",
            told(writing(), "15 01 00 00 00 06 11 10 00 03 00 02"));
  EXPECT_EQ("answers function 16 (write registers 1 to 2) with 1 registers, expected 2",
            told(writing(), "15 01 00 00 00 06 11 10 00 01 00 01"));
}

TEST(ModbusTelegram, EachExceptionIsExplained) {
  EXPECT_EQ(
      "refuses function 4 (read registers 8 to 8) with exception 2, illegal data address: it has no such registers, "
      "look at address and length of the image",
      told(kAsked, "15 01 00 00 00 03 11 84 02"));
  for (const unsigned code : {1u, 2u, 3u, 4u, 5u, 6u, 8u, 10u, 11u}) {
    EXPECT_STRNE(exceptionMeaning(99), exceptionMeaning(code)) << code;
  }
}

// An exception to another function is none to this one.
TEST(ModbusTelegram, AnExceptionOfAnotherFunctionIsAWrongFunction) {
  EXPECT_EQ(Fault::kFunction, judged(kAsked, "15 01 00 00 00 03 11 83 02").fault);
  EXPECT_EQ(Fault::kFunction, judged(kAsked, "15 01 00 00 00 04 11 84 02 00").fault);
}

// One byte of the answer, other than a register's, changed: never good.
RC_GTEST_PROP(ModbusTelegram, NoChangedByteOfTheFrameIsOverlooked, ()) {
  auto answer = fromHex("15 01 00 00 00 05 11 04 02 00 0A");
  const auto at = *rc::gen::inRange<std::size_t>(0, 9);
  const auto change = static_cast<std::uint8_t>(*rc::gen::inRange(1, 256));
  answer[at] = static_cast<std::uint8_t>(answer[at] ^ change);
  const AnswerVerdict verdict = judge(kAsked, ByteView{answer});
  RC_ASSERT(!verdict.good());
  RC_ASSERT(!describe(kAsked, verdict).empty());
}

// Whatever comes: judged without reading beyond its end (the sanitizers watch), and told.
RC_GTEST_PROP(ModbusTelegram, AnythingCanBeJudged, ()) {
  auto answer = *rc::gen::arbitrary<std::vector<std::uint8_t>>();
  if (answer.size() > kLongestAdu) answer.resize(kLongestAdu);
  for (const ModbusRequest& request : {kAsked, writing()}) {
    const AnswerVerdict verdict = judge(request, ByteView{answer});
    RC_ASSERT(verdict.good() || !describe(request, verdict).empty());
  }
}

}  // namespace
}  // namespace nord_driver::link
