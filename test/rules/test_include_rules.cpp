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
  EXPECT_THAT(about("src/transport/profibus/dp.cpp", "#include \"profibus/master.h\""), IsEmpty());
  EXPECT_THAT(about("src/transport/profibus/dp.cpp", "#include \"nord_driver/transport/transport.h\""), IsEmpty());
  EXPECT_THAT(about("src/transport/canopen/can.cpp", "#include \"link/can/can_link.h\""), IsEmpty());
  EXPECT_THAT(about("src/sim/bus_kinds.cpp", "#include \"sim/canopen/stations.h\""), IsEmpty());
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

// What only one bus needs stays apart from what only the other one needs, in tests as well.
TEST(IncludeRules, BusesAreApart) {
  const auto forbidden = [](const std::string& path, const std::string& header) {
    return about(path, "#include \"" + header + "\"").size();
  };
  EXPECT_EQ(1u, forbidden("src/transport/profibus/a.cpp", "transport/canopen/canopen.h"));
  EXPECT_EQ(1u, forbidden("src/transport/canopen/a.cpp", "transport/profibus/ppo.h"));
  EXPECT_EQ(1u, forbidden("src/transport/canopen/a.cpp", "profibus/telegram.h"));
  EXPECT_EQ(1u, forbidden("src/transport/canopen/a.cpp", "link/serial/serial_port.h"));
  EXPECT_EQ(1u, forbidden("src/sim/profibus/a.cpp", "sim/canopen/can_node.h"));
  EXPECT_EQ(1u, forbidden("src/sim/canopen/a.cpp", "sim/profibus/dp_slave.h"));
  EXPECT_EQ(1u, forbidden("src/link/serial/a.cpp", "link/can/can_link.h"));
  EXPECT_EQ(1u, forbidden("src/link/can/a.cpp", "link/serial/byte_link.h"));
  EXPECT_EQ(1u, forbidden("test/transport/profibus/test_a.cpp", "sim/canopen/can_node.h"));
  EXPECT_EQ(1u, forbidden("test/canopen/test_a.cpp", "sim/profibus/dp_slave.h"));
  EXPECT_EQ(1u, forbidden("test/link/can/test_a.cpp", "link/serial/byte_link.h"));
  EXPECT_EQ(1u, forbidden("test/devicenet/test_a.cpp", "sim/canopen/can_node.h"));
  EXPECT_EQ(0u, forbidden("test/link/test_a.cpp", "link/serial/byte_link.h"));
  EXPECT_EQ(0u, forbidden("test/system/test_a.cpp", "sim/canopen/can_node.h"));
}

// Above the transports nobody knows a bus: what they have in common is all there is.
TEST(IncludeRules, BusesEndAtTheirTransport) {
  for (const char* header : {"transport/profibus/ppo.h", "canopen/node.h", "link/can/can_link.h"}) {
    for (const char* path : {"src/cycle/a.cpp", "src/node/a.cpp", "src/tools/a.cpp", "src/transport/a.cpp",
                             "include/nord_driver/transport/a.h", "src/trace/a.cpp", "src/config/a.cpp"}) {
      EXPECT_EQ(1u, about(path, "#include \"" + std::string{header} + "\"").size()) << path << " " << header;
    }
  }
}

// A transport fills the ring of telegrams; what is made of it comes after the cycle, which does not know of it.
TEST(IncludeRules, TheTraceLooksOnFromAbove) {
  EXPECT_THAT(about("src/transport/canopen/a.cpp", "#include \"nord_driver/trace/telegram_trace.h\""), IsEmpty());
  EXPECT_THAT(about("src/trace/trace_feed.h", "#include \"cycle/cycle_observer.h\""), IsEmpty());
  EXPECT_THAT(about("src/transport/canopen/a.cpp", "#include \"trace/trace_feed.h\""),
              ElementsAre(HasSubstr("trace/, which transport/canopen/ must not use")));
  EXPECT_THAT(about("src/cycle/a.cpp", "#include \"trace/trace_feed.h\""),
              ElementsAre(HasSubstr("trace/, which cycle")));
  EXPECT_THAT(about("src/trace/telegram_trace.cpp", "#include \"cycle/snapshot.h\""), ElementsAre(HasSubstr("cycle/")));
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
  EXPECT_THAT(about("src/transport/token_ring/a.cpp", "#include <array>"),
              ElementsAre(HasSubstr("transport/token_ring/ has no row")));
  EXPECT_THAT(about("src/node/a.cpp", "#include \"nord_driver/extras/a.h\""), ElementsAre(HasSubstr("without a row")));
  EXPECT_THAT(about("src/node/a.cpp", "#include \"../node/a.h\""), ElementsAre(HasSubstr("'..'")));
}

}  // namespace
}  // namespace nord_driver::rules
