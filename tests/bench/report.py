#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares measured instructions with the committed ones, and the table of a page with these.

Prints "1..N" and N lines "ok …" or "not ok …". Status 77: the committed counts are of another compiler.
"""
import argparse
import re
import sys
from pathlib import Path

CPUS = ["Cortex-M3 -O2", "Cortex-M0+ -Os"]
MOST_GROWTH = 5  # percent
TABLE = re.compile(r"(<!-- instructions table: begin -->\n).*(<!-- instructions table: end -->)", re.DOTALL)
HEAD = """\
# Instructions of each operation, of arm-none-eabi-g++ {compiler}. tests/run --update-instructions writes the counts.
# operation | {cpus[0]} | {cpus[1]} | budget of each, where there is one
"""


class Row:
    """A line of the committed counts. Counts are texts, as they are printed; None: not measured yet."""

    def __init__(self, name, counts, budgets):
        self.name = name
        self.counts = counts
        self.budgets = budgets

    def line(self):
        return " | ".join([self.name, *self.counts, *self.budgets]).rstrip() + "\n"

    def cells(self):
        for count, budget in zip(self.counts, self.budgets):
            yield from (count, budget, f"{float(count) / float(budget):.2f}" if budget else "")


def read_committed(path):
    text = path.read_text(encoding="utf-8")
    compiler = re.search(r"g\+\+ ([0-9.]+[0-9])", text)
    rows = {}
    for line in text.splitlines():
        if line and not line.startswith("#"):
            name, *numbers = [field.strip() for field in line.split("|")]
            numbers += [""] * (4 - len(numbers))
            rows[name] = Row(name, numbers[:2], numbers[2:])
    return rows, compiler.group(1) if compiler else ""


def read_measured(paths):
    lines = [line for path in paths for line in path.read_text(encoding="utf-8").splitlines()]
    return dict(line.split("\t") for line in lines)


def table_of(rows):
    columns = " | ".join(f"{cpu} | budget | ratio" for cpu in CPUS)
    lines = [f"| operation | {columns} |", "|---" + "|---:" * 6 + "|"]
    for row in rows.values():
        lines.append("|" + "".join(f" {cell} |" if cell else " |" for cell in [row.name, *row.cells()]))
    return "\n".join(lines) + "\n"


def with_table(page, rows):
    changed, places = TABLE.subn(lambda marks: marks[1] + table_of(rows) + marks[2], page)
    if places != 1:
        sys.exit("the page has no place for the table")
    return changed


def update(arguments, committed, measured):
    """The measured operations in their order, with the budgets that are committed."""
    rows = {}
    for name in measured[0]:
        budgets = committed[name].budgets if name in committed else ["", ""]
        rows[name] = Row(name, [on_cpu[name] for on_cpu in measured], budgets)
    head = HEAD.format(compiler=arguments.compiler, cpus=CPUS)
    arguments.counts.write_text(head + "".join(row.line() for row in rows.values()), encoding="utf-8")
    page = arguments.page.read_text(encoding="utf-8")
    arguments.page.write_text(with_table(page, rows), encoding="utf-8")


def verdicts(page, committed, measured):
    for number, cpu in enumerate(CPUS):
        for name in dict.fromkeys([*committed, *measured[number]]):
            count = measured[number].get(name)
            if count is None:
                yield False, f"{name}, {cpu}: not measured"
            elif name not in committed:
                yield False, f"{name}, {cpu}: {count} instructions, but none are committed"
            else:
                before = committed[name].counts[number]
                growth = 100 * (float(count) / float(before) - 1)
                change = f"{before} are committed ({growth:+.1f} %, up to +{MOST_GROWTH} % is allowed)"
                yield growth <= MOST_GROWTH, f"{name}, {cpu}: {count} instructions, {change}"
    yield with_table(page, committed) == page, "docs/speed.md has these counts"


def print_verdicts(cases):
    good = True
    for is_good, what in cases:
        print("ok" if is_good else "not ok", what)
        good = good and is_good
    print(f"1..{len(cases)}")
    return 0 if good else 1


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--counts", type=Path, required=True, help="the committed counts")
    parser.add_argument("--page", type=Path, required=True, help="Markdown with the table")
    parser.add_argument("--compiler", required=True, help="version")
    parser.add_argument("--m3", type=Path, nargs="+", required=True, help="what was measured on Cortex-M3")
    parser.add_argument("--m0plus", type=Path, nargs="+", required=True, help="what was measured on Cortex-M0+")
    parser.add_argument("--update", action="store_true", help="write counts and table first")
    arguments = parser.parse_args()
    measured = [read_measured(arguments.m3), read_measured(arguments.m0plus)]
    if arguments.update:
        update(arguments, read_committed(arguments.counts)[0], measured)
    committed, compiler = read_committed(arguments.counts)
    if compiler != arguments.compiler:
        print(f"the committed counts are of arm-none-eabi-g++ {compiler}, this is {arguments.compiler}")
        return 77
    page = arguments.page.read_text(encoding="utf-8")
    return print_verdicts(list(verdicts(page, committed, measured)))


if __name__ == "__main__":
    sys.exit(main())
