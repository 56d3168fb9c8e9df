#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Holds tests/specification.md to the tests: each row names tests that exist, or says why no test can hold it.

usage: check_specification.py TESTS_DIR
Prints one line for each breach and exits 1 if there is one.
"""
import pathlib
import re
import sys

TEST = re.compile(r"^TEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\s*\)", re.MULTILINE)
CTEST = re.compile(r"add_test\(\s*NAME\s+(\S+)")


def existing(folder):
    names = set()
    for path in folder.rglob("*.cpp"):
        names.update(".".join(found) for found in TEST.findall(path.read_text(encoding="utf-8")))
    for path in folder.rglob("CMakeLists.txt"):
        names.update(CTEST.findall(path.read_text(encoding="utf-8")))
    return names


def breaches(lines, names):
    rows = 0
    for number, line in enumerate(lines, 1):
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if not line.startswith("|") or len(cells) != 3 or cells[0] in ("sentence", "---"):
            continue
        rows += 1
        tests = re.findall(r"`([^`]+)`", cells[2])
        for name in tests:
            if name not in names:
                yield f"{number}: there is no test {name}"
        if not tests and not cells[2].startswith("none: "):
            yield f"{number}: {cells[0]} has neither a test nor a reason"
    if rows == 0:
        yield "1: no rows"


def main():
    folder = pathlib.Path(sys.argv[1])
    page = folder / "specification.md"
    found = list(breaches(page.read_text(encoding="utf-8").splitlines(), existing(folder)))
    for breach in found:
        print(f"{page}:{breach}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
