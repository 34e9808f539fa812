#include <gtest/gtest.h>

#include "link/modbus/modbus_settings.h"

namespace nord_driver::link {
namespace {

ModbusSettings good() {
  ModbusSettings settings;
  settings.server = "192.168.0.10:502";
  settings.inputs.parts = {{0, 4}};
  settings.outputs.parts = {{0, 4}};
  return settings;
}

std::string refusal(const ModbusSettings& settings) {
  Sentence reason;
  EXPECT_FALSE(checkModbusSettings(settings, reason));
  return reason.str();
}

void expectServer(const std::string& text, const std::string& host, unsigned port) {
  Sentence reason;
  const auto name = serverName(text, reason);
  ASSERT_TRUE(name) << reason.c_str();
  EXPECT_EQ(host, name->host);
  EXPECT_EQ(port, name->port);
}

TEST(ModbusSettings, AServerIsAHostAndAPort) {
  expectServer("192.168.0.10:1502", "192.168.0.10", 1502);
  expectServer("192.168.0.10", "192.168.0.10", 502);
  expectServer("gateway.plant:502", "gateway.plant", 502);
  expectServer("[fe80::1]:503", "fe80::1", 503);
  expectServer("[fe80::1]", "fe80::1", 502);
  expectServer("fe80::1", "fe80::1", 502);
}

TEST(ModbusSettings, WhatIsNoServerIsRefused) {
  for (const char* text : {"", ":502", "gateway:", "gateway:0", "gateway:65536", "gateway:5o2", "gateway:-1", "a b",
                           "[fe80::1", "[fe80::1]502", "modbus://gateway"}) {
    Sentence reason;
    EXPECT_FALSE(serverName(text, reason)) << text;
    EXPECT_NE(std::string::npos, reason.str().find("\"" + std::string(text) + "\", expected a host name")) << text;
  }
}

TEST(ModbusSettings, GoodOnesPass) {
  Sentence reason;
  EXPECT_TRUE(checkModbusSettings(good(), reason)) << reason.c_str();
}

TEST(ModbusSettings, FunctionsThatDoNotFitAreRefused) {
  ModbusSettings settings = good();
  settings.inputs.function = ModbusFunction::kWriteRegisters;
  EXPECT_EQ("inputs/function: 16, expected 3, 4 or 23", refusal(settings));
  settings = good();
  settings.outputs.function = ModbusFunction::kReadInputRegisters;
  EXPECT_EQ("outputs/function: 4, expected 16 or 23", refusal(settings));
  settings = good();
  settings.inputs.function = ModbusFunction::kReadWriteRegisters;
  EXPECT_EQ("inputs/function: 23 and outputs/function: 16, expected 23 for both or for none: it moves both images",
            refusal(settings));
  settings.outputs.function = ModbusFunction::kReadWriteRegisters;
  settings.outputs.parts.clear();
  EXPECT_EQ("function 23 with one image only, expected inputs and outputs", refusal(settings));
  settings = good();
  settings.running = RunningFlag{ModbusFunction::kReadWriteRegisters, 0, 1, 1};
  EXPECT_EQ("running/function: 23, expected 3 or 4", refusal(settings));
}

TEST(ModbusSettings, PartsNoRequestCarriesAreRefused) {
  ModbusSettings settings = good();
  settings.inputs.parts = {{0, 126}};
  EXPECT_EQ("inputs: a part of 126 registers, expected 1 to 125 for function 4", refusal(settings));
  settings = good();
  settings.outputs.parts = {{0, 124}};
  EXPECT_EQ("outputs: a part of 124 registers, expected 1 to 123 for function 16", refusal(settings));
  settings.inputs.function = settings.outputs.function = ModbusFunction::kReadWriteRegisters;
  settings.outputs.parts = {{0, 122}};
  EXPECT_EQ("outputs: a part of 122 registers, expected 1 to 121 for function 23", refusal(settings));
}

TEST(ModbusSettings, RegistersBeyondTheLastAreRefused) {
  ModbusSettings settings = good();
  settings.inputs.address = 65533;
  EXPECT_EQ("inputs/address: 65533, the image ends at register 65536, expected at most 65535", refusal(settings));
  settings = good();
  settings.inputs.parts = {{200, 57}};
  EXPECT_EQ("inputs: words 200 to 256, expected an image of at most 256 words", refusal(settings));
}

TEST(ModbusSettings, AControlWordThatIsNotWrittenIsRefused) {
  ModbusSettings settings = good();
  settings.control_words = {0, 4};
  EXPECT_EQ("a control word at word 4 of the outputs, expected it in a part that is written", refusal(settings));
}

TEST(ModbusSettings, TimesNobodyMeansAreRefused) {
  ModbusSettings settings = good();
  settings.response_timeout = Duration{0};
  EXPECT_EQ("response_timeout: 0.000 s, expected 0.001 to 60 s", refusal(settings));
  settings = good();
  settings.longest_pause = std::chrono::hours{1};
  EXPECT_EQ("longest_pause: 3600.000 s, expected 0.001 to 60 s", refusal(settings));
}

}  // namespace
}  // namespace nord_driver::link
