// A link to a fake server, and waiting for what it tells.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>

#include "link/modbus/fake_modbus_server.h"
#include "link/modbus/modbus_link.h"

namespace nord_driver::link::test {

/// Longer than anything here takes on a loaded machine.
constexpr std::chrono::seconds kPatience{20};

/// Inputs of four words at input register 0, outputs of four at holding register 100.
inline ModbusSettings fourWords(const std::string& server) {
  ModbusSettings settings;
  settings.server = server;
  settings.inputs.parts = {{0, 4}};
  settings.outputs.address = 100;
  settings.outputs.parts = {{0, 4}};
  settings.response_timeout = kPatience;  // those who test it set it
  settings.connect_timeout = kPatience;
  return settings;
}

class ModbusLinkTest : public ::testing::Test {
 protected:
  void start() { start(fourWords(server.address())); }
  void start(const ModbusSettings& settings) {
    link = std::make_unique<ModbusLink>(settings);
    ASSERT_TRUE(link->open()) << link->report().text.c_str();
  }
  /// Waits until the condition holds; it is asked whenever the link has something new.
  bool waitUntil(const std::function<bool()>& condition) {
    const Instant until = link->now() + kPatience;
    while (!condition()) {
      if (!link->waitAnswers(until) && link->now() >= until) return false;
    }
    return true;
  }
  bool waitConnected() {
    return waitUntil([&] { return link->report().state == LinkState::kConnected; });
  }
  /// Gives `outputs` and waits for the inputs that were read after them.
  bool exchange(const RegisterImage& outputs) {
    const std::uint64_t number = link->give(outputs);
    return waitUntil([&] { return link->take().outputs >= number; });
  }
  /// Gives outputs until the link tells what is wrong.
  std::string trouble(const RegisterImage& outputs = {1, 2, 3, 4}) {
    EXPECT_TRUE(waitConnected()) << link->report().text.c_str();
    link->give(outputs);
    EXPECT_TRUE(waitUntil([&] { return link->report().state == LinkState::kPausing; }));
    const std::string text = link->report().text.str();
    EXPECT_EQ(0u, text.find(server.address() + " ")) << text;
    return text.substr(std::min(text.size(), server.address().size() + 1));
  }

  FakeModbusServer server;
  std::unique_ptr<ModbusLink> link;
};

}  // namespace nord_driver::link::test
