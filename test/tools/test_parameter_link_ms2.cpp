// nord_param on a station that is not in data exchange: over a connection of class 2 (MS2).
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <memory>

#include "catalogue/shipped.h"
#include "sim/profibus/simulated_segment.h"
#include "tools/parameter_link.h"
#include "tools/write_value.h"
#include "transport/profibus/profibus_ms2.h"

namespace nord_driver::tools {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// An SK 2xxE behind a module that has no address yet.
class Ms2Link : public ::testing::Test {
 protected:
  explicit Ms2Link(const std::string& more_of_bus = "")
      : config_(readToolConfig(
            YAML::Load(std::string("{transport: profibus_ms2, cycle_rate: 100, left_wheel: left_wheel_joint,") +
                       " bus: {device: simulated, baud_rate: 500000, slot_time: 0.0005" + more_of_bus +
                       "},"
                       " drives: {left: {address: 126, series: sk2xxe, pole_pairs: 2}}}"),
            "left")),
        transport_([this](const link::SerialSettings&) {
          sim::SimConfig config;
          config.bus.as<sim::DpBusConfig>().baud_rate = 500'000;
          sim::DriveConfig drive;
          drive.name = "left";
          drive.address = 126;
          drive.device.series = sim::Series::kSk2xxe;
          drive.place = 1;
          config.drives.push_back(drive);
          auto made = std::make_unique<sim::SimulatedSegment>(config);
          segment_ = made.get();
          return made;
        }),
        link_(config_, transport_, catalogue::shippedCatalogues()) {}

  std::string trouble() {
    try {
      link_.connect(seconds{5}, not_asked_);
    } catch (const Trouble& error) {
      return error.what();
    }
    return "";
  }
  static catalogue::ParameterAddress parameter(std::uint16_t number) {
    catalogue::ParameterAddress address;
    address.number = number;
    return address;
  }
  sim::DriveUnit& left() { return segment_->drive(0); }

  ToolConfig config_;
  sim::SimulatedSegment* segment_ = nullptr;
  ProfibusMs2Transport transport_;
  ParameterLink link_;
  std::atomic<bool> not_asked_{false};
};

class Ms2LinkThatListens : public Ms2Link {
 protected:
  Ms2LinkThatListens() : Ms2Link(", listen_first: 8") {}
};

// Longer than it waits for an answer: nothing is sent meanwhile, and nobody can answer.
TEST_F(Ms2LinkThatListens, IsWaitedFor) {
  EXPECT_EQ("", trouble());
  EXPECT_TRUE(link_.read(parameter(105)).success);
}

TEST_F(Ms2Link, ReadsAndWritesWithoutDataExchange) {
  ASSERT_EQ("", trouble());
  const ParameterAnswer read = link_.read(parameter(105));
  EXPECT_TRUE(read.success) << read.message;
  EXPECT_EQ(500, read.raw);
  EXPECT_EQ(1, read.set) << "the one in force, by the status word";
  catalogue::ParameterWrite write;
  write.value = 2.5;
  const ParameterAnswer written = writeValue(link_, parameter(102), write);
  EXPECT_TRUE(written.success) << written.message;
  EXPECT_EQ(250, left().parameters().value(102, 0));
  EXPECT_EQ(0u, left().parameters().eepromWrites());
  EXPECT_THAT(link_.finish(), IsEmpty());
  EXPECT_EQ(sim::SlaveState::kWaitParameters, segment_->station(0).state());
  EXPECT_EQ(0x0000, left().counters().last_control) << "no word ever";
  EXPECT_EQ(0u, segment_->stations().module(0).connections().open());
  EXPECT_EQ("no rule broken", segment_->referee().report());
}

// The time-out of the module watches words, and none were sent: nothing trips when the program has ended.
TEST_F(Ms2Link, ItsEndTripsNothing) {
  segment_->stations().module(0).parameters().preset(151, 0, 0, 500);
  ASSERT_EQ("", trouble());
  EXPECT_TRUE(link_.read(parameter(105)).success);
  EXPECT_THAT(link_.finish(), IsEmpty());
  segment_->run(seconds{10});
  EXPECT_EQ(0, left().inverter().faultNumber());
}

TEST_F(Ms2Link, LeavesADriveThatRunsAlone) {
  left().inverter().setLocalControl(true, 0.0);
  segment_->run(seconds{1});
  left().inverter().setLocalControl(true, 20.0);
  segment_->run(seconds{4});
  ASSERT_EQ(sim::InverterState::kOperationEnabled, left().inverter().state());
  EXPECT_THAT(trouble(), HasSubstr("drive left is not at rest"));
  segment_->run(seconds{10});
  EXPECT_DOUBLE_EQ(20.0, left().inverter().frequency());
}

// A drive whose status word is not known may be running.
TEST_F(Ms2Link, RefusesADriveThatDoesNotTellItsState) {
  left().setInverterPower(false);
  EXPECT_THAT(trouble(), HasSubstr("its status word (P741) cannot be read, so that it is not known whether it runs"));
}

}  // namespace
}  // namespace nord_driver::tools
