#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""pages.py LEXICAN NODE

Runs the examples of the pages of lexican with the demo node NODE, and compares their output. Prints TAP.

A line "$ COMMAND" of a block of language text is run on a pseudo-terminal, whose user answers questions with y; the
lines after it are the expected output. /dev/ttyACM0 is the pseudo-terminal of the node, which is started anew for each
page. Comments above a block prepare it:
  <!-- before: node ARGUMENTS -->  starts the node anew, with other arguments; -i BUS among them is LEXICAN_BUS
  <!-- before: sim ARGUMENTS -->   starts a simulation until the end of the page; the same one anew
  <!-- before: wait SECONDS -->    waits
  <!-- before: COMMAND -->         runs a command of lexican
  <!-- not run: REASON -->         leaves the block out
A line "sim> COMMAND" is typed into this simulation; the lines after it are not compared.
The examples of `lexican VERB --help` are run, too, and must not be wrong use.
"""
import os
import pty
import re
import select
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
PAGES = [*sorted((ROOT / "tools/lexican/docs").glob("*.md")), *sorted((ROOT / "docs/start").glob("[5-8]-*.md")),
         ROOT / "README.md"]
DEVICE = "/dev/ttyACM0"
BUS = f"slcan:{DEVICE}@500k"
NODE_ARGUMENTS = ["--serial", str(0x80BBBA4B)]  # the serial number in the pages
WRONG_USE = 2
MOST_SECONDS = 30
HEARTBEAT_SECONDS = 1.2  # and some more
TYPING_SECONDS = 0.3  # until a simulation has executed a command
LISTENING_SECONDS = 10  # of a command that ends with Ctrl-C, if fewer lines come than are expected

BLOCK = re.compile(r"(?P<comments>(?:^<!-- [^\n]* -->\n)*)^```text\n(?P<text>.*?)^```$", re.MULTILINE | re.DOTALL)
COMMENT = re.compile(r"<!-- (before|not run): (.*) -->")

# Durations, and the numbers of frames, differ from run to run; all else has to be equal.
MASKS = [(re.compile(pattern, re.MULTILINE), replacement) for pattern, replacement in (
    (r"\bin \d+\.\d+ s\b", "in T s"),
    (r"\b\d+ (valid )?frames? in\b", r"N \1frames in"),
    (r"^ +\d+\.\d{3}(?=  )", "T"),  # the time of a message
    (r"(Minute|Second) = \d+", r"\1 = N"),  # of the clock
    (r"^ +([0-9A-F]{3}h) +\d+( +\d+\.\d/s)?$", r"\1 N"),  # a line of the identifiers at the end
    (r"^\d+ PDOs? in", "N PDOs in"),
    (r"bus load \d+\.\d %", "bus load N %"),
    (r"\(since \d+\.\d+ s\)$", "(since T s)"),  # a cause
    (r"^ +\d+\.\d{3}(?= \S)", "T"),  # of a frame that shows it
    (r"\b\d+ times\b", "N times"),
    (r"in \d+ frames, \d+\.\d{3} s$", "in N frames, T s"),
    (r"^sim> \n", ""),  # the prompt of a simulation
    (r"not for \d+(\.\d+)? s", "not for T s"),
)]


def is_log(words):
    return words[1] in ("mon", "why") and words[2:] and not words[2].startswith("-")


def is_endless(words):
    """Returns whether a command runs until Ctrl-C."""
    return words[1] in ("mon", "share", "sim", "top", "why") and not is_log(words) and "--help" not in words


def comparable(words, text, recorded):
    """Returns the lines of an output without what differs, which is nothing for a log, unless the page has recorded it.
    On a bus, the order of the messages and their number differ, too."""
    if is_log(words) and words[2] not in recorded:
        return text.splitlines()
    for pattern, replacement in MASKS:
        text = pattern.sub(replacement, text)
    return sorted(set(text.splitlines())) if is_endless(words) else text.splitlines()


class Terminal:
    """A command on a pseudo-terminal, and the text that it has shown."""

    def __init__(self, command, environment, directory):
        self.shown = ""
        self.pid, self.fd = pty.fork()
        if self.pid == 0:
            os.chdir(directory)
            os.execve(command[0], command, environment)

    def read(self, seconds):
        """Reads what the command shows, for which it waits some time. Returns False after its end."""
        if not select.select([self.fd], [], [], seconds)[0]:
            return True
        try:
            text = os.read(self.fd, 65536)
        except OSError:  # EIO: the command has ended
            return False
        self.shown += text.decode(errors="replace").replace("\r\n", "\n")
        if self.shown.endswith("[y/N] "):
            self.type("y\n")
        return bool(text)

    def type(self, text):
        os.write(self.fd, text.encode())

    def end(self, seconds=MOST_SECONDS):
        """Waits for the end of the command, and returns its status."""
        end = time.monotonic() + seconds
        while self.read(0.1):
            if time.monotonic() > end:
                os.kill(self.pid, signal.SIGKILL)
        os.close(self.fd)
        return os.waitstatus_to_exitcode(os.waitpid(self.pid, 0)[1])


class Bench:
    """A directory with the files of the pages, the demo node, and the verdicts."""

    def __init__(self, lexican, node, directory):
        self.lexican = os.path.abspath(lexican)
        self.node = os.path.abspath(node)
        self.directory = directory
        self.device = directory / "ttyACM0"
        self.process = None
        self.simulations = {}  # by their arguments
        self.environment = {"PATH": os.environ["PATH"], "XDG_RUNTIME_DIR": str(directory), "NO_COLOR": "1",
                            "HOME": str(directory), "TERM": "xterm"}
        self.cases = 0
        self.good = True

    def report(self, name, fault=""):
        self.cases += 1
        print(f"ok {self.cases} - {name}" if not fault else f"not ok {self.cases} - {name}: {fault}", flush=True)
        self.good = self.good and not fault

    def start_node(self, arguments):
        self.stop_node()
        log = self.directory / "node.log"
        if "-i" in arguments:
            self.environment["LEXICAN_BUS"] = arguments[arguments.index("-i") + 1]
        else:
            arguments = ["-i", "slcan-pty", *arguments]
        with log.open("w") as file:
            self.process = subprocess.Popen([self.node, "--serve", *arguments], stdout=file, stderr=subprocess.STDOUT,
                                            env=self.environment, cwd=self.directory)
        end = time.monotonic() + MOST_SECONDS
        while not (found := re.search(r"at (/dev/pts/\d+)\n|hub:[\w@]+\n", log.read_text())):
            if self.process.poll() is not None or time.monotonic() > end:
                raise RuntimeError(f"the node does not start: {log.read_text()}")
            time.sleep(0.02)
        self.device.unlink(missing_ok=True)
        if found[1]:
            self.device.symlink_to(found[1])

    def stop_node(self):
        if self.process:
            self.process.terminate()
            self.process.wait()
            self.process = None

    def start_simulation(self, words):
        former = self.simulations.pop(tuple(words), None)
        if former:
            former.communicate("quit\n")
        process = subprocess.Popen([self.lexican, *words], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                   stderr=subprocess.DEVNULL, env=self.environment, cwd=self.directory, text=True,
                                   bufsize=1)
        self.simulations[tuple(words)] = process
        if not process.stdout.readline().startswith("node "):
            raise RuntimeError(f"it does not start: {shlex.join(words)}")

    def type_into_simulation(self, command):
        """Types a command into the simulation that was started last."""
        list(self.simulations.values())[-1].stdin.write(command + "\n")
        time.sleep(TYPING_SECONDS)

    def stop_simulations(self):
        for process in self.simulations.values():
            process.communicate("quit\n")
        self.simulations = {}

    def start(self, words):
        words = [word.replace(DEVICE, str(self.device)) for word in words]
        return Terminal([self.lexican, *words[1:]], self.environment, self.directory)

    def run(self, words, lines=0):
        """Runs a command; one that does not end is interrupted after some lines. Returns its output and status."""
        terminal = self.start(words)
        if is_endless(words):
            end = time.monotonic() + LISTENING_SECONDS
            while terminal.read(0.1) and terminal.shown.count("\n") < lines and time.monotonic() < end:
                pass
            time.sleep(HEARTBEAT_SECONDS)  # a second frame: there is no bus load of one
            os.kill(terminal.pid, signal.SIGINT)
        status = terminal.end()
        return terminal.shown.replace(str(self.device), DEVICE), status

    def prepare(self, command):
        words = shlex.split(command)
        if words[0] == "node":
            self.start_node(words[1:])
        elif words[0] == "sim":
            self.start_simulation(words)
        elif words[0] == "wait":
            time.sleep(float(words[1]))
        else:
            self.run(words)


def run_block(bench, name, text, recorded):
    """Runs each command of a block, and compares its output. Adds the logs that they record to recorded."""
    for prompt, command, expected in re.findall(r"^(\$|sim>) (.*)\n((?:(?!\$ |sim> ).*\n)*)", text, re.MULTILINE):
        if prompt == "sim>":
            bench.type_into_simulation(command)
            continue
        words = shlex.split(command)
        if words[0] == "export":
            variable, value = words[1].split("=", 1)
            bench.environment[variable] = value.replace(DEVICE, str(bench.device))
            continue
        shown, status = bench.run(words, expected.split("\n\n")[0].rstrip("\n").count("\n") + 1)
        if "--log" in words:
            recorded.add(words[words.index("--log") + 1])
        same = comparable(words, shown, recorded) == comparable(words, expected, recorded)
        bench.report(f"{name}: {command}", "" if same else "it shows")
        if not same:
            print(f"# status {status}\n{shown}\n# and not\n{expected}", flush=True)
            if bench.process and bench.process.poll() is not None:
                print(f"# the node has ended: {bench.process.poll()}", (bench.directory / "node.log").read_text())


def run_page(bench, page):
    """Returns the number of blocks that were run."""
    bench.environment.pop("LEXICAN_BUS", None)
    bench.start_node(NODE_ARGUMENTS)
    recorded = set()
    blocks = 0
    for block in BLOCK.finditer(page.read_text()):
        comments = COMMENT.findall(block["comments"])
        if any(kind == "not run" for kind, _ in comments):
            blocks += 1
            continue
        if not block["text"].startswith(("$ ", "sim> ")):
            continue
        for _, command in comments:
            bench.prepare(command)
        run_block(bench, page.name, block["text"], recorded)
        blocks += 1
    bench.stop_simulations()
    return blocks


def run_help(bench, verb):
    """Runs the examples of the help of a verb with the bus of the node, which has node-ID 5."""
    shown, _ = bench.run(["lexican", verb, "--help"])
    examples = shown.partition("Examples:\n")[2].splitlines()
    bench.report(f"{verb} --help has examples", "" if examples else "none")
    for example in examples:
        words = shlex.split(example)
        if "-i" in words:
            words[words.index("-i") + 1] = BUS
        shown, status = bench.run(words, 1)
        bench.report(f"{verb} --help: {example.strip()}", "" if status != WRONG_USE else f"wrong use: {shown}")


def copy_a_device(bench):
    """Dumps a device, changes it, applies and stores the dump, and dumps it again after a loss of power."""
    def run(command):
        shown, status = bench.run(["lexican", *shlex.split(command), "-i", BUS, "--yes"])
        bench.report(f"a copy: {command}", "" if status == 0 else f"status {status}: {shown}")

    node = ["--node-id", "5", "--storage", "copy.nvm"]
    bench.start_node(node)
    run("write 5 2101 -30 --type i16")
    run("dump 5 -o first/copy.dcf --eds clock.eds")
    run("write 5 2101 60 --type i16")
    run("write 5 1017 500")
    run("apply first/copy.dcf --store")
    bench.start_node(node)
    run("dump 5 -o second/copy.dcf --eds clock.eds")
    first, second = ((bench.directory / name / "copy.dcf").read_bytes() for name in ("first", "second"))
    bench.report("a copy: the dump after a loss of power is equal", "" if first == second else "it differs")


def copy_files(directory):
    """Copies the files that the pages and the helps name."""
    description = ROOT / "demo/clock/generated/clock.eds"
    shutil.copy(description, directory)
    for name in ("fault.pcapng", "heartbeat.log", "servo.eds", "module.eds"):
        shutil.copy(ROOT / "tools/lexican/tests/fixtures" / name, directory)
    (directory / "fault.log").write_text("(0.000000) can0 705#7F\n")
    (directory / "firmware.bin").write_bytes(bytes(100))
    text = re.sub("(Low|High)Limit=.*", "", description.read_text())
    for old, new in ("Time zone", "Profile velocity"), ("Picture", "Velocity actual value"):
        text = text.replace(f"ParameterName={old}", f"ParameterName={new}")
    for name in "descriptions", "first", "second":
        (directory / name).mkdir()
    for name in "drive.eds", "descriptions/drive.eds":
        (directory / name).write_text(text)


def main():
    with tempfile.TemporaryDirectory() as directory:
        bench = Bench(sys.argv[1], sys.argv[2], Path(directory))
        copy_files(bench.directory)
        try:
            for page in PAGES:
                blocks = run_page(bench, page)
                bench.report(f"{page.name} has examples", "" if blocks else "none")
            copy_a_device(bench)
            bench.start_node(["--node-id", "5"])
            bench.prepare(f"lexican dump 5 -o drive5.dcf --eds drive.eds -i {BUS}")
            for verb in (page.stem for page in PAGES if (ROOT / f"tools/lexican/src/program/{page.stem}.cpp").exists()):
                run_help(bench, verb)
        finally:
            bench.stop_simulations()
            bench.stop_node()
        print(f"1..{bench.cases}")
    sys.exit(0 if bench.good else 1)


if __name__ == "__main__":
    main()
