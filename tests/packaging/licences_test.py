#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Holds the tree to the REUSE specification: `reuse lint` if it is installed, and .reuse/dep5 to the licences in the files' heads.

usage: licences_test.py SOURCE_DIR   (skipped without git)
"""
import fnmatch
import pathlib
import re
import shutil
import subprocess
import sys

HEAD = re.compile(rb"^[^\n]{0,6}SPDX-License-Identifier: ([\w.-]+)", re.M)


def paragraphs(text):
    """(patterns, licence) in the order of the file; the last that matches a path counts."""
    for paragraph in text.split("\n\n")[1:]:
        fields = dict(re.findall(r"^(\S+): ((?:.|\n )*)$", paragraph, re.M))
        yield fields["Files"].split(), fields["License"]


def main(source):
    listing = subprocess.run(["git", "-C", source, "ls-files", "-z"], capture_output=True, text=True, check=False) if shutil.which("git") else None
    if not listing or listing.returncode != 0:
        print("no git, or no clone")
        return 77
    table = list(paragraphs((source / ".reuse/dep5").read_text(encoding="utf-8")))
    checked = 0
    for name in listing.stdout.split("\0")[:-1]:
        path = source / name
        found = HEAD.search(path.read_bytes()[:400]) if path.is_file() else None
        if found and not name.startswith("LICENSES/"):
            licence = [one for patterns, one in table if any(fnmatch.fnmatchcase(name, pattern) for pattern in patterns)][-1]
            assert found[1].decode() == licence, f"{name} is {found[1].decode()}, and {licence} in .reuse/dep5"
            checked += 1
    assert checked > 1000, checked
    if shutil.which("reuse"):
        lint = subprocess.run(["reuse", "--root", source, "lint"], capture_output=True, text=True, check=False)
        assert lint.returncode == 0, lint.stdout + lint.stderr
    print(f"{checked} licences agree; reuse lint: {'passes' if shutil.which('reuse') else 'not installed'}")
    return 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
