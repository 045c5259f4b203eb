#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""undocumented.py XML

Prints the headers and public symbols without comment, and the C functions that return an error code without a list of
\\retval (of the function, its group or its header), in the directory XML, which Doxygen has written with EXTRACT_ALL.
(Doxygen itself does not report enumerators, nor symbols inside of a class or file without comment.) Exits with 1 if
there are any.
"""
import sys
from pathlib import Path
from xml.etree import ElementTree

COMPOUNDS = ("file", "class", "struct", "union")
ERROR_CODES = ("CO_ERR", "ODR_t")


def has_comment(element):
    return any("".join(element.find(part).itertext()).strip() for part in ("briefdescription", "detaileddescription"))


def needs_comment(member):
    anonymous = (member.findtext("name") or "").startswith("@")
    deleted = (member.findtext("argsstring") or "").endswith("=delete")
    return member.get("prot") == "public" and member.get("kind") != "friend" and not anonymous and not deleted


def has_results(*elements):
    return any(element.find(".//parameterlist[@kind='retval']") is not None for element in elements)


def without_results(compound):
    """The functions of a C header that return an error code and have no list of results."""
    if compound.get("kind") != "file" or not compound.findtext("compoundname").endswith(".h"):
        return
    for section in compound.iterfind("sectiondef"):
        for member in section.iterfind("memberdef[@kind='function']"):
            returned = "".join(member.find("type").itertext()).split()
            comments = (member, *section.iterfind("description"), compound.find("detaileddescription"))
            if returned and returned[-1] in ERROR_CODES and not has_results(*comments):
                yield member


def undocumented(compound):
    """The elements of a compound without comment, each with the element that has its location."""
    if compound.get("prot") == "private" or compound.findtext("compoundname").endswith(".md"):
        return
    if compound.get("kind") in COMPOUNDS and not has_comment(compound):
        yield compound, compound
    for member in filter(needs_comment, compound.iterfind("sectiondef/memberdef")):
        for element in (member, *member.iterfind("enumvalue")):
            if not has_comment(element):
                yield element, member


def main():
    found = set()
    for file in Path(sys.argv[1]).glob("*.xml"):
        for compound in ElementTree.parse(file).iterfind("compounddef"):
            for element, parent in undocumented(compound):
                place = parent.find("location")
                name = element.findtext("compoundname") or element.findtext("name")
                found.add((place.get("file"), int(place.get("line") or 1), f"error: {name} has no comment"))
            for member in without_results(compound):
                place = member.find("location")
                name = member.findtext("name")
                found.add((place.get("file"), int(place.get("line")), f"error: {name} has no list of \\retval"))
    for file, line, fault in sorted(found):
        print(f"{file}:{line}: {fault}", file=sys.stderr)
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
