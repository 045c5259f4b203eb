#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The inputs of the fuzz targets: tests/fuzz/inputs/TARGET.txt has one in each line, in hex.

inputs.py unpack TARGET DIRECTORY   writes a file for each input
inputs.py add TARGET FILE...        adds the contents of files
"""
import sys
from pathlib import Path


def main():
    if len(sys.argv) < 4 or sys.argv[1] not in ("unpack", "add"):
        sys.exit(__doc__)
    command, target, *paths = sys.argv[1:]
    inputs = Path(__file__).parent / "inputs" / f"{target}.txt"
    lines = inputs.read_text(encoding="ascii").splitlines()
    if command == "add":
        all_lines = {*lines, *(Path(path).read_bytes().hex() for path in paths)}
        inputs.write_text("".join(f"{line}\n" for line in sorted(all_lines, key=lambda line: (len(line), line))))
        return
    for number, line in enumerate(lines, 1):
        (Path(paths[0]) / f"{target}-{number}").write_bytes(bytes.fromhex(line))


if __name__ == "__main__":
    main()
