#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>

#include "interbus/image_map.h"

namespace nord_driver::interbus {
namespace {

DriveImage drive(const std::string& name, unsigned position, unsigned ppo_type = 1,
                 ValueOrder order = ValueOrder::kInOrder) {
  DriveImage image;
  image.name = name;
  image.position = position;
  image.ppo_type = ppo_type;
  image.value_order = order;
  return image;
}

ImageSettings settings(std::vector<DriveImage> drives) {
  ImageSettings made;
  made.drives = std::move(drives);
  return made;
}

ImageMap map(const ImageSettings& from) {
  std::string reason;
  auto made = ImageMap::make(from, reason);
  EXPECT_TRUE(made) << reason;
  return made.value();
}

std::string refusal(const ImageSettings& from) {
  std::string reason;
  EXPECT_FALSE(ImageMap::make(from, reason));
  return reason;
}

RegisterImage image(std::initializer_list<Word> words) {
  return RegisterImage{words};
}

RegisterImage put(const ImageMap& where, std::size_t which, const ProcessWords& words) {
  RegisterImage outputs;
  outputs.resize(where.outputWords());
  for (Word& word : outputs) word = 0xEEEE;
  where.put(which, words, outputs);
  return outputs;
}

// --- Where the words lie ---

TEST(ImageMap, DrivesFollowEachOtherByTheirPlaceInTheRing) {
  const ImageMap here = map(settings({drive("right", 4, 2), drive("left", 2), drive("lift", 9)}));
  EXPECT_EQ((WordRange{2, 4}), here.outputs(0));
  EXPECT_EQ((WordRange{0, 2}), here.outputs(1));
  EXPECT_EQ((WordRange{6, 2}), here.inputs(2));
  EXPECT_EQ(8u, here.outputWords());
  EXPECT_EQ(8u, here.inputWords());
}

// BU 0070 4.2.1: three words of which the first is the parameter channel.
TEST(ImageMap, WithThePcpWordEachDriveHasOneMore) {
  ImageSettings with = settings({drive("left", 1), drive("right", 2, 2)});
  with.pcp_word = true;
  const ImageMap here = map(with);
  EXPECT_EQ((WordRange{0, 3}), here.outputs(0));
  EXPECT_EQ((WordRange{3, 5}), here.inputs(1));
  EXPECT_EQ((std::vector<std::uint16_t>{1, 4}), here.controlWords());
}

TEST(ImageMap, AnOffsetMovesTheDrivesBehindIt) {
  ImageSettings with = settings({drive("left", 1), drive("right", 2), drive("lift", 3)});
  with.drives[1].output_offset = 10;
  const ImageMap here = map(with);
  EXPECT_EQ((WordRange{10, 2}), here.outputs(1));
  EXPECT_EQ((WordRange{12, 2}), here.outputs(2));
  EXPECT_EQ((WordRange{2, 2}), here.inputs(1));
}

// --- Words ---

// BU 0070 7.1 and 7.2, the telegrams as printed (bytes 9 to 12).
TEST(ImageMap, LiteralTelegrams) {
  const ImageMap here = map(settings({drive("left", 1)}));
  EXPECT_EQ(image({0x047E, 0x0000}), put(here, 0, {0x047E, {}}));
  EXPECT_EQ(image({0x047F, 0x2000}), put(here, 0, {0x047F, {0x2000, 0, 0}}));
  EXPECT_EQ((ProcessWords{0x0B70, {}}), here.get(0, image({0x0B70, 0x0000})));
  EXPECT_EQ((ProcessWords{0x0B31, {}}), here.get(0, image({0x0B31, 0x0000})));
  EXPECT_EQ((ProcessWords{0x0F37, {0x2000, 0, 0}}), here.get(0, image({0x0F37, 0x2000})));
}

// BU 0070 4.2.2: control word, setpoint 1, setpoint 3, setpoint 2.
TEST(ImageMap, Ppo2PutsTheThirdValueBeforeTheSecond) {
  const ImageMap here = map(settings({drive("left", 1, 2, ValueOrder::kThreeBeforeTwo)}));
  EXPECT_EQ(image({0x047F, 0x1111, 0x3333, 0x2222}), put(here, 0, {0x047F, {0x1111, 0x2222, 0x3333}}));
  EXPECT_EQ((ProcessWords{0x0B37, {1, 2, 3}}), here.get(0, image({0x0B37, 1, 3, 2})));
}

// BU 0070 6.1.5, the notice on SK 5xxE.
TEST(ImageMap, Ppo2OfSk5xxeIsInOrder) {
  const ImageMap here = map(settings({drive("left", 1, 2)}));
  EXPECT_EQ(image({0x047F, 0x1111, 0x2222, 0x3333}), put(here, 0, {0x047F, {0x1111, 0x2222, 0x3333}}));
  EXPECT_EQ((ProcessWords{0x0B37, {1, 2, 3}}), here.get(0, image({0x0B37, 1, 2, 3})));
}

TEST(ImageMap, SwappedBytesAreSwappedBothWays) {
  ImageSettings swapped = settings({drive("left", 1)});
  swapped.byte_order = ByteOrder::kSwapped;
  const ImageMap here = map(swapped);
  EXPECT_EQ(image({0x7F04, 0x0020}), put(here, 0, {0x047F, {0x2000, 0, 0}}));
  EXPECT_EQ((ProcessWords{0x0B31, {0x1234, 0, 0}}), here.get(0, image({0x310B, 0x3412})));
  EXPECT_EQ(0x7F00, here.runBits());
}

// An order of the parameter channel nobody gave would be one.
TEST(ImageMap, ThePcpWordIsWrittenAsZero) {
  ImageSettings with = settings({drive("left", 1)});
  with.pcp_word = true;
  const ImageMap here = map(with);
  EXPECT_EQ(image({0x0000, 0x047E, 0x0000}), put(here, 0, {0x047E, {}}));
  EXPECT_EQ((ProcessWords{0x0B31, {7, 0, 0}}), here.get(0, image({0xDEAD, 0x0B31, 7})));
}

TEST(ImageMap, ADriveTouchesItsOwnWordsOnly) {
  const ImageMap here = map(settings({drive("left", 1), drive("right", 2), drive("lift", 3)}));
  EXPECT_EQ(image({0xEEEE, 0xEEEE, 0x047E, 0x0000, 0xEEEE, 0xEEEE}), put(here, 1, {0x047E, {}}));
}

// Words behind the end of an image are somebody else's memory.
TEST(ImageMap, NothingIsPutIntoAnImageThatIsTooShort) {
  const ImageMap here = map(settings({drive("left", 1), drive("right", 2)}));
  RegisterImage outputs = image({0xEEEE, 0xEEEE, 0xEEEE});
  here.put(1, {0x047E, {}}, outputs);
  EXPECT_EQ(image({0xEEEE, 0xEEEE, 0xEEEE}), outputs);
  here.put(0, {0x047E, {}}, outputs);
  EXPECT_EQ(image({0x047E, 0x0000, 0xEEEE}), outputs);
}

// A gateway that has said nothing yet: no drive there, and not the zeros of somebody's memory.
TEST(ImageMap, AnImageThatIsTooShortHasNoDriveInIt) {
  const ImageMap here = map(settings({drive("left", 1), drive("right", 2)}));
  EXPECT_EQ((ProcessWords{0, {0, 0, 0}}), here.get(1, image({0x0B31, 0x0000, 0x0B31})));
  EXPECT_EQ(0x0B31, here.get(0, image({0x0B31, 0x0000, 0x0B31})).head);
}

TEST(ImageMap, AWordBehindADriveIsNobodys) {
  ImageSettings with = settings({drive("left", 1), drive("right", 2)});
  with.drives[1].input_offset = 5;
  const ImageMap here = map(with);
  EXPECT_EQ(WordKind::kHead, here.inputMeaning(0).kind);
  EXPECT_EQ(WordKind::kValue, here.inputMeaning(1).kind);
  EXPECT_EQ(WordKind::kNobodys, here.inputMeaning(2).kind);
  EXPECT_EQ(WordKind::kNobodys, here.inputMeaning(4).kind);
  EXPECT_EQ(WordKind::kHead, here.inputMeaning(5).kind);
}

// BU 0070 4.2.2: PCP word, status word, actual values 1, 3 and 2.
TEST(ImageMap, EachWordHasItsMeaning) {
  ImageSettings with = settings({drive("left", 1), drive("right", 2, 2, ValueOrder::kThreeBeforeTwo)});
  with.pcp_word = true;
  const ImageMap here = map(with);
  const auto meaning = [&](std::size_t word) {
    const WordMeaning of = here.inputMeaning(word);
    const char* const kind = of.kind == WordKind::kPcp     ? "pcp "
                             : of.kind == WordKind::kHead  ? "head "
                             : of.kind == WordKind::kValue ? "value "
                                                           : "nobody's ";
    return kind + std::to_string(of.drive) + " " + std::to_string(of.value);
  };
  std::vector<std::string> all;
  for (std::size_t word = 0; word <= here.inputWords(); ++word) all.push_back(meaning(word));
  EXPECT_EQ((std::vector<std::string>{"pcp 0 0", "head 0 0", "value 0 1", "pcp 1 0", "head 1 0", "value 1 1",
                                      "value 1 3", "value 1 2", "nobody's 0 0"}),
            all);
}

TEST(ImageMap, WordsAreTheSameWhereEachIs) {
  const ProcessWords words{1, {2, 3, 4}};
  EXPECT_TRUE((words == ProcessWords{1, {2, 3, 4}}));
  EXPECT_FALSE((words == ProcessWords{9, {2, 3, 4}}));
  EXPECT_FALSE((words == ProcessWords{1, {9, 3, 4}}));
  EXPECT_FALSE((words == ProcessWords{1, {2, 9, 4}}));
  EXPECT_FALSE((words == ProcessWords{1, {2, 3, 9}}));
}

// --- Parts ---

TEST(ImageMap, OneRequestCarriesWhatFits) {
  std::vector<DriveImage> drives;
  for (unsigned i = 0; i < 31; ++i) drives.push_back(drive("d" + std::to_string(i), i + 1, 2));
  const ImageMap here = map(settings(drives));  // 124 words
  EXPECT_EQ((std::vector<WordRange>{{0, 124}}), here.inputParts(125));
  EXPECT_EQ((std::vector<WordRange>{{0, 124}}), here.inputParts(124));
  EXPECT_EQ((std::vector<WordRange>{{0, 120}, {120, 4}}), here.outputParts(123));
}

// The words before the first drive belong to other devices and stay out of it.
TEST(ImageMap, APartBeginsWithADrive) {
  ImageSettings with = settings({drive("left", 1), drive("right", 2)});
  with.drives[0].output_offset = 8;
  with.drives[1].output_offset = 200;
  const ImageMap here = map(with);
  EXPECT_EQ((std::vector<WordRange>{{8, 2}, {200, 2}}), here.outputParts(123));
  EXPECT_TRUE(here.unclaimedOutputs(123).empty());
}

TEST(ImageMap, OutputsOfOthersBetweenTwoDrivesAreNamed) {
  ImageSettings with = settings({drive("left", 1), drive("right", 2)});
  with.drives[1].output_offset = 5;
  EXPECT_EQ((std::vector<WordRange>{{2, 3}}), map(with).unclaimedOutputs(123));
}

RC_GTEST_PROP(ImageMap, EveryDriveLiesInExactlyOnePart, ()) {
  std::vector<DriveImage> drives;
  const auto count = *rc::gen::inRange<unsigned>(1, 51);
  for (unsigned i = 0; i < count; ++i) {
    drives.push_back(drive("d" + std::to_string(i), i + 1, *rc::gen::inRange<unsigned>(1, 3)));
  }
  ImageSettings with = settings(drives);
  with.pcp_word = *rc::gen::arbitrary<bool>();
  const ImageMap here = map(with);
  const auto most = *rc::gen::inRange<std::size_t>(5, 126);
  const auto parts = here.outputParts(most);
  for (const WordRange& part : parts) RC_ASSERT(part.count <= most);
  for (std::size_t i = 0; i < here.drives(); ++i) {
    int times = 0;
    for (const WordRange& part : parts) {
      if (here.outputs(i).first >= part.first && here.outputs(i).end() <= part.end()) ++times;
    }
    RC_ASSERT(times == 1);
  }
}

// What is put for one drive comes back as it was, whatever the map.
RC_GTEST_PROP(ImageMap, WordsComeBackAsTheyWerePut, ()) {
  ImageSettings with = settings({drive("a", 1, *rc::gen::inRange<unsigned>(1, 3),
                                       *rc::gen::element(ValueOrder::kInOrder, ValueOrder::kThreeBeforeTwo)),
                                 drive("b", 2, 2, ValueOrder::kThreeBeforeTwo)});
  with.pcp_word = *rc::gen::arbitrary<bool>();
  with.byte_order = *rc::gen::element(ByteOrder::kAsIs, ByteOrder::kSwapped);
  const ImageMap here = map(with);
  ProcessWords words{*rc::gen::arbitrary<Word>(), {*rc::gen::arbitrary<Word>(), 0, 0}};
  if (with.drives[0].ppo_type == 2) words.values = {words.values[0], *rc::gen::arbitrary<Word>(), 0x55AA};
  RC_ASSERT(here.get(0, put(here, 0, words)) == words);
}

// --- What is refused, with figures ---

TEST(ImageMap, OverlappingWordsAreRefused) {
  ImageSettings with = settings({drive("left", 1), drive("right", 2)});
  with.drives[1].output_offset = 1;
  EXPECT_EQ(
      "drives/right: its output words 1 to 2 lie in those of left, 0 to 1; expected output_offset 2 or higher, or one "
      "that ends before",
      refusal(with));
}

TEST(ImageMap, OfTwoDrivesAtOneOffsetTheLaterIsNamed) {
  ImageSettings with = settings({drive("left", 1), drive("right", 2)});
  with.drives[1].output_offset = 0;
  EXPECT_EQ(
      "drives/right: its output words 0 to 1 lie in those of left, 0 to 1; expected output_offset 2 or higher, or one "
      "that ends before",
      refusal(with));
}

TEST(ImageMap, AnOffsetInsideAnotherDrivesWordsIsRefused) {
  ImageSettings with = settings({drive("left", 1, 2), drive("right", 2)});
  with.drives[1].input_offset = 3;
  EXPECT_EQ(
      "drives/right: its input words 3 to 4 lie in those of left, 0 to 3; expected input_offset 4 or higher, or one "
      "that ends before",
      refusal(with));
}

TEST(ImageMap, TwoDrivesAtOnePlaceOfTheRingAreRefused) {
  EXPECT_EQ("drives/right/address: 3 is also that of left, expected a position in the ring of its own",
            refusal(settings({drive("left", 3), drive("right", 3)})));
  EXPECT_EQ("drives/right/address: 3 is also that of left, expected a position in the ring of its own",
            refusal(settings({drive("lift", 4), drive("left", 3), drive("right", 3), drive("fork", 1)})));
}

TEST(ImageMap, AnImageInterBusCannotCarryIsRefused) {
  ImageSettings with = settings({drive("left", 1)});
  with.drives[0].input_offset = 255;
  EXPECT_EQ(
      "drives/left: its 2 input words begin at word 255 of the image, expected all within the 256 words InterBus "
      "carries (0 to 255)",
      refusal(with));
  with.drives[0].input_offset = 4294967295u;
  EXPECT_NE(std::string::npos, refusal(with).find("begin at word 4294967295 of the image"));
  with.drives[0].input_offset = 254;
  map(with);
}

TEST(ImageMap, RegistersBeyondTheLastAreRefused) {
  ImageSettings with = settings({drive("left", 1)});
  with.output_address = 65535;
  EXPECT_EQ("bus/outputs/address: the image from register 65535 on ends at register 65536, expected at most 65535",
            refusal(with));
}

TEST(ImageMap, PpoTypesThreeAndFourAreRefused) {
  EXPECT_EQ(
      "drives/left/ppo_type: 3, expected 1 (control word and setpoint 1) or 2 (and setpoints 2 and 3); InterBus has no "
      "others",
      refusal(settings({drive("left", 1, 3)})));
}

TEST(ImageMap, APlaceOutsideTheRingIsRefused) {
  EXPECT_EQ("drives/left/address: 0, expected a position in the ring from 1 to 254",
            refusal(settings({drive("left", 0)})));
  EXPECT_EQ("drives/left/address: 255, expected a position in the ring from 1 to 254",
            refusal(settings({drive("left", 255)})));
  std::string reason;
  for (const unsigned position : {1u, 254u}) EXPECT_TRUE(ImageMap::make(settings({drive("left", position)}), reason));
}

TEST(ImageMap, NoDriveIsRefused) {
  EXPECT_EQ("drives: none, expected at least one", refusal(settings({})));
}

}  // namespace
}  // namespace nord_driver::interbus
