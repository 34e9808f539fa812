// Who is on a simulated PROFIBUS segment.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <initializer_list>
#include <memory>
#include <utility>

#include "sim/profibus/simulated_segment.h"
#include "support/map_settings.h"
#include "transport/profibus/profibus_dp.h"

namespace nord_driver {
namespace {

using test::MapSettings;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::MatchesRegex;

const std::atomic<bool> kNotAsked{false};

/// A segment that notes what its stations were told when it is closed.
class ScannedSegment final : public sim::SimulatedSegment {
 public:
  ScannedSegment(const sim::SimConfig& config, std::vector<std::uint64_t>& exchanges)
      : SimulatedSegment(config), exchanges_(exchanges) {}
  void close() noexcept override {
    SimulatedSegment::close();
    exchanges_.clear();
    for (std::size_t i = 0; i < robot().drives().size(); ++i) exchanges_.push_back(drive(i).counters().data_exchanges);
  }

 private:
  std::vector<std::uint64_t>& exchanges_;
};

/// Every few milliseconds another master hands its token to itself.
class BusyToken final : public sim::SimulatedSegment {
 public:
  using SimulatedSegment::SimulatedSegment;
  bool waitReadable(Instant until) noexcept override {
    const Instant next = now() + std::chrono::milliseconds{5};
    if (until < next) return SimulatedSegment::waitReadable(until);
    run(std::chrono::milliseconds{5});
    due_ = true;
    return true;
  }
  std::size_t read(std::uint8_t* buffer, std::size_t capacity) noexcept override {
    if (!due_ || capacity < 3) return SimulatedSegment::read(buffer, capacity);
    due_ = false;
    buffer[0] = 0xDC;
    buffer[1] = buffer[2] = 0x05;
    return 3;
  }

 private:
  bool due_ = false;
};

/// Those at 12 and 13 are of the kind that has a type plate.
sim::SimConfig stationsAt(std::initializer_list<int> addresses) {
  sim::SimConfig config;
  config.bus.as<sim::DpBusConfig>().baud_rate = 500'000;
  for (const int address : addresses) {
    sim::DriveConfig drive;
    drive.name = "drive" + std::to_string(address);
    drive.address = static_cast<std::uint8_t>(address);
    if (address == 12 || address == 13) {
      drive.device.series = sim::Series::kSk2xxe;
      drive.place = 1;
    }
    config.drives.push_back(drive);
  }
  return config;
}

sim::SimConfig threeStations() {
  return stationsAt({3, 12, 126});
}

MapSettings bus() {
  MapSettings settings{"~bus/"};
  settings.set("device", "simulated").set("baud_rate", 500'000).set("slot_time", 0.0005);
  return settings;
}

// Both kinds of modules, and one that is not addressed yet; none of them is parameterised or told words.
TEST(ProfibusScanner, NamesTheModules) {
  std::vector<std::uint64_t> exchanges;
  ProfibusDpTransport transport{
      [&](const link::SerialSettings&) { return std::make_unique<ScannedSegment>(threeStations(), exchanges); }};
  const ScanReport report = transport.scan(bus(), kNotAsked);
  EXPECT_THAT(report.trouble, IsEmpty());
  ASSERT_EQ(4u, report.stations.size());
  EXPECT_EQ(3u, report.stations[0].number);
  EXPECT_EQ("SK TU1/2/3-PBR (7531h)", report.stations[0].module);
  EXPECT_THAT(report.stations[0].series, HasSubstr("sk5xxe"));
  EXPECT_EQ(12u, report.stations[1].number);
  EXPECT_EQ("SK CU4/TU4-PBR (0BA8h)", report.stations[1].module);
  EXPECT_THAT(report.stations[1].version, HasSubstr("NORD (manufacturer 393)")) << "its type plate";
  EXPECT_EQ(12u, report.stations[2].number) << "the inverter behind it";
  EXPECT_EQ("inverter 1", report.stations[2].module);
  EXPECT_THAT(report.stations[2].version, MatchesRegex("P707 = [0-9]+ R[0-9]+"));
  EXPECT_THAT(report.stations[2].series, MatchesRegex("P742 = [0-9]+, P743 = [0-9]+"));
  EXPECT_EQ(126u, report.stations[3].number);
  EXPECT_EQ("not addressed yet: set its address to 3 to 125", report.stations[3].note);
  EXPECT_THAT(exchanges, ::testing::ElementsAre(0, 0, 0)) << "nobody was told words";
}

TEST(ProfibusScanner, SendsNothingBesideAnotherMaster) {
  ProfibusDpTransport transport{
      [](const link::SerialSettings&) { return std::make_unique<BusyToken>(threeStations()); }};
  const ScanReport report = transport.scan(bus(), kNotAsked);
  EXPECT_EQ("master 5 was heard: nothing is sent on the bus of another master; end it first", report.trouble);
  EXPECT_THAT(report.stations, IsEmpty());
}

TEST(ProfibusScanner, EndsWhenAsked) {
  const std::atomic<bool> asked{true};
  ProfibusDpTransport transport{
      [](const link::SerialSettings&) { return std::make_unique<sim::SimulatedSegment>(threeStations()); }};
  EXPECT_EQ("ended before every address was asked", transport.scan(bus(), asked).trouble);
}

/// Calls `happens` when the first telegram of MS2 is to leave: to the resource manager, SAP 49, which has the question for the
/// type plate behind it.
class InterruptedSegment final : public sim::SimulatedSegment {
 public:
  explicit InterruptedSegment(std::function<void(sim::SimulatedSegment&)> happens,
                              const sim::SimConfig& config = threeStations())
      : SimulatedSegment(config), happens_(std::move(happens)) {}
  bool write(ByteView telegram) noexcept override {
    constexpr std::size_t kDsap = 7;
    if (telegram.size() > kDsap && telegram[0] == 0x68 && telegram[kDsap] == 49) happens_(*this);
    return SimulatedSegment::write(telegram);
  }

 private:
  std::function<void(sim::SimulatedSegment&)> happens_;
};

// All stations are known by then; what is missing are the type plates and the inverters behind them.
TEST(ProfibusScanner, SaysThatTheModulesWereNotAskedToTheEnd) {
  std::atomic<bool> asked{false};
  const auto scan = [&](const std::function<void(sim::SimulatedSegment&)>& happens) {
    ProfibusDpTransport transport{
        [&](const link::SerialSettings&) { return std::make_unique<InterruptedSegment>(happens); }};
    return transport.scan(bus(), asked);
  };
  const ScanReport gone = scan([](auto& segment) { segment.setDevicePresent(false); });
  EXPECT_EQ("simulated segment: the device is gone", gone.trouble);
  EXPECT_EQ(3u, gone.stations.size());
  const ScanReport ended = scan([&](auto&) { asked = true; });
  EXPECT_EQ("ended before every module was asked", ended.trouble);
  EXPECT_EQ(3u, ended.stations.size());
}

TEST(ProfibusScanner, TellsThatItListensForLong) {
  const ProfibusDpTransport transport;
  const auto quiet = [&](double seconds) {
    return transport.quiet(MapSettings{"~bus/", {{"device", std::string{"/dev/null"}}, {"listen_first", seconds}}});
  };
  EXPECT_EQ("listens for other masters for 8 s before it sends anything (listen_first)", quiet(8.0));
  EXPECT_EQ("", quiet(1.0));
}

// It gets the bus: no further module is asked, and the list is not taken for a whole one.
TEST(ProfibusScanner, AsksNoFurtherModuleBesideADriverThatBegins) {
  constexpr std::uint8_t kOfMaster5[] = {0x10, 9, 5, 0x49, 0x57, 0x16};
  int asked = 0;
  const auto driver_begins = [&](sim::SimulatedSegment& segment) {
    ++asked;
    segment.foreign({kOfMaster5, sizeof kOfMaster5});
  };
  ProfibusDpTransport transport{[&](const link::SerialSettings&) {
    return std::make_unique<InterruptedSegment>(driver_begins, stationsAt({3, 12, 13}));
  }};
  const ScanReport report = transport.scan(bus(), kNotAsked);
  EXPECT_EQ("master 5 was heard: nothing is sent on the bus of another master; end it first", report.trouble);
  EXPECT_EQ(3u, report.stations.size());
  EXPECT_EQ(1, asked);
}

}  // namespace
}  // namespace nord_driver
