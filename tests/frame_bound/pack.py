#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Packs inputs into one file: of each the first 12 characters of its name, its length in 4 bytes, its bytes.

pack.py RESULT DIRECTORY      the files of a directory
pack.py RESULT NAME...        inputs that consist of their names
"""
import sys
from pathlib import Path


def main():
    result, *names = sys.argv[1:]
    inputs = {name: name.encode() for name in names}
    if Path(names[0]).is_dir():
        inputs = {file.name: file.read_bytes() for file in sorted(Path(names[0]).iterdir())}
    packed = b""
    for name, data in inputs.items():
        packed += name[:12].ljust(12).encode() + len(data).to_bytes(4, "little") + data
    Path(result).write_bytes(packed)


if __name__ == "__main__":
    main()
