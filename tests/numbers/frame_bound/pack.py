#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Packs inputs into one file: of each the first 12 characters of its name, its length in 4 bytes, its bytes.

pack.py RESULT FILE.txt       the lines of a file, in hex; their names are the numbers of the lines
pack.py RESULT NAME...        inputs that consist of their names
"""
import sys
from pathlib import Path


def main():
    result, *names = sys.argv[1:]
    inputs = {name: name.encode() for name in names}
    if names[0].endswith(".txt"):
        lines = Path(names[0]).read_text(encoding="ascii").splitlines()
        inputs = {f"line {number}": bytes.fromhex(line) for number, line in enumerate(lines, 1)}
    packed = b""
    for name, data in inputs.items():
        packed += name[:12].ljust(12).encode() + len(data).to_bytes(4, "little") + data
    Path(result).write_bytes(packed)


if __name__ == "__main__":
    main()
