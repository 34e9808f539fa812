// The files for systemd and udev, read by the programs they are for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <cstdlib>
#include <iterator>
#include <set>
#include <sstream>
#include <stdexcept>
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

std::string driverUnit() {
  return shell(std::string{"cat "} + kInstall + "/systemd/nord_driver@.service").output;
}

/// What stands behind `begin` in the unit, up to the next blank or line end; -1: it is not there, or no number.
double numberBehind(const std::string& begin) {
  const std::string unit = driverUnit();
  const std::size_t found = unit.find(begin);
  if (found == std::string::npos) return -1.0;
  const std::string rest = unit.substr(found + begin.size());
  char* end = nullptr;
  const double number = std::strtod(rest.c_str(), &end);
  return end != rest.c_str() && std::isspace(static_cast<unsigned char>(*end)) != 0 ? number : -1.0;
}

// A name in a unit that is not there would show on the robot only.
TEST(ServiceFiles, StartWhatThePackageHas) {
  EXPECT_THAT(driverUnit(), HasSubstr("roslaunch nord_driver service.launch config:=/etc/nord_driver/%i.yaml"));
}

// roslaunch ends with 0 when a required node dies, of whatever: to systemd no driver has ever failed.
TEST(ServiceFiles, TheDriverIsStartedAgainHoweverRoslaunchEnded) {
  EXPECT_THAT(driverUnit(), HasSubstr("\nRestart=always\n"));
  EXPECT_THAT(driverUnit(), Not(HasSubstr("RestartPreventExitStatus")));
  EXPECT_THAT(driverUnit(), Not(HasSubstr("SuccessExitStatus")));
}

// What ends at once is started StartLimitBurst times, all of them within the interval: else a wrong configuration would be
// tried for ever. 8 s are a slow computer's for roslaunch, a master and a node that refuses.
TEST(ServiceFiles, AWrongConfigurationIsTriedAFewTimesOnly) {
  const double starts = numberBehind("\nStartLimitBurst="), pause = numberBehind("\nRestartSec=");
  ASSERT_GT(starts, 0.0);
  ASSERT_GT(pause, 0.0);
  EXPECT_LT(starts * (8.0 + pause), numberBehind("\nStartLimitIntervalSec="));
}

// SIGINT, after the time-out SIGTERM, and 2 s after it SIGKILL: a node that still waits for its drives loses them. systemd
// kills all that is left when its own time is over, so that must be longer than all of roslaunch's.
TEST(ServiceFiles, RoslaunchWaitsForTheDrivesAndSystemdForRoslaunch) {
  constexpr double kToKill = 2.0, kMasterEnds = 1.0;
  const double patience = numberBehind(" --sigint-timeout=");
  EXPECT_THAT(driverUnit(), Not(HasSubstr("--sigterm-timeout"))) << "kToKill is roslaunch's default";
  EXPECT_GE(patience, 30.0) << "roslaunch alone gives 15 s";
  EXPECT_GE(numberBehind("\nTimeoutStopSec="), patience + kToKill + kMasterEnds);
  if (shell("command -v roslaunch").code != 0) GTEST_SKIP() << "roslaunch is not installed";
  EXPECT_THAT(shell("roslaunch --help").output, HasSubstr("--sigint-timeout="));
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

std::string installationPage() {
  return shell(std::string{"cat "} + kInstall + "/../doc/installation.md").output;
}

std::string replaced(std::string text, const std::string& part, const std::string& by) {
  const std::size_t found = text.find(part);
  if (found == std::string::npos) throw std::runtime_error("no " + part + " in " + text);
  return text.replace(found, part.size(), by);
}

// Two nodes of one name throw each other off the master, and systemd starts each again. What the page says against it
// is put where the unit puts it.
TEST(ServiceFiles, TheSecondUnitsNodeGetsTheNameThePageGivesIt) {
  const std::string options = shell(std::string{"sed -n \"s/.*ROSLAUNCH_OPTIONS=\\([^']*name:=[a-z_]*\\).*/\\1/p\" "} +
                                    kInstall + "/../doc/installation.md | tr -d '\\n'")
                                  .output;
  ASSERT_EQ("--wait name:=rear_driver", options);
  EXPECT_THAT(driverUnit(), HasSubstr("name:=rear_driver"));
  std::string start =
      shell(std::string{"sed -n 's/^ExecStart=//p' "} + kInstall + "/systemd/nord_driver@.service").output;
  start = replaced(start, "/usr/bin/roslaunch nord_driver service.launch",
                   std::string{"roslaunch --dump-params "} + kInstall + "/../launch/service.launch");
  start = replaced(start, "/etc/nord_driver/%i.yaml", "$file");
  const Ended dump = shell("file=$(mktemp --suffix=.yaml); echo 'auto_enable: true' >$file; ROSLAUNCH_OPTIONS='" +
                           options + "'; " + start + "rm $file");
  EXPECT_THAT(dump.output, HasSubstr("/rear_driver/auto_enable: false\n")) << dump.errors;
  EXPECT_THAT(dump.output, Not(HasSubstr("/nord_driver/")));
}

// roslaunch ends the master it has started with its node: neither of two drivers may be the one that has.
TEST(ServiceFiles, SystemdKnowsThePagesUnitOfTheMaster) {
  const std::string page = installationPage();
  const std::size_t begin = page.find("    [Unit]\n    Description=ROS master\n"), end = page.find("\n\n", begin);
  ASSERT_NE(std::string::npos, begin);
  EXPECT_THAT(page, HasSubstr("    [Unit]\n    Requires=roscore.service\n    After=roscore.service\n"));
  if (shell("command -v systemd-analyze && command -v roscore").code != 0) GTEST_SKIP() << "no systemd, or no roscore";
  const Ended verified = shell(
      "folder=$(mktemp -d) && sed 's/^    //' >$folder/roscore.service <<'END' && systemd-analyze verify "
      "$folder/roscore.service; code=$?; rm -r $folder; exit $code\n" +
      page.substr(begin, end - begin) + "\nEND\n");
  EXPECT_EQ(0, verified.code);
  EXPECT_EQ("", verified.errors);
}

// systemd.exec, DynamicUser=: a /tmp of its own, and nothing else can be written but the folder of StateDirectory=.
TEST(ServiceFiles, ThePagesTracesGoWhereTheServiceMayWrite) {
  EXPECT_THAT(driverUnit(), HasSubstr("\nDynamicUser=yes\n"));
  EXPECT_THAT(driverUnit(), HasSubstr("\nStateDirectory=nord_driver\n"));
  EXPECT_THAT(installationPage(), HasSubstr("`trace_directory: /var/lib/nord_driver`"));
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

/// The names that the rules give a port of which 60-serial.rules has found out `properties`: /dev/tty stands in for it, and
/// a folder of our own for /dev. Nothing: udev cannot be asked here.
std::string namesOf(const std::string& properties) {
  const Ended tried = shell(
      R"(exec 2>&1; unshare --mount bash -c '
mkdir -p /run/udev && mount -t tmpfs none /run/udev && mount -t tmpfs none /dev && mkdir /run/udev/rules.d || exit 77
cd /run/udev/rules.d && cat >69-properties.rules && sed s/ttyUSB.*ACM./tty/ )" +
      std::string{kInstall} + R"(/udev/70-nord-driver.rules >70-nord-driver.rules
udevadm test --action=add /sys/class/tty/tty' <<'END' || exit 77
)" + properties +
      "\nEND\n");
  if (tried.code == 77) return {};
  const std::string key = "\nDEVLINKS=";
  const std::size_t found = tried.output.find(key);
  if (found == std::string::npos) throw std::runtime_error("no DEVLINKS in " + tried.output);
  const std::size_t begin = found + key.size();
  std::istringstream line{tried.output.substr(begin, tried.output.find('\n', begin) - begin)};
  const std::set<std::string> names{std::istream_iterator<std::string>{line}, {}};
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : " ") + name;
  return text;
}

// An adapter may have several ports on one USB interface: by serial number, interface and path they are the same. The only
// port of an adapter is 0 with a driver of usb-serial, and has no number with cdc_acm.
TEST(ServiceFiles, UdevGivesEveryPortOfAnAdapterItsOwnName) {
  if (shell("command -v udevadm").code != 0) GTEST_SKIP() << "udevadm is not installed (udev)";
  const std::string adapter = R"(ENV{ID_SERIAL_SHORT}="A5", ENV{ID_USB_INTERFACE_NUM}="00", ENV{ID_PATH}="pci-1")";
  const std::string alone = namesOf(adapter);
  if (alone.empty()) GTEST_SKIP() << "mounting is not allowed here";
  EXPECT_EQ("/dev/nord/A5-00 /dev/nord/pci-1", alone);
  EXPECT_EQ("/dev/nord/A5-00 /dev/nord/pci-1", namesOf(adapter + R"(, ENV{.ID_PORT}="0")"));
  EXPECT_EQ("/dev/nord/A5-00-port1 /dev/nord/pci-1-port1", namesOf(adapter + R"(, ENV{.ID_PORT}="1")"));
  EXPECT_EQ("/dev/nord/A5-00-port10 /dev/nord/pci-1-port10", namesOf(adapter + R"(, ENV{.ID_PORT}="10")"));
  EXPECT_EQ("/dev/nord/pci-1-port3", namesOf(R"(ENV{ID_PATH}="pci-1", ENV{.ID_PORT}="3")"))
      << "without a serial number";
}

}  // namespace
}  // namespace nord_driver::documents
