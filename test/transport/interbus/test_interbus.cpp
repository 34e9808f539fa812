// The InterBus transport on a gateway in simulated time: words, silence, and that no cycle waits for the network.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "transport/interbus/fake_gateway.h"
#include "transport/interbus/interbus.h"
#include "transport/interbus/interbus_settings.h"

namespace nord_driver {
namespace {

using profile::ProcessInput;
using profile::ProcessOutput;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::seconds;
using test::FakeGateway;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

constexpr milliseconds kPeriod{10};

/// Two drives a hundred times a second.
class OnAGateway : public ::testing::Test {
 protected:
  explicit OnAGateway(std::size_t drives = 2) : settings{drives} {
    gateway.ring = [this](const RegisterImage&) { return words; };
    words.resize(8);
    words[0] = words[2] = 0x0B31;
  }
  void start() {
    transport.configure(settings.bus, settings.drives, 100.0);
    transport.setDriveTimeout(milliseconds{50});
    outputs.resize(settings.drives.size());
    inputs.resize(settings.drives.size());
  }
  /// One cycle; how long its exchange took.
  Duration cycle() {
    const Instant begin = transport.now();
    transport.exchange(outputs, inputs);
    const Duration taken = transport.now() - begin;
    transport.sleepUntil(begin + kPeriod);
    return taken;
  }
  void cycles(int count) {
    for (int i = 0; i < count; ++i) cycle();
  }

  test::InterbusSettings settings;
  FakeGateway gateway;
  RegisterImage words;  // what the ring answers
  InterbusTransport transport{
      [this](const link::ModbusSettings&) { return std::make_unique<test::FakeRegisterLink>(gateway); }};
  std::vector<ProcessOutput> outputs;
  std::vector<DriveExchange> inputs;
};

// --- Words ---

// BU 0070 7.1 and 7.2: 0B70, 047E, 0B31, 047F 2000, 0F37.
TEST_F(OnAGateway, CarriesTheTelegramsOfTheManual) {
  start();
  words[0] = 0x0B70;
  cycle();
  EXPECT_EQ((ProcessInput{0x0B70, {}}), inputs[0].input);
  EXPECT_EQ((RegisterImage{0, 0, 0, 0}), gateway.given.back().outputs);
  outputs[0] = {0x047E, {}};
  words[0] = 0x0B31;
  cycle();
  EXPECT_EQ((RegisterImage{0x047E, 0, 0, 0}), gateway.given.back().outputs);
  EXPECT_EQ((ProcessInput{0x0B31, {}}), inputs[0].input);
  outputs[0] = {0x047F, {0x2000, 0, 0}};
  words[0] = 0x0F37;
  words[1] = 0x2000;
  cycle();
  EXPECT_EQ((RegisterImage{0x047F, 0x2000, 0, 0}), gateway.given.back().outputs);
  EXPECT_EQ((ProcessInput{0x0F37, {0x2000, 0, 0}}), inputs[0].input);
  EXPECT_TRUE(inputs[0].inverter_answers && inputs[1].inverter_answers);
}

// SK 700E: control word, SW1, SW3, SW2 (BU 0070 4.2.2); told in the manual's order.
TEST_F(OnAGateway, PpoType2HasThreeValuesInTheOrderOfTheSeries) {
  settings.drive(0).set("series", "sk700e").set("ppo_type", 2);
  start();
  words = {0x0B37, 0x1111, 0x3333, 0x2222, 0x0B31, 0x4444};
  outputs[0] = {0x047F, {1, 2, 3}};
  outputs[1] = {0x047E, {-4, 5, 6}};
  cycle();
  EXPECT_EQ((RegisterImage{0x047F, 1, 3, 2, 0x047E, 0xFFFC}), gateway.given.back().outputs);
  EXPECT_EQ((ProcessInput{0x0B37, {0x1111, 0x2222, 0x3333}}), inputs[0].input);
  EXPECT_EQ((ProcessInput{0x0B31, {0x4444, 0, 0}}), inputs[1].input);
  EXPECT_EQ(3, transport.identity(0).process_values);
  EXPECT_EQ(1, transport.identity(1).process_values);
}

// 50 % of 50 Hz at two pole pairs are 750 rpm; no bit 10, setpoint reached in bit 10, remote in bit 9 (BU 0070 6.4.2).
TEST_F(OnAGateway, DrivecomHasWordsAndSpeedsOfItsOwn) {
  settings.drive(0).set("profile", "drivecom");
  start();
  words[0] = 0x0637;
  words[1] = 750;
  cycles(2);  // the first one looks
  EXPECT_EQ((RegisterImage{0x007E, 0, 0, 0}), gateway.given.back().outputs) << "0000 would block the voltage";
  outputs[0] = outputs[1] = {0x047F, {0x2000, 0, 0}};
  cycle();
  EXPECT_EQ((RegisterImage{0x007F, 750, 0x047F, 0x2000}), gateway.given.back().outputs);
  EXPECT_EQ((ProcessInput{0x0B37, {0x2000, 0, 0}}), inputs[0].input);
  EXPECT_EQ("InterBus position 1, DRIVECOM 21", transport.identity(0).address);
}

TEST_F(OnAGateway, BytesMayBeSwapped) {
  settings.bus.set("word_order", "swapped");
  start();
  words[0] = 0x310B;
  outputs[0] = {0x047E, {}};
  cycle();
  EXPECT_EQ(0x7E04, gateway.given.back().outputs[0]);
  EXPECT_EQ(0x0B31, inputs[0].input.status_word);
}

// --- Who answers ---

// An inverter that is off behind a module with 24 V, or a ring that stands unseen: silence, and nobody says that it
// hears nothing.
TEST_F(OnAGateway, AZeroStatusWordIsSilence) {
  start();
  words[2] = 0;
  words[3] = 0x1234;
  cycle();
  EXPECT_TRUE(inputs[0].inverter_answers);
  EXPECT_TRUE(inputs[1].module_answers);
  EXPECT_FALSE(inputs[1].inverter_answers);
  EXPECT_FALSE(inputs[1].inverter_missing);
  EXPECT_EQ(ProcessInput{}, inputs[1].input);
  EXPECT_EQ(Interruption::kNone, inputs[1].interruption);
  EXPECT_STREQ("", transport.note(0).text);
  EXPECT_THAT(transport.note(1).text, StartsWith("its status word is 0: is its mains supply on"));
  EXPECT_TRUE(transport.connected());
  EXPECT_TRUE(transport.busText().empty());
  words[0] = 0;
  cycle();
  EXPECT_THAT(transport.busText().str(), HasSubstr("192.168.0.10:502 answers, but every status word is 0"));
}

TEST_F(OnAGateway, BeforeTheFirstAnswerNobodyIsThere) {
  gateway.state = link::LinkState::kConnecting;
  start();
  EXPECT_EQ(Duration::zero(), cycle()) << "nothing to wait for";
  EXPECT_FALSE(inputs[0].module_answers || inputs[0].inverter_answers);
  EXPECT_FALSE(transport.connected());
  EXPECT_EQ("waits for the gateway 192.168.0.10:502", transport.busText().str());
  EXPECT_STREQ("no inputs have come from the gateway yet", transport.note(0).text);
  gateway.text = "192.168.0.10:502 refuses the connection";
  cycle();
  EXPECT_EQ("192.168.0.10:502 refuses the connection", transport.busText().str());
}

// drive_timeout is 50 ms from the question on: the first cycle that begins later says so, and the next ones no more.
TEST_F(OnAGateway, AGatewayThatFallsSilentEndsItWithTheTimeOut) {
  start();
  cycles(3);
  ASSERT_TRUE(inputs[0].inverter_answers);
  const Instant asked = gateway.newest().asked;
  gateway.stalled = true;
  std::vector<Duration> silences;
  for (int i = 0; i < 10; ++i) {
    transport.exchange(outputs, inputs);
    EXPECT_FALSE(inputs[0].inverter_answers);
    EXPECT_EQ(ProcessInput{}, inputs[0].input);
    if (inputs[0].interruption == Interruption::kSilent) silences.push_back(transport.now() - asked);
    EXPECT_EQ(transport.now() - asked <= milliseconds{50}, inputs[1].module_answers);
    transport.sleepUntil(asked + (i + 2) * Duration{kPeriod});
  }
  ASSERT_EQ(1u, silences.size());
  EXPECT_GT(silences[0], milliseconds{50});
  EXPECT_LE(silences[0], milliseconds{60});
  EXPECT_FALSE(transport.connected());
  EXPECT_THAT(transport.note(0).text, HasSubstr("older than drive_timeout"));
  EXPECT_THAT(transport.busText().str(), HasSubstr("ms old, more than drive_timeout (50 ms)"));
  gateway.stalled = false;
  cycles(3);
  EXPECT_TRUE(inputs[0].inverter_answers);
  EXPECT_TRUE(transport.busText().empty());
}

// Each answer comes, and each tells of the past.
TEST_F(OnAGateway, AGatewayThatIsSlowerThanTheTimeOutIsNoFreshData) {
  gateway.delay = milliseconds{60};
  start();
  for (int i = 0; i < 30; ++i) {
    cycle();
    EXPECT_FALSE(inputs[0].inverter_answers || inputs[0].module_answers);
  }
  EXPECT_GT(gateway.newest().number, 2u);
}

// Slower than a cycle, but not than the time-out: fresh where something new came, and online in between.
TEST_F(OnAGateway, AGatewayThatIsSlowerThanACycleIsFollowed) {
  gateway.delay = milliseconds{25};
  start();
  cycles(5);
  int fresh = 0;
  for (int i = 0; i < 30; ++i) {
    cycle();
    EXPECT_TRUE(inputs[0].module_answers);
    EXPECT_EQ(Interruption::kNone, inputs[0].interruption);
    if (inputs[0].inverter_answers) ++fresh;
  }
  EXPECT_GE(fresh, 10);
  EXPECT_LE(fresh, 13);
}

TEST_F(OnAGateway, WhileTheRingStandsNoDriveIsOnline) {
  settings.bus.set("running/address", 100);
  start();
  cycle();
  EXPECT_FALSE(transport.pollEvent());
  gateway.ring_runs = false;
  gateway.running = 0x0080;
  cycle();
  for (const DriveExchange& input : inputs) {
    EXPECT_FALSE(input.module_answers || input.inverter_answers);
    EXPECT_EQ(Interruption::kUnasked, input.interruption);
    EXPECT_EQ(ProcessInput{}, input.input);
  }
  EXPECT_FALSE(transport.connected());
  EXPECT_EQ("the ring behind the gateway does not run (bus/running)", std::string{transport.note(1).text});
  EXPECT_EQ("192.168.0.10:502 answers, but says that its ring does not run (register 100 holds 0080h)",
            transport.busText().str());
  auto event = transport.pollEvent();
  ASSERT_TRUE(event);
  EXPECT_TRUE(event->warning);
  EXPECT_EQ("the ring behind 192.168.0.10:502 stands: register 100 holds 0080h", event->text.str());
  cycle();
  EXPECT_EQ(Interruption::kNone, inputs[0].interruption) << "said once";
  EXPECT_FALSE(transport.pollEvent());
  EXPECT_EQ(1u, transport.counters().value("ring_stops"));
  gateway.ring_runs = true;
  cycle();
  EXPECT_TRUE(inputs[0].inverter_answers);
  event = transport.pollEvent();
  ASSERT_TRUE(event);
  EXPECT_FALSE(event->warning);
  EXPECT_EQ("the ring behind 192.168.0.10:502 runs again", event->text.str());
}

// --- Time ---

// The answer to this cycle's outputs is there in this cycle.
TEST_F(OnAGateway, AQuickGatewayAnswersInTheSameCycle) {
  gateway.delay = microseconds{800};
  gateway.ring = [](const RegisterImage& written) { return RegisterImage{0x0B31, written[1], 0x0B31, 0}; };
  start();
  for (std::int16_t i = 1; i < 20; ++i) {
    outputs[0] = {0x047F, {i, 0, 0}};
    EXPECT_EQ(microseconds{800}, cycle());
    EXPECT_EQ(i, inputs[0].input.actual_values[0]);
  }
}

// Outputs leave at the same moments and the exchange takes no longer, but for the window, once.
TEST_F(OnAGateway, AGatewayThatStallsCostsTheWindowOnce) {
  start();
  cycles(10);
  gateway.stalled = true;
  EXPECT_EQ(microseconds{2500}, cycle());
  for (int i = 0; i < 100; ++i) EXPECT_EQ(Duration::zero(), cycle());
  gateway.stalled = false;
  cycles(20);
  for (std::size_t i = 1; i < gateway.given.size(); ++i) {
    EXPECT_EQ(kPeriod, gateway.given[i].at - gateway.given[i - 1].at) << i;
  }
}

TEST_F(OnAGateway, NoExchangeTakesLongerThanTheWindow) {
  settings.bus.set("answer_window", 0.001);
  start();
  for (const Duration delay : {Duration{0}, Duration{microseconds{900}}, Duration{milliseconds{4}},
                               Duration{milliseconds{12}}, Duration{milliseconds{500}}}) {
    gateway.delay = delay;
    for (int i = 0; i < 20; ++i) EXPECT_LE(cycle(), milliseconds{1}) << i;
  }
}

TEST_F(OnAGateway, AWindowOfZeroTakesWhatTheCycleBeforeHasBrought) {
  settings.bus.set("answer_window", 0.0);
  start();
  EXPECT_EQ(Duration::zero(), cycle());
  EXPECT_FALSE(inputs[0].inverter_answers);
  EXPECT_EQ(Duration::zero(), cycle());
  EXPECT_TRUE(inputs[0].inverter_answers);
}

// A gateway that is gone is not waited for, and its images are given on, for the link to send when it is back.
TEST_F(OnAGateway, WithoutAConnectionNothingIsWaitedFor) {
  start();
  cycles(5);
  gateway.state = link::LinkState::kPausing;
  const std::size_t before = gateway.given.size();
  for (int i = 0; i < 20; ++i) EXPECT_EQ(Duration::zero(), cycle());
  EXPECT_EQ(before + 20, gateway.given.size());
  gateway.state = link::LinkState::kConnected;
  cycles(2);
  EXPECT_TRUE(inputs[0].inverter_answers) << "at once";
}

TEST_F(OnAGateway, ALinkThatDoesNotOpenIsTriedTwiceASecond) {
  gateway.opens = false;
  gateway.text = "no thread for the link";
  start();
  cycles(200);
  EXPECT_GE(gateway.opened, 4u);
  EXPECT_LE(gateway.opened, 5u);
  EXPECT_THAT(gateway.given, IsEmpty());
  EXPECT_EQ("no thread for the link", transport.busText().str());
  gateway.opens = true;
  gateway.text.clear();
  cycles(60);
  EXPECT_TRUE(inputs[0].inverter_answers);
}

// --- What is told ---

TEST_F(OnAGateway, AParameterRequestIsAnsweredInWords) {
  start();
  profile::ParameterRequest request;
  request.id = 77;
  request.number = 102;
  EXPECT_TRUE(transport.submit(1, request));
  const auto result = transport.pollResult();
  ASSERT_TRUE(result);
  EXPECT_EQ(77u, result->id);
  EXPECT_EQ(profile::ParameterOutcome::kNoChannel, result->outcome);
  EXPECT_THAT(result->text.str(), StartsWith("its gateway carries process data only"));
  EXPECT_FALSE(transport.pollResult());
  EXPECT_EQ("none", transport.identity(1).parameter_channel);
}

TEST_F(OnAGateway, IdentityNamesPlaceAndProtection) {
  start();
  EXPECT_EQ("InterBus position 2", transport.identity(1).address);
  EXPECT_EQ("", transport.identity(1).protected_by) << "P513 does not notice a computer that is dead";
  EXPECT_EQ(TimeoutOwner::kInverter, transport.identity(1).timeout_owner);
  settings.bus.set("watchdog/address", 2000).set("watchdog/value", 500);
  start();
  EXPECT_EQ(
      "watchdog of the gateway (register 2000 = 500), which ends its outputs: with P513 > 0 the inverter trips E10 and "
      "the motor coasts",
      transport.identity(1).protected_by);
  EXPECT_FALSE(transport.identity(1).timeout_notices);
  EXPECT_TRUE(transport.identity(1).timeout_needed);
  EXPECT_STREQ("gateway", transport.endPoint().key);
  EXPECT_STREQ("diagnosis", transport.endPoint().second_key);
}

TEST_F(OnAGateway, WarnsOfWhatIsNotWatched) {
  start();
  const auto warnings = transport.warnings();
  ASSERT_EQ(2u, warnings.size());
  EXPECT_THAT(warnings[0], StartsWith("bus/running is not configured"));
  EXPECT_THAT(warnings[1], StartsWith("bus/watchdog is not configured"));
  settings.bus.set("running/address", 100).set("watchdog/address", 2000).set("watchdog/value", 500);
  start();
  EXPECT_THAT(transport.warnings(), IsEmpty());
}

TEST_F(OnAGateway, WarnsOfOutputsThatBelongToNobody) {
  settings.bus.set("running/address", 100).set("watchdog/address", 2000).set("watchdog/value", 500);
  settings.bus.set("outputs/address", 100);
  settings.drive(1).set("output_offset", 5);
  start();
  const auto warnings = transport.warnings();
  ASSERT_EQ(1u, warnings.size());
  EXPECT_THAT(warnings[0],
              StartsWith("output words 2 to 4 of the image (registers 102 to 104) lie between two drives"));
}

TEST_F(OnAGateway, CountsCyclesWithoutInputs) {
  start();
  cycles(10);
  gateway.stalled = true;
  cycles(5);
  EXPECT_EQ(15u, transport.counters().value(bus_counter::kCycles));
  EXPECT_EQ(5u, transport.counters().value("without_inputs"));
}

TEST_F(OnAGateway, ClosingEndsTheLink) {
  InterbusTransport never_configured;
  never_configured.close();
  start();
  cycle();
  transport.close();
  transport.close();
  EXPECT_TRUE(gateway.closed);
}

}  // namespace
}  // namespace nord_driver
