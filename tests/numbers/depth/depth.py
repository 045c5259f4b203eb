#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How deep the stack gets in each function that an application can call.

Prints what keeps that from being known ("ok …", "not ok …", "1..N"), and writes the depths: name, tabulator, bytes,
tabulator, where.
"""
import argparse
import re
import sys
from fnmatch import fnmatchcase
from pathlib import Path

from program import Program
from targets import Targets


class RunTime:
    """The functions of the compiler's and the C library that a program has, from objdump -td: their instructions."""

    def __init__(self, text):
        self.depths = {}
        bodies = dict(re.findall(r"^([0-9a-f]+) <\S+>:\n((?:.+\n)*)", text, re.MULTILINE))
        names = re.findall(r"^([0-9a-f]+) .{7} \S+\t[0-9a-f]+ (?:\.hidden )?(\S+)$", text, re.MULTILINE)
        self.bodies = {name: bodies[address] for address, name in names if address in bodies}

    def depth(self, symbol):
        """All that is pushed anywhere in it, and the deepest of what it jumps to."""
        if symbol not in self.depths:
            body = self.bodies[symbol]
            pushed = sum(4 * self.registers(names) for names in re.findall(r"\tpush\t\{(.*?)\}", body))
            pushed += sum(int(size) for size in re.findall(r"\tsub\tsp, #(\d+)", body))
            self.depths[symbol] = pushed  # while it is looked at: a jump to its own beginning
            jumps = set(re.findall(r"\tb\w*(?:\.n)?\t[0-9a-f]+ <([^+>]+)>", body)) - {symbol}
            self.depths[symbol] = pushed + max((self.depth(jump) for jump in jumps), default=0)
        return self.depths[symbol]

    @staticmethod
    def registers(names):
        """Of "r4, r5, lr", or "r4-r7"."""
        ranges = (re.fullmatch(r"r(\d+)-r(\d+)", name.strip()) for name in names.split(","))
        return sum(int(found[2]) - int(found[1]) + 1 if found else 1 for found in ranges)


class Recursion(Exception):
    """A way that comes back to where it was."""


class Depths:
    """Of all functions of a program. A place is a function, or one as another function calls it ("function@caller")."""

    def __init__(self, program, targets, run_time):
        self.program = program
        self.targets = targets
        self.run_time = run_time
        self.next = {}  # place → places
        self.reached = set()  # titles of functions that calls through pointers lead to
        functions = program.functions.values()
        self.unknown = [call for function in functions for call in function.calls if not targets.rules_of(call)]
        self.by_caller = {
            function.title
            for function in functions
            if any(rule.depends_on_caller for call in function.calls for rule in targets.rules_of(call))
        }
        for function in functions:
            self.resolve(function.title, function, None)
        self.limits = {}  # title → number of the limit that it is one of
        for number, (pattern, _) in enumerate(targets.limits):
            self.limits.update((each.title, number) for each in functions if fnmatchcase(each.name, pattern))
        self.nevers = {}  # title → numbers of the "never" that begin with it
        self.forbidden = [targets.of_words(words, "") for _, words in targets.nevers]
        for number, (pattern, _) in enumerate(targets.nevers):
            found = [each.title for each in functions if fnmatchcase(each.name, pattern)]
            if not found and targets.is_whole:
                raise SystemExit(f"calls.txt: never | {pattern}: there is no such function")
            for title in found:
                self.nevers.setdefault(title, []).append(number)
        self.top = (0,) * (len(targets.limits) + len(targets.nevers))
        self.known = {}  # place, what is above it → bytes, next place
        self.way_here = []

    def resolve(self, place, function, caller):
        """What a place leads to, and what that leads to as far as it depends on its caller."""
        self.next[place] = set()
        through = set()
        for call in function.calls:
            through |= self.targets.of_call(call, caller)
        self.reached |= through
        for title in function.callees | through:
            after = title
            if title in self.by_caller:
                after = f"{title}@{function.title}"
                if after not in self.next:
                    self.resolve(after, self.program.functions[title], function)
            self.next[place].add(after)

    def is_application(self, title):
        function = self.program.functions.get(title)
        symbol = function.symbol if function else title
        return symbol.startswith("CO") and (function is None or function.is_weak)

    def of(self, place, above=None):
        """Bytes, and the place that it goes on with."""
        above = self.top if above is None else above
        title = place.partition("@")[0]
        if self.is_application(title):
            return 0, None
        if title not in self.program.functions:
            return self.run_time.depth(title), None
        if (place, above) in self.way_here:
            raise Recursion(self.way_here[self.way_here.index((place, above)) :] + [(place, above)])
        if (place, above) not in self.known:
            self.way_here.append((place, above))
            self.known[place, above] = self.measure(place, title, above)
            self.way_here.pop()
        return self.known[place, above]

    def measure(self, place, title, above):
        frame = self.program.functions[title].frame
        below = self.below(title, above)
        if below is None:
            return frame, None
        ways = ((self.of(after, below)[0], after) for after in self.next[place] if not self.is_forbidden(after, below))
        deepest = max(ways, default=(0, None), key=lambda way: (way[0], way[1] or ""))
        return frame + deepest[0], deepest[1]

    def below(self, title, above):
        """What is above those that a function calls. None: it has reached its limit."""
        now = list(above)
        limit = self.limits.get(title)
        if limit is not None:
            if above[limit] == self.targets.limits[limit][1]:
                return None
            now[limit] += 1
        for number in self.nevers.get(title, []):
            now[len(self.targets.limits) + number] = 1
        return tuple(now)

    def is_forbidden(self, place, above):
        flags = above[len(self.targets.limits) :]
        return any(flag and place.partition("@")[0] in self.forbidden[number] for number, flag in enumerate(flags))

    def name(self, place):
        title = place.partition("@")[0]
        return self.program.functions[title].name if title in self.program.functions else title

    def way(self, place):
        """Names and bytes of the functions, from the first to the last."""
        steps = []
        above = self.top
        while place:
            title = place.partition("@")[0]
            if not self.is_application(title):
                is_ours = title in self.program.functions
                own = self.program.functions[title].frame if is_ours else self.run_time.depth(title)
                steps.append(f"{self.name(place)} {own}")
            after = self.of(place, above)[1]
            above = self.below(title, above)
            place = after
        return ", ".join(steps)

    def uncovered(self):
        """Functions whose address is in a table or taken, and that no call is said to lead to."""
        tables = {title for table in self.program.tables.values() for title in table.values()}
        return sorted((tables | self.program.taken()) - self.reached)

    def public(self):
        """Functions of the API."""
        functions = self.program.functions.values()
        return [each for each in functions if each.symbol.startswith("CO") and not each.is_weak]


def verdicts(depths):
    """What there may not be, one by one. A program with a part of the library uses a part of calls.txt."""
    program = depths.program
    is_whole = depths.targets.is_whole
    for function in program.functions.values():
        if not function.is_fixed:
            yield False, f"{function.name} has an array of variable length, or alloca()"
    for call in depths.unknown:
        yield False, f"{call.file}, {call.function.name}: no line lists what {call.expression}() may call"
    for title in depths.uncovered() if is_whole else []:
        yield False, f"{depths.name(title)} is in a table, or its address is taken, but no call is said to lead to it"
    for rule in depths.targets.rules if is_whole else []:
        yield rule.is_used, f"calls.txt: {rule.file} | {rule.expression} {'' if rule.is_used else 'applies to no call'}"
    for function in depths.public():
        try:
            depths.of(function.title)
            yield True, f"{function.name} does not call itself"
        except Recursion as recursion:
            names = ", ".join(depths.name(place) for place, _ in recursion.args[0])
            yield False, f"{function.name} leads to a function that calls itself: {names}"
            return


def measured(depths):
    """Lines, the deepest first; the way of the deepest is told."""
    functions = sorted(depths.public(), key=lambda each: (-depths.of(each.title)[0], each.name))
    for function in functions:
        way = depths.way(function.title) if function is functions[0] else ""
        yield f"{function.name}\t{depths.of(function.title)[0]}\t{way}\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--objects", type=Path, nargs="+", required=True, help="objects, with their call graphs beside them")
    parser.add_argument("--sources", type=Path, required=True, help="src/")
    parser.add_argument("--calls", type=Path, required=True, help="calls.txt")
    parser.add_argument("--program", required=True, help="has the functions of the C library")
    parser.add_argument("--tools", required=True, help="prefix of objdump and c++filt")
    parser.add_argument("--only", nargs="+", default=[], help="write these functions of a part of the library, with a suffix")
    parser.add_argument("--depths", type=Path, required=True, help="to be written")
    parser.add_argument("--ways", type=Path, required=True, help="to be written: every way")
    arguments = parser.parse_args()
    sys.setrecursionlimit(10000)
    program = Program(arguments.objects, arguments.sources.resolve(), arguments.tools)
    run_time = RunTime(program.output_of("objdump", "-td", arguments.program))
    depths = Depths(program, Targets(arguments.calls.read_text(encoding="utf-8"), program, not arguments.only), run_time)
    cases = list(verdicts(depths))
    for is_good, what in cases:
        print("ok" if is_good else "not ok", what)
    print(f"1..{len(cases)}")
    if not all(is_good for is_good, _ in cases):
        return 1
    if arguments.only:
        suffix, *names = arguments.only
        arguments.depths.write_text("".join(f"{each.name}{suffix}\t{depths.of(each.title)[0]}\n" for each in depths.public() if each.name in names), encoding="utf-8")
        return 0
    arguments.depths.write_text("".join(measured(depths)), encoding="utf-8")
    ways = (f"{depths.of(each.title)[0]}: {depths.way(each.title)}\n" for each in depths.public())
    arguments.ways.write_text("".join(sorted(ways, key=lambda way: -int(way.partition(":")[0]))), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
