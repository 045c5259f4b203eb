#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""rules.py [--coverage] ROOT | --self-test

Compares the tags of rules, such as [D11], in sources and tests with tests/stack/conformance/RULES.md. Prints "1..N" and a
line "ok …" or "not ok …" for each rule, which needs a test, and for each tag that is not on the page.
--coverage prints the tests of each rule instead.
"""
import re
import sys
from pathlib import Path

ROW = re.compile(r"^\| ([A-Z]{1,3}[0-9]{1,2}) \| (.+) \| (.+) \|$", re.MULTILINE)
# Not an index of an array: those follow a name.
TAGS = re.compile(r"(?<![\w\])])\[([A-Z]{1,3}[0-9]{1,2}(?:, [A-Z]{1,3}[0-9]{1,2})*)\]")
TEXT = re.compile(r'"((?:[^"\\\n]|\\.)*)"')
PLACES = ("src", "include", "drivers", "demo", "tests")
SUFFIXES = {".h", ".hpp", ".c", ".cpp"}


def tags_in(text):
    return [tag for group in TAGS.findall(text) for tag in group.split(", ")]


def compare(page, files):
    """Returns the rules, the tests of each, and the unknown tags with the files that have them."""
    rules = {tag: sentence for tag, sentence, _ in ROW.findall(page)}
    tests = {tag: [] for tag in rules}
    unknown = {}
    for name, text in files.items():
        for tag in tags_in(text):
            if tag not in rules:
                unknown.setdefault(tag, name)
        if name.startswith("tests/"):
            for case in TEXT.findall(text):
                for tag in tags_in(case):
                    tests.get(tag, []).append(f"{name}: {case}")
    return rules, tests, unknown


def verdicts(page, files):
    rules, tests, unknown = compare(page, files)
    lines = [(bool(tests[tag]), f"[{tag}] has a test: {rules[tag]}") for tag in rules]
    lines += [(False, f"[{tag}] in {name} is not a rule of RULES.md") for tag, name in sorted(unknown.items())]
    repeated = len(ROW.findall(page)) - len(rules)
    return lines + [(repeated == 0, "each rule is listed in RULES.md once")]


def self_test():
    page = "| D1 | One. | ours |\n"
    test = {"tests/a.cpp": 'TEST_CASE("a thing [D1]") {'}
    cases = [
        ("a rule with a test", page, test, True),
        ("a rule with a test of two rules", page + "| D2 | Two. | ours |\n", {"tests/a.cpp": '"a [D1, D2]"'}, True),
        ("a rule without a test", page + "| D2 | Two. | ours |\n", test, False),
        ("a rule with a tag in a comment only", page, {"src/a.cpp": "// [D1]"}, False),
        ("an unknown tag in a source", page, {**test, "src/a.cpp": "// [D2]"}, False),
        ("an unknown tag in a test", page, {"tests/a.cpp": '"a [D1] [X9]"'}, False),
        ("an index of an array", page, {**test, "src/a.cpp": "a[N2] = b()[N3];"}, True),
        ("a duplicate rule", page + page, test, False),
    ]
    return [(all(good for good, _ in verdicts(text, files)) == want, f"self-test: {name}") for name, text, files, want in cases]


def read(root):
    files = {}
    for place in PLACES:
        for path in sorted((root / place).rglob("*")):
            if path.suffix in SUFFIXES:
                files[str(path.relative_to(root))] = path.read_text()
    return (root / "tests/stack/conformance/RULES.md").read_text(), files


def main():
    if sys.argv[1:] == ["--self-test"]:
        lines = self_test()
    elif sys.argv[1:2] == ["--coverage"]:
        rules, tests, _ = compare(*read(Path(sys.argv[2])))
        for tag, sentence in rules.items():
            print(f"[{tag}] {sentence}", *tests[tag], sep="\n    ")
        return 0
    else:
        lines = verdicts(*read(Path(sys.argv[1])))
    print(f"1..{len(lines)}")
    for good, text in lines:
        print("ok" if good else "not ok", text)
    return 0 if all(good for good, _ in lines) else 1


if __name__ == "__main__":
    sys.exit(main())
