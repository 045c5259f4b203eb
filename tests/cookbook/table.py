#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""table.py ROOT

Compares the table of objects in docs/cookbook.md with the recipes in tests/cookbook: each row
  | 1005h | 0 | name | `TYPE` | `FLAGS`, `FLAGS` | data |
needs an entry of that index, sub-index and type in a recipe, with each of the flags.
Prints "1..N" and a line "ok …" or "not ok …" for each row.
"""
import pathlib
import re
import sys

ROW = re.compile(r"^\| ([0-9A-F]{4})h…? \| (\d+)…? \| [^|]* \| `(\w+)` \| ([^|]*) \|", re.MULTILINE)
ENTRY = re.compile(r"\{CO_KEY\(0x([0-9A-F]{4}), (\d+), (\w+)\), (\w+),")


def main():
    root = pathlib.Path(sys.argv[1])
    entries = set()
    for recipe in (root / "tests/cookbook").glob("*.c"):
        entries.update(ENTRY.findall(recipe.read_text(encoding="utf-8")))
    page = (root / "docs/cookbook.md").read_text(encoding="utf-8")
    rows = ROW.findall(page)
    faults = len(re.findall(r"^\| [0-9A-F]{4}h", page, re.MULTILINE)) - len(rows)
    print(f"1..{len(rows)}")
    for index, sub, kind, flags in rows:
        names = re.findall(r"`(\w+)`", flags)
        missing = [name for name in names if (index, sub, name, kind) not in entries]
        good = bool(names) and not missing
        faults += not good
        print(f"{'ok' if good else 'not ok'} {index}h:{sub} {kind} {' '.join(missing or names)}")
    return 0 if rows and faults == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
