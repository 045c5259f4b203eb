#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""assemble.py ROOT PAGES REFERENCE

Copies the pages of the site to the directory PAGES, which must not exist: docs/, the pages of codict and lexican, the
list of rules, the pages for contributors, and the API reference that reference.sh has made in REFERENCE. Adds a page
with the sources of each example program of demo/ that a page names. Links between pages are adapted; a link to a header
leads to its page of the API reference, a link to another file of the repository becomes its path. Pictures are drawn
from docs/pictures/*.dot by Graphviz. Rows of the first page that name a row of docs/sizes.md or docs/speed.md get its
numbers.
"""
import os.path
import re
import shutil
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

FENCE = re.compile(r"^(```\w+) whole$", re.MULTILINE)
PROGRAM = re.compile(r"(?<!\[)`(demo/[\w/.]+)`")
# Names of source files of example programs, and their languages, in the order of a page.
LANGUAGES = {"*.c": "c", "*.h": "c", "*.cpp": "cpp", "*.hpp": "cpp", "*.eds": "ini", "*.xdd": "xml",
             "CMakeLists.txt": "cmake", "makefile": "make"}
NUMBERS = re.compile(r"^(\| \[(.+)\]\((\w+\.md)\S*\) \|) \| \| \|$", re.MULTILINE)
STACKS = ("CANopen-Stack 4.4", "CANopenNode 4.1")
LIMIT = "at most"
LINK = re.compile(r"(!?)\[([^\]]*)\]\(([^)#\s]+)(#[^)\s]*)?\)")


def pages_of(root):
    """The place of each page in the site, by its place in the repository."""
    pages = {}
    for path in sorted((root / "docs").rglob("*.md")):
        pages[path.relative_to(root)] = path.relative_to(root / "docs")
    for name in ("codict", "rules", "network"):
        if (root / f"tools/codict/docs/{name}.md").exists():
            pages[Path(f"tools/codict/docs/{name}.md")] = Path(f"{name}.md")
    tool = root / "tools/lexican/docs"
    for path in sorted(tool.rglob("*.md")):
        place = path.relative_to(tool)
        pages[path.relative_to(root)] = place if path.stem == "lexican" else Path("lexican") / place
    pages[Path("tests/stack/conformance/RULES.md")] = Path("conformance.md")
    pages[Path("CONTRIBUTING.md")] = Path("contributing.md")
    pages[Path("tests/README.md")] = Path("tests.md")
    for place in ("drivers/models", "stack/target"):
        pages[Path(f"tests/{place}/README.md")] = Path(f"{Path(place).name}.md")
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


def sources_of(root, program):
    """The language of each source file of a directory of demo/; files of its subdirectories are last."""
    files = {file.relative_to(root): name for name in LANGUAGES for file in sorted((root / program).rglob(name))}
    files = {file: name for file, name in files.items() if not {"generated", "build"} & set(file.parts[:-1])}
    return {file: LANGUAGES[files[file]] for file in sorted(files, key=lambda file: len(file.parts))}


def adapt(text, source, pages, headers, root):
    """The text of a page with links that hold within the site, and with Markdown that mkdocs understands; and the
    directories of demo/ that it names."""
    programs = set()

    def program_of(place):
        """The path from the page to the sources of a file or directory of demo/, None for a script."""
        program = Path(*place.parts[:2])
        if place.parts[0] != "demo" or not (root / program).is_dir():
            return None
        if place not in (program, *sources_of(root, program)):
            return None
        programs.add(program)
        anchor = f"#{place.relative_to(program)}" if place != program else ""
        return os.path.relpath(f"source/{program.name}.md", pages[source].parent) + anchor

    def link(match):
        picture, words, target, anchor = match[1], match[2], match[3], match[4] or ""
        if "://" in target:
            return match[0]
        place = Path(os.path.normpath(source.parent / target))
        if place.parent == Path("docs/pictures"):
            return f"{picture}[{words}]({os.path.relpath(place.relative_to('docs'), pages[source].parent)})"
        if place in headers:
            return f"[{words}]({os.path.relpath(headers[place], pages[source].parent)})"
        if place in pages:
            return f"{picture}[{words}]({os.path.relpath(pages[place], pages[source].parent)}{anchor})"
        if not (root / place).exists():
            sys.exit(f"{source}: the link to {target} leads nowhere")
        if to := program_of(place):
            return f"[{words}]({to})"
        return f"{words} (`{place}`)" if str(place) not in words else f"`{place}`"

    def program(match):
        to = program_of(Path(match[1].rstrip("/")))
        return f"[`{match[1]}`]({to})" if to else match[0]

    return PROGRAM.sub(program, LINK.sub(link, indent_items(FENCE.sub(r"\1", text)))), programs


def page_of_program(root, program):
    """A page with the sources of a program."""
    lines = [f"# `{program}`", "", f"Sources of `{program}` in the repository."]
    for file, language in sources_of(root, program).items():
        name = file.relative_to(program)
        code = (root / file).read_text().rstrip("\n")
        lines += ["", f"## `{name}` {{ #{name} }}", "", f"````{language}", code, "````"]
    return "\n".join(lines) + "\n"


def with_numbers(text, docs):
    """The text with numbers in the rows that name a row of a page: of the first CPU, of other stacks and, from the column
    in front of theirs and of limits, of Lexican."""

    def cells_of(line):
        return [cell.strip() for cell in line.strip("|").split("|")]

    def numbers(match):
        head = []
        for cells in map(cells_of, (docs / match[3]).read_text().splitlines()):
            if STACKS[0] in cells:
                head = cells
            elif head and cells[0] == match[2]:
                before = head[: head.index(STACKS[0])]
                own = max(n for n, title in enumerate(before) if title != LIMIT)
                values = [cells[own], *(cells[head.index(stack)] for stack in STACKS)]
                return match[1] + "".join(f" {float(value):,.12g} |".replace(",", "\u202f") for value in values)
        sys.exit(f"docs/index.md: {match[3]} has no row '{match[2]}'")

    return NUMBERS.sub(numbers, text)


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
    programs = set()
    for source, place in pages.items():
        (to / place).parent.mkdir(parents=True, exist_ok=True)
        text, named = adapt((root / source).read_text(), source, pages, headers, root)
        if place == Path("index.md"):
            text = "---\nhide: [navigation, toc]\n---\n" + with_numbers(text, root / "docs")
        (to / place).write_text(text)
        programs |= named
    (to / "source").mkdir()
    for program in programs:
        (to / f"source/{program.name}.md").write_text(page_of_program(root, program))
    shutil.copytree(reference / "html", to / "reference")
    draw(root, to / "pictures")
    for file in sorted((root / "docs/pictures").glob("*.[sp][vn]g")):
        shutil.copy(file, to / "pictures")
    shutil.copy(root / "docs/site/space.css", to)


if __name__ == "__main__":
    main()
