// The tables of parameters and faults in doc/ say what the files say.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <sstream>

#include "catalogue/shipped.h"
#include "documents/catalogue_tables.h"

namespace nord_driver::documents {
namespace {

std::string fileOf(const std::string& name) {
  std::ifstream file{std::string{NORD_DRIVER_SOURCE_DIR} + "/" + name};
  return {std::istreambuf_iterator<char>(file), {}};
}

void expectSame(const std::string& name, const std::string& expected) {
  std::istringstream wanted{expected}, found{fileOf(name)};
  for (std::string line, written; std::getline(wanted, line);) {
    ASSERT_TRUE(std::getline(found, written)) << name << " ends too early";
    ASSERT_EQ(line, written) << name << " is old: build and run write_tables (test/documents)";
  }
  std::string more;
  EXPECT_FALSE(std::getline(found, more)) << name << " has more lines than the files know: " << more;
}

TEST(CatalogueTables, OfParametersAreWhatTheFilesSay) {
  expectSame("doc/parameter_tables.md", parameterTables(catalogue::shippedCatalogues()));
}

TEST(CatalogueTables, OfFaultsAreWhatTheFilesSay) {
  expectSame("doc/fault_tables.md", faultTables(catalogue::shippedCatalogues()));
}

// No file is left out: each entry of each device has a row in the table of its family.
TEST(CatalogueTables, HaveARowForEveryEntry) {
  const auto rowsOf = [](const std::string& text, const std::string& begin) {
    std::size_t rows = 0;
    for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at + 1)) ++rows;
    return rows;
  };
  std::size_t parameters = 0, faults = 0;
  for (const std::string& file : catalogue::shippedParameterFiles()) {
    parameters += catalogue::readParameterFile(file).entries.size();
  }
  const std::string tables = parameterTables(catalogue::shippedCatalogues());
  EXPECT_EQ(parameters, rowsOf(tables, "\n| P") + rowsOf(tables, "\n| object "));
  for (const std::string& file : catalogue::shippedFaultFiles()) faults += catalogue::loadMap(file)["faults"].size();
  const std::string fault_tables = faultTables(catalogue::shippedCatalogues());
  EXPECT_EQ(faults + catalogue::shippedFaultFiles().size(), rowsOf(fault_tables, "\n| ")) << "with the head of each";
}

TEST(CatalogueTables, SayWhatAReaderLooksFor) {
  const std::string tables =
      parameterTables(catalogue::shippedCatalogues()) + faultTables(catalogue::shippedCatalogues());
  for (const char* row :
       {"| P509 | Source control word | 0 to 10 | 0 Control terminals or keyboard |  | 0 Control terminals "
        "or keyboard; 1 Control terminals only; 2 USS; 3 CAN; 4 PROFIBUS;",
        "| P102 | Acceleration time | steps of 0.01 s |  | sets 1 to 4 |", "| P152 | Factory setting | 0 to 1 |",
        "[-02] Delta time (s, 16 bits)", "| E2.1 | motor overtemperature (I2t) | "}) {
    EXPECT_NE(std::string::npos, tables.find(row)) << row;
  }
}

}  // namespace
}  // namespace nord_driver::documents
