#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""page_output.py PAGE NAME PROGRAM

Runs PROGRAM and compares what it prints with the block of PAGE behind <!-- output of NAME -->.
"""
import difflib
import pathlib
import re
import subprocess
import sys

page, name, program = sys.argv[1:]
block = re.search(rf"<!-- output of {re.escape(name)} -->\n```text\n(.*?)^```$", pathlib.Path(page).read_text(), re.MULTILINE | re.DOTALL)
if block is None:
    sys.exit(f"{page} has no output of {name}")
ran = subprocess.run([program], capture_output=True, text=True, check=True, timeout=600)
difference = difflib.unified_diff(block[1].splitlines(True), ran.stdout.splitlines(True), page, name)
sys.stdout.writelines(difference)
sys.exit(0 if block[1] == ran.stdout else 1)
