// A wrong configuration ends the node before anything is advertised, with a sentence that names key, value and what was
// expected. Each way to be wrong is a test of its own: see the names at the end.
#include <gmock/gmock.h>
#include <rosgraph_msgs/Log.h>
#include <signal.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "rostest/robot_under_test.h"
#include "support/second_try.h"

namespace nord_driver::test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::StartsWith;
using XmlRpc::XmlRpcValue;

constexpr Seconds kLongestLife{5.0};
constexpr Seconds kHoldsUpAStart{1.0};

/// Everything below "/<node>/" that the master knows: publications, subscriptions and services, but for what every
/// roscpp node has.
std::vector<std::string> advertisedBy(const std::string& node) {
  XmlRpcValue arguments, result, state;
  arguments[0] = ros::this_node::getName();
  std::vector<std::string> names;
  if (!ros::master::execute("getSystemState", arguments, result, state, false)) return names;
  for (int kind = 0; kind < state.size(); ++kind) {
    for (int i = 0; i < state[kind].size(); ++i) {
      const std::string name = state[kind][i][0];
      for (int j = 0; j < state[kind][i][1].size(); ++j) {
        const std::string owner = state[kind][i][1][j];
        const bool of_every_node = name == "/rosout" || name == node + "/get_loggers" || name == "/clock" ||
                                   name == node + "/set_logger_level";
        if (owner == node && !of_every_node) names.push_back(name);
      }
    }
  }
  return names;
}

/// A key of /nord_driver replaced, added or, with an invalid value, taken away; and what the sentence must say.
struct Mistake {
  std::string name;
  std::string key;
  XmlRpcValue value;
  std::string named;     ///< the key as it is named
  std::string shown;     ///< the value
  std::string expected;  ///< what was expected
};

void PrintTo(const Mistake& mistake, std::ostream* out) {
  *out << mistake.named;
}

XmlRpcValue missing() {
  return {};
}

XmlRpcValue listOf(double first, double second) {
  XmlRpcValue list;
  list[0] = first;
  list[1] = second;
  return list;
}

void configure(const std::string& node, const std::string& key, const XmlRpcValue& value) {
  XmlRpcValue parameters;
  ASSERT_TRUE(ros::param::get("/nord_driver", parameters));
  ros::param::set(node, parameters);
  if (value.valid()) {
    ros::param::set(node + "/" + key, value);
  } else {
    ASSERT_TRUE(ros::param::del(node + "/" + key)) << key;
  }
}

class WrongConfiguration : public ::testing::TestWithParam<Mistake> {
 protected:
  static void SetUpTestSuite() {
    ros::NodeHandle handle;
    rosout = std::make_unique<Topic<rosgraph_msgs::Log>>(handle, "/rosout");
    aggregated = std::make_unique<Topic<rosgraph_msgs::Log>>(handle, "/rosout_agg");
  }
  static void TearDownTestSuite() {
    rosout.reset();
    aggregated.reset();
  }
  /// The last words of a node. It waits for one reader, which may be the aggregator and not this test.
  static Topic<rosgraph_msgs::Log>::Pointer lastWordsOf(const std::string& node) {
    const auto last = [&](const rosgraph_msgs::Log& log) {
      return log.name == node && log.level == rosgraph_msgs::Log::FATAL;
    };
    Topic<rosgraph_msgs::Log>::Pointer said;
    eventually([&] {
      for (auto* topic : {&rosout, &aggregated}) {
        if (said == nullptr) said = (*topic)->waitFrom(0, last, Seconds{0.0});
      }
      return said != nullptr;
    });
    return said;
  }
  /// Starts the node and looks, while it lives, at what it advertises.
  static std::optional<NodeProcess::End> runToItsEnd(const std::string& name, std::unique_ptr<NodeProcess>& driver,
                                                     std::vector<std::string>& advertised) {
    const auto start = std::chrono::steady_clock::now();
    driver = std::make_unique<NodeProcess>(kDriverProgram, std::vector<std::string>{"__name:=" + name});
    while (!driver->waitEnd(Seconds{0.02}) && std::chrono::steady_clock::now() - start < kLongestLife) {
      for (const std::string& topic : advertisedBy("/" + name)) advertised.push_back(topic);
    }
    return driver->waitEnd(Seconds::zero());
  }

  static std::unique_ptr<Topic<rosgraph_msgs::Log>> rosout, aggregated;
};
std::unique_ptr<Topic<rosgraph_msgs::Log>> WrongConfiguration::rosout, WrongConfiguration::aggregated;

TEST_P(WrongConfiguration, EndsTheNodeWithASentence) {
  const Mistake& mistake = GetParam();
  const std::string name = "driver_" + mistake.name, node = "/" + name;
  ASSERT_NO_FATAL_FAILURE(configure(node, mistake.key, mistake.value));

  std::unique_ptr<NodeProcess> driver;
  std::vector<std::string> advertised;
  std::optional<NodeProcess::End> end;
  const auto attempt = [&] { end = runToItsEnd(name, driver, advertised); };
  tryAgainOnlyIfStoodStill(
      kHoldsUpAStart, attempt, [&] { return end.has_value(); }, [&] { driver.reset(); });
  ASSERT_TRUE(end) << "still runs: " << driver->errorText();
  EXPECT_EQ(end->signal, 0);
  EXPECT_EQ(end->exit_code, 1);
  EXPECT_THAT(advertised, IsEmpty());

  std::vector<std::string> lines = driver->errorLines();
  // roscpp's own words on a master that is slow under load.
  const auto of_roscpp = [](const std::string& line) { return line.find("contact master") != std::string::npos; };
  lines.erase(std::remove_if(lines.begin(), lines.end(), of_roscpp), lines.end());
  ASSERT_THAT(lines, SizeIs(1)) << driver->errorText();
  EXPECT_THAT(lines[0], HasSubstr("FATAL"));
  EXPECT_THAT(lines[0], HasSubstr("nord_driver: " + mistake.named));
  EXPECT_THAT(lines[0], HasSubstr(mistake.shown));
  EXPECT_THAT(lines[0], HasSubstr("expected"));
  EXPECT_THAT(lines[0], HasSubstr(mistake.expected));
  const auto said = lastWordsOf(node);
  ASSERT_TRUE(said) << "nothing on rosout";
  EXPECT_THAT(said->msg, StartsWith("nord_driver: " + mistake.named));
}

std::string mistakeName(const ::testing::TestParamInfo<Mistake>& info) {
  return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(
    InManyWays, WrongConfiguration,
    ::testing::Values(
        Mistake{"TransportUnknown", "transport", "nord_driver/carrier_pigeon", "~transport", "carrier_pigeon",
                "profibus_dp"},
        Mistake{"CycleRateZero", "cycle_rate", 0.0, "~cycle_rate", "0", "1 to 1000 Hz"},
        Mistake{"CycleRateAText", "cycle_rate", "fast", "~cycle_rate", "\"fast\"", "a number"},
        Mistake{"DeviceMissing", "bus/device", missing(), "~bus/device", "is missing", "/dev/ttyUSB0"},
        Mistake{"BaudRateNotOfProfibus", "bus/baud_rate", 115200, "~bus/baud_rate", "115200", "500000"},
        Mistake{"BaudRateTooSlowForTheCycle", "bus/baud_rate", 9600, "~bus/baud_rate", "9600", "cycle_rate"},
        Mistake{"WatchdogShorterThanTheWorstCycle", "bus/watchdog", 0.02, "~bus/watchdog", "0.02", "worst cycle"},
        Mistake{"SlotTimeShorterThanAnAnswer", "bus/slot_time", 0.00001, "~bus/slot_time", "1e-05", "at least"},
        Mistake{"DrivesMissing", "drives", missing(), "~drives", "is missing", "at least one drive"},
        Mistake{"AddressMissing", "drives/left/address", missing(), "~drives/left/address", "is missing", "3 to 125"},
        Mistake{"AddressOutOfRange", "drives/left/address", 126, "~drives/left/address", "126", "3 to 125"},
        Mistake{"AddressTwice", "drives/right/address", 3, "~drives/right/address", "3", "another address"},
        Mistake{"SeriesUnknown", "drives/left/series", "sk9000", "~drives/left/series", "\"sk9000\"", "sk5xxe"},
        Mistake{"PpoTypeOutOfRange", "drives/left/ppo_type", 7, "~drives/left/ppo_type", "7", "1 to 4"},
        Mistake{"PolePairsMissing", "drives/left/pole_pairs", missing(), "~drives/left/pole_pairs", "is missing",
                "a whole number"},
        Mistake{"InvertedANumber", "drives/right/inverted", 1, "~drives/right/inverted", "1", "true or false"},
        Mistake{"MaxFrequencyMissingWithoutAParameterChannel", "drives/left/ppo_type", 3, "~drives/left/max_frequency",
                "is missing", "P105"},
        Mistake{"WheelJointUnknown", "left_wheel", "lift_wheel_joint", "~left_wheel", "\"lift_wheel_joint\"", "joint"},
        Mistake{"WheelRadiusMissing", "wheel_radius", missing(), "~wheel_radius", "is missing", "m"},
        Mistake{"WheelSeparationNegative", "wheel_separation", -0.5, "~wheel_separation", "-0.5", "a number from"},
        Mistake{"CovarianceTooShort", "pose_covariance_diagonal", listOf(0.1, 0.1), "~pose_covariance_diagonal",
                "2 numbers", "six numbers"},
        Mistake{"ParameterFileNotThere", "parameter_files", "/is/not/there.yaml",
                "~parameter_files: /is/not/there.yaml", "cannot be opened", "a readable YAML file"},
        Mistake{"BusNotAGroup", "bus", "/dev/ttyUSB0", "~bus", "\"/dev/ttyUSB0\"", "a group"}),
    mistakeName);

// A key nobody knows is no reason to end, but named, with the nearest one that is known.
TEST(UnknownKey, IsWarnedAboutWithTheNearestNameAndTheNodeRunsOn) {
  const std::string node = "/driver_with_a_typo";
  ASSERT_NO_FATAL_FAILURE(configure(node, "wheel_seperation_multiplier", 1.0));
  ros::param::set(node + "/bus/baudrate", 500000);
  ros::param::set(node + "/drives/left/gear_ration", 20.0);
  NodeProcess driver(kDriverProgram, {"__name:=driver_with_a_typo"});
  ASSERT_TRUE(ros::service::waitForService(node + "/enable", ros::Duration(kPatience.count())));
  EXPECT_THAT(driver.errorText(), HasSubstr("~wheel_seperation_multiplier is not known and is ignored; did you mean "
                                            "~wheel_separation_multiplier?"));
  EXPECT_THAT(driver.errorText(), HasSubstr("~bus/baudrate is not known and is ignored; did you mean ~bus/baud_rate?"));
  EXPECT_THAT(driver.errorText(), HasSubstr("~drives/left/gear_ration is not known and is ignored; did you mean "
                                            "~drives/left/gear_ratio?"));
  EXPECT_FALSE(driver.waitEnd(Seconds::zero())) << driver.errorText();
}

// A file name that is silently ignored would look taken.
TEST(CommandLine, IsRefusedInWordsWithoutAskingAMaster) {
  NodeProcess driver(kDriverProgram, {"my_robot.yaml", "__master:=http://127.0.0.1:1"});
  const auto end = driver.waitEnd(kPatience);
  ASSERT_TRUE(end) << driver.errorText();
  EXPECT_EQ(end->exit_code, 2);
  EXPECT_THAT(driver.errorText(), HasSubstr("nord_driver_node: \"my_robot.yaml\" is not known, expected --help"));
}

// No master is no wrong configuration: the node says so and waits. Asked to end meanwhile, it ends well.
TEST(NoMaster, IsSaidAndWaitedFor) {
  NodeProcess driver(kDriverProgram, {"__name:=driver_without_a_master", "__master:=http://127.0.0.1:1"});
  ASSERT_TRUE(eventually([&] { return !driver.errorLines().empty(); }));
  EXPECT_THAT(driver.errorText(), HasSubstr("no ROS master answers at http://127.0.0.1:1"));
  EXPECT_FALSE(driver.waitEnd(Seconds::zero())) << driver.errorText();
  driver.signal(SIGTERM);
  const auto end = driver.waitEnd(kPatience);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->exit_code, 0) << driver.errorText();
}

}  // namespace
}  // namespace nord_driver::test
