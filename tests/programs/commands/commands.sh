#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# commands.sh COMMANDS DIRECTORY
#
# Runs the commands of pages, which commands.py has written to the file COMMANDS, as a reader does, in DIRECTORY. Prints
# TAP. Also runs in the guest of the lane vcan, by busybox.
commands=$1 cases=0 started=
log=$(mktemp)
cd "$2" || exit
unset CMAKE_GENERATOR CMAKE_BUILD_TYPE CMAKE_PREFIX_PATH

verdict() {  # STATUS PAGE COMMAND
  cases=$((cases + 1))
  if [ "$1" -eq 0 ]; then
    echo "ok $2: $3"
  else
    echo "not ok $2: $3"
    tail -n 40 "$log" | sed 's/^\(not \)\{0,1\}ok /| &/'
  fi
}

# Runs in this shell, as later commands may use variables.
run() {  # PAGE COMMAND
  echo "\$ $2"
  eval "$2" </dev/null >"$log" 2>&1
  verdict $? "$1" "$2"
}

# Starts a program that serves until it is killed; the node of the block before has ended by then.
start() {  # PAGE COMMAND
  case $2 in *--serve*) stop ;; esac
  (eval "exec ${2%&}") </dev/null >"$log.started" 2>&1 &
  started="$started $!"
  sleep 2
  kill -0 $! 2>/dev/null
  status=$?
  cp "$log.started" "$log"
  verdict $status "$1" "$2"
}

# Stops the started programs; one that has ended before is a failure.
stop() {
  for process in $started; do
    kill "$process" 2>"$log" || verdict 1 "started program" "ended before it was stopped"
  done
  started=
}

. "$commands"
stop
rm -f "$log" "$log.started"
echo "1..$cases"
