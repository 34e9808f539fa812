// The link against a server nobody here has written: python3-pymodbus. Where it is missing the tests are skipped.
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>

#include "link/modbus/link_fixture.h"

namespace nord_driver::link::test {
namespace {

class Pymodbus : public ModbusLinkTest {
 protected:
  void SetUp() override {
    int to[2], from[2];
    ASSERT_TRUE(::pipe2(to, O_CLOEXEC) == 0 && ::pipe2(from, O_CLOEXEC) == 0);
    child_ = ::fork();
    ASSERT_GE(child_, 0);
    if (child_ == 0) {
      ::dup2(to[0], STDIN_FILENO);
      ::dup2(from[1], STDOUT_FILENO);
      ::execl("/usr/bin/python3", "python3", NORD_DRIVER_PYMODBUS_SERVER, nullptr);
      ::_exit(77);
    }
    ::close(to[0]);
    ::close(from[1]);
    input_ = to[1];
    std::FILE* said = ::fdopen(from[0], "r");
    unsigned port = 0;
    const bool runs = std::fscanf(said, "%u", &port) == 1;
    std::fclose(said);
    if (runs) {
      address_ = "127.0.0.1:" + std::to_string(port);
    } else if (const int code = end(); code == 77) {
      GTEST_SKIP() << "python3-pymodbus is not installed, or older than 3.0";
    } else {
      FAIL() << "the server ended with " << code;
    }
  }
  void TearDown() override {
    link.reset();
    end();
  }

  ModbusSettings pymodbus(ModbusFunction in, ModbusFunction out) {
    ModbusSettings settings = fourWords(address_);
    settings.unit = 3;
    settings.inputs.function = in;
    settings.outputs.function = out;
    return settings;
  }

 private:
  int end() {
    if (child_ <= 0) return 0;
    ::close(input_);
    int status = 0;
    ::waitpid(child_, &status, 0);
    child_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  pid_t child_ = 0;
  int input_ = -1;
  std::string address_;
};

TEST_F(Pymodbus, FunctionsSixteenAndFour) {
  start(pymodbus(ModbusFunction::kReadInputRegisters, ModbusFunction::kWriteRegisters));
  ASSERT_TRUE(waitConnected());
  ASSERT_TRUE(exchange({0x047F, 0x2000, 0x047E, 0xC000}));
  EXPECT_EQ((RegisterImage{1000, 1001, 1002, 1003}), link->take().words);
}

TEST_F(Pymodbus, FunctionsSixteenAndThree) {
  ModbusSettings settings = pymodbus(ModbusFunction::kReadHoldingRegisters, ModbusFunction::kWriteRegisters);
  settings.inputs.address = 98;  // two before the outputs
  start(settings);
  ASSERT_TRUE(waitConnected());
  ASSERT_TRUE(exchange({0x047F, 0x2000, 0x047E, 0xC000}));
  EXPECT_EQ((RegisterImage{2098, 2099, 0x047F, 0x2000}), link->take().words);
}

TEST_F(Pymodbus, FunctionTwentyThree) {
  ModbusSettings settings = pymodbus(ModbusFunction::kReadWriteRegisters, ModbusFunction::kReadWriteRegisters);
  settings.inputs.address = 102;
  start(settings);
  ASSERT_TRUE(waitConnected());
  ASSERT_TRUE(exchange({0x047F, 0x2000, 0x047E, 0xC000}));
  EXPECT_EQ((RegisterImage{0x047E, 0xC000, 2104, 2105}), link->take().words);
}

TEST_F(Pymodbus, TheLongestRequests) {
  ModbusSettings settings = pymodbus(ModbusFunction::kReadHoldingRegisters, ModbusFunction::kWriteRegisters);
  settings.inputs.parts = {{0, 125}, {125, 75}};
  settings.inputs.address = 100;
  settings.outputs.parts = {{0, 123}, {123, 77}};
  settings.watchdog = WatchdogRegister{50, 500};
  start(settings);
  ASSERT_TRUE(waitConnected());
  RegisterImage outputs;
  while (outputs.size() < 200) outputs.push_back(static_cast<Word>(3 * outputs.size()));
  ASSERT_TRUE(exchange(outputs));
  EXPECT_EQ(outputs, link->take().words);
}

TEST_F(Pymodbus, ItsExceptionsAreUnderstood) {
  ModbusSettings settings = pymodbus(ModbusFunction::kReadInputRegisters, ModbusFunction::kWriteRegisters);
  settings.outputs.address = 299;
  start(settings);
  ASSERT_TRUE(waitConnected());
  link->give({1, 2, 3, 4});
  ASSERT_TRUE(waitUntil([&] { return !link->report().text.empty(); }));
  EXPECT_NE(std::string::npos,
            link->report().text.str().find("refuses function 16 (write registers 299 to 302) with exception 2"))
      << link->report().text.c_str();
}

}  // namespace
}  // namespace nord_driver::link::test
