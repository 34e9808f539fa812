#!/usr/bin/env bash
# Builds the fuzz targets of the protocol engines and of what reads files in build/fuzz, and runs each for a time, one on each
# processor. Each begins with the inputs of fuzz/corpus and with what earlier runs have found. Ends with 1 when one of them
# crashed; the input that did it stays in build/fuzz.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

usage() {
  cat <<'TEXT'
usage: fuzz.sh [SECONDS [EXECUTIONS]]
       fuzz.sh --build
  SECONDS     for each target, 30
  EXECUTIONS  a target ends earlier after so many; without it they go on until their time is up
  --build     builds the targets and runs none
The long form is fuzz.sh 1200 10000000: ten million executions of every target, or twenty minutes.
TEXT
}

build_only=false
if [[ $# == 1 && $1 == --build ]]; then
  build_only=true
  shift
fi
seconds=${1:-30}
executions=${2:--1}
if [[ ${1-} == -h || ${1-} == --help ]]; then usage; exit 0; fi
if (($# > 2)) || [[ ! $seconds =~ ^[1-9][0-9]*$ ]] || [[ ! $executions =~ ^(-1|[1-9][0-9]*)$ ]]; then
  usage >&2
  exit 2
fi

out=$root/build/fuzz
mkdir -p "$out"
configure "$out" -DNORD_DRIVER_FUZZ=ON -DNORD_DRIVER_MERGE_SOURCES=ON -DCMAKE_C_COMPILER=clang-14 -DCMAKE_CXX_COMPILER=clang++-14 \
  >"$out/configure.log" 2>&1 || {
  tail -n 20 "$out/configure.log"
  exit 1
}
cmake --build "$out" -j "$jobs" --target fuzz_targets >"$out/build.log" 2>&1 || {
  tail -n 40 "$out/build.log"
  exit 1
}
if $build_only; then exit 0; fi

# The words of the files that are read: bytes alone would find none of them.
sed -nE 's/^ +([a-z_/]+):.*/"\1: "/p' "$root/doc/parameters.yaml" | sort -u >"$out/fuzz_config.dict"
sed -nE 's/^\| `([a-z_]+)` \|.*/"\1: "/p' "$root/doc/parameter_files.md" | sort -u >"$out/fuzz_catalogue.dict"

# run NAME: one target, for its time.
run() {
  local name=$1 log=$out/$1.log corpus=$out/corpus/$1 start=$SECONDS
  local -a more=()
  mkdir -p "$corpus"
  if [[ -s $out/$name.dict ]]; then more+=("-dict=$out/$name.dict"); fi
  more+=("$corpus")
  if [[ -d $root/fuzz/corpus/$name ]]; then more+=("$root/fuzz/corpus/$name"); fi
  if "$out/bin/$name" -max_total_time="$seconds" -runs="$executions" -max_len=4096 -timeout=10 -print_final_stats=1 \
    -artifact_prefix="$out/$name-" "${more[@]}" >"$log" 2>&1; then
    echo "$name: $(sed -n 's/^stat::number_of_executed_units: *//p' "$log") executions in $((SECONDS - start)) s"
  else
    echo "$name: FAILED, see $log"
    tail -n 30 "$log"
    return 1
  fi
}
export -f run
export out root seconds executions

[[ -s $out/fuzz_targets.txt ]] || {
  echo "$out/fuzz_targets.txt names no target"
  exit 1
}
xargs -n 1 -P "$jobs" bash -c 'run "$1"' fuzz <"$out/fuzz_targets.txt" || exit 1
