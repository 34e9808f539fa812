#!/usr/bin/env bash
# Everything that shows that the driver holds, and one table of it: the fault campaign, in simulated time and with real processes,
# mutants, every order of events, sanitizers, fuzzing, soak and coverage. Each part runs its own script or program; its log is in
# build/prove, until it runs again. The table is of the last run of each, and says of which commit that was. Ends with 0 when every
# part that was to run now has run and none failed. doc/reliability.md holds such a table, as build/prove/table.md has it.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

usage() {
  cat <<'TEXT'
usage: prove.sh [--quick] [PART...]
  --quick  ten minutes, once build/test and build/fuzz are built: fewer scenarios, shorter runs; what needs a build of the whole
           project for itself (mutants, sanitizers, coverage) is left out, and the table says so
  PART     only these: campaign processes mutants explored address thread fuzz soak coverage
Without --quick it takes most of a day on two processors; part by part it can be spread over several.
TEXT
}

all=(campaign processes mutants explored address thread fuzz soak coverage)
quick=false
parts=()
for argument in "$@"; do
  case $argument in
    --quick) quick=true ;;
    -h | --help) usage; exit 0 ;;
    -*) usage >&2; exit 2 ;;
    *)
      [[ " ${all[*]} " == *" $argument "* ]] || { usage >&2; exit 2; }
      parts+=("$argument")
      ;;
  esac
done
if ((${#parts[@]} == 0)); then parts=("${all[@]}"); fi

logs=$root/build/prove
mkdir -p "$logs"
build=$root/build/test # what test.sh has built

# built TARGET...: in test.sh's folder, and as it does it.
built() {
  if [[ ! -e $build/CMakeCache.txt ]]; then
    configure "$build" -DNORD_DRIVER_STRICT=ON -DNORD_DRIVER_BENCH=ON -DNORD_DRIVER_PRECOMPILE=ON \
      "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1 -g1" -DNORD_DRIVER_TEST_OPTIONS=-O0 || return 1
  fi
  cmake --build "$build" -j "$jobs" --target "$@"
}

campaign() {
  built test_campaign >"$logs/build_campaign.log" 2>&1 || { tail -n 20 "$logs/build_campaign.log"; return 125; }
  NORD_CAMPAIGN_SCENARIOS=$($quick && echo 2000 || echo 20000) "$build/devel/lib/nord_driver/test_campaign"
}
processes() {
  built nord_driver_node nord_sim_node rostest_campaign >"$logs/build_processes.log" 2>&1 || { tail -n 20 "$logs/build_processes.log"; return 125; }
  local status=0 results=$build/test_results/nord_driver result bus
  rm -f "$results"/rosunit-*_rostest_campaign.xml
  (cd "$build" && NORD_PROCESS_SCENARIOS=$($quick && echo 3 || echo 12) ctest -R rostest_campaign -j 4 --output-on-failure) || status=1
  # Without its file a bus has no line, and the table says that one is missing.
  for result in "$results"/rosunit-*_rostest_campaign.xml; do
    bus=${result##*/rosunit-}
    echo "processes: ${bus%_rostest_campaign.xml} $(sed -nE 's/.*name="scenarios" value="([0-9]+)".*/\1/p' "$result") scenarios," \
      "$(grep -c '<failure ' "$result") failed"
  done
  return "$status"
}
mutants() {
  if $quick; then echo "--quick"; return 126; fi
  /usr/bin/python3 "$root/scripts/mutants.py" --fresh
}
explored() {
  built test_explore >"$logs/build_explored.log" 2>&1 || { tail -n 20 "$logs/build_explored.log"; return 125; }
  "$build/devel/lib/nord_driver/test_explore"
}
address() {
  if $quick; then echo "--quick"; return 126; fi
  "$root/scripts/test.sh" --sanitize --merged
}
thread() {
  if $quick; then echo "--quick"; return 126; fi
  "$root/scripts/test.sh" --sanitize=thread --merged
}
fuzz() {
  if $quick; then "$root/scripts/fuzz.sh" 15; else "$root/scripts/fuzz.sh" 1200 10000000; fi
}
soak() {
  # A week takes an hour in a build of its own, which is optimised, and two in that of the tests.
  if $quick; then "$root/scripts/soak.sh" --quick --build "$build"; else "$root/scripts/soak.sh"; fi
}
coverage() {
  if $quick; then echo "--quick"; return 126; fi
  "$root/scripts/coverage.sh"
}

# 125 says that a part could not be run, 126 that it was not to be, and the last line of its log why; a script or program that is
# not there is the first.
form=$($quick && echo quick || echo long)
for part in "${parts[@]}"; do
  rm -f "$logs/$part.status"
  start=$SECONDS
  status=0
  before=$(/usr/bin/python3 "$root/scripts/proof_table.py" --commit)
  (set -e; $part) >"$logs/$part.log" 2>&1 || status=$?
  /usr/bin/python3 "$root/scripts/proof_table.py" --ended "$logs" "$part" "$form" "$status" $((SECONDS - start)) "$before"
  echo "== $part: ended with $status after $((SECONDS - start)) s"
done
exec /usr/bin/python3 "$root/scripts/proof_table.py" "$logs" "${parts[@]}"
