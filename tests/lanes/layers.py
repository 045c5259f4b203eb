#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The include rules: include < wire < hal < base < dictionary < storage < service < extra < node; drivers include only include/.
The modules of tools/codict/src: text < model < eds, xdd < check, gen and so on < network < catalogue < cli; none includes one of
its own level. Those of tools/lexican/src: trace, bus < host < client < describe < explain < simulate < program; the
last four include codict's.

layers.py ROOT         checks a source tree, one case for each module
layers.py --self-test  checks that a violation of each rule is found in a small tree
Both print "1..N" and N lines "ok …" or "not ok …".
"""
import re
import sys
import tempfile
from pathlib import Path

MODULES = ["wire", "hal", "base", "dictionary", "storage", "service", "extra", "node"]
# A service that extends another one includes it.
EXTENDS = {"mpdo": "pdo"}
# Public headers of src/extra.
OF_EXTRAS = {"co_od.h", "co_od_2020.h", "co_os.h", "co_recorder.h"}
CODICT_LEVELS = [{"text"}, {"model"}, {"eds", "xdd"}, {"check", "convert", "diff", "doc", "gen", "json", "project"}, {"network"}, {"catalogue"}, {"cli"}]
TOOL_LEVELS = [{"trace", "bus"}, {"host"}, {"client"}, {"describe"}, {"explain"}, {"simulate"}, {"program"}]
# Headers of the stack that codict includes: they need no configuration.
CODICT_STACK = {"lexican/detail/objects.h", "lexican/srdo.hpp"}
# Headers of the standard library that need neither an operating system nor allocation.
FREESTANDING = {
    "algorithm", "array", "climits", "cstddef", "cstdint", "cstring", "initializer_list", "iterator", "limits", "tuple",
    "type_traits", "utility", "stdbool.h", "stddef.h", "stdint.h",
}
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)
DEFINE = re.compile(r"^\s*#\s*define\s+(\w+)", re.MULTILINE)


def sources(directory):
    return sorted(p for p in directory.rglob("*") if p.suffix in (".h", ".hpp", ".c", ".cpp"))


class Tree:
    def __init__(self, root):
        self.root = Path(root)

    def is_public(self, name):
        return any((self.root / place / name).is_file() for place in ("include", "config"))

    def directories(self):
        """The directories to check, each with its rule."""
        yield "include", self.in_include
        for module in MODULES:
            yield f"src/{module}", self.in_src
        yield "drivers", self.in_drivers
        for module in sorted(p.name for p in (self.root / "tools/codict/src").iterdir() if p.is_dir()):
            yield f"tools/codict/src/{module}", self.in_codict
        for module in sorted(p.name for p in (self.root / "tools/lexican/src").iterdir() if p.is_dir()):
            yield f"tools/lexican/src/{module}", self.in_tool

    def faults(self, directory, rule):
        """Returns the violations below a directory; None if it contains no sources."""
        files = sources(self.root / directory)
        if not files:
            return None
        found = []
        for file in files:
            text = file.read_text()
            for bracket, name in INCLUDE.findall(text):
                reason = rule(file, name, bracket == "<")
                if reason:
                    found.append(f"{file.relative_to(self.root)} includes {name}: {reason}")
            if directory.startswith("src/"):
                found += [f"{file.relative_to(self.root)} defines the macro {m}" for m in DEFINE.findall(text)
                          if f"#undef {m}\n" not in text]
        return found

    def in_include(self, file, name, system):
        if system:
            return None if name in FREESTANDING else "not a freestanding header"
        return None if self.is_public(name) else "not a public header"

    def in_src(self, file, name, system):
        if system:
            return None if name in FREESTANDING else "not a freestanding header"
        source = self.root / "src"
        here = file.relative_to(source).parts
        if name in OF_EXTRAS and here[0] != "extra":
            return "a header of an extra"
        if self.is_public(name):
            return None
        there = Path(name).parts
        if there[0] not in MODULES or not (source / name).is_file():
            return "neither a public header nor module/file"
        if MODULES.index(there[0]) > MODULES.index(here[0]):
            return f"{there[0]} is above {here[0]}"
        in_service_module = len(here) > 2 and len(there) > 2
        if here[0] == there[0] == "service" and in_service_module and there[1] not in (here[1], EXTENDS.get(here[1])):
            return "one service never includes another"
        return None

    def in_codict(self, file, name, system):
        if system or name in CODICT_STACK:
            return None
        return self.above(CODICT_LEVELS, file.relative_to(self.root / "tools/codict/src").parts[0], name)

    def in_tool(self, file, name, system):
        here = file.relative_to(self.root / "tools/lexican/src").parts[0]
        if system or len(Path(name).parts) == 1 or self.is_public(name):  # of the stack, or of a driver
            return None
        if here in ("describe", "explain", "simulate", "program") and (self.root / "tools/codict/src" / name).is_file():
            return None
        return self.above(TOOL_LEVELS, here, name)

    @staticmethod
    def above(table, here, name):
        there = Path(name).parts[0]
        if here == there:
            return None
        levels = [[n for n, modules in enumerate(table) if module in modules] for module in (there, here)]
        if not all(levels):
            return "not a module of the table"
        return None if levels[0] < levels[1] else f"{there} is not below {here}"

    def in_drivers(self, file, name, system):
        if system or self.is_public(name):
            return None
        own = [file.parent / name, self.root / "drivers" / name]
        kind = file.relative_to(self.root / "drivers").parts[0]
        for path in own:
            if path.is_file() and path.resolve().relative_to((self.root / "drivers").resolve()).parts[0] == kind:
                return None
        return "drivers include only include/, the system and their own directory"


def check(root):
    tree = Tree(root)
    directories = list(tree.directories())
    print(f"1..{len(directories)}")
    good = True
    for directory, rule in directories:
        faults = tree.faults(directory, rule)
        if faults == []:
            print(f"ok {directory}")
        else:
            good = False
            print(f"not ok {directory}: " + ("no source found" if faults is None else "; ".join(faults)))
    return good


CLEAN = {
    "include/co_a.h": "#include <stdint.h>\n",
    "include/co_b.h": '#include "co_a.h"\n',
    "config/co_cfg.h": "",
    "src/wire/sdo.hpp": '#include "co_a.h"\n',
    "src/hal/port.cpp": '#include "wire/sdo.hpp"\n',
    "src/base/transmit.cpp": '#include "hal/port.hpp"\n',
    "src/hal/port.hpp": "",
    "src/dictionary/dict.cpp": '#include "wire/sdo.hpp"\n#include "co_cfg.h"\n',
    "src/dictionary/dict.hpp": "",
    "src/dictionary/types/string.cpp": '#include "dictionary/dict.hpp"\n#define CO_ROW(a) a,\n#undef CO_ROW\n',
    "src/storage/para.cpp": '#include "dictionary/dict.hpp"\n',
    "include/co_od.h": "",
    "src/service/nmt/nmt.hpp": '#include "dictionary/dict.hpp"\n',
    "src/service/pdo/pdo.cpp": '#include "service/pdo/pdo.hpp"\n',
    "src/service/pdo/pdo.hpp": "",
    "src/service/mpdo/mpdo.cpp": '#include "service/mpdo/mpdo.hpp"\n#include "service/pdo/pdo.hpp"\n',
    "src/service/mpdo/mpdo.hpp": "",
    "src/extra/od/flags.cpp": '#include "service/pdo/pdo.hpp"\n#include "extra/od/index.hpp"\n',
    "src/extra/od/index.hpp": "",
    "src/node/parts.cpp": '#include "service/nmt/nmt.hpp"\n#include "service/pdo/pdo.hpp"\n',
    "drivers/can/socket.cpp": '#include "co_b.h"\n#include "socket.h"\n#include <sys/socket.h>\n',
    "drivers/can/socket.h": "",
    "drivers/nvm/file.cpp": "#include <cstdio>\n",
    "tools/codict/src/text/edit.hpp": "#include <string>\n",
    "tools/codict/src/eds/read.cpp": '#include "eds/read.hpp"\n#include "text/edit.hpp"\n',
    "tools/codict/src/xdd/read.hpp": "",
    "tools/lexican/src/bus/hub.cpp": '#include "bus/hub.hpp"\n#include "co_a.h"\n',
    "tools/lexican/src/describe/names.cpp": '#include "bus/log.hpp"\n#include "xdd/read.hpp"\n',
}

PLANTED = {
    "a public header includes a source header": ("include/co_b.h", '#include "dictionary/dict.hpp"'),
    "a public header needs a hosted library": ("include/co_b.h", "#include <string>"),
    "wire includes the dictionary": ("src/wire/sdo.hpp", '#include "dictionary/dict.hpp"'),
    "hal includes the queue of frames": ("src/hal/port.cpp", '#include "base/transmit.cpp"'),
    "the dictionary includes a service": ("src/dictionary/dict.cpp", '#include "service/nmt/nmt.hpp"'),
    "a type includes the node": ("src/dictionary/types/string.cpp", '#include "node/parts.hpp"'),
    "a service includes another service": ("src/service/pdo/pdo.cpp", '#  include "service/nmt/nmt.hpp"'),
    "a service includes one that extends it": ("src/service/pdo/pdo.cpp", '#include "service/mpdo/mpdo.hpp"'),
    "a service that extends another one includes a third one": ("src/service/mpdo/mpdo.cpp", '#include "service/nmt/nmt.hpp"'),
    "a service includes the OD access interface": ("src/service/pdo/pdo.cpp", '#include "extra/od/index.hpp"'),
    "the dictionary includes the header of an extra": ("src/dictionary/dict.cpp", '#include "co_od.h"'),
    "a source needs a hosted library": ("src/dictionary/dict.cpp", "#include <vector>"),
    "a source includes by a relative path": ("src/dictionary/dict.cpp", '#include "../wire/sdo.hpp"'),
    "a source defines a macro": ("src/dictionary/dict.cpp", "#define FAST 1"),
    "a driver includes a source header": ("drivers/can/socket.cpp", '#include "dictionary/dict.hpp"'),
    "a directory of codict includes one above": ("tools/codict/src/text/edit.hpp", '#include "eds/read.hpp"'),
    "a directory of codict includes one beside": ("tools/codict/src/eds/read.cpp", '#include "xdd/read.hpp"'),
    "a directory of codict includes a header of the stack": ("tools/codict/src/eds/read.cpp", '#include "co_core.h"'),
    "a bus of the tool includes the program": ("tools/lexican/src/bus/hub.cpp", '#include "program/verb.hpp"'),
    "a bus of the tool includes codict": ("tools/lexican/src/bus/hub.cpp", '#include "xdd/read.hpp"'),
    "a driver includes another kind of driver": ("drivers/nvm/file.cpp", '#include "../can/socket.h"'),
}


def plant(root, extra=None):
    for name, text in CLEAN.items():
        path = Path(root) / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text + (extra[1] + "\n" if extra and extra[0] == name else ""))


def faults_of(extra=None):
    with tempfile.TemporaryDirectory() as root:
        plant(root, extra)
        tree = Tree(root)
        return [fault for directory, rule in tree.directories() for fault in tree.faults(directory, rule)]


def self_test():
    print(f"1..{len(PLANTED) + 1}")
    good = not faults_of()
    print("ok a clean tree passes" if good else "not ok a clean tree passes")
    for name, extra in PLANTED.items():
        found = len(faults_of(extra)) == 1
        good = good and found
        print(f"{'ok' if found else 'not ok'} found: {name}")
    return good


if __name__ == "__main__":
    sys.exit(0 if (self_test() if sys.argv[1] == "--self-test" else check(sys.argv[1])) else 1)
