#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""raw_block.py INTERFACE NODE-ID: SDO block transfers with the demo node, byte for byte.

Prints "ok NAME" or "not ok NAME: DETAIL" for each case. The status is 0 only if all are ok.
"""
import sys

import can

from sdo_block import SEGMENT, Node, Unexpected, abort, crc_of, frame, head, same
from sdo_block import begin_download, download, end_of_download, send_segments
from sdo_block import begin_upload, receive_block, upload

DEVICE_NAME = (0x1008, 0)  # read-only, 18 bytes: three segments
PRODUCT_CODE = (0x1018, 2)  # 4 bytes
HOUR = (0x2100, 1)  # 1 byte
PICTURE = (0x2200, 0)  # many sub-blocks of 127 segments
STATION = (0x2201, 0)  # up to 32 bytes

cases = []


def case(name):
    def register(function):
        cases.append((name, function))
        return function

    return register


def pattern(size, seed):
    """Bytes without a period that a segment or a sub-block has."""
    return bytes([(at * at >> 5) + seed & 0xFF for at in range(size)])


def picture_size(node):
    """As an ordinary upload says it."""
    answer = node.ask(head(0x40, PICTURE))
    node.send(abort(PICTURE, 0x08000000))
    return int.from_bytes(answer[4:], "little")


@case("the picture: download with CRC and size; upload with CRC, later with blksize changing and segments lost")
def whole_with_crc(node):
    def acknowledge(block, seqno, blksize):
        if block < 20:
            return seqno, blksize
        lost = block % 4 == 3
        return (block % (seqno + 1) if lost else seqno), (1, 5, 127, 64, 127, 126, 2, 127)[block % 8]

    data = pattern(picture_size(node), 1)
    download(node, PICTURE, data)
    same("all bytes are back", upload(node, PICTURE, acknowledge=acknowledge) == data, True)


@case("the picture, its begin: download without CRC and size, segments lost; upload without CRC")
def begin_without_crc(node):
    def leave_out(block, seqnos):
        lost = block * 5 if block % 2 else 0
        return [seqno for seqno in seqnos if seqno != lost or seqno == len(seqnos)]

    data = pattern(20 * 127 * SEGMENT, 2)
    download(node, PICTURE, data, crc=False, sized=False, seqnos_sent=leave_out)
    begin_upload(node, PICTURE, crc=False)
    node.send(frame(0xA3))
    back, _ = receive_block(node, 127)
    while len(back) * SEGMENT < len(data):
        node.send(frame(0xA2, 127, 127))
        back += receive_block(node, 127)[0]
    node.send(abort(PICTURE, 0x08000000))
    same("all bytes are back", b"".join(back) == data, True)


def short_transfer(blksize):
    def both_ways(node):
        data = f"A station, blksize {blksize}".encode()
        download(node, STATION, data)
        same("upload", upload(node, STATION, blksize), data)

    return both_ways


for size in 1, 5, 127:
    case(f"a short object, uploaded with blksize {size}")(short_transfer(size))


@case("upload: segments lost at the end and in the middle, CRC right")
def lost_in_upload(node):
    data = b"32 bytes, which are 5 segments.."
    download(node, STATION, data)
    answers = iter([(2, 4), (0, 3), (1, 2), (2, 127)])  # ackseq, blksize
    same("upload", upload(node, STATION, acknowledge=lambda *_: next(answers)), data)


@case("download: a lost segment, acknowledged at the end of the sub-block")
def lost_in_download(node):
    data = b"Lost and sent again, sooner..."
    download(node, STATION, data, seqnos_sent=lambda block, seqnos: [1, 2, 4, 5] if block == 0 else seqnos)
    same("upload", upload(node, STATION), data)


@case("download: a lost last segment, acknowledged after silence")
def lost_last_in_download(node):
    data = b"Lost and sent again, in the end"
    download(node, STATION, data, seqnos_sent=lambda block, seqnos: [1, 2, 3, 4] if block == 0 else seqnos)
    same("upload", upload(node, STATION), data)


@case("download: each segment twice")
def repeated_in_download(node):
    data = b"All of this comes two times."
    download(node, STATION, data, seqnos_sent=lambda block, seqnos: [seqno for seqno in seqnos for _ in range(2)])
    same("upload", upload(node, STATION), data)


@case("download: the last segment of a full sub-block twice")
def repeated_last_of_block(node):
    data = bytes(range(251)) * 8
    blksize = begin_download(node, PICTURE, None)
    send_segments(node, data, blksize, lambda block, seqnos: [*seqnos, blksize] if block == 0 else seqnos)
    node.send(abort(PICTURE, 0x08000000))
    node.silent()


def refused_download(data, size, crc, code):
    def refuse(node):
        before = upload(node, STATION)
        send_segments(node, data, begin_download(node, STATION, size))
        same("end", node.ask(end_of_download(data, crc)), abort(STATION, code))
        same("the object", upload(node, STATION), before)

    return refuse


NAME = b"A name of 21 bytes..."
case("download: wrong CRC: 05040004h, the object unchanged")(
    refused_download(NAME, len(NAME), crc_of(NAME) ^ 0x8000, 0x05040004)
)
case("download: CRC with its bytes swapped: 05040004h")(
    refused_download(NAME, len(NAME), int.from_bytes(crc_of(NAME).to_bytes(2, "little"), "big"), 0x05040004)
)
case("download: fewer bytes than announced: 06070013h")(refused_download(NAME, len(NAME) + 1, crc_of(NAME), 0x06070013))
case("download: more bytes than announced: 06070012h")(refused_download(NAME, len(NAME) - 1, crc_of(NAME), 0x06070012))


def refused_acknowledge(ackseq, blksize, code):
    def refuse(node):
        begin_upload(node, PICTURE, 5)
        node.send(frame(0xA3))
        receive_block(node, 5)
        same("answer", node.ask(frame(0xA2, ackseq, blksize)), abort(PICTURE, code))
        node.silent()

    return refuse


case("upload: ackseq beyond what was sent: 05040003h")(refused_acknowledge(6, 5, 0x05040003))
case("upload: ackseq 128: 05040003h")(refused_acknowledge(128, 5, 0x05040003))
case("upload: acknowledge with blksize 128: 05040002h")(refused_acknowledge(5, 128, 0x05040002))
case("upload: acknowledge with blksize 0: 05040002h")(refused_acknowledge(5, 0, 0x05040002))


def answered(request, response):
    def answer(node):
        same("answer", node.ask(request), response)
        node.silent()

    return answer


case("upload with blksize 128: 05040002h")(answered(head(0xA4, PICTURE, b"\x80"), abort(PICTURE, 0x05040002)))
case("upload with blksize 0: 05040002h")(answered(head(0xA4, PICTURE, b"\x00"), abort(PICTURE, 0x05040002)))
case("upload of an unknown object: 06020000h")(
    answered(head(0xA4, (0x2FFF, 0), b"\x7F"), abort((0x2FFF, 0), 0x06020000))
)
case("download to a read-only object: 06010002h")(
    answered(head(0xC6, DEVICE_NAME, b"\x12"), abort(DEVICE_NAME, 0x06010002))
)
case("start of an upload that was not initiated: 05040001h")(answered(frame(0xA3), abort((0, 0), 0x05040001)))


@case("pst: 18 bytes and pst 18 are uploaded in segments")
def pst_reached(node):
    same("initiate", node.ask(head(0xA4, DEVICE_NAME, bytes([127, 18]))), head(0x41, DEVICE_NAME, b"\x12"))
    same("segment 1", node.ask(frame(0x60)), b"\x00Lexican")
    same("segment 2", node.ask(frame(0x70)), b"\x10 demo c")
    same("segment 3", node.ask(frame(0x60)), b"\x07lock\0\0\0")


@case("pst: 18 bytes and pst 17 are a block upload")
def pst_not_reached(node):
    same("size", begin_upload(node, DEVICE_NAME, 127, 17), 18)
    node.send(frame(0xA3))
    same("segment 1", node.receive(), b"\x01Lexican")
    same("segment 2", node.receive(), b"\x02 demo c")
    same("segment 3", node.receive(), b"\x83lock\0\0\0")
    crc = crc_of(b"Lexican demo clock")
    same("end", node.ask(frame(0xA2, 3, 127)), frame(0xCD, crc & 0xFF, crc >> 8))
    node.send(frame(0xA1))
    node.silent()


@case("pst: 4 bytes and pst 4 are uploaded in one frame")
def pst_expedited(node):
    same("answer", node.ask(head(0xA4, PRODUCT_CODE, bytes([127, 4]))), head(0x43, PRODUCT_CODE, b"\x0C\xC1"))


@case("4 bytes in a block: 81h, and CDh: 3 bytes are unused")
def four_bytes(node):
    same("size", begin_upload(node, PRODUCT_CODE, crc=False), 4)
    same("segment", node.ask(frame(0xA3)), frame(0x81, 0x0C, 0xC1))
    same("end", node.ask(frame(0xA2, 1, 127)), frame(0xCD))
    node.send(frame(0xA1))


@case("1 byte in a block: 81h, and D9h: 6 bytes are unused")
def one_byte(node):
    begin_download(node, HOUR, 1)
    same("acknowledge", node.ask(frame(0x81, 23))[:2], b"\xA2\x01")
    same("end of download", node.ask(frame(0xD9, crc_of(b"\x17") & 0xFF, crc_of(b"\x17") >> 8)), frame(0xA1))
    same("size", begin_upload(node, HOUR, crc=False), 1)
    same("segment", node.ask(frame(0xA3)), frame(0x81, 23))
    same("end", node.ask(frame(0xA2, 1, 1)), frame(0xD9))
    node.send(frame(0xA1))


@case("download: aborted within a sub-block, then a new transfer")
def abort_download(node):
    begin_download(node, PICTURE)
    for seqno in range(1, 50):
        node.send(frame(seqno))
    node.send(abort(PICTURE, 0x08000021))
    node.silent()
    same("upload", upload(node, DEVICE_NAME), b"Lexican demo clock")


@case("upload: aborted within a sub-block, then a new transfer")
def abort_upload(node):
    begin_upload(node, PICTURE)
    node.send(frame(0xA3))
    receive_block(node, 100)
    node.send(abort(PICTURE, 0x08000021))
    node.drain()
    same("upload", upload(node, DEVICE_NAME), b"Lexican demo clock")


@case("upload: a new initiate instead of an acknowledge begins anew")
def begin_anew(node):
    begin_upload(node, PICTURE)
    node.send(frame(0xA3))
    receive_block(node, 127)
    same("upload", upload(node, DEVICE_NAME), b"Lexican demo clock")
    node.silent()


def run(node, name, function):
    """Whether the case is ok."""
    try:
        function(node)
    except (Unexpected, can.CanError) as error:
        print(f"not ok {name}: {error}", flush=True)
        node.send(abort((0, 0), 0x08000000))
        node.drain()
        return False
    print(f"ok {name}", flush=True)
    return True


def main():
    node = Node(sys.argv[1], int(sys.argv[2]))
    results = [run(node, name, function) for name, function in cases]
    node.bus.shutdown()
    return 0 if all(results) else 1


if __name__ == "__main__":
    sys.exit(main())
