#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""typed_walk.py socketcan INTERFACE NODE-ID EDS EXPEDITED SEGMENTED
typed_walk.py socketcand HOST PORT NODE-ID EDS EXPEDITED SEGMENTED

Reads all readable entries of an EDS from a node that `lexican sim` runs, by SDO frames that are written out here, and
compares them with the values of the EDS. At least EXPEDITED values must come expedited, and SEGMENTED in segments.
Prints "ok NAME" or "not ok NAME: DETAIL" for each case.
"""
import configparser
import os
import re
import struct
import sys

import can

import typed_frames

INTEGERS = {1: 1, 2: 1, 3: 2, 4: 4, 5: 1, 6: 2, 7: 4, 0x10: 3, 0x12: 5, 0x13: 6, 0x14: 7, 0x15: 8, 0x16: 3, 0x18: 5,
            0x19: 6, 0x1A: 7, 0x1B: 8}  # bytes
REALS = {8: "<f", 0x11: "<d"}
VISIBLE_STRING = 9
READABLE = ("ro", "rw", "rwr", "rww", "const")
NO_DATA = 0x08000024
OWN_EDS = 0x1021
# Their values are those of the state of the device: errors, what 1010h and 1011h can do, the state of a drive.
OF_STATE = {0x1001, 0x1003, 0x1010, 0x1011, 0x6041, 0x6061}


class Refused(Exception):
    """The node has aborted; the code."""


class Server:
    def __init__(self, bus, node):
        self.bus, self.node = bus, node

    def exchange(self, command, rest=bytes(7)):
        data = bytes([command]) + rest
        self.bus.send(can.Message(arbitration_id=0x600 + self.node, is_extended_id=False, data=data))
        answer = typed_frames.receive(self.bus, 0x580 + self.node)
        if answer == "no answer":
            raise TimeoutError(f"no answer to {data.hex()}")
        answer = bytes.fromhex(answer)
        if answer[0] == 0x80:
            raise Refused(int.from_bytes(answer[4:], "little"))
        return answer

    def upload(self, index, sub):
        """Returns the bytes of an entry, and whether they came in segments."""
        place = struct.pack("<HB", index, sub)
        answer = self.exchange(0x40, place + bytes(4))
        assert len(answer) == 8 and answer[1:4] == place, answer.hex()
        if answer[0] & 0xF3 == 0x43:  # expedited, with the number of unused bytes
            unused = answer[0] >> 2 & 3
            return answer[4:8 - unused], False
        assert answer[0] == 0x41, answer.hex()  # with the size
        size = int.from_bytes(answer[4:], "little")
        value, toggle, is_last = b"", 0, False
        while not is_last:
            answer = self.exchange(0x60 | toggle)
            assert answer[0] & 0xF0 == toggle, answer.hex()
            value += answer[1:8 - (answer[0] >> 1 & 7)]
            is_last = answer[0] & 1 == 1
            toggle ^= 0x10
        assert len(value) == size, f"{len(value)} of {size} bytes"
        return value, True


def entries(path):
    """Yields index, sub-index and section of the entries that can be read."""
    eds = configparser.ConfigParser(interpolation=None, strict=False)
    eds.read(path, encoding="utf-8")
    for name in eds.sections():
        found = re.fullmatch(r"([0-9A-F]{4})(?:sub([0-9A-F]+))?", name, re.IGNORECASE)
        if found and int(found[1], 16) >= 0x1000 and eds[name].get("AccessType", "").lower() in READABLE:
            yield int(found[1], 16), int(found[2] or "0", 16), eds[name]


def described(section, node, path, index):
    """Returns the bytes of an entry as described; None if there is no value."""
    kind, text = int(section["DataType"], 0), section.get("DefaultValue", "").strip()
    if index == OWN_EDS:
        with open(path, "rb") as file:
            return file.read()
    if not text or index in OF_STATE:
        return None
    if kind in REALS:
        return struct.pack(REALS[kind], float(text))
    if kind in INTEGERS:
        parts = [node if part.strip().upper() == "$NODEID" else int(part, 0) for part in text.split("+")]
        return (sum(parts) % (1 << 8 * INTEGERS[kind])).to_bytes(INTEGERS[kind], "little")
    return text.encode() if kind == VISIBLE_STRING else None


def main():
    kind, *place, node, path, least_expedited, least_segmented = sys.argv[1:]
    bus = typed_frames.bus_of(kind, place)
    server = Server(bus, int(node))
    faults, refused = [], []
    expedited = segmented = compared = 0
    for index, sub, section in entries(path):
        name = f"{index:04X}h:{sub:02X}"
        expected = described(section, server.node, path, index)
        try:
            value, in_segments = server.upload(index, sub)
        except Refused as refusal:
            refused += [] if refusal.args[0] == NO_DATA else [f"{name} {refusal.args[0]:08X}h"]
            continue
        except (AssertionError, TimeoutError) as fault:
            faults.append(f"{name} {fault}")
            continue
        segmented += in_segments
        expedited += not in_segments
        compared += expected is not None
        if expected not in (None, value):
            faults.append(f"{name} {value[:40].hex()}, described as {expected[:40].hex()}")
    bus.shutdown()
    file = os.path.basename(path)
    title = f"lexican: sim {file}, typed frames by {kind}"
    good = typed_frames.report(f"{title}: {compared} values are as described", [], faults)
    enough = expedited >= int(least_expedited) and segmented >= int(least_segmented) and compared > 0
    good &= typed_frames.report(f"{title}: {expedited} expedited, {segmented} in segments", True, enough)
    good &= typed_frames.report(f"{title}: no entry is refused", [], refused)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
