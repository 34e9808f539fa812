// A dump of one drive restored into a factory-new one, on every bus and series the simulator has.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "system/restored_drive.h"
#include "tools/comparison.h"
#include "tools/parameter_name.h"
#include "tools/restore/restore_run.h"

namespace nord_driver::test {
namespace {

using ::testing::IsEmpty;
using tools::RestoreStage;

struct Kind {
  const char* bus;
  const char* drive;
  const char* name;
  bool ram_orders;  ///< the bus and the drive have them: nothing reaches the EEPROM
};

void PrintTo(const Kind& kind, std::ostream* out) {
  *out << kind.name;
}

const Kind kKinds[] = {
    {"profibus_dp", "address: 3, series: sk5xxe, ppo_type: 1", "PkwSk5xxe", true},
    {"profibus_dp", "address: 3, series: sk5xxe, ppo_type: 2", "PkwPpo2Sk5xxe", true},
    {"profibus_dp", "address: 3, series: sk54xe, ppo_type: 1", "PkwSk54xe", true},
    {"profibus_dp", "address: 3, series: sk300e, ppo_type: 1", "PkwSk300e", true},
    {"profibus_dp", "address: 3, series: sk700e, ppo_type: 1", "PkwSk700e", true},
    {"profibus_dp", "address: 3, series: sk750e, ppo_type: 1", "PkwSk750e", true},
    {"profibus_dp", "address: 3, series: sk2xxe, ppo_type: 1, inverter: 1", "PkwSk2xxe", true},
    {"profibus_dp", "address: 3, series: sk1x0e, ppo_type: 1, inverter: 1", "PkwSk1x0e", true},
    {"profibus_ms2", "address: 3, series: sk2xxe, inverter: 1", "Ms2Sk2xxe", true},
    {"canopen", "address: 3, series: sk5xxe", "CanopenSk5xxe", false},
    {"canopen", "address: 3, series: sk54xe", "CanopenSk54xe", false},
    {"canopen", "address: 3, series: sk2xxe, connection: gateway, inverter: 1", "CanopenGatewaySk2xxe", false},
    {"canopen", "address: 32, series: sk2xxe, connection: system_bus", "CanopenSystemBusSk2xxe", false},
    {"devicenet", "address: 5, series: sk5xxe, assembly: 100", "DevicenetSk5xxe", false},
    {"devicenet", "address: 5, series: sk54xe, assembly: 100", "DevicenetSk54xe", false},
    {"devicenet", "address: 5, series: sk2xxe, assembly: 100, inverter: 1", "DevicenetSk2xxe", false},
    {"interbus", "address: 1, series: sk5xxe, ppo_type: 1", "PcpSk5xxe", false},
    {"interbus", "address: 1, series: sk700e, ppo_type: 1", "PcpSk700e", false},
};

class RestoreRoundTrip : public ::testing::TestWithParam<Kind> {
 protected:
  /// Every setting that the catalogue knows and that does not decide where the drive is gets another value it may have.
  static std::size_t change(RestoredDrive& drive, const catalogue::DriveCatalogue& known, std::mt19937& random) {
    std::size_t changed = 0;
    for (const sim::ParameterDefinition& definition : sim::parameterDefinitions(drive.unit().config().device)) {
      const catalogue::ParameterEntry* entry = known.find(definition.number);
      // P513 > 0 ends in a fault when a run ends, and P560 decides where writes go.
      if (definition.read_only || entry == nullptr || definition.number == 513 || definition.number == 560) continue;
      if (tools::stageOf(definition.number) == RestoreStage::kReach) continue;
      // No source says how many positions P613 has: what the catalogue does not know is in no dump.
      const unsigned elements = std::min(std::max<unsigned>(definition.elements, 1), entry->elements.value_or(1));
      for (unsigned element = 0; element < elements; ++element) {
        for (unsigned set = 0; set < (definition.per_set ? 4u : 1u); ++set) {
          std::uniform_int_distribution<std::int32_t> any{definition.minimum, definition.maximum};
          for (int i = 0; i < 50; ++i) {
            const std::int32_t raw = any(random);
            if (!entry->takes(raw, element + 1) || raw == definition.factoryOf(element)) continue;
            changed += drive.unit().parameters().preset(definition.number, set, element, raw) ? 1 : 0;
            break;
          }
        }
      }
    }
    return changed;
  }

  static std::vector<std::string> texts(const tools::Differences& differences, const catalogue::DriveCatalogue& known) {
    std::vector<std::string> result;
    for (const auto& difference : differences.found) {
      result.push_back(tools::differenceText(difference, known, "the file", "the drive"));
    }
    return result;
  }
};

TEST_P(RestoreRoundTrip, AFactoryNewDriveBecomesTheSame) {
  const Kind& kind = GetParam();
  std::mt19937 random{7};
  RestoredDrive source{kind.bus, kind.drive};
  const std::string file = source.folder().path("left.yaml");
  std::size_t changed = 0;
  {
    tools::ParameterLink& link = source.begin();
    changed = change(source, link.known(), random);
    source.folder().write("left.yaml", tools::dumpText(tools::takeDump(link, source.notAsked()), link.known(), "left",
                                                       link.identity().address));
    source.finish();
  }
  ASSERT_GT(changed, 20u);

  RestoredDrive target{kind.bus, kind.drive};
  tools::ParameterLink& link = target.begin();
  const tools::Dump dump = tools::readDump(file);
  const tools::RestorePlan plan = tools::planRestore(link, dump, {}, target.notAsked());
  EXPECT_THAT(plan.left_out, IsEmpty());
  EXPECT_GT(plan.changes.size(), 20u);
  tools::RestoreRecord record = tools::recordOf(plan, link, file, false);
  tools::RestoreRun run{link, record, [](const tools::RestoreRecord&) {}, target.notAsked()};
  EXPECT_EQ(tools::RestoreEnd::kVerified, run.write());
  EXPECT_THAT(run.notes(), IsEmpty());
  const tools::Dump alike = tools::readAlike(link, dump, target.notAsked());
  EXPECT_THAT(texts(tools::differencesOf(dump, alike, link.known()), link.known()), IsEmpty());
  target.finish();
  if (kind.ram_orders) {
    EXPECT_EQ(0u, target.unit().parameters().eepromWrites());
  }
  EXPECT_EQ(1, target.unit().parameters().value(560));

  // Not only what both were asked for: what they are.
  for (const sim::ParameterDefinition& definition : sim::parameterDefinitions(target.unit().config().device)) {
    if (definition.read_only) continue;
    for (unsigned element = 0; element < std::max<unsigned>(definition.elements, 1); ++element) {
      for (unsigned set = 0; set < (definition.per_set ? 4u : 1u); ++set) {
        EXPECT_EQ(source.unit().parameters().value(definition.number, set, element),
                  target.unit().parameters().value(definition.number, set, element))
            << "P" << definition.number << " set " << set + 1 << " element " << element + 1;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EveryKind, RestoreRoundTrip, ::testing::ValuesIn(kKinds),
                         [](const auto& kind) { return std::string(kind.param.name); });

}  // namespace
}  // namespace nord_driver::test
