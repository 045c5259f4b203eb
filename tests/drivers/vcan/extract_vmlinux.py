#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""extract_vmlinux.py BZIMAGE OUTPUT: the kernel proper, which QEMU starts at once instead of having it unpack itself.

Field names as in the kernel's documentation of the x86 boot protocol.
"""
import lzma
import struct
import sys

SETUP_SECTS = 0x1F1
PAYLOAD_OFFSET = 0x248
SECTOR = 512

with open(sys.argv[1], "rb") as image:
    data = image.read()
protected_mode = ((data[SETUP_SECTS] or 4) + 1) * SECTOR
offset, length = struct.unpack_from("<II", data, PAYLOAD_OFFSET)
payload = data[protected_mode + offset : protected_mode + offset + length]
with open(sys.argv[2], "wb") as output:
    output.write(lzma.LZMADecompressor().decompress(payload))
