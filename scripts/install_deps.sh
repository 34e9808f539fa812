#!/usr/bin/env bash
# Installs the Debian packages this project needs and that are missing (bookworm, bullseye). Everything comes from Debian's
# own archive. Nothing missing: ends with 0 at once, without network.
set -euo pipefail
export PATH=/usr/bin:/usr/sbin:/bin:/sbin:$PATH

usage() {
  cat <<'TEXT'
usage: install_deps.sh [--test] [--deb] [--list]
  --test  also what scripts/test.sh needs beyond a build: formatter, linter, fuzzer, recorders, and a machine with CAN
  --deb   also what scripts/build_deb.sh needs beyond a build
  --list  print the packages, install nothing
Without root it prints the command that installs what is missing and ends with 1.
TEXT
}

# Build, programs and demo. The test libraries belong here: catkin configures the tests with every build.
packages=(
  build-essential cmake
  catkin ros-core-dev rosbash
  libdiagnostic-updater-dev pluginlib-dev
  libdynamic-reconfigure-config-init-mutex-dev python3-dynamic-reconfigure
  libtf2-dev libtf2-ros-dev
  liburdfdom-dev liburdfdom-headers-dev
  libboost-program-options-dev libmodbus-dev libyaml-cpp-dev
  ros-robot-state-publisher python3-rosbag
  librostest-dev python3-rostest
  python3-rospy python3-diagnostic-msgs python3-geometry-msgs python3-nav-msgs python3-std-srvs
  libgtest-dev libgmock-dev librapidcheck-dev
)
test_packages=(
  clang-format-14 clang-tidy-14 clang-14 libclang-rt-14-dev tcpdump
  can-utils iproute2 tshark
  python3-pymodbus python3-serial-asyncio mbpoll # the first imports the second; an independent server for the tests of link/modbus, independent clients of the simulated gateway
  git mmdebstrap # scripts/check_fresh.sh
  debhelper lintian # scripts/check_deb.sh
  man-db systemd udev # what reads the manual pages, the units and the rules of install/
  qemu-system-x86 busybox-static cpio kmod # the emulated machine of scripts/can_machine.sh
)
deb_packages=(debhelper)

# What may be left out where the archive has it not (bullseye, Ubuntu 20.04): each property test is skipped then.
optional=(librapidcheck-dev)

list=false
for argument in "$@"; do
  case $argument in
    --test) packages+=("${test_packages[@]}") ;;
    --deb) packages+=("${deb_packages[@]}") ;;
    --list) list=true ;;
    -h | --help) usage; exit 0 ;;
    *) usage >&2; exit 2 ;;
  esac
done

if $list; then
  printf '%s\n' "${packages[@]}"
  exit 0
fi

if ! command -v apt-get dpkg-query >/dev/null; then
  echo "install_deps: this is not a Debian system; needed are the equivalents of: ${packages[*]}" >&2
  exit 1
fi

# The two exclude each other: apt would take the robot's own ROS away.
if compgen -G '/opt/ros/*/setup.bash' >/dev/null && ! dpkg-query -W catkin >/dev/null 2>&1; then
  echo "install_deps: ROS is in /opt/ros here, and Debian's packages do not go with it: nothing is installed. rosdep does it:" >&2
  echo "rosdep install --from-paths $(printf %q "$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)") --ignore-src" >&2
  exit 0
fi

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f '${db:Status-Status}\n' "$package" 2>/dev/null || true)
  grep -qx installed <<<"$status" || missing+=("$package")
done

# Forgets what is optional and not in the lists of apt, if there are any.
leave_out() {
  local package rest=()
  compgen -G '/var/lib/apt/lists/*_Packages*' >/dev/null || return 0
  for package in "${missing[@]}"; do
    if [[ " ${optional[*]} " == *" $package "* ]] && ! apt-cache show "$package" >/dev/null 2>&1; then
      echo "install_deps: $package does not exist here and is left out" >&2
    else
      rest+=("$package")
    fi
  done
  missing=("${rest[@]}")
}
leave_out
if ((${#missing[@]} == 0)); then
  exit 0
fi

# A desktop's own updates may hold the lock of dpkg for minutes.
install=(apt-get -o DPkg::Lock::Timeout=300 install -y --no-install-recommends)
if ((EUID != 0)); then
  echo "install_deps: missing packages; install them with" >&2
  echo "sudo ${install[*]} ${missing[*]}"
  exit 1
fi

export DEBIAN_FRONTEND=noninteractive
# A machine that has never fetched the lists knows no candidate; one with old lists may be sent to files that are gone.
if apt-cache show "${missing[@]}" >/dev/null 2>&1 && "${install[@]}" "${missing[@]}"; then
  exit 0
fi
for pause in 10 60 0; do # a network or a mirror may be away for a moment
  if apt-get update && leave_out && "${install[@]}" "${missing[@]}"; then
    exit 0
  fi
  sleep "$pause"
done
echo "install_deps: these packages could not be installed: ${missing[*]}" >&2
exit 1
