#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""terminal.py LEXICAN NODE

Tests in tmux what only a terminal shows: progress lines, colours, questions and Ctrl-C. Prints TAP.
"""
import re
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from pages import NODE_ARGUMENTS, Bench, copy_files

BUS = "-i slcan:ttyACM0@500k"
SLOW_BUS = "-i hub:slow"  # on which a transfer takes long enough to be seen
SLOW_NODE = [*NODE_ARGUMENTS, "--quiet", "-i", "hub:slow@500k"]
MOST_SECONDS = 30
MOST_TRIES = 5  # to stop the node before a transfer has ended
PICTURE_BYTES = 73728  # of 2200h
RED = re.compile("\x1b\\[31m(.*?)\x1b\\[39m", re.DOTALL)
BAR = re.compile(r"^\[[#.]{30}\] +(\d+) %  \d+ of 73728 bytes", re.MULTILINE)
PROMPT = re.compile(r"^status (\d+) >$")


class Screen:
    """A shell in tmux, with 80 columns and 24 lines. Its prompt shows the status of the last command."""

    def __init__(self, bench):
        self.socket = str(bench.directory / "tmux")
        environment = {**bench.environment, "PS1": "status $? > "}
        environment["PATH"] = f"{bench.directory}/bin:{environment['PATH']}"
        del environment["NO_COLOR"]
        words = ["env", "-i", "TERM=screen", *(f"{name}={value}" for name, value in environment.items()), "sh"]
        self.tmux("-f", "/dev/null", "new-session", "-d", "-x", "80", "-y", "24", "-c", str(bench.directory), *words)

    def tmux(self, *words):
        return subprocess.run(["tmux", "-S", self.socket, *words], check=True, capture_output=True, text=True).stdout

    def text(self, *options):
        return self.tmux("capture-pane", "-p", *options).rstrip()

    def wait(self, is_reached):
        """Waits until the text of the screen has a property; returns the text, after some time in any case."""
        end = time.monotonic() + MOST_SECONDS
        while not is_reached(text := self.text()) and time.monotonic() < end:
            time.sleep(0.01)
        return text

    def start(self, command):
        """Types a command on an empty screen."""
        self.tmux("send-keys", "-R", "clear", "Enter")
        self.wait(lambda text: text == "status 0 >")
        self.tmux("send-keys", "-l", command)
        self.wait(lambda text: command in text.replace("\n", ""))
        self.tmux("send-keys", "Enter")

    def end(self):
        """Waits for the end of the command. Returns what it has shown, and its status."""
        text = self.wait(lambda text: text.count("\n") > 0 and PROMPT.match(text.splitlines()[-1]))
        lines = text.splitlines()
        return "\n".join(lines[1:-1]), PROMPT.match(lines[-1])[1] if PROMPT.match(lines[-1]) else "none"

    def run(self, command):
        self.start(command)
        return self.end()

    def answer(self, command, *keys):
        """Runs a command that asks a question, and types these keys as the answer."""
        self.start(command)
        self.wait(lambda text: text.endswith("[y/N]"))
        self.tmux("send-keys", *keys)
        return self.end()


def expect(bench, name, is_good, shown):
    bench.report(name, "" if is_good else f"it shows {shown!r}")


def test_progress(bench, screen):
    (bench.directory / "picture").write_bytes(bytes(range(256)) * (PICTURE_BYTES // 256))
    for name, command in ("write", f"write 1 2200 --file picture {SLOW_BUS}"), ("read", f"read 1 2200 -o back {SLOW_BUS}"):
        screen.start(f"lexican {command}")
        text = screen.wait(BAR.search)
        expect(bench, f"{name} shows its progress", BAR.search(text), text)
        shown, status = screen.end()
        bars = BAR.findall(shown)
        expect(bench, f"{name}: at its end no part of a bar remains", status == "0" and bars in ([], ["100"]), shown)
    same = (bench.directory / "back").read_bytes() == (bench.directory / "picture").read_bytes()
    bench.report("the file that was read is the one that was written", "" if same else "it is not")


def test_interruption(bench, screen):
    """The node is stopped when the transfer has begun, so that this does not end before Ctrl-C is typed."""
    settings = screen.run("stty -g")
    for name, command in ("write", f"write 1 2200 --file picture {SLOW_BUS}"), ("read", f"read 1 2200 -o half {SLOW_BUS}"):
        status = "0"
        for _ in range(MOST_TRIES):
            if status != "0":
                break
            screen.start(f"lexican {command} --timeout 60000")
            screen.wait(BAR.search)
            bench.process.send_signal(signal.SIGSTOP)
            screen.tmux("send-keys", "C-c")
            shown, status = screen.end()
            bench.process.send_signal(signal.SIGCONT)
        expect(bench, f"Ctrl-C ends {name} with status 130", status == "130", (status, shown))
        expect(bench, f"{name}: the prompt begins in a new line", len(BAR.findall(shown)) <= 1, shown)
    exists = (bench.directory / "half").exists()
    bench.report("no file remains of a transfer that was interrupted", "it does" if exists else "")
    now = screen.run("stty -g")
    expect(bench, "the settings of the terminal are those before", now == settings, (settings, now))
    shown, status = screen.run(f"lexican read 1 1008 {SLOW_BUS}")
    expect(bench, "the node answers after the interrupted transfers", "Lexican demo clock" in shown, shown)


def test_monitor(bench, screen):
    command = "lexican mon fault.pcapng --service sdo"
    screen.run(command)
    text = screen.text("-e")
    red = "".join(RED.findall(text)).split("    ")
    expect(bench, "mon shows faults in red", len(red) == 3 and all("refused" in line for line in red[1:]), text)
    screen.run(f"NO_COLOR=1 {command}")
    text = screen.text("-e")
    expect(bench, "with NO_COLOR, mon shows no colours", "refused" in text and "\x1b" not in text, text)
    screen.start(f"lexican mon {BUS}")
    screen.wait(lambda text: "heartbeat" in text)
    screen.tmux("send-keys", "C-c")
    shown, status = screen.end()
    expect(bench, "Ctrl-C ends mon with numbers and status 0", status == "0" and " 0 lost" in shown, (status, shown))


def test_question(bench, screen):
    reset = f"lexican nmt reset 1 {BUS}"
    shown, status = screen.answer(reset, "n", "Enter")
    expect(bench, "nmt reset answered n: status 2", status == "2" and "booted" not in shown, (status, shown))
    shown, status = screen.answer(reset, "C-c")
    expect(bench, "nmt reset answered Ctrl-C: status 130", status == "130" and "booted" not in shown, (status, shown))
    shown, status = screen.answer(reset, "y", "Enter")
    expect(bench, "nmt reset answered y", status == "0" and "node 1 has booted" in shown, (status, shown))


class Top:
    """lexican top on a screen."""

    def __init__(self, screen, environment=""):
        self.screen = screen
        screen.start(f"{environment}lexican top {BUS} --eds clock.eds")
        self.wait(r"^   1 \S+ ")

    def wait(self, pattern):
        return self.screen.wait(re.compile(pattern, re.MULTILINE).search)

    def shows(self, bench, name, pattern):
        text = self.wait(pattern)
        expect(bench, f"top {name}", re.search(pattern, text, re.MULTILINE), text)

    def type(self, key, text=""):
        """Types a key, and a text at its prompt."""
        self.screen.tmux("send-keys", "-l", key)
        if text:
            self.wait(r":$")
            self.screen.tmux("send-keys", "-l", text)
            self.screen.tmux("send-keys", "Enter")

    def resize(self, columns, rows):
        self.screen.tmux("resize-window", "-x", str(columns), "-y", str(rows))


def test_top(bench, screen):
    settings = screen.run("stty -g")
    top = Top(screen)
    top.shows(bench, "shows the node", r"^   1 pre-operational +(<1|\d) s   -  +Lexican demo clock$")
    top.shows(bench, "shows the keys", r"^r read  w write  n NMT ")
    top.type("n", "start")
    top.shows(bench, "shows the command of a key", r"^node 1 is operational\nlexican nmt start 1 -i slcan:ttyACM0@500k$")
    top.shows(bench, "shows the state", r"^   1 operational ")
    top.shows(bench, "shows values of PDOs, and their plot", r"^TPDO1 Time, Second +\d+ +\u2800*[\u2801-\u28ff]")
    top.type("r", "2101")
    top.shows(bench, "reads", r"^2101h Time zone = 0 \(i16\)\nlexican read 1 2101 -i slcan:ttyACM0@500k --eds clock.eds$")
    top.type("w", "time zone 60")
    top.shows(bench, "writes", r'^2101h Time zone = 60 \(i16\)\nlexican write 1 "time zone" 60 -i ')
    top.type("w", "1000 5 --force")
    top.shows(bench, "shows a refusal", r"0609 0031h|0601 0002h object is read-only")
    expect(bench, "top shows faults in red", "refused" in "".join(RED.findall(screen.text("-e"))), screen.text("-e"))
    top.type("r", "no such object")
    top.shows(bench, "explains a name that is not known", r"^no object is called 'no such object'")
    top.type("s")
    top.shows(bench, "scans", r"^1 node in \d\.\d s.*\nnode-IDs: 1\nlexican scan -i slcan:ttyACM0@500k$")
    top.type("/", "nmt")
    top.shows(bench, "filters the events", r"^events with 'nmt' *\n +\d+\.\d+   1  NMT start, node 1$\n\n")
    top.type("/")
    top.wait(r"^filter: nmt$")
    screen.tmux("send-keys", "C-u", "Enter")
    top.shows(bench, "removes the filter", r"^events *\n")
    top.type("/", '"')
    top.type("s")
    top.shows(bench, "scans after a quote that is not closed in the filter", r"^events with '\"' *\n(.*\n)*node-IDs: 1\n")
    top.type("/")
    top.wait(r'^filter: "$')
    screen.tmux("send-keys", "C-u", "Enter")
    top.type("n", "start 1 6")
    top.shows(bench, "refuses a second node of an NMT command", r"^give a command and one node-ID, such as start 5$")
    top.type("n", "reset")
    top.shows(bench, "asks before a reset of a physical bus", r"^reset 1 on a physical bus\? \[y/N\]$")
    top.type("n")
    top.shows(bench, "sends no reset without agreement", r"^nothing was sent\nlexican nmt reset 1 ")
    top.type("n", "reset")
    top.wait(r"\[y/N\]$")
    top.type("y")
    top.shows(bench, "sends the reset", r"^node 1 has booted\nlexican nmt reset 1 ")
    top.type("?")
    top.shows(bench, "shows its help", r"^w  write an object: 6081 2000$")
    top.type("x")
    top.resize(40, 10)
    top.type("?")
    screen.tmux("send-keys", "NPage", "NPage", "NPage", "NPage")
    top.shows(bench, "scrolls its help", r"^--type u16 behind an object: its type$")
    screen.tmux("send-keys", "PPage", "PPage", "PPage", "PPage")
    top.shows(bench, "scrolls its help back", r"^Up, Down, PgUp, PgDn  select a node$")
    top.type("x")
    for columns, rows in (40, 10), (20, 5), (1, 1), (132, 50), (80, 24):
        top.resize(columns, rows)
        pattern = r"^   1 \S+" if columns >= 20 else r"^"
        top.shows(bench, f"fits {columns} x {rows}", pattern)
    top.wait(r"^   1 pre-operational")
    time.sleep(1.5)  # a second heartbeat, which shows its period
    bench.process.send_signal(signal.SIGSTOP)
    top.type("r", "2101")
    top.shows(bench, "shows that a transfer runs", r"^runs; Esc cancels it, q quits$")
    screen.tmux("send-keys", "Escape")
    top.shows(bench, "cancels a transfer", r"^interrupted; the transfer was aborted$")
    top.shows(bench, "marks a heartbeat that is overdue", r"^   1 \S+ +\d+ s!")
    top.type("r", "2101")
    top.wait(r"^runs; Esc cancels it, q quits$")
    screen.tmux("send-keys", "-l", "s?n")
    screen.tmux("send-keys", "Escape")
    top.shows(bench, "forgets the keys that were typed while a command ran", r"^interrupted; the [^\n]*\nlexican read ")
    top.type("r", "2101")
    top.wait(r"^runs; Esc cancels it, q quits$")
    top.type("q")
    shown, status = screen.end()
    expect(bench, "q ends top with status 0 while a command runs", status == "0", (status, shown))
    bench.process.send_signal(signal.SIGCONT)
    top = Top(screen)
    top.type("q")
    shown, status = screen.end()
    expect(bench, "q ends top with status 0", status == "0", (status, shown))
    now = screen.run("stty -g")
    expect(bench, "top restores the settings of the terminal", now == settings, (settings, now))
    for keys, status_of in (["C-c"], "130"), (["r", "C-c"], "130"):
        Top(screen)
        screen.tmux("send-keys", *keys)
        shown, status = screen.end()
        expect(bench, f"{' '.join(keys)} ends top with status 130", status == status_of, (status, shown))
    now = screen.run("stty -g")
    expect(bench, "Ctrl-C in top restores the settings of the terminal", now == settings, (settings, now))
    top = Top(screen, "LANG=none_NONE.utf8 ")
    top.type("n", "start")
    top.wait(r"^node 1 is operational$")
    top.shows(bench, "shows plots with a locale that is not installed", r"^TPDO1 Time, Second +\d+ +\u2800*[\u2801-\u28ff]")
    top.type("q")
    screen.end()
    # ncurses does not free the memory of a terminal that it does not know.
    shown, status = screen.run(f"ASAN_OPTIONS=detect_leaks=0 TERM=none lexican top {BUS}")
    expect(bench, "top names a terminal without terminfo entry", status == "2" and "no entry for 'none'" in shown, shown)
    for name in "dumb", "":
        shown, status = screen.run(f"TERM={name} lexican top {BUS}")
        expect(bench, f"top with TERM={name}: status 2", status == "2" and "lexican mon" in shown, (status, shown))
    shown, status = screen.run(f"lexican top {BUS} </dev/null")
    expect(bench, "top without terminal: status 2", status == "2" and "lexican mon" in shown, (status, shown))


def main():
    with tempfile.TemporaryDirectory() as directory:
        bench = Bench(sys.argv[1], sys.argv[2], Path(directory))
        copy_files(bench.directory)
        (bench.directory / "bin").mkdir()
        (bench.directory / "bin/lexican").symlink_to(Path(bench.lexican).resolve())
        screen = Screen(bench)
        try:
            bench.start_node(SLOW_NODE)
            test_progress(bench, screen)
            test_interruption(bench, screen)
            bench.start_node([*NODE_ARGUMENTS, "--quiet"])
            for test in test_monitor, test_question, test_top:
                test(bench, screen)
        finally:
            screen.tmux("kill-server")
            bench.stop_node()
        print(f"1..{bench.cases}")
    sys.exit(0 if bench.good else 1)


if __name__ == "__main__":
    main()
