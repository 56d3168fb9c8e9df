#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Lets man set the manual pages: without a warning, and with every option that the programs' own help lists.

usage: manual_test.py FOLDER POSEWIRE POSEWIRE_CLI
"""
import os
import pathlib
import shutil
import subprocess
import sys

from completion_test import commands_in_help, options_in_help

SKIPPED = 77


def page(path):
    result = subprocess.run(["man", "--warnings=w", "-l", str(path)], capture_output=True, text=True, check=True,
                            env=dict(os.environ, MANWIDTH="200", LC_ALL="C.UTF-8", MAN_KEEP_FORMATTING="", TERM="dumb"))
    assert not result.stderr, result.stderr
    return result.stdout


def entries(lines):
    """The lines that name options: `-o, --output FILE`."""
    return {word.rstrip(",") for line in lines if line.strip().startswith("-") for word in line.split()
            if word.startswith("-")}


def check_options(lines, command):
    missing = options_in_help(command) - entries(lines)
    assert not missing, (command, missing)


def section(text, title):
    """The lines below a heading up to the next one as far left."""
    lines = text.splitlines()
    begin = next(i for i, line in enumerate(lines) if line.strip() == title)
    indent = len(lines[begin]) - len(lines[begin].lstrip())
    end = next((i for i in range(begin + 1, len(lines))
                if lines[i].strip() and len(lines[i]) - len(lines[i].lstrip()) <= indent), len(lines))
    return lines[begin + 1:end]


def main(folder, posewire, cli):
    if not shutil.which("man"):
        return SKIPPED
    text = page(folder / "posewire.1")
    check_options(section(text, "OPTIONS"), [posewire])
    text = page(folder / "posewire-cli.1")
    check_options(section(text, "OPTIONS"), [cli])
    for command in commands_in_help(cli):
        check_options(section(text, command), [cli, command])
        assert f"posewire-cli {command} [OPTION]..." in text, command
    return 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]), sys.argv[2], sys.argv[3]))
