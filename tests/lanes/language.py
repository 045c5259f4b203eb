#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""language.py ROOT | --self-test

Finds comments and names of test cases that are hard to read: CONTRIBUTING.md, Language, has the rules. Prints "1..N" and a
line "ok …" or "not ok …" for each directory, with the places that break a rule.
"""
import re
import sys
from pathlib import Path

DIRECTORIES = ("config", "demo", "drivers", "include", "src", "tests", "tools")
SUFFIXES = {".h", ".hpp", ".c", ".cpp"}
COMMENT = re.compile(r"(?:^|\s)//[/!]?<?\s*(.*)$")
NAME = re.compile(r'TEST_CASE\(\s*"([^"]*)"')
# Matched at the beginning of a comment, unless the previous line ends within a sentence.
BEGINNINGS = re.compile(r"(What|Who|Whoever|Whatever|Of|The same|That|As|Nothing|Nobody|Somebody)\b(?! (is|are) )")
WORDS = re.compile(
    r"\b(whoever|whosoever|somebody|nobody|anybody|nameless|halving|neighbours?|foreign frames?|torn|from now on|by itself|of its own)\b",
    re.IGNORECASE)


def faults(text):
    """Returns the lines that break a rule, each with what is wrong."""
    found = []
    within = False  # the comment of the line before goes on
    for number, line in enumerate(text.splitlines(), 1):
        comment = COMMENT.search(line)
        words = comment.group(1) if comment else ""
        if comment and not within and (match := BEGINNINGS.match(words)):
            found.append((number, f"a comment begins with '{match.group(0)}'"))
        for place in [words, *NAME.findall(line)]:
            if match := WORDS.search(place):
                found.append((number, f"'{match.group(0)}'"))
        within = bool(comment) and bool(words) and words[-1] not in ".:;}" and "SPDX" not in words and line.strip()[0] == "/"
    return found


def check(root):
    good = True
    print(f"1..{len(DIRECTORIES)}")
    for directory in DIRECTORIES:
        files = sorted(p for p in (root / directory).rglob("*") if p.suffix in SUFFIXES and "generated" not in p.parts)
        found = [f"{p.relative_to(root)}:{line}: {fault}" for p in files for line, fault in faults(p.read_text())]
        print("not ok" if found or not files else "ok", f"language of {directory}", *found[:1000], sep="\n  " if found else " ")
        good = good and not found
    return good


def self_test():
    cases = [
        ("a noun phrase", "// Ticks until the inhibit time ends.", 0),
        ("a verb", "int f();  // Returns the first route.", 0),
        ("What", "// What waits is sent.", 1),
        ("The same", "/// The same for a block.", 1),
        ("a question that is answered", "// What is sent: nothing.", 0),
        ("below the line of the licence", "// SPDX-License-Identifier: Apache-2.0\n// Of many", 1),
        ("below a comment behind code", "int a;  // Ticks\n// Of many", 1),
        ("within a sentence", "// Sends a frame\n// What is next", 0),
        ("a new sentence", "// Sends a frame.\n// Of many", 1),
        ("a word", "// Nobody, or somebody else", 1),
        ("a name of a case", 'TEST_CASE("a frame that nobody takes") {', 1),
        ("no comment", 'log("nobody");', 0),
    ]
    good = True
    print(f"1..{len(cases)}")
    for name, text, number in cases:
        right = bool(faults(text)) == bool(number)
        print("ok" if right else "not ok", f"self-test: {name}")
        good = good and right
    return good


if __name__ == "__main__":
    sys.exit(0 if (self_test() if sys.argv[1:] == ["--self-test"] else check(Path(sys.argv[1]))) else 1)
