#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Prints those sources of the library whose preprocessed text differs between two configurations.

changed_sources.py ROOT SOURCE... -- COMPILER... -- DEFINITION... -- DEFINITION...: sources are relative to ROOT/src.
All sources are preprocessed as one file, because most of the time is spent in the headers that they share. A source is
printed if its own text differs, or that of a header that it may include. A source without text of its own in both
configurations has an empty object in both.
"""
import re
import subprocess
import sys
from collections import defaultdict
from functools import lru_cache
from itertools import groupby
from pathlib import Path

# The values of the settings (include/lexican/detail/configuration.h): headers only refer to them, in the names of
# functions of src/node.
VALUES = re.compile(r'"_SSDO"[ "_0-9A-Za-z]*')


@lru_cache(None)
def resolved(path):
    return Path(path).resolve()


def texts(compiler, root, sources, definitions):
    """Returns the preprocessed text of each file, with single spaces."""
    everything = "".join(f'#include "{root}/src/{source}"\n' for source in sources)
    command = [*compiler, *(f"-D{each}" for each in definitions), "-E", "-x", "c++", "-"]
    output = subprocess.run(command, input=everything, stdout=subprocess.PIPE, text=True, check=True).stdout
    found = defaultdict(list)
    lines = found[None]
    for line in output.splitlines():
        if line.startswith("# "):
            lines = found[resolved(line.split('"')[1])]
        elif line.strip():
            lines.append(" ".join(line.split()))
    return {file: " ".join(lines) for file, lines in found.items() if lines}


@lru_cache(None)
def included(file, places):
    """Returns the headers that a file names and that exist, for whatever configuration."""
    names = re.findall(r'^\s*#\s*include\s*["<]([^">]+)', file.read_text(encoding="utf-8"), re.MULTILINE)
    paths = (place / name for name in names for place in (file.parent, *places))
    return frozenset(resolved(path) for path in paths if path.is_file())


def all_included(file, places):
    found, new = set(), {file}
    while new:
        found |= new
        new = {header for each in new for header in included(each, places)} - found
    return found


def main():
    parts = [list(part) for is_end, part in groupby(sys.argv[1:], lambda each: each == "--") if not is_end]
    (root, *sources), compiler, before, after = *parts, *[[]] * (4 - len(parts))
    root = Path(root).resolve()
    places = (root / "src", root / "include", root / "config")
    compiler += [f"-I{place}" for place in places]
    old, new = (texts(compiler, root, sources, definitions) for definitions in (before, after))
    for text in (old, new):
        for file in text:
            if file and file.suffix != ".cpp":
                text[file] = VALUES.sub("", text[file])
    changed = {file for file in old.keys() | new.keys() if old.get(file) != new.get(file)}
    for source in sources:
        file = root / "src" / source
        if (file in old or file in new) and changed & all_included(file, places):
            print(source)


if __name__ == "__main__":
    main()
