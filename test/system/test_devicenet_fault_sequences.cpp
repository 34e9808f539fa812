// Seeded trouble on DeviceNet, with drives and a base on top of it; the seeded frames against the engine alone are in
// test/devicenet/test_random_frames.cpp.
#include "system/devicenet_robot.h"
#include "system/fault_sequences.h"

namespace nord_driver::test {
namespace {

using std::chrono::seconds;

struct DevicenetTrouble {
  /// Two seconds of the scanner's duplicate-MAC check, two of the module's, and a pause between two tries.
  static constexpr seconds kBackWithin{6};

  static void strike(DevicenetRobot& robot, Dice& dice) {
    const std::size_t drive = dice.below(2);
    sim::BusModule& module = robot.unit(drive).module();
    switch (dice.below(16)) {
      case 12:
      case 13:
      case 0:
        return robot.bus().loseAnswers(1 + dice.below(6));
      case 14:
      case 15:
      case 1:
        return robot.bus().loseRequests(1 + dice.below(6));
      case 2:
        return robot.bus().overflow(1 + dice.below(6));
      case 3:
        return module.setPowered(dice.coin());
      case 4:
        return module.setMute(dice.coin());
      case 5:
        return module.setInverterLink(dice.coin());
      case 6:
        return robot.unit(drive).setInverterPower(dice.coin());
      case 7:
        return robot.bus().setInterfacePresent(dice.coin());
      case 8:
        return robot.bus().setQueueFull(dice.coin());
      case 9:
        return dice.coin() ? robot.bus().setBusOff() : robot.bus().restart();
      case 10: {
        // Somebody else: polls, an explicit request, a release, an answer nobody waits for.
        const std::uint32_t ids[] = {0x42D, 0x435, 0x42C, 0x436, 0x42B, 0x3C5};
        const std::array<std::uint8_t, 8> data{0x11, 0x4C, 0x03, 0x01, static_cast<std::uint8_t>(dice.below(4)),
                                               0,    0,    0};
        return robot.bus().inject(dataFrame(ids[dice.below(6)], ByteView{data.data(), 5}));
      }
      default: {
        sim::CanDisturbance disturbance;
        disturbance.lose = 0.01 * dice.below(3);
        disturbance.error = 0.01 * dice.below(3);
        disturbance.duplicate = 0.01 * dice.below(3);
        disturbance.seed = dice.below(1'000'000);
        return robot.bus().setDisturbance(disturbance);
      }
    }
  }

  static void end(DevicenetRobot& robot) {
    robot.bus().setDisturbance({});
    robot.bus().loseAnswers(0);
    robot.bus().loseRequests(0);
    robot.bus().overflow(0);
    robot.bus().setQueueFull(false);
    robot.bus().setInterfacePresent(true);
    robot.bus().restart();
    for (const std::size_t i : {0u, 1u}) {
      robot.unit(i).module().setPowered(true);
      robot.unit(i).module().setMute(false);
      robot.unit(i).module().setInverterLink(true);
      robot.unit(i).setInverterPower(true);
    }
  }
};

TEST(DevicenetFaultSequences, NothingIsEnabledAndNothingTurnsUnasked) {
  expectNothingUnasked<DevicenetRobot, DevicenetTrouble>(16, 4, 0);
}

}  // namespace
}  // namespace nord_driver::test
