// The class-2 master against the simulated module: both written on their own, and a referee between them.
#include <gtest/gtest.h>

#include "profibus/class2_master.h"
#include "profibus/identification.h"
#include "profibus/record_wire.h"
#include "sim/profibus/simulated_segment.h"

namespace nord_driver::profibus {
namespace {

using namespace std::chrono_literals;

sim::SimConfig modules(const std::vector<int>& addresses, const sim::Class2Settings& class2 = {}) {
  sim::SimConfig config;
  config.bus.as<sim::DpBusConfig>().baud_rate = 500'000;
  for (const int address : addresses) {
    sim::DriveConfig drive;
    drive.name = "fi" + std::to_string(address);
    drive.address = static_cast<std::uint8_t>(address);
    drive.device.series = sim::Series::kSk2xxe;
    drive.place = 1;
    config.drives.push_back(drive);
    sim::ModuleConfig module;
    module.settings.address = drive.address;
    module.settings.class2 = class2;
    config.bus.as<sim::DpBusConfig>().modules.push_back(module);
  }
  return config;
}

class Class2Run {
 public:
  explicit Class2Run(const std::vector<int>& addresses, const sim::Class2Settings& class2 = {},
                     const Class2Times& times = {})
      : segment{modules(addresses, class2)},
        master{BusParameters::forBaudRate(BaudRate{500'000}, station(1)), stations(addresses), times} {
    segment.open();
    segment.run(500ms);  // the charging relays have engaged
    master.restart(segment.now());
  }

  void run(Duration span) {
    const Instant end = segment.now() + span;
    std::uint8_t buffer[256];
    while (segment.now() < end) {
      if (!master.wantsBus(segment.now())) {
        const Instant due = master.nextDeadline().value_or(end);
        segment.run(std::max(Duration{1}, std::min(due, end) - segment.now()));
        continue;
      }
      const ByteView telegram = master.pollTransmit(segment.now());
      if (!telegram.empty()) {
        segment.write(telegram);
        continue;
      }
      const auto deadline = master.nextDeadline();
      ASSERT_TRUE(deadline);
      if (segment.waitReadable(*deadline)) {
        const std::size_t count = segment.read(buffer, sizeof buffer);
        master.handleBytes({buffer, count}, segment.now());
      }
      if (segment.now() >= *deadline) master.handleTimeout(segment.now());
    }
  }
  RecordResult record(const RecordRequest& request, std::size_t station = 0) {
    EXPECT_TRUE(master.submitRecord(station, request));
    for (int i = 0; i < 5000; ++i) {
      if (const auto result = master.pollRecord()) return *result;
      run(1ms);
    }
    ADD_FAILURE() << "no result";
    return {};
  }
  std::string identity(std::uint8_t number) {
    IdentificationReader reader{number};
    while (const auto request = reader.pollRecord()) reader.handleRecord(record(*request));
    const auto plate = reader.typePlate();
    return plate ? describe(*plate).str() : reader.trouble().str();
  }
  void expectFairPlay() { EXPECT_TRUE(segment.referee().content()) << segment.referee().report(); }

  sim::SimulatedSegment segment;
  Class2Master master;

 private:
  static std::vector<StationAddress> stations(const std::vector<int>& addresses) {
    std::vector<StationAddress> found;
    for (const int address : addresses) found.push_back(station(address));
    return found;
  }
};

/// P102 of the first inverter, set 1: PKE 644Eh is order 6, number 1102.
RecordRequest order(const char* hex) {
  RecordRequest request = writeOrder();
  request.data.clear();
  for (const std::uint8_t byte : fromHex(hex)) request.data.push_back(byte);
  return request;
}

// A parameter is read and written without anybody parameterising the module or exchanging data with it.
TEST(Class2Simulated, ParametersWithoutDataExchange) {
  Class2Run run{{8}};
  EXPECT_EQ(RecordOutcome::kDone, run.record(order("15 E5 00 00 00 00 00 00")).outcome);
  const RecordResult read = run.record(readAnswer());
  EXPECT_EQ("15 E5 00 00 00 00 00 03", toHex(read.data)) << "P509 of an SK 2xxE";
  EXPECT_EQ(sim::SlaveState::kWaitParameters, run.segment.station(0).state());
  EXPECT_EQ(1u, run.segment.stations().module(0).connections().open());
  run.master.close();
  run.run(10ms);
  EXPECT_EQ(0u, run.segment.stations().module(0).connections().open());
  run.expectFairPlay();
}

// Address 126: nobody can exchange data with it, its parameters can be read.
TEST(Class2Simulated, ModuleThatHasNoAddressYet) {
  Class2Run run{{126}};
  RecordRequest module = order("14 9C 00 00 00 00 00 00");  // P180, its address
  module.index = 100;
  EXPECT_EQ(RecordOutcome::kDone, run.record(module).outcome);
  RecordRequest answer = readAnswer();
  answer.index = 100;
  EXPECT_EQ("14 9C 00 00 00 00 00 7E", toHex(run.record(answer).data));
  run.expectFairPlay();
}

// A quiet connection lives by its signs of life, however long the pause is.
TEST(Class2Simulated, StaysOpenInPauses) {
  Class2Run run{{8}};
  run.record(order("15 E5 00 00 00 00 00 00"));
  run.run(60s);
  EXPECT_EQ(1u, run.segment.stations().module(0).connections().open());
  EXPECT_TRUE(run.master.isConnected(0));
  EXPECT_EQ("15 E5 00 00 00 00 00 03", toHex(run.record(readAnswer()).data)) << "still the same connection";
  run.expectFairPlay();
}

TEST(Class2Simulated, SeveralStationsTakeTurns) {
  Class2Run run{{8, 9, 126}};
  for (std::size_t i = 0; i < 3; ++i) ASSERT_TRUE(run.master.submitRecord(i, order("15 E5 00 00 00 00 00 00")));
  run.run(20ms);
  unsigned done = 0;
  while (const auto result = run.master.pollRecord()) done += result->outcome == RecordOutcome::kDone ? 1u : 0u;
  EXPECT_EQ(3u, done);
  run.expectFairPlay();
}

TEST(Class2Simulated, TypePlate) {
  Class2Run run{{8}};
  EXPECT_EQ(
      "NORD (manufacturer 393), order number SK CU4-PBR, serial number SIMULATED-0001, hardware 2, software V1.3.0",
      run.identity(0));
  EXPECT_EQ("it has no I&M1 record: DP-V1 error B0, invalid index", run.identity(1));
  run.expectFairPlay();
}

TEST(Class2Simulated, RefusedInWords) {
  sim::Class2Settings none;
  none.connections = 0;
  Class2Run without{{8}, none};
  EXPECT_EQ(RecordOutcome::kNotActivated, without.record(readAnswer()).outcome);
  EXPECT_NE(std::string::npos, without.master.trouble(0).str().find("access point 49"))
      << without.master.trouble(0).c_str();

  Class2Run absent{{8}};
  absent.segment.stations().module(0).setPowered(false);
  EXPECT_EQ(RecordOutcome::kNoAnswer, absent.record(readAnswer()).outcome);

  sim::Class2Settings mute;
  mute.mute = true;
  Class2Run slow{{8}, mute};
  EXPECT_EQ(RecordOutcome::kTimedOut, slow.record(readAnswer()).outcome);
  slow.run(10ms);
  EXPECT_EQ(0u, slow.segment.stations().module(0).connections().open()) << "it was ended";
}

// A short Send_Timeout is raised to what the module wants.
TEST(Class2Simulated, ShortSendTimeout) {
  Class2Times times;
  times.send_timeout = 50ms;
  Class2Run run{{8}, {}, times};
  EXPECT_EQ(RecordOutcome::kDone, run.record(order("15 E5 00 00 00 00 00 00")).outcome);
  run.expectFairPlay();
}

// Powered off in between: the connection is gone, and another is opened by the next record.
TEST(Class2Simulated, ModuleSwitchedOffAndOn) {
  Class2Run run{{8}};
  run.record(order("15 E5 00 00 00 00 00 00"));
  run.segment.stations().module(0).setPowered(false);
  EXPECT_EQ(RecordOutcome::kNoAnswer, run.record(readAnswer()).outcome);
  run.segment.stations().module(0).setPowered(true);
  EXPECT_EQ("70 00 00 00 00 00 00 09", toHex(run.record(readAnswer()).data)) << "nothing was written before (error 9)";
}

// Answers that are lost on the way come by a repetition with the same frame count.
TEST(Class2Simulated, LostAnswers) {
  Class2Run run{{8}};
  for (int i = 0; i < 20; ++i) {
    run.segment.loseAnswers(1);
    EXPECT_EQ(RecordOutcome::kDone, run.record(order("15 E5 00 00 00 00 00 00")).outcome) << i;
    run.segment.loseRequests(1);
    EXPECT_EQ("15 E5 00 00 00 00 00 03", toHex(run.record(readAnswer()).data)) << i;
  }
  run.expectFairPlay();
}

}  // namespace
}  // namespace nord_driver::profibus
