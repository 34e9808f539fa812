// Every transport this package declares can be created: a slip of the pen in the XML or the library is silent
// otherwise.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <pluginlib/class_loader.hpp>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "nord_driver/transport/transport.h"

namespace nord_driver {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

std::string readXml() {
  std::ifstream file(NORD_DRIVER_PLUGINS_XML);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::vector<std::string> declaredNames() {
  const std::string xml = readXml();
  static const std::regex kClass("<class\\s+name=\"([^\"]+)\"");
  std::vector<std::string> names;
  for (std::sregex_iterator at(xml.begin(), xml.end(), kClass), end; at != end; ++at) names.push_back((*at)[1]);
  return names;
}

std::string whereItLooked(pluginlib::ClassLoader<Transport>& loader) {
  std::string text = "declared:";
  for (const std::string& name : loader.getDeclaredClasses()) text += " " + name;
  const char* prefixes = std::getenv("CMAKE_PREFIX_PATH");
  return text + "; CMAKE_PREFIX_PATH=" + (prefixes == nullptr ? "" : prefixes);
}

TEST(Plugins, EveryDeclaredTransportCanBeCreated) {
  const std::vector<std::string> names = declaredNames();
  ASSERT_THAT(names, Not(IsEmpty()));
  EXPECT_THAT(names, Contains("nord_driver/profibus_dp"));
  EXPECT_THAT(names, Contains("nord_driver/profibus_ms2"));
  EXPECT_THAT(names, Contains("nord_driver/canopen"));
  EXPECT_THAT(names, Contains("nord_driver/devicenet"));
  EXPECT_THAT(names, Contains("nord_driver/interbus"));
  pluginlib::ClassLoader<Transport> loader("nord_driver", "nord_driver::Transport");
  for (const std::string& name : names) {
    EXPECT_TRUE(loader.isClassAvailable(name)) << name << "; " << whereItLooked(loader);
    EXPECT_NO_THROW(EXPECT_NE(nullptr, loader.createInstance(name)) << name) << name << "; " << whereItLooked(loader);
  }
}

// A missing export line in package.xml hides the whole file without a word.
TEST(Plugins, PluginlibFindsWhatTheFileDeclares) {
  pluginlib::ClassLoader<Transport> loader("nord_driver", "nord_driver::Transport");
  EXPECT_THAT(loader.getDeclaredClasses(), ::testing::IsSupersetOf(declaredNames())) << whereItLooked(loader);
}

// What a user reads who mistyped the name.
TEST(Plugins, AWrongNameListsTheDeclaredOnes) {
  pluginlib::ClassLoader<Transport> loader("nord_driver", "nord_driver::Transport");
  EXPECT_FALSE(loader.isClassAvailable("nord_driver/profibus"));
  try {
    loader.createInstance("nord_driver/profibus");
    FAIL() << "created what nobody declared";
  } catch (const pluginlib::PluginlibException& error) {
    for (const std::string& name : declaredNames()) EXPECT_THAT(error.what(), HasSubstr(name));
  }
}

}  // namespace
}  // namespace nord_driver
