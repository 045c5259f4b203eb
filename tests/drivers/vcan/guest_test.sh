# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=dash
# Runs in the guest: tests the demo node with can-utils, python-can and the demo master. Frames have the bytes that CiA
# 301 specifies, in candump's notation.

node=lexican-demo-node
can=vcan0 node_id=5
latest_heartbeat=50000  # ticks of the node, which are microseconds: 5 % of its heartbeat time
master=lexican-demo-master
heartbeat=705 request=605 response=585 emcy=085 tpdo=185 rpdo=205 sync=080  # of node-ID 5
cases=0

verdict() {  # STATUS NAME DETAIL
  cases=$((cases + 1))
  if [ "$1" -eq 0 ]; then
    echo "ok $2"
  else
    echo "not ok $2: $3"
  fi
}

listeners() { grep -ci " $1 " /proc/net/can/rcvlist_sff; }  # CAN-ID

# Records data frames of some CAN-IDs until expect is called. No frame is lost, however slow the machine is: listen
# returns when the kernel has registered the listener, whose buffer holds the frames of a long transfer.
listen() {  # "CAN-ID..." NUMBER [MILLISECONDS]
  others=$(listeners "${1##* }")
  filters=
  for id in $1; do filters=$filters,$id:C00007FF; done
  candump -L "$can$filters" -r 8000000 -n "$2" -T "${3:-5000}" >/tmp/heard &
  listener=$!
  tries=500
  until [ "$(listeners "${1##* }")" -gt "$others" ] || [ $((tries -= 1)) -eq 0 ]; do usleep 10000; done
}

# Compares the frames recorded since listen, without time and interface, in one line.
expect() {  # NAME EXPECTED-PATTERN
  wait "$listener"
  got=$(awk '{ printf "%s%s", (NR > 1 ? " " : ""), $3 }' /tmp/heard)
  case $got in
    $2) verdict 0 "$1" ;;
    *) verdict 1 "$1" "expected '$2', got '$got'" ;;
  esac
}

sdo() {  # NAME REQUEST RESPONSE
  listen $response 1
  cansend $can "$request#$2"
  expect "$1" "$response#$3"
}

silence() {  # NAME FRAME
  listen $response 1 500
  cansend $can "$2"
  expect "$1" ""
}

# Sends an NMT command, and waits 200 ms: heartbeats sent before it takes effect have the old state.
nmt() {  # NAME COMMAND STATE
  cansend $can "000#$2"
  usleep 200000
  listen $heartbeat 1
  expect "$1" "$heartbeat#$3"
}

# Expects one boot-up message among the heartbeats.
reboot() {  # NAME COMMAND
  listen $heartbeat 2
  cansend $can "000#$2"
  expect "$1" "*$heartbeat#00*"
}

shown() {  # NAME TEXT: in the trace of the node
  tries=300
  until grep -q "$2" /tmp/trace || [ $((tries -= 1)) -eq 0 ]; do usleep 10000; done
  [ $tries -gt 0 ]
  verdict $? "$1" "no '$2' in the trace"
}

period() {  # NAME MINIMUM MAXIMUM (ms), of the heartbeat
  listen $heartbeat 3
  wait "$listener"
  between=$(tr -d '()' </tmp/heard | awk 'NR == 1 { first = $1 } NR == 3 { printf "%d", ($1 - first) * 500 }')
  [ "${between:-0}" -ge "$2" ] && [ "${between:-0}" -le "$3" ]
  verdict $? "$1" "$between ms between two"
}

# Checks that the master succeeds, and prints exactly this.
says() {  # NAME OUTPUT ARGUMENT...
  name=$1 expected=$2
  shift 2
  got=$($master -i $can --node $node_id "$@" 2>/tmp/said)
  status=$?
  [ $status -eq 0 ] && [ "$got" = "$expected" ]
  verdict $? "$name" "expected '$expected', got '$got', status $status $(cat /tmp/said)"
}

# Checks that the master prints nothing but the error message, and ends with this status.
refuses() {  # NAME STATUS WORDS ARGUMENT...
  name=$1 expected="$2 $3"
  shift 3
  got=$($master "$@" 2>/tmp/said)
  got="$? $got$(cat /tmp/said)"
  [ "$got" = "$expected" ]
  verdict $? "$name" "expected '$expected', got '$got'"
}

# Sends Ctrl-C when a quarter of the picture has been transferred. The last frame of the master must be the abort.
interrupted() {  # NAME ARGUMENT...
  name=$1
  shift
  listen $request 1000000 1000
  : >/tmp/said
  $master --node 5 --index 0x2200 --progress "$@" 2>/tmp/said &
  process=$!
  tries=500
  until grep -q " 25 %" /tmp/said || [ $((tries -= 1)) -eq 0 ]; do usleep 10000; done
  kill -INT $process
  wait $process
  status=$?
  wait "$listener"
  got="$status $(tail -n 1 /tmp/said) $(tail -n 1 /tmp/heard | cut -d ' ' -f 3)"
  [ "$got" = "130 node 5, 2200h:00: cancelled $request#8000220021000008" ]
  verdict $? "$name" "got '$got'"
}

listen 123 1
cansend vcan0 123#DEADBEEF
expect "vcan0 carries a frame" 123#DEADBEEF

listen $heartbeat 2
$node -i vcan0 --node-id 5 --serve --serial 1 >/tmp/trace 2>&1 &
server=$!
expect "boot-up, then heartbeats: pre-operational" "$heartbeat#00 $heartbeat#7F"
period "a heartbeat each second" 800 1200

sdo "identity: four entries" 4018100000000000 4F18100004000000
sdo "identity: product code C10Ch" 4018100200000000 431810020CC10000
sdo "identity: serial number" 4018100400000000 4318100401000000

sdo "device name: 18 bytes" 4008100000000000 4108100012000000
sdo "device name: Lexican" 6000000000000000 004C65786963616E
sdo "device name: _demo_c" 7000000000000000 102064656D6F2063
sdo "device name: lock, the end" 6000000000000000 076C6F636B000000

sdo "hour: written" 2F0021010C000000 6000210100000000
sdo "hour: read back" 4000210100000000 4F0021010C000000
sdo "hour 24: above the limit of the description" 2F00210118000000 8000210131000906
sdo "hour: unchanged" 4000210100000000 4F0021010C000000

sdo "station name: 15 bytes will come" 210122000F000000 6001220000000000
sdo "station name: Central" 0043656E7472616C 2000000000000000
sdo "station name: _Statio" 102053746174696F 3000000000000000
sdo "station name: n, the end" 0D6E000000000000 2000000000000000
sdo "station name: 15 bytes" 4001220000000000 410122000F000000
sdo "station name read back: Central" 6000000000000000 0043656E7472616C
sdo "station name read back: _Statio" 7000000000000000 102053746174696F
sdo "station name read back: n, the end" 6000000000000000 0D6E000000000000

sdo "unknown object: object does not exist" 40FF2F0000000000 80FF2F0000000206
sdo "unknown sub-index: does not exist" 4018100500000000 8018100511000906
sdo "device type: attempt to write a read-only object" 2300100001000000 8000100002000106
sdo "segment without a transfer: unknown command" 6000000000000000 8000000001000405
silence "a request of 7 bytes is not answered" "$request#40181001000000"
silence "a request with an extended identifier is not answered" "00000$request#4018100100000000"
silence "a request to another node is not answered" 606#4018100100000000

nmt "NMT start: operational" 0105 05
nmt "NMT stop: stopped" 0205 04
silence "stopped: no SDO" "$request#4018100000000000"
nmt "NMT enter pre-operational" 8005 7F
nmt "NMT start for all" 0100 05
nmt "NMT stop of another node" 0206 05

cansend vcan0 20000040#0000000000000000
shown "the error frame bus-off is seen" bus-off
cansend vcan0 20000100#0000000000000000
sdo "and life goes on" 4018100000000000 4F18100004000000

reboot "NMT reset node: boot-up" 8105
reboot "NMT reset communication: boot-up" 8205
nmt "NMT start after a reset" 0105 05

# --- PDOs: RPDO1 sets the clock, TPDO1 transmits the time when it changes.

listen $tpdo 3
cansend vcan0 $rpdo#0C2238
expect "RPDO1 sets the clock to 12:34:56, TPDO1 transmits it" "*$tpdo#0C223[89]*"
sdo "and SDO reads the hour" 4000210100000000 4F0021010C000000
listen $emcy 2
cansend vcan0 $rpdo#180000
cansend vcan0 $rpdo#0C2238
expect "RPDO1 with hour 24: EMCY 6300h; after a valid one: 0000h" "$emcy#0063810118000000 $emcy#0000000000000000"
listen $emcy 2
cansend vcan0 $rpdo#0102
cansend vcan0 $rpdo#0C2238
expect "RPDO1 with 2 bytes of 3: EMCY 8210h; after a valid one: 0000h" "$emcy#108211* $emcy#000000*"

# --- SYNC

sdo "TPDO1 with every SYNC" 2F00180201000000 6000180200000000
listen $tpdo 1 2500
expect "without SYNC the synchronous TPDO1 is not sent" ""
listen $tpdo 3 1500
cansend vcan0 $sync#
usleep 200000
cansend vcan0 $sync#
expect "two SYNC messages: TPDO1 twice" "$tpdo#?????? $tpdo#??????"
sdo "RPDO1 with the next SYNC" 2F00140201000000 6000140200000000
cansend vcan0 $rpdo#070809
sdo "before the SYNC: still 12 hours" 4000210100000000 4F0021010C000000
cansend vcan0 $sync#
sdo "after the SYNC: 7 hours" 4000210100000000 4F00210107000000
sdo "SYNC each 250 ms" 2306100090D00300 6006100000000000
listen "$sync $tpdo" 6
cansend vcan0 $request#2305100080000040
expect "the node produces SYNC, and TPDO1 follows each" \
  "$sync# $tpdo#?????? $sync# $tpdo#?????? $sync# $tpdo#??????"
sdo "no SYNC any more" 2305100080000000 6005100000000000
listen $sync 1 1000
expect "after its end no SYNC is sent" ""
sdo "RPDO1 at once" 2F001402FF000000 6000140200000000
sdo "TPDO1 when the time changes" 2F001802FF000000 6000180200000000

# --- Node guarding

guard() {  # NAME EXPECTED-PATTERN: answers to four requests
  listen $heartbeat 4 1000
  for n in 1 2 3 4; do
    cansend $can $heartbeat#R
    usleep 100000
  done
  expect "$1" "$2"
}

sdo "guard time 200 ms" 2B0C1000C8000000 600C100000000000
sdo "life time factor 3" 2F0D100003000000 600D100000000000
listen $heartbeat 1
expect "a heartbeat, and the next one after a second" "$heartbeat#05"
listen $heartbeat 1 500
cansend vcan0 $heartbeat#R
expect "with a heartbeat a remote frame is not answered" ""
sdo "no heartbeat" 2B17100000000000 6017100000000000
guard "node guarding: the toggle bit changes" "$heartbeat#05 $heartbeat#85 $heartbeat#05 $heartbeat#85"
listen $emcy 1
expect "life guarding: EMCY 8130h after 600 ms without a request" "$emcy#308111*"
listen "$heartbeat $emcy" 2
cansend vcan0 $heartbeat#R
expect "the node is in pre-operational; the next request ends the error" "$heartbeat#7F $emcy#000000*"
listen $heartbeat 1
cansend vcan0 000#8205
expect "reset communication: boot-up" "$heartbeat#00"
sdo "the reset has restored the heartbeat; no heartbeat again" 2B17100000000000 6017100000000000
guard "node guarding after a reset: the toggle bit begins with 0" \
  "$heartbeat#7F $heartbeat#FF $heartbeat#7F $heartbeat#FF"
sdo "no life guarding" 2F0D100000000000 600D100000000000
sdo "a heartbeat again" 2B171000E8030000 6017100000000000
nmt "NMT start after guarding" 0105 05

# --- Floods

cangen vcan0 -g 0 -p 10 -n 20000 -I 123 -L 8
sdo "a flood of 20000 foreign frames is survived" 4018100000000000 4F18100004000000
# The reset restores the state before the random NMT and SDO frames.
cangen vcan0 -g 0 -p 10 -n 20000
reboot "a flood of 20000 random frames is survived" 8105
sdo "the node answers afterwards" 4018100200000000 431810020CC10000

python3 /raw_block.py vcan0 5 >/tmp/raw_block 2>&1
status=$?
cat /tmp/raw_block
cases=$((cases + $(grep -cE "^(not )?ok " /tmp/raw_block)))
verdict $status "raw block transfers: all cases pass" "$(tail -n 1 /tmp/raw_block)"

says "master: a number without a type" 0x0000C10C --index 0x1018 --sub 2 read
says "master: a number of its type" 49420 --index 0x1018 --sub 2 --type u32 read
says "master: a string" "Lexican demo clock" --index 0x1008 --type string read
says "master: a name without a type" "Lexican demo clock" --index 1008 read
says "master: a decimal index" "Lexican demo clock" --index 0d4104 read
says "master: a number written" "" --index 0x2100 --sub 1 --type u8 write 17
says "master: the written value is read back" 17 --index 0x2100 --sub 1 --type u8 read
says "master: a string written" "" --index 0x2201 --type string write "Grand Central Terminal"
says "master: the written value is read back" "Grand Central Terminal" --index 0x2201 --type string read
says "master: a string of 30 bytes, in a block" "" --index 0x2201 --type string write "A station with a very long name"
says "master: the written value is read back" "A station with a very long name" --index 0x2201 --type string read
echo "From a file" >/tmp/station
says "master: a short object written from standard input" "" --index 0x2201 --file - write </tmp/station
says "master: and read to standard output" "From a file" --index 0x2201 --file - read

listen 000 1
says "master: NMT stop" "" nmt stop
expect "master: NMT stop is one message for the node" "000#0205"
listen 000 1
$master --node all nmt preop >/tmp/said 2>&1
verdict $? "master: NMT enter pre-operational, for all nodes" "$(cat /tmp/said)"
expect "master: NMT enter pre-operational is one message for all nodes" "000#8000"
says "master: the node answers SDO again" 0x0000C10C --index 1018 --sub 2 read
refuses "master: NMT without a node" 2 "nmt needs the node to command: --node 1...127, or --node all" nmt start

refuses "master: an abort of the node in words" 1 \
  "node 5, 2FFFh:00: aborted with 0602 0000h object does not exist" --node 5 --index 0x2FFF read
refuses "master: an abort of the application in words" 1 \
  "node 5, 2100h:01: aborted with 0609 0031h value too high" --node 5 --index 0x2100 --sub 1 --type u8 write 24
refuses "master: an object that is longer than --max" 1 \
  "node 5, 2200h:00: aborted with 0504 0005h out of memory; the object has more than 1000 bytes" \
  --node 5 --index 0x2200 --max 1000 read
listen 609 2
refuses "master: no such node" 1 "node 9, 1000h:00: no answer; is node 9 on this bus, with power, and at this bit rate?" --node 9 --timeout 200 --index 0x1000 --type u32 read
expect "master: the time-out is sent as an abort" "609#4000100000000000 609#8000100000000405"
refuses "master: a missing interface" 2 \
  "CAN interface 'vcan9': no such interface (a virtual one: ip link add dev NAME type vcan)" \
  -i vcan9 --node 5 --index 0x1000 read

says "master: the initial picture" "" --index 0x2200 --file /tmp/picture_before read
dd if=/dev/urandom of=/tmp/picture bs="$(wc -c </tmp/picture_before)" count=1 2>/dev/null
listen $response 1
says "master: the picture written from a file" "" --index 0x2200 --progress --file /tmp/picture write
expect "master: by block download" "$response#A4002200*"
got=$(grep -oE "[0-9]+ %" /tmp/said | tr '\n' ' ')
[ "$got" = "25 % 50 % 75 % 100 % " ]
verdict $? "master: progress in quarters" "got '$got'"
listen $response 1
says "master: the picture read into a file" "" --index 0x2200 --file /tmp/picture_back read
expect "master: by block upload" "$response#C6002200*"
cmp /tmp/picture /tmp/picture_back
verdict $? "master: every byte is read back" "$(ls -l /tmp/picture /tmp/picture_back)"

interrupted "master: SIGINT ends a download with 08000021h and status 130" --file /tmp/picture write
interrupted "master: SIGINT ends an upload with 08000021h and status 130" --file /tmp/picture_half read
[ ! -e /tmp/picture_half ]
verdict $? "master: no file remains" "$(ls -l /tmp/picture_half)"
says "master: the node continues" "From a file" --index 0x2201 --type string read

kill -TERM $server
wait $server
verdict $? "SIGTERM ends the node with status 0" "status $?"

# --- Six seconds at full load, each of which takes several real ones: all identifiers, lengths and kinds of frames, and
# many for the node. The node reports the lateness of its heartbeats in ticks of its clock, counted from the boot-up
# message. The tolerance is for the seven programs that share one processor.

flood() {  # ARGUMENT... of cangen
  timeout 6 cangen vcan0 -g 0 -p 10 "$@" &
  floods="$floods $!"
}

listen $heartbeat 1
$node -i vcan0 --node-id 5 --serve --quiet >/tmp/end 2>&1 &
server=$!
expect "another node boots" "$heartbeat#00"
nmt "NMT start before the flood" 0105 05
floods=
flood -I i -L i -D r
flood -I r -L r -D r -e
flood -I i -L i -R
flood -I r -L r -e -R
flood -I $rpdo -L r -D r
flood -I $request -L r -D r
for process in $floods; do wait "$process"; done
reboot "6 s of cangen at full speed are survived" 8105
sdo "the node answers afterwards" 4018100200000000 431810020CC10000
kill -TERM $server
wait $server
lateness=$(sed -n 's/^ *\([0-9]*\) heartbeats, greatest lateness \([0-9]*\) us$/\1 \2/p' /tmp/end)
[ "${lateness% *}" -ge 5 ] && [ "${lateness#* }" -le $latest_heartbeat ]
verdict $? "no heartbeat was later than $latest_heartbeat ticks" "$(cat /tmp/end)"
received=$(sed -n 's/.*node *\([0-9]*\) frames received.*/\1/p' /tmp/end)
[ "${received:-0}" -ge 10000 ]
verdict $? "the node has received at least 10000 frames" "$(cat /tmp/end)"
cat /tmp/end

# --- Storage and LSS: stored values survive kill -9, which permits the node no action.

address="vendor-ID, product code, revision, serial number: 0x00000000 0x0000C10C 0x???????? 0x00000001"

serve() {  # ARGUMENT... of the node
  $node -i vcan0 --serve --serial 1 "$@" >/tmp/trace 2>&1 &
  server=$!
}

killed() {  # NAME
  kill -KILL $server
  wait $server 2>/dev/null
  status=$?
  [ $status -eq 137 ]
  verdict $? "$1" "status $status"
}

# Checks that the LSS master succeeds, and prints exactly this.
lss() {  # NAME OUTPUT-PATTERN ARGUMENT...
  name=$1 expected=$2
  shift 2
  got=$($master lss "$@" 2>/tmp/said)
  got="$? $got"
  case $got in
    "0 "$expected) verdict 0 "$name" ;;
    *) verdict 1 "$name" "expected '0 $expected', got '$got' $(cat /tmp/said)" ;;
  esac
}

listen $heartbeat 1
serve --node-id 5 --storage /tmp/storage
expect "storage: a node with an empty file boots" "$heartbeat#00"
says "storage: no time zone" 0 --index 0x2101 --type i16 read
says "storage: a name" "" --index 0x2201 --type string write "Platform 9"
says "storage: a time zone" "" --index 0x2101 --type i16 write 120
sdo "storage: save" 2310100173617665 6010100100000000
says "storage: a name that is not saved" "" --index 0x2201 --type string write "Platform 10"
killed "storage: kill -9"
listen $heartbeat 1
serve --node-id 5 --storage /tmp/storage
expect "storage: the node boots again" "$heartbeat#00"
says "storage: its name is the one that was saved" "Platform 9" --index 0x2201 --type string read
says "storage: its saved time zone" 120 --index 0x2101 --type i16 read
sdo "storage: load" 231110016C6F6164 6011100100000000
killed "storage: kill -9 after load"
listen $heartbeat 1
serve --node-id 5 --storage /tmp/storage
expect "storage: it boots without records" "$heartbeat#00"
says "storage: with the default time zone" 0 --index 0x2101 --type i16 read
killed "storage: kill -9 of a node that has nothing to do"

listen "7E4 $heartbeat" 1 1500
serve --node-id unconfigured --storage /tmp/lss
shown "LSS: a node without node-ID" "without node-ID"
expect "LSS: a node without node-ID sends nothing" ""
lss "LSS: a fastscan finds it" "$address" scan
listen $heartbeat 1 30000  # a fastscan takes its time
lss "LSS: it gets a node-ID, and stores it" "$address" set-id 5 --store
expect "LSS: it boots with its node-ID" "$heartbeat#00"
sdo "LSS: and answers" 4018100200000000 431810020CC10000
lss "LSS: there is no node without node-ID any more" "" scan
killed "LSS: kill -9"
listen $heartbeat 1
serve --node-id unconfigured --storage /tmp/lss
expect "LSS: it has its node-ID" "$heartbeat#00"
kill -TERM $server
wait $server

for id in 0 128 none; do
  $node -i vcan0 --node-id $id --serve >/tmp/tour 2>&1
  [ $? -eq 2 ] && grep -q -e --node-id /tmp/tour
  verdict $? "node-ID $id is refused, status 2" "$(cat /tmp/tour)"
done
$node -i vcan0 --node-id 5 --serve --storage /tmp/missing/file >/tmp/tour 2>&1
[ $? -eq 2 ] && grep -q /tmp/missing/file /tmp/tour
verdict $? "a file that cannot be created: named, status 2" "$(cat /tmp/tour)"

# Without arguments the demo uses vcan0.
$node >/tmp/tour 2>&1 && grep -q "steps in .* all as expected" /tmp/tour && head -n 1 /tmp/tour | grep -q vcan0
verdict $? "the tour uses vcan0 without options" "$(tail -n 1 /tmp/tour)"
$node -i vcan9 >/tmp/tour 2>&1
[ $? -eq 2 ] && grep -q vcan9 /tmp/tour
verdict $? "a missing interface: named, status 2" "$(tail -n 1 /tmp/tour)"
$node -i lo >/tmp/tour 2>&1
[ $? -eq 2 ] && grep -q lo /tmp/tour
verdict $? "an interface that is not CAN: named, status 2" "$(tail -n 1 /tmp/tour)"

# demo/heater: its dictionary is generated from an EDS during the build.
request=609 response=589 heartbeat=709 tpdo=189
listen $heartbeat 1
heater vcan0 9 &
server=$!
expect "the generated node boots" "$heartbeat#00"
sdo "the generated node has the default value of its description" 4001200000000000 4B012000C8000000
sdo "the generated node checks the limits of its description" 2B012000E8030000 8001200031000906
sdo "the generated node accepts a value within them" 2B01200064000000 6001200000000000
got=$($master --node 9 --index 2001 --type i16 write 250 2>&1 && $master --node 9 --index 2001 --type i16 read 2>&1)
[ "$got" = 250 ]
verdict $? "the generated node accepts a setpoint" "got '$got'"
refuses "the generated node refuses a setpoint above its limit" 1 \
  "node 9, 2001h:00: aborted with 0609 0031h value too high" --node 9 --index 2001 --type i16 write 9000
listen $tpdo 2
$master --node 9 nmt start
expect "the generated node sends changed values" "$tpdo#??00 $tpdo#??00"
kill $server

# --- SRDO: a button (node-ID 4) and a drive (node-ID 5), demo/srdo

restarted() {  # NAME: errors end when the nodes leave Operational
  : >/tmp/trace
  cansend vcan0 000#8000
  cansend vcan0 000#0100
  shown "$1" "motor on"
}

: >/tmp/trace
listen "107 108" 4
lexican-demo-srdo -i vcan0 --serve >>/tmp/trace 2>&1 &
server=$!
expect "SRDO: pairs of frames, inverse to each other" "107#00 108#FF 107#00 108#FF"
shown "SRDO: the consumer is established" "drive:  established"
shown "SRDO: the motor runs" "motor on"
listen 085 1
cansend vcan0 108#00
expect "SRDO: an inverse frame without a plain one: EMCY 8200h with the state 5" "085#0082110000011305"
shown "SRDO: the safe state: frames not inverse" "drive:  error: frames not inverse"
shown "SRDO: the motor is off" "motor off"
restarted "SRDO: established again after the error"
cansend vcan0 107#00
shown "SRDO: the safe state after a plain frame without an inverse one" "drive:  error: "
shown "SRDO: the motor is off" "motor off"
restarted "SRDO: established again"
cansend vcan0 000#8004
shown "SRDO: the safe state after the end of the producer" "drive:  error: no pair in time"
shown "SRDO: the motor is off" "motor off"
kill -TERM $server
wait $server
verdict $? "SRDO: SIGTERM ends the nodes with status 0" "status $?"
lexican-demo-srdo -i vcan0 >/tmp/trace 2>&1
verdict $? "SRDO: the motor stops when the button is pressed and when its contact fails" "$(cat /tmp/trace)"

. /lexican_verbs

# --- The driver of SJA1000 on a PCI card of QEMU; the other end is the kernel's driver on a second card.

can=can0 node_id=10 request=60A response=58A heartbeat=70A emcy=08A
card=/sys/bus/pci/devices/0000:00:11.0/resource1

sja1000_card $card $can >/tmp/check
verdict $? "SJA1000: driver check, the kernel's driver as peer" "$(grep -v ^ok /tmp/check | head -n 3)"
listen $heartbeat 2
sja1000_card $card 10 >/tmp/trace &
server=$!
expect "SJA1000: boot-up, then a heartbeat" "$heartbeat#00 $heartbeat#7F"
period "SJA1000: a heartbeat each second" 950 1050
sdo "SJA1000: vendor-ID" 4018100100000000 4318100178563412
silence "SJA1000: a request with an extended identifier is not answered" "00000$request#4018100100000000"
silence "SJA1000: a request to another node is not answered" 60B#4018100100000000
nmt "SJA1000: NMT start: operational" 010A 05
reboot "SJA1000: NMT reset node: boot-up" 810A
reboot "SJA1000: NMT reset communication: boot-up" 820A
sdo "SJA1000: no heartbeat" 2B17100000000000 6017100000000000
guard "SJA1000: node guarding, by remote frames" "$heartbeat#7F $heartbeat#FF $heartbeat#7F $heartbeat#FF"
sdo "SJA1000: the heartbeat of node 11 passes the filter from now on" 231610012C010B00 6016100100000000
listen $emcy 1
cansend $can 70B#05
expect "SJA1000: EMCY 8130h when a second heartbeat of node 11 is missing" "$emcy#308111*"

# The kernel sends the segments of a block without a pause: more frames than fit in the FIFO.
dd if=/dev/urandom of=/tmp/text bs=200 count=1 2>/dev/null
listen $response 1
says "SJA1000: 200 bytes written" "" --index 0x2000 --file /tmp/text write
expect "SJA1000: by block download" "$response#A4002000*"
listen $response 1
says "SJA1000: 200 bytes read" "" --index 0x2000 --file /tmp/text_back read
expect "SJA1000: by block upload" "$response#C6002000*"
cmp /tmp/text /tmp/text_back
verdict $? "SJA1000: every byte is read back" "$(ls -l /tmp/text /tmp/text_back)"
overflows=$($master -i $can --node $node_id --index 0x2001 --type u32 read 2>&1)
[ "$overflows" -gt 0 ]
verdict $? "SJA1000: overflows of the FIFO in the block download were counted" "got '$overflows'"
cangen $can -g 0 -p 10 -n 2000 -I 70B -L 8
got=$($master -i $can --node $node_id --index 0x2001 --type u32 read 2>&1)
[ "$got" -gt "$overflows" ]
verdict $? "SJA1000: and in a flood of 2000 frames, after which the node answers" "got '$got' after '$overflows'"
kill $server

lexican_bus_tests >/tmp/socketcan 2>&1
summary=$(grep "test cases:" /tmp/socketcan)
echo "$summary" | grep -Eq "test cases: +10 +\| +10 passed"
verdict $? "the SocketCAN driver on real interfaces: 10 cases" "$summary; $(grep -A3 "ERROR" /tmp/socketcan | tr '\n' ' ')"

# The pages show /dev/pts/0 as an example of the name that the node prints.
$node --serve -i slcan-pty --node-id 5 >/tmp/trace 2>&1 &
sh /commands.sh /vcan.commands /lexican >/tmp/pages
grep -v '^1\.\.' /tmp/pages
cases=$((cases + $(grep -cE '^(not )?ok ' /tmp/pages)))

checked() {  # OTHER-END NAME
  lexican-driver-check vcan0 "$1" >/tmp/check 2>&1
  verdict $? "driver check of SocketCAN, $2" "$(grep -v ^ok /tmp/check | head -n 3)"
}

checked peer "two sockets"
sh /bin/feed vcan0 >/tmp/fed 2>&1 &
tries=500
until grep -q "vcan0.* raw" /proc/net/can/rcvlist_all || [ $((tries -= 1)) -eq 0 ]; do usleep 10000; done
checked feed "the script feed as the other end"

echo "1..$cases"
