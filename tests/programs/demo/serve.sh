#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# serve.sh NODE MASTER
#
# Tests the demo node and its master on a hub and on a pseudo-terminal: buses without CAN support of the kernel. Both run
# in real time, so each case waits for an event, for minutes. LSS selects the node by its address, because a
# fastscan treats a late answer as a missing one; demo_lss_test.cpp and the lane vcan test the fastscan in simulated time.
set -uo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
node=${1:?the demo node} master=${2:?the demo master}
if ! (exec 3<>/dev/ptmx) 2>/dev/null; then
  echo "skipped: this machine has no pseudo-terminals (mount -t devpts devpts /dev/pts)"
  exit 77
fi
server=
hub=hub:serve-$$
trap 'kill $server 2>/dev/null; rm -r "$work"' EXIT

serve() {  # BUS ARGUMENT... of the node; sets bus to the name by which a master opens it
  : >"$work/trace"  # await must not see the lines of the previous node
  "$node" --serve -i "$@" >"$work/trace" 2>&1 &
  server=$!
  await "$work/trace" '^ *time/s'
  bus=$(sed -nE 's/^Master: .* -i ([^ ]+).*/\1/p' "$work/trace")
}

stop() {  # CASE
  local status=0
  kill -TERM $server
  wait $server || status=$?
  verdict $status "$1" "status $status"
}

at_node() { "$master" -i "$bus" --timeout 600000 "$@"; }
lss() { at_node lss --address 0 0xC10C 1 7 "$@"; }  # the node with --serial 7
has_booted() { await "$work/trace" '705 +00 .*boot-up'; }

serve "$hub" --node-id 5
grep -qx "Master: demo/run master -i $hub --node 5 --index 1008 read" "$work/trace"
verdict $? "the output names the master's command" "$(cat "$work/trace")"
ends "a name is text" 0 "Lexican demo clock" at_node --node 5 --index 1008 read
ends "an index with 0x" 0 "Lexican demo clock" at_node --node 5 --index 0x1008 read
ends "a decimal index behind 0d" 0 "Lexican demo clock" at_node --node 5 --index 0d4104 read
ends "a name as bytes" 0 "4C 65 78 69 *" at_node --node 5 --index 1008 --type bytes read
ends "a version is text" 0 "host" at_node --node 5 --index 1009 read
ends "a number is written" 0 "" at_node --node 5 --index 2100 --sub 1 --type u8 write 7
ends "a number is read" 0 "0x07" at_node --node 5 --index 2100 --sub 1 read
ends "an index that is no number" 2 "--index: '2100h' is no hexadecimal number in 0...FFFF *" at_node --node 5 --index 2100h read
ends "the picture by block transfer" 0 "" at_node --node 5 --index 2200 --file "$work/picture" read
[ "$(stat -c %s "$work/picture")" -eq 73728 ]
verdict $? "every byte of the picture" "$(ls -l "$work/picture")"

ends "NMT without a node" 2 "nmt needs the node to command: --node 1...127, or --node all" at_node nmt start
ends "NMT with an unknown command" 2 "nmt: 'begin' is none of start, stop, *" at_node --node 5 nmt begin
ends "NMT start" 0 "" at_node --node 5 nmt start
await "$work/trace" 'bus +000 +01 05 .*NMT start' && await "$work/trace" '705 +05 .*operational'
verdict $? "the node is operational" "$(tail "$work/trace")"
ends "NMT reset communication of all nodes" 0 "" at_node nmt reset-comm --node all
await "$work/trace" '000 +82 00' && has_booted
verdict $? "the node has booted" "$(tail "$work/trace")"
stop "the node ends with status 0"

serve "$hub" --node-id unconfigured --serial 7
grep -qx "Master: demo/run master -i $hub lss set-id 5" "$work/trace"
verdict $? "without a file the node cannot store" "$(cat "$work/trace")"
ends "LSS gives a node-ID that is not stored" 0 "" lss set-id 5
stop "the node that does not store ends with status 0"

serve "$hub" --node-id unconfigured --serial 7 --storage "$work/clock.nvm"
grep -qx "Master: demo/run master -i $hub lss set-id 5 --store" "$work/trace"
verdict $? "without node-ID, the output names the LSS command" "$(cat "$work/trace")"
ends "LSS gives the node-ID" 0 "" lss set-id 5 --store
has_booted
verdict $? "the node boots with it" "$(tail "$work/trace")"
ends "the node answers with it" 0 "Lexican demo clock" at_node --node 5 --index 1008 read
stop "the node without node-ID ends with status 0"

# Kills a master in a transfer: the next master must not receive the remaining frames.
serve slcan-pty --node-id 5
"$master" -i "$bus" --node 5 --index 2200 --file "$work/half" read &
client=$!
await "$work/trace" '2200h'
kill -KILL $client
wait $client 2>/dev/null
ends "another master after one that was killed" 0 "0x0000C10C" at_node --node 5 --index 1018 --sub 2 read
stop "it, too, ends with status 0"

# Time on the built-in bus is simulated: two runs print the same times, in milliseconds, of all frames.
tour() { "$node" --virtual | tee "$work/$1"; }
ends "the tour on the built-in bus" 0 "*built-in virtual bus*simulated time*22 of 22 steps in 1?.? s, all as expected" tour one
ends "the tour again" 0 "*22 of 22 steps in 1?.? s, all as expected" tour other
ends "both have the same times" 0 "" diff "$work/one" "$work/other"
finish
