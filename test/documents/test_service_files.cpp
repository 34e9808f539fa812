// The files for systemd and udev, read by the programs they are for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tools/program.h"

namespace nord_driver::documents {
namespace {

using test::Ended;
using test::runProgram;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr char kInstall[] = NORD_DRIVER_SOURCE_DIR "/install";

Ended shell(const std::string& script) {
  return runProgram({"/bin/bash", "-c", script});
}

TEST(ServiceFiles, SystemdKnowsEveryKey) {
  if (shell("command -v systemd-analyze").code != 0) GTEST_SKIP() << "systemd-analyze is not installed (systemd)";
  for (const char* unit : {"nord_driver@", "nord_can@"}) {
    const Ended verified = shell(std::string{"systemd-analyze verify "} + kInstall + "/systemd/" + unit + ".service");
    EXPECT_EQ(0, verified.code) << unit;
    EXPECT_EQ("", verified.errors) << unit;
  }
}

// A name in a unit that is not there would show on the robot only.
TEST(ServiceFiles, StartWhatThePackageHas) {
  const Ended text = shell(std::string{"cat "} + kInstall + "/systemd/nord_driver@.service");
  EXPECT_THAT(text.output, HasSubstr("roslaunch nord_driver service.launch config:=/etc/nord_driver/%i.yaml"));
}

// After a crash systemd starts the driver again: it does not enable by itself, whatever its file says.
TEST(ServiceFiles, TheServiceTakesAutoEnableAway) {
  const Ended dump = shell(std::string{"file=$(mktemp --suffix=.yaml); echo 'auto_enable: true' >$file; roslaunch "
                                       "--dump-params "} +
                           kInstall + "/../launch/service.launch config:=$file | sed '/^$/d'; rm $file");
  EXPECT_EQ("/nord_driver/auto_enable: false\n", dump.output) << dump.errors;
  const Ended launch = shell(std::string{"cat "} + kInstall + "/../launch/service.launch");
  EXPECT_THAT(launch.output, HasSubstr("required=\"true\"")) << "systemd would not see that the node has ended";
}

// udevadm verify came with systemd 254; before it, udevadm test reads the rules of /run/udev, here a folder of our own.
TEST(ServiceFiles, UdevKnowsEveryKey) {
  if (shell("command -v udevadm").code != 0) GTEST_SKIP() << "udevadm is not installed (udev)";
  const std::string rules = std::string{kInstall} + "/udev/70-nord-driver.rules";
  const Ended verified = shell("udevadm verify " + rules + " 2>&1");
  if (verified.output.find("Unknown command verb") == std::string::npos) {
    EXPECT_EQ(0, verified.code) << verified.output;
    return;
  }
  const Ended read = shell(
      "exec 2>&1; unshare --mount bash -c 'mkdir -p /run/udev && mount -t tmpfs none /run/udev || exit 77; mkdir "
      "/run/udev/rules.d; cp " +
      rules + " /run/udev/rules.d/; udevadm test --action=add /sys/class/tty/tty' || exit 77");
  if (read.code == 77) GTEST_SKIP() << "udevadm has no verify, and mounting is not allowed here: " << read.output;
  EXPECT_THAT(read.output, HasSubstr("Reading rules file: /run/udev/rules.d/70-nord-driver.rules"));
  EXPECT_THAT(read.output, Not(HasSubstr("70-nord-driver.rules:")));
}

}  // namespace
}  // namespace nord_driver::documents
