// A parameter access as the drive layer knows it, as explicit messages carry it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "transport/devicenet/devicenet_parameters.h"
#include "transport/devicenet/explicit_refusal.h"

namespace nord_driver {
namespace {

using devicenet::ExplicitAnswer;
using devicenet::ExplicitEnd;
using devicenet::ExplicitRequest;
using profile::ParameterAction;
using profile::ParameterOutcome;
using profile::ParameterReason;
using profile::ParameterRequest;
using profile::ParameterShape;
using ::testing::HasSubstr;

ParameterRequest requestOf(std::uint16_t number, ParameterShape shape, ParameterAction action, std::int32_t raw = 0) {
  ParameterRequest request;
  request.id = 77;
  request.number = number;
  request.shape = shape;
  request.action = action;
  request.raw = raw;
  return request;
}
ParameterRequest readOf(std::uint16_t number, ParameterShape shape = ParameterShape::kPlain) {
  return requestOf(number, shape, ParameterAction::kRead);
}
DevicenetDrive driveOf(std::uint8_t inverter, ParameterObjects objects = ParameterObjects::kNumbered) {
  DevicenetDrive drive;
  drive.inverter = inverter;
  drive.parameter_objects = objects;
  return drive;
}
/// "10 101 1 3 = 67 00": service, class, instance, attribute, data.
std::string text(const ExplicitRequest& request) {
  char service[8];
  std::snprintf(service, sizeof service, "%02X ", request.service);
  std::string result = service + std::to_string(request.class_id) + " " + std::to_string(request.instance) + " " +
                       std::to_string(request.attribute.value_or(0));
  if (!request.data.empty()) result += " = " + toHex(ByteView{request.data});
  return result;
}

struct Channel {
  explicit Channel(const DevicenetDrive& drive = driveOf(1)) : parameters{drive, 5} {}

  /// Starts the next access.
  std::string start() {
    const auto access = parameters.pendingAccess();
    if (!access) return "nothing";
    id = access->id;
    parameters.handleStarted();
    return text(*access);
  }
  bool answer(const std::string& hex = "") {
    ExplicitAnswer answer;
    answer.id = id;
    for (const std::uint8_t byte : fromHex(hex)) answer.data.push_back(byte);
    return parameters.handleAnswer(answer);
  }
  bool refuse(std::uint8_t general) {
    ExplicitAnswer answer;
    answer.id = id;
    answer.end = ExplicitEnd::kRefused;
    answer.general = general;
    return parameters.handleAnswer(answer);
  }
  void end(ExplicitEnd with) {
    ExplicitAnswer answer;
    answer.id = id;
    answer.end = with;
    parameters.handleAnswer(answer);
  }
  profile::ParameterResult result() {
    const auto result = parameters.pollResult();
    EXPECT_TRUE(result.has_value());
    return result.value_or(profile::ParameterResult{});
  }

  DevicenetParameters parameters;
  std::uint32_t id = 0;
};

// BU 0280 4.3.9, the four examples; sub-index 0 is set 1 or element 1.
TEST(DevicenetParametersTest, ObjectsAreTheManuals) {
  const auto object = [](std::uint8_t inverter, ParameterRequest request, std::uint8_t set = 1) {
    request.parameter_set = set;
    const auto found = parameterObject(driveOf(inverter), request);
    if (!found) return std::string{"none"};
    return std::to_string(found->class_id) + " " + std::to_string(found->attribute) + " " +
           std::to_string(found->instance);
  };
  EXPECT_EQ("101 3 1", object(1, readOf(103, ParameterShape::kPerSet)));
  EXPECT_EQ("131 3 3", object(4, readOf(103, ParameterShape::kPerSet), 3));
  EXPECT_EQ("105 46 1", object(1, readOf(546)));
  EXPECT_EQ("125 46 1", object(3, readOf(546)));
  ParameterRequest array = readOf(543, ParameterShape::kArrayPerSet);
  array.index = 3;
  EXPECT_EQ("105 43 10", object(1, array, 2)) << "4 * (3 - 1) + (2 - 1) + 1";
  EXPECT_EQ("109 99 1", object(1, readOf(999)));
  // The module's are in class 181, whichever inverter asks.
  EXPECT_EQ("181 51 1", object(1, readOf(151)));
  EXPECT_EQ("181 51 1", object(3, readOf(151)));
  array.index = 65;
  EXPECT_EQ("none", object(1, array));
}

TEST(DevicenetParametersTest, AReadIsOneMessage) {
  Channel channel;
  channel.parameters.submit(readOf(105, ParameterShape::kPerSet));
  EXPECT_EQ("0E 101 1 5", channel.start());
  EXPECT_EQ(5, DevicenetParameters::tagOf(channel.id));
  EXPECT_FALSE(channel.answer("F4 01"));
  const auto result = channel.result();
  EXPECT_EQ(ParameterOutcome::kDone, result.outcome);
  EXPECT_EQ(77u, result.id);
  EXPECT_EQ(500, result.raw);
}

TEST(DevicenetParametersTest, AWriteIsAsWideAsItsValue) {
  Channel channel;
  channel.parameters.submit(requestOf(102, ParameterShape::kPerSet, ParameterAction::kWritePersistent, 103));
  EXPECT_EQ("10 101 1 2 = 67 00", channel.start());
  channel.answer();
  EXPECT_EQ(103, channel.result().raw);
  ParameterRequest position = requestOf(613, ParameterShape::kArray, ParameterAction::kWritePersistent, -2);
  position.double_word = true;
  position.index = 2;
  channel.parameters.submit(position);
  EXPECT_EQ("10 106 2 13 = FE FF FF FF", channel.start());
  channel.answer();
  EXPECT_EQ(-2, channel.result().raw);
}

// Of a parameter that is not in the catalogue only the value is known: refused for its length it was not written.
TEST(DevicenetParametersTest, AWriteThatIsRefusedForItsLengthIsTriedWithTheOther) {
  Channel channel;
  channel.parameters.submit(requestOf(613, ParameterShape::kPlain, ParameterAction::kWritePersistent, 103));
  EXPECT_EQ("10 106 1 13 = 67 00", channel.start());
  channel.refuse(0x13);
  EXPECT_EQ("10 106 1 13 = 67 00 00 00", channel.start());
  channel.answer();
  EXPECT_EQ(ParameterOutcome::kDone, channel.result().outcome);
  ParameterRequest wide = requestOf(613, ParameterShape::kPlain, ParameterAction::kWritePersistent, 32767);
  wide.double_word = true;
  channel.parameters.submit(wide);
  EXPECT_EQ("10 106 1 13 = FF 7F 00 00", channel.start());
  channel.refuse(0x15);
  EXPECT_EQ("10 106 1 13 = FF 7F", channel.start());
  channel.refuse(0x13);
  EXPECT_EQ(ParameterOutcome::kRefused, channel.result().outcome) << "once";
  // Read back, FE FF is 65534 to who expects 32 bits: it would be said to differ, though it was written.
  for (const std::int32_t other_in_a_word : {-2, 32768, 65536}) {
    wide.raw = other_in_a_word;
    channel.parameters.submit(wide);
    channel.start();
    channel.refuse(0x15);
    EXPECT_EQ("nothing", channel.start()) << other_in_a_word;
    EXPECT_EQ(ParameterOutcome::kRefused, channel.result().outcome) << other_in_a_word;
  }
  channel.parameters.submit(requestOf(613, ParameterShape::kPlain, ParameterAction::kWritePersistent, 103));
  channel.start();
  channel.refuse(0x09);
  EXPECT_EQ(ParameterOutcome::kRefused, channel.result().outcome) << "its value, not its length";
  Channel index{driveOf(1, ParameterObjects::kIndexObject)};
  index.parameters.submit(requestOf(613, ParameterShape::kPlain, ParameterAction::kWritePersistent, 103));
  index.start();
  index.answer();
  index.start();
  index.answer();
  EXPECT_EQ("10 199 1 3 = 67 00", index.start());
  index.refuse(0x13);
  EXPECT_EQ("10 199 1 4 = 67 00 00 00", index.start());
}

// BU 0280 P560: what is written is written to the EEPROM, unless P560 = 0.
TEST(DevicenetParametersTest, AWriteThatSparesTheEepromIsRefusedUnasked) {
  Channel channel;
  EXPECT_FALSE(DevicenetParameters::capabilities().ram_writes);
  channel.parameters.submit(requestOf(102, ParameterShape::kPerSet, ParameterAction::kWriteRam, 1));
  EXPECT_EQ("nothing", channel.start());
  EXPECT_EQ(ParameterReason::kNotSupported, channel.result().reason);
}

// BU 0280 4.3.10: number, index, value; the inverter is the instance.
TEST(DevicenetParametersTest, TheIndexObjectIsTheSecondWay) {
  Channel channel{driveOf(2, ParameterObjects::kIndexObject)};
  ParameterRequest request = readOf(546, ParameterShape::kPerSet);
  request.parameter_set = 3;
  channel.parameters.submit(request);
  EXPECT_EQ("10 199 2 1 = 22 02", channel.start());
  EXPECT_FALSE(channel.answer());
  EXPECT_EQ("10 199 2 2 = 02", channel.start());
  channel.answer();
  EXPECT_EQ("0E 199 2 3", channel.start());
  channel.answer("01 00");
  EXPECT_EQ(1, channel.result().raw);
  // The module's parameters are not in it.
  channel.parameters.submit(readOf(151));
  EXPECT_EQ("0E 181 1 51", channel.start());
}

// An access of the wrong size is an error (BU 0280 4.3.10): of a value whose width is not known 16 bits are tried first.
TEST(DevicenetParametersTest, TheIndexObjectTriesBothWidths) {
  Channel channel{driveOf(1, ParameterObjects::kIndexObject)};
  channel.parameters.submit(readOf(601));
  for (int step = 0; step < 2; ++step) {
    channel.start();
    channel.answer();
  }
  EXPECT_EQ("0E 199 1 3", channel.start());
  channel.refuse(0x15);
  EXPECT_EQ("0E 199 1 4", channel.start());
  channel.answer("FE FF FF FF");
  EXPECT_EQ(-2, channel.result().raw);
}

// BU 0280 4.1.2.
TEST(DevicenetParametersTest, ResourceUnavailableIsAnInverterThatIsOff) {
  Channel channel;
  channel.parameters.submit(readOf(707));
  channel.start();
  EXPECT_TRUE(channel.refuse(0x02));
  const auto result = channel.result();
  EXPECT_EQ(ParameterOutcome::kRefused, result.outcome);
  EXPECT_EQ(ParameterReason::kNoInverter, result.reason);
  EXPECT_EQ("DeviceNet error 02h, a resource is unavailable: the inverter behind the module is missing or off",
            result.text.str());
  channel.parameters.submit(readOf(151));
  channel.start();
  EXPECT_FALSE(channel.refuse(0x02)) << "that was about the module";
}

// A parameter without sets is read without one, as on PKW (P105 has four sets, or none).
TEST(DevicenetParametersTest, ASetThatIsMissingIsReadWithout) {
  Channel channel;
  ParameterRequest request = readOf(105, ParameterShape::kPerSet);
  request.parameter_set = 2;
  channel.parameters.submit(request);
  EXPECT_EQ("0E 101 2 5", channel.start());
  channel.refuse(0x16);
  EXPECT_EQ("0E 101 1 5", channel.start());
  channel.answer("F4 01");
  EXPECT_EQ(500, channel.result().raw);
}

// The fault number also stands in the control supervisor (class 41, attribute 13; BU 0280 4.3.6).
TEST(DevicenetParametersTest, TheSupervisorKnowsTheFaultToo) {
  for (const ParameterObjects objects : {ParameterObjects::kNumbered, ParameterObjects::kIndexObject}) {
    Channel channel{driveOf(3, objects)};
    ParameterRequest request = readOf(700, ParameterShape::kArray);
    const auto refuseParameter = [&] {
      channel.parameters.submit(request);
      EXPECT_EQ(objects == ParameterObjects::kNumbered ? "0E 127 1 0" : "10 199 3 1 = BC 02", channel.start());
      channel.refuse(0x0F);
      EXPECT_EQ("0E 41 3 13", channel.start());
    };
    refuseParameter();
    channel.answer("66 00");
    EXPECT_EQ(102, channel.result().raw);
    // Where it does not tell either, the refusal of the parameter is told.
    refuseParameter();
    channel.refuse(0x16);
    EXPECT_EQ("DeviceNet error 0Fh, the privilege is missing", channel.result().text.str());
    refuseParameter();
    channel.answer("00 00");
    EXPECT_EQ(ParameterReason::kNoRight, channel.result().reason) << "no fault is none of its answers";
    // Not of an inverter that is off, and not of what is no fault number.
    channel.parameters.submit(request);
    channel.start();
    EXPECT_TRUE(channel.refuse(0x02));
    EXPECT_EQ("nothing", channel.start());
    channel.result();
    request.index = 2;
    channel.parameters.submit(request);
    channel.start();
    channel.refuse(0x0F);
    EXPECT_EQ("nothing", channel.start());
    channel.result();
  }
}

TEST(DevicenetParametersTest, WhatEndsWithoutAnAnswerIsSaidToBeSo) {
  Channel channel;
  channel.parameters.submit(readOf(105));
  channel.start();
  channel.end(ExplicitEnd::kTimedOut);
  EXPECT_EQ(ParameterOutcome::kTimeout, channel.result().outcome);
  channel.parameters.submit(readOf(105));
  channel.start();
  channel.end(ExplicitEnd::kNotConnected);
  EXPECT_EQ(ParameterOutcome::kOffline, channel.result().outcome);
  channel.parameters.submit(readOf(105));
  channel.start();
  channel.answer("01 02 03 04 05");
  EXPECT_EQ(ParameterReason::kUnreadable, channel.result().reason);
  channel.parameters.submit(readOf(105));
  channel.start();
  channel.parameters.handleOffline();
  EXPECT_EQ(ParameterOutcome::kOffline, channel.result().outcome);
  channel.parameters.submit(readOf(106));
  EXPECT_FALSE(channel.answer("01 00")) << "an answer to what was given up";
  EXPECT_EQ("0E 101 1 6", channel.start());
}

TEST(ExplicitRefusal, TellsReasonAndWords) {
  const ParameterRequest plain = readOf(102);
  const ParameterRequest set = readOf(102, ParameterShape::kPerSet);
  EXPECT_EQ(ParameterReason::kOutOfLimits, reasonOfError(0x09, plain));
  EXPECT_EQ(ParameterReason::kReadOnly, reasonOfError(0x0E, plain));
  EXPECT_EQ(ParameterReason::kNoRight, reasonOfError(0x0F, plain));
  EXPECT_EQ(ParameterReason::kNotNow, reasonOfError(0x10, plain));
  EXPECT_EQ(ParameterReason::kNoSuchParameter, reasonOfError(0x14, plain));
  EXPECT_EQ(ParameterReason::kWrongType, reasonOfError(0x15, plain));
  EXPECT_EQ(ParameterReason::kNoSuchElement, reasonOfError(0x16, plain));
  EXPECT_EQ(ParameterReason::kNotIndexed, reasonOfError(0x16, set));
  EXPECT_EQ(ParameterReason::kDeviceFailure, reasonOfError(0x19, plain));
  EXPECT_EQ(ParameterReason::kOther, reasonOfError(0x77, plain));
  EXPECT_EQ("DeviceNet error 09h, the value of the attribute is invalid", errorSentence(0x09, 0xFF).str());
  EXPECT_EQ("DeviceNet error 1Fh (additional code 05h), an error of the manufacturer's own",
            errorSentence(0x1F, 0x05).str());
  EXPECT_EQ("DeviceNet error 77h, a code that is reserved", errorSentence(0x77, 0xFF).str());
}

}  // namespace
}  // namespace nord_driver
