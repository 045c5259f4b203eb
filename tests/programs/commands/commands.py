#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""commands.py ROOT [LANE]

Finds the commands of the pages below ROOT: the lines of their blocks of language sh. The comment <!-- run by LANE -->
above a block names the lane that runs its commands, each with the exceptions in commands_not_run.txt.

With LANE, prints a line "run PAGE COMMAND" or "start PAGE COMMAND" (a program that does not end) for commands.sh.
Without, prints TAP: each command is run by a lane or is an exception, and each exception is needed.
"""
import pathlib
import re
import shlex
import sys

BLOCK = re.compile(r"(?:^[ ]*<!-- run by (?P<lane>\w+) -->\n)?^(?P<indent>[ ]*)```(?P<language>\S*)\n(?P<text>.*?)^(?P=indent)```$",
                   re.MULTILINE | re.DOTALL)
SHELLS = ("sh", "bash", "shell", "console")
HIDES_FAILURE = re.compile(r"(?<![|])[|](?![|])|;")
ENDLESS = re.compile(r"&$|^candump |^demo/run .*--serve")


def commands_of(text):
    """Returns the commands of a block without comments; a line that ends with a backslash continues."""
    lines = re.sub(r"\\\n\s*", "", text).splitlines()
    commands = (re.sub(r"(^|\s{2,}|\s+(?=# ))#.*$", "", line).strip() for line in lines)
    return [command for command in commands if command]


def blocks_of(root):
    """Yields (page, lane or None, commands) of each block of shell commands."""
    for path in sorted(root.rglob("*.md")):
        page = path.relative_to(root).as_posix()
        if page.startswith(("build", ".")):
            continue
        for block in BLOCK.finditer(path.read_text()):
            if block["language"] in SHELLS:
                yield page, block["lane"], commands_of(block["text"])


def exceptions_of(root):
    """Returns the commands that no lane runs, with the reasons: lines "REASON | COMMAND"."""
    lines = (root / "tests/programs/commands/commands_not_run.txt").read_text().splitlines()
    pairs = (line.split(" | ", 1) for line in lines if line and not line.startswith("#"))
    return {command: reason for reason, command in pairs}


def runs_pages(root, lane):
    file = root / f"tests/lanes/{lane}.sh"
    return file.exists() and "run_pages" in file.read_text()


def check(root):
    exceptions = exceptions_of(root)
    unused = set(exceptions)
    verdicts = []
    for page, lane, commands in blocks_of(root):
        for command in commands:
            unused.discard(command)
            fault = ""
            if command not in exceptions:
                if lane is None:
                    fault = "no lane runs it: write <!-- run by LANE --> above its block, or add it to commands_not_run.txt"
                elif HIDES_FAILURE.search(command):
                    fault = "a pipe or a semicolon hides the failure of a command: write two lines"
                elif not runs_pages(root, lane):
                    fault = f"lane {lane} does not run the commands of pages (run_pages)"
            verdicts.append((f"{page}: {command}", fault))
    verdicts += [(f"commands_not_run.txt: {command}", "no page has this command") for command in unused]
    print(f"1..{len(verdicts)}")
    for name, fault in verdicts:
        print(f"not ok {name}: {fault}" if fault else f"ok {name}")
    return any(fault for _, fault in verdicts)


def main():
    root = pathlib.Path(sys.argv[1])
    if len(sys.argv) < 3:
        return check(root)
    exceptions = exceptions_of(root)
    for page, lane, commands in blocks_of(root):
        for command in commands:
            if lane == sys.argv[2] and command not in exceptions:
                kind = "start" if ENDLESS.search(command) and " master " not in command else "run"
                print(kind, shlex.quote(page), shlex.quote(command))
    return 0


sys.exit(main())
