#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the library as one source: lexican.cpp, lexican.h, lexican_config.h and, for drivers, co_cfg.h.

docs/integrate.md describes the use.
"""
import argparse
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PLACES = [ROOT / "include", ROOT / "config", ROOT / "src"]
PRESETS = ["minimal", "slave", "full"]
CONFIG = "lexican_config.h"

TITLE = """// SPDX-License-Identifier: Apache-2.0
// Lexican {}, written by cmake/one_file.py: {}
"""

CHOICE = """
// Preset, whose values have priority over the defaults below: 1 minimal, 2 slave, 3 full.
#ifndef LEXICAN_PRESET
#define LEXICAN_PRESET {}
#endif
"""

HEAD = """#include "lexican.h"

// Internal linkage of all functions and objects that are not the C API. With -D'CO_INTERNAL(text)=' they are external.
// Without optimisation, too: gcc would warn of functions of parts that the configuration leaves out.
#ifndef CO_INTERNAL
#if defined(__GNUC__) && !defined(__clang__) && !defined(__OPTIMIZE__)
#define CO_INTERNAL(text)
#else
#define CO_INTERNAL(text) text
#endif
#endif

// A configuration does not use or define every function.
#ifdef __GNUC__
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#ifdef __clang__
#pragma clang diagnostic ignored "-Wundefined-internal"
#pragma clang diagnostic ignored "-Wunused-const-variable"
#endif

// With exceptions, a C program would need the C++ run time. Clang has no such pragma and requires -fno-exceptions.
#if defined(__GNUC__) && !defined(__clang__) && defined(__EXCEPTIONS)
#pragma GCC optimize("no-exceptions")
#endif
"""


def fail(message):
    sys.exit(f"one_file.py: {message}")


def text_of(path):
    """Returns the text of a file without its licence. Include guards stay: headers of drivers include single headers."""
    text = path.read_text(encoding="utf-8").replace("// SPDX-License-Identifier: Apache-2.0\n", "", 1)
    return text.replace("#pragma once\n", "", 1)


def included(path):
    """Yields the headers of the project that a file includes."""
    for name in re.findall(r'^#include "([^"]+)"$', path.read_text(encoding="utf-8"), re.M):
        yield find(name, path)


def find(name, user):
    for place in PLACES:
        if (place / name).is_file():
            return place / name
    return fail(f"{user}: no header {name}")


class Writer:
    """Expands the includes of files, each header once."""

    def __init__(self, is_internal, done=()):
        self.is_internal = is_internal
        self.done = set(done)
        self.lines = []

    def add(self, path):
        conditions = []
        self.lines.append(f"\n// {path.relative_to(ROOT)}")
        lines = text_of(path).splitlines()
        begins, ends = (sum(line.startswith(text) for line in lines) for text in ("namespace co", "}  // namespace co"))
        if begins != ends:
            fail(f"{path}: an end of namespace co without '// namespace co'")
        for line in lines:
            name = re.match(r'#include "([^"]+)"$', line)
            if name:
                self.include(find(name[1], path), conditions)
            elif not is_left_out(line):
                conditions = conditions_after(line, conditions)
                self.lines += in_unnamed_namespace(line) if self.is_internal and path.suffix != ".h" else [line]

    def include(self, path, conditions=()):
        """Expands a header. One that is included under a condition only is expanded again where another file includes it."""
        if path in self.done:
            return
        if not conditions:
            self.done.add(path)
        if path == ROOT / "config/co_cfg.h":
            self.lines.append(f'#include "{CONFIG}"')
        else:
            self.add(path)


def conditions_after(line, conditions):
    """Returns the conditions that are open after a line, without those of include guards."""
    if re.match(r"#\s*if", line):
        return conditions + [line]
    conditions = conditions[:-1] if re.match(r"#\s*endif", line) else conditions
    is_guard = re.match(r"#define \w+_H_$", line)
    return conditions[:-1] if is_guard else conditions


def is_left_out(line):
    """Returns whether a line concerns definitions in another file, which are now in the same one.

    No symbol can be made weak after its use, and no template of internal linkage be declared as instantiated elsewhere.
    """
    name = re.match(r"#pragma weak (\w+)$", line)
    in_library = name and any(re.search(rf"\b{name[1]}( =|\(.*\) {{$)", text_of(path), re.M) for path in sources())
    return in_library or line.startswith("extern template ")


def in_unnamed_namespace(line):
    """Returns a line with the contents of namespace co in an unnamed namespace."""
    name = re.match(r"(?:namespace|\}  // namespace) co(?:::([\w:]+)(?: \{)?| \{|)$", line)
    if not name:
        return [line]
    if line.startswith("}"):
        return ["}"] * bool(name[1]) + ["CO_INTERNAL(})", line]
    return ["namespace co {", "CO_INTERNAL(namespace {)"] + [f"namespace {name[1]} {{"] * bool(name[1])


def headers():
    """Returns the headers for applications, co_core.h first."""
    names = {path.name for path in (ROOT / "include").glob("co_*.h")} - {"co_assert.h", "co_core.h", "co_od_2020.h"}
    return [ROOT / "include" / name for name in ["co_core.h"] + sorted(names)]


def sources():
    return sorted((ROOT / "src").rglob("*.cpp"))


def config(preset):
    lines = [CHOICE.format(PRESETS.index(preset) + 1)]
    for number, name in enumerate(PRESETS, 1):
        lines.append(f"#if LEXICAN_PRESET == {number}\n{text_of(ROOT / f'config/presets/{name}.h')}#endif\n")
    return "\n".join(lines) + text_of(ROOT / "config/co_cfg.h").replace("/// \\file co_cfg.h\n", "", 1)


def write(path, text):
    """Writes a file. Settings that were edited are kept."""
    if path.name == CONFIG and path.exists() and path.read_text(encoding="utf-8") != text:
        print(f"one_file.py: {path} differs and is kept; the new one is {CONFIG}.new")
        path = path.with_name(f"{CONFIG}.new")
    path.write_text(text, encoding="utf-8")


def main(directory, preset):
    api = Writer(is_internal=False)
    for path in headers():
        api.include(path)
    code = Writer(is_internal=True, done=api.done)
    for source in sources():
        for path in included(source):
            code.include(path)
    code.done.update(path for source in sources() for path in included(source))
    for source in sources():
        code.add(source)
    version = re.search(r"lexican VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1]
    texts = {
        CONFIG: ("the settings. Edit this file.", config(preset)),
        "co_cfg.h": ("the settings, for drivers.", f'#include "{CONFIG}"\n'),
        "lexican.h": ("the API, for C and C++.", "\n".join(api.lines) + "\n"),
        "lexican.cpp": ("the library, in C++17.", HEAD + "\n".join(code.lines) + "\n"),
    }
    directory.mkdir(parents=True, exist_ok=True)
    for name, (title, text) in texts.items():
        write(directory / name, TITLE.format(version, title) + text)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", type=pathlib.Path, metavar="DIRECTORY", help="is created if needed")
    parser.add_argument("preset", nargs="?", default="slave", choices=PRESETS, metavar="PRESET",
                        help=f"preset in {CONFIG}: {', '.join(PRESETS)}; default: %(default)s")
    arguments = parser.parse_args()
    main(arguments.directory, arguments.preset)
