# SPDX-License-Identifier: Apache-2.0
"""What a call through a pointer may lead to: the rules of calls.txt, applied to a program."""
from fnmatch import fnmatchcase

WORD = 4  # bytes of a pointer
APPLICATION = "application"
PASSED = "passed"


class Rule:
    """A line of calls.txt."""

    def __init__(self, file, expression, targets, where=""):
        self.file = file
        self.expression = expression
        self.targets = targets
        self.function = where.removeprefix("in ") if where.startswith("in ") else "*"
        self.caller = where.removeprefix("from ") if where.startswith("from ") else ""
        self.depends_on_caller = self.caller != "" or targets.startswith(PASSED)
        self.is_used = False

    def applies_to(self, call):
        return (
            fnmatchcase(call.file, self.file)
            and fnmatchcase(call.expression, self.expression)
            and fnmatchcase(call.function.name, self.function)
        )


class Targets:
    """The rules, and what they mean in a program."""

    def __init__(self, text, program, is_whole=True):
        self.program = program
        self.is_whole = is_whole
        self.rules = []
        self.rows = []  # (pattern of tables, members)
        self.limits = []  # (pattern of functions, number)
        self.nevers = []  # (pattern of functions, functions that no call below them leads to)
        for line in text.splitlines():
            fields = [field.strip() for field in line.split("|")]
            if not line or line.startswith("#"):
                continue
            if fields[0] == "rows":
                self.rows.append((fields[1], fields[2].split()))
            elif fields[0] == "limit":
                self.limits.append((fields[1], int(fields[2])))
            elif fields[0] == "never":
                self.nevers.append((fields[1], fields[2]))
            else:
                self.rules.append(Rule(*fields))

    def rules_of(self, call):
        """Of those that apply: the last, or the last ones that depend on the caller. None: nobody has thought of this call."""
        rules = [rule for rule in self.rules if rule.applies_to(call)]
        while rules and rules[-1].depends_on_caller and not rules[0].depends_on_caller:
            rules.pop(0)
        rules = rules if rules and rules[-1].depends_on_caller else rules[-1:]
        for rule in rules:
            rule.is_used = True
        return rules

    def of_call(self, call, caller=None):
        """Titles of functions; caller: who calls the function that the call is in."""
        found = set()
        for rule in self.rules_of(call):
            if rule.targets == PASSED:
                found |= caller.taken if caller else set()
            elif rule.targets.startswith(PASSED):
                found |= self.of_passed_tables(caller, rule.targets.partition(".")[2])
            elif not rule.caller or (caller and fnmatchcase(caller.name, rule.caller)):
                found |= self.of_words(rule.targets, call.file)
        return found

    def of_passed_tables(self, caller, member):
        tables = caller.tables & set(self.program.tables) if caller else set()
        return set().union(*(self.of_table(key, member) for key in tables))

    def of_words(self, targets, file):
        words, parenthesis, parameters = targets.partition("(")
        found = self.with_parameters(parenthesis + parameters) if parenthesis else set()
        for word in words.split():
            found |= self.of_word(word, file)
        return found

    def with_parameters(self, parameters):
        functions = (self.program.functions[title] for title in self.program.taken())
        return {function.title for function in functions if function.parameters == parameters}

    def of_word(self, word, file):
        if word == APPLICATION:
            return set()
        name, _, member = word.partition(".")
        tables = [key for key, table in self.program.table_names.items() if fnmatchcase(table, name)]
        here = [key for key in tables if key[0] == file]
        found = set()
        for key in here or tables:
            found |= self.of_table(key, member)
        if not tables:
            functions = self.program.functions.values()
            found = {function.title for function in functions if function.name == word}
        if not found and self.is_whole:
            raise SystemExit(f"calls.txt: there is no {word} for {file}")
        return found

    def of_table(self, key, member):
        functions = self.program.tables[key]
        members = self.members_of(self.program.table_names[key]) if member else []
        if member and member not in members:
            raise SystemExit(f"calls.txt: rows of {key[1]} have no {member}")
        return {
            title
            for offset, title in functions.items()
            if not member or members[offset // WORD % len(members)] == member
        }

    def members_of(self, table):
        return next((members for pattern, members in self.rows if fnmatchcase(table, pattern)), [])
