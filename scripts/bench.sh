#!/usr/bin/env bash
# Builds the benchmarks (optimised, build/bench) and runs them one after the other. Ends with 0 when every bound is kept, and
# when the figures that have none, those over the kernel's CAN, could be taken.
# A machine that does other things at the same time makes the figures worse: stop the rest, or repeat.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

if (($# > 0)); then
  echo "usage: bench.sh"
  [[ $1 == -h || $1 == --help ]]
  exit
fi

out=$root/build/bench
mkdir -p "$out"
configure "$out" -DCMAKE_BUILD_TYPE=Release -DNORD_DRIVER_BENCH=ON -DNORD_DRIVER_STRICT=ON >"$out/configure.log" 2>&1 ||
  { tail -n 40 "$out/configure.log"; exit 1; }
cmake --build "$out" -j "$jobs" --target bench >"$out/build.log" 2>&1 || { tail -n 40 "$out/build.log"; exit 1; }

# bench_ros_latency starts a ROS master and the node; their logs stay in the build folder.
export ROS_HOME=$out/ros_home ROS_LOG_DIR=$out/ros_home/log
set +u # ROS' own file
source "$out/devel/setup.bash"
set -u

echo "processors $(nproc), load before: $(cut -d' ' -f1-3 /proc/loadavg)"
status=0
for program in bench_efficiency bench_in_process bench_pty_cycle bench_can bench_devicenet bench_interbus bench_command_latency bench_parameters bench_ros_latency; do
  echo "== $program"
  "$out/devel/lib/nord_driver/$program" || status=1
done

# Where this machine's kernel has no CAN, in an emulated machine: about ten times slower.
echo "== bench_can over the kernel's CAN (vcan), without bounds"
"$root/scripts/can_machine.sh" bash -c 'ip link add dev vcan1 type vcan && ip link set vcan1 up && exec "$1" vcan0 vcan1' \
  bash "$out/devel/lib/nord_driver/bench_can" || status=1
exit $status
