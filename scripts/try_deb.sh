#!/usr/bin/env bash
# try_deb.sh PACKAGE: run by check_deb.sh and check_fresh.sh in a minimal Debian that has nothing else: installs the package,
# asks every program for its version, looks for what else the package brings, and lets the demo's robot drive, with ROS's own
# tools. Ends with 0 when the robot's true pose has moved.
set -euo pipefail
package=$1
export DEBIAN_FRONTEND=noninteractive LANG=C.UTF-8 ROS_HOSTNAME=localhost
unset ROS_MASTER_URI # as in a user's shell: Debian's ROS sets none

fail() {
  echo "try_deb: $*" >&2
  tail -n 30 /root/apt.log /root/launch.log >&2 2>/dev/null || true
  exit 1
}

echo "installing the package and what it depends on"
if ! compgen -G '/var/lib/apt/lists/*_Packages*' >/dev/null; then
  apt-get update >/root/apt.log 2>&1 || fail "apt-get update failed"
fi
apt-get install -y --no-install-recommends "$package" >/root/apt.log 2>&1 || fail "apt-get install failed"
version=$(dpkg-query -W -f '${Version}' nord-driver)
for program in nord_driver_node nord_sim_node nord_sim nord_param; do
  answer=$(rosrun nord_driver "$program" --version) || fail "rosrun nord_driver $program failed"
  [[ $answer == *"$version"* ]] || fail "rosrun nord_driver $program --version says $answer, where $version was expected"
done
nord_param --version >/dev/null || fail "nord_param is no command"
config=$(rospack find nord_driver)/config
nord_param --config "$config/demo.yaml" list >/dev/null || fail "nord_param does not read the demo's file"
for file in /lib/udev/rules.d/70-nord-driver.rules /lib/systemd/system/nord_driver@.service /lib/systemd/system/nord_can@.service; do
  [[ -s $file ]] || fail "$file is not there"
done

echo "driving the demo's robot"
roslaunch nord_driver demo.launch output:=log bus:=/tmp/nord_driver_demo_bus >/root/launch.log 2>&1 &
launch=$!
stop() {
  kill -INT "$launch" 2>/dev/null || true
  kill -TERM "$launch" 2>/dev/null || true
  wait "$launch" 2>/dev/null || true
}
trap stop EXIT
true_x() {
  timeout 20 rostopic echo -n 1 /nord_sim/truth/odom/pose/pose/position/x | head -n 1
}
deadline=$((SECONDS + 60))
until rosservice call /nord_driver/enable true 2>/dev/null | grep -q 'success: True'; do
  kill -0 "$launch" 2>/dev/null || fail "roslaunch has ended"
  ((SECONDS < deadline)) || fail "the drives were not enabled within 60 s"
done
said=$(nord_param --config "$config/demo.yaml" --bus /tmp/nord_driver_demo_bus read left P105 2>&1) ||
  fail "nord_param does not read beside the driver: $said"
[[ $said == *"through node /nord_driver"*"P105"* ]] || fail "nord_param beside the driver says $said"
before=$(true_x) || fail "nothing comes on /nord_sim/truth/odom"
timeout 60 rostopic pub -r 20 /cmd_vel geometry_msgs/Twist '{linear: {x: 0.3}}' >/dev/null 2>&1 &
deadline=$((SECONDS + 60))
until now=$(true_x) && python3 -c "import sys; sys.exit(not float('$now') > float('$before') + 0.3)"; do
  ((SECONDS < deadline)) || fail "the robot has not moved: x was $before, is $now"
done
echo "try_deb: nord-driver $version: the robot stood at x = $before m and is at $now m"
