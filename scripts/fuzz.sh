#!/usr/bin/env bash
# Builds the fuzz targets of the protocol engines in build/fuzz and runs each for a time, one on each processor. Ends with 1
# when one of them crashed; the input that did it stays in build/fuzz.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

seconds=${1:-30}
if (($# > 1)) || [[ ! $seconds =~ ^[1-9][0-9]*$ ]]; then
  echo "usage: fuzz.sh [seconds for each target, 30]" >&2
  exit 2
fi

out=$root/build/fuzz
mkdir -p "$out"
configure "$out" -DNORD_DRIVER_FUZZ=ON -DCMAKE_C_COMPILER=clang-14 -DCMAKE_CXX_COMPILER=clang++-14 \
  >"$out/configure.log" 2>&1 || {
  tail -n 20 "$out/configure.log"
  exit 1
}
cmake --build "$out" -j "$jobs" --target fuzz_targets >"$out/build.log" 2>&1 || {
  tail -n 40 "$out/build.log"
  exit 1
}

# run NAME: one target, for its time.
run() {
  local name=$1 log=$out/$1.log corpus=$out/corpus/$1
  mkdir -p "$corpus"
  if "$out/bin/$name" -max_total_time="$seconds" -max_len=4096 -timeout=10 -print_final_stats=1 \
    -artifact_prefix="$out/$name-" "$corpus" >"$log" 2>&1; then
    echo "$name: $(sed -n 's/^stat::number_of_executed_units: *//p' "$log") executions in $seconds s"
  else
    echo "$name: FAILED, see $log"
    tail -n 30 "$log"
    return 1
  fi
}
export -f run
export out seconds

[[ -s $out/fuzz_targets.txt ]] || {
  echo "$out/fuzz_targets.txt names no target"
  exit 1
}
xargs -n 1 -P "$jobs" bash -c 'run "$1"' fuzz <"$out/fuzz_targets.txt" || exit 1
