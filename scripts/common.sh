# Sourced by the scripts beside it: the same surroundings from every folder and shell, sourced workspace or not.
export PATH=/usr/bin:/usr/sbin:/bin:/sbin:$PATH # Debian's python3 has catkin_pkg, one of pyenv has not
unset CMAKE_PREFIX_PATH ROS_PACKAGE_PATH PYTHONPATH LD_LIBRARY_PATH PKG_CONFIG_PATH GTEST_FILTER
# A caller's short campaign, or a single scenario, is not the whole.
unset NORD_CAMPAIGN_BUS NORD_CAMPAIGN_FIRST NORD_CAMPAIGN_REPLAY NORD_MUTANT
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
jobs=$(nproc)

# configure FOLDER [CMAKE OPTION...]
configure() {
  local folder=$1
  shift
  cmake -S "$root" -B "$folder" -DPYTHON_EXECUTABLE=/usr/bin/python3 -DCMAKE_EXPORT_COMPILE_COMMANDS=ON "$@"
}
