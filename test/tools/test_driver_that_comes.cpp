// A driver on another computer that starts while nord_param works with the PROFIBUS: the bus is its.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tools/linked_drive.h"

namespace nord_driver::tools {
namespace {

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
  drive.link().pass(std::chrono::milliseconds{20});
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

}  // namespace
}  // namespace nord_driver::tools
