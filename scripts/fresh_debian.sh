# Sourced by the scripts that try something in a minimal Debian in a temporary folder: how it is made, entered and left. A
# script calls itself again with --inside, in namespaces of its own: whatever is mounted or started there ends with them.
me=$(basename "$0" .sh)

cannot() {
  echo "$me: cannot be tried here: $*"
  exit 77
}

fail() {
  echo "$me: $*" >&2
  exit 1
}

# --- Inside ---

# make_debian FOLDER SUITE PACKAGES: in FOLDER/debian, from FOLDER/sources.list.
make_debian() {
  local folder=$1 suite=$2 packages=$3
  echo "making a minimal Debian $suite"
  try_make_debian "$folder" "$suite" "$packages" || {
    sleep 30 # a network or a mirror may be away for a moment
    rm -rf --one-file-system "$folder/debian"
    try_make_debian "$folder" "$suite" "$packages" || fail "mmdebstrap failed"
  }
  # What an installer leaves and minbase does not.
  printf '127.0.0.1 localhost\n127.0.1.1 %s\n' "$(uname -n)" >"$folder/debian/etc/hosts"
}

try_make_debian() {
  mmdebstrap --quiet --variant=minbase --include="$3" --aptopt="$1/apt.conf" "$2" "$1/debian" - <"$1/sources.list"
}

# enter_debian DEBIAN VARIABLE=VALUE... -- COMMAND...: with no variable of this machine, but those of a proxy.
enter_debian() {
  local debian=$1 variable environment=(HOME=/root TERM=dumb PATH=/usr/sbin:/usr/bin:/sbin:/bin)
  shift
  mount -t proc proc "$debian/proc"
  mount --rbind /dev "$debian/dev"
  for variable in http_proxy https_proxy no_proxy; do
    if [[ -n ${!variable-} ]]; then environment+=("$variable=${!variable}"); fi
  done
  while [[ $1 != -- ]]; do
    environment+=("$1")
    shift
  done
  env -i "${environment[@]}" chroot "$debian" "${@:2}"
}

# What is run in the Debian DEBIAN that has nothing but the package at the path PACKAGE: as its users would.
try_package() {
  local debian=$1 package=$2
  cp "$package" "$debian/root/nord-driver.deb"
  cp "$root/scripts/try_deb.sh" "$debian/root/try_deb.sh"
  enter_debian "$debian" -- bash /root/try_deb.sh /root/nord-driver.deb
}

# --- Outside ---

need_root_and_mounts() {
  ((EUID == 0)) || cannot "it needs root, to make a Debian in a folder"
  command -v mmdebstrap >/dev/null || fail "mmdebstrap is missing (scripts/install_deps.sh --test)"
  unshare --mount --pid --fork --kill-child true 2>/dev/null || cannot "this machine's root may not mount"
}

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
    echo "$me: $folder is left: something is mounted in it" >&2
  else
    rm -rf --one-file-system "$folder"
  fi
}

# make_folder SUITE: sets `folder`, which goes with the script, with the sources of apt for this Debian in it.
make_folder() {
  local suite=$1 mirror= address
  trap clean EXIT
  trap 'exit 129' HUP
  trap 'exit 130' INT
  trap 'exit 143' TERM
  folder=$(mktemp -d "${TMPDIR:-/var/tmp}/nord_driver_fresh.XXXXXX")
  chmod 755 "$folder" # apt fetches as a user of its own
  # The first of this machine's mirrors that has this Debian.
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
}

# run_inside SUITE: the script itself, with --inside, this folder and the suite.
run_inside() {
  local suite=$1 start=$SECONDS status=0
  unshare --mount --pid --fork --kill-child --mount-proc bash "$0" --inside "$folder" "$suite" </dev/null &
  inner=$!
  wait "$inner" || status=$?
  inner=
  ((status == 0)) || fail "$suite: FAILED ($status)"
  echo "$me: $suite: good ($((SECONDS - start)) s)"
}
