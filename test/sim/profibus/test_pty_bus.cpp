#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include <fstream>
#include <string>

#include "sim/profibus/conversation.h"
#include "sim/profibus/pty_bus.h"

namespace nord_driver::sim {
namespace {

class PtyBusTest : public ::testing::Test {
 protected:
  PtyBusTest() {
    std::string pattern = "/tmp/nord_sim_test_XXXXXX";
    folder = ::mkdtemp(pattern.data());
    path = folder + "/bus";
  }
  ~PtyBusTest() override {
    ::unlink(path.c_str());
    ::rmdir(folder.c_str());
  }

  bool linkExists() const {
    struct stat info {};
    return ::lstat(path.c_str(), &info) == 0;
  }
  int openClient() const { return ::open(path.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC); }
  /// Sends and waits for `expected` bytes, at most ten seconds.
  static std::string ask(int client, const std::string& hex, std::size_t expected) {
    const auto bytes = fromHex(hex);
    if (::write(client, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size())) return "not written";
    std::vector<std::uint8_t> answer;
    while (answer.size() < expected) {
      pollfd descriptor{client, POLLIN, 0};
      if (::poll(&descriptor, 1, 10000) <= 0) break;
      std::uint8_t buffer[64];
      const ssize_t count = ::read(client, buffer, sizeof buffer);
      if (count <= 0) break;
      for (ssize_t i = 0; i < count; ++i) answer.push_back(buffer[i]);
    }
    return toHex(answer);
  }

  std::string folder;
  std::string path;
};

// A module with slots on a pty: its ident number, and what is connected to it.
TEST_F(PtyBusTest, ServesModules) {
  PtyBus bus{oneModule(2), path};
  const int client = openClient();
  ASSERT_GE(client, 0);
  EXPECT_EQ("68 0B 0B 68 81 88 08 3E 3C 02 05 00 FF 0B A8 44 16", ask(client, "68 05 05 68 88 81 6D 3C 3E F0 16", 17));
  EXPECT_EQ("68 08 08 68 81 88 08 3E 3B 00 F5 F5 74 16", ask(client, "68 05 05 68 88 81 5D 3B 3E DF 16", 14));
  ::close(client);
}

// A client after the other finds the stations behind the link; the first one's closing disturbs nobody.
TEST_F(PtyBusTest, ServesClients) {
  {
    PtyBus bus{oneDrive(), path};
    for (int round = 0; round < 2; ++round) {
      const int client = openClient();
      ASSERT_GE(client, 0);
      EXPECT_EQ("10 01 08 00 09 16", ask(client, "10 08 01 49 52 16", 6));
      // All byte values pass: 11h and 13h would be flow control, 0Ah and 0Dh line ends.
      EXPECT_EQ("68 0B 0B 68 81 88 08 3E 3C 02 05 00 FF 75 31 37 16",
                ask(client, "68 05 05 68 88 81 6D 3C 3E F0 16", 17));
      ::close(client);
    }
    EXPECT_TRUE(bus.withStations([](DpStations& stations) { return stations.referee().content(); }));
  }
  EXPECT_FALSE(linkExists());
}

// Time runs by itself: after the charging time the inverter is in "switch-on disabled".
TEST_F(PtyBusTest, RunsInRealTime) {
  PtyBus bus{oneDrive(), path};
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(5);
  Word status = 0;
  while (status != 0x0B70 && std::chrono::steady_clock::now() < deadline) {
    status = bus.withModel([](RobotSim& robot) { return robot.drive(0).inverter().statusWord(); });
    std::this_thread::yield();
  }
  EXPECT_EQ(0x0B70, status);
}

// A telegram in two pieces is one telegram. With more than 100 ms between them they are none: when the machine kept
// this thread from running so long, they are sent again.
TEST_F(PtyBusTest, JoinsPieces) {
  PtyBus bus{oneDrive(), path};
  const int client = openClient();
  const auto first = fromHex("10 08 01"), second = fromHex("49 52 16");
  auto gap = std::chrono::milliseconds::max();
  for (int i = 0; i < 5 && gap > std::chrono::milliseconds(50); ++i) {
    ::tcflush(client, TCIFLUSH);
    const auto start = std::chrono::steady_clock::now();
    ASSERT_EQ(3, ::write(client, first.data(), first.size()));
    ASSERT_EQ(3, ::write(client, second.data(), second.size()));
    gap = std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now() - start);
    if (gap > std::chrono::milliseconds(50)) std::this_thread::sleep_for(std::chrono::milliseconds(150));
  }
  EXPECT_EQ("10 01 08 00 09 16", ask(client, "", 6));
  ::close(client);
}

// A station that answers late answers all the same.
TEST_F(PtyBusTest, AnswersLate) {
  PtyBus bus{oneDrive(), path};
  bus.withModel([](RobotSim& robot) { robot.drive(0).setAnswerDelay(std::chrono::milliseconds(30)); });
  const int client = openClient();
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ("10 01 08 00 09 16", ask(client, "10 08 01 49 52 16", 6));
  EXPECT_GE(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(25));
  ::close(client);
}

// What nobody reads is thrown away: every request is taken, and who reads again is answered again.
TEST_F(PtyBusTest, SurvivesAClientThatDoesNotRead) {
  PtyBus bus{oneDrive(), path};
  const int client = openClient();
  const auto request = fromHex("10 08 01 49 52 16");
  for (int i = 0; i < 2000; ++i) ASSERT_EQ(6, ::write(client, request.data(), request.size()));
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  std::uint64_t taken = 0;
  while (taken < 2000 && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::yield();
    taken = bus.withModel([](RobotSim& robot) { return robot.drive(0).counters().telegrams; });
  }
  EXPECT_EQ(2000u, taken);
  ::tcflush(client, TCIFLUSH);
  EXPECT_EQ("10 01 08 00 09 16", ask(client, "10 08 01 49 52 16", 6));
  EXPECT_TRUE(bus.withStations([](DpStations& stations) { return stations.referee().content(); }));
  ::close(client);
}

// A link left behind by a killed simulator is replaced; anything else is not touched.
TEST_F(PtyBusTest, ReplacesALinkButNothingElse) {
  ASSERT_EQ(0, ::symlink("/dev/pts/9999", path.c_str()));
  { PtyBus bus{oneDrive(), path}; }
  EXPECT_FALSE(linkExists());

  std::ofstream(path) << "precious";
  try {
    PtyBus bus{oneDrive(), path};
    FAIL() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(
        "bus/device: " + path + " exists and is no symbolic link; expected a path where the simulator may put one",
        error.what());
  }
  EXPECT_TRUE(linkExists());
}

}  // namespace
}  // namespace nord_driver::sim
