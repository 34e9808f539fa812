// Two programs on one segment, each with its own adapter: one that looks on and was there first, and a driver.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "sim/profibus/simulated_segment.h"
#include "support/map_settings.h"
#include "transport/profibus/profibus_dp.h"

namespace nord_driver {
namespace {

using profile::ParameterOutcome;
using std::chrono::milliseconds;
using std::chrono::seconds;
using test::MapSettings;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;

/// The line between two adapters: each hears what the other one sends, and every answer, `latency` later.
struct SharedLine {
  explicit SharedLine(const sim::SimConfig& config) : segment(config) { segment.open(); }
  sim::SimulatedSegment segment;
  struct Heard {
    std::uint8_t byte;
    Instant at;
  };
  std::array<std::deque<Heard>, 2> heard;
  Duration latency{};
  std::array<std::size_t, 2> sent{};  ///< telegrams
};

class AdapterOnALine final : public link::ByteLink {
 public:
  AdapterOnALine(SharedLine& line, std::size_t which) : line_(line), which_(which) {}

  bool open() noexcept override {
    heard().clear();
    return open_ = true;
  }
  void close() noexcept override { open_ = false; }
  bool isOpen() const noexcept override { return open_; }
  bool write(ByteView telegram) noexcept override {
    ++line_.sent[which_];
    tellOther(telegram);
    return line_.segment.write(telegram);
  }
  std::size_t read(std::uint8_t* buffer, std::size_t capacity) noexcept override {
    std::size_t count = 0;
    for (; count < capacity && hasHeard(); ++count) {
      buffer[count] = heard().front().byte;
      heard().pop_front();
    }
    if (count > 0) return count;
    count = line_.segment.read(buffer, capacity);
    tellOther({buffer, count});
    return count;
  }
  void discardInput() noexcept override { heard().clear(); }
  bool waitReadable(Instant until) noexcept override {
    if (hasHeard()) return true;
    const Instant next = heard().empty() ? until : std::min(until, heard().front().at);
    return line_.segment.waitReadable(next) || hasHeard();
  }
  void sleepUntil(Instant when) noexcept override { line_.segment.sleepUntil(when); }
  Instant now() const noexcept override { return line_.segment.now(); }
  bool keepsBaudRate() const noexcept override { return true; }
  const std::string& lastError() const noexcept override { return no_error_; }

 private:
  std::deque<SharedLine::Heard>& heard() noexcept { return line_.heard[which_]; }
  bool hasHeard() noexcept { return !heard().empty() && heard().front().at <= now(); }
  void tellOther(ByteView bytes) noexcept {
    for (const std::uint8_t byte : bytes) line_.heard[1 - which_].push_back({byte, now() + line_.latency});
  }

  SharedLine& line_;
  std::size_t which_;
  bool open_ = false;
  std::string no_error_;
};

/// A program with a drive at station 3, 100 cycles a second and, of a driver, a watchdog of 200 ms.
class Program {
 public:
  Program(SharedLine& line, std::size_t which, bool looks_on, int ppo_type)
      : transport_{
            [&line, which](const link::SerialSettings&) { return std::make_unique<AdapterOnALine>(line, which); }} {
    auto drive = std::make_shared<MapSettings>("~drives/lift/");
    drive->set("address", 3).set("series", "sk2xxe").set("pole_pairs", 2).set("inverter", 1).set("ppo_type", ppo_type);
    if (looks_on) transport_.serveParametersOnly();
    const MapSettings bus{"~bus/", {{"device", std::string{"simulated"}}, {"slot_time", 0.0005}}};
    transport_.configure(bus, {{"lift", drive}}, 100.0);
    transport_.setDriveTimeout(milliseconds{50});
  }

  void cycle() {
    transport_.exchange(outputs_, inputs_);
    while (const auto event = transport_.pollEvent()) events_.push_back(event->text.str());
  }
  void command(Word word, std::int16_t setpoint = 0) {
    outputs_[0].control_word = word;
    outputs_[0].setpoints[0] = setpoint;
  }
  bool drives() const { return inputs_[0].inverter_answers; }
  bool asks(std::uint16_t number) {
    profile::ParameterRequest request;
    request.id = 77;
    request.number = number;
    request.shape = profile::ParameterShape::kPerSet;
    return transport_.submit(0, request);
  }
  std::string note() const { return transport_.note(0).text; }
  ProfibusDpTransport& transport() { return transport_; }
  const std::vector<std::string>& events() const { return events_; }

 private:
  ProfibusDpTransport transport_;
  std::vector<profile::ProcessOutput> outputs_{1};
  std::vector<DriveExchange> inputs_{1};
  std::vector<std::string> events_;
};

class ProfibusGivesWay : public ::testing::TestWithParam<int> {
 protected:
  static sim::SimConfig simulated(int ppo_type) {
    sim::SimConfig config;
    sim::DriveConfig drive;
    drive.name = "lift";
    drive.address = 3;
    drive.device.series = sim::Series::kSk2xxe;
    drive.place = 1;
    drive.bus.as<sim::DpDriveConfig>().ppo_type = ppo_type;
    config.drives.push_back(drive);
    return config;
  }
  void run(Duration span) {
    for (const Instant end = line_.segment.now() + span; line_.segment.now() < end;) {
      const Instant start = line_.segment.now();
      if (driver_) driver_->cycle();
      looker_.cycle();
      line_.segment.sleepUntil(start + milliseconds{10});
    }
  }
  // Both begin in the same moment, and hear each other too late.
  void runTwoThatLookOn(Duration latency) {
    line_.latency = latency;
    driver_ = std::make_unique<Program>(line_, 1, true, GetParam());
    run(seconds{10});
  }
  void startDriver() { driver_ = std::make_unique<Program>(line_, 1, false, GetParam()); }
  sim::InverterState state() { return line_.segment.drive(0).inverter().state(); }
  std::uint64_t trips() { return line_.segment.station(0).counters().watchdog_trips; }

  SharedLine line_{simulated(GetParam())};
  Program looker_{line_, 0, true, GetParam()};
  std::unique_ptr<Program> driver_;
};

// And whoever kills the driver finds its drive stopped by its watchdog, though somebody looks on.
TEST_P(ProfibusGivesWay, ToADriverThatStartsLater) {
  run(seconds{2});
  ASSERT_TRUE(looker_.drives());
  startDriver();
  run(seconds{1});
  EXPECT_TRUE(driver_->drives());
  EXPECT_FALSE(looker_.drives());
  EXPECT_THAT(looker_.note(), HasSubstr("is left to another master, which leads this segment"));
  EXPECT_THAT(looker_.transport().busText().str(), HasSubstr("nothing is sent for as long as it is heard"));
  EXPECT_THAT(looker_.events(), Contains(AllOf(HasSubstr("PROFIBUS station 3 (lift) is left to another master"))));
  EXPECT_THAT(looker_.events(), Contains(HasSubstr("PROFIBUS address 1: another master leads this segment")));

  const std::size_t sent = line_.sent[0];
  driver_->command(0x047E);
  run(seconds{1});
  driver_->command(0x047F, 0x1000);
  run(seconds{20});
  ASSERT_EQ(sim::InverterState::kOperationEnabled, state());
  EXPECT_EQ(sent, line_.sent[0]);
  EXPECT_EQ(0u, trips());

  driver_.reset();
  run(milliseconds{300});
  EXPECT_EQ(1u, trips());
  EXPECT_NE(sim::InverterState::kOperationEnabled, state());
  EXPECT_EQ(sent, line_.sent[0]);
  run(seconds{2});
  EXPECT_TRUE(looker_.drives()) << looker_.note();
}

TEST_P(ProfibusGivesWay, WhoWaitsForAParameterIsToldWhy) {
  run(seconds{2});
  ASSERT_TRUE(looker_.drives());
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(looker_.asks(102));
  startDriver();
  run(milliseconds{20});
  ASSERT_TRUE(looker_.asks(102)) << "and whoever asks then";
  run(milliseconds{20});
  int ended = 0;
  while (const auto result = looker_.transport().pollResult()) {
    ++ended;
    if (result->outcome == ParameterOutcome::kDone) continue;  // before the driver came
    EXPECT_EQ(ParameterOutcome::kOffline, result->outcome);
    EXPECT_THAT(result->text.str(), HasSubstr("is left to another master, which leads this segment")) << ended;
  }
  EXPECT_EQ(4, ended);
}

// Behind adapters that hand over late, who looks on sends before it hears that another one does: they do not meet for ever.
TEST_P(ProfibusGivesWay, TwoThatLookOnDoNotMeetForEver) {
  for (const int latency : {4, 16}) {
    SCOPED_TRACE(latency);
    runTwoThatLookOn(milliseconds{latency});
    EXPECT_NE(looker_.drives(), driver_->drives());
    EXPECT_LE(looker_.events().size(), 20u);
    driver_.reset();
  }
}

// By PKW, and by records.
INSTANTIATE_TEST_SUITE_P(PpoTypes, ProfibusGivesWay, ::testing::Values(1, 3));

}  // namespace
}  // namespace nord_driver
