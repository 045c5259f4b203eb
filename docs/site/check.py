#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check.py HTML

Checks the built site: no page and no style sheet loads anything from another machine, links and pictures within the
site exist, and the search leads to existing places, also of the API reference. Prints "1..N" and a line "ok …" or
"not ok …" for each page, style sheet and index of the search.
"""
import json
import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

LOADING = {("script", "src"), ("img", "src"), ("iframe", "src"), ("source", "src"), ("link", "href"), ("object", "data")}
NO_LOAD = {"canonical", "prev", "next", "edit"}


class Page(HTMLParser):
    def __init__(self, file, root):
        super().__init__()
        self.file = file
        self.root = root
        self.faults = []

    def handle_starttag(self, tag, attrs):
        of = dict(attrs)
        for name in ("src", "href", "data"):
            target = of.get(name)
            if not target or (tag == "link" and of.get("rel") in NO_LOAD):
                continue
            parts = urlsplit(target)
            if parts.scheme or parts.netloc:
                if (tag, name) in LOADING and parts.scheme not in ("data", "javascript"):
                    self.faults.append(f"loads {target}")
            elif parts.path and not self.exists(unquote(parts.path)):
                self.faults.append(f"leads to {target}, which does not exist")

    def exists(self, path):
        base = self.root if path.startswith("/") else self.file.parent
        place = base / path.lstrip("/")
        return place.is_file() or (place / "index.html").is_file()


def faults_of_search(index, root):
    texts = {}  # of the pages, None: there is no such page
    for place in (entry["location"] for entry in index["docs"]):
        page, _, anchor = place.partition("#")
        if page not in texts:
            file = root / page / "index.html" if (root / page).is_dir() else root / page
            texts[page] = file.read_text(encoding="utf-8") if file.is_file() else None
        if texts[page] is None or (anchor and f'id="{anchor}"' not in texts[page]):
            yield f"leads to {place}, which does not exist"
    if not any(page.startswith("reference/") for page in texts):
        yield "finds no symbol of the API reference"


def faults_of(file, root):
    text = file.read_text(encoding="utf-8")
    if file.suffix == ".json":
        return list(faults_of_search(json.loads(text), root))
    if file.suffix == ".css":
        return [f"loads {url}" for url in re.findall(r"(?:url\(|@import\s+)[\"']?(https?://[^\"')]+)", text)]
    page = Page(file, root)
    page.feed(text)
    return page.faults


def main():
    root = Path(sys.argv[1])
    files = sorted(p for p in root.rglob("*") if p.suffix in (".html", ".css") or p.name == "search_index.json")
    print(f"1..{len(files)}")
    good = bool(files)
    for file in files:
        faults = faults_of(file, root)
        good = good and not faults
        place = file.relative_to(root)
        print(f"not ok {place}: {'; '.join(faults)}" if faults else f"ok {place}")
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
