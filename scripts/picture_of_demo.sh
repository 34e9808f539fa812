#!/usr/bin/env bash
# Makes doc/pictures/demo.png: the demo in rviz (config/demo.rviz) on a screen that exists in memory only, after the robot has
# driven its square; with --steered doc/pictures/demo_steered.png, the steered robot after its circle. Installs nothing, builds nothing: needs Debian's rviz, xvfb and imagemagick, and the demo as
# scripts/demo.sh has built it, or the build folder that is named.
set -euo pipefail
export PATH=/usr/bin:/bin:/usr/sbin:/sbin
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

usage() {
  echo "usage: picture_of_demo.sh [--steered] [BUILD FOLDER]   (default: out/demo)"
}
name=demo
robot=two_wheels
drive=(drive_square.py)
if [[ ${1:-} == --steered ]]; then
  name=demo_steered
  robot=steered
  # Where rviz draws by software the simulator is late at times, and odometry with it: a picture needs no centimetres.
  drive=(drive_circle.py --radius 0.6 --tolerance 0.1)
  shift
fi
if (($# > 1)) || [[ ${1:-} == -* ]]; then
  usage
  [[ ${1:-} == -h || ${1:-} == --help ]] || exit 2
  exit 0
fi
built=${1:-$root/out/demo}
picture=$root/doc/pictures/$name.png

missing=()
for need in rviz:rviz Xvfb:xvfb import:imagemagick; do
  command -v "${need%:*}" >/dev/null || missing+=("${need#*:}")
done
if ((${#missing[@]} > 0)); then
  echo "picture_of_demo.sh: missing packages; install them with: sudo apt-get install -y --no-install-recommends ${missing[*]}" >&2
  exit 1
fi
if [[ ! -f $built/devel/setup.bash ]]; then
  echo "picture_of_demo.sh: $built/devel/setup.bash does not exist: run scripts/demo.sh first, or name a build folder" >&2
  exit 1
fi

set +u # catkin's setup files read variables that may be unset
# shellcheck disable=SC1091
source "$built/devel/setup.bash"
set -u
# shellcheck disable=SC1091
source "$root/scripts/demo_launch.sh"

files=$(mktemp -d) # rviz and roslaunch leave nothing anywhere else
log=$files/log
launch=
screen=
end() {
  stop_demo
  if [[ -n $screen ]]; then kill "$screen" 2>/dev/null || true; fi
  rm -rf "$files"
}
trap end EXIT
fail() {
  tail -n 30 "$log" >&2
  echo "picture_of_demo.sh: $1" >&2
  exit 1
}

mkfifo "$files/display"
Xvfb -displayfd 3 -screen 0 1200x800x24 -nolisten tcp 3>"$files/display" >>"$log" 2>&1 &
screen=$!
read -r -t 20 number <"$files/display" || fail "Xvfb did not start"
mkdir -p "$files/run" && chmod 700 "$files/run"
export DISPLAY=:$number LIBGL_ALWAYS_SOFTWARE=1 QT_X11_NO_MITSHM=1 HOME=$files ROS_HOME=$files/ros XDG_RUNTIME_DIR=$files/run

start_demo "$log" robot:="$robot" bus:="$files/bus" rviz:=true
hears_odometry() {
  local told
  told=$(rosnode info /rviz 2>/dev/null) && [[ $told == *"* /odom ["* ]]
}
for _ in $(seq 100); do # until rviz hears what it is to show
  hears_odometry && break
  kill -0 "$launch" 2>/dev/null || fail "the demo ended"
  sleep 0.2
done
hears_odometry || fail "rviz does not listen to /odom"

python3 "$root/scripts/${drive[0]}" "${drive[@]:1}" >>"$log" 2>&1 || fail "the robot did not drive its way"
# Without the panels beside the view.
import -window root -crop 820x700+364+66 +repage -strip +dither -colors 256 "PNG8:$files/demo.png"
mv "$files/demo.png" "$picture"
echo "$picture: $(stat -c %s "$picture") bytes"
