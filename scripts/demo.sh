#!/usr/bin/env bash
# The demo: installs what is missing, builds, and lets a simulated two-wheel robot drive a square by cmd_vel.
# Ends with 0 when the robot's true pose is back within 5 cm of the start. --keep leaves everything running.
set -euo pipefail
export PATH=/usr/bin:/bin:/usr/sbin:/sbin

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
keep=false
for argument in "$@"; do
  case "$argument" in
    --keep) keep=true ;;
    -h | --help)
      sed -n '2,3s/^# //p' "${BASH_SOURCE[0]}"
      exit 0
      ;;
    *)
      echo "demo.sh: unknown argument \"$argument\", expected --keep" >&2
      exit 2
      ;;
  esac
done

"$root/scripts/install_deps.sh"

out="$root/out/demo"
log=$(mktemp /tmp/nord_driver_demo.XXXXXX.log)
echo "building in out/demo (log: $log) ..."
# Merged and without debug information it is built in two fifths of the time: nobody changes it, nor debugs it.
options=(-DCATKIN_ENABLE_TESTING=OFF -DNORD_DRIVER_MERGE_SOURCES=ON
  -DCMAKE_BUILD_TYPE=Release "-DCMAKE_CXX_FLAGS_RELEASE=-O2 -DNDEBUG")
if ! { cmake -S "$root" -B "$out" -DPYTHON_EXECUTABLE=/usr/bin/python3 "${options[@]}" &&
  cmake --build "$out" -j "$(nproc)"; } >"$log" 2>&1; then
  tail -n 40 "$log" >&2
  echo "demo.sh: the build failed, see $log" >&2
  exit 1
fi

set +u # catkin's setup files read variables that may be unset
# shellcheck disable=SC1091
source "$out/devel/setup.bash"
set -u

# shellcheck disable=SC1091
source "$root/scripts/demo_launch.sh"
launch=
trap stop_demo EXIT
start_demo "$log" bus:="/tmp/nord_driver_demo_bus.$$"

status=0
python3 "$root/scripts/drive_square.py" || status=$?
if [ "$status" -ne 0 ]; then
  echo "--- end of $log:" >&2
  tail -n 30 "$log" >&2
fi

if $keep; then
  echo "The demo goes on until Ctrl-C. In another terminal:"
  echo "  export ROS_MASTER_URI=$ROS_MASTER_URI ROS_IP=127.0.0.1"
  echo "  source out/demo/devel/setup.bash && rostopic list"
  wait "$launch" || true
fi
if [ "$status" -eq 0 ]; then rm -f "$log"; fi
exit "$status"
