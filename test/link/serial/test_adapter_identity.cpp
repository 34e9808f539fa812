#include <errno.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "link/serial/adapter_identity.h"

namespace nord_driver::link {
namespace {

namespace fs = std::filesystem;

/// /dev and /sys as Linux lays them out for USB serial adapters, in a folder of the test's own.
class AdapterIdentity : public ::testing::Test {
 protected:
  AdapterIdentity() {
    char name[] = "/tmp/nord_driver_identity_XXXXXX";
    root_ = fs::canonical(::mkdtemp(name));
    by_id_ = (root_ / "dev/serial/by-id").string();
    tty_class_ = (root_ / "sys/class/tty").string();
    fs::create_directories(by_id_);
    fs::create_directories(tty_class_);
    tree_.by_id = by_id_.c_str();
    tree_.tty_class = tty_class_.c_str();
  }
  ~AdapterIdentity() override { fs::remove_all(root_); }

  std::string device(const std::string& tty) const { return (root_ / "dev" / tty).string(); }

  static void put(const fs::path& file, const std::string& text) { std::ofstream{file} << text << "\n"; }

  /// An adapter at this USB port; without `serial` it has no number of its own.
  void plugIn(const std::string& tty, const std::string& port, const std::string& link, const std::string& serial) {
    const fs::path usb = root_ / "sys/devices/usb1" / port;
    const fs::path folder = usb / (port + ":1.0") / tty;
    fs::create_directories(folder / "tty" / tty);
    put(usb / "idVendor", "0403");
    if (!serial.empty()) put(usb / "serial", serial);
    fs::create_directories(fs::path{tty_class_} / tty);
    fs::create_directory_symlink(folder, fs::path{tty_class_} / tty / "device");
    std::ofstream{device(tty)} << "";
    if (!link.empty()) fs::create_symlink(fs::path{"../.."} / tty, fs::path{by_id_} / link);
  }

  fs::path root_;
  std::string by_id_, tty_class_;
  DeviceTree tree_;
};

TEST_F(AdapterIdentity, FindsTheLinkThatLeadsToTheDevice) {
  plugIn("ttyUSB0", "1-1", "usb-FTDI_FT232R_A1-if00-port0", "A1");
  plugIn("ttyUSB1", "1-2", "usb-FTDI_FT232R_B2-if00-port0", "B2");
  DevicePath link;
  ASSERT_EQ(0, adapterLink(tree_, device("ttyUSB1").c_str(), link));
  EXPECT_EQ(by_id_ + "/usb-FTDI_FT232R_B2-if00-port0", link.str());
  DevicePath target;
  ASSERT_EQ(0, resolvePath(link.c_str(), target));
  EXPECT_EQ(device("ttyUSB1"), target.str());
}

// Most CH340 have none: two of them share one link, which would lead to either.
TEST_F(AdapterIdentity, AnAdapterWithoutASerialNumberHasNone) {
  plugIn("ttyUSB0", "1-1", "usb-1a86_USB_Serial-if00-port0", "");
  DevicePath link;
  EXPECT_EQ(-ENOENT, adapterLink(tree_, device("ttyUSB0").c_str(), link));
}

TEST_F(AdapterIdentity, WithoutLinksThereIsNone) {
  plugIn("ttyUSB0", "1-1", "", "A1");
  DevicePath link;
  EXPECT_EQ(-ENOENT, adapterLink(tree_, device("ttyUSB0").c_str(), link));
  fs::remove_all(by_id_);
  EXPECT_EQ(-ENOENT, adapterLink(tree_, device("ttyUSB0").c_str(), link));
  EXPECT_EQ(-ENOENT, adapterLink(tree_, device("ttyUSB9").c_str(), link));
}

// More links than one read of the folder brings.
TEST_F(AdapterIdentity, LooksThroughALargeFolder) {
  for (int i = 0; i < 100; ++i) {
    const std::string number = std::to_string(i);
    plugIn("ttyUSB" + number, "1-" + number, "usb-" + std::string(60, 'x') + "_S" + number + "-if00-port0", number);
  }
  for (const int i : {0, 37, 99}) {
    DevicePath link;
    ASSERT_EQ(0, adapterLink(tree_, device("ttyUSB" + std::to_string(i)).c_str(), link)) << i;
    EXPECT_NE(std::string::npos, link.str().find("_S" + std::to_string(i) + "-")) << link.str();
  }
}

TEST_F(AdapterIdentity, ReadsTheLatencyTimer) {
  plugIn("ttyUSB0", "1-1", "usb-A1", "A1");
  EXPECT_EQ(-ENOENT, latencyTimer(tree_, device("ttyUSB0").c_str()));
  put(root_ / "sys/devices/usb1/1-1/1-1:1.0/ttyUSB0/latency_timer", "16");
  EXPECT_EQ(16, latencyTimer(tree_, device("ttyUSB0").c_str()));
  EXPECT_EQ(16, latencyTimer(tree_, (by_id_ + "/usb-A1").c_str()));
  EXPECT_EQ(-ENOENT, latencyTimer(tree_, "/nowhere"));
}

TEST_F(AdapterIdentity, ALongPathIsRefusedAndNotCut) {
  const fs::path deep = root_ / std::string(150, 'a') / std::string(150, 'b');
  fs::create_directories(deep);
  DevicePath target;
  EXPECT_EQ(-ENAMETOOLONG, resolvePath(deep.c_str(), target));
  EXPECT_TRUE(target.empty());
}

}  // namespace
}  // namespace nord_driver::link
