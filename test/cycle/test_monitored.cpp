// The parameters of drives/<name>/monitor in the bus cycle: in the pauses of the parameter channel, after everybody else.
#include <gtest/gtest.h>

#include <algorithm>

#include "cycle/cycle_bench.h"

namespace nord_driver::cycle {
namespace {

constexpr std::uint16_t kCurrent = 719;

CycleConfig monitoring(DriveIndex drive) {
  CycleConfig config = CycleBench::config();
  profile::ParameterRequest request;
  request.number = kCurrent;
  config.drives[drive].monitor = {request};
  return config;
}

std::size_t asked(const ScriptedTransport& transport, std::uint16_t number) {
  return static_cast<std::size_t>(std::count_if(
      transport.submitted.begin(), transport.submitted.end(),
      [number](const ScriptedTransport::Submitted& submitted) { return submitted.request.number == number; }));
}

Request reading(std::uint16_t number) {
  Request request;
  request.kind = RequestKind::kReadParameter;
  request.drive = CycleBench::kLeft;
  request.parameter.number = number;
  return request;
}

TEST(Monitored, StandsInThePictureOfItsDrive) {
  CycleBench bench{monitoring(CycleBench::kLeft)};
  bench.transport.parameters[kCurrent] = 17;
  bench.run(54);
  ASSERT_EQ(1u, bench.snapshot().drives[CycleBench::kLeft].monitored.size());
  EXPECT_EQ(MonitoredValue::State::kKnown, bench.snapshot().drives[CycleBench::kLeft].monitored[0].state);
  EXPECT_EQ(17, bench.snapshot().drives[CycleBench::kLeft].monitored[0].raw);
  EXPECT_TRUE(bench.snapshot().drives[CycleBench::kRight].monitored.empty());
  bench.transport.parameters[kCurrent] = 18;
  bench.run(110);
  EXPECT_EQ(18, bench.snapshot().drives[CycleBench::kLeft].monitored[0].raw);
}

// The driver's own questions are all answered before the first one of this kind is put.
TEST(Monitored, ComesAfterWhatTheDriverReadsForItself) {
  CycleBench bench{monitoring(CycleBench::kLeft)};
  bench.transport.hold_answers = true;
  int answered = 0;
  for (; answered < 500 && asked(bench.transport, kCurrent) == 0; ++answered) {
    if (!bench.transport.submitted.empty()) bench.transport.answerFirst();
    bench.step();
  }
  EXPECT_GT(answered, 20);
  EXPECT_TRUE(bench.snapshot().drives[CycleBench::kLeft].device.complete);
  EXPECT_EQ(1u, asked(bench.transport, kCurrent));
}

TEST(Monitored, WaitsWhileAnyOtherQuestionIsUnderWay) {
  CycleBench bench{monitoring(CycleBench::kLeft)};
  bench.transport.parameters[kCurrent] = 17;
  bench.run(200);
  bench.transport.hold_answers = true;
  Request request = reading(102);
  request.id = 1;
  request.patience = std::chrono::seconds{30};
  ASSERT_TRUE(bench.ports.submit(request));
  bench.run(300);
  EXPECT_EQ(1u, asked(bench.transport, 102));
  EXPECT_EQ(0u, asked(bench.transport, kCurrent)) << "for three seconds";
  bench.transport.answerFirst();
  bench.run(5);
  EXPECT_EQ(1u, asked(bench.transport, kCurrent));
}

// One at most is under way, and it keeps nobody else's from being put.
TEST(Monitored, KeepsNobodyElseWaiting) {
  CycleBench bench{monitoring(CycleBench::kLeft)};
  bench.transport.parameters[kCurrent] = 17;
  bench.run(200);
  bench.transport.hold_answers = true;
  bench.run(300);
  ASSERT_EQ(1u, asked(bench.transport, kCurrent));
  Request request = reading(102);
  request.id = 1;
  request.patience = std::chrono::seconds{30};
  ASSERT_TRUE(bench.ports.submit(request));
  bench.run(2);
  EXPECT_EQ(1u, asked(bench.transport, 102));
}

TEST(Monitored, AsksNothingOfADriveThatIsAway) {
  CycleBench bench{monitoring(CycleBench::kLeft)};
  bench.transport.parameters[kCurrent] = 17;
  bench.run(50);
  bench.transport.inverters[CycleBench::kLeft].silent = true;
  bench.run(20);
  bench.transport.hold_answers = true;
  bench.run(300);
  EXPECT_EQ(0u, asked(bench.transport, kCurrent));
  EXPECT_EQ(MonitoredValue::State::kNotRead, bench.snapshot().drives[CycleBench::kLeft].monitored[0].state);
}

}  // namespace
}  // namespace nord_driver::cycle
