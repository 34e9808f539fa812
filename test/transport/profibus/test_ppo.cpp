#include <gtest/gtest.h>

#include "profile/position_words.h"
#include "transport/profibus/ppo.h"

namespace nord_driver::profile {
namespace {

constexpr PkwWords kPkw{0x744E, 0x0200, 0x0000, 0x03E8};

ProcessOutput output() {
  ProcessOutput out;
  out.control_word = 0x047F;
  out.setpoints = {0x2000, 0x1111, 0x3333};
  return out;
}

FixedBytes<2> identifiers(std::uint8_t type, std::uint16_t ident) {
  return ppoLayout(type, ident, Series::kSk5xxe)->identifiers;
}

/// PPO 4, which is the process data alone; half of P105 as speed where a word carries it.
PpoWords sentTo(Series series, const FunctionCodes& functions, std::int32_t steps) {
  ProcessOutput out;
  out.control_word = 0x047F;
  const PositionWords words = positionWords(series, functions, {}, 3);
  if (words.speed_setpoint) out.setpoints[*words.speed_setpoint] = 0x2000;
  putPosition(words.setpoint, steps, out.setpoints);
  return pack(*ppoLayout(4, 0x0BA8, series), {}, out);
}

// 100.000 revolutions are 0001 86A0h, -0.001 are FFFF FFFFh; the layouts are those of BU 0020 7.3.1 and 7.3.5 and BU 2700
// 5.3 and 6.4.4.
TEST(Ppo, CarriesPositionsAsTheManualsLayThemOut) {
  EXPECT_EQ((PpoWords{0x047F, 0x2000, 0x86A0, 0x0001}), sentTo(Series::kSk2xxe, {1, 23, 24}, 100'000)) << "BU 2700 5.3";
  EXPECT_EQ((PpoWords{0x047F, 0x86A0, 0x0001, 0x2000}), sentTo(Series::kSk5xxe, {21, 22, 1}, 100'000)) << "7.3.5";
  EXPECT_EQ((PpoWords{0x047F, 0xFFFF, 0xFFFF, 0x2000}), sentTo(Series::kSk54xe, {22, 21, 1}, -1));
  EXPECT_EQ((PpoWords{0x047F, 0x0001, 0x86A0, 0x2000}), sentTo(Series::kSk700e, {3, 1, 0}, 100'000))
      << "7.3.1: STW, SW1 of 32 bits, SW2";
  EXPECT_EQ((PpoWords{0x047F, 0x7FFF, 0x0000, 0x2000}), sentTo(Series::kSk700e, {2, 1, 0}, 32'767)) << "16 bits";
  EXPECT_EQ((PpoWords{0x047F, 0x2000, 0x8000, 0x0000}), sentTo(Series::kSk5xxe, {1, 21, 0}, -32'768)) << "6.4.4";
}

// Module ident 7531h: PPO 2 and 4 reserve six words (BU 0020 7.2).
TEST(Ppo, HasTheLengthsOfTheTechnologyUnit) {
  EXPECT_EQ(12u, ppoLayout(1, 0x7531, Series::kSk5xxe)->bytes());
  EXPECT_EQ(20u, ppoLayout(2, 0x7531, Series::kSk5xxe)->bytes());
  EXPECT_EQ(4u, ppoLayout(3, 0x7531, Series::kSk5xxe)->bytes());
  EXPECT_EQ(12u, ppoLayout(4, 0x7531, Series::kSk5xxe)->bytes());
  EXPECT_EQ((FixedBytes<2>{0xF3, 0xF1}), identifiers(1, 0x7531));
  EXPECT_EQ((FixedBytes<2>{0xF3, 0xF5}), identifiers(2, 0x7531));
  EXPECT_EQ((FixedBytes<2>{0xF1}), identifiers(3, 0x7531));
  EXPECT_EQ((FixedBytes<2>{0xF5}), identifiers(4, 0x7531));
}

// Module ident 0BA8h: P182 shows 245, 247, 241, 243 (BU 2700 7.1.4).
TEST(Ppo, HasTheLengthsOfCu4AndTu4) {
  EXPECT_EQ(12u, ppoLayout(1, 0x0BA8, Series::kSk2xxe)->bytes());
  EXPECT_EQ(16u, ppoLayout(2, 0x0BA8, Series::kSk2xxe)->bytes());
  EXPECT_EQ(4u, ppoLayout(3, 0x0BA8, Series::kSk2xxe)->bytes());
  EXPECT_EQ(8u, ppoLayout(4, 0x0BA8, Series::kSk2xxe)->bytes());
  EXPECT_EQ((FixedBytes<2>{245}), identifiers(1, 0x0BA8));
  EXPECT_EQ((FixedBytes<2>{247}), identifiers(2, 0x0BA8));
  EXPECT_EQ((FixedBytes<2>{241}), identifiers(3, 0x0BA8));
  EXPECT_EQ((FixedBytes<2>{243}), identifiers(4, 0x0BA8));
}

TEST(Ppo, KnowsNoOtherTypeOrModule) {
  EXPECT_FALSE(ppoLayout(0, 0x7531, Series::kSk5xxe).has_value());
  EXPECT_FALSE(ppoLayout(5, 0x7531, Series::kSk5xxe).has_value());
  EXPECT_FALSE(ppoLayout(1, 0x0DA5, Series::kSk5xxe).has_value());
}

TEST(Ppo, Packs1AsParameterChannelControlWordAndSetpoint1) {
  const PpoWords expected{0x744E, 0x0200, 0x0000, 0x03E8, 0x047F, 0x2000};
  EXPECT_EQ(expected, pack(*ppoLayout(1, 0x7531, Series::kSk5xxe), kPkw, output()));
}

// BU 0020 7.2.3: STW SW1 SW2 SW3; the reserve words of 7531h are 0.
TEST(Ppo, PacksTheNaturalOrder) {
  const PpoWords with_reserve{0x744E, 0x0200, 0x0000, 0x03E8, 0x047F, 0x2000, 0x1111, 0x3333, 0x0000, 0x0000};
  EXPECT_EQ(with_reserve, pack(*ppoLayout(2, 0x7531, Series::kSk5xxe), kPkw, output()));
  const PpoWords short_one{0x047F, 0x2000, 0x1111, 0x3333};
  EXPECT_EQ(short_one, pack(*ppoLayout(4, 0x0BA8, Series::kSk2xxe), kPkw, output()));
}

// BU 0020 7.2.2: STW SW1 SW3 SW2 on SK 300E, SK 700E and SK 750E, the way back likewise.
TEST(Ppo, PutsTheThirdBeforeTheSecondOnOldSeries) {
  for (const Series series : {Series::kSk300e, Series::kSk700e, Series::kSk750e}) {
    const auto layout = *ppoLayout(4, 0x7531, series);
    const PpoWords expected{0x047F, 0x2000, 0x3333, 0x1111, 0x0000, 0x0000};
    EXPECT_EQ(expected, pack(layout, kPkw, output())) << toString(series);
    PkwWords pkw{1, 2, 3, 4};
    ProcessInput input;
    ASSERT_TRUE(unpack(layout, {0x0B37, 0xE000, 0x0333, 0x0222, 0, 0}, pkw, input));
    EXPECT_EQ((std::array<std::int16_t, 3>{-8192, 0x0222, 0x0333}), input.actual_values);
    EXPECT_EQ((PkwWords{}), pkw);
  }
}

TEST(Ppo, Unpacks1) {
  PkwWords pkw{};
  ProcessInput input;
  input.actual_values = {1, 2, 3};
  ASSERT_TRUE(unpack(*ppoLayout(1, 0x7531, Series::kSk5xxe), {0x444E, 0x0200, 0, 0x03E8, 0x0B37, 0x2000}, pkw, input));
  EXPECT_EQ((PkwWords{0x444E, 0x0200, 0, 0x03E8}), pkw);
  EXPECT_EQ(0x0B37, input.status_word);
  EXPECT_EQ((std::array<std::int16_t, 3>{0x2000, 0, 0}), input.actual_values);
}

TEST(Ppo, UnpacksNothingOfAnotherLength) {
  PkwWords pkw{};
  ProcessInput input;
  EXPECT_FALSE(unpack(*ppoLayout(1, 0x7531, Series::kSk5xxe), {0x0B37, 0x2000}, pkw, input));
  EXPECT_EQ(0, input.status_word);
}

}  // namespace
}  // namespace nord_driver::profile
