// An hour of the whole driver on every bus: what it costs an EEPROM that lives for 100,000 writes (BU 0020 7.5, BU 2700
// 6.5).
#include <gtest/gtest.h>

#include <cstdint>
#include <optional>

#include "catalogue/parameter_access.h"
#include "catalogue/shipped.h"
#include "system/every_robot.h"

namespace nord_driver::test {
namespace {

constexpr DriveIndex kLeft = 0, kRight = 1;
constexpr std::uint16_t kAccelerationTime = 102, kSaveInEeprom = 560;

template <typename Robot>
class LongRun : public ::testing::Test {
 protected:
  static typename Robot::Options options() {
    typename Robot::Options options;
    options.node = {{"cycle_rate", 25.0}};
    return options;
  }
  void SetUp() override { ASSERT_TRUE(robot_.bringUp()); }
  void TearDown() override { EXPECT_EQ("no rule broken", busOf(robot_).referee().report()); }

  /// This bus has orders that write to the RAM alone. Without them P560 decides.
  bool hasRamOrders() { return robot_.transport().parameterCapabilities(kLeft).ram_writes; }
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
  /// As the driver counts.
  std::uint64_t toldWrites(DriveIndex drive) { return robot_.snapshot().drives[drive].eeprom_writes; }

  Robot robot_{options()};

 private:
  cycle::Request requestFor(DriveIndex drive, std::uint8_t set, std::optional<double> value, bool persistent) {
    cycle::Request request;
    const catalogue::DriveCatalogue known{catalogue::shippedCatalogues(), robot_.config().drives[drive].series, {}};
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
TYPED_TEST_SUITE(LongRun, EveryRobot, BusName);

// Where the bus has no orders for the RAM, somebody who writes often sets P560 = 0 before, as the manuals advise.
TYPED_TEST(LongRun, AnHourOfRamWritesAndSetSwitchingLeavesTheEepromAlone) {
  for (const DriveIndex drive : {kLeft, kRight}) {
    if (!this->hasRamOrders()) this->robot_.unit(drive).parameters().preset(kSaveInEeprom, 0, 0, 0);
  }
  const Instant end = this->robot_.transport().now() + std::chrono::hours{1};
  std::uint64_t rounds = 0;
  for (; this->robot_.transport().now() < end; ++rounds) {
    const DriveIndex drive = rounds % 2;
    const auto set = static_cast<std::uint8_t>(1 + rounds / 2 % 4);
    const double seconds = rounds / 8 % 2 == 0 ? 3.0 : 4.0;
    ASSERT_TRUE(this->select(drive, set).success) << rounds;
    const cycle::Completion written = this->write(drive, set, seconds, false);
    ASSERT_TRUE(written.success) << written.message.c_str();
    const cycle::Completion seen = this->read(drive, set);
    ASSERT_TRUE(seen.success) << seen.message.c_str();
    ASSERT_EQ(static_cast<std::int32_t>(seconds * 100), seen.parameter.raw);
    ASSERT_EQ(seen.parameter.raw, this->robot_.unit(drive).parameters().value(kAccelerationTime, set - 1u));
  }
  EXPECT_LT(3600u, rounds) << "more than one a second";
  for (const DriveIndex drive : {kLeft, kRight}) {
    EXPECT_EQ(0u, this->eepromWrites(drive));
    EXPECT_EQ(0u, this->toldWrites(drive));
    EXPECT_LT(1800u, this->robot_.unit(drive).inverter().setSwitches());
    EXPECT_EQ(0u, this->robot_.unit(drive).counters().watchdog_trips);
    EXPECT_EQ(0, this->robot_.unit(drive).inverter().faultNumber());
  }
}

// Each persistent change costs one, however long its order stands on the bus; what is there already costs none.
TYPED_TEST(LongRun, APersistentChangeCostsOneWriteEach) {
  std::uint64_t cost = 0;
  for (const double seconds : {3.0, 3.0, 4.0, 4.0, 5.0}) {
    const bool change = this->robot_.unit(kLeft).parameters().value(kAccelerationTime, 1) != 100.0 * seconds;
    const cycle::Completion written = this->write(kLeft, 2, seconds, true);
    ASSERT_TRUE(written.success) << written.message.c_str();
    cost += change ? 1 : 0;
    EXPECT_EQ(cost, this->eepromWrites(kLeft));
    EXPECT_EQ(cost, this->toldWrites(kLeft));
    EXPECT_EQ(change, written.parameter.eeprom_written) << "what the budget counts by";
  }
  EXPECT_EQ(3u, cost);
  EXPECT_EQ(0u, this->eepromWrites(kRight));
}

// What stands in the RAM only is a change once it is to stay. Through P560 a write to the RAM is counted not too low.
TYPED_TEST(LongRun, AValueOfTheRamCostsOneWriteWhenItIsToStay) {
  const cycle::Completion to_ram = this->write(kLeft, 2, 6.0, false);
  ASSERT_TRUE(to_ram.success) << to_ram.message.c_str();
  const std::uint64_t cost = this->eepromWrites(kLeft), told = this->toldWrites(kLeft);
  EXPECT_EQ(this->hasRamOrders(), cost == 0);
  EXPECT_EQ(!this->hasRamOrders(), to_ram.parameter.eeprom_written);
  EXPECT_GE(told, cost);
  ASSERT_TRUE(this->write(kLeft, 2, 6.0, true).success);
  EXPECT_EQ(cost + 1, this->eepromWrites(kLeft));
  EXPECT_EQ(told + 1, this->toldWrites(kLeft));
}

}  // namespace
}  // namespace nord_driver::test
