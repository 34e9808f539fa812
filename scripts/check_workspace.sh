#!/usr/bin/env bash
# The ordinary ROS way in a workspace made for it: catkin_make, catkin_make install; then, from the devel space and from an
# install space left alone (sources and devel space moved away), every program answers --version, the launch files parse
# and the plugin description is found. Last, a transport from a package of its own (test/plugins/loopback) is built against the
# install space alone, and nord_param talks over it.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

workspace=$(mktemp -d)
trap 'rm -rf "$workspace"' EXIT
export ROS_HOME=$workspace/ros_home

version=$(sed -n 's:.*<version>\(.*\)</version>.*:\1:p' "$root/package.xml")
mkdir -p "$workspace/src/nord_driver"
tar -C "$root" --exclude=./out --exclude=./build --exclude='./out-*' --exclude=./.git -cf - . | tar -C "$workspace/src/nord_driver" -xf -

# step NAME COMMAND...: quiet while it works.
step() {
  local log=$workspace/log
  echo "$1"
  if ! "${@:2}" >"$log" 2>&1; then
    tail -n 40 "$log"
    echo "check_workspace: failed: $1"
    exit 1
  fi
}

# in_space SETUP COMMAND: in a new shell that has sourced this setup file and nothing else.
in_space() {
  env -u CMAKE_PREFIX_PATH -u ROS_PACKAGE_PATH bash -c "source '$1' && $2"
}

programs_of() {
  find "$1/lib/nord_driver" -maxdepth 1 -type f -executable ! -name 'test_*' ! -name '*.so*' -printf '%f\n' | sort
}

# look_into SPACE: what a user does first.
look_into() {
  local space=$1 programs program answer
  programs=$(programs_of "$space" 2>/dev/null || true)
  grep -qx nord_driver_node <<<"$programs" || {
    echo "check_workspace: $(basename "$space") space has no nord_driver_node"
    exit 1
  }
  for program in $programs; do
    answer=$(in_space "$space/setup.bash" "timeout 60 rosrun nord_driver $program --version" 2>&1) &&
      grep -qF "$version" <<<"$answer" || {
      echo "check_workspace: rosrun nord_driver $program --version says, where $version was expected: $answer"
      exit 1
    }
  done
  in_space "$space/setup.bash" 'rospack plugins --attrib=plugin nord_driver' | grep -q nord_driver_plugins.xml || {
    echo "check_workspace: no plugin description in the $(basename "$space") space"
    exit 1
  }
  local launch
  for launch in "$root"/launch/*.launch; do
    [[ -e $launch ]] || continue
    launch=$(basename "$launch")
    # Every launch file takes a configuration; one has no default for it.
    in_space "$space/setup.bash" \
      "roslaunch --files nord_driver $launch config:=\$(rospack find nord_driver)/config/demo.yaml" >/dev/null || {
      echo "check_workspace: roslaunch does not find $launch in the $(basename "$space") space"
      exit 1
    }
  done
}

make=(catkin_make -C "$workspace" -j "$jobs" -DPYTHON_EXECUTABLE=/usr/bin/python3
  -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O0 # without debug information: nobody debugs these
  -DNORD_DRIVER_PRECOMPILE=ON -DNORD_DRIVER_MERGE_SOURCES=ON) # lint reads each source alone
step "catkin_make" "${make[@]}"
look_into "$workspace/devel"
step "catkin_make install" "${make[@]}" install
mkdir "$workspace/away"
mv "$workspace/src" "$workspace/devel" "$workspace/build" "$workspace/away/"
look_into "$workspace/install"

# A transport of somebody else, in a workspace that has never seen the sources: built against what is installed, and loaded.
foreign=$workspace/foreign
mkdir -p "$foreign/src"
cp -r "$root/test/plugins/loopback" "$foreign/src/nord_driver_loopback"
build_foreign() {
  in_space "$workspace/install/setup.bash" "catkin_make -C '$foreign' -DPYTHON_EXECUTABLE=/usr/bin/python3 install"
}
step "a foreign transport against the install space" build_foreign
rm -r "$foreign/src" "$foreign/devel" "$foreign/build"
# foreign_says ANSWER ARGUMENTS...: of nord_param with that transport.
foreign_says() {
  local answer
  answer=$(in_space "$foreign/install/setup.bash" "timeout 60 rosrun nord_driver nord_param \
    --config \$(rospack find nord_driver_loopback)/loopback.yaml --bus B ${*:2}" 2>&1) || true
  grep -qF "$1" <<<"$answer" || {
    echo "check_workspace: nord_param ${*:2} over a foreign transport says, where \"$1\" was expected: $answer"
    exit 1
  }
}
foreign_says "loopback place 7" list
foreign_says "Maximum frequency = 50.0 Hz" read belt P105
foreign_says "loopback error 1, nobody has told this drive of such a parameter" read belt P999
