#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Sources the completions in bash: they must offer every option that the program's own help lists, the choices of a
value, commands, and files.

usage: completion_test.py FOLDER POSEWIRE POSEWIRE_CLI   (FOLDER has bash)
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

OPTION = re.compile(r"(?<![\w-])--?[a-z][a-z-]*")

BASH = """
source "$1"
read -ra COMP_WORDS <<<"$2"
[[ $2 == *' ' ]] && COMP_WORDS+=('')
COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
"_${COMP_WORDS[0]//-/_}"
printf '%s\\n' "${COMPREPLY[@]}"
"""


def run(command, folder):
    result = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=60,
                            env=dict(os.environ, HOME=str(folder), TERM="dumb"))
    assert result.returncode == 0 and not result.stderr, (command[-2:], result.returncode, result.stderr)
    return result.stdout.splitlines()


def bash(scripts, line, folder):
    return set(run(["bash", "--norc", "-c", BASH, "bash", str(scripts / "bash" / line.split()[0]), line], folder))


def options_in_help(command):
    text = subprocess.run([*command, "--help"], check=True, capture_output=True, text=True).stdout
    found = set()
    for line in text.splitlines():
        if re.match(r"  -", line):
            names = re.split(r"  +| [A-Z<[]", line.strip())[0]
            found |= set(OPTION.findall(names))
    assert "--help" in found and len(found) > 1, text
    return found


def commands_in_help(cli):
    text = subprocess.run([cli, "--help"], check=True, capture_output=True, text=True).stdout
    found = re.findall(r"^  ([a-z]+) ", text[text.index("Subcommands:"):], re.M)
    assert "decode" in found and len(found) > 1, text
    return found


def check(scripts, folder, programs):
    checked = 0
    commands = commands_in_help(programs["posewire-cli"])
    for name, path in programs.items():
        contexts = [[]] + [[command] for command in commands if name == "posewire-cli"]
        for context in contexts:
            wanted = {o for o in options_in_help([path, *context]) if o.startswith("--")}
            offered = bash(scripts, " ".join([name, *context, "--"]), folder)
            assert offered == wanted, (name, context, offered ^ wanted)
            checked += 1
    cases = {"posewire-cli ": set(commands), "posewire-cli send --revision ": {"E", "J", "K", "N"},
             "posewire --theme ": {"dark", "light", "system"}, "posewire-cli send --rate ": set(),
             "posewire-cli decode ta": {"take.pcapng"}, "posewire-cli monitor --record ta": {"take.pcapng"},
             "posewire ta": {"take.pcapng"}, "posewire --layout Ch": {"Check"}, "posewire-cli reference ta": set()}
    for line, wanted in cases.items():
        offered = {hit for hit in bash(scripts, line, folder) if hit and not hit.startswith("-")}
        assert offered == wanted, (line, offered, wanted)
        checked += 1
    return checked


def main(scripts, posewire, cli):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "take.pcapng").touch()
        checked = check(scripts, folder, {"posewire": posewire, "posewire-cli": cli})
        print(f"{checked} lines completed as expected")
    return 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]), sys.argv[2], sys.argv[3]))
