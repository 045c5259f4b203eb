#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Packs the files of a directory into one: of each the first 8 characters of its name, its length in 4 bytes, its bytes.

pack.py DIRECTORY RESULT
"""
import sys
from pathlib import Path


def main():
    directory, result = sys.argv[1:]
    packed = b""
    for file in sorted(Path(directory).iterdir()):
        data = file.read_bytes()
        packed += file.name[:8].ljust(8).encode() + len(data).to_bytes(4, "little") + data
    Path(result).write_bytes(packed)


if __name__ == "__main__":
    main()
