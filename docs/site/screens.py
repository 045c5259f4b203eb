#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""screens.py PICTURES [CODICT]

Runs programs as on a terminal and writes their output, with its colours, to the directory PICTURES: screen_demo.svg
without CODICT; with this program screen_check.svg, and screen_doc.png, which Chromium draws.
"""
import base64
import os
import pty
import re
import subprocess
import sys
import tempfile
from html import escape
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/lanes"))
from browser import Browser  # noqa: E402

TEXT = "#d4d4d4"
COLOURS = {"1": "#ffffff", "32": "#7ec97e", "1;31": "#ff7b72", "33": "#e2c069", "1;35": "#d99ee8", "36": "#6cc7d6",
           "90": "#9a9a9a"}
WIDTH, HEIGHT = 7, 17  # pixels of a character

# Changes of the demo's description that make it faulty: a section, and what sed does in it.
FAULTS = (("DeviceInfo", "s/^NrOfRXPDO=1/NrOfRXPDO=2/"), ("1A00sub3", "s/^DefaultValue=.*/DefaultValue=0x21000408/"),
          ("2100sub1", "s/^DefaultValue=.*/DefaultValue=24/"), ("2101", "s/^AccessType=.*/AccessType=read/"))


def output_of(*command, directory=ROOT):
    """The lines that a command writes to a terminal."""
    ours, theirs = pty.openpty()
    process = subprocess.Popen(command, cwd=directory, stdin=theirs, stdout=theirs, stderr=subprocess.DEVNULL)
    os.close(theirs)
    text = b""
    try:
        while part := os.read(ours, 65536):
            text += part
    except OSError:  # the end of the output
        pass
    os.close(ours)
    process.wait()
    return text.decode().replace("\r", "").splitlines()


def line_of_svg(line, y):
    """A text element for each part of the line without colours and double spaces, which SVG does not preserve."""
    texts = []
    x, colour = 12, TEXT
    for part in re.split(r"(\033\[[\d;]*m)", line):
        if part.startswith("\033"):
            colour = COLOURS.get(part[2:-1], TEXT)
            continue
        for words in re.finditer(r"\S+( \S+)*", part):
            place = f'x="{x + WIDTH * words.start()}" y="{y}" textLength="{WIDTH * len(words[0])}"'
            texts.append(f'<text {place} fill="{colour}">{escape(words[0])}</text>')
        x += WIDTH * len(part)
    return "".join(texts)


def write_svg(file, command, lines):
    lines = [f"\033[1m$ {command}\033[0m", *lines]
    width = 24 + WIDTH * max(len(re.sub(r"\033\[[\d;]*m", "", line)) for line in lines)
    height = 20 + HEIGHT * len(lines)
    rows = [line_of_svg(line, 22 + HEIGHT * number) for number, line in enumerate(lines)]
    file.write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}" '
        'font-family="monospace" font-size="11.6">\n'
        "  <!-- SPDX-License-Identifier: Apache-2.0; written by docs/site/screens.py -->\n"
        f'  <rect width="{width}" height="{height}" rx="6" fill="#1e1e1e"/>\n'
        + "".join(f"  {row}\n" for row in rows if row) + "</svg>\n", encoding="utf-8")


def draw_demo(pictures):
    lines = output_of("demo/run", "--virtual")
    first, last = (next(n for n, line in enumerate(lines) if step in line) for step in (" 2. ", " 4. "))
    head = [line for line in lines if "time/s" in line]
    shown = [*head, "", *lines[first:last], "\033[90m    …\033[0m", lines[-1]]
    write_svg(pictures / "screen_demo.svg", "demo/run", shown)


def draw_check(codict, pictures, directory):
    sed = [option for section, change in FAULTS for option in ("-e", rf"/^\[{section}\]/,/^PDOMapping/{change}")]
    with open(directory / "clock.eds", "wb") as faulty:
        subprocess.run(["sed", *sed, ROOT / "demo/clock/generated/clock.eds"], stdout=faulty, check=True)
    lines = output_of(codict, "check", "clock.eds", directory=directory)
    write_svg(pictures / "screen_check.svg", "codict check clock.eds", lines)


def draw_doc(codict, pictures, directory):
    page_file = directory / "clock.html"
    subprocess.run([codict, "doc", ROOT / "demo/clock/generated/clock.eds", "-o", page_file], check=True)
    with Browser() as browser:
        page = browser.open(page_file.as_uri(), 760)
        tops = "Array.from(document.querySelectorAll('h2'), h => h.getBoundingClientRect().top)"
        _, _, top, _, bottom, *_ = page.evaluate(tops)
        clip = {"x": 0, "y": top - 10, "width": 760, "height": bottom - top, "scale": 1}
        answer = browser.call("Page.captureScreenshot", format="png", clip=clip, captureBeyondViewport=True)
    (pictures / "screen_doc.png").write_bytes(base64.b64decode(answer["data"]))


def main():
    pictures = Path(sys.argv[1])
    if len(sys.argv) == 2:
        draw_demo(pictures)
    else:
        codict = Path(sys.argv[2]).resolve()
        with tempfile.TemporaryDirectory() as directory:
            draw_check(codict, pictures, Path(directory))
            draw_doc(codict, pictures, Path(directory))


if __name__ == "__main__":
    main()
