// Parameters over the services: what is read, what is written where, and every refusal in words.
#include <gmock/gmock.h>
#include <signal.h>

#include <fstream>
#include <limits>
#include <memory>
#include <thread>

#include "nord_driver/ReadParameter.h"
#include "nord_driver/WriteParameter.h"
#include "rostest/robot_under_test.h"

namespace nord_driver::test {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;

struct Read : Answer {
  ReadParameter::Response response;
};
struct Written : Answer {
  WriteParameter::Response response;
};

/// With a driver of its own for all tests of a suite.
class ParameterService : public RobotTest {
 protected:
  static void SetUpTestSuite() {
    ros::param::set("nord_driver/allow_raw_parameters", false);
    start();
  }
  static void TearDownTestSuite() {
    shared_driver->signal(SIGTERM);
    EXPECT_TRUE(shared_driver->waitEnd(kPatience));
    shared_driver.reset();
  }
  static void start() {
    shared_driver = std::make_unique<NodeProcess>(kDriverProgram, std::vector<std::string>{"__name:=nord_driver"});
  }
  void SetUp() override {
    RobotTest::SetUp();
    ASSERT_TRUE(robot().waitForDrivesOnline());
  }
  static Read read(const std::string& drive, int number, int set = 0, int index = 0) {
    ReadParameter service;
    service.request.number = static_cast<std::uint16_t>(number);
    service.request.parameter_set = static_cast<std::uint8_t>(set);
    service.request.index = static_cast<std::uint8_t>(index);
    Read result;
    static_cast<Answer&>(result) = callService("nord_driver/" + drive + "/read_parameter", service);
    result.response = service.response;
    return result;
  }
  static Written write(const std::string& drive, int number, double value, bool persistent, int set = 0,
                       int index = 0) {
    WriteParameter service;
    service.request.number = static_cast<std::uint16_t>(number);
    service.request.parameter_set = static_cast<std::uint8_t>(set);
    service.request.index = static_cast<std::uint8_t>(index);
    service.request.value = value;
    service.request.persistent = persistent;
    Written result;
    static_cast<Answer&>(result) = callService("nord_driver/" + drive + "/write_parameter", service);
    result.response = service.response;
    return result;
  }
  static DriveTopics& topics(const std::string& drive) { return drive == "left" ? robot().left : robot().right; }
  static std::uint64_t eepromWrites(const std::string& drive) { return topics(drive).truth.next()->eeprom_writes; }

  static std::unique_ptr<NodeProcess> shared_driver;
};
std::unique_ptr<NodeProcess> ParameterService::shared_driver;

class RawParameters : public ParameterService {
 protected:
  static void SetUpTestSuite() {
    ros::param::set("nord_driver/allow_raw_parameters", true);
    start();
  }
};

/// With a driver that may write each EEPROM twice a day.
class EepromBudget : public ParameterService {
 protected:
  static void SetUpTestSuite() {
    ros::param::set("nord_driver/eeprom_budget", 2);
    ASSERT_TRUE(ros::param::get("nord_driver/eeprom_state_file", shared_file));
    std::ofstream(shared_file) << "schema: 1\ndrives:\n";  // the other suites have used it
    start();
  }
  static void TearDownTestSuite() {
    ParameterService::TearDownTestSuite();
    ros::param::set("nord_driver/eeprom_budget", 1000);
    std::ofstream(shared_file) << "schema: 1\ndrives:\n";
  }
  /// As after a crash.
  static void killAndRestart() {
    shared_driver->signal(SIGKILL);
    ASSERT_TRUE(shared_driver->waitEnd(kPatience));
    start();
    ASSERT_TRUE(robot().waitForDrivesOnline());
  }

  static std::string shared_file;
};
std::string EepromBudget::shared_file;

// Set 0 is the active set: the driver's, 1 here. P105 of set 3 differs (common.launch).
TEST_F(ParameterService, ReadsASetDependentParameterOfTheSetAskedFor) {
  Read p105 = read("left", 105);
  ASSERT_TRUE(p105.success) << p105;
  EXPECT_EQ(p105.response.raw, 500);
  EXPECT_DOUBLE_EQ(p105.response.value, 50.0);
  EXPECT_EQ(p105.response.unit, "Hz");
  EXPECT_EQ(p105.response.name, "Maximum frequency");
  EXPECT_EQ(p105.message, "P105 = 50.0 Hz");
  p105 = read("left", 105, 3);
  ASSERT_TRUE(p105.success) << p105;
  EXPECT_EQ(p105.response.raw, 250);
  EXPECT_DOUBLE_EQ(p105.response.value, 25.0);
}

TEST_F(ParameterService, ReadsANegativeValueAndASetThatDoesNotMatter) {
  // P513 does not depend on the set: a set is ignored.
  const Read p513 = read("left", 513, 2);
  ASSERT_TRUE(p513.success) << p513;
  EXPECT_EQ(p513.response.raw, 0);
  EXPECT_EQ(p513.response.unit, "s");
}

// [-01] is 1: version, revision (BU 0020 6.2, P707).
TEST_F(ParameterService, ReadsAnArrayElementByItsPrintedIndex) {
  const Read version = read("left", 707, 0, 1);
  ASSERT_TRUE(version.success) << version;
  EXPECT_EQ(version.response.raw, 20);
  EXPECT_TRUE(read("left", 707, 0, 2).success);
  const Read none = read("left", 707, 0, 9);
  EXPECT_FALSE(none.success);
  EXPECT_THAT(none.message,
              AllOf(HasSubstr("drive left refuses P707"), HasSubstr(bus().refusal(Refusal::kNoSuchIndex))));
}

// P113 is in no file of the catalogue, so that the set has to be named: as transferred, without unit and name.
TEST_F(ParameterService, ReadsAnUnknownParameterRaw) {
  const Read p113 = read("left", 113, 1);
  ASSERT_TRUE(p113.success) << p113;
  EXPECT_DOUBLE_EQ(p113.response.value, p113.response.raw);
  EXPECT_EQ(p113.response.unit, "");
  EXPECT_EQ(p113.response.name, "");
}

// By the name the file of its series gives it.
TEST_F(ParameterService, NamesAValueAndTheNumberOfAFault) {
  const Read source = read("left", 509);
  ASSERT_TRUE(source.success) << source;
  EXPECT_THAT(source.message, ContainsRegex("^P509 = [0-9]+ [A-Z]"));
  const Read fault = read("left", 700, 0, 1);
  ASSERT_TRUE(fault.success) << fault;
  EXPECT_EQ(fault.message, "P700[-01] = 0.0 no fault");
}

TEST_F(ParameterService, SaysInWordsWhatDoesNotExist) {
  const Read no_number = read("left", 1000);
  EXPECT_THAT(no_number.message, AllOf(HasSubstr("parameter 1000 does not exist"), HasSubstr("0 to 999")));
  EXPECT_TRUE(no_number.response.refused) << "by the driver";
  EXPECT_FALSE(no_number.response.unknown);
  EXPECT_THAT(read("left", 105, 5).message, AllOf(HasSubstr("parameter set 5 does not exist"), HasSubstr("0 to 4")));
  const Read unknown = read("left", 999);
  EXPECT_FALSE(unknown.success);
  EXPECT_THAT(unknown.message,
              AllOf(HasSubstr("drive left refuses P999"), HasSubstr(bus().refusal(Refusal::kUnknownParameter))));
  EXPECT_TRUE(unknown.response.refused);
}

// RAM orders spare the EEPROM (BU 2700 6.5.1.1, AK 11 to 14). Where there are none it is P560, off and on.
TEST_F(ParameterService, WritesToRamWithoutTheEeprom) {
  const std::uint64_t before = eepromWrites("left");
  const Written ramp = write("left", 102, 1.5, false, 2);
  ASSERT_TRUE(ramp.success) << ramp;
  EXPECT_EQ(ramp.response.raw, 150);
  EXPECT_DOUBLE_EQ(ramp.response.value, 1.5);
  EXPECT_DOUBLE_EQ(read("left", 102, 2).response.value, 1.5);
  EXPECT_DOUBLE_EQ(read("left", 102, 1).response.value, 0.5) << "the other sets stay";
  EXPECT_LE(eepromWrites("left"), before + (bus().has_ram_orders ? 0 : 2));
}

TEST_F(ParameterService, WritesPersistentlyOnceAndTheSameValueNotAtAll) {
  const std::uint64_t before = eepromWrites("left");
  const Written first = write("left", 102, 2.5, true, 4);
  ASSERT_TRUE(first.success) << first;
  EXPECT_EQ(first.response.raw, 250);
  EXPECT_EQ(first.message, "P102 = 2.50 s");
  EXPECT_EQ(eepromWrites("left"), before + 1);

  const Written again = write("left", 102, 2.5, true, 4);
  ASSERT_TRUE(again.success) << again;
  EXPECT_THAT(again.message, HasSubstr("nothing was written"));
  EXPECT_EQ(again.response.raw, 250);
  EXPECT_EQ(eepromWrites("left"), before + 1);
}

// Beyond the catalogue the driver says no, beyond its own range the inverter does. Nothing is written.
TEST_F(ParameterService, RefusesAValueOutOfRangeInWords) {
  const std::uint64_t before = eepromWrites("left");
  const Written too_long = write("left", 513, 200.0, true);
  EXPECT_FALSE(too_long.success);
  EXPECT_THAT(too_long.message, AllOf(HasSubstr("200"), HasSubstr("P513"), HasSubstr("-0.1 to 100 s")));
  EXPECT_TRUE(too_long.response.refused && !too_long.response.used_up);
  const Written nan = write("left", 102, std::numeric_limits<double>::quiet_NaN(), true);
  EXPECT_FALSE(nan.success);
  EXPECT_THAT(nan.message, HasSubstr("expected"));
  const Written by_the_inverter = write("left", 102, 400.0, false);
  EXPECT_FALSE(by_the_inverter.success);
  EXPECT_THAT(by_the_inverter.message,
              AllOf(HasSubstr("drive left refuses P102"), HasSubstr(bus().refusal(Refusal::kOutOfLimits))));
  EXPECT_TRUE(by_the_inverter.response.refused && !by_the_inverter.response.used_up);
  EXPECT_DOUBLE_EQ(read("left", 102).response.value, 0.5);
  const Written read_only = write("left", 743, 5.0, false);
  EXPECT_FALSE(read_only.success);
  EXPECT_THAT(read_only.message, AllOf(HasSubstr("P743 "), HasSubstr(" can only be read")));
  const Written factory = write("left", 152, 1.0, false);
  EXPECT_FALSE(factory.success);
  EXPECT_THAT(factory.message, AllOf(HasSubstr("P152"), HasSubstr(" is never written")));
  EXPECT_LE(eepromWrites("left"), before + (bus().has_ram_orders ? 0 : 2)) << "P560 off and on";
}

// Without a unit nobody knows what 12 is: a key of the configuration has to allow it.
TEST_F(ParameterService, RefusesToWriteAnUnknownParameter) {
  const Written p113 = write("left", 113, 12.0, false, 1);
  EXPECT_FALSE(p113.success);
  EXPECT_THAT(p113.message, AllOf(HasSubstr("P113 is not in the catalogue"), HasSubstr("allow_raw_parameters: true")));
  EXPECT_EQ(read("left", 113, 1).response.raw, 0);
  const Written quick_stop = write("left", 426, 0.1, false, 1);
  EXPECT_FALSE(quick_stop.success);
  EXPECT_THAT(quick_stop.message, AllOf(HasSubstr("P426 Quick stop time"), HasSubstr("allow_raw_parameters: true")));
}

TEST_F(RawParameters, WritesAnUnknownParameterWhereItIsAllowed) {
  const Written p113 = write("left", 113, 12.0, false, 1);
  ASSERT_TRUE(p113.success) << p113;
  EXPECT_EQ(p113.response.raw, 12);
  EXPECT_EQ(read("left", 113, 1).response.raw, 12);
}

// An inverter without AK 11 to 14 (BU 2700 6.5.1.1: some do not know them): P560 spares the EEPROM, and is put back.
TEST_F(ParameterService, WritesToRamThroughP560WhereThereAreNoRamOrders) {
  const std::uint64_t before = eepromWrites("right");
  const Written ramp = write("right", 102, 1.5, false, 2);
  ASSERT_TRUE(ramp.success) << ramp;
  EXPECT_THAT(ramp.message, AllOf(HasSubstr("P560 was set to 0"), HasSubstr("put back to 1")));
  EXPECT_DOUBLE_EQ(read("right", 102, 2).response.value, 1.5);
  EXPECT_EQ(read("right", 560).response.raw, 1);
  EXPECT_LE(eepromWrites("right"), before + 2) << "P560 off and on, the value not";
}

// The write has switched P560 off when the node is asked to end: cut off here, the inverter would save nothing any more.
TEST_F(ParameterService, PutsP560BackBeforeTheNodeEnds) {
  const std::uint64_t before = eepromWrites("right");
  std::thread caller{[] { write("right", 102, 1.7, false, 2); }};
  EXPECT_TRUE(robot().right.truth.waitNext([&](const SimDrive& is) { return is.eeprom_writes > before; }));
  shared_driver->signal(SIGTERM);
  EXPECT_TRUE(shared_driver->waitEnd(kPatience));
  caller.join();
  start();
  ASSERT_TRUE(robot().waitForDrivesOnline());
  const Read after = read("right", 560);
  ASSERT_TRUE(after.success) << after;
  EXPECT_EQ(after.response.raw, 1);
}

TEST_F(EepromBudget, IsKeptAcrossAKilledDriverAndRefusesInWords) {
  const std::uint64_t before = eepromWrites("left");
  const Written first = write("left", 102, 2.5, true, 3);
  ASSERT_TRUE(first.success) << first;
  EXPECT_TRUE(write("left", 102, 2.5, true, 3).success) << "the same again is not written and costs nothing";
  killAndRestart();
  const Written second = write("left", 102, 3.0, true, 3);
  ASSERT_TRUE(second.success) << second;
  killAndRestart();
  const Written third = write("left", 102, 3.5, true, 3);
  EXPECT_FALSE(third.success);
  EXPECT_TRUE(third.response.refused && third.response.used_up);
  EXPECT_THAT(third.message, AllOf(HasSubstr("drive left: its EEPROM has had 2 writes"), HasSubstr("eeprom_budget")));
  EXPECT_EQ(eepromWrites("left"), before + 2);
  EXPECT_DOUBLE_EQ(read("left", 102, 3).response.value, 3.0);
  // Where a write to RAM costs EEPROM writes, too, it is refused with it.
  EXPECT_EQ(write("left", 102, 3.5, false, 3).success, bus().has_ram_orders);
  std::ofstream(shared_file) << "?";
  const Written broken = write("left", 102, 4.0, true, 3);
  EXPECT_FALSE(broken.success);
  EXPECT_THAT(broken.message, AllOf(HasSubstr(shared_file), HasSubstr("mend or remove the file")));
  EXPECT_TRUE(write("left", 102, 4.0, false, 3).success) << "the RAM can be written";
}

}  // namespace
}  // namespace nord_driver::test
