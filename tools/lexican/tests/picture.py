#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""picture.py LEXICAN NODE [PICTURES]

Tests the pages of `lexican mon --html` in Chromium. Writes pictures of them to the directory PICTURES. Prints TAP.
"""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tests/lanes"))
from browser import Browser  # noqa: E402

EVIL = "</script><img src=x onerror=alert(1)>"
CAUSES = [
    {"title": "Value is out of range", "text": f"The master writes 100 {EVIL}", "check": "the range of 2101h",
     "fix": "write at most 60", "node": 1, "since": 3.4, "until": 3.8, "times": [3.576]},
    {"title": "Object is read-only", "text": "A write to 1000h", "check": "", "fix": "", "node": 1, "since": 3.692,
     "until": 3.692, "times": [3.692]},
]
PIXELS_BEYOND = "document.documentElement.scrollWidth - document.documentElement.clientWidth"
ROWS = "Array.from(document.querySelectorAll('.row'), row => row.lastChild.textContent)"
RANGE = "document.getElementById('range').textContent"
CHOSEN = "document.querySelector('.row[aria-selected=true] .x')?.textContent ?? ''"
SMALL = """Array.from(document.querySelectorAll('button, input, select'))
  .filter(item => item.checkVisibility() && item.getBoundingClientRect().height < %d)
  .map(item => item.id || item.textContent)"""
# The contrast of all texts that are not in a canvas, at least 4.5.
PALE = """(() => {
  const parts = colour => colour.match(/[\\d.]+/g).map(Number);
  const light = ([r, g, b]) => [r, g, b].map(c => c / 255).map(c => c <= .04 ? c / 12.92 : ((c + .055) / 1.055) ** 2.4)
    .reduce((sum, c, n) => sum + c * [.2126, .7152, .0722][n], 0);
  const back = element => {
    const colour = parts(getComputedStyle(element).backgroundColor);
    return colour.length === 4 && colour[3] === 0 ? back(element.parentElement) : colour;
  };
  const faults = [];
  for (const element of document.querySelectorAll('body *')) {
    if (!Array.from(element.childNodes).some(node => node.nodeType === 3 && node.data.trim())) continue;
    if (!element.checkVisibility() || ['SCRIPT', 'OPTION'].includes(element.nodeName)) continue;
    const [a, b] = [light(parts(getComputedStyle(element).color)), light(back(element))].sort((x, y) => x - y);
    if ((b + .05) / (a + .05) < 4.5) faults.push(`${element.textContent}: ${((b + .05) / (a + .05)).toFixed(2)}`);
  }
  return faults;
})()"""


class Pages:
    def __init__(self, browser, lexican, directory, pictures):
        self.browser, self.lexican, self.directory, self.pictures = browser, lexican, directory, pictures
        self.number = 0
        self.good = True

    def report(self, what, wanted, found):
        self.number += 1
        if wanted == found:
            print(f"ok {self.number} - {what}", flush=True)
        else:
            self.good = False
            print(f"not ok {self.number} - {what}: {found}, not {wanted}", flush=True)

    def make(self, name, log, *options):
        """Writes the page of a log."""
        page = self.directory / f"{name}.html"
        subprocess.run([self.lexican, "mon", log, "--html", page, *options], check=True, stdout=subprocess.DEVNULL)
        return page

    def open(self, page, width):
        return self.browser.open(page.as_uri(), width)

    def settle(self, page, script=""):
        page.evaluate(script)
        page.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")

    def key(self, page, key):
        self.browser.call("Input.dispatchKeyEvent", type="keyDown", key=key, **({"text": key} if len(key) == 1 else {}))
        self.browser.call("Input.dispatchKeyEvent", type="keyUp", key=key)
        self.settle(page)

    def mouse(self, kind, x, y, **more):
        self.browser.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, **more)

    def click(self, page, x, y):
        for kind in "mousePressed", "mouseReleased":
            self.mouse(kind, x, y, button="left", clickCount=1)
        self.settle(page)

    def save(self, page, name):
        if self.pictures:
            page.save_picture(self.pictures / f"{name}-{page.width}.png")


def box(page, selector):
    return page.evaluate(f"(() => {{ const b = document.querySelector('{selector}').getBoundingClientRect();"
                         "return [b.left, b.top, b.width, b.height]; })()")


def test_messages(pages, page):
    pages.report("all messages are shown", 11, len(page.evaluate(ROWS)))
    pages.report("faults are marked", 2, page.evaluate("document.querySelectorAll('.row.fault').length"))
    pages.settle(page, "const search = document.getElementById('search'); search.value = 'Refused';"
                       "search.oninput();")
    pages.report("a filter reduces the rows", 2, len(page.evaluate(ROWS)))
    pages.report("and says so", "2 of 11 messages", page.evaluate("document.getElementById('count').textContent"))
    pages.settle(page, "search.value = ''; search.oninput();")
    pages.settle(page, "document.querySelector('#services button:nth-child(3)').click()")
    pages.report("so does a service", ["TPDO1 Time, Hour = 0, Time, Minute = 0, Time, Second = " + second
                                       for second in ("29", "30", "31")], page.evaluate(ROWS))
    pages.settle(page, "document.querySelector('#services button:nth-child(3)').click()")


def test_axis(pages, page):
    pages.settle(page, "document.getElementById('all').click()")
    whole = page.evaluate(RANGE)
    pages.report("the axis shows all", "0.000 to 6.000 s  (6.000 s)", whole)
    left, top, width, height = box(page, "#ruler")
    pages.mouse("mouseWheel", left + width / 2, top + height / 2, deltaX=0, deltaY=-300)
    pages.settle(page)
    zoomed = page.evaluate(RANGE)
    pages.report("the wheel zooms", True, zoomed != whole)
    pages.mouse("mousePressed", left + width / 2, top + height / 2, button="left", clickCount=1)
    pages.mouse("mouseMoved", left + width / 2 - 200, top + height / 2, button="left", buttons=1)
    pages.mouse("mouseReleased", left + width / 2 - 200, top + height / 2, button="left", clickCount=1)
    pages.settle(page)
    pages.report("dragging moves", True, page.evaluate(RANGE) not in (whole, zoomed))
    page.evaluate("document.getElementById('timeline').focus()")
    pages.key(page, "0")
    pages.report("the key 0 shows all", whole, page.evaluate(RANGE))
    pages.key(page, "+")
    pages.report("the key + zooms", True, page.evaluate(RANGE) != whole)
    pages.key(page, "0")


def test_touch(pages, page):
    """Two fingers move apart."""
    whole = page.evaluate(RANGE)
    left, top, width, _ = box(page, "#ruler")

    def touch(kind, *xs):
        pages.browser.call("Input.dispatchTouchEvent", type=kind,
                           touchPoints=[{"x": left + x * width, "y": top + 20, "id": n} for n, x in enumerate(xs)])
    touch("touchStart", .5, .6)
    touch("touchMove", .4, .7)
    touch("touchMove", .3, .8)
    touch("touchEnd")
    pages.settle(page)
    pages.report("two fingers zoom", True, page.evaluate(RANGE) != whole)
    pages.settle(page, "show_all()")


def test_selection(pages, page):
    pages.settle(page, "document.querySelectorAll('.row')[6].click()")
    pages.report("a click selects a message", "write 2101h Time zone refused: 0609 0031h value too high  0.5 ms",
                 page.evaluate(CHOSEN))
    pages.report("which the time axis marks", 3576500, round(page.evaluate("mark")))
    page.evaluate("document.getElementById('rows').focus()")
    pages.key(page, "ArrowDown")
    pages.report("the arrow keys select the next one", True, page.evaluate(CHOSEN).startswith("write 1000h"))
    left, top, *_ = box(page, "#nodes")
    pages.click(page, left + page.evaluate("x_of(document.getElementById('nodes'), 1616000)"), top + 10)
    pages.report("a click on the time axis selects a message", "NMT start, node 1", page.evaluate(CHOSEN))


def test_causes(pages, page):
    items = page.evaluate("Array.from(document.querySelectorAll('#causes li'), item => item.textContent)")
    pages.report("the causes are listed", [True, True], [cause["title"] in item for cause, item in zip(CAUSES, items)])
    pages.report("a text of the bus is shown as text", (True, 0),
                 (EVIL in items[0], page.evaluate("document.images.length")))
    pages.settle(page, "document.querySelector('#causes .go').click()")
    pages.report("a click on a cause leads there", (True, 3576000),
                 (page.evaluate("view.from < 3.4e6 && view.to > 3.8e6 && view.to - view.from < 2e6"), page.evaluate("mark")))


def test_values(pages, page):
    plots = "document.querySelectorAll('.plot').length"
    pages.report("the value that changes is drawn", 1, page.evaluate(plots))
    pages.settle(page, "document.querySelector('#series button').click()")
    pages.report("a click draws another one", 2, page.evaluate(plots))
    pages.settle(page, "document.querySelector('#series button').click()")
    pages.report("and removes it", 1, page.evaluate(plots))


def test_log(pages, description):
    page_file = pages.make("fault", ROOT / "tools/lexican/tests/fixtures/fault.pcapng", "--eds", description)
    text = page_file.read_text()
    causes = json.dumps(CAUSES).replace("<", "\\u003c")
    page_file.write_text(text.replace('"causes":[]', f'"causes":{causes}'))
    for scheme in "light", "dark":
        pages.browser.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
        page = pages.open(page_file, 1280)
        pages.report(f"{scheme}: all texts can be read", [], page.evaluate(PALE))
        pages.save(page, f"fault-{scheme}")
    test_messages(pages, page)
    test_axis(pages, page)
    test_selection(pages, page)
    test_values(pages, page)
    test_causes(pages, page)
    for width, least in (1280, 30), (400, 44):
        page.resize(width)
        pages.settle(page)
        pages.report(f"at {width} pixels, nothing has to be scrolled sideways", 0, page.evaluate(PIXELS_BEYOND))
        pages.report(f"at {width} pixels, targets are large enough", [], [
            item for item in page.evaluate(SMALL % least) if not item[:1].isdigit()])
        pages.save(page, "fault")
    test_touch(pages, page)
    pages.report("no error of the script", [], page.errors)


def test_long_log(pages):
    """More messages than a page has."""
    log = pages.directory / "long.log"
    with log.open("w") as file:
        for n in range(100_010):
            file.write(f"({n / 1000:.6f}) can0 {0x181 + n % 3:03X}#{n % 256:02X}\n")
    page = pages.open(pages.make("long", log), 1280)
    pages.report("the page of a long log says what it leaves out", True, page.evaluate(
        "document.getElementById('notice').textContent.includes('leaves out 10 messages')"))
    for width, height in (1280, 800), (1280, 500), (700, 800), (400, 800):
        page.resize(width, height)
        pages.settle(page)
        rows = page.evaluate("document.querySelectorAll('.row').length")
        pages.report(f"and has few rows at {width} x {height} pixels", True, 0 < rows < 60)
    pages.settle(page, "document.getElementById('rows').focus()")
    pages.key(page, "End")
    pages.report("the last one can be reached", True, page.evaluate(CHOSEN).startswith("TPDO1"))
    took = page.evaluate("(() => { const begin = performance.now(); for (let n = 0; n < 10; ++n) draw_now();"
                         "return (performance.now() - begin) / 10; })()")
    print(f"# a picture takes {took:.1f} ms")
    pages.report("no error of its script", [], page.errors)


def test_recorder(pages):
    csv = pages.directory / "speed.csv"
    csv.write_text("# name: <speed>\n# object: 2110h:00\n# colour: C00000\n# trigger: 5\n0;10\n5;30\n12;20\n")
    page_file = pages.make("speed", csv)
    for width in 1280, 400:
        page = pages.open(page_file, width)
        pages.report(f"at {width} pixels, a recorder's curve is drawn", (0, 1, "<speed>", []), (
            page.evaluate(PIXELS_BEYOND), page.evaluate("document.querySelectorAll('.plot').length"),
            page.evaluate("document.querySelector('h1').textContent"), page.errors))
        pages.save(page, "speed")


def main():
    pictures = Path(sys.argv[3]) if len(sys.argv) > 3 else None
    with tempfile.TemporaryDirectory() as directory, Browser() as browser:
        pages = Pages(browser, sys.argv[1], Path(directory), pictures)
        description = pages.directory / "clock.eds"
        text = (ROOT / "demo/clock/generated/clock.eds").read_text()
        description.write_text(text)
        test_log(pages, description)
        test_recorder(pages)
        # A name of an object that would be a script.
        evil = pages.directory / "evil.eds"
        evil.write_text(text.replace("ParameterName=Time zone", f"ParameterName={EVIL}"))
        page = pages.open(pages.make("evil", ROOT / "tools/lexican/tests/fixtures/fault.pcapng", "--eds", evil), 400)
        pages.report("a name of a description is shown as text", (True, 0, []), (
            any(EVIL in row for row in page.evaluate(ROWS)), page.evaluate("document.images.length"), page.errors))
        test_long_log(pages)
        print(f"1..{pages.number}")
    sys.exit(0 if pages.good else 1)


if __name__ == "__main__":
    main()
