// What goes beside the images of the simulated gateway: parameters, the second connection, and looking without writing.
#include <gmock/gmock.h>

#include "transport/interbus/gateway_ring.h"

namespace nord_driver::test {
namespace {

using profile::ParameterOutcome;
using profile::ParameterRequest;
using profile::ParameterShape;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class GatewayParameters : public GatewayRing {
 protected:
  void withPcp() { settings.bus.set("pcp/invoke/address", 500).set("pcp/result/address", 600); }
  static ParameterRequest maxFrequency() {
    ParameterRequest request;
    request.id = 5;
    request.number = 105;
    request.shape = ParameterShape::kPerSet;
    return request;
  }
};

TEST_F(GatewayParameters, PcpIsAParameterChannelAndCalledExperimental) {
  withPcp();
  start();
  EXPECT_EQ("PCP (experimental)", transport.identity(0).parameter_channel);
  EXPECT_TRUE(transport.identity(0).sends_words);
  EXPECT_THAT(transport.warnings(), Contains(HasSubstr("Compact PCP is experimental")));
  EXPECT_FALSE(transport.parameterCapabilities(0).ram_writes);
  ASSERT_TRUE(allAnswer()) << transport.busText().c_str();
  const auto result = ask(maxFrequency(), 1);
  EXPECT_EQ(ParameterOutcome::kDone, result.outcome) << result.text.c_str();
  EXPECT_EQ(500, result.raw);
  EXPECT_EQ(5u, result.id);
}

TEST_F(GatewayParameters, ADriveThatDoesNotAnswerIsNotAsked) {
  withPcp();
  start();
  ASSERT_TRUE(allAnswer()) << transport.busText().c_str();
  sim.withModel([](sim::RobotSim& robot) { robot.drive(0).setInverterPower(false); });
  ASSERT_TRUE(runUntil([&] { return !inputs[0].inverter_answers && inputs[1].inverter_answers; }));
  EXPECT_EQ(ParameterOutcome::kOffline, ask(maxFrequency()).outcome);
  EXPECT_EQ(ParameterOutcome::kDone, ask(maxFrequency(), 1).outcome);
}

TEST_F(GatewayParameters, TheSecondConnectionCarriesThem) {
  withPcp();
  settings.bus.set("diagnosis", sim.where());
  start();
  ASSERT_TRUE(allAnswer()) << transport.busText().c_str();
  EXPECT_EQ(2u, transport.counters().value("connections"));
  EXPECT_EQ(ParameterOutcome::kDone, ask(maxFrequency()).outcome);
  sim.withGateway([](sim::IbsRing& ring, sim::RegisterGateway&) { ring.setCut(true); });
  EXPECT_TRUE(runUntil([&] { return inputs[0].interruption == Interruption::kUnasked; })) << "running is read over it";
}

// DRIVECOM commands rpm: without P105 every speed is 0.
TEST_F(GatewayParameters, DrivecomSpeedsAreScaledByWhatTheDriveLayerReads) {
  withPcp();
  settings.drive(0) = MapSettings("~drives/drive0/", {{"address", 1}, {"series", std::string{"sk5xxe"}}});
  settings.drive(0).set("profile", "drivecom").set("pole_pairs", 2);
  start();
  ASSERT_TRUE(runUntil([&] { return inputs[0].inverter_answers; })) << transport.busText().c_str();
  outputs[0] = {0x047F, {0x2000, 0, 0}};
  const auto setpoint = [&] {
    return sim.withGateway([](sim::IbsRing& ring, sim::RegisterGateway&) { return ring.outputs()[1]; });
  };
  ASSERT_TRUE(runUntil([&] { return inputs[0].inverter_answers; }));
  EXPECT_EQ(0, setpoint());
  ParameterRequest request = maxFrequency();
  EXPECT_EQ(ParameterOutcome::kDone, ask(request).outcome);
  EXPECT_TRUE(runUntil([&] { return inputs[0].inverter_answers; }));
  EXPECT_EQ(0, setpoint()) << "a user's read changes no speed";
  request.scales = true;
  EXPECT_EQ(ParameterOutcome::kDone, ask(request).outcome);
  EXPECT_TRUE(runUntil([&] { return setpoint() == 750; })) << "half of 50 Hz: " << setpoint();
}

// BU 0070 6.3.2: with another value than FFh the words of the ring are not evaluated.
TEST_F(GatewayParameters, WarnsOfTheObjectThatEnablesTheWordsOfDrivecom) {
  settings.drive(1).set("profile", "drivecom");
  start();
  EXPECT_THAT(transport.warnings(),
              ElementsAre("drive drive1: with profile: drivecom the inverter takes control word and setpoint from the "
                          "ring only while its object 6002h (PA data enabled) is FFh (BU 0070 6.3.2), which the driver "
                          "does not read: check it where the drive does not obey"))
      << "of the other drive nothing";
}

// A program that looks, or reads parameters, leaves the drives to whoever has them.
TEST_F(GatewayParameters, WhoServesParametersOnlyWritesNoImage) {
  settings.bus.set("inputs/function", 23);
  EXPECT_TRUE(transport.serveParametersOnly());
  transport.showWords(8);
  // The simulated gateway has four words: more is an exception, and told.
  start();
  EXPECT_TRUE(runUntil([&] { return !transport.busText().empty() && !transport.connected(); }));
  EXPECT_TRUE(runUntil([&] {
    return std::string(transport.busText().c_str()).find("exception 2") != std::string::npos;
  })) << transport.busText().c_str();
  EXPECT_EQ(0u, writes());
  EXPECT_FALSE(transport.identity(0).sends_words);
  EXPECT_THAT(transport.warnings(), Not(Contains(HasSubstr("watchdog"))));
}

TEST_F(GatewayParameters, ShowsTheImage) {
  EXPECT_TRUE(transport.serveParametersOnly());
  transport.showWords(0);
  start();
  EXPECT_TRUE(transport.image().empty());
  ASSERT_TRUE(allAnswer()) << transport.busText().c_str();
  EXPECT_EQ(sim.where() + ", function 4, registers 0 to 3", transport.imageText());
  ASSERT_TRUE(runUntil([&] { return inputs[0].input.status_word == 0x0B70; }));
  outputs[0] = {0x047F, {0x2000, 0, 0}};
  const std::uint64_t before = transport.counters().value("exchanges");
  ASSERT_TRUE(runUntil([&] { return transport.counters().value("exchanges") > before + 20; }));
  const auto words = transport.image();
  ASSERT_EQ(4u, words.size());
  EXPECT_EQ("drive0", words[0].drive);
  EXPECT_EQ("status word", words[0].meaning);
  EXPECT_EQ("switch-on disabled", words[0].text);
  EXPECT_EQ(0x0B70, words[0].value);
  EXPECT_EQ("actual value 1", words[3].meaning);
  EXPECT_EQ("drive1", words[3].drive);
  EXPECT_EQ(3u, words[3].register_at);
  EXPECT_EQ(0u, writes());
}

}  // namespace
}  // namespace nord_driver::test
