#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""page_test.py CODICT FIXTURES

Tests the HTML page of `codict doc` in Chromium. Prints TAP.
"""
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "tests/lanes"))
from browser import Browser  # noqa: E402

SHOWN_OBJECTS = "document.querySelectorAll('section.object:not([hidden])').length"
BOXES = "document.querySelectorAll('g.part').length"
PIXELS_BEYOND = "document.documentElement.scrollWidth - document.documentElement.clientWidth"
TWO_LINES = """Array.from(document.querySelectorAll('td, p'), cell => cell.innerText)
  .filter(text => text.includes('What it is,\\nin two lines.')).length"""


class Pages:
    """Pages of descriptions in a browser, and the number of cases."""

    def __init__(self, browser, codict, directory):
        self.browser = browser
        self.codict = codict
        self.directory = directory
        self.number = 0
        self.good = True

    def run_codict(self, *arguments):
        subprocess.run([self.codict, *map(str, arguments)], check=True, stdout=subprocess.DEVNULL)

    def make(self, name, description):
        self.run_codict("doc", description, "-o", self.directory / f"{name}.html")

    def open(self, name, search="", width=1200):
        query = f"?q={search}" if search else ""
        return self.browser.open(f"file://{self.directory}/{name}.html{query}", width)

    def report(self, what, wanted, found):
        self.number += 1
        if wanted == found:
            print(f"ok {self.number} - {what}")
        else:
            self.good = False
            print(f"not ok {self.number} - {what}: {found}, not {wanted}")


def test_search(pages):
    page = pages.open("drive")
    pages.report("all objects are shown", 11, page.evaluate(SHOWN_OBJECTS))
    pages.report("no error of the script", [], page.errors)
    # A box for each byte: 8 + 16 bits of the RPDO, 32 + 8 of the TPDO.
    pages.report("the pictures of the PDOs have their boxes", 8, page.evaluate(BOXES))
    page = pages.open("drive", "wanted")
    pages.report("a search finds an object by its name", 1, page.evaluate(SHOWN_OBJECTS))
    pages.report("and says so", True, page.evaluate("document.body.innerText.includes('1 of 11 objects')"))
    page = pages.open("drive", "encoder")
    pages.report("a search finds a sub-object", 1, page.evaluate(SHOWN_OBJECTS))
    pages.report("and hides the others of its object", True, page.evaluate("document.getElementById('o-2001-0').hidden"))
    page = pages.open("drive", "nowhere")
    pages.report("a search finds nothing where nothing is", 0, page.evaluate(SHOWN_OBJECTS))
    page = pages.open("broken")
    pages.report("an error of the script would be noticed", 1, len(page.errors))


def test_widths(pages):
    page = pages.open("drive", width=400)
    pages.report("at 400 pixels, nothing has to be scrolled sideways", 0, page.evaluate(PIXELS_BEYOND))
    page.resize(1200)
    pages.report("nor at 1200 pixels", 0, page.evaluate(PIXELS_BEYOND))
    page = pages.open("long", width=400)
    pages.report("at 400 pixels, long words are broken", 0, page.evaluate(PIXELS_BEYOND))
    page = pages.open("lines")
    pages.report("line breaks of a description are shown", 1, page.evaluate(TWO_LINES))
    page.resize(400)
    pages.report("and the page of an XDD has no sideways scrolling", 0, page.evaluate(PIXELS_BEYOND))


def main():
    codict, fixtures = sys.argv[1], Path(sys.argv[2])
    with tempfile.TemporaryDirectory() as directory, Browser() as browser:
        pages = Pages(browser, codict, Path(directory))
        pages.make("drive", fixtures / "drive.eds")
        pages.make("lines", fixtures / "xdd/device10.xdd")
        text = (pages.directory / "drive.html").read_text()
        (pages.directory / "broken.html").write_text(text.replace("\nshow();\n", "\nnonsense();\n"))
        # A name without blanks, as long as an EDS permits.
        long = pages.directory / "long.eds"
        pages.run_codict("set", fixtures / "drive.eds", "0x2000", f"name={'x' * 240}", "-o", long)
        pages.make("long", long)
        print("1..14")
        test_search(pages)
        test_widths(pages)
    sys.exit(0 if pages.good else 1)


if __name__ == "__main__":
    main()
