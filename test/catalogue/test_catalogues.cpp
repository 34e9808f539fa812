// Where the files are found, and a user's laid over both kinds of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "catalogue/drive_catalogue.h"
#include "catalogue/fault_words.h"
#include "catalogue/shipped.h"
#include "catalogue/temporary_file.h"

namespace nord_driver::catalogue {
namespace {

namespace fs = std::filesystem;
using profile::Series;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string refusal(const std::string& folder, const std::vector<std::string>& own = {}) {
  try {
    loadCatalogues(folder, own);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

/// A prefix that was moved to a folder of its own, with the folders of an installation.
class InstalledSomewhere : public ::testing::Test {
 protected:
  InstalledSomewhere() {
    fs::create_directories(prefix_ / "share/nord_driver/config/parameters");
    fs::create_directories(prefix_ / "share/nord_driver/config/faults");
  }
  ~InstalledSomewhere() override { fs::remove_all(prefix_); }

  fs::path prefix_ = fs::path(::testing::TempDir()) / ("nord_installed_" + std::to_string(::getpid()));
};

// Its own files, wherever the prefix went; nobody is asked for the package.
TEST_F(InstalledSomewhere, AProgramFindsTheFilesOfItsOwnPrefix) {
  const std::string program = (prefix_ / "lib/nord_driver/nord_param").string();
  const auto nobody = []() -> std::string { throw std::logic_error("asked"); };
  EXPECT_EQ((prefix_ / "share/nord_driver/config").string(), findConfigFolder(program, nobody));
}

// In a workspace programs and files are apart: the package says where it is.
TEST(CatalogueFolder, IsThatOfThePackageInAWorkspace) {
  const auto package = [] { return std::string("/ws/src/nord_driver"); };
  EXPECT_EQ("/ws/src/nord_driver/config", findConfigFolder("/ws/devel/lib/nord_driver/nord_param", package));
  EXPECT_EQ("/ws/src/nord_driver/config", findConfigFolder("", package));
  EXPECT_EQ("", findConfigFolder("/ws/devel/lib/nord_driver/nord_param", [] { return std::string(); }));
}

TEST(CatalogueFolder, TheRunningProgramIsKnown) {
  EXPECT_EQ("test_catalogue", fs::path(runningProgram()).filename());
}

// PROFIBUS has two ways to it: in data exchange, and without.
TEST(Catalogues, AModuleIsTheSameOnEveryWayToIt) {
  for (const char* transport : {"profibus_dp", "profibus_ms2"}) {
    const DriveCatalogue known = driveCatalogue(shippedCatalogues(), Series::kSk2xxe, transport, true);
    const ParameterEntry* const timeout = known.find(151);
    ASSERT_NE(nullptr, timeout) << transport;
    EXPECT_EQ("0.500 s", known.valueText(timeout, 500)) << transport;
  }
}

TEST(Catalogues, MissingFilesAreToldInASentence) {
  EXPECT_EQ(
      "the package nord_driver: the files of parameters and faults are missing, expected config/parameters and "
      "config/faults of the package nord_driver (is the workspace's setup file sourced?)",
      refusal(""));
  EXPECT_THAT(refusal("/is/not/there"), StartsWith("/is/not/there: the files of parameters and faults are missing"));
}

// One file may correct parameters and faults; the rest stays.
TEST(Catalogues, AFileOfTheUserIsLaidOverBoth) {
  const TemporaryFile own(
      "devices: [sk5xxe]\n"
      "parameters:\n"
      "  - number: 513\n"
      "    range: [-0.1, 200.0]\n"
      "codes: p700\n"
      "resolution: 0.1\n"
      "faults:\n"
      "  - number: 2.1\n"
      "    name: drum motor too hot\n");
  const Catalogues catalogues = loadCatalogues(shippedFolder(), {own.path()});
  EXPECT_DOUBLE_EQ(200.0, catalogues.parameters.find(Series::kSk5xxe, 513)->range->highest);
  EXPECT_DOUBLE_EQ(100.0, catalogues.parameters.find(Series::kSk54xe, 513)->range->highest);
  EXPECT_EQ("drum motor too hot", FaultWords(catalogues.faults, Series::kSk5xxe).name(21));
  EXPECT_THAT(FaultWords(catalogues.faults, Series::kSk5xxe).remedy(21), HasSubstr("let it cool down"));
  EXPECT_EQ("motor overtemperature (I2t)", FaultWords(catalogues.faults, Series::kSk54xe).name(21));
}

// Each kind alone, in the order given.
TEST(Catalogues, LaterFilesGoOverEarlierOnes) {
  const TemporaryFile first("devices: [sk5xxe]\nparameters: [{number: 104, unit: rpm}, {number: 105, unit: rpm}]\n");
  const TemporaryFile second("devices: [sk5xxe]\nparameters: [{number: 105, unit: 1/s}]\n");
  const TemporaryFile faults("codes: p700\nfaults: [{number: 970, name: ours, source: us}]\n");
  const Catalogues catalogues = loadCatalogues(shippedFolder(), {first.path(), second.path(), faults.path()});
  EXPECT_EQ("rpm", catalogues.parameters.find(Series::kSk5xxe, 104)->unitOf(1));
  EXPECT_EQ("1/s", catalogues.parameters.find(Series::kSk5xxe, 105)->unitOf(1));
  EXPECT_EQ("ours", FaultWords(catalogues.faults, Series::kSk700e).name(970));
}

// Who reads the sentence looks for the key in the configuration.
TEST(Catalogues, AFileOfTheConfigurationIsNamedByItsKey) {
  const auto named = [](const char* sentence) {
    return std::string(namedBy("~parameter_files", {"/a.yaml", "/b.yaml"}, ConfigError(sentence)).what());
  };
  EXPECT_EQ("~parameter_files: /b.yaml:4: number 513: range: 5 is not valid, expected two numbers",
            named("/b.yaml:4: number 513: range: 5 is not valid, expected two numbers"));
  EXPECT_EQ("~parameter_files: /a.yaml: cannot be opened", named("/a.yaml: cannot be opened"));
  EXPECT_EQ("/a.yaml.old: cannot be opened", named("/a.yaml.old: cannot be opened")) << "another file";
}

TEST(Catalogues, AWrongFileIsToldWithItsLine) {
  const TemporaryFile own("devices: [sk5xxe]\nparameters:\n  - number: 513\n    range: [200, -0.1]\n");
  EXPECT_EQ(own.path() + ":4: number 513: range: [200, -0.1] is not valid, expected the lowest value first",
            refusal(shippedFolder(), {own.path()}));
  EXPECT_EQ("/is/not/there.yaml: cannot be opened, expected a readable YAML file",
            refusal(shippedFolder(), {"/is/not/there.yaml"}));
  const TemporaryFile other("devices: [sk5xxe]\nresolution: 0.1\nparameters: []\n");
  EXPECT_THAT(refusal(shippedFolder(), {other.path()}), HasSubstr("resolution is not a key of this file"))
      << "only beside faults";
}

}  // namespace
}  // namespace nord_driver::catalogue
