#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares measured numbers with the committed ones, and the table of a page with these.

A measured number is a line "name<TAB>number", or "name<TAB>number<TAB>remark". The committed numbers are lines
"name | number of each column | limit of each column | remark". Limits are written by hand; --update writes the rest.
Numbers of other stacks, written by hand, are lines "name | column | number of each stack" of a file whose line
"# stacks | name of each" names them.
Prints "1..N" and N lines "ok …" or "not ok …"; what another compiler has made is "ok … # SKIP".
"""
import argparse
import re
import sys
from pathlib import Path

HEAD = """\
# {title} of {page}. tests/run --update-numbers writes the numbers; limits are written by hand.
# compilers | {compilers}
# {title} | {columns} | limit of each, where there is one | remark
"""


class Column:
    """A title, the compiler of its numbers, and what was measured: texts, as they were printed."""

    def __init__(self, title, compiler, *files):
        self.title = title
        self.compiler = compiler
        self.numbers = {}
        self.remarks = {}
        for line in (line for file in files for line in Path(file).read_text(encoding="utf-8").splitlines()):
            name, number, *remark = line.split("\t")
            self.numbers[name] = number
            self.remarks[name] = remark[0].strip() if remark else ""


class Row:
    """A line of the committed numbers. Numbers are texts; "" is none."""

    def __init__(self, name, numbers, limits, remark):
        self.name = name
        self.numbers = numbers
        self.limits = limits
        self.remark = remark

    def line(self):
        return " | ".join([self.name, *self.numbers, *self.limits, self.remark]).rstrip(" |") + "\n"


class Stacks:
    """Other stacks: their names, and their numbers of a row and a column."""

    def __init__(self, path):
        text = path.read_text(encoding="utf-8") if path else ""
        found = re.search(r"^# stacks \| (.*)$", text, re.MULTILINE)
        self.names = [name.strip() for name in found[1].split("|")] if found else []
        self.numbers = {}
        for line in text.splitlines():
            if line and not line.startswith("#"):
                name, column, *numbers = [field.strip() for field in line.split("|")]
                self.numbers[name, column] = numbers + [""] * (len(self.names) - len(numbers))

    def know(self, column):
        return any(of == column for _, of in self.numbers)

    def of(self, name, column):
        return self.numbers.get((name, column), [""] * len(self.names))


class Committed:
    """The file of the committed numbers."""

    def __init__(self, path, width):
        text = path.read_text(encoding="utf-8") if path.exists() else ""
        found = re.search(r"^# compilers \| (.*)$", text, re.MULTILINE)
        self.compilers = [compiler.strip() for compiler in found[1].split("|")] if found else []
        self.rows = {}
        for line in text.splitlines():
            if line and not line.startswith("#"):
                name, *fields = [field.strip() for field in line.split("|")]
                fields += [""] * (2 * width + 1 - len(fields))
                self.rows[name] = Row(name, fields[:width], fields[width : 2 * width], fields[2 * width])

    def has_compiler_of(self, number, column):
        return number < len(self.compilers) and self.compilers[number] == column.compiler


class Report:
    """What the command line asks for."""

    def __init__(self, arguments):
        self.arguments = arguments
        self.columns = [Column(*column) for column in arguments.column]
        self.committed = Committed(arguments.committed, len(self.columns))
        self.stacks = Stacks(arguments.stacks)

    # The table of the page ----------------------------------------------------------------------------------------

    def table(self):
        rows = list(self.committed.rows.values())
        with_limits = [any(row.limits[number] for row in rows) for number in range(len(self.columns))]
        with_stacks = [self.stacks.know(column.title) for column in self.columns]
        with_remarks = any(row.remark for row in rows)
        heads = [self.arguments.title]
        for column, has_limits, has_stacks in zip(self.columns, with_limits, with_stacks):
            heads += [column.title] + [self.arguments.limits] * has_limits + self.stacks.names * has_stacks
        marks = ["---"] + ["---:"] * (len(heads) - 1)
        if with_remarks:
            heads.append(self.arguments.remark)
            marks.append("---")
        lines = ["| " + " | ".join(heads) + " |", "|" + "|".join(marks) + "|"]
        for row in rows:
            cells = [row.name]
            for number, column in enumerate(self.columns):
                cells += [row.numbers[number]] + [row.limits[number]] * with_limits[number]
                cells += self.stacks.of(row.name, column.title) * with_stacks[number]
            cells += [row.remark] if with_remarks else []
            lines.append("|" + "".join(f" {cell} |" if cell else " |" for cell in cells))
        return "\n".join(lines) + "\n"

    def page_with_table(self, page):
        name = re.escape(self.arguments.table)
        place = re.compile(f"(<!-- {name} table: begin -->\n).*(<!-- {name} table: end -->)", re.DOTALL)
        changed, places = place.subn(lambda marks: marks[1] + self.table() + marks[2], page)
        if places != 1:
            sys.exit(f"the page has no place for the table {self.arguments.table}")
        return changed

    # Update -------------------------------------------------------------------------------------------------------

    def update(self):
        """The measured names in their order, with the limits that are committed."""
        before, self.committed.rows = self.committed.rows, {}
        self.committed.compilers = [column.compiler for column in self.columns]
        for name in self.names_of_columns():
            limits = before[name].limits if name in before else [""] * len(self.columns)
            numbers = [column.numbers.get(name, "") for column in self.columns]
            remarks = [column.remarks[name] for column in self.columns if column.remarks.get(name)]
            self.committed.rows[name] = Row(name, numbers, limits, remarks[0] if remarks else "")
        head = HEAD.format(
            title=self.arguments.title,
            page=f"{self.arguments.page.parent.name}/{self.arguments.page.name}",
            compilers=" | ".join(self.committed.compilers),
            columns=" | ".join(column.title for column in self.columns),
        )
        text = head + "".join(row.line() for row in self.committed.rows.values())
        self.arguments.committed.write_text(text, encoding="utf-8")
        page = self.arguments.page.read_text(encoding="utf-8")
        self.arguments.page.write_text(self.page_with_table(page), encoding="utf-8")

    def names_of_columns(self):
        """In the order of the column that has most of them."""
        columns = sorted(self.columns, key=lambda column: -len(column.numbers))
        return dict.fromkeys(name for column in columns for name in column.numbers)

    # Verdicts -----------------------------------------------------------------------------------------------------

    def verdicts(self):
        for number, column in enumerate(self.columns):
            is_comparable = self.committed.has_compiler_of(number, column)
            for name in dict.fromkeys([*self.committed.rows, *column.numbers]):
                row = self.committed.rows.get(name)
                before = row.numbers[number] if row else ""
                now = column.numbers.get(name, "")
                if not before and not now:
                    continue
                what = f"{name}, {column.title}"
                if is_comparable:
                    yield self.verdict(what, before, now)
                    if self.arguments.limits and now and row and row.limits[number]:
                        yield self.within_limit(what, row.limits[number], now)
                else:
                    yield True, f"{what} # SKIP what is committed is not of {column.compiler}"
        page = self.arguments.page.read_text(encoding="utf-8")
        yield from self.names_of_stacks()
        yield self.page_with_table(page) == page, f"{self.arguments.page.name} has these numbers"

    def names_of_stacks(self):
        """Rows of other stacks that no measured row has would be shown nowhere."""
        columns = [column.title for column in self.columns]
        for name, column in self.stacks.numbers:
            yield name in self.committed.rows and column in columns, f"{name}, {column}: measured here as in other stacks"

    @staticmethod
    def within_limit(what, limit, now):
        return float(now) <= float(limit), f"{what}: {now}, at most {limit}: free as many bytes elsewhere"

    def verdict(self, what, before, now):
        if not now:
            return False, f"{what}: not measured"
        if not before:
            return False, f"{what}: {now}, but none is committed"
        most = max(float(before) * (1 + self.arguments.percent / 100), float(before) + self.arguments.slack)
        return float(now) <= most, f"{what}: {now}, {before} is committed, up to {most:.1f} is allowed"


def print_verdicts(cases):
    for is_good, what in cases:
        print("ok" if is_good else "not ok", what)
    print(f"1..{len(cases)}")
    return 0 if all(is_good for is_good, _ in cases) else 1


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--committed", type=Path, required=True, help="the committed numbers")
    parser.add_argument("--stacks", type=Path, help="the numbers of other stacks")
    parser.add_argument("--page", type=Path, required=True, help="Markdown with the table")
    parser.add_argument("--table", required=True, help="name of the table in its marks")
    parser.add_argument("--title", required=True, help="of the column of the names")
    parser.add_argument("--remark", default="", help="title of the column of the remarks")
    parser.add_argument("--percent", type=float, default=0, help="how much a number may grow …")
    parser.add_argument("--slack", type=float, default=0, help="… if that is more than this")
    parser.add_argument("--column", nargs="+", action="append", required=True, help="title, compiler, measured files")
    parser.add_argument("--limits", default="", help="title of the limits, which then bind: no number may exceed its own")
    parser.add_argument("--update", action="store_true", help="write numbers and table first")
    report = Report(parser.parse_args())
    if report.arguments.update:
        report.update()
    return print_verdicts(list(report.verdicts()))


if __name__ == "__main__":
    sys.exit(main())
