// Parameters by Compact PCP against the simulated gateway, in simulated time.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/interbus/register_gateway.h"
#include "transport/interbus/interbus_parameters.h"
#include "transport/interbus/pcp_refusal.h"

namespace nord_driver {
namespace {

using profile::ParameterAction;
using profile::ParameterOutcome;
using profile::ParameterReason;
using profile::ParameterRequest;
using profile::ParameterResult;
using profile::ParameterShape;
using std::chrono::milliseconds;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr std::uint16_t kInvoke = 500, kResult = 600;

// `by_table`: the first drive has arrays without sets by the table.
sim::SimConfig ringOfTwo(bool swapped, bool by_table) {
  sim::IbsBusConfig bus;
  bus.output_address = 100;
  bus.swapped = swapped;
  bus.pcp = sim::IbsPcp{kInvoke, kResult, 2, true};
  sim::SimConfig config;
  config.bus = bus;
  for (std::uint8_t place = 1; place <= 2; ++place) {
    sim::DriveConfig drive;
    drive.name = "drive" + std::to_string(place - 1);
    drive.address = place;
    sim::IbsDriveConfig settings;
    settings.array_sub_by_table = by_table && place == 1;
    drive.bus = settings;
    config.drives.push_back(drive);
  }
  return config;
}

PcpMap mapOf(bool swapped, bool initiate = true) {
  PcpMap map;
  map.invoke_address = kInvoke;
  map.result_address = kResult;
  map.swapped = swapped;
  map.initiate = initiate;
  return map;
}

/// One cycle each 10 ms; an order is carried out in the same one.
class Pcp : public ::testing::Test {
 protected:
  explicit Pcp(bool swapped = false, bool initiate = true, bool by_table = false)
      : config(ringOfTwo(swapped, by_table)), parameters(mapOf(swapped, initiate), {{2, by_table}, {3}}) {
    sim.ring.advance(now);
    cycles(100);
  }

  static ParameterRequest read(std::uint16_t number, ParameterShape shape = ParameterShape::kPlain,
                               std::uint8_t index = 1) {
    ParameterRequest request;
    request.id = 7;
    request.number = number;
    request.shape = shape;
    request.index = index;
    return request;
  }
  static ParameterRequest write(std::uint16_t number, std::int32_t raw, ParameterShape shape = ParameterShape::kPlain) {
    ParameterRequest request = read(number, shape);
    request.action = ParameterAction::kWritePersistent;
    request.raw = raw;
    return request;
  }

  link::RegisterAnswer carryOut(const link::RegisterOrder& order) {
    std::vector<std::uint8_t> bytes{0, 1, 0, 0, 0, 0, 1, static_cast<std::uint8_t>(order.write ? 16 : 3)};
    const auto put = [&](unsigned word) {
      bytes.push_back(static_cast<std::uint8_t>(word >> 8));
      bytes.push_back(static_cast<std::uint8_t>(word & 0xFFu));
    };
    put(order.registers.first);
    put(order.registers.count);
    if (order.write) {
      bytes.push_back(static_cast<std::uint8_t>(2 * order.registers.count));
      for (std::size_t i = 0; i < order.registers.count; ++i) put(order.values[i]);
    }
    bytes[5] = static_cast<std::uint8_t>(bytes.size() - 6);
    const sim::ModbusBytes answer = sim.gateway.handle(bytes, now);
    link::RegisterAnswer result;
    result.good = answer.size() > 8 && (answer[7] & 0x80u) == 0;
    if (!result.good) result.text = "192.168.0.10:502 refuses it";
    for (std::size_t i = 0; !order.write && result.good && i < order.registers.count; ++i) {
      result.values[i] = static_cast<Word>(answer[9 + 2 * i] << 8 | answer[10 + 2 * i]);
    }
    return result;
  }
  void cycle() {
    now += milliseconds{10};
    sim.ring.advance(now);
    sim.gateway.advance(now);
    const auto order = parameters.pollOrder(now);
    if (!order) return;
    ++orders;
    const bool invokes = order->write && order->values[0] != 0;
    if (invokes && busy > 0) {
      --busy;
      link::RegisterAnswer refused;
      refused.not_taken = true;
      refused.text = "192.168.0.10:502 refuses it with exception 6";
      return parameters.handleAnswer(refused);
    }
    if (!lose) parameters.handleAnswer(carryOut(*order));
  }
  void cycles(int count) {
    for (int i = 0; i < count; ++i) cycle();
  }
  /// The result of one access, which has 5 s.
  ParameterResult ask(const ParameterRequest& request, std::size_t drive = 0) {
    EXPECT_TRUE(parameters.submit(drive, request));
    const Instant begin = now;
    while (now < begin + std::chrono::seconds{5}) {
      if (const auto result = parameters.pollResult(drive)) {
        taken = now - begin;
        return *result;
      }
      cycle();
    }
    ADD_FAILURE() << "no result";
    return {};
  }

  struct Simulator {
    explicit Simulator(const sim::SimConfig& config)
        : robot(config), ring(robot), gateway(config.bus.as<sim::IbsBusConfig>(), ring) {}
    sim::RobotSim robot;
    sim::IbsRing ring;
    sim::RegisterGateway gateway;
  };

  Instant now{std::chrono::hours{1}};
  sim::SimConfig config;
  Simulator sim{config};
  InterbusParameters parameters;
  int orders = 0;
  int busy = 0;       // so many invocations more are refused
  bool lose = false;  // orders are not answered any more
  Duration taken{};
};

class SwappedPcp : public Pcp {
 protected:
  SwappedPcp() : Pcp(true) {}
};
class PcpWithoutInitiate : public Pcp {
 protected:
  PcpWithoutInitiate() : Pcp(false, false) {}
};
class PcpByTable : public Pcp {
 protected:
  PcpByTable() : Pcp(false, true, true) {}
};

TEST_F(Pcp, ReadsAndWrites) {
  const ParameterResult p105 = ask(read(105, ParameterShape::kPerSet));
  EXPECT_EQ(ParameterOutcome::kDone, p105.outcome) << p105.text.c_str();
  EXPECT_EQ(500, p105.raw);
  EXPECT_EQ(7u, p105.id);
  EXPECT_LE(taken, milliseconds{300});
  ParameterRequest set3 = write(102, 1000, ParameterShape::kPerSet);
  set3.parameter_set = 3;
  EXPECT_EQ(ParameterOutcome::kDone, ask(set3).outcome);
  EXPECT_EQ(1000, sim.robot.drive(0).parameters().value(102, 2));
  set3.action = ParameterAction::kRead;
  EXPECT_EQ(1000, ask(set3).raw);
  ParameterRequest wide = write(613, 0x12345, ParameterShape::kArray);
  wide.double_word = true;
  EXPECT_EQ(ParameterOutcome::kDone, ask(wide).outcome);
  wide.action = ParameterAction::kRead;
  EXPECT_EQ(0x12345, ask(wide).raw);
}

TEST_F(SwappedPcp, BytesAreTurnedInBothBlocks) {
  EXPECT_EQ(500, ask(read(105, ParameterShape::kPerSet)).raw);
}

TEST_F(PcpWithoutInitiate, AGatewayThatKeepsNoConnectionsRefuses) {
  const ParameterResult result = ask(read(105, ParameterShape::kPerSet));
  EXPECT_EQ(ParameterOutcome::kRefused, result.outcome);
  EXPECT_EQ(ParameterReason::kNotNow, result.reason);
  EXPECT_THAT(result.text.str(), StartsWith("PCP error 1/0"));
}

TEST_F(Pcp, EveryRefusalIsNamed) {
  struct {
    ParameterRequest request;
    ParameterReason reason;
    const char* text;
  } const rows[] = {
      {read(999), ParameterReason::kNoSuchParameter,
       "PCP error 6/7 (additional code 0000h), the inverter has no parameter of this number"},
      {write(700, 1, ParameterShape::kArray), ParameterReason::kReadOnly, "PCP error 6/3"},
      {write(507, 5), ParameterReason::kOutOfLimits,
       "PCP error 8/0 (additional code 0031h), the value is above the upper limit"},
      {write(507, 0), ParameterReason::kOutOfLimits, "PCP error 8/0 (additional code 0032h)"},
      {read(701, ParameterShape::kArray, 9), ParameterReason::kNoSuchElement, "PCP error 6/5 (additional code 0011h)"},
      {write(513, 1, ParameterShape::kPerSet), ParameterReason::kNotIndexed, "PCP error 6/5"},
  };
  for (const auto& row : rows) {
    const ParameterResult result = ask(row.request);
    EXPECT_EQ(ParameterOutcome::kRefused, result.outcome) << row.text;
    EXPECT_EQ(row.reason, result.reason) << result.text.c_str();
    EXPECT_THAT(result.text.str(), StartsWith(row.text));
  }
  ParameterRequest ram = write(105, 400);
  ram.action = ParameterAction::kWriteRam;
  EXPECT_EQ(ParameterReason::kNotSupported, ask(ram).reason);
}

// BU 0060 p. 54 and p. 61 contradict each other: the second element of an array without sets is 2, or 5. The drives beside
// it keep theirs, and so does what has sets.
TEST_F(PcpByTable, TheSecondElementOfAnArrayHasSubIndexFive) {
  for (std::size_t drive = 0; drive < 2; ++drive) {
    sim.robot.drive(drive).parameters().preset(613, 0, 1, 77);
    const ParameterResult second = ask(read(613, ParameterShape::kArray, 2), drive);
    EXPECT_EQ(77, second.raw) << drive << second.text.c_str();
    EXPECT_EQ(500, ask(read(105, ParameterShape::kPerSet), drive).raw) << drive;
  }
  EXPECT_EQ(ParameterReason::kNoSuchElement, ask(read(613, ParameterShape::kArray, 65)).reason)
      << "no sub-index is 257";
  parameters = InterbusParameters{mapOf(false), {{2}, {3}}};
  const ParameterResult by_element = ask(read(613, ParameterShape::kArray, 2));
  EXPECT_EQ(ParameterReason::kNoSuchElement, by_element.reason) << by_element.text.c_str();
}

// A parameter without sets may be asked for with one (BU 0020 8).
TEST_F(Pcp, AReadFallsBackToThePlainParameter) {
  const ParameterResult result = ask(read(513, ParameterShape::kPerSet));
  EXPECT_EQ(ParameterOutcome::kDone, result.outcome) << result.text.c_str();
}

TEST_F(Pcp, BothDrivesHaveTheirTurns) {
  sim.robot.drive(1).parameters().preset(105, 0, 0, 600);
  ParameterRequest request = read(105, ParameterShape::kPerSet);
  for (int i = 0; i < 4; ++i) {
    EXPECT_TRUE(parameters.submit(0, request));
    EXPECT_TRUE(parameters.submit(1, request));
  }
  int first = 0, second = 0;
  for (int i = 0; i < 400 && (first < 4 || second < 4); ++i) {
    cycle();
    if (const auto result = parameters.pollResult(0)) {
      EXPECT_EQ(500, result->raw);
      ++first;
    }
    if (const auto result = parameters.pollResult(1)) {
      EXPECT_EQ(600, result->raw);
      ++second;
    }
    EXPECT_LE(std::abs(first - second), 1);
  }
  EXPECT_EQ(4, first);
  EXPECT_EQ(4, second);
}

TEST_F(Pcp, NothingIsAskedWithoutARequest) {
  ask(read(105, ParameterShape::kPerSet));
  cycles(10);
  const int before = orders;
  cycles(100);
  EXPECT_EQ(before, orders);
}

TEST_F(Pcp, AnInverterThatDoesNotAnswerRunsIntoTheTimeOut) {
  ask(read(105, ParameterShape::kPerSet));
  sim::ParameterSwitches silent;
  silent.silent = true;
  sim.robot.drive(0).setParameterSwitches(silent);
  const ParameterResult result = ask(read(105, ParameterShape::kPerSet));
  EXPECT_EQ(ParameterOutcome::kTimeout, result.outcome);
  EXPECT_EQ("PCP service 0081h was not confirmed within 2.0 s (communication reference 2)", result.text.str());
  EXPECT_NEAR(2.0, toSeconds(taken), 0.05);
  sim.robot.drive(0).setParameterSwitches({});
  EXPECT_EQ(ParameterOutcome::kDone, ask(read(105, ParameterShape::kPerSet)).outcome);
}

// A connection over which nothing comes back any more.
TEST_F(Pcp, OrdersThatAreLostEndWithTheTimeOut) {
  lose = true;
  EXPECT_EQ(ParameterOutcome::kTimeout, ask(read(105, ParameterShape::kPerSet)).outcome);
  lose = false;
  EXPECT_EQ(ParameterOutcome::kDone, ask(read(105, ParameterShape::kPerSet)).outcome);
}

TEST_F(Pcp, RegistersThatAreNotThereAreNamedWithTheGatewaysWords) {
  PcpMap map = mapOf(false);
  map.invoke_address = 900;
  parameters = InterbusParameters{map, {{2}, {3}}};
  const ParameterResult result = ask(read(105, ParameterShape::kPerSet));
  EXPECT_EQ(ParameterOutcome::kTimeout, result.outcome);
  EXPECT_EQ("192.168.0.10:502 refuses it", result.text.str());
}

TEST_F(Pcp, AConnectionThatIsRefusedIsNamed) {
  parameters = InterbusParameters{mapOf(false), {{9}, {3}}};
  const ParameterResult result = ask(read(105, ParameterShape::kPerSet));
  EXPECT_EQ(ParameterOutcome::kRefused, result.outcome);
  EXPECT_TRUE(mayPass(result.reason));
  EXPECT_THAT(result.text.str(),
              StartsWith("its PCP connection (communication reference 9) was refused: PCP error 1/0"));
}

// The connection is made anew by itself after the ring stood.
TEST_F(Pcp, AfterAStopOfTheRingTheConnectionIsInitiatedAgain) {
  ask(read(105, ParameterShape::kPerSet));
  sim.ring.setCut(true);
  parameters.handleOffline(0);
  cycles(20);
  sim.ring.setCut(false);
  cycles(50);
  const ParameterResult result = ask(read(105, ParameterShape::kPerSet));
  EXPECT_EQ(ParameterOutcome::kDone, result.outcome) << result.text.c_str();
}

// The answer of the one that has ended belongs to no other.
TEST_F(Pcp, ADriveThatGoesOfflineEndsItsRequestsAtOnce) {
  ask(read(105, ParameterShape::kPerSet));
  for (int at = 0; at < 12; ++at) {
    EXPECT_TRUE(parameters.submit(0, read(105, ParameterShape::kPerSet)));
    cycles(at);
    const auto order = parameters.pollOrder(now);
    const bool ended = parameters.pollResult(0).has_value();
    parameters.handleOffline(0);
    if (order) parameters.handleAnswer(carryOut(*order));
    if (!ended) {
      const auto result = parameters.pollResult(0);
      ASSERT_TRUE(result);
      EXPECT_EQ(ParameterOutcome::kOffline, result->outcome);
    }
    const ParameterResult other = ask(read(102, ParameterShape::kPerSet), 1);
    EXPECT_EQ(ParameterOutcome::kDone, other.outcome) << at << " " << other.text.c_str();
    EXPECT_EQ(sim.robot.drive(1).parameters().value(102), other.raw);
  }
}

// "Server device busy": what was not carried out is asked again (MODBUS Application Protocol V1.1b3, 7).
TEST_F(Pcp, ABusyGatewayIsAskedAgain) {
  busy = 3;
  const ParameterResult result = ask(read(105, ParameterShape::kPerSet));
  EXPECT_EQ(ParameterOutcome::kDone, result.outcome) << result.text.c_str();
  EXPECT_EQ(0, busy);
  EXPECT_LT(taken, milliseconds{500});
  busy = 1;
  EXPECT_EQ(ParameterOutcome::kDone, ask(write(102, 150, ParameterShape::kPerSet)).outcome);
  EXPECT_EQ(150, sim.robot.drive(0).parameters().value(102));
}

TEST(PcpRefusal, ReasonsTheDriverActsOn) {
  ParameterRequest request;
  const auto reason = [&](unsigned error_class, unsigned code, unsigned additional) {
    return reasonOfPcp({static_cast<std::uint8_t>(error_class), static_cast<std::uint8_t>(code),
                        static_cast<std::uint16_t>(additional)},
                       request);
  };
  EXPECT_EQ(ParameterReason::kNotNow, reason(1, 1, 0));
  EXPECT_EQ(ParameterReason::kDeviceFailure, reason(6, 2, 0));
  EXPECT_EQ(ParameterReason::kWrongType, reason(6, 5, 0x12));
  EXPECT_EQ(ParameterReason::kWrongType, reason(6, 8, 0));
  EXPECT_EQ(ParameterReason::kOther, reason(6, 5, 0x10));
  EXPECT_EQ(ParameterReason::kNoRight, reason(8, 0, 0x21));
  EXPECT_EQ(ParameterReason::kNotNow, reason(8, 0, 0x22));
  EXPECT_EQ(ParameterReason::kOutOfLimits, reason(8, 0, 0x36));
  EXPECT_EQ(ParameterReason::kOther, reason(8, 1, 0x31));
  EXPECT_EQ(ParameterReason::kOther, reason(9, 0, 0));
}

}  // namespace
}  // namespace nord_driver
