#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""screenshots.py HTML PICTURES [PAGE...]

Draws the pages of the built site in Chromium, in a window of 1280 pixels and, after a change of its size, of 400, and
writes pictures of them to the directory PICTURES. The pages are all pages of mkdocs, and the pages PAGE of the API
reference. A page is faulty if it cannot be loaded or is empty, if it scrolls sideways as a whole, if contents are cut
off at its right edge, if an image is missing or has no size, or if a script or a request fails. Prints "1..N" and a line
"ok …" or "not ok …", with the faults, for each page and width.
"""
import functools
import http.server
import sys
import threading
from pathlib import Path
from urllib.parse import quote

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests/lanes"))
from browser import Browser  # noqa: E402

WIDTHS = (1280, 400)

# Returns the faults of the page in the window.
FAULTS = """(() => {
  const faults = [];
  const wide = document.scrollingElement.scrollWidth;
  if (document.body.innerText.trim() == '' && document.images.length == 0) faults.push('is empty');
  if (wide > innerWidth) faults.push(`scrolls sideways: its width is ${wide} pixels`);
  for (const image of document.images) {
    const box = image.getBoundingClientRect();
    if (!image.complete || image.naturalWidth == 0) faults.push(`image ${image.src} is not loaded`);
    else if (image.checkVisibility() && (box.width == 0 || box.height == 0)) faults.push(`image ${image.src} has no size`);
  }
  const scrolls = element => ['auto', 'scroll'].includes(getComputedStyle(element).overflowX);
  const is_within = element => !element || element == document.body || (!scrolls(element) && is_within(element.parentElement));
  for (const element of document.querySelectorAll('main *, .contents *, body:not(:has(main, .contents)) *')) {
    const edge = Math.round(element.getBoundingClientRect().right);
    if (edge > innerWidth && element.checkVisibility() && is_within(element.parentElement)) {
      faults.push(`${element.localName} is cut off: it ends at ${edge} pixels: ${element.textContent.trim().slice(0, 40)}`);
      break;
    }
  }
  return faults;
})()"""


class Files(http.server.SimpleHTTPRequestHandler):
    def do_GET(self):
        if self.path == "/favicon.ico":  # Chromium requests it where a page names no icon
            self.answer(b"")
        elif self.path == "/search/search_index.json":  # each page would index all others, which takes most of the time
            self.answer(b'{"config": {"lang": ["en"], "separator": " ", "pipeline": []}, "docs": []}')
        else:
            super().do_GET()

    def answer(self, text):
        self.send_response(200)
        self.end_headers()
        self.wfile.write(text)

    def log_message(self, *_):
        pass


def serve(root):
    """Serves the site; returns its address."""
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Files, directory=root))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    return f"http://127.0.0.1:{server.server_port}/"


def pages_of(root):
    """The pages of mkdocs, relative to the root of the site."""
    return sorted(place for file in root.rglob("*.html") if (place := file.relative_to(root)).parts[0] != "reference")


def draw(browser, url, pictures, name):
    """Returns the faults of a page for each width."""
    faults = {width: [] for width in WIDTHS}
    try:
        page = browser.open(url, WIDTHS[0])
        for width in WIDTHS:
            page.resize(width)
            page.save_picture(pictures / f"{name}-{width}.png")
            faults[width] = page.evaluate(FAULTS) + page.errors
    except OSError as fault:
        faults = {width: [f"cannot be drawn: {fault}"] for width in WIDTHS}
    return faults


def main():
    root, pictures = Path(sys.argv[1]), Path(sys.argv[2])
    pages = pages_of(root) + [Path(page) for page in sys.argv[3:]]
    pictures.mkdir(parents=True, exist_ok=True)
    print(f"1..{len(pages) * len(WIDTHS)}")
    good = bool(pages)
    address = serve(root)
    with Browser() as browser:
        for place in pages:
            name = "-".join(place.with_suffix("").parts)
            for width, faults in draw(browser, address + quote(str(place)), pictures, name).items():
                good = good and not faults
                what = f"{place} at {width} pixels"
                print(f"not ok {what}: {'; '.join(faults)}" if faults else f"ok {what}", flush=True)
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
