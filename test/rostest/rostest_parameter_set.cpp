// A node started over drives that turn in parameter set 3: its first control word must not switch the set.
#include <gmock/gmock.h>

#include <cmath>

#include "rostest/robot_under_test.h"
#include "support/map_settings.h"

namespace nord_driver::test {
namespace {

constexpr double kGear = 20.0, kPolePairs = 2.0, kMaxFrequencyOfSet3 = 25.0;  // robot.yaml, common.launch

/// Another master, long before: it lets both drives turn in parameter set 3 and leaves without a word. P513 = -0.1 lets
/// them run on (BU 2700 7.1.1).
class EarlierMaster {
 public:
  EarlierMaster() {
    std::vector<DriveSettings> drives;
    for (const std::string name : {"left", "right"}) {
      auto settings = std::make_shared<MapSettings>(name + "/");
      settings->set("address", name == "left" ? 3 : 4).set("series", "sk5xxe").set("pole_pairs", 2);
      bus().set_drive(*settings);
      drives.push_back({name, settings});
    }
    MapSettings settings{"bus/"};
    settings.set(bus().end_point, ros::param::param(std::string("nord_driver/bus/") + bus().end_point, std::string{}));
    bus().set_bus(settings);
    transport_ = bus().make_transport();
    transport_->configure(settings, drives, kRate);
  }
  ~EarlierMaster() { transport_->close(); }
  EarlierMaster(const EarlierMaster&) = delete;
  EarlierMaster& operator=(const EarlierMaster&) = delete;

  /// Sends the word until the masked status word of both drives is `status`; false when it is not in time.
  bool bring(Word control, std::int16_t setpoint, Word mask, Word status) {
    outputs_.assign(2, {});
    for (profile::ProcessOutput& output : outputs_) {
      output.control_word = control;
      output.setpoints[0] = setpoint;
    }
    const Instant deadline = transport_->now() + seconds(kPatience.count());
    while (transport_->now() < deadline) {
      const Instant start = transport_->now();
      transport_->exchange(outputs_, inputs_);
      transport_->sleepUntil(start + seconds(1.0 / kRate));
      bool all = true;
      for (const DriveExchange& input : inputs_) {
        all = all && input.inverter_answers && (input.input.status_word & mask) == status;
      }
      if (all) return true;
    }
    return false;
  }

 private:
  static constexpr double kRate = 100.0;  // Hz
  std::unique_ptr<Transport> transport_;
  std::vector<profile::ProcessOutput> outputs_;
  std::vector<DriveExchange> inputs_{2};
};

using ParameterSet = RobotTest;

// The set is learnt from the status word and kept: 847E is OFF1 in set 3, where 047E would be set 1, with another P105
// and other ramps, on a turning motor.
TEST_F(ParameterSet, ANodeOverDrivesThatTurnInSet3KeepsTheSetAndIdlesThem) {
  ASSERT_TRUE(robot().left.truth.next());  // the simulator is there
  {
    EarlierMaster earlier;
    constexpr Word kStateOfSet3 = 0xC06F;  // set and state bits of the status word; bits 14 and 15 = 10 is set 3
    ASSERT_TRUE(earlier.bring(0x847E, 0, kStateOfSet3, 0x8021));
    ASSERT_TRUE(earlier.bring(0x847F, 0, kStateOfSet3, 0x8027));
    ASSERT_TRUE(earlier.bring(0x847F, 0x2000, kStateOfSet3, 0x8027));
    const auto turning = [](const SimDrive& truth) { return truth.frequency > 0.49 * kMaxFrequencyOfSet3; };
    ASSERT_TRUE(eventually([&] {
      return earlier.bring(0x847F, 0x2000, kStateOfSet3, 0x8027) && turning(*robot().left.truth.next()) &&
             turning(*robot().right.truth.next());
    }));
  }
  // The module's watchdog expires, or the node is left alone; the inverters do not mind.
  for (DriveTopics* drive : {&robot().left, &robot().right}) {
    const auto alone = drive->truth.waitNext([](const SimDrive& truth) { return !truth.in_data_exchange; });
    ASSERT_TRUE(alone);
    ASSERT_TRUE(alone->operation_enabled);
  }

  const std::size_t left_from = robot().left.truth.mark();
  const std::size_t right_from = robot().right.truth.mark();
  const std::size_t status_from = robot().left.status.mark();
  ASSERT_NO_FATAL_FAILURE(startDriver());
  ASSERT_TRUE(robot().waitForRest());
  ASSERT_TRUE(robot().waitForStandstill());

  for (const auto& [drive, from] :
       {std::make_pair(&robot().left, left_from), std::make_pair(&robot().right, right_from)}) {
    const auto truths = drive->truth.since(from);
    ASSERT_FALSE(truths.empty());
    double last = kMaxFrequencyOfSet3;
    for (const auto& truth : truths) {
      ASSERT_EQ(truth->set_switches, truths.front()->set_switches);
      ASSERT_EQ(truth->parameter_set, 3);
      // What is heard is nothing yet, bit 10 = 0 which the drive does not evaluate, or 847E.
      ASSERT_TRUE(truth->control_word == 0x847F || truth->control_word == 0 || truth->control_word == 0x847E)
          << std::hex << truth->control_word;
      ASSERT_LE(truth->frequency, last + 1e-9) << "down the ramp, never up";
      last = truth->frequency;
    }
    EXPECT_EQ(truths.back()->control_word, 0x847E);
    EXPECT_EQ(truths.back()->fault_number, 0);
    const auto status = drive->status.next();
    EXPECT_EQ(status->parameter_set, 3);
    EXPECT_EQ(status->control_word, 0x847E);
  }

  // Enabled, the speed is scaled by P105 of set 3: 25 Hz, not 50.
  ASSERT_NO_FATAL_FAILURE(enableAndDrive(0.2));
  EXPECT_EQ(robot().left.truth.next()->control_word, 0x847F);
  // Both come to the end of the ramp, each in its time.
  constexpr double kShaft = 0.2 / 0.1 * kGear, kFrequency = kShaft * kPolePairs / (2.0 * M_PI);  // rad/s, Hz
  const auto truth =
      robot().left.truth.waitNext([](const SimDrive& left) { return std::fabs(left.frequency - kFrequency) < 0.1; });
  ASSERT_TRUE(truth) << robot().left.truth.next()->frequency;
  const auto status = robot().left.status.waitNext([](const DriveStatus& left) {
    return std::fabs(left.frequency - kFrequency) < 0.1 && std::fabs(left.velocity - kShaft / kGear) < 0.05;
  });
  ASSERT_TRUE(status) << *robot().left.status.next();
  const auto told = robot().left.status.next();
  const auto is = robot().left.truth.next();
  ASSERT_TRUE(told && is);
  EXPECT_NEAR(told->frequency, is->frequency, 0.1);
  EXPECT_NEAR(told->velocity, is->frequency * 2.0 * M_PI / kPolePairs / kGear, 0.05);
  EXPECT_EQ(truth->set_switches, robot().left.truth.since(left_from).front()->set_switches);
  EXPECT_GT(robot().left.status.mark(), status_from);
}

}  // namespace
}  // namespace nord_driver::test
