#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""table.py ROOT

Compares the table of objects in docs/features.md with the recipes in tests/stack/cookbook: each row
  | 1005h | 0 | name | `TYPE` | `FLAGS`, `FLAGS` | data | `SETTING` | `TEST` |
needs an entry of that index, sub-index and type in a recipe, with each of the flags, and a test that names the index.
Compares it also with the list of objects in include/lexican/detail/objects.h: each row of the list has a row in the
table, and the type, the flags D and N, the width of the variable and the setting are those of the list. Every type of
the list and every test of the page must exist.
Prints "1..N" and a line "ok …" or "not ok …" for each row of the table and of the list.
"""
import pathlib
import re
import sys

ROW = re.compile(r"^\| ([0-9A-F]{4})h…? \| (\d+)…? \| [^|]* \| `(\w+)` \| ([^|]*) \| ([^|]*) \| ([^|]*)\| `([\w.]+)` \|$",
                 re.MULTILINE)
TEST = re.compile(r"^\| .* \| `(\w+_test|\w+\.c)` \|$", re.MULTILINE)
OBJECT = re.compile(r"^  X\((.*)\)", re.MULTILINE)
ENTRY = re.compile(r"\{CO_KEY\(0x([0-9A-F]{4}), (\d+), (\w+)\), (\w+),")


class Object:
    """A row of CO_OBJECTS()."""

    def __init__(self, row):
        self.rule, self.kind, _, *numbers, self.flags, _, use, self.setting = re.split(r", +", row)
        self.first, self.last, self.first_sub, self.last_sub, self.bytes = (int(n, 0) for n in numbers)
        self.is_in_table = use != "none"

    def contains(self, index, sub):
        tpdo = 0x400 if "T" in self.flags and index >= self.first + 0x400 else 0
        return self.first <= index - tpdo <= self.last and self.first_sub <= sub <= self.last_sub

    def faults(self, kind, flags, data, settings):
        """Returns the differences of a row of the table."""
        widths = re.findall(r"`uint(\d+)_t`", data)
        yield from ([f"type {self.kind}"] if kind != self.kind else [])
        yield from (f"no flag {flag}" for flag in "DN" if flag in "".join(flags) and flag not in self.flags)
        yield from ([f"no {self.setting}"] if self.setting != "always" and f"`{self.setting}`" not in settings else [])
        yield from (f"{self.bytes} bytes" for width in widths if int(width) != 8 * self.bytes)


def compared(objects, rows):
    """Returns a list of (title, faults) for the rows of the list."""
    result = []
    for row in objects:
        found, faults = False, []
        for index, sub, kind, flags, data, settings, _ in rows:
            at = int(index, 16), int(sub)
            is_first = next((o for o in objects if o.contains(*at)), None) is row
            is_highest = at[1] == 0 != row.last_sub and kind == "CO_TUNSIGNED8"
            if is_first and not is_highest:
                found = True
                names = [name[len("CO_OBJ_"):] for name in re.findall(r"`(\w+)`", flags)]
                faults += [f"{index}h:{sub}: {fault}" for fault in row.faults(kind, names, data, settings)]
        result.append((f"{row.rule} {row.kind}", faults if found else ["no row in the table"]))
    return result


def text_of(root, test):
    """Returns the text of a test, an empty one if it does not exist."""
    file = root / "tests/stack" / (f"cookbook/{test}" if test.endswith(".c") else f"conformance/{test}.cpp")
    return file.read_text(encoding="utf-8") if file.exists() else ""


def main():
    root = pathlib.Path(sys.argv[1])
    entries = set()
    for recipe in (root / "tests/stack/cookbook").glob("*.c"):
        entries.update(ENTRY.findall(recipe.read_text(encoding="utf-8")))
    page = (root / "docs/features.md").read_text(encoding="utf-8")
    rows = ROW.findall(page)
    listed = OBJECT.findall((root / "include/lexican/detail/objects.h").read_text(encoding="utf-8"))
    objects = list(map(Object, listed))
    faults = len(re.findall(r"^\| [0-9A-F]{4}h", page, re.MULTILINE)) - len(rows)
    cases = compared([o for o in objects if o.is_in_table], rows)
    for index, sub, kind, flags, _, _, test in rows:
        names = re.findall(r"`(\w+)`", flags)
        missing = [f"{name} in no recipe" for name in names if (index, sub, name, kind) not in entries]
        missing += [] if re.search(f"0x{index}|{index}h", text_of(root, test)) else [f"{test} does not name the index"]
        cases.append((f"{index}h:{sub} {kind}", missing if names else ["no flags"]))
    for kind in dict.fromkeys(o.kind for o in objects):
        cases.append((f"{kind} on the page", [] if f"`{kind}`" in page else ["missing"]))
    for test in dict.fromkeys(TEST.findall(page)):
        cases.append((f"{test} exists", [] if text_of(root, test) else ["missing"]))
    print(f"1..{len(cases)}")
    for title, different in cases:
        faults += bool(different)
        print(f"{'not ok' if different else 'ok'} {title} {', '.join(different)}".rstrip())
    return 0 if rows and objects and faults == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
