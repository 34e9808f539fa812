#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rules/include_rules.h"

namespace nord_driver::rules {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// What is said about one file that holds only this line.
Violations about(const std::string& path, const std::string& line) {
  return checkIncludes({{path, line + "\n"}});
}

// A tree without sources proves nothing.
TEST(IncludeRules, AnEmptyTreeIsAViolation) {
  EXPECT_THAT(checkIncludes({}), ElementsAre(HasSubstr("no C++ file")));
  EXPECT_THAT(checkIncludes({{"README.md", "#include <ros/ros.h>\n"}}), ElementsAre(HasSubstr("no C++ file")));
}

// What the table allows passes.
TEST(IncludeRules, AllowedIncludesPass) {
  EXPECT_THAT(about("include/nord_driver/core/bytes.h", "#include <array>"), IsEmpty());
  EXPECT_THAT(about("src/profile/scaling.cpp", "#include \"nord_driver/core/units.h\""), IsEmpty());
  EXPECT_THAT(about("src/profile/scaling.cpp", "#include \"nord_driver/profile/scaling.h\""), IsEmpty());
  EXPECT_THAT(about("src/profile/scaling.cpp", "#include \"table.h\""), IsEmpty());
  EXPECT_THAT(about("src/link/serial.cpp", "#include <termios.h>"), IsEmpty());
  EXPECT_THAT(about("src/transport/dp.cpp", "#include \"nord_driver/profibus/master.h\""), IsEmpty());
  EXPECT_THAT(about("src/cycle/cycle.cpp", "#include <thread>"), IsEmpty());
  EXPECT_THAT(about("src/cycle/cycle.cpp", "auto now = std::chrono::steady_clock::now();"), IsEmpty());
  EXPECT_THAT(about("src/robot/geometry.cpp", "#include <urdf_parser/urdf_parser.h>"), IsEmpty());
  EXPECT_THAT(about("src/node/node.cpp", "#include <ros/ros.h>"), IsEmpty());
  EXPECT_THAT(about("src/node/node.cpp", "#include <nord_driver/DriveStatus.h>"), IsEmpty());
  EXPECT_THAT(about("src/plugins/register.cpp", "#include <pluginlib/class_list_macros.hpp>"), IsEmpty());
  EXPECT_THAT(about("test/node/test_node.cpp", "#include \"nord_driver/sim/inverter.h\""), IsEmpty());
  EXPECT_THAT(about("test/profibus/test_master.cpp", "#include \"nord_driver/sim/slave.h\""), IsEmpty());
  EXPECT_THAT(about("test/robot/test_ramp.cpp", "#include <gtest/gtest.h>"), IsEmpty());
}

// What it does not allow is found, with the file and the line.
TEST(IncludeRules, ForbiddenLayersAreFound) {
  EXPECT_THAT(
      checkIncludes({{"src/sim/slave.cpp", "// far end\n#include \"nord_driver/profibus/telegram.h\"\n"}}),
      ElementsAre("src/sim/slave.cpp:2: nord_driver/profibus/telegram.h is of profibus/, which sim/ must not use"));
  EXPECT_THAT(about("src/sim/inverter.cpp", "#include \"nord_driver/profile/control_word.h\""),
              ElementsAre(HasSubstr("profile/, which sim/")));
  EXPECT_THAT(about("test/sim/test_inverter.cpp", "#include \"nord_driver/profile/control_word.h\""),
              ElementsAre(HasSubstr("profile/, which sim/")));
  EXPECT_THAT(about("include/nord_driver/core/bytes.h", "#include \"nord_driver/profile/series.h\""),
              ElementsAre(HasSubstr("profile/, which core/")));
  EXPECT_THAT(about("src/profibus/master.cpp", "#  include <nord_driver/drive/drive.h>"),
              ElementsAre(HasSubstr("drive/, which profibus/")));
  EXPECT_THAT(about("src/drive/drive.cpp", "#include \"nord_driver/transport/transport.h\""),
              ElementsAre(HasSubstr("transport/, which drive/")));
  EXPECT_THAT(about("src/tools/nord_param.cpp", "#include \"node/parameters.h\""),
              ElementsAre(HasSubstr("node/, which tools/")));
}

// ROS stays in the folders made for it.
TEST(IncludeRules, RosOutsideItsFoldersIsFound) {
  for (const char* header :
       {"ros/time.h", "tf2/utils.h", "tf2_ros/transform_broadcaster.h", "geometry_msgs/Twist.h", "std_srvs/Trigger.h",
        "pluginlib/class_loader.hpp", "diagnostic_updater/publisher.h", "dynamic_reconfigure/server.h", "urdf/model.h",
        "XmlRpcValue.h", "nord_driver/BusStatus.h"}) {
    EXPECT_THAT(about("src/cycle/cycle.cpp", "#include <" + std::string(header) + ">"),
                ElementsAre(HasSubstr("is ROS, which cycle/ must not know")))
        << header;
    EXPECT_THAT(about("src/node/node.cpp", "#include <" + std::string(header) + ">"), IsEmpty()) << header;
  }
  EXPECT_THAT(about("test/profile/test_word.cpp", "#include <ros/ros.h>"), ElementsAre(HasSubstr("is ROS")));
  EXPECT_THAT(about("test/profile/test_word.cpp", "#include <rostest/permuter.h>"), ElementsAre(HasSubstr("is ROS")));
  EXPECT_THAT(about("test/profile/test_word.cpp", "#include \"rostest/topic.h\""),
              ElementsAre(HasSubstr("rostest/, which profile/ must not use")));
}

// The pure layers are handed everything: no thread, no socket, no clock, no waiting.
TEST(IncludeRules, PureLayersKnowNoSystem) {
  for (const char* header :
       {"thread", "mutex", "condition_variable", "sys/socket.h", "unistd.h", "time.h", "boost/any.hpp"}) {
    for (const char* path : {"src/profile/a.cpp", "src/profibus/a.cpp", "src/robot/a.cpp", "src/drive/a.cpp"}) {
      EXPECT_EQ(1u, about(path, "#include <" + std::string(header) + ">").size()) << path << " " << header;
    }
  }
  EXPECT_THAT(about("src/drive/drive.cpp", "auto t = std::chrono::steady_clock::now();"),
              ElementsAre(HasSubstr("clock")));
  EXPECT_THAT(about("src/profibus/master.cpp", "std::this_thread::sleep_for(pause);"), ElementsAre(HasSubstr("waits")));
  EXPECT_THAT(about("test/drive/test_drive.cpp", "std::this_thread::sleep_for(pause);"),
              ElementsAre(HasSubstr("waits")));
  EXPECT_THAT(about("src/drive/drive.cpp", "// never ask steady_clock::now() here"), IsEmpty());
}

// An include in a comment is none.
TEST(IncludeRules, CommentsDoNotCount) {
  EXPECT_THAT(about("src/robot/a.cpp", "// #include <ros/ros.h>"), IsEmpty());
  EXPECT_THAT(about("src/robot/a.cpp", "/* \n#include <ros/ros.h>\n*/"), IsEmpty());
}

// A folder nobody put into the table, as a place or as a target, and a way up are found.
TEST(IncludeRules, UnknownFoldersAreFound) {
  EXPECT_THAT(about("src/extras/a.cpp", "#include <array>"), ElementsAre(HasSubstr("extras/ has no row")));
  EXPECT_THAT(about("src/node/a.cpp", "#include \"nord_driver/extras/a.h\""), ElementsAre(HasSubstr("without a row")));
  EXPECT_THAT(about("src/node/a.cpp", "#include \"../node/a.h\""), ElementsAre(HasSubstr("'..'")));
}

}  // namespace
}  // namespace nord_driver::rules
