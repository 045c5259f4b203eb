#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""python_files.py PROGRAM: the installed files of all modules that PROGRAM and the interpreter import, one a line."""
import os
import runpy
import sys

sys.path.insert(0, os.path.dirname(sys.argv[1]))
runpy.run_path(sys.argv[1])  # under another name than __main__: it only imports
for module in list(sys.modules.values()):
    for attribute in "__file__", "__cached__":
        path = getattr(module, attribute, None) or ""
        if path.startswith(sys.prefix) and os.path.exists(path):
            print(path)
