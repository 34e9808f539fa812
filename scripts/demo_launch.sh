# shellcheck shell=bash
# Sourced by the scripts that run the demo: a roscore of its own on a free port, so that nothing else on this computer meets it.
# Needs $root, and a shell that has sourced a setup file of the build.

# start_demo LOG [ARGUMENT OF demo.launch...]: returns when the master answers; sets launch to its process.
start_demo() {
  local log=$1 port
  shift
  port=$(python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])')
  export ROS_MASTER_URI="http://127.0.0.1:$port" ROS_IP=127.0.0.1
  unset ROS_HOSTNAME
  roslaunch --port "$port" nord_driver demo.launch output:=log "$@" >>"$log" 2>&1 &
  launch=$!
  for _ in $(seq 100); do
    python3 -c 'import rosgraph, sys; sys.exit(not rosgraph.is_master_online())' 2>>"$log" && break
    kill -0 "$launch" 2>/dev/null || break
    sleep 0.2
  done
}

# TERM: a shell that is no terminal's starts what is beside it deaf to INT.
stop_demo() {
  [[ -n $launch ]] || return 0
  kill -TERM "$launch" 2>/dev/null || true
  wait "$launch" 2>/dev/null || true
}
