// What documents point to is there.
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

namespace nord_driver::documents {
namespace {

namespace fs = std::filesystem;

const fs::path kSource{NORD_DRIVER_SOURCE_DIR};

std::string textOf(const fs::path& path) {
  std::ifstream stream{path};
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

std::vector<fs::path> documents() {
  std::vector<fs::path> all{kSource / "README.md"};
  for (const auto& entry : fs::directory_iterator{kSource / "doc"}) {
    if (entry.path().extension() == ".md") all.push_back(entry.path());
  }
  return all;
}

/// As it stands behind a heading's '#': small letters, figures, '-' and '_', a hyphen for each space.
std::vector<std::string> anchorsOf(const fs::path& document) {
  std::vector<std::string> anchors;
  std::ifstream stream{document};
  for (std::string line; std::getline(stream, line);) {
    if (line.empty() || line[0] != '#') continue;
    std::string anchor;
    for (const char c : line.substr(line.find_first_not_of("# "))) {
      if (c == ' ') anchor += '-';
      if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_') {
        anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      }
    }
    anchors.push_back(anchor);
  }
  return anchors;
}

TEST(Links, LeadToFilesAndHeadings) {
  const std::regex link{R"(\]\(([^)\s#]*)(?:#([^)\s]*))?\))"};
  int seen = 0;
  for (const fs::path& document : documents()) {
    const std::string text = textOf(document);
    for (auto at = std::sregex_iterator(text.begin(), text.end(), link); at != std::sregex_iterator{}; ++at) {
      const std::string file = (*at)[1], anchor = (*at)[2];
      if (file.find("://") != std::string::npos) continue;
      const fs::path target = file.empty() ? document : document.parent_path() / file;
      EXPECT_TRUE(fs::exists(target)) << document.filename() << ": " << file;
      if (anchor.empty() || !fs::exists(target)) continue;
      const std::vector<std::string> anchors = anchorsOf(target);
      EXPECT_NE(anchors.end(), std::find(anchors.begin(), anchors.end(), anchor))
          << document.filename() << ": " << file << "#" << anchor;
      ++seen;
    }
  }
  EXPECT_GT(seen, 5);
}

// Whoever looks for a file for a robot finds each of them.
TEST(Links, LeadFromReadmeToEveryTemplate) {
  const std::string readme = textOf(kSource / "README.md");
  for (const auto& entry : fs::directory_iterator{kSource / "config" / "templates"}) {
    const std::string link = "](config/templates/" + entry.path().filename().string() + ")";
    EXPECT_NE(std::string::npos, readme.find(link)) << "README.md has no " << link;
  }
}

// The PPO type of a technology unit is P507 of its inverter (BU 0020 6.1.2, 6.2.2), from the factory 1; SK CU4/TU4 takes
// the driver's.
TEST(Templates, TellToSetP507WhereThePpoTypeIsNotThatOfTheFactory) {
  std::size_t seen = 0;
  for (const auto& entry : fs::directory_iterator{kSource / "config" / "templates"}) {
    const std::string text = textOf(entry.path());
    const YAML::Node file = YAML::Load(text);
    if (file["transport"].as<std::string>() != "nord_driver/profibus_dp") continue;
    for (const auto& drive : file["drives"]) {
      const YAML::Node ppo_type = drive.second["ppo_type"];
      if (!ppo_type || ppo_type.as<int>() == 1 || drive.second["inverter"]) continue;
      const std::string asked = "P507 = " + ppo_type.as<std::string>();
      EXPECT_NE(std::string::npos, text.find(asked)) << entry.path().filename() << " does not say " << asked;
      ++seen;
    }
  }
  EXPECT_GT(seen, 1u);
}

}  // namespace
}  // namespace nord_driver::documents
