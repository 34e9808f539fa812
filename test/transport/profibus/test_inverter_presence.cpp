#include <gtest/gtest.h>

#include "transport/profibus/inverter_presence.h"

namespace nord_driver {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Instant kStart{seconds{100}};
constexpr std::array<bool, 4> kAllUseful{true, true, true, true};
constexpr std::array<std::uint8_t, 4> kNumbers{1, 2, 3, 4};

// A status word of zeros is an inverter that is off (BU 0020 2.1.3); the others behind the module live on.
TEST(InverterPresence, ZerosAreAnInverterThatIsOff) {
  InverterPresence presence{4, true};
  presence.handleExchange(false, {true, false, true, true}, kStart);
  EXPECT_TRUE(presence.answers(0));
  EXPECT_FALSE(presence.answers(1));
  presence.handleExchange(true, {true, false, true, true}, kStart);
  EXPECT_TRUE(presence.answers(0)) << "the diagnosis 02 04 is explained by the zeros";
  EXPECT_FALSE(presence.wantsModuleStatus(kStart));
}

// A module that fell silent took everything known of its inverters with it.
TEST(InverterPresence, NothingIsKeptOverALoss) {
  InverterPresence presence{4, true};
  presence.handleExchange(true, kAllUseful, kStart);
  presence.handleModuleStatus(0xAA02, kNumbers);  // all online
  ASSERT_TRUE(presence.answers(0));
  presence.handleSilence();
  EXPECT_FALSE(presence.answers(0));
  presence.handleExchange(true, kAllUseful, kStart);
  EXPECT_FALSE(presence.answers(0)) << "a broken link again, and P173 not asked yet";
}

// 02 04 behind a module with one inverter: its status word is an old one. The diagnosis is looked at again.
TEST(InverterPresence, ABrokenLinkIsTheOnlyInvertersOwn) {
  InverterPresence presence{1, false};
  presence.handleExchange(true, kAllUseful, kStart);
  EXPECT_FALSE(presence.answers(0));
  EXPECT_TRUE(presence.doubtsDiagnosis(kStart));
  EXPECT_FALSE(presence.doubtsDiagnosis(kStart + milliseconds{249}));
  EXPECT_TRUE(presence.doubtsDiagnosis(kStart + milliseconds{250}));
  presence.handleExchange(false, kAllUseful, kStart);
  EXPECT_TRUE(presence.answers(0));
}

// 02 04 of several, and all words look well: P173 says whose it is; until then none counts.
TEST(InverterPresence, TheModuleSaysWhoseLinkIsBroken) {
  InverterPresence presence{4, true};
  presence.handleExchange(true, kAllUseful, kStart);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_FALSE(presence.answers(i));
  EXPECT_TRUE(presence.wantsModuleStatus(kStart));
  presence.handleModuleStatus(0xAE02, kNumbers);  // 10 10 11 10: FI2 is lost or switched off
  presence.handleExchange(true, kAllUseful, kStart);
  EXPECT_TRUE(presence.answers(0));
  EXPECT_FALSE(presence.answers(1));
  EXPECT_TRUE(presence.answers(2));
  EXPECT_TRUE(presence.answers(3));
  presence.handleExchange(false, kAllUseful, kStart);
  EXPECT_TRUE(presence.answers(1));
  presence.handleExchange(true, kAllUseful, kStart);
  EXPECT_FALSE(presence.answers(0)) << "another break: what P173 said before does not count";
}

// Errors 101 and 102: the module answers for an inverter it does not have. P173 takes it back.
TEST(InverterPresence, AParameterErrorCountsUntilTheModuleKnowsBetter) {
  InverterPresence presence{2, true};
  presence.handleExchange(false, {true, true}, kStart);
  presence.handleAbsence(1, kStart);
  EXPECT_TRUE(presence.answers(0));
  EXPECT_FALSE(presence.answers(1));
  EXPECT_TRUE(presence.wantsModuleStatus(kStart));
  presence.handleModuleStatus(0x0E02, kNumbers);  // FI1 online, FI2 lost
  presence.handleExchange(false, {true, true}, kStart + seconds{10});
  EXPECT_FALSE(presence.answers(1));
  presence.handleModuleStatus(0x0A02, kNumbers);  // both online
  EXPECT_TRUE(presence.answers(1));
}

// P173 can be read by its kind, and is refused or not answered: the parameter error passes all the same, for as long as
// useful status words come.
TEST(InverterPresence, AModuleThatDoesNotTellHoldsNoParameterError) {
  InverterPresence presence{2, true};
  presence.handleExchange(false, {true, true}, kStart);
  presence.handleAbsence(1, kStart);
  for (Instant now = kStart; now < kStart + seconds{5}; now += milliseconds{10}) {
    presence.handleExchange(false, {true, true}, now);
    presence.wantsModuleStatus(now);
    ASSERT_FALSE(presence.answers(1));
  }
  presence.handleExchange(false, {true, true}, kStart + seconds{5});
  EXPECT_TRUE(presence.answers(1));
  EXPECT_FALSE(presence.wantsModuleStatus(kStart + seconds{5}));
  presence.handleAbsence(1, kStart + seconds{20});
  EXPECT_TRUE(presence.wantsModuleStatus(kStart + seconds{20}));
  presence.handleExchange(false, {true, true}, kStart + seconds{22});
  EXPECT_FALSE(presence.answers(1)) << "a new doubt, and a new time to tell";
}

// Told again and again that it is lost, it is; and for so long after the last time.
TEST(InverterPresence, AModuleThatTellsHoldsIt) {
  InverterPresence presence{2, true};
  presence.handleExchange(false, {true, true}, kStart);
  presence.handleAbsence(1, kStart);
  for (Instant now = kStart; now < kStart + seconds{20}; now += milliseconds{500}) {
    presence.handleExchange(false, {true, true}, now);
    ASSERT_FALSE(presence.answers(1));
    EXPECT_TRUE(presence.wantsModuleStatus(now));
    presence.handleModuleStatus(0x0E02, kNumbers);  // FI1 online, FI2 lost
  }
}

// Nobody to ask: the status word counts again after a second.
TEST(InverterPresence, WithoutRecordsAParameterErrorPasses) {
  InverterPresence presence{1, false};
  presence.handleExchange(false, kAllUseful, kStart);
  presence.handleAbsence(0, kStart);
  EXPECT_FALSE(presence.wantsModuleStatus(kStart));
  presence.handleExchange(false, kAllUseful, kStart + milliseconds{999});
  EXPECT_FALSE(presence.answers(0));
  presence.handleExchange(false, kAllUseful, kStart + seconds{1});
  EXPECT_TRUE(presence.answers(0));
}

}  // namespace
}  // namespace nord_driver
