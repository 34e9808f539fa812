#include <gmock/gmock.h>

#include "canopen/sdo_conversation.h"
#include "canopen/store_command.h"
#include "sim/canopen/simulated_can_bus.h"

namespace nord_driver::canopen {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;

class StoreCommands : public SdoConversation {
 protected:
  /// The command against what a node answers, frame by frame; its own frames in between.
  Progress run(StoreCommand& command, const std::vector<std::string>& answers) {
    Progress progress = Progress::kGoOn;
    for (const std::string& answer_frame : answers) {
      EXPECT_EQ(Progress::kGoOn, progress);
      EXPECT_TRUE(client.start(command.request(), now));
      frames.push_back(sent());
      answer(answer_frame);
      progress = command.handle(taken());
    }
    return progress;
  }
  std::vector<std::string> frames;
};

// CiA 301 7.5.2.13: 73h 61h 76h 65h is "save".
TEST_F(StoreCommands, Stores) {
  StoreCommand command{StoreAction::kStore};
  EXPECT_EQ(Progress::kDone, run(command, {"43 10 10 01 01 00 00 00", "60 10 10 01 00 00 00 00"}));
  EXPECT_EQ((std::vector<std::string>{"40 10 10 01 00 00 00 00", "23 10 10 01 73 61 76 65"}), frames);
  EXPECT_TRUE(command.reason().empty());
}

// CiA 301 7.5.2.14: 6Ch 6Fh 61h 64h is "load".
TEST_F(StoreCommands, Restores) {
  StoreCommand command{StoreAction::kRestore, 2};
  EXPECT_EQ(Progress::kDone, run(command, {"43 11 10 02 01 00 00 00", "60 11 10 02 00 00 00 00"}));
  EXPECT_EQ((std::vector<std::string>{"40 11 10 02 00 00 00 00", "23 11 10 02 6C 6F 61 64"}), frames);
}

// What cannot do it is not commanded.
TEST_F(StoreCommands, RefusedInWords) {
  const auto reason = [&](StoreAction action, const std::vector<std::string>& answers, std::uint8_t sub = 1) {
    StoreCommand command{action, sub};
    frames.clear();
    EXPECT_EQ(Progress::kFailed, run(command, answers));
    return command.reason().str();
  };
  EXPECT_EQ("has no object 1010h: it cannot store its settings on command (BU 0260 names it of SK CU4/TU4-CAO only)",
            reason(StoreAction::kStore, {"80 10 10 01 00 00 02 06"}));
  EXPECT_EQ("has no sub-index 2 of 1011h: it cannot restore that part of its settings alone",
            reason(StoreAction::kRestore, {"80 11 10 02 11 00 09 06"}, 2));
  EXPECT_EQ("stores its settings by itself, and not on command (1010h:1 = 2): there is nothing to do",
            reason(StoreAction::kStore, {"43 10 10 01 02 00 00 00"}));
  EXPECT_EQ("stores nothing on command (1010h:1 = 0)", reason(StoreAction::kStore, {"43 10 10 01 00 00 00 00"}));
  EXPECT_EQ("restores nothing on command (1011h:1 = 0)", reason(StoreAction::kRestore, {"43 11 10 01 00 00 00 00"}));
  EXPECT_EQ(
      "store parameters (1010h:1) cannot be written: abort 0800 0022h (the data cannot be transferred or stored in the "
      "present state of the device)",
      reason(StoreAction::kStore, {"43 10 10 01 01 00 00 00", "80 10 10 01 22 00 00 08"}));
  EXPECT_EQ(2u, frames.size());
}

TEST_F(StoreCommands, NoAnswer) {
  StoreCommand command{StoreAction::kStore};
  ASSERT_TRUE(client.start(command.request(), now));
  sent();
  pass(kTimeout);
  EXPECT_EQ(Progress::kFailed, command.handle(taken()));
  EXPECT_THAT(command.reason().c_str(), HasSubstr("abort 0504 0000h (no answer in time)"));
}

/// A command to the simulated gateway at node 5; why it failed, or "".
std::string commanded(sim::SimulatedCanBus& bus, StoreAction action) {
  SdoClient client{defaultSdoChannel(5), milliseconds{100}};
  StoreCommand command{action};
  Progress progress = Progress::kGoOn;
  while (progress == Progress::kGoOn) {
    client.start(command.request(), bus.now());
    std::optional<SdoAnswer> answer;
    while (!(answer = client.takeAnswer())) {
      CanFrame frame;
      if (client.pollTransmit(frame)) bus.send(frame);
      bus.run(milliseconds{1});
      link::ReceivedCanFrame received;
      while (bus.receive(received)) client.handle(received.frame, bus.now());
      client.poll(bus.now());
    }
    progress = command.handle(*answer);
  }
  return command.reason().str();
}

sim::SimConfig node5(sim::CanConnection connection) {
  sim::CanDriveConfig can;
  can.connection = connection;
  sim::SimConfig config;
  config.bus = sim::CanBusConfig{};
  sim::DriveConfig drive;
  drive.name = "fi1";
  drive.address = 5;
  drive.bus = can;
  if (connection == sim::CanConnection::kGateway) {
    drive.device.series = sim::Series::kSk2xxe;
    drive.place = 1;
  }
  config.drives.push_back(drive);
  return config;
}

// The simulated gateway stores, and a technology unit has no such object.
TEST(StoreCommandSimulated, GatewayAndOthers) {
  sim::SimulatedCanBus gateway{node5(sim::CanConnection::kGateway)};
  gateway.open();
  gateway.run(milliseconds{500});
  EXPECT_EQ("", commanded(gateway, StoreAction::kStore));
  EXPECT_EQ("", commanded(gateway, StoreAction::kRestore));

  sim::SimulatedCanBus option{node5(sim::CanConnection::kOption)};
  option.open();
  option.run(milliseconds{500});
  EXPECT_THAT(commanded(option, StoreAction::kStore), HasSubstr("has no object 1010h"));
}

}  // namespace
}  // namespace nord_driver::canopen
