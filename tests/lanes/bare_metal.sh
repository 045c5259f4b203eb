# SPDX-License-Identifier: Apache-2.0
about="the demo node on four microcontrollers without an operating system, in QEMU; the host's master, over slcan"
. "$root/demo/bare_metal/emulate.sh"
packages=("${build_packages[@]}")
for board in "${boards[@]}"; do
  mapfile -t -O ${#packages[@]} packages < <(board_packages "$board")
done

# In the directory of the lane vcan, but only what is needed here.
build_master() {
  (cd "$root" && cmake -S "$root" -B "$build/release" -G Ninja -DLEXICAN_PRESET=full --preset release) &&
    cmake --build "$build/release" --target lexican-demo-master
}

# One board at a time: an emulated UART is not paced, and a board that gets too little of the host's CPU loses bytes.
lane() {
  build_master >"$results/build-bare-metal.log" 2>&1 || { fail "build of the master" "$results/build-bare-metal.log"; return; }
  local board
  for board in "${boards[@]}"; do
    build_board "$board" "$build/bare-metal-$board" lexican-demo-bare-metal lexican-timer-test \
      >"$results/build-bare-metal-$board.log" 2>&1 || fail "build for $board" "$results/build-bare-metal-$board.log"
  done
  for board in "${boards[@]}"; do
    master_at "$board" tour >"$results/bare-metal-$board.log" 2>&1
    count_steps "$board" "$results/bare-metal-$board.log"
    check "$board: alarms and clock of its timer" \
      run_alone "$board" "$build/bare-metal-$board/demo/bare_metal/lexican-timer-test"
    check "$board: its name, read by lexican-demo-master --slcan" name_of "$board"
  done
}

master_at() {  # BOARD ARGUMENT...
  with_board "$1" "$build/bare-metal-$1/demo/bare_metal/lexican-demo-bare-metal" \
    "$build/release/demo/linux_master/lexican-demo-master" "${@:2}"
  local status=$?
  echo "status $status"
  return $status
}

# A case for each step of the tour: BOARD LOG
count_steps() {
  local line title=
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
  [ "$(tail -n 1 "$2")" = "status 0" ] || [ "$failed" -gt 0 ] || fail "$1: $(tail -n 1 "$2")" "$2"
}

name_of() {  # BOARD
  master_at "$1" --node 1 --index 0x1009 --type string --timeout 30000 read | tee "$results/bare-metal-name"
  head -n 1 "$results/bare-metal-name" | grep -qx "$1"
}
