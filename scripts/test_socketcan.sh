#!/usr/bin/env bash
# Runs the tests that need a kernel with CAN, all at one go, where can_machine.sh finds one. The last line says where.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

# GoogleTest programs.
programs=(test_socketcan)
# rostests: a line each, a file below test/ and what it is handed. All are handed interface:=vcan0 (or make interfaces of
# their own) and time_factor:=N (1, or 10 where everything is emulated), so they have these two <arg>s and multiply their
# time limits with the latter.
rostests=(
  rostest/rostest_canopen_drive.test
  "socketcan/rostest_socketcan.test transport:=canopen"
  "socketcan/rostest_socketcan.test transport:=devicenet"
  "process_campaign/rostest_campaign.test transport:=canopen"
)

usage() {
  cat <<'TEXT'
usage: test_socketcan.sh BUILD RESULTS [GTEST OPTION...]
  BUILD    a configured build folder in which the target "tests" was built
  RESULTS  a folder for the results (JUnit XML); what is in it goes
Ends with 0 when every program did, with 125 when there was no place to run them.
TEXT
}

# Called by itself, in the place with CAN.
inside() {
  local build=$1 results=$2 program line word name start status=0
  local -a words
  shift 2
  for program in "${programs[@]}"; do
    echo "-- $program"
    timeout $((60 * NORD_TIME_FACTOR)) "$build/devel/lib/nord_driver/$program" "--gtest_output=xml:$results/$program.xml" \
      --gtest_brief=1 "$@" || status=1
  done
  ((${#rostests[@]} > 0)) || return "$status"
  export NORD_PROCESS_SCENARIOS=${NORD_PROCESS_SCENARIOS:-2} # a minute each where everything is emulated
  set +u # ROS' own file
  source "$build/devel/setup.bash"
  set -u
  for line in "${rostests[@]}"; do
    read -r -a words <<<"$line"
    name=$(basename "${words[0]}" .test)
    for word in "${words[@]:1}"; do name+=_${word#*:=}; done
    start=$SECONDS
    echo "-- $name"
    rostest --pkgdir="$root" --package=nord_driver --results-filename="$name.xml" --results-base-dir="$results" \
      "$root/test/${words[0]}" "${words[@]:1}" interface:=vcan0 "time_factor:=$NORD_TIME_FACTOR" || status=1
    echo "-- $name: $((SECONDS - start)) s"
  done
  return "$status"
}

case ${1-} in
  --inside) shift; inside "$@"; exit ;;
  -h | --help) usage; exit 0 ;;
esac
(($# >= 2)) || { usage >&2; exit 2; }
build=$(cd "$1" && pwd)
results=$2
shift 2
rm -rf "$results"
mkdir -p "$results"
results=$(cd "$results" && pwd)
status=0
"$root/scripts/can_machine.sh" --keep "$results" "${BASH_SOURCE[0]}" --inside "$build" "$results" "$@" || status=$?
exit "$status"
