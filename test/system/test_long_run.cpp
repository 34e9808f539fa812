// An hour of the whole driver: what it costs an EEPROM that lives for 100,000 writes (BU 0020 7.5, BU 2700 6.5).
#include <gtest/gtest.h>

#include <cstdint>
#include <optional>

#include "catalogue/parameter_access.h"
#include "catalogue/shipped.h"
#include "system/simulated_robot.h"

namespace nord_driver::test {
namespace {

constexpr DriveIndex kLeft = 0, kRight = 1;
constexpr std::uint16_t kAccelerationTime = 102;

class LongRun : public ::testing::Test {
 protected:
  static SimulatedRobot::Options options() {
    SimulatedRobot::Options options;
    options.node = {{"cycle_rate", 25.0}};
    return options;
  }
  void SetUp() override { ASSERT_TRUE(robot_.bringUp()); }
  void TearDown() override { EXPECT_EQ("no rule broken", robot_.segment().referee().report()); }

  cycle::Completion read(DriveIndex drive, std::uint8_t set) {
    return robot_.ask(requestFor(drive, set, std::nullopt, false));
  }
  cycle::Completion write(DriveIndex drive, std::uint8_t set, double value, bool persistent) {
    return robot_.ask(requestFor(drive, set, value, persistent));
  }
  cycle::Completion select(DriveIndex drive, std::uint8_t set) {
    cycle::Request request;
    request.kind = cycle::RequestKind::kSelectParameterSet;
    request.drive = drive;
    request.parameter_set = set;
    return robot_.ask(request);
  }
  std::uint64_t eepromWrites(DriveIndex drive) { return robot_.unit(drive).parameters().eepromWrites(); }

  SimulatedRobot robot_{options()};

 private:
  static cycle::Request requestFor(DriveIndex drive, std::uint8_t set, std::optional<double> value, bool persistent) {
    cycle::Request request;
    const catalogue::DriveCatalogue known{catalogue::shippedCatalogues(), profile::Series::kSk5xxe, {}};
    catalogue::ParameterAccess access = catalogue::accessTo({kAccelerationTime, set, 0}, known);
    EXPECT_EQ("", access.error);
    if (value) {
      EXPECT_EQ("", catalogue::setValue(access, {*value, persistent, false}));
    }
    request.kind = value ? cycle::RequestKind::kWriteParameter : cycle::RequestKind::kReadParameter;
    request.drive = drive;
    request.parameter = access.request;
    return request;
  }
};

TEST_F(LongRun, AnHourOfRamWritesAndSetSwitchingLeavesTheEepromAlone) {
  const Instant end = robot_.transport().now() + std::chrono::hours{1};
  std::uint64_t rounds = 0;
  for (; robot_.transport().now() < end; ++rounds) {
    const DriveIndex drive = rounds % 2;
    const auto set = static_cast<std::uint8_t>(1 + rounds / 2 % 4);
    const double seconds = rounds / 8 % 2 == 0 ? 3.0 : 4.0;
    ASSERT_TRUE(select(drive, set).success) << rounds;
    const cycle::Completion written = write(drive, set, seconds, false);
    ASSERT_TRUE(written.success) << written.message.c_str();
    const cycle::Completion seen = read(drive, set);
    ASSERT_TRUE(seen.success) << seen.message.c_str();
    ASSERT_EQ(static_cast<std::int32_t>(seconds * 100), seen.parameter.raw);
    ASSERT_EQ(seen.parameter.raw, robot_.unit(drive).parameters().value(kAccelerationTime, set - 1u));
  }
  EXPECT_LT(3600u, rounds) << "more than one a second";
  for (const DriveIndex drive : {kLeft, kRight}) {
    EXPECT_EQ(0u, eepromWrites(drive));
    EXPECT_EQ(0u, robot_.snapshot().drives[drive].eeprom_writes) << "as the driver counts";
    EXPECT_LT(1800u, robot_.unit(drive).inverter().setSwitches());
    EXPECT_EQ(0u, robot_.unit(drive).counters().watchdog_trips);
    EXPECT_EQ(0, robot_.unit(drive).inverter().faultNumber());
  }
}

// Each persistent change costs one, however long its order stands on the bus; what is there already costs none.
TEST_F(LongRun, APersistentChangeCostsOneWriteEach) {
  std::uint64_t cost = 0;
  for (const double seconds : {3.0, 3.0, 4.0, 4.0, 5.0}) {
    const bool change = robot_.unit(kLeft).parameters().value(kAccelerationTime, 1) != 100.0 * seconds;
    const cycle::Completion written = write(kLeft, 2, seconds, true);
    ASSERT_TRUE(written.success) << written.message.c_str();
    cost += change ? 1 : 0;
    EXPECT_EQ(cost, eepromWrites(kLeft));
    EXPECT_EQ(cost, robot_.snapshot().drives[kLeft].eeprom_writes) << "as the driver counts";
  }
  EXPECT_EQ(3u, cost);
  EXPECT_EQ(0u, eepromWrites(kRight));
  // What stands in the RAM only is a change once it is to stay.
  ASSERT_TRUE(write(kLeft, 2, 6.0, false).success);
  EXPECT_EQ(3u, eepromWrites(kLeft));
  ASSERT_TRUE(write(kLeft, 2, 6.0, true).success);
  EXPECT_EQ(4u, eepromWrites(kLeft));
}

}  // namespace
}  // namespace nord_driver::test
