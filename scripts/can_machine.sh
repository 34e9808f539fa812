#!/usr/bin/env bash
# Runs a command where the kernel has CAN, with vcan0 and the loopback up, in a network of its own: on this kernel, if it
# has CAN, otherwise in an emulated machine (qemu, pure emulation) that sees this file system as it is. What the command
# writes is gone with the machine, but for the one folder it is given.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

usage() {
  cat <<'TEXT'
usage: can_machine.sh [--keep FOLDER] COMMAND [ARGUMENT...]
  --keep FOLDER  what the command writes into this folder stays
The command runs as root of its own network, in the folder it was called from, and finds in its environment
  NORD_CAN_WHERE        the place in words
  NORD_TIME_FACTOR      1, or 10 where everything is emulated: for time limits
  ROS_HOSTNAME=localhost and a ROS_HOME of its own
Its exit status is that of can_machine.sh; 125 when there was no place to run it.
Settings in the environment:
  NORD_CAN_PLACE        "kernel" or "machine" instead of the first that works
  NORD_CAN_MACHINE_DIR  where kernel and start-up files of the machine are kept (out/can_machine)
  NORD_CAN_TIMEOUT      seconds until an emulated machine is stopped (3000)
TEXT
}

keep=
if [[ ${1-} == --keep && $# -ge 2 ]]; then
  mkdir -p "$2"
  keep=$(cd "$2" && pwd -P)
  shift 2
fi
case ${1-} in
  -h | --help) usage; exit 0 ;;
  '' | -*) usage >&2; exit 2 ;;
esac

cache=${NORD_CAN_MACHINE_DIR:-$root/out/can_machine}
run=$(mktemp -d)
trap 'rm -rf "$run"' EXIT

give_up() {
  echo "can_machine: $*" >&2
  exit 125
}

# What has to be true in both places before the command starts. A word for `bash -c`, run as root of the network.
network='ip link set lo up && ip link add dev vcan0 type vcan && ip link set vcan0 up'

own_network=(unshare --net)
if ((EUID != 0)); then own_network=(unshare --map-root-user --net); fi

kernel_has_can() {
  if ((EUID == 0)); then modprobe -qa can_raw vcan vxcan sch_tbf 2>/dev/null || true; fi
  "${own_network[@]}" bash -c "$network" >/dev/null 2>&1 &&
    /usr/bin/python3 -c 'import socket; socket.socket(socket.AF_CAN, socket.SOCK_RAW, socket.CAN_RAW)' 2>/dev/null
}

# script WHERE FACTOR: what runs inside, on stdout.
script() {
  local where=$1 factor=$2
  shift 2
  cat <<TEXT
export PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 GTEST_COLOR=no
export NORD_CAN_WHERE=$(printf %q "$where") NORD_TIME_FACTOR=$factor
export ROS_HOSTNAME=localhost ROS_HOME=\$(mktemp -d)
unset ROS_MASTER_URI ROS_IP ROS_LOG_DIR
$network || exit 125
cd $(printf %q "$PWD") || exit 125
$(printf '%q ' "$@")
TEXT
}

on_this_kernel() {
  local where
  where="on this machine's own kernel ($(uname -r))"
  echo "can_machine: $where"
  script "$where" 1 "$@" >"$run/inside"
  TMPDIR=$run "${own_network[@]}" bash "$run/inside"
}

in_a_machine() {
  local processors=2 where status ended=0
  local limit=${NORD_CAN_TIMEOUT:-3000} # s; longer than all that runs inside may take
  command -v qemu-system-x86_64 >/dev/null || give_up "qemu-system-x86_64 is missing (scripts/install_deps.sh --test)"
  "$root/scripts/can_machine/make.sh" "$cache" || give_up "the start-up files of the emulated machine could not be made"
  if ((jobs < 2)); then processors=1; fi
  where="in an emulated machine ($(<"$cache/kernel_version"), qemu)"
  echo "can_machine: $where, since this machine's kernel has no CAN"
  mkdir "$run/share"
  script "$where" 10 "$@" >"$run/share/inside"
  local shares=(-virtfs "local,path=$run/share,mount_tag=share,security_model=none")
  if [[ -n $keep ]]; then
    printf %s "$keep" >"$run/share/keep"
    shares+=(-virtfs "local,path=$keep,mount_tag=keep,security_model=none")
  fi
  # Pure emulation: virtualization within a virtual machine hangs on some hosts. Two emulated controllers on one bus.
  timeout --foreground --kill-after=10 "$limit" \
    qemu-system-x86_64 -accel tcg,thread=multi -cpu max -smp "$processors" -m 2G -no-reboot -nic none \
    -display none -vga none -monitor none -serial stdio \
    -kernel "$cache/vmlinuz" -initrd "$cache/initramfs" -append "console=ttyS0 quiet panic=-1" \
    -virtfs local,path=/,mount_tag=host,security_model=none,readonly=on,multidevs=remap "${shares[@]}" \
    -object can-bus,id=bus0 -device kvaser_pci,canbus=bus0 -device kvaser_pci,canbus=bus0 \
    </dev/null | tr -d '\r' || ended=$?
  ((ended != 124)) || give_up "the emulated machine was not done after $limit s"
  ((ended == 0)) || give_up "qemu ended with $ended"
  status=$(cat "$run/share/status" 2>/dev/null) || give_up "the emulated machine stopped before the command was done"
  return "$status"
}

case ${NORD_CAN_PLACE:-} in
  kernel) kernel_has_can || give_up "this machine's kernel has no CAN, or gives no network of our own"; place=on_this_kernel ;;
  machine) place=in_a_machine ;;
  *) if kernel_has_can; then place=on_this_kernel; else place=in_a_machine; fi ;;
esac
status=0
$place "$@" || status=$?
exit "$status"
