#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""search.py REFERENCE HTML

Adds the API reference that reference.sh has made in REFERENCE to the search of the site in HTML: an entry for each
header and type, with the names of its members, and one for each function, macro, constant and variable, with its
declaration and brief description. Omits the text of the example programs, which would hide the pages that explain a
function.
"""
import json
import sys
from pathlib import Path
from xml.etree import ElementTree

PAGES = ("file", "namespace", "class", "struct", "union")
RECORDS = ("struct", "union")  # their members have no entries


def text_of(element):
    return " ".join("".join(element.itertext()).split()) if element is not None else ""


def briefs_of(xml):
    """The brief description of each compound and symbol, by its page and anchor."""
    briefs = {}
    for file in xml.glob("*.xml"):
        for element in ElementTree.parse(file).iter():
            if "id" in element.attrib and element.tag in ("compounddef", "memberdef", "enumvalue"):
                key = element.get("id")
                briefs[key] = text_of(element.find("briefdescription")) or text_of(element.find("detaileddescription"))
    return briefs


def entries_of(compound, briefs):
    """The entries of a page of the reference, as Material requires them: the first one contains the text of all others,
    the second one is shown as the page itself."""
    page = "reference/" + compound.findtext("filename")
    members = [member for member in compound.iterfind("member") if not member.findtext("name").startswith("@")]
    is_record = compound.get("kind") in RECORDS
    text = " ".join([briefs.get(Path(page).stem, ""), *(member.findtext("name") for member in members if is_record)])
    entries = [{"location": page + "#top", "title": compound.findtext("name"), "text": text}]
    for member in members if not is_record else ():
        file, anchor = member.findtext("anchorfile"), member.findtext("anchor")
        if file == Path(page).name:
            name, brief = member.findtext("name"), briefs.get(f"{Path(file).stem}_1{anchor}", "")
            text = f"{name}{member.findtext('arglist')}: {brief}"
            entries.append({"location": f"{page}#{anchor}", "title": name, "text": text})
    text = " ".join(f"{entry['title']} {entry['text']}" for entry in entries)
    return [{"location": page, "title": compound.findtext("name"), "text": text}, *entries]


def main():
    reference, html = Path(sys.argv[1]), Path(sys.argv[2])
    briefs = briefs_of(reference / "xml")
    index = json.loads((html / "search/search_index.json").read_text(encoding="utf-8"))
    for entry in index["docs"]:
        if entry["location"].startswith("source/"):
            entry["text"] = ""
    for compound in ElementTree.parse(reference / "tags.xml").iterfind("compound"):
        if compound.get("kind") in PAGES:
            index["docs"] += entries_of(compound, briefs)
    (html / "search/search_index.json").write_text(json.dumps(index), encoding="utf-8")


if __name__ == "__main__":
    main()
