#!/usr/bin/env bash
# Builds the fuzz targets of the protocol engines in out/fuzz and runs each for a time. Ends with 1 when one of them
# crashed; the input that did it stays in out/fuzz.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

seconds=${1:-30}
if (($# > 1)) || [[ ! $seconds =~ ^[1-9][0-9]*$ ]]; then
  echo "usage: fuzz.sh [seconds for each target, 30]" >&2
  exit 2
fi

out=$root/out/fuzz
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

failed=0
for target in telegram diagnosis gsd record master sdo eds canopen; do
  corpus=$out/corpus/$target
  mkdir -p "$corpus"
  log=$out/$target.log
  if "$out/bin/fuzz_$target" -max_total_time="$seconds" -max_len=4096 -timeout=10 -print_final_stats=1 \
    -artifact_prefix="$out/$target-" "$corpus" >"$log" 2>&1; then
    echo "fuzz_$target: $(sed -n 's/^stat::number_of_executed_units: *//p' "$log") executions in $seconds s"
  else
    failed=1
    echo "fuzz_$target: FAILED, see $log"
    tail -n 30 "$log"
  fi
done
exit "$failed"
