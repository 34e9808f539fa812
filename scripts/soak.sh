#!/usr/bin/env bash
# Lets the driver run for long: a simulated week of driving on each bus, shared among the processors. Ends with 0 when nothing
# grew, drifted or was allocated. Each bus prints a line that begins with "soak:".
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

usage() {
  cat <<'TEXT'
usage: soak.sh [--quick] [--build FOLDER]
  --quick         an hour of simulated time on each bus
  --build FOLDER  a configured build folder to build the programs in (build/soak)
TEXT
}

hours=168
out=$root/build/soak
while (($# > 0)); do
  case $1 in
    --quick) hours=1 ;;
    --build) out=${2:?}; shift ;;
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
  configure "$out" -DNORD_DRIVER_PRECOMPILE=ON >"$logs/configure.log" 2>&1 || { tail -n 40 "$logs/configure.log"; exit 1; }
fi
cmake --build "$out" -j "$jobs" --target test_soak >"$logs/build.log" 2>&1 || { tail -n 40 "$logs/build.log"; exit 1; }
programs=$out/devel/lib/nord_driver

status=0
run() {
  if NORD_SOAK_HOURS=$hours "$programs/test_soak" --gtest_brief=1 "--gtest_filter=*$1*" >"$logs/$1.log" 2>&1; then
    grep -h '^soak:' "$logs/$1.log"
  else
    tail -n 40 "$logs/$1.log"
    return 1
  fi
}
export -f run
export hours programs logs
printf '%s\n' Profibus Canopen Devicenet | xargs -n 1 -P "$jobs" bash -c 'run "$1"' soak || status=1
exit "$status"
