#!/usr/bin/env bash
# README's first command on a fresh machine: a minimal Debian in a temporary folder, in it what is committed, and nothing
# else. Ends with 0 when the command does, with 77 when this cannot be tried here (the last line says why).
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

usage() {
  cat <<'TEXT'
usage: check_fresh.sh [bookworm|bullseye]
  bookworm  (default) README's first command
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

cannot() {
  echo "check_fresh: cannot be tried here: $*"
  exit 77
}

fail() {
  echo "check_fresh: $*" >&2
  exit 1
}

# --- Inside: in namespaces of its own. Whatever is mounted or started here ends with them. ---

# make_debian FOLDER SUITE PACKAGES: in FOLDER/debian.
make_debian() {
  mmdebstrap --quiet --variant=minbase --include="$3" --aptopt="$1/apt.conf" "$2" "$1/debian" - <"$1/sources.list"
}

# What an installer leaves and minbase does not.
name_machine() {
  printf '127.0.0.1 localhost\n127.0.1.1 %s\n' "$(uname -n)" >"$1/etc/hosts"
}

inside() {
  local folder=$1 suite=$2 debian=$1/debian extra=ca-certificates
  if [[ $suite == bullseye ]]; then extra+=,g++-9; fi
  echo "making a minimal Debian $suite"
  make_debian "$folder" "$suite" "$extra" || {
    sleep 30 # a network or a mirror may be away for a moment
    rm -rf --one-file-system "$debian"
    make_debian "$folder" "$suite" "$extra" || fail "mmdebstrap failed"
  }
  name_machine "$debian"
  mkdir "$debian/root/nord_driver"
  tar -C "$debian/root/nord_driver" -xf "$folder/clone.tar"
  cp "$folder/within" "$debian/root/within"
  mount -t proc proc "$debian/proc"
  mount --rbind /dev "$debian/dev"
  # No variable of this machine, but those of a proxy.
  local variable environment=(HOME=/root TERM=dumb PATH=/usr/sbin:/usr/bin:/sbin:/bin)
  for variable in http_proxy https_proxy no_proxy; do
    if [[ -n ${!variable-} ]]; then environment+=("$variable=${!variable}"); fi
  done
  if [[ $suite == bullseye ]]; then environment+=(CC=gcc-9 CXX=g++-9); fi
  exec env -i "${environment[@]}" chroot "$debian" bash /root/within "$suite"
}

if [[ $suite == --inside ]]; then
  inside "$2" "$3"
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
if [[ \$suite == bookworm ]]; then exit 0; fi
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

((EUID == 0)) || cannot "it needs root, to make a Debian in a folder"
command -v mmdebstrap >/dev/null || fail "mmdebstrap is missing (scripts/install_deps.sh --test)"
unshare --mount --pid --fork --kill-child true 2>/dev/null || cannot "this machine's root may not mount"

command=$(sed -n '/^```$/,/^```$/{/^```$/!p}' "$root/README.md" | sed -n '1s/ *#.*//p')
[[ -n $command ]] || fail "README.md has no first command"

folder=
inner=
# Nothing is mounted in the folder as seen from here; if it were, deleting would go through.
clean() {
  if [[ -n $inner ]]; then
    kill -KILL "$inner" 2>/dev/null || true
    wait "$inner" 2>/dev/null || true
  fi
  [[ -n $folder ]] || return 0
  if grep -qF " $folder/" /proc/self/mountinfo; then
    echo "check_fresh: $folder is left: something is mounted in it" >&2
  else
    rm -rf --one-file-system "$folder"
  fi
}
trap clean EXIT
trap 'exit 129' HUP
trap 'exit 130' INT
trap 'exit 143' TERM
folder=$(mktemp -d "${TMPDIR:-/var/tmp}/nord_driver_fresh.XXXXXX")
chmod 755 "$folder" # apt fetches as a user of its own

# The first of this machine's mirrors that has this Debian.
mirror=
while read -r address; do
  /usr/lib/apt/apt-helper download-file "${address%/}/dists/$suite/InRelease" "$folder/InRelease" >"$folder/log" 2>&1 || continue
  grep -qx 'Label: Debian' "$folder/InRelease" && grep -qx "Codename: $suite" "$folder/InRelease" || continue
  mirror=$address
  break
done < <(apt-get indextargets --format '$(REPO_URI)' 'Identifier: Packages' 'Component: main' | sort -u)
[[ -n $mirror ]] || cannot "no mirror of this machine's apt sources answers with Debian $suite"
echo "deb $mirror $suite main" >"$folder/sources.list"
# How this machine reaches it.
apt-config dump Acquire | grep -iE '^Acquire::(Check-Valid-Until|Check-Date|https?::Proxy) ' >"$folder/apt.conf" || true

git=(git -C "$root" -c "safe.directory=$root")
"${git[@]}" archive --format=tar -o "$folder/clone.tar" HEAD || fail "what is committed cannot be had from git"
if [[ -n $("${git[@]}" status --porcelain) ]]; then echo "check_fresh: what is not committed is not in it"; fi
within >"$folder/within"

start=$SECONDS
unshare --mount --pid --fork --kill-child --mount-proc bash "${BASH_SOURCE[0]}" --inside "$folder" "$suite" </dev/null &
inner=$!
status=0
wait "$inner" || status=$?
inner=
((status == 0)) || fail "$suite: FAILED ($status)"
echo "check_fresh: $suite: good ($((SECONDS - start)) s)"
