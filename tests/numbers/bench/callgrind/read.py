#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Prints what callgrind has counted: name, tabulator, instructions.

read.py REPORTS FILE... - the lines that machine.cpp has printed (name, operations, units), and the files of callgrind.
"""
import re
import sys
from pathlib import Path


def counted(file):
    """The name of the report and the instructions."""
    text = Path(file).read_text(encoding="utf-8")
    name = re.search(r"^desc: Trigger: Client Request: (.*)$", text, re.MULTILINE)
    number = re.search(r"^(?:summary|totals): ([0-9]+)$", text, re.MULTILINE)
    return (name[1], int(number[1])) if name and number else ("", 0)


def main():
    reports, *files = sys.argv[1:]
    counts = dict(map(counted, files))
    clock = 0
    for line in Path(reports).read_text(encoding="utf-8").splitlines():
        name, operations, units = line.split("\t")
        if name == "clock":
            clock = counts[name] / int(operations)
            continue
        each = (counts[name] - clock * int(operations)) / int(units)
        print(f"{name}\t{each:.0f}" if operations == units else f"{name}\t{each:.1f}")


if __name__ == "__main__":
    main()
