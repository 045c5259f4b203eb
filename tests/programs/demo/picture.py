#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""picture.py HTML PNG

Checks that Chromium draws the page of a recorder: without an error, with its curve, the time of the trigger and the
title. Writes a picture of it to a PNG file.
"""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "lanes"))
from browser import Browser  # noqa: E402

CURVE = "document.querySelector('.plot b')?.textContent"
TRIGGER = "document.getElementById('numbers').textContent.includes('Trigger')"


def main():
    with Browser() as browser:
        page = browser.open(pathlib.Path(sys.argv[1]).resolve().as_uri(), width=800)
        found = page.evaluate("document.title"), page.evaluate(CURVE), page.evaluate(TRIGGER)
        page.save_picture(sys.argv[2])
        errors = page.errors
    print("title {!r}, curve {!r}, trigger {}".format(*found))
    for error in errors:
        print(error)
    return 0 if not errors and found == ("speed – lexican mon", "speed", True) else 1


if __name__ == "__main__":
    sys.exit(main())
