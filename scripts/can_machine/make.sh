#!/usr/bin/env bash
# make.sh FOLDER: puts there what the emulated machine starts from: Debian's own kernel and a first file system of busybox
# and the few modules the machine needs. Nothing is installed. Done already: ends at once.
set -euo pipefail
export PATH=/usr/bin:/usr/sbin:/bin:/sbin:$PATH
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
folder=$1

# In the order they are loaded; what they depend on comes before them by itself.
modules=(virtio_pci 9pnet_virtio 9p overlay can can-raw vcan vxcan can-dev kvaser_pci sch_tbf)

give_up() {
  echo "can_machine: $*" >&2
  exit 1
}

made_from=$(cat "$here/make.sh" "$here/init" | sha256sum)
if [[ -e $folder/made_from && $(<"$folder/made_from") == "$made_from" ]]; then exit 0; fi

[[ $(dpkg --print-architecture) == amd64 ]] || give_up "emulated is an amd64 machine, and this one is none"
for program in busybox cpio depmod modprobe; do
  command -v $program >/dev/null || give_up "$program is missing (scripts/install_deps.sh --test)"
done

mkdir -p "$folder"
work=$(mktemp -d "$folder/making.XXXXXX")
trap 'rm -rf "$work"' EXIT

# The generic kernel: Debian's cloud kernel has no CAN.
kernel_package() {
  apt-cache depends linux-image-amd64 2>/dev/null | sed -n 's/^ *Depends: \(linux-image-.*\)$/\1/p' | head -n 1
}
fetch() {
  local package
  package=$(kernel_package)
  [[ -n $package ]] && (cd "$work" && apt-get download "$package") >"$work/log" 2>&1
}
echo "can_machine: fetching Debian's kernel"
if ! fetch; then
  if ((EUID == 0)); then apt-get update >/dev/null 2>&1 || true; fi
  fetch || { sleep 30 && fetch; } || give_up "Debian's kernel package cannot be fetched: $(tail -n 3 "$work/log" 2>/dev/null || true)"
fi
package=$(kernel_package)
version=${package#linux-image-}
dpkg -x "$work"/linux-image-*.deb "$work/kernel"
depmod -b "$work/kernel" "$version"

first=$work/first
mkdir -p "$first/bin" "$first/modules"
cp "$(command -v busybox)" "$first/bin/busybox"
install -m 755 "$here/init" "$first/init"

unpack() {
  case $1 in
    *.xz) xz -dc "$1" ;;
    *.zst) zstd -dcq "$1" ;;
    *.gz) gzip -dc "$1" ;;
    *) cat "$1" ;;
  esac
}
number=100
for module in "${modules[@]}"; do
  while read -r kind path _; do
    [[ $kind == insmod ]] || continue # what is built in needs no file
    name=$(basename "${path%%.ko*}").ko
    compgen -G "$first/modules/???-$name" >/dev/null && continue
    unpack "$path" >"$first/modules/$number-$name"
    number=$((number + 1))
  done < <(modprobe -d "$work/kernel" -S "$version" --show-depends "$module")
done
((number > 100)) || give_up "no module found in $package"
(cd "$first" && find . | LC_ALL=C sort | cpio --quiet -o -H newc -R 0:0 | gzip -1) >"$work/initramfs"

mv "$work/kernel/boot/vmlinuz-$version" "$folder/vmlinuz"
mv "$work/initramfs" "$folder/initramfs"
echo "Linux $version" >"$folder/kernel_version"
echo "$made_from" >"$folder/made_from"
