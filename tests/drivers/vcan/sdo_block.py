# SPDX-License-Identifier: Apache-2.0
"""The client side of SDO block transfer, by python-can.

Frames and CRC are written down from CiA 301, 7.2.4.3.8 to 7.2.4.3.16; nothing of them comes from the stack.
"""
import itertools

import can
import can.interfaces.socketcan  # otherwise loaded by its name

SEGMENT = 7  # bytes
LAST = 0x80  # in the first byte of a segment
WAIT = 10  # s; the node answers at once, or after its silence of 0.5 s
QUIET = 0.3  # s, in which nothing comes


def crc_table():
    for byte in range(256):
        remainder = byte << 8
        for _ in range(8):
            remainder = remainder << 1 ^ (0x1021 if remainder & 0x8000 else 0)
        yield remainder & 0xFFFF


CRC_TABLE = list(crc_table())


def crc_of(data):
    remainder = 0
    for byte in data:
        remainder = remainder << 8 & 0xFFFF ^ CRC_TABLE[remainder >> 8 ^ byte]
    return remainder


assert crc_of(b"123456789") == 0x31C3


class Unexpected(Exception):
    """What the node did, against what it should have done."""


def shown(value):
    return value.hex(" ").upper() if isinstance(value, bytes) else value


def same(what, got, expected):
    if got != expected:
        raise Unexpected(f"{what}: expected {shown(expected)}, got {shown(got)}")


def frame(*values):
    """A frame of bytes, padded by zeros."""
    return bytes(values).ljust(8, b"\0")


def head(command, entry, rest=b""):
    """A frame with a multiplexer."""
    index, sub = entry
    return (bytes([command]) + index.to_bytes(2, "little") + bytes([sub]) + rest).ljust(8, b"\0")


def abort(entry, code):
    return head(0x80, entry, code.to_bytes(4, "little"))


class Node:
    """The SDO server of a node."""

    def __init__(self, interface, node_id):
        self.request = 0x600 + node_id
        response = {"can_id": 0x580 + node_id, "can_mask": 0x7FF, "extended": False}
        self.bus = can.interface.Bus(interface="socketcan", channel=interface, can_filters=[response])

    def send(self, data):
        self.bus.send(can.Message(arbitration_id=self.request, data=data, is_extended_id=False))

    def receive(self):
        message = self.bus.recv(WAIT)
        if message is None:
            raise Unexpected("no answer")
        same("DLC", message.dlc, 8)
        return bytes(message.data)

    def ask(self, data):
        self.send(data)
        return self.receive()

    def silent(self):
        message = self.bus.recv(QUIET)
        same("silence", None if message is None else bytes(message.data), None)

    def drain(self):
        """Takes what is still to come."""
        while self.bus.recv(QUIET):
            pass


# --- Block download


def segments_of(data):
    return [data[at : at + SEGMENT].ljust(SEGMENT, b"\0") for at in range(0, len(data), SEGMENT)]


def in_order(seqnos):
    """How many of these the server takes: each must be the one after the last."""
    taken = 0
    for seqno in seqnos:
        taken += seqno == taken + 1
    return taken


def begin_download(node, entry, size=None, crc=True):
    """Returns the blksize of the node."""
    answer = node.ask(head(0xC0 | (crc and 4) | (size is not None and 2), entry, (size or 0).to_bytes(4, "little")))
    same("initiate", answer, head(0xA4, entry, answer[4:5]))
    return answer[4]


def send_segments(node, data, blksize, seqnos_sent=lambda block, seqnos: seqnos):
    """seqnos_sent(block, seqnos): which segments of the sub-block really go out, the block-th, and how often."""
    segments = segments_of(data)
    done = 0
    for block in itertools.count():
        if done == len(segments):
            return
        same("1 <= blksize <= 127", 1 <= blksize <= 127, True)
        seqnos = seqnos_sent(block, range(1, min(blksize, len(segments) - done) + 1))
        for seqno in seqnos:
            last = LAST if done + seqno == len(segments) else 0
            node.send(bytes([last | seqno]) + segments[done + seqno - 1])
        answer = node.receive()
        same(f"acknowledge of block {block}", answer, frame(0xA2, in_order(seqnos), answer[2]))
        done += answer[1]
        blksize = answer[2]


def end_of_download(data, crc=0):
    return frame(0xC1 | -len(data) % SEGMENT << 2, crc & 0xFF, crc >> 8)


def download(node, entry, data, crc=True, sized=True, seqnos_sent=lambda block, seqnos: seqnos):
    blksize = begin_download(node, entry, len(data) if sized else None, crc)
    send_segments(node, data, blksize, seqnos_sent)
    same("end", node.ask(end_of_download(data, crc and crc_of(data))), frame(0xA1))


# --- Block upload


def begin_upload(node, entry, blksize=127, pst=0, crc=True):
    """Returns the size that the node announces."""
    answer = node.ask(head(0xA0 | (crc and 4), entry, bytes([blksize, pst])))
    same("initiate", answer, head(0xC6, entry, answer[4:]))
    return int.from_bytes(answer[4:], "little")


def receive_block(node, blksize):
    """The segments of a sub-block, and whether the last of all is among them."""
    segments = []
    while len(segments) < blksize:
        segment = node.receive()
        same("seqno", segment[0] & ~LAST, len(segments) + 1)
        segments.append(segment[1:])
        if segment[0] & LAST:
            return segments, True
    return segments, False


def receive_segments(node, blksize, acknowledge=lambda block, seqno, blksize: (seqno, blksize)):
    """acknowledge(block, seqno, blksize): the ackseq and blksize to answer to the sub-block, the block-th, which has
    had so many segments. Returns the segments, and the answer to the last acknowledge."""
    taken = []
    for block in itertools.count():
        segments, last = receive_block(node, blksize)
        ackseq, blksize = acknowledge(block, len(segments), blksize)
        taken += segments[:ackseq]
        node.send(frame(0xA2, ackseq, blksize))
        if last and ackseq == len(segments):
            return b"".join(taken), node.receive()


def upload(node, entry, blksize=127, crc=True, **options):
    size = begin_upload(node, entry, blksize, 0, crc)
    node.send(frame(0xA3))
    data, end = receive_segments(node, blksize, **options)
    unused = len(data) - size
    same("end", end, end_of_download(data[:size], crc and crc_of(data[:size])))
    same("unused bytes", data[size:], bytes(unused))
    node.send(frame(0xA1))
    return data[:size]
