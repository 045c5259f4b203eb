#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Prints what callgrind has counted: name, tabulator, instructions.

read.py [--only FUNCTIONS] REPORTS FILE... - the lines that machine.cpp has printed (name, operations, units), and the
files of callgrind. FUNCTIONS: counts those only whose source file or name matches this regular expression, without the
functions that they call; the files are then written with --compress-strings=no.
"""
import argparse
import re
import sys
from pathlib import Path


def instructions_of(functions, text):
    number, file, is_counted, is_call = 0, "", False, False
    for line in text.splitlines():
        if line.startswith("fl="):
            file = line
        elif line.startswith("fn="):
            is_counted = re.search(functions, f"{file} {line}") is not None
        elif line.startswith("calls="):
            is_call = True  # the next line has the instructions of the function that is called
        elif re.match(r"[0-9+*-]", line):
            number += int(line.split()[1]) if is_counted and not is_call else 0
            is_call = False
    return number or sys.exit(f"no instructions of {functions}")


def counted(file, functions):
    """The name of the report and the instructions."""
    text = Path(file).read_text(encoding="utf-8")
    name = re.search(r"^desc: Trigger: Client Request: (.*)$", text, re.MULTILINE)
    number = re.search(r"^(?:summary|totals): ([0-9]+)$", text, re.MULTILINE)
    if not name or not number:
        return "", 0
    return name[1], instructions_of(functions, text) if functions else int(number[1])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", help="functions to count")
    parser.add_argument("reports", type=Path)
    parser.add_argument("files", nargs="+")
    arguments = parser.parse_args()
    counts = dict(counted(file, arguments.only) for file in arguments.files)
    clock = 0
    for line in arguments.reports.read_text(encoding="utf-8").splitlines():
        name, operations, units, *_ = line.split("\t")
        if name == "clock":
            clock = counts[name] / int(operations)
            continue
        each = (counts[name] - clock * int(operations)) / int(units)
        print(f"{name}\t{each:.0f}" if operations == units else f"{name}\t{each:.1f}")


if __name__ == "__main__":
    main()
