#!/usr/bin/env bash
# Builds everything and runs every test and check. The last line is "N passed, N failed, N skipped": test cases, and each
# check (format, dependencies, pictures, proof, lint, fuzz, workspace, fresh) as one. The lines before say where the tests on
# SocketCAN ran, and how often a test was tried again since the machine had stood still. Ends with 0 only when nothing failed
# and something passed.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

usage() {
  cat <<'TEXT'
usage: test.sh [--sanitize[=thread]] [--quick] [--deep] [--merged]
  --sanitize  the tests built with AddressSanitizer and UndefinedBehaviorSanitizer (build/sanitize), with =thread
              with ThreadSanitizer (build/sanitize_thread); those on SocketCAN count as skipped, as do those that count
              allocations
  --quick     the tests, format, dependencies, pictures and proof only; lint, fuzz, workspace and fresh count as skipped
  --deep      lint of every source with clang's path analyzer, and each fuzz target runs five minutes: an hour more
              (otherwise lint reads what was changed last and a sixth of the rest)
  --merged    libraries and unit tests are built from merged sources: faster from nothing, slower after a change
TEXT
}

sanitize=false
threads=false
quick=false
deep=false
merged=false
for argument in "$@"; do
  case $argument in
    --sanitize) sanitize=true ;;
    --sanitize=thread) sanitize=true threads=true ;;
    --quick) quick=true ;;
    --deep) deep=true ;;
    --merged) merged=true ;;
    -h | --help) usage; exit 0 ;;
    *) usage >&2; exit 2 ;;
  esac
done

out=$root/build/test # rosrun does not look below build/
# Light optimisation builds in half the time, and without NDEBUG the assertions of the code are tested, too. The benchmarks
# are built, so that they go on building; scripts/bench.sh runs them.
options=(-DNORD_DRIVER_STRICT=ON -DNORD_DRIVER_BENCH=ON -DNORD_DRIVER_PRECOMPILE=ON "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1 -g1"
  -DNORD_DRIVER_TEST_OPTIONS=-O0)
if $threads; then
  out=$root/build/sanitize_thread
  options+=(-DNORD_DRIVER_SANITIZE=thread)
elif $sanitize; then
  out=$root/build/sanitize
  # gcc takes what these instructions add for values that were never set, and warns of them.
  options+=(-DNORD_DRIVER_SANITIZE=ON -DNORD_DRIVER_STRICT=OFF)
fi
if $merged; then options+=(-DNORD_DRIVER_MERGE_SOURCES=ON); fi
export CTEST_OUTPUT_ON_FAILURE=1
# Sanitizers take several times as long: a fifth of the campaign's scenarios.
if $sanitize; then export NORD_CAMPAIGN_SCENARIOS=${NORD_CAMPAIGN_SCENARIOS:-400}; fi
# Nothing of a test leaves the build folder or this machine.
export ROS_HOME=$out/ros_home ROS_LOG_DIR=$out/ros_home/log ROS_HOSTNAME=localhost
export LSAN_OPTIONS=${LSAN_OPTIONS:-suppressions=$root/scripts/lsan_suppressions.txt:print_suppressions=0}
# Its reports are counted afterwards, by whose code they are about; a program does not fail by those of ROS.
reports=$out/reports
export TSAN_OPTIONS=${TSAN_OPTIONS:-suppressions=$root/scripts/tsan_suppressions.txt:print_suppressions=0:second_deadlock_stack=1:exitcode=0:handle_segv=0:handle_abort=0:handle_sigbus=0:handle_sigfpe=0:handle_sigill=0:log_path=$reports/tsan}
# A node that roslaunch ends tells nobody how it ended: reports about addresses and leaks are counted afterwards. Undefined
# behaviour ends its program, which a test sees unless it comes while the node ends: gcc's library writes it to stderr only.
export ASAN_OPTIONS=${ASAN_OPTIONS:-detect_stack_use_after_return=1:log_path=$reports/asan} UBSAN_OPTIONS=${UBSAN_OPTIONS:-print_stacktrace=1}
unset ROS_MASTER_URI ROS_IP

passed=0
failed=0
skipped=0
second_tries=0      # of tests whose machine stood still (test/support/second_try.h)
linter=             # the process that runs the linter
socketcan=          # the process that runs these tests
socketcan_ran=      # where, in words

finish() {
  echo
  if [[ -n $socketcan_ran ]]; then echo "socketcan: $socketcan_ran"; fi
  echo "second tries because the machine stood still: $second_tries"
  echo "$passed passed, $failed failed, $skipped skipped"
  ((failed == 0 && passed > 0)) || exit 1
  exit 0
}

# check NAME COMMAND...: runs it and counts it as one.
check() {
  local name=$1 start=$SECONDS
  shift
  echo "== $name"
  if "$@"; then
    passed=$((passed + 1))
    echo "== $name: passed ($((SECONDS - start)) s)"
  else
    failed=$((failed + 1))
    echo "== $name: FAILED ($((SECONDS - start)) s)"
  fi
}

# As check(); a status of 77 says that it cannot be tried here, and its last line why.
check_where_possible() {
  local name=$1 start=$SECONDS status=0
  shift
  echo "== $name"
  "$@" >"$out/$name.log" 2>&1 || status=$?
  if ((status == 77)); then
    skip "$name" "$(tail -n 1 "$out/$name.log")"
  elif ((status == 0)); then
    tail -n 5 "$out/$name.log"
    passed=$((passed + 1))
    echo "== $name: passed ($((SECONDS - start)) s)"
  else
    tail -n 60 "$out/$name.log"
    failed=$((failed + 1))
    echo "== $name: FAILED ($((SECONDS - start)) s)"
  fi
}

skip() {
  skipped=$((skipped + 1))
  echo "== $1: skipped ($2)"
}

# Stops here when it fails: nothing after it could run.
must() {
  local name=$1 before=$failed
  check "$@"
  ((failed == before)) || finish
  passed=$((passed - 1)) # a step, not a check
}

format() {
  local folders=("$root"/include "$root"/src "$root"/test)
  if [[ -d $root/bench ]]; then folders+=("$root/bench"); fi
  if [[ -d $root/fuzz ]]; then folders+=("$root/fuzz"); fi
  find "${folders[@]}" \( -name '*.h' -o -name '*.cpp' \) -print0 |
    xargs -0 clang-format-14 --style=file --dry-run -Werror
}

# Shows as well that it can fail: the headers of yaml-cpp are on this machine whatever is listed.
dependencies() {
  "$root/scripts/check_dependencies.py" || return 1
  if "$root/scripts/check_dependencies.py" --without libyaml-cpp-dev >/dev/null; then
    echo "check_dependencies.py does not notice that libyaml-cpp-dev is not listed"
    return 1
  fi
}

# Shows as well that it can fail: a picture that was changed by hand.
pictures() {
  "$root/scripts/draw_pictures.sh" --check || return 1
  local copy=$out/pictures_check
  rm -rf "$copy"
  mkdir -p "$copy" && cp -r "$root/doc" "$root/README.md" "$copy/"
  sed -i 's/390 ohm/391 ohm/' "$copy/doc/pictures/wiring_rs485.svg"
  if /usr/bin/python3 "$copy/doc/pictures/draw.py" --check >/dev/null; then
    echo "draw_pictures.sh does not notice a picture that was changed by hand"
    return 1
  fi
}

# That what counts and judges the proof can fail.
proof() {
  "$root/scripts/proof_table.py" --self-test && "$root/scripts/count_races.py" --self-test && "$root/scripts/mutants.py" --self-test
}

# no_reports [FOLDER]: of AddressSanitizer, in the files it writes itself.
no_reports() {
  local folder=${1:-$reports} found=0 report
  for report in "$folder"/*; do
    [[ -s $report ]] || continue
    found=$((found + 1))
    echo "-- $report"
    head -n 40 "$report"
  done
  echo "$found reports of AddressSanitizer"
  ((found == 0))
}

# What the linter reads: every source with --deep. Otherwise those that a commit of the last four hours, counted back from
# the last commit, has touched, and a sixth of the others, another one with each commit: all of them take eight minutes more.
lint_sources() {
  local all=() recent='' number=0 turn=0 source
  mapfile -t all < <(find "$root/src" -name '*.cpp' | sort)
  if $deep || ! git -C "$root" rev-parse --verify --quiet HEAD >/dev/null; then
    printf '%s\n' "${all[@]}"
    return
  fi
  recent=$(git -C "$root" log --name-only --format= --since="$(($(git -C "$root" show -s --format=%ct HEAD) - 14400))" -- src | sort -u)
  turn=$(($(git -C "$root" rev-list --count HEAD) % 6))
  for source in "${all[@]}"; do
    if ((number++ % 6 == turn)) || grep -qxF "${source#"$root/"}" <<<"$recent"; then echo "$source"; fi
  done
}

lint() {
  [[ -s $out/lint/compile_commands.json ]] || {
    tail -n 40 "$out/lint.configure.log"
    return 1
  }
  local options=(--quiet --extra-arg=-Wno-unknown-warning-option)
  # The analyzer, which follows paths through functions, doubles the time of the whole.
  if ! $deep; then options+=('--checks=-clang-analyzer-*'); fi
  lint_sources | xargs -n 1 -P "$jobs" clang-tidy-14 -p "$out/lint" "${options[@]}" 2>&1 |
    { grep -vE '^[0-9]+ warnings? generated\.$' || true; }
}

build() {
  configure "$out" "${options[@]}" >"$out/configure.log" 2>&1 || {
    tail -n 40 "$out/configure.log"
    return 1
  }
  # Everything a user gets, and everything a test needs.
  cmake --build "$out" -j "$jobs" >"$out/build.log" 2>&1 &&
    cmake --build "$out" -j "$jobs" --target tests >>"$out/build.log" 2>&1 || {
    grep -nE 'error|Error|FAILED' -A 5 "$out/build.log" | head -n 80
    return 1
  }
}

# count_cases FOLDER STATUS: adds the cases of the result files there; STATUS is how their programs ended.
count_cases() {
  local cases_passed cases_failed cases_skipped cases_tried_again
  read -r cases_passed cases_failed cases_skipped cases_tried_again <<<"$(/usr/bin/python3 "$root/scripts/count_results.py" "$1")"
  passed=$((passed + cases_passed))
  failed=$((failed + cases_failed))
  skipped=$((skipped + cases_skipped))
  second_tries=$((second_tries + cases_tried_again))
  if ((cases_passed == 0)); then
    echo "no test case ran"
    failed=$((failed + 1))
  elif (($2 != 0 && cases_failed == 0)); then
    echo "ended with $2 although no case failed: a test program died"
    failed=$((failed + 1))
  fi
}

# Four at a time: they wait for events most of the time (two processors are idle for two thirds of it). The ones that need the
# machine for themselves say RUN_SERIAL.
run_tests() {
  local results=$out/test_results status=0
  rm -rf "$results" "$reports"
  mkdir -p "$reports"
  (cd "$out" && ctest -j 4 --no-tests=error) || status=$?
  count_cases "$results" "$status"
}

# beside NAME COMMAND...: starts it in a session of its own, which ends with this script; what it says goes to NAME.log.
beside() {
  local name=$1
  shift
  setsid "$@" >"$out/$name.log" 2>&1 </dev/null &
  sessions+=("$!")
}

end_sessions() {
  local session
  for session in "${sessions[@]}"; do kill -- "-$session" 2>/dev/null || true; done
}

# How each source is compiled alone, and without gcc's precompiled headers, which clang cannot read: so the linter sees what a
# source itself includes. Headers that a build makes (of messages) are where they were built.
configure_lint() {
  rm -rf "$out/lint"
  configure "$out/lint" "${options[@]}" -DNORD_DRIVER_MERGE_SOURCES=OFF -DNORD_DRIVER_PRECOMPILE=OFF \
    >"$out/lint.configure.log" 2>&1 &&
    sed -i -E "s#(-I|-isystem )$out/lint/#\1$out/#g" "$out/lint/compile_commands.json"
}

# Takes what the tests leave of the processors, and then builds what "fuzz" runs: they wait for events most of the time. A session is scheduled as one group
# where the kernel has autogroups (sched(7)): `nice` counts inside it only, so the group gets the same.
start_lint() {
  configure_lint || true # lint says so
  export -f lint lint_sources
  export out root jobs deep
  beside lint nice -n 19 bash -o pipefail -c '{ echo 19 >/proc/self/autogroup; } 2>/dev/null || true; lint; status=$?
    "$root/scripts/fuzz.sh" --build >/dev/null 2>&1; exit "$status"' # what does not build there "fuzz" says
  linter=$!
}

finish_lint() {
  local status=0
  wait "$linter" || status=$?
  cat "$out/lint.log"
  return "$status"
}

# After the tests on a bus of this machine: an emulated one is slow enough alone.
start_socketcan() {
  rm -rf "$out/socketcan_results"
  beside socketcan "$root/scripts/test_socketcan.sh" "$out" "$out/socketcan_results"
  socketcan=$!
}

finish_socketcan() {
  local status=0
  echo "== socketcan"
  wait "$socketcan" || status=$?
  cat "$out/socketcan.log"
  socketcan_ran=$(sed -n 's/^can_machine: \(on\|in\) /\1 /p' "$out/socketcan.log" | head -n 1)
  if [[ -z $socketcan_ran ]]; then socketcan_ran="ran nowhere"; fi
  count_cases "$out/socketcan_results" "$status"
}

mkdir -p "$out"
must "install_deps" "$root/scripts/install_deps.sh" --test
must "build" build
sessions=()
trap end_sessions EXIT
if ! $sanitize && ! $quick; then start_lint; fi
echo "== tests"
start=$SECONDS
run_tests
echo "== tests: $((SECONDS - start)) s"
if $threads; then
  check "races" "$root/scripts/count_races.py" "$reports"
elif $sanitize; then
  check "reports" no_reports
fi
if $sanitize; then
  for name in format dependencies pictures proof lint fuzz workspace fresh socketcan; do
    skip $name "the run without --sanitize does it"
  done
else
  start_socketcan
  check "format" format
  check "dependencies" dependencies
  check "pictures" pictures
  check "proof" proof
  if $quick; then
    for name in lint fuzz workspace fresh; do skip $name "--quick"; done
  else
    check "lint" finish_lint
    check "workspace" "$root/scripts/check_workspace.sh"
    check "fuzz" "$root/scripts/fuzz.sh" "$($deep && echo 300 || echo 8)"
  fi
  finish_socketcan
  # Alone: how well the demo closes its square depends on what else the machine does.
  if ! $quick; then check_where_possible "fresh" "$root/scripts/check_fresh.sh" bookworm; fi
fi
finish
