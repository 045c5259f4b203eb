#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares the calls of operations with the committed lists, and the lists of a page with these.

PROGRAM prints "WALK<TAB>name" and "DEPTH<TAB>ADDRESS" for each call. The committed lists are tests/walk/walks.txt:
"name | number of calls | aim", then a line for each function: indented by its depth, with its file, and the number of
calls where it is called repeatedly. Deep calls of long operations are counted, but not listed. Prints "1..N" and N
lines "ok …" or "not ok …".
"""
import argparse
import re
import subprocess
import sys
from pathlib import Path

# The aim of an operation, and the depth of its list in walks.txt and on the page.
ALL = 99
AIMS = {"RPDO": 30, "SYNC": 45, "save": 90}
DEEPEST = {
    "RPDO": (ALL, ALL),
    "SYNC": (ALL, ALL),
    "SDO upload": (ALL, ALL),
    "SDO block download": (5, 6),
    "save": (6, 8),
    "NMT reset": (4, 4),
}


def functions(program):
    """Returns the name and the file of the function at each address."""
    lines = subprocess.run(["nm", "-C", "-l", program], check=True, capture_output=True, text=True).stdout.splitlines()
    found = {}
    for line in lines:
        symbol, _, place = line.partition("\t")
        parts = symbol.split(maxsplit=2)
        if len(parts) != 3 or parts[1] not in "tTwW":
            continue
        name = parts[2].replace("(anonymous namespace)::", "")
        inside = re.search(r"\bco::([\w:~]+)", name)
        name = inside[1] if inside else re.sub(r"[(<].*", "", name)
        found[format(int(parts[0], 16), "x")] = (name, re.sub(r"^.*/(src|include)/", "", place).split(":")[0])
    return found


class Node:
    """A call with the calls that it makes."""

    def __init__(self, what):
        self.what = what
        self.calls = []
        self.times = 1

    def key(self):
        return (self.what, tuple(call.key() for call in self.calls))

    def folded(self):
        """Joins equal calls that follow each other."""
        self.calls = [call.folded() for call in self.calls]
        joined = []
        for call in self.calls:
            if joined and joined[-1].key() == call.key():
                joined[-1].times += call.times
            else:
                joined.append(call)
        self.calls = joined
        return self

    def lines(self, depth=0):
        name = "  " * depth + self.what[0] + (f" x {self.times}" if self.times > 1 else "")
        yield f"{name:<64} {self.what[1]}"
        for call in self.calls:
            yield from call.lines(depth + 1)


def tree(calls, names):
    root = Node(("", ""))
    path = [root]
    for depth, address in calls:
        node = Node(names[address])
        del path[depth + 1 :]
        path[-1].calls.append(node)
        path.append(node)
    return root.folded()


def read_walks(output):
    walks = {}
    for line in output.splitlines():
        first, second = line.split("\t")
        if first == "WALK":
            walks[second] = []
            current = walks[second]
        else:
            current.append((int(first), second))
    return walks


def text_of(name, calls, names):
    aim = AIMS.get(name)
    head = f"{name} | {len(calls)} calls" + (f" | aim {aim}" if aim else "")
    lines = shallow(tree(calls, names), DEEPEST[name][0])
    return "\n".join([head, *("  " + line for line in lines)]) + "\n"


def without_helpers(node):
    """Removes the calls of functions in headers that call no function of a source file."""
    node.calls = [without_helpers(call) for call in node.calls]
    node.calls = [call for call in node.calls if call.calls or call.what[1].endswith(".cpp")]
    return node


def shallow(root, deepest):
    """Returns the lines of the calls down to a depth."""
    lines = [line for call in root.calls for line in call.lines()]
    return [line for line in lines if (len(line) - len(line.lstrip())) // 2 <= deepest]


def page_with(page, walks, names):
    for name, calls in walks.items():
        begin, end = f"<!-- walk {name}: begin -->", f"<!-- walk {name}: end -->"
        if begin in page:
            head, rest = page.split(begin)
            tail = rest.split(end)[1]
            aim = f" (aim: {AIMS[name]})" if name in AIMS else ""
            lines = "\n".join(shallow(without_helpers(tree(calls, names)).folded(), DEEPEST[name][1]))
            page = f"{head}{begin}\n{len(calls)} calls{aim}:\n\n```\n{lines}\n```\n{end}{tail}"
    return page


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", required=True)
    parser.add_argument("--committed", required=True, type=Path)
    parser.add_argument("--page", required=True, type=Path)
    parser.add_argument("--compiler", required=True)
    parser.add_argument("--update", action="store_true")
    options = parser.parse_args()
    output = subprocess.run([options.program], check=True, capture_output=True, text=True).stdout
    walks = read_walks(output)
    names = functions(options.program)
    texts = {name: text_of(name, calls, names) for name, calls in walks.items()}
    committed = f"# {options.compiler}\n" + "\n".join(texts.values())
    page = page_with(options.page.read_text(encoding="utf-8"), walks, names)
    if options.update:
        options.committed.write_text(committed, encoding="utf-8")
        options.page.write_text(page, encoding="utf-8")
    old = options.committed.read_text(encoding="utf-8") if options.committed.exists() else ""
    results = [(text in old, f"calls of {name}: {len(walks[name])}") for name, text in texts.items()]
    results.append((committed == old, f"{options.committed.name} contains these lists alone"))
    results.append((page == options.page.read_text(encoding="utf-8"), f"{options.page.name} contains the lists"))
    print(f"1..{len(results)}")
    for is_right, what in results:
        print("ok" if is_right else "not ok", what)
        if not is_right:
            print("  tests/run --update-numbers writes the lists: read the change")
    return 0 if all(is_right for is_right, _ in results) else 1


if __name__ == "__main__":
    sys.exit(main())
