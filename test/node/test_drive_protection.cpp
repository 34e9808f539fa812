// Whether a drive would stop when this computer dies, from what the bus does and what the drive's parameters say.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "node/drive_protection.h"

namespace nord_driver::node {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using Level = ProtectionReport::Level;

const char* const kWatchdog = "PROFIBUS watchdog of 0.2 s";

DriveIdentity identity(TimeoutOwner owner = TimeoutOwner::kInverter, const char* by = kWatchdog, double time = 0.2) {
  DriveIdentity identity;
  identity.protected_by = by;
  identity.protection_time = time;
  identity.timeout_owner = owner;
  identity.parameter_channel = "PKW";
  return identity;
}

cycle::DeviceData withP513(std::optional<double> p513) {
  cycle::DeviceData device;
  device.telegram_timeout = p513;
  device.complete = true;
  return device;
}

cycle::DeviceData behindModule(std::optional<double> p151, std::optional<std::int32_t> p120) {
  cycle::DeviceData device = withP513(0.0);
  device.module_timeout = p151;
  device.option_monitoring = p120;
  return device;
}

ProtectionReport assess(const DriveIdentity& identity, const cycle::DeviceData& device, double cmd_vel_timeout = 0.5,
                        profile::Series series = profile::Series::kSk2xxe) {
  return DriveProtection{identity, series, seconds(cmd_vel_timeout), seconds(0.01)}.assess(device);
}

ProtectionReport assessLookingOn(const DriveIdentity& identity, const cycle::DeviceData& device) {
  return DriveProtection{identity, profile::Series::kSk2xxe, seconds(0.5), seconds(0.01), true}.assess(device);
}

// BU 2700 7.1.1: with 0 the inverter trips on a lost master, with -0.1 it runs on in every case.
TEST(DriveProtection, P513OfMinusOneTenthRunsOn) {
  EXPECT_EQ(Level::kFine, assess(identity(), withP513(0.0)).level);
  EXPECT_EQ(kWatchdog, assess(identity(), withP513(0.0)).text);
  const ProtectionReport off = assess(identity(), withP513(-0.1));
  EXPECT_EQ(Level::kError, off.level);
  EXPECT_THAT(off.text, StartsWith("nothing: P513 = -0.1"));
  EXPECT_EQ(Level::kError, assess(identity(TimeoutOwner::kModule), withP513(-0.1)).level);
}

// Behind a gateway that may repeat the last words P513 alone notices nothing, known or not; what ends the words and P513
// stop the drive together, one after the other.
TEST(DriveProtection, WhoMayRepeatTheLastWordsHasToEndThemFirst) {
  DriveIdentity gateway = identity(TimeoutOwner::kInverter, "", 0.0);
  gateway.timeout_notices = false;
  for (const auto p513 : {std::optional<double>{}, std::optional<double>{0.2}}) {
    const ProtectionReport alone = assess(gateway, withP513(p513));
    EXPECT_EQ(Level::kError, alone.level);
    EXPECT_EQ(
        "nothing that is known: what stands between this computer and the drive may repeat the last control words for "
        "ever, and P513 does not notice that",
        alone.text);
  }
  gateway.protected_by = "watchdog of the gateway";
  gateway.protection_time = 0.2;
  gateway.timeout_needed = true;
  const ProtectionReport unknown = assess(gateway, withP513(std::nullopt));
  EXPECT_EQ(Level::kWarning, unknown.level);
  EXPECT_EQ("watchdog of the gateway; P513, without which it would run on, is not known", unknown.text);
  const ProtectionReport off = assess(gateway, withP513(0.0));
  EXPECT_EQ(Level::kError, off.level);
  EXPECT_EQ("nothing: watchdog of the gateway, but P513 = 0: it would run on", off.text);
  const ProtectionReport both = assess(gateway, withP513(0.2));
  EXPECT_EQ(Level::kFine, both.level);
  EXPECT_EQ("watchdog of the gateway; P513 of 0.2 s after that", both.text);
  const ProtectionReport late = assess(gateway, withP513(0.2), 0.3);
  EXPECT_EQ(Level::kWarning, late.level);
  EXPECT_THAT(late.text, HasSubstr("that is 0.4 s after the last telegram"));
  gateway.timeout_needed = false;
  EXPECT_EQ(Level::kFine, assess(gateway, withP513(0.0)).level) << "its zeros switch off";
}

// It may be -0.1: nobody knows whether this drive stops.
TEST(DriveProtection, WhatCouldNotBeReadIsWarnedAbout) {
  const ProtectionReport inverter = assess(identity(), withP513(std::nullopt));
  EXPECT_EQ(Level::kWarning, inverter.level);
  EXPECT_THAT(inverter.text, HasSubstr("P513, which can switch this off, is not known"));
  const ProtectionReport module = assess(identity(TimeoutOwner::kModule), withP513(0.0));
  EXPECT_THAT(module.text, HasSubstr("P151 of the bus module, which can switch this off, is not known"));
  EXPECT_THAT(module.text, HasSubstr("P120, by which the inverter watches its bus module, is not known"));
}

// Before everything has been asked for, "not known" would tell nothing.
TEST(DriveProtection, WhatHasNotBeenAskedForYetIsNoWarning) {
  cycle::DeviceData device;
  EXPECT_EQ(Level::kFine, assess(identity(), device).level);
  EXPECT_EQ(Level::kFine, assess(identity(TimeoutOwner::kModule), device).level);
}

// Modules SK CU4/TU4: P151 of the module, P120 of the inverter (BU 2700 8.1).
TEST(DriveProtection, BehindAModuleP151AndP120Decide) {
  const DriveIdentity module = identity(TimeoutOwner::kModule);
  EXPECT_EQ(Level::kFine, assess(module, behindModule(0.0, 1)).level);
  EXPECT_EQ(Level::kFine, assess(module, behindModule(0.3, 2)).level);
  EXPECT_THAT(assess(module, behindModule(0.3, 2)).text, HasSubstr("P151 of the bus module of 0.3 s"));
  const ProtectionReport off = assess(module, behindModule(-0.001, 1));
  EXPECT_EQ(Level::kError, off.level);
  EXPECT_THAT(off.text, HasSubstr("P151 = -1"));
  const ProtectionReport unwatched = assess(module, behindModule(0.0, 0));
  EXPECT_EQ(Level::kWarning, unwatched.level);
  EXPECT_THAT(unwatched.text, HasSubstr("P120 = 0"));
}

// SK 511E to 535E behind SK CU4/TU4 watch the system bus by P513 and have no P120; SK 54xE have it (BU 2700 8.1).
TEST(DriveProtection, BehindAModuleSk5xxeWatchesItByP513) {
  const auto assess5xxe = [](std::optional<double> p513) {
    cycle::DeviceData device = withP513(p513);
    device.module_timeout = 0.3;
    return assess(identity(TimeoutOwner::kModule), device, 0.5, profile::Series::kSk5xxe);
  };
  const ProtectionReport fine = assess5xxe(0.5);
  EXPECT_EQ(Level::kFine, fine.level) << fine.text;
  EXPECT_THAT(fine.text, Not(HasSubstr("P120")));
  const ProtectionReport off = assess5xxe(0.0);
  EXPECT_EQ(Level::kWarning, off.level);
  EXPECT_THAT(off.text, HasSubstr("P513 = 0: the inverter does not notice a bus module that fails"));
  EXPECT_THAT(off.text, Not(HasSubstr("P120")));
  EXPECT_EQ(Level::kError, assess5xxe(-0.1).level);
  const ProtectionReport unknown = assess5xxe(std::nullopt);
  EXPECT_EQ(Level::kWarning, unknown.level);
  EXPECT_THAT(unknown.text, HasSubstr("P513, by which the inverter watches its bus module, is not known"));
  const ProtectionReport sk54xe =
      assess(identity(TimeoutOwner::kModule), behindModule(0.3, 0), 0.5, profile::Series::kSk54xe);
  EXPECT_THAT(sk54xe.text, HasSubstr("P120 = 0"));
}

// P513: E10.0 in the tables of SK 300E, 7x0E (BU 0020 8.1) and SK 1x0E, 2xxE (BU 0220 6.2.1); for SK 5xxE BU 2700 8.3 has
// E10.3 and BU 0020 8.1 E10.0. P151 is E10.3 (BU 2700 8.3).
TEST(DriveProtection, TheFaultOfATimeoutIsThatOfSeriesAndOwner) {
  const std::pair<profile::Series, const char*> kOfP513[] = {
      {profile::Series::kSk1x0e, "E10.0"}, {profile::Series::kSk2xxe, "E10.0"}, {profile::Series::kSk300e, "E10.0"},
      {profile::Series::kSk700e, "E10.0"}, {profile::Series::kSk750e, "E10.0"}, {profile::Series::kSk5xxe, "E10"},
      {profile::Series::kSk54xe, "E10"}};
  for (const auto& [series, fault] : kOfP513) {
    const std::string expected = std::string("the inverter trips ") + fault + " and the motor coasts";
    EXPECT_EQ("P513 of 0.3 s: " + expected,
              assess(identity(TimeoutOwner::kInverter, "", 0.0), withP513(0.3), 0.5, series).text)
        << profile::toString(series);
    EXPECT_THAT(assess(identity(TimeoutOwner::kModule), behindModule(0.3, 1), 0.5, series).text,
                HasSubstr("P151 of the bus module of 0.3 s: the inverter trips E10.3 and the motor coasts"));
  }
}

// A bus without a watchdog of its own leaves all to the drive's time-out.
TEST(DriveProtection, WithoutAWatchdogOnTheBusTheDrivesOwnTimeoutMustAct) {
  const DriveIdentity bare = identity(TimeoutOwner::kInverter, "", 0.0);
  EXPECT_EQ(Level::kFine, assess(bare, withP513(0.3)).level);
  EXPECT_THAT(assess(bare, withP513(0.3)).text, StartsWith("P513 of 0.3 s"));
  EXPECT_EQ(Level::kError, assess(bare, withP513(0.0)).level);
  EXPECT_EQ(Level::kWarning, assess(bare, withP513(std::nullopt)).level);
}

// Nobody will ever know: what stops the drive has to be configured.
TEST(DriveProtection, WithoutAWatchdogAndWithoutAParameterChannelNothingIsKnownToStopIt) {
  DriveIdentity bare = identity(TimeoutOwner::kInverter, "", 0.0);
  bare.parameter_channel = "none";
  const ProtectionReport report = assess(bare, withP513(std::nullopt));
  EXPECT_EQ(Level::kError, report.level);
  EXPECT_EQ("nothing that is known: the bus watches nothing, and there is no parameter channel to read P513 by",
            report.text);
  DriveIdentity watched = identity();
  watched.parameter_channel = "none";
  EXPECT_EQ(Level::kWarning, assess(watched, withP513(std::nullopt)).level);
}

// A robot must not drive on for longer without a computer than without a command.
TEST(DriveProtection, LaterThanCmdVelTimeoutIsWarnedAbout) {
  EXPECT_EQ(Level::kFine, assess(identity(), withP513(0.0), 0.2).level);
  const ProtectionReport late = assess(identity(), withP513(0.0), 0.1);
  EXPECT_EQ(Level::kWarning, late.level);
  EXPECT_THAT(late.text, HasSubstr("0.2 s after the last telegram, later than cmd_vel_timeout (0.1 s)"));
  EXPECT_EQ(Level::kFine, assess(identity(), withP513(0.1), 0.1).level) << "the earlier one counts";
  EXPECT_EQ(Level::kFine, assess(identity(), withP513(0.0), 0.0).level) << "no time-out to compare with";
  EXPECT_EQ(Level::kWarning, assess(identity(TimeoutOwner::kInverter, "", 0.0), withP513(2.0)).level);
  EXPECT_EQ(Level::kFine, assess(identity(TimeoutOwner::kInverter, "guarding", 0.0), withP513(0.0)).level)
      << "when it acts is not known";
}

// P151 at least twice the bus cycle (BU 0220 4.2.3.2).
TEST(DriveProtection, ShorterThanTwoCyclesIsWarnedAbout) {
  EXPECT_EQ(Level::kFine, assess(identity(TimeoutOwner::kModule), behindModule(0.02, 1)).level);
  const ProtectionReport report = assess(identity(TimeoutOwner::kModule), behindModule(0.019, 1));
  EXPECT_EQ(Level::kWarning, report.level);
  EXPECT_THAT(report.text, HasSubstr("shorter than two bus cycles: it trips without a reason (BU 0220 4.2.3.2)"));
}

// Not each cycle has a telegram.
TEST(DriveProtection, ShorterThanTwoPausesIsWarnedAbout) {
  DriveIdentity cyclic = identity(TimeoutOwner::kModule);
  cyclic.longest_pause = 0.1;
  EXPECT_EQ(Level::kFine, assess(cyclic, behindModule(0.2, 1)).level);
  const ProtectionReport report = assess(cyclic, behindModule(0.199, 1));
  EXPECT_EQ(Level::kWarning, report.level);
  EXPECT_THAT(report.text, HasSubstr("shorter than two pauses between telegrams, which may be 0.1 s long each"));
}

// Its end takes no word away, and on PROFIBUS and CANopen no transport protects a drive then (safety.md, "Looking on").
TEST(DriveProtection, ANodeThatLooksOnHasNothingToBeStopped) {
  DriveIdentity gateway = identity(TimeoutOwner::kInverter, "", 0.0);
  gateway.timeout_notices = false;
  for (const auto p513 : {std::optional<double>{}, std::optional<double>{0.0}, std::optional<double>{-0.1}}) {
    for (const DriveIdentity& of :
         {identity(TimeoutOwner::kInverter, ""), identity(TimeoutOwner::kModule, ""), gateway}) {
      const ProtectionReport report = assessLookingOn(of, withP513(p513));
      EXPECT_EQ(Level::kFine, report.level);
      EXPECT_EQ("this node looks on and commands nothing", report.text);
    }
  }
  EXPECT_EQ(Level::kFine, assessLookingOn(gateway, withP513(0.5)).level) << "no words are written to a gateway";
  DriveIdentity foreign = identity(TimeoutOwner::kInverter, "");
  foreign.nord_profile = false;
  EXPECT_EQ(Level::kFine, assessLookingOn(foreign, withP513(0.5)).level) << "it has no word that is ignored";
}

// BU 2700 7.1.1: a control word without bit 10 throughout trips where P513, or P151 of the module, is above 0.
TEST(DriveProtection, ATimeoutTripsOnTheWordsOfANodeThatLooksOn) {
  const ProtectionReport inverter = assessLookingOn(identity(TimeoutOwner::kInverter, ""), withP513(0.5));
  EXPECT_EQ(Level::kWarning, inverter.level);
  EXPECT_EQ(
      "this node looks on and commands nothing; P513 of 0.5 s: by its words 0000 the inverter trips E10.0 and the "
      "motor "
      "coasts; set it to 0 while it looks on",
      inverter.text);
  const ProtectionReport module = assessLookingOn(identity(TimeoutOwner::kModule, ""), behindModule(0.3, 0));
  EXPECT_EQ(Level::kWarning, module.level);
  EXPECT_THAT(module.text, HasSubstr("P151 of the bus module of 0.3 s: by its words 0000 the inverter trips E10.3"));
}

}  // namespace
}  // namespace nord_driver::node
