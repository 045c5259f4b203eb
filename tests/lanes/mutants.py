#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Changes src in N random places, one at a time, and runs the doctest cases and the C programs against each change.

mutants.py --root DIRECTORY --work DIRECTORY --number N --seed S

A mutant is a relation, a number or a condition that is changed, or a statement that is left out. It is killed if a test
fails. Mutants that do not compile, and those whose machine code is that of the original, are replaced by others. The
same N and S choose the same mutants as long as src is the same. Prints a line for each mutant: "ok" if it is killed,
file, function, line and change, and the first case that fails.
"""
import argparse
import concurrent.futures
import hashlib
import itertools
import os
import pathlib
import random
import re
import resource
import shutil
import subprocess
import sys

CPU_SECONDS = 200  # of one test program; a mutant that runs longer is killed
JOBS = os.cpu_count() or 1
# Ends at the first failure. The tests of the fixtures have cases that should fail, which would end it, too.
CASES = ("--no-colors", "--abort-after=1", "-sfe=*fixture_test.cpp,*/unity_test.cpp")

RELATIONS = {"==": "!=", "!=": "==", "<": "<=", "<=": "<", ">": ">=", ">=": ">"}
RELATION = re.compile(r" (==|!=|<=|>=|<|>) ")
NUMBER = re.compile(r"(?<![\w.'\"])(\d+)(U?)(?![\w.'\"])")
CONDITION = re.compile(r"\bif \(([^;]*)\) \{$")
STATEMENT = re.compile(r"^ +(?!return\b|break|continue|const |static|using |constexpr|uint|int|bool |case |default|"
                       r"\}|else)"
                       r"(?:[\w:.\[\]>*()-]+(?: [-+|&^]?= |\().*|\+\+.*|--.*);$")
FUNCTION = re.compile(r"^(?:\[\[.*\]\] )?(?!namespace|struct|class|enum|using|static_assert|extern|template)[\w:]"
                      r"[\w:<>&*,~ ]*?\b([\w:~]+)\(.*")


def mutants_of(path, text):
    """Yields (line, kind, new text of the line, description, function)."""
    function, in_table, before = "", False, ""
    for number, line in enumerate(text.split("\n")):
        begins, before = not before or before.endswith((";", "{", "}", ":")), line.split("//")[0].rstrip()
        match = FUNCTION.match(line)
        if match:
            function, in_table = match.group(1), False
        if re.match(r"^\S.* = \{$|^\S.*\{$", line) and not match:
            in_table = True
        code = line.split("//")[0].rstrip()
        if not line.startswith("  ") or in_table or not code or re.search("static_assert|CO_ASSERT|constexpr|ASSERT_PTR", code):
            continue
        for match in RELATION.finditer(code):
            if "template" in code or "operator" in code:
                break
            new = code[:match.start(1)] + RELATIONS[match.group(1)] + code[match.end(1):]
            yield number, "relation", new, function
        for match in NUMBER.finditer(code):
            if match.group(1) in ("0", "1") or re.search(r" [-+<>=]=? $", code[:match.start()]):
                new = code[:match.start()] + str(int(match.group(1)) + 1) + match.group(2) + code[match.end():]
                yield number, "number", new, function
        match = CONDITION.search(code)
        if match:
            new = code[:match.start(1)] + "!(" + match.group(1) + ")" + code[match.end(1):]
            yield number, "condition", new, function
        if begins and STATEMENT.match(code):
            yield number, "statement", re.match(" *", code).group() + ";", function


class Tree:
    """A copy of the sources with a build of its own."""

    def __init__(self, root, directory):
        self.source, self.build = directory / "source", directory / "build"
        shutil.rmtree(directory, ignore_errors=True)
        shutil.copytree(root, self.source, ignore=shutil.ignore_patterns("build", ".git"), symlinks=True)
        self.log = directory / "log"
        self.run("cmake", "-S", self.source, "-B", self.build, "-G", "Ninja", "-DLEXICAN_PRESET=full",
                 "-DCMAKE_BUILD_TYPE=Debug", "-DCMAKE_C_FLAGS_DEBUG=-O1", "-DCMAKE_CXX_FLAGS_DEBUG=-O1",
                 "-DLEXICAN_THIN_SWEEPS=ON")
        if not self.make("lexican_tests"):
            sys.exit(f"the tree without a mutant is not built, see {self.log}")
        self.original = self.machine_code()
        killer = self.killer()
        if killer:
            sys.exit(f"the tests fail without a mutant: {killer}")

    def run(self, *command, **options):
        with open(self.log, "w", encoding="utf-8") as log:
            return subprocess.run([str(part) for part in command], stdout=log, stderr=subprocess.STDOUT, check=False,
                                  **options).returncode

    def said(self):
        return self.log.read_text(encoding="utf-8", errors="replace")

    def make(self, *targets):
        return self.run("cmake", "--build", self.build, "-j", "1", "--target", *targets) == 0

    def machine_code(self):
        return hashlib.sha256((self.build / "src/liblexican.a").read_bytes()).hexdigest()

    def killer(self):
        """Returns the first case that fails, or None."""
        limit = lambda: resource.setrlimit(resource.RLIMIT_CPU, (CPU_SECONDS, CPU_SECONDS))
        if not self.make("lexican_tests"):
            return "the build of the tests"
        if self.run(self.build / "tests/lexican_tests", *CASES, preexec_fn=limit) != 0:
            found = re.search(r"^TEST CASE: +(.*)", self.said(), re.M)
            return found.group(1) if found else "ended early"
        if not self.make("tests/stack/compat/all"):
            return "the build of the tests"
        if self.run("ctest", "--test-dir", self.build / "tests/stack/compat", "--stop-on-failure", "-E", "[.]lto[.]") != 0:
            found = re.search(r"Test +#\d+: (\S+) .*(?:Failed|Exception|Timeout)", self.said())
            return found.group(1) if found else "ctest"
        return None

    def verdict(self, mutant):
        """Returns the case that kills the mutant, "" if it survives, None if it is not a mutant."""
        path, number, _, new, _ = mutant
        file = self.source / path
        text = file.read_text(encoding="utf-8")
        lines = text.split("\n")
        lines[number] = new
        file.write_text("\n".join(lines), encoding="utf-8")
        try:
            if not self.make("lexican") or self.machine_code() == self.original:
                return None
            return self.killer() or ""
        finally:
            file.write_text(text, encoding="utf-8")


def choose(root, seed):
    """Yields the mutants in their random order, the kinds in turn."""
    kinds = {"relation": [], "number": [], "condition": [], "statement": []}
    for path in sorted((root / "src").rglob("*.cpp")):
        for number, kind, new, function in mutants_of(path, path.read_text(encoding="utf-8")):
            kinds[kind].append((str(path.relative_to(root)), number, kind, new, function))
    generator = random.Random(seed)
    for mutants in kinds.values():
        generator.shuffle(mutants)
    for row in itertools.zip_longest(*kinds.values()):
        yield from (mutant for mutant in row if mutant is not None)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--root", type=pathlib.Path, required=True)
    parser.add_argument("--work", type=pathlib.Path, required=True)
    parser.add_argument("--number", type=int, required=True)
    parser.add_argument("--seed", type=int, required=True)
    arguments = parser.parse_args()

    print(f"1..{arguments.number}", flush=True)
    mutants, running, valid = choose(arguments.root, arguments.seed), {}, 0
    with concurrent.futures.ThreadPoolExecutor(JOBS) as pool:
        idle = list(pool.map(lambda n: Tree(arguments.root, arguments.work / str(n)), range(JOBS)))
        while valid < arguments.number:
            while idle and valid + len(running) < arguments.number:
                mutant, tree = next(mutants), idle.pop()
                running[pool.submit(tree.verdict, mutant)] = (tree, mutant)
            for done in concurrent.futures.wait(running, return_when=concurrent.futures.FIRST_COMPLETED).done:
                tree, (path, number, _, new, function) = running.pop(done)
                idle.append(tree)
                killer = done.result()
                if killer is not None:
                    valid += 1
                    change = new.strip()
                    if change == ";":
                        lines = (arguments.root / path).read_text(encoding="utf-8").split("\n")
                        change = "without " + lines[number].strip()
                    print("ok" if killer else "not ok", f"{valid} - {path}:{number + 1} {function}(): {change}:",
                          killer or "survives", flush=True)


if __name__ == "__main__":
    main()
