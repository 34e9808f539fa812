// Parameters over connections of class 2 (MS2), on a simulated segment: nothing is parameterised, nothing exchanged.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "sim/profibus/simulated_segment.h"
#include "support/map_settings.h"
#include "transport/profibus/ask_parameter.h"
#include "transport/profibus/profibus_ms2.h"

namespace nord_driver {
namespace {

using profile::ParameterOutcome;
using std::chrono::milliseconds;
using test::MapSettings;
using ::testing::HasSubstr;

/// A segment on which another master hands its token to itself.
class SegmentOfAnotherMaster final : public sim::SimulatedSegment {
 public:
  using SimulatedSegment::SimulatedSegment;
  bool waitReadable(Instant until) noexcept override {
    const Instant next = now() + milliseconds{5};
    if (until < next) return SimulatedSegment::waitReadable(until);
    run(milliseconds{5});
    token_due_ = true;
    return true;
  }
  std::size_t read(std::uint8_t* buffer, std::size_t capacity) noexcept override {
    if (!token_due_ || capacity < 3) return SimulatedSegment::read(buffer, capacity);
    token_due_ = false;
    buffer[0] = 0xDC;
    buffer[1] = buffer[2] = 0x05;
    return 3;
  }

 private:
  bool token_due_ = false;
};

/// A segment whose module takes "no order", and answers the read that follows with error 9 and the number of P741: a read
/// without an order before it (BU 2700 6.5.1.1).
class SegmentOfAModuleWithNothingToRead final : public sim::SimulatedSegment {
 public:
  using SimulatedSegment::SimulatedSegment;
  bool write(ByteView telegram) noexcept override {
    answer_.clear();
    if (telegram.size() > kReadTelegram) {  // an order, or none: eight zeros
      const auto none = fromHex("08 00 00 00 00 00 00 00 00");
      taken_back_ = std::search(telegram.begin(), telegram.end(), none.begin(), none.end()) != telegram.end();
      times_ += taken_back_ ? 1 : 0;
    }
    return SimulatedSegment::write(telegram);
  }
  std::size_t read(std::uint8_t* buffer, std::size_t capacity) noexcept override {
    const std::size_t count = SimulatedSegment::read(buffer, capacity);
    for (std::size_t i = 0; i < count; ++i) buffer[i] = changed(buffer[i]);
    return count;
  }
  int timesTakenBack() const noexcept { return times_; }

 private:
  // SD2: 68 L L 68, DA SA FC DSAP SSAP, then function, slot, index, length and data of the record, FCS, 16.
  static constexpr std::size_t kReadTelegram = 15, kFunction = 9, kData = 13, kChecksum = 21;

  std::uint8_t changed(std::uint8_t byte) noexcept {
    const std::size_t place = answer_.size();
    answer_.push_back(byte);
    if (!taken_back_ || place < kData || answer_[1] != 17 || answer_[kFunction] != 0x5E) return byte;
    if (place > kChecksum) return byte;
    const auto error = fromHex("76 CD 00 00 00 00 00 09");
    if (place == kChecksum) return static_cast<std::uint8_t>(byte + std::exchange(added_, 0));
    added_ += error[place - kData] - byte;
    return error[place - kData];
  }

  std::vector<std::uint8_t> answer_;
  int added_ = 0;  // to the sum of its bytes
  bool taken_back_ = false;
  int times_ = 0;
};

class ProfibusMs2 : public ::testing::Test {
 protected:
  /// Two inverters behind a module SK CU4-PBR.
  template <typename Segment = sim::SimulatedSegment>
  void open(int address = 3, bool serve = true, unsigned connections = 3) {
    std::vector<DriveSettings> drives;
    sim::SimConfig config;
    config.bus.as<sim::DpBusConfig>().baud_rate = 500'000;
    sim::ModuleConfig module;
    module.settings.address = static_cast<std::uint8_t>(address);
    module.settings.class2.connections = connections;
    config.bus.as<sim::DpBusConfig>().modules.push_back(module);
    for (unsigned place = 1; place <= 2; ++place) {
      const std::string name = "fi" + std::to_string(place);
      auto settings = std::make_shared<MapSettings>("~drives/" + name + "/");
      settings->set("address", address).set("series", "sk2xxe").set("pole_pairs", 2);
      settings->set("inverter", static_cast<int>(place));
      drives.push_back({name, settings});
      sim::DriveConfig drive;
      drive.name = name;
      drive.address = static_cast<std::uint8_t>(address);
      drive.device.series = sim::Series::kSk2xxe;
      drive.place = place;
      config.drives.push_back(drive);
    }
    inputs_.resize(2);
    outputs_.resize(2);
    for (auto& output : outputs_) output.control_word = 0x047F;  // what is asked for reaches nobody
    transport_ = std::make_unique<ProfibusMs2Transport>([&](const link::SerialSettings&) {
      auto segment = std::make_unique<Segment>(config);
      segment_ = segment.get();
      return segment;
    });
    if (serve) {
      EXPECT_TRUE(transport_->serveParametersOnly());
    }
    bus_.set("device", "simulated").set("slot_time", 0.0005);
    transport_->configure(bus_, drives, 100.0);
  }
  void step() {
    const Instant start = transport_->now();
    transport_->exchange(outputs_, inputs_);
    transport_->sleepUntil(start + milliseconds{10});
  }
  void run(Duration span) {
    const Instant end = transport_->now() + span;
    while (transport_->now() < end) {
      step();
      EXPECT_FALSE(transport_->pollResult()) << "nobody has asked";
    }
  }
  profile::ParameterResult ask(DriveIndex drive, std::uint16_t number,
                               profile::ParameterAction action = profile::ParameterAction::kRead,
                               std::int32_t raw = 0) {
    return askParameter(*transport_, drive, number, action, raw, 400, [this] { step(); });
  }
  sim::ModuleStation& module() { return segment_->stations().module(0); }
  std::string note() const { return transport_->note(0).text; }

  MapSettings bus_{"~bus/"};
  sim::SimulatedSegment* segment_ = nullptr;
  std::unique_ptr<ProfibusMs2Transport> transport_;
  std::vector<profile::ProcessOutput> outputs_;
  std::vector<DriveExchange> inputs_;
};

// The status words are read as parameters, and so is everything else; the module stays in WAIT_PRM, the inverters get
// no word.
TEST_F(ProfibusMs2, ParametersWithoutDataExchange) {
  open();
  run(milliseconds{1500});
  for (const DriveExchange& input : inputs_) {
    EXPECT_TRUE(input.module_answers);
    EXPECT_TRUE(input.inverter_answers);
    EXPECT_EQ(segment_->drive(0).inverter().statusWord(), input.input.status_word);
  }
  EXPECT_EQ("", note());
  EXPECT_TRUE(transport_->connected());
  const auto read = ask(1, 509);
  EXPECT_EQ(ParameterOutcome::kDone, read.outcome) << read.text.c_str();
  EXPECT_EQ(3, read.raw);
  EXPECT_EQ(ParameterOutcome::kDone, ask(0, 513, profile::ParameterAction::kWriteRam, 7).outcome);
  EXPECT_EQ(7, segment_->drive(0).parameters().value(513));
  EXPECT_EQ(0u, segment_->drive(0).parameters().eepromWrites());
  EXPECT_EQ(ParameterOutcome::kDone, ask(0, 151, profile::ParameterAction::kWriteRam, 500).outcome);
  EXPECT_EQ(500, module().parameters().value(151));
  EXPECT_EQ(sim::SlaveState::kWaitParameters, module().state());
  EXPECT_EQ(0u, module().counters().data_exchanges);
  EXPECT_EQ(0x0000, segment_->drive(0).counters().last_control);
  EXPECT_TRUE(segment_->referee().content()) << segment_->referee().report();
}

// The status word is the same parameter again and again: before each "no order" is written, and read until it is gone.
TEST_F(ProfibusMs2, StatusWordOfAModuleThatHasNothingToRead) {
  open<SegmentOfAModuleWithNothingToRead>();
  run(milliseconds{1500});
  const Instant end = transport_->now() + milliseconds{6000};
  while (transport_->now() < end) {
    run(milliseconds{10});
    ASSERT_TRUE(inputs_[0].inverter_answers) << note();
    ASSERT_EQ(segment_->drive(0).inverter().statusWord(), inputs_[0].input.status_word);
  }
  EXPECT_GT(static_cast<SegmentOfAModuleWithNothingToRead*>(segment_)->timesTakenBack(), 10);
}

TEST_F(ProfibusMs2, IdentityOfADrive) {
  open(126);
  const DriveIdentity identity = transport_->identity(1);
  EXPECT_EQ("PROFIBUS station 126, inverter 2", identity.address);
  EXPECT_EQ("DP-V1 records, MS2", identity.parameter_channel);
  EXPECT_EQ(0, identity.process_values);
  EXPECT_EQ(TimeoutOwner::kModule, identity.timeout_owner);
  EXPECT_EQ("", identity.protected_by);
}

// BU 0220 4.2.2: nobody exchanges data with a module that has its address from the factory.
TEST_F(ProfibusMs2, ModuleWithoutAnAddress) {
  open(126);
  const auto read = ask(0, 180);
  EXPECT_EQ(ParameterOutcome::kDone, read.outcome) << read.text.c_str();
  EXPECT_EQ(126, read.raw);
}

// A driver would wait for ever, or worse, believe that it moves something.
TEST_F(ProfibusMs2, IsRefusedForADriver) {
  try {
    open(3, false);
    FAIL() << "accepted";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("~transport: nord_driver/profibus_ms2 reads and writes parameters only"));
    EXPECT_THAT(error.what(), HasSubstr("expected nord_driver/profibus_dp"));
  }
}

TEST_F(ProfibusMs2, RefusesBesideAnotherMaster) {
  open<SegmentOfAnotherMaster>();
  run(milliseconds{2000});
  EXPECT_EQ(0u, transport_->counters().value(bus_counter::kTelegramsSent));
  EXPECT_THAT(transport_->busText().c_str(),
              HasSubstr("master 5 is on this segment, and its token ring is not joined"));
  EXPECT_EQ(ParameterOutcome::kOffline, ask(0, 509).outcome);
}

// The module lives on its own 24 V, the inverter behind it is off: its status word is not there, those of the others
// are.
TEST_F(ProfibusMs2, InverterIsOff) {
  open();
  segment_->drive(0).setInverterPower(false);
  run(milliseconds{1500});
  EXPECT_TRUE(inputs_[0].module_answers);
  EXPECT_FALSE(inputs_[0].inverter_answers);
  EXPECT_TRUE(inputs_[0].inverter_missing);
  EXPECT_TRUE(inputs_[1].inverter_answers);
  EXPECT_THAT(note(), HasSubstr("its status word (P741) cannot be read"));
  segment_->drive(0).setInverterPower(true);
  run(milliseconds{1500});
  EXPECT_TRUE(inputs_[0].inverter_answers);
}

TEST_F(ProfibusMs2, FailuresInWords) {
  open(3, true, 0);
  run(milliseconds{1500});
  EXPECT_FALSE(inputs_[0].inverter_answers);
  EXPECT_THAT(note(), HasSubstr("it answers RS, not activated, at access point 49"));
  const auto refused = ask(0, 509);
  EXPECT_EQ(ParameterOutcome::kNoChannel, refused.outcome);
  EXPECT_THAT(refused.text.c_str(), HasSubstr("access point 49"));
}

TEST_F(ProfibusMs2, ModuleIsOff) {
  open();
  module().setPowered(false);
  run(milliseconds{1500});
  EXPECT_EQ("it does not answer", note());
  EXPECT_FALSE(transport_->connected());
  EXPECT_EQ(ParameterOutcome::kTimeout, ask(0, 509).outcome);
  module().setPowered(true);
  run(milliseconds{1500});
  EXPECT_TRUE(inputs_[0].inverter_answers);
}

// The adapter is pulled and put back.
TEST_F(ProfibusMs2, DeviceIsLookedForAgain) {
  open();
  run(milliseconds{1500});
  segment_->setDevicePresent(false);
  run(milliseconds{100});
  EXPECT_FALSE(inputs_[0].inverter_answers);
  EXPECT_EQ("the bus device is not open", note());
  segment_->setDevicePresent(true);
  run(milliseconds{2500});
  EXPECT_TRUE(inputs_[0].inverter_answers);
}

// The module need not wait for its time-out.
TEST_F(ProfibusMs2, CloseEndsTheConnections) {
  open();
  run(milliseconds{1500});
  EXPECT_EQ(1u, module().connections().open());
  transport_->close();
  EXPECT_EQ(0u, module().connections().open());
}

}  // namespace
}  // namespace nord_driver
