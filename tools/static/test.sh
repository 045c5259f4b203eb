#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Tests that a program of build.sh needs no other files: test.sh PROGRAM [NODE [EMULATOR]]. NODE, which lexican
# needs, is a lexican-demo-node of this machine. EMULATOR runs a PROGRAM of another CPU. Prints TAP.
set -uo pipefail

program=$(realpath "$1") node=${2:-} emulator=${3:-} name=${1##*/}
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
place=$(mktemp -d)
served=
trap '[ -z "$served" ] || kill "$served"; rm -rf "$place"' EXIT
most_bytes=$((8 * 1024 * 1024))
number=0

report() {  # NAME COMMAND...
  number=$((number + 1))
  if "${@:2}" >"$place/said" 2>&1; then
    echo "ok $number - $1"
  else
    echo "not ok $number - $1: $(tr '\n' ' ' <"$place/said")"
  fi
}

# An empty environment, and an emulator that finds no libraries.
start() {
  if [ -n "$emulator" ]; then
    env -i PATH="$PATH" XDG_RUNTIME_DIR="$place" "$emulator" -L "$place/root" "$program" "$@"
  else
    env -i XDG_RUNTIME_DIR="$place" "$program" "$@"
  fi
}

# Runs the program in the directory $place/root, which contains only the program and its input, as the root directory.
# The user namespace permits chroot for any user. An emulator would have to be there, too: it uses the current root.
run_in_root() {
  local chroot=(chroot)
  if [ -n "$emulator" ]; then
    (cd "$place/root" && start "$@")
    return
  fi
  [ "$(id -u)" = 0 ] || chroot=(unshare --map-root-user chroot)
  env -i PATH="$PATH" "${chroot[@]}" "$place/root" "/$name" "$@"
}

prints() {  # TEXT COMMAND...: succeeds if the output contains the text, whatever the status
  local said
  said=$("${@:2}" 2>&1)
  echo "$said"
  [[ $said == *"$1"* ]]
}

is_small() { wc -c <"$program" && [ "$(wc -c <"$program")" -le $most_bytes ]; }
needs_no_loader() { [ -s "$program" ] && ! LC_ALL=C readelf --program-headers --dynamic "$program" | grep -E 'INTERP|NEEDED'; }
names_its_version() { prints "$name $(sed -n 's/^project(lexican VERSION \([0-9.]*\).*/\1/p' "$root/CMakeLists.txt")" start --version; }
converts() { run_in_root convert drive.eds -o drive.xdd && [ -s "$place/root/drive.xdd" ]; }
shows_log() { prints "heartbeat: operational" run_in_root mon fault.pcapng; }
refused() { prints "Connection refused" start read 1 1008 -i "$1"; }

reads_from_node() {
  XDG_RUNTIME_DIR=$place "$node" --serve -i hub:static --quiet >"$place/node" 2>&1 &
  served=$!
  for _ in {1..50}; do
    [ ! -S "$place/lexican/static.hub" ] || break
    sleep 0.1
  done
  start read 1 1008 -i hub:static
}

# script gives the program a terminal. A key that is typed before the program reads keys can be lost.
shows_screen() {
  local command=(env -i TERM=xterm XDG_RUNTIME_DIR="$place")
  [ -z "$emulator" ] || command+=("$emulator" -L "$place/root")
  prints "q quit" timeout 60 script -qec "${command[*]@Q} ${program@Q} top -i hub:static" /dev/null < <(type_quit)
}

type_quit() {
  for _ in {1..50}; do
    sleep 1
    printf q 2>/dev/null || break
  done
}

mkdir "$place/root"
cp "$program" "$root/tools/codict/tests/fixtures/drive.eds" "$root/tools/lexican/tests/fixtures/fault.pcapng" "$place/root"

case $name in
  codict) echo "1..4" ;;
  lexican) echo "1..8" ;;
esac
report "it has at most 8 MB" is_small
report "it names no loader and no library" needs_no_loader
report "it runs without environment variables" names_its_version
if [ "$name" = codict ]; then
  report "it converts a description where there is no other file" converts
else
  report "it shows a log where there is no other file" shows_log
  report "it connects to a numeric address" refused slcan-tcp:127.0.0.1:1
  report "it connects to localhost" refused socketcand:localhost:1/can0
  report "it reads from a node on a hub" reads_from_node
  report "it shows a live screen" shows_screen
fi
