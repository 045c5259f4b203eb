# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=dash
# Runs in guest_test.sh, with its functions: the verbs of the bus tool lexican on vcan0 with the demo node, compared with
# can-utils and python-can.

# Checks status and output of the tool, standard output and error output together.
tool() {  # NAME STATUS OUTPUT-PATTERN ARGUMENT...
  name=$1 expected="$2 $3"
  shift 3
  got=$(LEXICAN_BUS=vcan0 lexican "$@" 2>&1)
  got="$? $got"
  case $got in
    $expected) verdict 0 "lexican: $name" ;;
    *) verdict 1 "lexican: $name" "expected '$expected', got '$got'" ;;
  esac
}

# Waits until a program that runs in the background has printed a text.
printed() {  # TEXT FILE
  tries=1000
  until grep -qs "$1" "$2" || [ $((tries -= 1)) -eq 0 ]; do usleep 10000; done
}

# Runs a program of python-can, which prints the verdicts.
python_can() {  # PROGRAM ARGUMENT...
  program=$1
  shift
  python3 "/$program.py" "$@" >/tmp/typed 2>&1
  status=$?
  grep -E "^(not )?ok " /tmp/typed
  cases=$((cases + $(grep -cE "^(not )?ok " /tmp/typed)))
  verdict $status "lexican: python-can, $program $1" "$(tail -n 1 /tmp/typed)"
}

receivers() { grep -c "vcan0 .* raw" /proc/net/can/rcvlist_all; }

request=605 response=585 heartbeat=705 can=vcan0
listen $heartbeat 2
serve --node-id 5
expect "lexican: the node boots" "$heartbeat#00 $heartbeat#7F"

tool "scan" 0 "*
   5  pre-operational  no profile      00000000:0000C10C  00000001  Lexican demo clock
1 node in * s" scan
tool "read" 0 "1018h:04 serial number = 00000001h (u32)" read 5 1018:4
tool "read of a node that does not exist" 3 "lexican: node 9 does not answer*" read 9 1000
listen "$request $response" 2
tool "write" 0 "2101h:00 = 60 (i16)" write 5 2101 60 --type i16
expect "lexican: write is one request" "$request#2B0121003C000000 $response#6001210000000000"
tool "write of a value that the node refuses" 1 "lexican: node 5, 2101h:00: aborted with 0609 0031h value too high*" \
  write 5 2101 900 --type i16
dd if=/dev/urandom of=/tmp/picture bs="$(wc -c </tmp/picture_before)" count=1 2>/dev/null
tool "write of a file, in blocks" 0 "2200h:00, 73728 bytes" write 5 2200 --file /tmp/picture
tool "read into a file, in blocks" 0 "*" read 5 2200 -o /tmp/picture_back
cmp /tmp/picture /tmp/picture_back
verdict $? "lexican: every byte is read back" "$(ls -l /tmp/picture /tmp/picture_back)"
listen 000 1
tool "nmt start" 0 "node 5 is operational" nmt start 5
expect "lexican: nmt start is one message" "000#0105"
tool "nmt reset, without a question on a virtual interface" 0 "node 5 has booted" nmt reset 5

# mon records the frames that candump does, and shows those of cansend and python-can in words.
others=$(receivers)
candump -L vcan0 -r 8000000 >/tmp/candump.log &
listener=$!
lexican mon -i vcan0 --log /tmp/mon.log >/tmp/mon 2>&1 &
monitor=$!
tries=500
until [ "$(receivers)" -ge $((others + 2)) ] || [ $((tries -= 1)) -eq 0 ]; do usleep 10000; done
cansend vcan0 000#0105
cansend vcan0 085#1043090000000000
python_can typed_frames socketcan vcan0 5
cangen vcan0 -g 0.2 -n 2000 -I i -L i -D i
cangen vcan0 -g 0.2 -n 500 -I r -L r -D r -e
cangen vcan0 -g 0.2 -n 500 -I r -L r -R
usleep 500000
kill -INT $listener
wait $listener
kill -INT $monitor
wait $monitor
verdict $? "lexican: Ctrl-C ends mon with status 0" "status $? $(tail -n 1 /tmp/mon)"
# From the first frame of cansend to the last one of candump: the heartbeats before and behind it reach only one of them.
awk '$3 == "000#0105" { begun = 1 } begun { print $3 }' /tmp/candump.log >/tmp/candump.frames
awk '$3 == "000#0105" { begun = 1 } begun { print $3 }' /tmp/mon.log | head -n "$(wc -l </tmp/candump.frames)" >/tmp/mon.frames
[ "$(wc -l </tmp/candump.frames)" -ge 3000 ] && cmp /tmp/candump.frames /tmp/mon.frames
verdict $? "lexican: the log of mon has the frames of candump" "$(diff /tmp/candump.frames /tmp/mon.frames | head -n 4)"
for text in "NMT start, node 5" "EMCY 4310h" "write 2101h:00 = 005Ah" "write 1000h.*refused: 0601 0002h"; do
  grep -q "   5  $text\|   -  $text" /tmp/mon
  verdict $? "lexican: mon shows '$text'" "$(head -n 20 /tmp/mon)"
done

# share: one bus for lexican, python-can (socketcand) and the kernel's slcan.
lexican share -i vcan0 --pty >/tmp/share 2>&1 &
share=$!
printed "/dev/pts/" /tmp/share
grep -q "^hub:vcan0, socketcand 127.0.0.1:29536/can0.*, slcan-tcp:127.0.0.1:29537" /tmp/share
verdict $? "lexican: share names its ways" "$(cat /tmp/share)"
python_can typed_frames socketcand 127.0.0.1 29536 5
python_can typed_frames slcan socket://127.0.0.1:29537 5
got=$(lexican read 5 1018:2 -i hub:vcan0 2>&1)
[ "$got" = "1018h:02 product code = 0000C10Ch (u32)" ]
verdict $? "lexican: read through the hub of share" "got '$got'"
slcand -F -o -s6 "$(grep -o '/dev/pts/[0-9]*' /tmp/share)" slcan9 >/tmp/slcand 2>&1 &
slcand=$!
tries=500
until /bin/ip link set slcan9 up 2>/dev/null || [ $((tries -= 1)) -eq 0 ]; do usleep 10000; done
verdict $((tries == 0)) "lexican: the pseudo-terminal of share is an slcan interface of the kernel" "$(cat /tmp/slcand)"
usleep 200000
can=slcan9 listen 123 2
cansend vcan0 123#DEADBEEF
cansend vcan0 123#
expect "lexican: candump on it receives the frames of vcan0" "123#DEADBEEF 123#"
listen $response 1
cansend slcan9 $request#4018100200000000
expect "lexican: and a frame that is sent on it reaches the node" "$response#431810020CC10000"
kill $slcand
wait $slcand
kill -INT $share
wait $share
status=$?
[ $status -eq 0 ] && ! grep -q lost /tmp/share
verdict $? "lexican: Ctrl-C ends share with status 0, and no frame was lost" "status $status $(cat /tmp/share)"
kill -TERM $server
wait $server

# sim: the devices of descriptions, read by frames that typed_walk.py writes out.
simulated() {  # EDS NODE-ID EXPEDITED SEGMENTED
  rm -f /tmp/sim
  lexican sim "/descriptions/$1" --node "$2" -i vcan0 </dev/null >/tmp/sim 2>&1 &
  simulation=$!
  printed "^node $2 " /tmp/sim
  python_can typed_walk socketcan vcan0 "$2" "/descriptions/$1" "$3" "$4"
  kill -INT $simulation
  wait $simulation
  verdict $? "lexican: Ctrl-C ends sim $1 with status 0" "status $? $(cat /tmp/sim)"
}
simulated device.eds 7 30 2
simulated servo.eds 8 80 0
simulated clock.eds 9 40 5
