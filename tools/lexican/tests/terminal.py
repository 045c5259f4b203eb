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
        environment["PATH"] = f"{bench.directory}:{environment['PATH']}"
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
    for name, command in ("write", f"write 1 2200 --file picture {BUS}"), ("read", f"read 1 2200 -o back {BUS}"):
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
    for name, command in ("write", f"write 1 2200 --file picture {BUS}"), ("read", f"read 1 2200 -o half {BUS}"):
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
    shown, status = screen.run(f"lexican read 1 1008 {BUS}")
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


def main():
    with tempfile.TemporaryDirectory() as directory:
        bench = Bench(sys.argv[1], sys.argv[2], Path(directory))
        copy_files(bench.directory)
        (bench.directory / "lexican").symlink_to(Path(bench.lexican).resolve())
        bench.start_node([*NODE_ARGUMENTS, "--quiet"])
        screen = Screen(bench)
        try:
            for test in test_progress, test_interruption, test_monitor, test_question:
                test(bench, screen)
        finally:
            screen.tmux("kill-server")
            bench.stop_node()
        print(f"1..{bench.cases}")
    sys.exit(0 if bench.good else 1)


if __name__ == "__main__":
    main()
