// A driver on another computer that starts while nord_param works with the PROFIBUS: the bus is its.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tools/linked_drive.h"

namespace nord_driver::tools {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;

/// Its telegram to station 9 is heard once per cycle of nord_param, for as long as it is `there`.
class AnotherDriver final : public cycle::CycleObserver {
 public:
  explicit AnotherDriver(LinkedDrive& drive) : drive_(drive) { drive.link().setObserver(this); }
  ~AnotherDriver() override { drive_.link().setObserver(nullptr); }
  AnotherDriver(const AnotherDriver&) = delete;
  AnotherDriver& operator=(const AnotherDriver&) = delete;

  void handleCycle(const std::vector<profile::ProcessOutput>&, const std::vector<DriveExchange>&,
                   const cycle::CycleSnapshot&) noexcept override {
    constexpr std::uint8_t kRequest[] = {0x10, 9, 1, 0x49, 0x53, 0x16};
    if (there) drive_.segment().foreign({kRequest, sizeof kRequest});
  }

  bool there = true;

 private:
  LinkedDrive& drive_;
};

catalogue::ParameterAddress acceleration() {
  catalogue::ParameterAddress address;
  address.number = 102;
  return address;
}

TEST(DriverThatComes, EndsAnAccessWithASentence) {
  LinkedDrive drive;
  ASSERT_EQ("", drive.trouble());
  const auto exchanges = [&] { return drive.left().counters().data_exchanges; };
  AnotherDriver other{drive};
  drive.link().pass(milliseconds{20});
  const std::uint64_t before = exchanges();
  const ParameterAnswer answer = drive.link().read(acceleration());
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message, HasSubstr("drive left does not answer: is left to another master, which leads this "
                                        "segment: nothing is sent for as long as that one is heard"));
  drive.link().pass(seconds{10});
  EXPECT_EQ(before, exchanges());
  other.there = false;
  drive.link().pass(seconds{3});
  EXPECT_TRUE(drive.link().read(acceleration()).success);
}

/// Such a driver has led the drives, has let this one run, and is gone.
void wasLedByAnother(LinkedDrive& drive, sim::DriveUnit& unit) {
  AnotherDriver other{drive};
  drive.link().pass(milliseconds{200});
  sim::ProcessData word;
  word.control = 0x047E;
  unit.inverter().receive(word);
  drive.segment().run(milliseconds{100});
  word.control = 0x047F;
  word.setpoints[0] = 0x2000;
  unit.inverter().receive(word);
  drive.segment().run(seconds{4});
  ASSERT_DOUBLE_EQ(25.0, unit.inverter().frequency());
  drive.link().pass(milliseconds{200});
}

// The idle word would acknowledge it: it is looked at first, and told.
TEST(DriverThatComes, AFaultItHasLeftIsTold) {
  LinkedDrive drive{{}, true, 1, {"left", "right"}};
  ASSERT_EQ("", drive.trouble());
  ASSERT_EQ(0x047E, drive.left().counters().last_control);
  wasLedByAnother(drive, drive.right());
  drive.right().inverter().trip(30, false);
  EXPECT_EQ("", drive.link().changedByReading(1)) << "it has not been looked at";
  drive.link().exchangeUntil(drive.link().now() + seconds{3}, drive.notAsked());
  ASSERT_TRUE(drive.link().snapshot(1).online);
  EXPECT_FALSE(drive.link().snapshot(1).fault);
  EXPECT_EQ("", drive.link().changedByReading(0));
  EXPECT_THAT(drive.link().changedByReading(1), HasSubstr("drive right was in fault when this program came"));
}

// One that runs is left as it is, as it is at the first look.
TEST(DriverThatComes, ADriveItHasLeftRunningIsRefused) {
  LinkedDrive drive;
  ASSERT_EQ("", drive.trouble());
  wasLedByAnother(drive, drive.left());
  std::string refusal;
  try {
    drive.link().exchangeUntil(drive.link().now() + seconds{10}, drive.notAsked());
  } catch (const Trouble& trouble) {
    refusal = trouble.what();
  }
  EXPECT_EQ("drive left is not at rest (operation enabled): it was left as it is; disable it first", refusal);
  EXPECT_THROW(drive.link().read(acceleration()), Trouble);
  drive.segment().run(seconds{10});
  EXPECT_DOUBLE_EQ(25.0, drive.left().inverter().frequency());
  EXPECT_EQ(0x0000, drive.left().counters().last_control);
}

}  // namespace
}  // namespace nord_driver::tools
