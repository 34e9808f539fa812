// doc/parameters.md says what the code says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

#include "documents/parameter_document.h"
#include "nord_driver/config/settings.h"

namespace nord_driver::documents {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr char kFolder[] = NORD_DRIVER_SOURCE_DIR;
constexpr char kConfiguration[] =
    "{bus: {device: /dev/null}, drives: {a: {series: sk5xxe, pole_pairs: 2, address: 3}}}";

std::string fileOf(const std::string& path) {
  std::ifstream stream{std::string{kFolder} + "/" + path};
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// Of the shipped meanings, one key more or less or otherwise.
class Slips : public ::testing::Test {
 protected:
  Document document() const { return makeDocument(meanings_, records_); }
  YAML::Node section(const std::string& title) {
    for (YAML::Node section : meanings_["sections"]) {
      if (section["title"].as<std::string>() == title) return section;
    }
    throw std::runtime_error("no section " + title);
  }

  YAML::Node meanings_ = YAML::LoadFile(std::string{kFolder} + "/doc/parameters.yaml");
  RecordsByTransport records_ = readAll(YAML::LoadFile(std::string{kFolder} + "/test/documents/configurations.yaml"));
};

TEST(ParameterDocument, IsThatOfTheCode) {
  const Document document = documentOf(kFolder);
  EXPECT_THAT(document.problems, IsEmpty());
  std::istringstream expected{document.text}, found{fileOf("doc/parameters.md")};
  for (std::string line, written; std::getline(expected, line);) {
    std::getline(found, written);
    ASSERT_EQ(line, written) << "doc/parameters.md is old: build and run write_parameters (test/documents)";
    written.clear();
  }
  EXPECT_EQ(found.tellg(), document.text.size()) << "doc/parameters.md has more lines than the code knows";
}

/// The group of a configuration, without this key; empty: it was not there.
YAML::Node without(const YAML::Node& group, const std::string& key) {
  YAML::Node copy = YAML::Clone(group);
  const std::size_t slash = key.find('/');
  if (slash == std::string::npos) return copy.IsMap() && copy.remove(key) ? copy : YAML::Node{};
  const YAML::Node inner =
      group[key.substr(0, slash)] ? without(group[key.substr(0, slash)], key.substr(slash + 1)) : YAML::Node{};
  if (inner.IsNull()) return {};
  copy[key.substr(0, slash)] = inner;
  return copy;
}

/// The configuration with one required key less.
YAML::Node withoutRequired(const YAML::Node& configuration, Group group, const std::string& key) {
  if (group == Group::kNode) return without(configuration, key);
  YAML::Node copy = YAML::Clone(configuration);
  YAML::Node place = copy[group == Group::kBus ? "bus" : "drives"];
  if (group == Group::kBus) {
    const YAML::Node less = without(place, key);
    if (less.IsNull()) return {};
    copy["bus"] = less;
    return copy;
  }
  const std::string name = place.begin()->first.as<std::string>();
  const YAML::Node less = without(place[name], key);
  if (less.IsNull()) return {};
  place[name] = less;
  return copy;
}

std::string refusal(const YAML::Node& configuration) {
  YAML::Node list;
  list.push_back(configuration);
  try {
    readAll(list);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "taken";
}

// What the document calls required is missed when it is not there.
TEST(ParameterDocument, EachRequiredKeyIsMissed) {
  const YAML::Node configurations = YAML::LoadFile(std::string{kFolder} + "/test/documents/configurations.yaml");
  int missed = 0;
  for (const auto& [transport, groups] : readAll(configurations)) {
    for (const auto& [group, keys] : groups) {
      for (const auto& [key, record] : keys) {
        if (!record.isRequired()) continue;
        for (const YAML::Node& configuration : configurations) {
          const std::string own =
              configuration["transport"] ? configuration["transport"].as<std::string>() : std::string{"profibus_dp"};
          const YAML::Node less = own == transport ? withoutRequired(configuration, group, key) : YAML::Node{};
          if (less.IsNull()) continue;
          EXPECT_THAT(refusal(less), HasSubstr(key + " is missing")) << transport;
          ++missed;
        }
      }
    }
  }
  EXPECT_GT(missed, 10);
}

TEST_F(Slips, AKeyNobodyReadsIsNamed) {
  section("PROFIBUS")["bus"]["colour"] = "of the cable";
  EXPECT_THAT(document().problems, Contains("PROFIBUS: bus/colour is described and nobody reads it"));
}

TEST_F(Slips, AKeyNobodyDescribesIsNamed) {
  section("PROFIBUS")["bus"].remove("watchdog");
  EXPECT_THAT(document().problems, Contains("profibus_dp: bus key watchdog is read and not described"));
}

TEST_F(Slips, AKeyDescribedTwiceIsNamed) {
  section("PROFIBUS")["drive"]["joint"] = "it turns";
  EXPECT_THAT(document().problems, Contains("profibus_dp: joint is described twice"));
}

TEST_F(Slips, ADefaultInTheDocumentBesideThatOfTheCodeIsNamed) {
  section("PROFIBUS")["bus"]["max_retries"] = YAML::Load("{meaning: tries, default: 3}");
  EXPECT_THAT(document().problems,
              Contains("PROFIBUS: bus/max_retries has a default in the code, and a second one in the document"));
}

TEST_F(Slips, ARangeInTheDocumentBesideThatOfTheCodeIsNamed) {
  section("PROFIBUS")["bus"]["max_retries"] = YAML::Load("{meaning: tries, range: 0 to 8}");
  EXPECT_THAT(document().problems,
              Contains("PROFIBUS: bus/max_retries has a range in the code, and a second one in the document"));
}

TEST_F(Slips, ADefaultThatDependsOnOtherKeysNeedsWords) {
  section("Node")["node"]["drive_timeout"].remove("default");
  EXPECT_THAT(document().problems,
              Contains("Node: drive_timeout has a default that depends on other keys: say how, as \"default\""));
}

TEST_F(Slips, ADefaultTheCodeDoesNotTellNeedsWords) {
  section("PROFIBUS")["drive"]["io_byte"] = "slot 1";
  EXPECT_THAT(document().problems,
              Contains("PROFIBUS: drives/<name>/io_byte is read without a note of its default (booleanOr, numberOr, "
                       "...): say it, as \"default\""));
}

// A constant changed in the code is another document.
TEST(ParameterDocument, ShowsKindUnitRangeAndDefaultOfTheCode) {
  YAML::Node list;
  list.push_back(YAML::Load(kConfiguration));
  const auto meanings = YAML::Load(
      "{about: '', sections: [{title: T, bus: {watchdog: w, sync: s, echo: e, device: d}, drive: {pole_pairs: p}}]}");
  const std::string text = makeDocument(meanings, readAll(list)).text;
  EXPECT_THAT(text, HasSubstr("| `bus/watchdog` | 0.01 to 650.25 s | 0.2 s | w |\n"));
  EXPECT_THAT(text, HasSubstr("| `bus/sync` | true or false | false | s |\n"));
  EXPECT_THAT(text, HasSubstr("| `bus/echo` | `auto`, `off`, `on` | auto | e |\n"));
  EXPECT_THAT(text, HasSubstr("| `bus/device` | text | required | d |\n"));
  EXPECT_THAT(text, HasSubstr("| `drives/<name>/pole_pairs` | whole number, 1 to 64 | required | p |\n"));
}

}  // namespace
}  // namespace nord_driver::documents
