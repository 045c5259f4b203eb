#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""excerpts.py [--some] ROOT PAGE | --self-test

Compares the blocks of code in PAGE with files of ROOT. A comment in front of a block names its file:
  <!-- tests/… -->         the block is an excerpt of the file, line by line
  <!-- all of tests/… -->  the block is the whole file
A block of C or C++ without such a comment is a fault; with --some it is not compared.
Prints "1..N" and a line "ok …" or "not ok …" for each block.
"""
import pathlib
import re
import sys

BLOCK = re.compile(r"(?:<!-- (all of )?(\S+) -->\n)?```(c|cpp|cmake|ini)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def judge(page, read, some=False):
    """Returns (good, text) for each block; read gives the text of a file, or None."""
    verdicts = []
    for block in BLOCK.finditer(page):
        whole, name, code = block.group(1), block.group(2), block.group(4)
        line = page.count("\n", 0, block.start()) + 1
        text = read(name) if name else None
        if name is None:
            if not some and block.group(3) in ("c", "cpp"):
                verdicts.append((False, f"line {line}: a block of C without a file"))
        elif text is None:
            verdicts.append((False, f"line {line}: there is no {name}"))
        elif whole:
            verdicts.append((code == text, f"line {line}: the whole of {name}"))
        else:
            is_excerpt = ("\n" + code) in ("\n" + text)
            verdicts.append((is_excerpt, f"line {line}: an excerpt of {name}"))
    return verdicts


def self_test():
    files = {"a.c": "int a;\nint b;\n"}
    page = "<!-- a.c -->\n```c\n{}```\n"
    cases = [
        ("an excerpt", page.format("int b;\n"), [True]),
        ("another line", page.format("int c;\n"), [False]),
        ("half a line", page.format("t b;\n"), [False]),
        ("no file", "```c\nint a;\n```\n", [False]),
        ("a missing file", page.replace("a.c", "b.c").format("int a;\n"), [False]),
        ("a line of an EDS", "<!-- a.c -->\n```ini\nint c;\n```\n", [False]),
        ("no C", "```sh\nmake\n```\n", []),
        ("a whole file", page.replace("a.c", "all of a.c").format("int a;\nint b;\n"), [True]),
        ("half a file", page.replace("a.c", "all of a.c").format("int b;\n"), [False]),
    ]
    verdicts = [([good for good, _ in judge(text, files.get)] == want, f"self-test: {name}") for name, text, want in cases]
    verdicts.append((judge(cases[3][1], files.get, some=True) == [], "self-test: --some, no file"))
    return verdicts


def main():
    if sys.argv[1:] == ["--self-test"]:
        verdicts = self_test()
    else:
        some = sys.argv[1] == "--some"
        root, page = pathlib.Path(sys.argv[-2]), sys.argv[-1]

        def read(name):
            path = root / name
            return path.read_text(encoding="utf-8") if path.is_file() else None

        verdicts = judge((root / page).read_text(encoding="utf-8"), read, some)
    print(f"1..{len(verdicts)}")
    for good, text in verdicts:
        print(f"{'ok' if good else 'not ok'} {text}")
    return 0 if verdicts and all(good for good, _ in verdicts) else 1


if __name__ == "__main__":
    sys.exit(main())
