#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""typed_frames.py socketcan INTERFACE NODE-ID
typed_frames.py socketcand HOST PORT NODE-ID
typed_frames.py slcan URL NODE-ID

Sends SDO frames to the demo node by python-can, and checks the answers. With socketcand and slcan, the bus is that of
`lexican share`, where frames without a pause must arrive, too. Prints "ok NAME" or "not ok NAME: DETAIL" for each case.
"""
import encodings.idna  # of socket addresses
import sys
import time

import can
import can.interfaces.slcan  # otherwise loaded by their names
import can.interfaces.socketcan
import can.interfaces.socketcand
import serial.urlhandler.protocol_socket

ANSWER_SECONDS = 10
FLOOD = 1000
EXCHANGES = (
    ("product code", "4018100200000000", "431810020cc10000"),
    ("time zone = 90", "2b0121005a000000", "6001210000000000"),
    ("device type is read-only", "2300100005000000", "8000100002000106"),
)


def receive(bus, identifier):
    end = time.monotonic() + ANSWER_SECONDS
    while time.monotonic() < end:
        message = bus.recv(end - time.monotonic())
        if message and message.arbitration_id == identifier:
            return message.data.hex()
    return "no answer"


def report(name, expected, got):
    print(f"ok {name}" if got == expected else f"not ok {name}: expected {expected}, got {got}", flush=True)
    return got == expected


def echoes(bus, other):
    """Returns the numbers in the frames that have arrived on another connection, in their order."""
    got = []
    for number in range(FLOOD):
        bus.send(can.Message(arbitration_id=0x123, is_extended_id=False, data=number.to_bytes(4, "big")))
    while len(got) < FLOOD and (data := receive(other, 0x123)) != "no answer":
        got.append(int(data, 16))
    return got


def bus_of(kind, place):
    if kind == "socketcan":
        options = {"channel": place[0]}
    elif kind == "slcan":
        options = {"channel": place[0], "bitrate": 500000, "sleep_after_open": 0}
    else:
        options = {"channel": "can0", "host": place[0], "port": int(place[1])}
    return can.Bus(interface=kind, **options)


def main():
    kind, *place, node_id = sys.argv[1:]
    bus = bus_of(kind, place)
    good = True
    for name, request, answer in EXCHANGES:
        bus.send(can.Message(arbitration_id=0x600 + int(node_id), is_extended_id=False, data=bytes.fromhex(request)))
        good &= report(f"lexican: python-can by {kind}: {name}", answer, receive(bus, 0x580 + int(node_id)))
    if kind != "socketcan":
        with bus_of(kind, place) as other:
            got = echoes(bus, other)
        same = got == list(range(FLOOD))
        good &= report(f"lexican: python-can by {kind}: {FLOOD} frames arrive in their order", True, same)
    bus.shutdown()
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
