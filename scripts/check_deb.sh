#!/usr/bin/env bash
# The Debian package in a minimal Debian that has nothing else: built, installed, and the demo driven. Ends with 0 when the
# robot has moved, with 77 when this cannot be tried here (the last line says why).
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
source "$root/scripts/fresh_debian.sh"

usage() {
  cat <<'TEXT'
usage: check_deb.sh [--tree FOLDER]
  --tree FOLDER  as in build_deb.sh: a build tree to take what is built from
Needs root, about 2 GB below TMPDIR (/var/tmp) and a network: packages come from this machine's own apt sources. Debian
bookworm, as this machine. scripts/check_fresh.sh does the same with what it has built.
TEXT
}

case ${1-} in
  --inside)
    make_debian "$2" "$3" ca-certificates
    try_package "$2/debian" "$2/nord-driver.deb"
    exit
    ;;
  -h | --help) usage; exit 0 ;;
  '' | --tree) ;;
  *) usage >&2; exit 2 ;;
esac

need_root_and_mounts
package=$("$root/scripts/build_deb.sh" "$@" | tail -n 1)
echo "$package"
if command -v lintian >/dev/null; then
  lintian --fail-on error,warning "$package" || fail "lintian has found something"
else
  echo "check_deb: lintian is not installed: the package's form is not looked at"
fi
make_folder bookworm
cp "$package" "$folder/nord-driver.deb"
run_inside bookworm
