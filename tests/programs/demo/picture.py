#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""picture.py SVG PNG

Checks that Chromium draws the picture of lexican-plot: without an error, with its curve as wide as the axes and not
higher, with a line for the trigger within them, and with its title. Writes what it has drawn to a PNG file.
"""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "lanes"))
from browser import Browser  # noqa: E402

# Position and size of an element in the coordinates of the picture.
BOX = """(() => {
  const unit = document.documentElement.getScreenCTM(), box = document.getElementById('%s').getBoundingClientRect();
  return [(box.left - unit.e) / unit.a, (box.top - unit.f) / unit.d, box.width / unit.a, box.height / unit.d];
})()"""


def main():
    picture = pathlib.Path(sys.argv[1]).resolve()
    with Browser() as browser:
        page = browser.open(picture.as_uri(), width=800)
        axes = page.evaluate(BOX % "axes")
        curve = page.evaluate(BOX % "curve")
        trigger = page.evaluate(BOX % "trigger")
        title = page.evaluate("document.title")
        errors = page.errors + page.evaluate("Array.from(document.querySelectorAll('parsererror'), e => e.textContent)")
        page.save_picture(sys.argv[2])
    print(f"title {title!r}, axes {axes}, curve {curve}, trigger {trigger}")
    for error in errors:
        print(error)
    # The stroke of a curve is outside of its values.
    fits = abs(axes[0] - curve[0]) < 4 and abs(axes[2] - curve[2]) < 4 and all(
        inner[at] > axes[at] - 4 and inner[at] + inner[at + 2] < axes[at] + axes[at + 2] + 4
        for inner in (curve, trigger) for at in (0, 1))
    return 0 if not errors and title == "speed" and fits else 1


if __name__ == "__main__":
    sys.exit(main())
