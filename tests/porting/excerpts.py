#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""excerpts.py ROOT PAGE | --self-test

Every block of C in PAGE stands behind a comment that names a file, <!-- tests/… -->, and is an excerpt of it, line by line.
Prints "1..N" and a line "ok …" or "not ok …" for each block.
"""
import pathlib
import re
import sys

BLOCK = re.compile(r"(?:<!-- (\S+) -->\n)?```(c|cpp)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def judge(page, read):
    """Returns (good, text) for each block; read gives the text of a file, or None."""
    verdicts = []
    for block in BLOCK.finditer(page):
        name, code = block.group(1), block.group(3)
        line = page.count("\n", 0, block.start()) + 1
        text = read(name) if name else None
        if name is None:
            verdicts.append((False, f"line {line}: a block of C without a file"))
        elif text is None:
            verdicts.append((False, f"line {line}: there is no {name}"))
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
        ("no C", "```sh\nmake\n```\n", []),
    ]
    return [([good for good, _ in judge(text, files.get)] == want, f"self-test: {name}") for name, text, want in cases]


def main():
    if sys.argv[1:] == ["--self-test"]:
        verdicts = self_test()
    else:
        root = pathlib.Path(sys.argv[1])

        def read(name):
            path = root / name
            return path.read_text(encoding="utf-8") if path.is_file() else None

        verdicts = judge((root / sys.argv[2]).read_text(encoding="utf-8"), read)
    print(f"1..{len(verdicts)}")
    for good, text in verdicts:
        print(f"{'ok' if good else 'not ok'} {text}")
    return 0 if verdicts and all(good for good, _ in verdicts) else 1


if __name__ == "__main__":
    sys.exit(main())
