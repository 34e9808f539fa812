// Under which name a drive's EEPROM writes are counted, and what a write without an answer leaves.
#include <gtest/gtest.h>

#include <memory>
#include <optional>

#include "support/map_settings.h"
#include "support/temporary_folder.h"
#include "tools/counted_write.h"

namespace nord_driver::tools {
namespace {

std::string countedAs(const std::string& series) {
  const test::MapSettings settings{"drives/left/", {{"address", 3}, {"series", series}}};
  return state::nameOf(placeOf("/dev/ttyUSB0", "profibus_dp", {"left", std::make_shared<test::MapSettings>(settings)}));
}

// One drive has one budget, however its series is written: as the series or as on the nameplate.
TEST(CountedWrite, EverySpellingOfASeriesHasOneCount) {
  const std::string name = "/dev/ttyUSB0, address 3, inverter 1, sk5xxe";
  for (const char* series : {"sk5xxe", "SK5xxE", "sk535e", "SK 535E", "SK 535E-750-340-A"}) {
    EXPECT_EQ(name, countedAs(series)) << series;
  }
  EXPECT_EQ("/dev/ttyUSB0, address 3, inverter 1, sk54xe", countedAs("SK 540E-750-340-A"));
}

// With a budget that is used up the RAM goes on being written, though one answer was late, or none came.
TEST(CountedWrite, AWriteToRamWithoutAnswerDoesNotEndThoseAfterIt) {
  const test::TemporaryFolder folder;
  const state::EepromBudget budget{folder.path("counts.yaml"), 0};
  profile::ParameterRequest ram;
  ram.number = 102;
  ram.action = profile::ParameterAction::kWriteRam;
  for (const bool broker_answers : {true, false}) {
    state::DriveEeprom eeprom{budget, {"can0", 5, 1, "sk5xxe"}, "left", true};
    const auto write = [&](const std::optional<cycle::Completion>& completion) {
      return countedWrite(eeprom, ram, [&] { return completion; }).refusal;
    };
    cycle::Completion late;
    late.unanswered = true;
    late.parameter.eeprom_written = true;
    EXPECT_EQ("", write(broker_answers ? std::optional<cycle::Completion>{late} : std::nullopt));
    cycle::Completion good;
    good.success = true;
    EXPECT_EQ("", write(good)) << broker_answers;
  }
}

}  // namespace
}  // namespace nord_driver::tools
