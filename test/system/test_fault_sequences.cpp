// Seeded trouble on the line, with drives and a base on top of it.
#include "system/fault_sequences.h"
#include "system/simulated_robot.h"

namespace nord_driver::test {
namespace {

using std::chrono::seconds;

constexpr std::uint32_t kSequences = 200;

struct LineTrouble {
  static constexpr seconds kBackWithin{3};

  static void strike(SimulatedRobot& robot, Dice& dice) {
    const std::size_t drive = dice.below(2);
    sim::BusModule& slave = robot.unit(drive).module();
    switch (dice.below(11)) {
      case 0:
        return robot.segment().loseAnswers(1 + dice.below(12));
      case 1:
        return robot.segment().loseRequests(1 + dice.below(12));
      case 2:
        return robot.segment().spoilAnswers(1 + dice.below(12));
      case 3:
        return slave.setPowered(dice.coin());
      case 4:
        return slave.setMute(dice.coin());
      case 5:
        return slave.setInverterLink(dice.coin());
      case 6:
        return robot.unit(drive).setInverterPower(dice.coin());
      case 7:
        return robot.segment().setDevicePresent(dice.coin());
      case 8:
        return robot.segment().setAnswerTime(20 + dice.below(400));
      case 9: {
        sim::Disturbance disturbance;
        disturbance.lose = 0.01 * dice.below(3);
        disturbance.flip = 0.01 * dice.below(3);
        disturbance.duplicate = 0.01 * dice.below(3);
        disturbance.seed = dice.below(1'000'000);
        return robot.segment().setDisturbance(disturbance);
      }
      default:
        return robot.segment().setDisturbance({});
    }
  }

  static void end(SimulatedRobot& robot) {
    robot.segment().setDisturbance({});
    robot.segment().setAnswerTime(32);
    robot.segment().loseAnswers(0);
    robot.segment().loseRequests(0);
    robot.segment().spoilAnswers(0);
    robot.segment().setDevicePresent(true);
    for (const std::size_t i : {0u, 1u}) {
      robot.unit(i).module().setPowered(true);
      robot.unit(i).module().setMute(false);
      robot.unit(i).module().setInverterLink(true);
      robot.unit(i).setInverterPower(true);
    }
  }
};

TEST(FaultSequences, NothingIsEnabledAndNothingTurnsUnasked) {
  expectNothingUnasked<SimulatedRobot, LineTrouble>(kSequences, 50, 5);
}

// Two cycles of nothing but silence, of one station or of the line, again and again: shorter than drive_timeout.
TEST(FaultSequences, LossesShorterThanDriveTimeoutStopNothing) {
  std::uint64_t retries = 0;
  for (std::uint32_t seed = 1; seed <= kSequences / 10 && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Dice trouble{seed};
    Watched<SimulatedRobot> watched;
    ASSERT_TRUE(watched.robot.bringUp());
    ASSERT_TRUE(watched.enable());
    watched.run(seconds{2});
    for (int i = 0; i < 30; ++i) {
      const unsigned cycles = 1 + trouble.below(2);
      const unsigned kind = trouble.below(4);
      const std::size_t drive = trouble.below(2);
      for (unsigned k = 0; k < cycles; ++k) {
        const unsigned telegrams = 1 + trouble.below(4);  // 4: both stations, with their repetitions
        if (kind == 0) watched.robot.segment().loseAnswers(telegrams);
        if (kind == 1) watched.robot.segment().loseRequests(telegrams);
        if (kind == 2) watched.robot.segment().spoilAnswers(telegrams);
        if (kind == 3) watched.robot.unit(drive).setMute(true);
        watched.step();
      }
      LineTrouble::end(watched.robot);
      const unsigned good = 1 + trouble.below(5);
      for (unsigned k = 0; k < good; ++k) watched.step();
      ASSERT_TRUE(watched.runs()) << "loss " << i << " of kind " << kind << ", " << cycles
                                  << " cycles: " << watched.robot.snapshot().base.text.c_str();
    }
    retries += watched.robot.transport().counters().value(bus_counter::kRetries);
    EXPECT_EQ("no rule broken", watched.robot.segment().referee().report());
  }
  EXPECT_GT(retries, 300u);
}

}  // namespace
}  // namespace nord_driver::test
