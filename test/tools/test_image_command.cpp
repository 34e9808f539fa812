// nord_param image against the simulated gateway: what it shows, and that it never writes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

#include "sim/interbus/gateway_bus.h"
#include "tools/image_command.h"
#include "tools/usage_error.h"
#include "transport/interbus/interbus.h"
#include "transport/profibus/profibus_dp.h"

namespace nord_driver::tools {
namespace {

using std::chrono::seconds;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// Two drives, with a word between them that belongs to neither.
constexpr char kRobot[] = R"(
transport: nord_driver/interbus
cycle_rate: 100.0
bus:
  gateway: 127.0.0.1:0
  inputs:  {function: 23, address: 0}
  outputs: {function: 23, address: 100}
  watchdog: {address: 300, value: 500}
  pcp: {invoke: {address: 500}, result: {address: 600}}
drives:
  left:  {address: 1, series: sk5xxe, joint: left_wheel_joint,  gear_ratio: 20.0, pole_pairs: 2, max_frequency: 50.0}
  right: {address: 2, series: sk5xxe, joint: right_wheel_joint, gear_ratio: 20.0, pole_pairs: 2, max_frequency: 50.0, input_offset: 3, output_offset: 3}
)";

class ImageCommand : public ::testing::Test {
 protected:
  ImageCommand() {
    file["bus"]["gateway"] = sim.where();
    // Until both inverters have started.
    EXPECT_TRUE(waitFor([](sim::IbsRing& ring) { return ring.inputs()[0] == 0x0B70 && ring.inputs()[3] == 0x0B70; }));
  }
  bool waitFor(const std::function<bool(sim::IbsRing&)>& condition) {
    const Instant until = std::chrono::steady_clock::now() + seconds{20};
    while (std::chrono::steady_clock::now() < until) {
      if (sim.withGateway([&](sim::IbsRing& ring, sim::RegisterGateway&) { return condition(ring); })) return true;
      std::this_thread::yield();
    }
    return false;
  }
  void waitForReads(std::uint64_t count) {
    const auto reads = [&] {
      return sim.withGateway([](sim::IbsRing&, sim::RegisterGateway& gateway) { return gateway.reads(); });
    };
    const std::uint64_t begin = reads();
    const Instant end_of_patience = std::chrono::steady_clock::now() + seconds{20};
    while (reads() < begin + count && std::chrono::steady_clock::now() < end_of_patience) std::this_thread::yield();
  }
  std::uint64_t writes() {
    return sim.withGateway([](sim::IbsRing&, sim::RegisterGateway& gateway) { return gateway.writes(); });
  }
  /// What stands on stdout.
  std::string show(const ImageOptions& options, bool expected = true) {
    InterbusTransport transport;
    ::testing::internal::CaptureStdout();
    EXPECT_EQ(expected, showImage(file, transport, options, end));
    return ::testing::internal::GetCapturedStdout();
  }

  YAML::Node file = YAML::Load(kRobot);
  sim::GatewayBus sim{sim::readSimConfig(YAML::Load(kRobot))};
  std::atomic<bool> end{false};
};

TEST_F(ImageCommand, ShowsTheWordsAndWhoseTheyAre) {
  ImageOptions options;
  options.once = true;
  options.patience = seconds{20};
  EXPECT_EQ("Inputs of " + sim.where() +
                ", function 3, registers 0 to 4; nothing is written\n"
                "  word  register  value  drive         meaning\n"
                "     0         0  0B70   left          status word: switch-on disabled\n"
                "     1         1  0000   left          actual value 1\n"
                "     2         2  0000   -             -\n"
                "     3         3  0B70   right         status word: switch-on disabled\n"
                "     4         4  0000   right         actual value 1\n",
            show(options));
  EXPECT_EQ(0u, writes());
}

TEST_F(ImageCommand, InJson) {
  ImageOptions options;
  options.once = options.json = true;
  options.patience = seconds{20};
  const YAML::Node image = YAML::Load(show(options));  // JSON is YAML
  ASSERT_EQ(5u, image["words"].size());
  EXPECT_EQ(sim.where() + ", function 3, registers 0 to 4", image["inputs"].as<std::string>());
  const YAML::Node word = image["words"][3];
  EXPECT_EQ(3, word["register"].as<int>());
  EXPECT_EQ(0x0B70, word["value"].as<int>());
  EXPECT_EQ("0B70", word["hex"].as<std::string>());
  EXPECT_EQ("right", word["drive"].as<std::string>());
  EXPECT_EQ("status word: switch-on disabled", word["meaning"].as<std::string>());
  EXPECT_FALSE(word["changed"].as<bool>());
  EXPECT_TRUE(image["words"][2]["drive"].IsNull());
  EXPECT_EQ(0u, writes());
}

// The way to find a drive: switch it off, and see which words change. A gateway's word order does not matter for it.
TEST_F(ImageCommand, MarksWhatChanges) {
  ImageOptions options;
  options.patience = seconds{20};
  std::thread technician{[&] {
    waitForReads(20);
    sim.withModel([](sim::RobotSim& robot) { robot.drive(1).setInverterPower(false); });
    EXPECT_TRUE(waitFor([](sim::IbsRing& ring) { return ring.inputs()[3] == 0; }));
    waitForReads(20);
    end = true;
  }};
  const std::string text = show(options);
  technician.join();
  EXPECT_THAT(text, HasSubstr(" s  word 3, register 3, right, status word: silent: 0B70 -> 0000\n"));
  EXPECT_THAT(text, HasSubstr("\n*    3         3  0000   right         status word: silent\n"));
  EXPECT_EQ(0u, writes()) << "nothing was written for as long as it looked";
}

TEST_F(ImageCommand, MoreWordsThanThoseOfDrives) {
  ImageOptions options;
  options.once = true;
  options.patience = seconds{1};
  options.words = 6;  // the simulated gateway has five
  ::testing::internal::CaptureStderr();
  EXPECT_EQ("", show(options, false));
  EXPECT_THAT(::testing::internal::GetCapturedStderr(), HasSubstr("exception 2, illegal data address"));
  options.words = 300;
  InterbusTransport transport;
  EXPECT_THROW(showImage(file, transport, options, end), ConfigError);
}

TEST(ImageCommandLines, AreOneEach) {
  const ImageWord word{3, 8003, 0x0123, "right", "actual value 1", ""};
  EXPECT_EQ("     1.50 s  word 3, register 8003, right, actual value 1: 0000 -> 0123\n", changeLine(1.5, word, 0));
  EXPECT_EQ(
      "{\"time\": 1.50, \"before\": 0, \"word\": 3, \"register\": 8003, \"value\": 291, \"hex\": \"0123\", \"drive\": "
      "\"right\", \"meaning\": \"actual value 1\"}\n",
      changeJson(1.5, word, 0));
}

TEST(ImageCommandLines, ATransportWithoutAnImageIsNamed) {
  ProfibusDpTransport transport;
  const std::atomic<bool> end{false};
  try {
    showImage(YAML::Load("{transport: profibus_dp}"), transport, {}, end);
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), StartsWith("image: the transport nord_driver/profibus_dp has no image"));
  }
}

}  // namespace
}  // namespace nord_driver::tools
