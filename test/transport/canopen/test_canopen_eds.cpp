// The data sheet of a node's maker: what it fills in, and what it refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>

#include "transport/canopen/canopen_settings.h"

namespace nord_driver {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using Bus = test::CanopenSettings;

/// A file that is gone with the test.
class EdsOnDisk {
 public:
  explicit EdsOnDisk(const std::string& text) : path_("/tmp/nord_canopen_config_" + std::to_string(getpid()) + ".eds") {
    std::ofstream{path_} << text;
  }
  ~EdsOnDisk() { std::remove(path_.c_str()); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

constexpr char kEds[] = R"(
[DeviceInfo]
VendorNumber=0x4E
ProductNumber=7
BaudRate_250=1
BaudRate_500=0
[1000]
ParameterName=Device type
DataType=0x0007
AccessType=ro
DefaultValue=0x10192
[1400]
ParameterName=RPDO 1
SubNumber=2
[1400sub1]
ParameterName=COB-ID
DataType=0x0007
AccessType=rw
DefaultValue=$NODEID+0x200
[1400sub2]
ParameterName=Type
DataType=0x0005
AccessType=rw
DefaultValue=255
[1800]
ParameterName=TPDO 1
SubNumber=4
[1800sub1]
ParameterName=COB-ID
DataType=0x0007
AccessType=rw
DefaultValue=$NODEID+0x180
[1800sub2]
ParameterName=Type
DataType=0x0005
AccessType=rw
DefaultValue=255
[1800sub3]
ParameterName=Inhibit time
DataType=0x0006
AccessType=rw
DefaultValue=0
[1800sub5]
ParameterName=Event timer
DataType=0x0006
AccessType=rw
DefaultValue=0
)";

// What the configuration leaves open the file fills in: the identity is then demanded of the node.
TEST(CanopenEds, AnEdsFileFillsInTheIdentity) {
  const EdsOnDisk file{kEds};
  Bus bus{1};
  bus.drive().set("eds", file.path()).set("error_control", "none").set("pdo_mapping", "keep");
  ASSERT_EQ("accepted", bus.refusal());
  const canopen::NodeConfig node = bus.read().master.nodes[0];
  EXPECT_EQ(0x4Eu, node.vendor_id.value());
  EXPECT_EQ(7u, node.product_code.value());
  EXPECT_EQ(0x10192u, node.device_type.value());
}

TEST(CanopenEds, AnEdsFileThatSaysOtherwiseIsRefused) {
  const EdsOnDisk file{kEds};
  Bus bus{1};
  bus.drive().set("eds", file.path()).set("error_control", "none").set("pdo_mapping", "keep").set("vendor_id", 0x99);
  EXPECT_THAT(bus.refusal(), AllOf(HasSubstr("~drives/drive0/eds: " + file.path()), HasSubstr("another device")));
}

TEST(CanopenEds, AnEdsFileThatIsNoneIsRefused) {
  Bus bus{1};
  bus.drive().set("eds", "/nowhere.eds");
  EXPECT_THAT(bus.refusal(),
              HasSubstr("~drives/drive0/eds: \"/nowhere.eds\" is not valid, expected an EDS file that can "
                        "be read (No such file or directory)"));
  const EdsOnDisk file{"hello"};
  bus.drive().set("eds", file.path());
  EXPECT_THAT(bus.refusal(), HasSubstr("it describes no object"));
}

}  // namespace
}  // namespace nord_driver
