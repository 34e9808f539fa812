// ~<drive>/fault: a message for each thing that becomes known, and one when it is gone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "catalogue/shipped.h"
#include "node/fault_messages.h"

namespace nord_driver::node {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::uint16_t kUnknown = 65535, kMotorHot = 21;

class FaultMessagesTest : public ::testing::Test {
 protected:
  FaultMessagesTest() {
    drive_.online = true;
    drive_.time = start_;
    messages_.poll(drive_, stamps_);
  }
  void trip(std::uint16_t number) {
    ++drive_.faults;
    drive_.fault = drive_.fault_latched = true;
    drive_.fault_number = drive_.last_fault_number = number;
    drive_.at_fault.time = start_ - std::chrono::seconds{1};
    drive_.fault_history = {};
    drive_.fault_record.clear();
    for (int i = 0; i < 33; ++i) {
      cycle::CycleData data;
      data.time = drive_.at_fault.time - (32 - i) * std::chrono::milliseconds{10};
      data.answered = i != 5;
      data.output = {0x047F, {static_cast<std::int16_t>(i), 0, 0}};
      data.input = {0x0B37, {0, static_cast<std::int16_t>(-i), 0}};
      drive_.fault_record.push_back(data);
    }
  }
  void vanish() {
    drive_.fault = false;
    drive_.fault_number = 0;
  }
  std::vector<Fault> poll() { return messages_.poll(drive_, stamps_); }

  const Instant start_ = Instant{} + std::chrono::hours{1};
  const Stamps stamps_{ros::Time{5000.0}, start_};
  cycle::DriveSnapshot drive_;
  FaultMessages messages_{"left", {catalogue::shippedFaults(), profile::Series::kSk5xxe}};
};

TEST_F(FaultMessagesTest, AFaultWithAllThatIsKnownOfIt) {
  trip(kUnknown);
  auto due = poll();
  ASSERT_EQ(1u, due.size());
  EXPECT_EQ("left", due[0].name);
  EXPECT_EQ(kUnknown, due[0].number);
  EXPECT_TRUE(due[0].active);
  EXPECT_EQ(ros::Time{4999.0}, due[0].header.stamp);
  EXPECT_THAT(poll(), IsEmpty());

  drive_.fault_number = drive_.last_fault_number = kMotorHot;
  due = poll();
  ASSERT_EQ(1u, due.size());
  EXPECT_EQ(kMotorHot, due[0].number);
  EXPECT_EQ("E2.1, motor overtemperature (I2t)", due[0].text);
  EXPECT_THAT(due[0].cause, HasSubstr("too hot"));
  EXPECT_THAT(due[0].remedy, HasSubstr("let it cool down"));
  EXPECT_THAT(due[0].history, IsEmpty());
  EXPECT_EQ(ros::Time{4999.0}, due[0].header.stamp);

  drive_.fault_history.numbers = {kMotorHot, 102, 0};
  EXPECT_THAT(poll(), IsEmpty()) << "being read";
  drive_.fault_history.asked = true;
  due = poll();
  ASSERT_EQ(1u, due.size());
  EXPECT_THAT(due[0].history_numbers, ElementsAre(kMotorHot, 102, 0));
  EXPECT_THAT(due[0].history, ElementsAre("E2.1, motor overtemperature (I2t)", HasSubstr("E10.2, "), "no fault"));
  EXPECT_THAT(poll(), IsEmpty());
}

// Each message has them, since only the last one is kept for who comes later.
TEST_F(FaultMessagesTest, TheProcessDataBeforeIt) {
  trip(kUnknown);
  poll();
  drive_.fault_number = drive_.last_fault_number = kMotorHot;
  const auto due = poll();
  ASSERT_EQ(1u, due.size());
  const auto& data = due[0].process_data;
  ASSERT_EQ(33u, data.size());
  EXPECT_EQ(due[0].header.stamp, data[32].stamp);
  EXPECT_NEAR(0.32, (data[32].stamp - data[0].stamp).toSec(), 1e-9);
  EXPECT_NEAR(0.32, data[32].time - data[0].time, 1e-9);
  EXPECT_FALSE(data[5].answered);
  EXPECT_TRUE(data[6].answered);
  EXPECT_EQ(0x047F, data[7].control_word);
  EXPECT_EQ(0x0B37, data[7].status_word);
  EXPECT_THAT(data[7].setpoints, ElementsAre(7, 0, 0));
  EXPECT_THAT(data[7].actual_values, ElementsAre(0, -7, 0));
}

// The inverter takes it back by itself, which acknowledges nothing here.
TEST_F(FaultMessagesTest, IsGoneWhenItIsAcknowledged) {
  trip(kMotorHot);
  poll();
  vanish();
  auto due = poll();
  ASSERT_EQ(1u, due.size());
  EXPECT_EQ(kMotorHot, due[0].number);
  EXPECT_FALSE(due[0].active);
  drive_.fault_latched = false;
  due = poll();
  ASSERT_EQ(1u, due.size());
  EXPECT_EQ(0, due[0].number);
  EXPECT_EQ("no fault", due[0].text);
  EXPECT_EQ(ros::Time{5000.0}, due[0].header.stamp);
  EXPECT_THAT(due[0].process_data, IsEmpty());
  EXPECT_THAT(poll(), IsEmpty());
}

TEST_F(FaultMessagesTest, OneBetweenTwoPicturesIsToldAndGone) {
  trip(kMotorHot);
  vanish();
  drive_.fault_latched = false;
  const auto due = poll();
  ASSERT_EQ(2u, due.size());
  EXPECT_EQ(kMotorHot, due[0].number);
  EXPECT_EQ(33u, due[0].process_data.size());
  EXPECT_EQ(0, due[1].number);
  EXPECT_THAT(poll(), IsEmpty());
}

TEST_F(FaultMessagesTest, TheNextFaultIsAnotherOne) {
  trip(kMotorHot);
  poll();
  trip(kMotorHot);
  EXPECT_EQ(1u, poll().size());
}

// Who subscribes finds a message, whatever happens later.
TEST_F(FaultMessagesTest, ADriveThatAnswersWithoutOneSaysSoOnce) {
  FaultMessages messages{"left", {catalogue::shippedFaults(), profile::Series::kSk5xxe}};
  drive_.online = false;
  EXPECT_THAT(messages.poll(drive_, stamps_), IsEmpty());
  drive_.online = true;
  const auto due = messages.poll(drive_, stamps_);
  ASSERT_EQ(1u, due.size());
  EXPECT_EQ(0, due[0].number);
  EXPECT_THAT(messages.poll(drive_, stamps_), IsEmpty());
}

// P700 said "no fault" by then. The number stays unknown: nobody has seen that it is that one.
TEST_F(FaultMessagesTest, AFaultWithoutANumberNamesTheNewestOfTheHistory) {
  trip(kUnknown);
  ASSERT_EQ(1u, poll().size());
  vanish();
  drive_.last_fault_number = kUnknown;
  ASSERT_EQ(1u, poll().size());
  drive_.fault_history.asked = true;
  for (const int past : {102, 0}) drive_.fault_history.numbers.push_back(static_cast<std::uint16_t>(past));
  const auto due = poll();
  ASSERT_EQ(1u, due.size());
  EXPECT_EQ(kUnknown, due[0].number);
  EXPECT_FALSE(due[0].active);
  EXPECT_THAT(due[0].text,
              HasSubstr("; the newest of its last faults, P701[-01], is E10.2, bus timeout of the option"));
  EXPECT_THAT(due[0].remedy, HasSubstr("P701"));
  EXPECT_THAT(due[0].history_numbers, ElementsAre(102, 0));
}

TEST_F(FaultMessagesTest, AnEmptyHistoryNamesNothing) {
  trip(kUnknown);
  poll();
  for (const bool empty : {true, false}) {
    vanish();
    drive_.fault_history = {};
    if (!empty) drive_.fault_history.numbers.push_back(0);
    poll();
    drive_.fault_history.asked = true;
    const auto due = poll();
    ASSERT_EQ(1u, due.size());
    EXPECT_EQ("fault of unknown number, fault; its number could not be read", due[0].text);
  }
}

}  // namespace
}  // namespace nord_driver::node
