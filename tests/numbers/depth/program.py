# SPDX-License-Identifier: Apache-2.0
"""What the compiler tells of a program: its functions, what each has on the stack, and whom it calls.

From -fcallgraph-info=su,da there are a function's bytes and its calls, from the relocations of the object file the calls
that the compiler itself does not know (of its own run time), the functions in tables, and those whose address is taken.
"""
import re
import subprocess
from pathlib import Path

NODE = re.compile(r'^node: \{ title: "([^"]+)" label: "([^"]*)"( shape : ellipse)? \}$', re.MULTILINE)
EDGE = re.compile(r'^edge: \{ sourcename: "([^"]+)" targetname: "([^"]+)"(?: label: "([^"]*)")? \}$', re.MULTILINE)
FRAME = re.compile(r"\\n([0-9]+) bytes \(([a-z,]+)\)\\n([0-9]+) dynamic objects")
INDIRECT = "__indirect_call"


class Function:
    """One of the program. title: unlike that of any other; for a local one with its file."""

    def __init__(self, title, file):
        self.title = title
        self.symbol = title.rsplit(":", 1)[-1]
        self.file = file
        self.name = self.symbol  # as a person would write it
        self.parameters = ""
        self.frame = 0
        self.is_fixed = True  # no alloca(), no array of variable length
        self.is_weak = False
        self.callees = set()  # titles
        self.taken = set()  # titles of functions whose address it takes
        self.tables = set()  # keys of tables of the same file whose address it takes
        self.calls = []  # Call


class Call:
    """Through a pointer."""

    def __init__(self, function, file, expression):
        self.function = function  # that it is in
        self.file = file
        self.expression = expression


def expression_at(line, column):
    """What is called, where the call of a line has its parenthesis, or its last name, in this column: "type->Read"."""
    end = column - 1
    end += len(re.match(r"\w*", line[end:])[0])
    begin = end
    while begin > 0:
        character = line[begin - 1]
        if character in ")]":
            begin = opening(line, begin - 1)
        elif re.match(r"[\w.:]", character):
            begin -= 1
        elif line[begin - 2 : begin] == "->":
            begin -= 2
        elif line[begin - 2 : begin] == ".*":
            begin -= 2
        else:
            break
    return line[begin:end].strip().lstrip("!")


def opening(line, place):
    """The place of the parenthesis that belongs to the one at this place."""
    depth = 0
    while place >= 0:
        depth += {")": 1, "]": 1, "(": -1, "[": -1}.get(line[place], 0)
        if depth == 0:
            return place
        place -= 1
    return 0


# A symbol that is given by its name (*), and the configuration in those of CONodeInit() and CONodeInitEx().
DECORATION = re.compile(r"^\*|_SSDO\w+$")


class Program:
    """Functions and tables of objects, whose call graphs are beside them."""

    def __init__(self, objects, sources, tools):
        self.sources = sources
        self.tools = tools
        self.functions = {}
        self.tables = {}  # (file, symbol) → {offset: title of a function}
        self.outside = set()  # symbols of nobody here
        graphs = {each: each.with_suffix(".ci") for each in objects}
        for graph in graphs.values():
            self.read_graph(graph.read_text(encoding="utf-8"))
        for each, graph in graphs.items():
            self.read_object(each, self.file_of_graph(graph))
        self.name_functions()

    def relative(self, path):
        """A source below src/."""
        path = Path(path)
        return str(path.resolve().relative_to(self.sources)) if path.is_absolute() else str(path)

    def file_of_graph(self, graph):
        return self.relative(re.match(r'graph: \{ title: "([^"]+)"', graph.read_text(encoding="utf-8"))[1])

    def title(self, text):
        path, colon, symbol = text.rpartition(":")
        symbol = DECORATION.sub("", symbol)
        return f"{self.relative(path)}:{symbol}" if colon else symbol

    def read_graph(self, text):
        file = self.relative(re.match(r'graph: \{ title: "([^"]+)"', text)[1])
        for title, label, is_outside in NODE.findall(text):
            frame = FRAME.search(label)
            if is_outside or not frame:
                continue
            function = self.functions.setdefault(self.title(title), Function(self.title(title), file))
            function.frame = int(frame[1])
            function.is_fixed = frame[2] == "static" and frame[3] == "0"
        for source, target, place in EDGE.findall(text):
            function = self.functions[self.title(source)]
            if target == INDIRECT:
                function.calls.append(self.call_at(function, place))
            else:
                function.callees.add(self.title_in(file, self.title(target)))

    def call_at(self, function, place):
        path, line, column = place.rsplit(":", 2)
        text = Path(path).read_text(encoding="utf-8").splitlines()[int(line) - 1]
        return Call(function, self.relative(path), expression_at(text, int(column)))

    def output_of(self, tool, *arguments):
        return subprocess.run([self.tools + tool, *arguments], capture_output=True, text=True, check=True).stdout

    def read_object(self, path, file):
        text = self.output_of("objdump", "-tr", str(path))
        for weak in re.findall(r"^[0-9a-f]+ .w....F \S+\t[0-9a-f]+ (?:\S+ )?(\S+)$", text, re.MULTILINE):
            if self.title_in(file, weak) in self.functions:  # not another name of a constructor
                self.functions[self.title_in(file, weak)].is_weak = True
        section = ""
        for line in text.splitlines():
            begin = re.match(r"RELOCATION RECORDS FOR \[(.*)\]:", line)
            section = begin[1] if begin else section
            relocation = re.match(r"([0-9a-f]{8}) (R_\S+)\s+(\S+)$", line)
            if relocation and not section.startswith(".debug"):
                title = self.title_in(file, relocation[3])
                self.take_relocation(file, section, int(relocation[1], 16), relocation[2], title)

    def title_in(self, file, symbol):
        """Of a symbol that this file knows. A constructor (C1) is the same as that of a base class (C2)."""
        symbol = DECORATION.sub("", symbol)
        for known in (symbol, re.sub("(?<=[CD])1E", "2E", symbol)):
            for title in (f"{file}:{known}", known):
                if title in self.functions:
                    return title
        return symbol

    def take_relocation(self, file, section, offset, kind, target):
        kind_of_section, _, symbol = section.removeprefix(".").partition(".")
        if kind in ("R_ARM_THM_CALL", "R_ARM_THM_JUMP24"):
            caller = self.functions[self.title_in(file, symbol)]
            caller.callees.add(target)
            self.outside.update({target} - set(self.functions))
        elif target in self.functions and kind_of_section == "text":
            self.functions[self.title_in(file, symbol)].taken.add(target)
        elif kind_of_section == "text" and self.title_in(file, symbol) in self.functions:
            function = self.functions[self.title_in(file, symbol)]
            function.tables.add((file, target.removeprefix(".rodata.")))  # or other data
        elif target in self.functions and kind_of_section in ("rodata", "data"):
            self.tables.setdefault((file, symbol), {})[offset] = target

    def taken(self):
        """Titles of all functions whose address code takes."""
        return set().union(*(function.taken for function in self.functions.values()))

    def name_functions(self):
        """co::lss::(anonymous namespace)::has_address(CO_NODE_T&) is lss::has_address, parameters (CO_NODE_T&)."""
        symbols = [function.symbol for function in self.functions.values()]
        # A clone of a function (.isra.0 …) has its name.
        plain = [symbol.partition(".")[0] for symbol in symbols]
        names = dict(zip(symbols, self.output_of("c++filt", *plain).splitlines()))
        tables = [symbol for _, symbol in self.tables]
        table_names = dict(zip(tables, self.output_of("c++filt", *tables).splitlines()))
        for function in self.functions.values():
            full = re.sub(r"\(anonymous namespace\)::", "", names[function.symbol])
            found = re.match(r"(.*?)(\((?:[^()]|\([^()]*\))*\))?(?: const)?$", full)
            words = re.split(r" (?![^<]*>)", found[1])
            function.name = words[-1].removeprefix("co::")
            function.parameters = found[2] or ""
        self.table_names = {
            key: re.sub(r"\(anonymous namespace\)::", "", table_names[key[1]]).rpartition("::")[2] for key in self.tables
        }
