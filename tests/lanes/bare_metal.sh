# SPDX-License-Identifier: Apache-2.0
about="the demo node on four microcontrollers without an operating system, in QEMU; the host's master, over slcan"
minutes=2
. "$root/demo/bare_metal/emulate.sh"
packages=("${build_packages[@]}" python3)
for board in "${boards[@]}"; do
  mapfile -t -O ${#packages[@]} packages < <(board_packages "$board")
done

# Builds for one board after the other, then runs all boards at the same time.
lane() {
  run_pages "$root"
  local board demo arguments targets=(lexican-demo-bare-metal lexican-timer-test)
  host_demo || return
  for board in "${boards[@]}"; do
    mapfile -t arguments < <(toolchain "$board")
    build_tree "bare-metal-$board" -DCMAKE_BUILD_TYPE=MinSizeRel -DLEXICAN_PRESET=slave -DLEXICAN_TESTS=OFF \
      -DLEXICAN_DEMO=ON -DLEXICAN_BOARD="$board" "${arguments[@]}"
  done
  for board in "${boards[@]}"; do
    run_board "$board" "$results/bare-metal-$board" &
  done
  wait
  for board in "${boards[@]}"; do
    count_steps "$board" "$results/bare-metal-$board-tour.log"
    verdict "$board: alarms and clock of its timer" "$results/bare-metal-$board-timer.log"
    verdict "$board: two masters, one after the other, at the node that serves" "$results/bare-metal-$board-serve.log"
    verdict "$board: its name, read by lexican-demo-master" "$results/bare-metal-$board-name.log"
  done
}

run_board() {  # BOARD LOGS
  logged "$2-tour.log" master_at "$1" tour
  logged "$2-timer.log" run_alone "$1" "$build/bare-metal-$1/demo/bare_metal/lexican-timer-test"
  logged "$2-name.log" name_of "$1"
  logged "$2-serve.log" served "$1"
}

logged() {  # LOG COMMAND...
  local log=$1
  shift
  "$@" >"$log" 2>&1
  echo "status $?" >>"$log"
}

verdict() {  # WHAT LOG
  if [ "$(tail -n 1 "$2")" = "status 0" ]; then
    pass
  else
    fail "$1" "$2"
  fi
}

master_at() {  # BOARD ARGUMENT...
  with_board "$1" "$build/bare-metal-$1/demo/bare_metal/lexican-demo-bare-metal" \
    "$demo/linux_master/lexican-demo-master" "${@:2}"
}

# Reports a case for each step of the tour: count_steps BOARD LOG
count_steps() {
  local line title= before=$failed
  while IFS= read -r line; do
    if [[ $line =~ ^\ ?[0-9]+\.\ (.*) ]]; then
      title=${BASH_REMATCH[1]}
    elif [ -n "$title" ] && [[ $line =~ ^\ +ok\  ]]; then
      pass
      title=
    elif [ -n "$title" ] && [[ $line =~ ^\ +FAILED\ +(.*) ]]; then
      fail "$1: $title: ${BASH_REMATCH[1]}"
      title=
    fi
  done <"$2"
  [ -z "$title" ] || fail "$1: ended in: $title" "$2"
  [ "$(tail -n 1 "$2")" = "status 0" ] || [ "$failed" -gt "$before" ] || fail "$1: $(tail -n 1 "$2")" "$2"
}

name_of() {  # BOARD
  local name
  name=$(master_at "$1" --node 1 --index 1009 --timeout 600000 read) && echo "$name" && [ "$name" = "$1" ]
}

# Serves like demo/run --bare-metal BOARD --serve: the emulator continues when a master has disconnected.
served() (  # BOARD
  place=$(mktemp -d)
  serve_board "$1" "$build/bare-metal-$1/demo/bare_metal/lexican-demo-bare-metal" "$place/can" &
  emulator=$!
  trap 'kill "$emulator"; wait "$emulator"; rm -r "$place"' EXIT
  await_socket "$place/can" "$emulator"
  at_board() {
    "$demo/linux_master/lexican-demo-master" -i "slcan:$place/can" --node 1 --timeout 600000 "$@"
  }
  [ "$(at_board --index 1009 read)" = "$1" ] && at_board nmt start && [ "$(at_board --index 1008 read)" = "Lexican demo clock" ]
)
