#!/usr/bin/env bash
# How much of the protocol, profile, drive, cycle and robot folders the unit and system tests run: lines and branches of each
# folder, by gcov, in build/coverage. Prints what is below the goals; test/coverage/reasons.yaml says why it may be. Ends with 0
# when every folder has 95 % of its lines and 90 % of its branches, or a reason for each file that keeps it from them.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

usage() {
  cat <<'TEXT'
usage: coverage.sh [--count-only] [--files] [FOLDER...]
  --count-only  counts what earlier runs have left, and runs nothing
  --files       lists every file, and the lines of it that nothing ran
  FOLDER        below src/; all that are counted (scripts/count_coverage.py)
TEXT
}

count_only=false
options=()
for argument in "$@"; do
  case $argument in
    --count-only) count_only=true ;;
    -h | --help) usage; exit 0 ;;
    -*) if [[ $argument != --files ]]; then usage >&2; exit 2; fi; options+=("$argument") ;;
    *) options+=("$argument") ;;
  esac
done

# What tests these folders and needs no ROS master. Without the programs that replace malloc: they run the same code again.
programs=(test_core test_config test_profile test_profibus test_canopen test_devicenet test_interbus test_modbus test_transport
  test_transport_scan test_transport_interbus test_robot test_drive test_cycle test_commissioning test_tools test_nord_param
  test_explore test_system test_system_canopen test_system_devicenet test_system_interbus test_system_channels test_system_gateway
  test_system_restore test_system_positions test_system_steered test_system_steered_stops)
out=$root/build/coverage
mkdir -p "$out"
if ! $count_only; then
  # Without optimisation, so that a line is a line. The counters are not shared safely among threads: a count may be lost, but
  # only those of 0 matter here, and with atomic ones the programs ran for hours.
  configure "$out" -DCMAKE_BUILD_TYPE=None -DNORD_DRIVER_PRECOMPILE=ON -DNORD_DRIVER_MERGE_SOURCES=ON \
    "-DCMAKE_CXX_FLAGS=-O0 -g0 --coverage -fprofile-update=single" >"$out/configure.log" 2>&1 || { tail -n 40 "$out/configure.log"; exit 1; }
  cmake --build "$out" -j "$jobs" --target "${programs[@]}" >"$out/build.log" 2>&1 || { tail -n 40 "$out/build.log"; exit 1; }
  find "$out" -name '*.gcda' -delete
  run() {
    if ! "$out/catkin_generated/env_cached.sh" "$out/devel/lib/nord_driver/$1" --gtest_brief=1 >"$out/$1.log" 2>&1; then
      echo "$1: FAILED, see $out/$1.log"
      return 1
    fi
  }
  export -f run
  export out
  printf '%s\n' "${programs[@]}" | xargs -n 1 -P "$jobs" bash -c 'run "$1"' coverage || { echo "coverage: a test failed: nothing is counted"; exit 1; }
fi
exec /usr/bin/python3 "$root/scripts/count_coverage.py" "$out" "${options[@]}"
