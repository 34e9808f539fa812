#!/usr/bin/env bash
# Builds the Debian package from the install space, without a network. Its last line is the package's path.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

usage() {
  cat <<'TEXT'
usage: build_deb.sh [--tree FOLDER] [--output FOLDER]
  --tree FOLDER    a build tree to take what is built from; it is configured for the prefix /usr (build/deb)
  --output FOLDER  where the package goes (build/deb_package)
Needs debhelper besides what a build needs (scripts/install_deps.sh --deb).
TEXT
}

tree=$root/build/deb
output=$root/build/deb_package
while (($# > 0)); do
  case $1 in
    --tree | --output)
      (($# > 1)) || { usage >&2; exit 2; }
      if [[ $1 == --tree ]]; then tree=$2; else output=$2; fi
      shift 2
      ;;
    -h | --help) usage; exit 0 ;;
    *) usage >&2; exit 2 ;;
  esac
done
command -v dh >/dev/null || {
  echo "build_deb: debhelper is missing (scripts/install_deps.sh --deb)" >&2
  exit 1
}

mkdir -p "$tree" "$output"
tree=$(cd "$tree" && pwd -P)
output=$(cd "$output" && pwd -P)
stage=$(mktemp -d)
trap 'rm -rf "$stage"' EXIT

# step NAME COMMAND...: quiet while it works.
step() {
  if ! "${@:2}" >"$stage/log" 2>&1; then
    tail -n 40 "$stage/log" >&2
    echo "build_deb: failed: $1" >&2
    exit 1
  fi
}

# A binary package: no setup files of a workspace in /usr. The libraries stay where the tree has them, in lib.
options=(-DCMAKE_INSTALL_PREFIX=/usr -DCMAKE_INSTALL_LIBDIR=lib -DCATKIN_BUILD_BINARY_PACKAGE=ON)
if [[ ! -e $tree/CMakeCache.txt ]]; then options+=(-DCATKIN_ENABLE_TESTING=OFF); fi
step "configure" configure "$tree" "${options[@]}"
step "build" cmake --build "$tree" -j "$jobs"

version=$(sed -n 's:.*<version>\(.*\)</version>.*:\1:p' "$root/package.xml")
source=$stage/nord-driver-$version
mkdir -p "$source/debian/source"
cp -r "$root"/install/debian/. "$source/debian/"
cp "$root"/install/systemd/*.service "$source/debian/"
cp "$root/install/udev/70-nord-driver.rules" "$source/debian/nord-driver.udev"
cp -r "$root/doc" "$root/README.md" "$source/"
echo "3.0 (native)" >"$source/debian/source/format"
date=$(date -R -r "$root/package.xml")
cat >"$source/debian/changelog" <<TEXT
nord-driver ($version) unstable; urgency=medium

  * Version $version of nord_driver.

 -- $(sed -n 's:^Maintainer\: ::p' "$root/install/debian/control")  $date
TEXT
pack() {
  cd "$source"
  NORD_BUILD_TREE=$tree DEB_BUILD_OPTIONS=noautodbgsym dpkg-buildpackage -b -us -uc
}
step "pack" pack
cp "$stage"/nord-driver_*.deb "$output/"
echo "$output/$(cd "$stage" && echo nord-driver_*.deb)"
