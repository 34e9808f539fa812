#!/usr/bin/env bash
# Lets the driver run for long: a simulated week of driving on each bus, shared among the processors, and half an hour of real
# time at 500 Hz over a pty, and over CAN frames where the kernel has them. Ends with 0 when nothing grew, drifted, was
# allocated or came late by the driver's own doing. Each part prints a line that begins with "soak:".
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

usage() {
  cat <<'TEXT'
usage: soak.sh [--quick] [--build FOLDER]
  --quick         an hour of simulated time on each bus and ten seconds of real time
  --build FOLDER  a configured build folder to build the programs in (build/soak)
TEXT
}

hours=168
seconds=1800
out=$root/build/soak
while (($# > 0)); do
  case $1 in
    --quick) hours=1 seconds=10 ;;
    --build)
      (($# > 1)) || { usage >&2; exit 2; }
      out=$2
      shift
      ;;
    -h | --help) usage; exit 0 ;;
    *) usage >&2; exit 2 ;;
  esac
  shift
done

mkdir -p "$out"
out=$(cd "$out" && pwd)
logs=$root/build/soak_logs
rm -rf "$logs"
mkdir -p "$logs"
if [[ ! -e $out/CMakeCache.txt ]]; then
  configure "$out" -DNORD_DRIVER_PRECOMPILE=ON -DNORD_DRIVER_MERGE_SOURCES=ON >"$logs/configure.log" 2>&1 || { tail -n 40 "$logs/configure.log"; exit 1; }
fi
cmake --build "$out" -j "$jobs" --target test_soak test_real_time >"$logs/build.log" 2>&1 || { tail -n 40 "$logs/build.log"; exit 1; }
programs=$out/devel/lib/nord_driver

# watch LOG COMMAND...: the lines of one program, and where it failed the others before them.
watch() {
  local log=$1
  shift
  if "$@" >"$log" 2>&1; then
    grep -h '^soak:' "$log"
  else
    grep -v '^soak:' "$log" | tail -n 40
    grep -h '^soak:' "$log" | sed 's/$/, FAILED/'
    return 1
  fi
}

# The programs of the real time first and alone: they are about the time.
status=0
watch "$logs/real_time.log" "$programs/test_real_time" "$seconds" --gtest_brief=1 || status=1
NORD_CAN_TIMEOUT=$((seconds * 2 + 600)) watch "$logs/real_time_can.log" "$root/scripts/can_machine.sh" \
  "$programs/test_real_time" "$seconds" vcan0 --gtest_brief=1 || status=1
grep -h '^can_machine: \(on\|in\) ' "$logs/real_time_can.log" || true

run() {
  NORD_SOAK_HOURS=$hours watch "$logs/$1.log" "$programs/test_soak" --gtest_brief=1 "--gtest_filter=*$1*"
}
export -f run watch
export hours programs logs
printf '%s\n' Profibus Canopen Devicenet Interbus | xargs -n 1 -P "$jobs" bash -c 'run "$1"' soak || status=1
exit "$status"
