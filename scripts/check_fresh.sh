#!/usr/bin/env bash
# README's first command on a fresh machine: a minimal Debian in a temporary folder, in it what is committed, and nothing
# else. Ends with 0 when the command does, with 77 when this cannot be tried here (the last line says why).
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
source "$root/scripts/fresh_debian.sh"

usage() {
  cat <<'TEXT'
usage: check_fresh.sh [bookworm|bullseye]
  bookworm  (default) README's first command; then the Debian package of what it has built, in a second minimal Debian
  bullseye  the nearest that can be had to Ubuntu 20.04: the same, built with g++-9, and then the unit tests
Needs root, about 3 GB below TMPDIR (/var/tmp) and a network: packages come from this machine's own apt sources.
TEXT
}

suite=${1:-bookworm}
case $suite in
  -h | --help) usage; exit 0 ;;
  bookworm | bullseye) ;;
  --inside) ;;
  *) usage >&2; exit 2 ;;
esac

# --- Inside ---

inside() {
  local folder=$1 suite=$2 debian=$1/debian extra=ca-certificates compiler=()
  if [[ $suite == bullseye ]]; then
    extra+=,g++-9
    compiler=(CC=gcc-9 CXX=g++-9)
  fi
  make_debian "$folder" "$suite" "$extra"
  if [[ $suite == bookworm ]]; then cp -a --reflink=auto "$debian" "$folder/second"; fi
  mkdir "$debian/root/nord_driver"
  tar -C "$debian/root/nord_driver" -xf "$folder/clone.tar"
  cp "$folder/within" "$debian/root/within"
  enter_debian "$debian" "${compiler[@]}" -- bash /root/within "$suite" || exit
  if [[ $suite == bullseye ]]; then exit; fi
  # The package of what was built, where nothing of it is; what apt has fetched once it need not fetch again.
  echo "== the Debian package"
  cp -a --reflink=auto "$debian"/var/cache/apt/archives/*.deb "$folder/second/var/cache/apt/archives/" 2>/dev/null || true
  cp -a --reflink=auto "$debian"/var/lib/apt/lists/. "$folder/second/var/lib/apt/lists/"
  try_package "$folder/second" "$(echo "$debian"/root/deb/nord-driver_*.deb)"
}

if [[ $suite == --inside ]]; then
  inside "$2" "$3"
  exit
fi

# --- Outside ---

# What is run in the fresh machine.
within() {
  cat <<TEXT
set -euo pipefail
suite=\$1
cd /root/nord_driver
echo "== $command"
$command
if [[ \$suite == bookworm ]]; then
  scripts/install_deps.sh --deb >/root/deb.log 2>&1 || { tail -n 40 /root/deb.log; exit 1; }
  scripts/build_deb.sh --tree out/demo --output /root/deb
  exit
fi
echo "== unit tests, built with \$(\$CXX -dumpfullversion), CMake \$(cmake --version | sed -n '1s/[^0-9]*//p')"
out=\$PWD/out/demo log=/root/unit_tests.log # what the demo has built need not be built again
{
  cmake -S . -B \$out -DCATKIN_ENABLE_TESTING=ON -DNORD_DRIVER_TEST_OPTIONS=-O0 &&
    cmake --build \$out -j "\$(nproc)" --target unit_tests
} >\$log 2>&1 || { tail -n 60 \$log; exit 1; }
sed -n '/^CMake Warning/,/^\$/p' \$log
status=0
(cd \$out && ctest -R _gtest_ --no-tests=error --output-on-failure) >\$log 2>&1 || status=\$?
if ((status != 0)); then grep -E '^[0-9 ]+/[0-9]+ Test|Failure\$' -A 6 \$log | tail -n 300; fi
read -r passed failed skipped _ <<<"\$(python3 scripts/count_results.py \$out/test_results)"
echo "unit tests: \$passed passed, \$failed failed, \$skipped skipped"
echo "left out: the rostests (they take half an hour), lint, format, fuzz, workspace, the tests on SocketCAN"
((status == 0 && failed == 0 && passed > 0))
TEXT
}

need_root_and_mounts
command=$(sed -n '/^```$/,/^```$/{/^```$/!p}' "$root/README.md" | sed -n '1s/ *#.*//p')
[[ -n $command ]] || fail "README.md has no first command"

make_folder "$suite"
git=(git -C "$root" -c "safe.directory=$root")
"${git[@]}" archive --format=tar -o "$folder/clone.tar" HEAD || fail "what is committed cannot be had from git"
if [[ -n $("${git[@]}" status --porcelain) ]]; then echo "check_fresh: what is not committed is not in it"; fi
within >"$folder/within"

run_inside "$suite"
