// The adapter is pulled out at any telegram of a restore, and the program is gone: the next run goes on or takes back.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "system/restored_drive.h"
#include "tools/parameter_name.h"
#include "tools/restore/restore_run.h"

namespace nord_driver::test {
namespace {

using tools::ChangeState;
using tools::RestoreEnd;
using tools::RestoreRecord;

struct Setting {
  unsigned number, set, element;
  std::int32_t wanted;
};

// Of an SK 5xxE: plain, in sets, in an array, motion and process data; all differ from the factory setting.
const Setting kSettings[] = {{102, 0, 0, 250}, {102, 1, 0, 300}, {103, 0, 0, 400}, {104, 0, 0, 20},
                             {105, 0, 0, 600}, {105, 3, 0, 700}, {420, 0, 0, 1},   {480, 0, 2, 11},
                             {506, 0, 0, 7},   {510, 0, 1, 4},   {546, 1, 0, 5}};

tools::Dump wanted() {
  tools::Dump dump;
  for (const Setting& setting : kSettings) {
    catalogue::ParameterAddress address;
    address.number = static_cast<std::uint16_t>(setting.number);
    const bool sets = setting.number < 200 || setting.number == 546;
    const bool array = setting.number == 480 || setting.number == 510;
    if (sets) address.parameter_set = static_cast<std::uint8_t>(setting.set + 1);
    if (array) address.index = static_cast<std::uint8_t>(setting.element + 1);
    dump.values.push_back({address, setting.wanted});
  }
  return dump;
}

std::vector<std::int32_t> valuesOf(RestoredDrive& drive) {
  std::vector<std::int32_t> values;
  for (const Setting& setting : kSettings) {
    values.push_back(drive.unit().parameters().value(setting.number, setting.set, setting.element));
  }
  return values;
}

std::vector<std::int32_t> wantedValues() {
  std::vector<std::int32_t> values;
  for (const Setting& setting : kSettings) values.push_back(setting.wanted);
  return values;
}

class Breaks {
 public:
  Breaks(const std::string& bus, const std::string& drive, bool ram_orders)
      : drive_(bus, drive, ram_orders), factory_(valuesOf(drive_)) {}

  RestoredDrive& drive() { return drive_; }
  const std::vector<std::int32_t>& factory() const { return factory_; }

  void plan(bool persistent, const tools::Dump& dump = wanted()) {
    tools::ParameterLink& link = drive_.begin();
    tools::RestoreOptions options;
    options.persistent = persistent;
    record_ = recordOf(planRestore(link, dump, options, drive_.notAsked()), link, "left.yaml", persistent);
    ASSERT_EQ(std::size(kSettings), record_.changes.size());
    kept_ = recordText(record_);
  }
  /// How it ends; nothing: it broke off, in words.
  std::optional<RestoreEnd> write() {
    tools::RestoreRun run{drive_.link(), record_, [this](const RestoreRecord& record) { kept_ = recordText(record); },
                          drive_.notAsked()};
    try {
      return run.write();
    } catch (const tools::Trouble& trouble) {
      EXPECT_THAT(trouble.what(), ::testing::HasSubstr("--resume goes on"));
      return std::nullopt;
    }
  }
  RestoreEnd goOn(bool take_back) {
    record_ = tools::recordFrom(kept_, "kept");
    tools::ParameterLink& link = drive_.begin();
    tools::RestoreRun run{link, record_, [this](const RestoreRecord& record) { kept_ = recordText(record); },
                          drive_.notAsked()};
    if (take_back) return run.takeBack();
    run.lookAgain();
    return run.write();
  }
  /// What is in the drive and was not there before is in the journal as begun at least.
  void expectNothingUnnoticed() {
    const RestoreRecord kept = tools::recordFrom(kept_, "kept");
    const std::vector<std::int32_t> now = valuesOf(drive_);
    const tools::Dump dump = wanted();
    for (std::size_t i = 0; i < now.size(); ++i) {
      if (now[i] == factory_[i]) continue;
      EXPECT_EQ(kSettings[i].wanted, now[i]);
      for (const RestoreRecord::Change& change : kept.changes) {
        if (tools::parameterName(change.address) != tools::parameterName(dump.values[i].address)) continue;
        EXPECT_NE(ChangeState::kPending, change.state) << tools::parameterName(change.address);
        EXPECT_EQ(factory_[i], change.before);
      }
    }
  }
  /// Telegrams of a run that is not disturbed.
  unsigned telegramsOfARun(bool persistent) {
    plan(persistent);
    drive_.cut().set(CutAfter::kNever);
    EXPECT_EQ(RestoreEnd::kVerified, write().value_or(RestoreEnd::kDiffers));
    return drive_.cut().sent();
  }

 private:
  RestoredDrive drive_;
  std::vector<std::int32_t> factory_;
  RestoreRecord record_;
  std::string kept_;
};

/// One break: where, and what happens then, by the seed.
void breakOnce(const std::string& bus, const std::string& drive, unsigned seed, unsigned telegrams, unsigned& broken) {
  SCOPED_TRACE(bus + ", seed " + std::to_string(seed));
  std::mt19937 random{seed};
  const bool ram_orders = random() % 2 == 0, persistent = random() % 4 == 0, take_back = random() % 3 == 0,
             by_chance = random() % 4 == 0;
  // A CANopen node that is left operational goes on sending, and nord_param keeps off its bus until it was off.
  const bool switched_off = by_chance || bus == "canopen";
  Breaks breaks{bus, drive, ram_orders};
  breaks.plan(persistent);
  breaks.drive().cut().set(1 + static_cast<unsigned>(random() % telegrams));
  const std::optional<RestoreEnd> end = breaks.write();
  broken += end ? 0 : 1;
  breaks.drive().end();
  breaks.drive().plugAdapterIn();
  breaks.expectNothingUnnoticed();
  breaks.drive().run(std::chrono::seconds{3});
  if (switched_off) breaks.drive().switchOffAndOn();
  const RestoreEnd after = breaks.goOn(take_back);
  EXPECT_EQ(take_back ? RestoreEnd::kTakenBack : RestoreEnd::kVerified, after);
  EXPECT_EQ(take_back ? breaks.factory() : wantedValues(), valuesOf(breaks.drive()));
  EXPECT_EQ(1, breaks.drive().unit().parameters().value(560));
  if (persistent) {
    breaks.drive().unit().parameters().restoreFromEeprom();
    EXPECT_EQ(take_back ? breaks.factory() : wantedValues(), valuesOf(breaks.drive()));
  }
}

void breakOften(const std::string& bus, const std::string& drive, unsigned runs) {
  unsigned telegrams = 0;
  {
    Breaks whole{bus, drive, false};
    telegrams = whole.telegramsOfARun(false);
  }
  ASSERT_GT(telegrams, 50u);
  unsigned broken = 0;
  for (unsigned seed = 1; seed <= runs && !::testing::Test::HasFailure(); ++seed) {
    breakOnce(bus, drive, seed, telegrams, broken);
  }
  EXPECT_GT(broken, runs / 3) << "most of them are shorter than the one that was counted";
  ::testing::Test::RecordProperty("broken", static_cast<int>(broken));
}

TEST(RestoreBreaks, OnProfibusAtAnyTelegram) {
  breakOften("profibus_dp", "address: 3, series: sk5xxe, ppo_type: 1", 200);
}

TEST(RestoreBreaks, OnCanopenAtAnyFrame) {
  breakOften("canopen", "address: 3, series: sk5xxe", 60);
}

TEST(RestoreBreaks, OnDevicenetAtAnyFrame) {
  breakOften("devicenet", "address: 5, series: sk5xxe, assembly: 100", 60);
}

// The drive refuses one in the middle, whose limits the catalogue does not know: what was written before it is taken
// back.
TEST(RestoreBreaks, ARefusalIsTakenBack) {
  for (const bool persistent : {false, true}) {
    for (const bool ram_orders : {false, true}) {
      Breaks breaks{"profibus_dp", "address: 3, series: sk5xxe, ppo_type: 1", ram_orders};
      tools::Dump dump = wanted();
      for (tools::Dump::Value& value : dump.values) {
        if (value.address.number == 104) value.raw = 30000;
      }
      breaks.plan(persistent, dump);
      EXPECT_EQ(RestoreEnd::kTakenBack, breaks.write().value_or(RestoreEnd::kVerified));
      EXPECT_EQ(breaks.factory(), valuesOf(breaks.drive()));
      EXPECT_EQ(1, breaks.drive().unit().parameters().value(560));
    }
  }
}

}  // namespace
}  // namespace nord_driver::test
