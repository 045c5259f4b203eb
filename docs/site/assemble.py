#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""assemble.py ROOT PAGES REFERENCE

Copies the pages of the site to the directory PAGES, which must not exist: docs/, the pages of codict, the list of
rules, the pages for contributors, and the API reference that reference.sh has made in REFERENCE. Links between them are
adapted; a link to a header leads to its page of the API reference, a link to another file of the repository becomes its
path. Pictures are drawn from docs/pictures/*.dot by Graphviz.
"""
import os.path
import re
import shutil
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

FENCE = re.compile(r"^(```\w+) whole$", re.MULTILINE)
LINK = re.compile(r"(!?)\[([^\]]*)\]\(([^)#\s]+)(#[^)\s]*)?\)")


def pages_of(root):
    """The place of each page in the site, by its place in the repository."""
    pages = {}
    for path in sorted((root / "docs").rglob("*.md")):
        pages[path.relative_to(root)] = path.relative_to(root / "docs")
    for name in ("codict", "rules", "network"):
        if (root / f"tools/codict/docs/{name}.md").exists():
            pages[Path(f"tools/codict/docs/{name}.md")] = Path(f"{name}.md")
    pages[Path("tests/conformance/RULES.md")] = Path("conformance.md")
    pages[Path("CONTRIBUTING.md")] = Path("contributing.md")
    pages[Path("tests/README.md")] = Path("tests.md")
    return pages


def headers_of(root, tags):
    """The place of each header's page in the site, by the header's place in the repository."""
    headers = {}
    for file in ElementTree.parse(tags).iterfind("compound[@kind='file']"):
        header = Path(file.findtext("path")) / Path(file.findtext("name")).name
        headers[header.relative_to(root)] = Path("reference") / file.findtext("filename")
    return headers


def indent_items(text):
    """The text with lists as mkdocs requires them: 4 spaces in front of everything that belongs to an item, and an empty
    line in front of the item behind one with several paragraphs."""
    lines = []
    offset = 0  # of the contents of the item; 0: no item
    has_paragraphs = False
    for line in text.split("\n"):
        item = re.match(r"(\d+\.|-) +", line)
        if item:
            if offset and has_paragraphs:
                lines.append("")
            offset = len(item[0])
            has_paragraphs = False
        elif line and not line.startswith(" "):
            offset = 0
        has_paragraphs = has_paragraphs or not line
        is_inside = 0 < offset < 4 and not item and line.startswith(" " * offset)
        lines.append(" " * (4 - offset) + line if is_inside else line)
    return "\n".join(lines)


def adapt(text, source, pages, headers, root):
    """The text of a page with links that hold within the site, and with Markdown that mkdocs understands."""

    def link(match):
        picture, words, target, anchor = match[1], match[2], match[3], match[4] or ""
        if "://" in target:
            return match[0]
        place = Path(os.path.normpath(source.parent / target))
        if place.suffix == ".svg":
            return match[0]
        if place in headers:
            return f"[{words}]({os.path.relpath(headers[place], pages[source].parent)})"
        if place in pages:
            return f"{picture}[{words}]({os.path.relpath(pages[place], pages[source].parent)}{anchor})"
        if not (root / place).exists():
            sys.exit(f"{source}: the link to {target} leads nowhere")
        return f"{words} (`{place}`)" if str(place) not in words else f"`{place}`"

    return LINK.sub(link, indent_items(FENCE.sub(r"\1", text)))


def draw(root, to):
    to.mkdir(parents=True, exist_ok=True)
    for source in sorted((root / "docs/pictures").glob("*.dot")):
        subprocess.run(["dot", "-Tsvg", source, "-o", to / f"{source.stem}.svg"], check=True)


def main():
    root, to, reference = Path(sys.argv[1]).resolve(), Path(sys.argv[2]), Path(sys.argv[3])
    pages = pages_of(root)
    headers = headers_of(root, reference / "tags.xml")
    listed = (root / "docs/site/mkdocs.yml").read_text()
    if missing := [str(place) for place in pages.values() if f": {place}\n" not in listed]:
        sys.exit(f"docs/site/mkdocs.yml, nav, does not list: {', '.join(missing)}")
    for source, place in pages.items():
        (to / place).parent.mkdir(parents=True, exist_ok=True)
        (to / place).write_text(adapt((root / source).read_text(), source, pages, headers, root))
    shutil.copytree(reference / "html", to / "reference")
    draw(root, to / "pictures")
    for file in sorted((root / "docs/pictures").glob("*.svg")):
        shutil.copy(file, to / "pictures")
    shutil.copy(root / "docs/site/space.css", to)


if __name__ == "__main__":
    main()
