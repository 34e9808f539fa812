#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <string>

#include "devicenet/eds_samples.h"
#include "transport/devicenet/devicenet_rig.h"
#include "transport/devicenet/devicenet_settings.h"

namespace nord_driver::test {
namespace {

using Bus = DevicenetSettings;
using testing::ElementsAre;
using testing::HasSubstr;

class EdsOnDisk {
 public:
  explicit EdsOnDisk(const std::string& text = devicenet::kEds)
      : path_("/tmp/nord_devicenet_config_" + std::to_string(getpid()) + ".eds") {
    std::ofstream{path_} << text;
  }
  ~EdsOnDisk() { std::remove(path_.c_str()); }
  EdsOnDisk(const EdsOnDisk&) = delete;
  EdsOnDisk& operator=(const EdsOnDisk&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

TEST(DevicenetEdsTest, GivesTheIdentity) {
  const EdsOnDisk file;
  Bus bus{2};
  bus.drive().set("eds", file.path());
  const DevicenetConfig config = bus.read();
  EXPECT_EQ(std::uint16_t{389}, config.scanner.nodes[0].vendor_id);
  EXPECT_EQ(std::uint16_t{7}, config.scanner.nodes[0].product_code);
  EXPECT_FALSE(config.scanner.nodes[1].vendor_id) << "the other drive names none";
  EXPECT_THAT(config.warnings, testing::IsEmpty());
}

// Then another device at that MAC id is named and not polled.
TEST(DevicenetEdsTest, AnotherDeviceIsNotPolled) {
  const EdsOnDisk file;
  Bus bus{1};
  bus.drive().set("eds", file.path());
  DevicenetRig rig{bus};
  rig.device().product = 8;
  rig.run(std::chrono::seconds{4});
  EXPECT_EQ(0u, rig.bus->sentTo("42D"));
  EXPECT_FALSE(rig.inputs[0].module_answers);
  EXPECT_STREQ(
      "is another device than configured: vendor 389, device type 2, product code 8; expected vendor 389, device type "
      "2, "
      "product code 7",
      rig.transport.note(0).text);
  rig.device().product = 7;
  EXPECT_TRUE(rig.starts());
}

TEST(DevicenetEdsTest, AMistakeIsToldWithFileAndLine) {
  const EdsOnDisk file;
  Bus bus{1};
  bus.drive().set("eds", file.path()).set("product_code", 8);
  EXPECT_EQ("~drives/drive0/eds: " + file.path() +
                " describes another module than is configured: line 10: product_code is 7, configured is 8",
            bus.refusal());
  bus.drive().erase("product_code").set("assembly", 101);
  EXPECT_THAT(bus.refusal(), HasSubstr("line 13: no Input is assembly 111"));
  bus.drive().set("assembly", 100).set("io", "cyclic");
  EXPECT_THAT(bus.refusal(), HasSubstr("line 13: the device has no process data by cyclic"));
}

TEST(DevicenetEdsTest, AFileThatIsNone) {
  Bus bus{1};
  bus.drive().set("eds", "/nowhere.eds");
  EXPECT_EQ(
      "~drives/drive0/eds: \"/nowhere.eds\" is not valid, expected an EDS file that can be read (No such file or "
      "directory)",
      bus.refusal());
  const EdsOnDisk canopen{"[FileInfo]\nFileName=tester.eds\n[DeviceInfo]\nVendorNumber=1\n"};
  bus.drive().set("eds", canopen.path());
  EXPECT_THAT(bus.refusal(), HasSubstr("expected an EDS file of DeviceNet"));
}

// What is wrong in the file and not needed is told and left out.
TEST(DevicenetEdsTest, ProblemsOfTheFileAreWarnings) {
  const EdsOnDisk file{"[Device]\nVendCode = 389;\nProdCode = many;\n"};
  Bus bus{1};
  bus.drive().set("eds", file.path());
  DevicenetRig rig{bus};
  EXPECT_THAT(rig.transport.warnings(),
              ElementsAre(file.path() + ":3: ProdCode: \"many\" is no number from 0 to 65535"));
}

TEST(DevicenetEdsTest, OneModuleHasOneFile) {
  const EdsOnDisk file;
  Bus bus = Bus::gateway(2, 120);
  bus.drive(1).set("eds", file.path());
  EXPECT_EQ("accepted", bus.refusal());
  bus.drive(0).set("eds", file.path());
  EXPECT_EQ("accepted", bus.refusal());
  bus.drive(1).set("eds", "/other.eds");
  EXPECT_EQ("~drives/drive1/eds: \"/other.eds\" is not valid, expected \"" + file.path() +
                "\", the one of drive \"drive0\": both are behind one module",
            bus.refusal());
}

}  // namespace
}  // namespace nord_driver::test
