#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Prints the bytes of flash of each directory of src/ in a linked program: name, tabulator, bytes.

modules.py MAP: MAP is the linker's map file. The objects of the library have the same paths as their sources in src/.
The last line is the sum.
"""
import re
import sys
from collections import Counter
from pathlib import Path

KEPT = re.compile(r"\.(text|rodata|srodata|data|sdata)\b")
OF_LIBRARY = re.compile(r"/lexican\w*\.dir/(?:(?:__/)+src/)?(.+)$")
# " .section 0xaddress 0xsize file"; a long name has a line of its own
PIECE = re.compile(r"^ (\S+)\s+0x[0-9a-f]+\s+0x([0-9a-f]+) (\S+)$")


def pieces(text):
    """Section, bytes and file of everything that was linked."""
    linked = text.split("\nLinker script and memory map\n", 1)[1]
    joined = re.sub(r"^( \S+)\n(\s+0x)", r"\1\2", linked, flags=re.MULTILINE)
    for line in joined.splitlines():
        found = PIECE.match(line)
        if found and KEPT.match(found[1]):
            yield int(found[2], 16), found[3]


def module_of(source):
    """Returns "base" for src/base/…, "sdo" for src/service/sdo/…, "od" for src/extra/od/…."""
    parts = Path(source).parts
    return parts[1] if parts[0] in ("service", "extra") else parts[0]


def main():
    modules = Counter()
    for size, file in pieces(Path(sys.argv[1]).read_text(encoding="utf-8")):
        of_library = OF_LIBRARY.search(file)
        if of_library:
            modules[module_of(of_library[1])] += size
    for module, size in sorted(modules.items()):
        if size:
            print(f"{module}\t{size}")
    print(f"all modules\t{sum(modules.values())}")


if __name__ == "__main__":
    main()
