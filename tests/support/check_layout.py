#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Holds the source tree to its rules: who may include whom, how long a file may be, how it begins.

usage: check_layout.py SOURCE_DIR | check_layout.py --self-test
Prints one line for each breach and exits 1 if there is one.
"""
import pathlib
import re
import sys

# A folder may include from itself and from the folders named here. The first rule that matches a file counts.
MAY_INCLUDE = [
    ("core/wire", []),
    ("core/log", ["core/wire"]),
    ("core/model", ["core/wire", "core/log"]),
    ("core/performer", ["core/wire", "core/log", "core/model"]),
    ("core/export", ["core/wire", "core/log", "core/model"]),
    ("render", []),
    ("app/net", ["core"]),
    ("app/cli", ["core", "app/net"]),
    ("app/gui/models", ["core", "app/gui"]),
    ("app/gui/panels", ["core", "app/gui"]),
    ("app/gui", ["core", "render", "app/net"]),
]
# What a folder must not include, although the table above would let it, or although it is no file of ours.
FORBIDDEN = [
    ("core", r"<Q[A-Z]|<Qt|<epoxy|<GL/|<glm|<sys/socket|<netinet|<iostream|<cstdio>", "Qt, OpenGL, sockets or printing"),
    ("render", r"<Q[A-Z]|<Qt|<Eigen|<sys/socket", "Qt, Eigen or sockets"),
    ("app", r"<epoxy|<GL/", "OpenGL entry points"),
    ("app/cli", r"<QWidget|<QApplication|<QtWidgets|<sys/socket", "widgets or sockets"),
    ("app/gui", r"<sys/socket|<netinet|<QUdpSocket|<QTcpS", "sockets"),
]
# Core may format text with snprintf; printing is what the rule is about.
ALLOWED_LINES = {("core/model", "<cstdio>")}
PANEL_HEADER = re.compile(r'"app/gui/panels/(\w+)\.h"')
MAY_INCLUDE_PANELS = ("app/gui/panels/panels.cpp", "app/gui/main_window.cpp", "tests/")
LIMITS = [("tests/", 600), (".h", 300), (".cpp", 500)]
SOURCES = (".h", ".cpp")
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<][^">]+[">])', re.M)


def rule_for(path, rules):
    return next((rule for rule in rules if path.startswith(rule[0] + "/")), None)


def breaches(path, text):
    """All breaches of one file; `path` is relative to the source folder, with slashes."""
    found = []
    includes = INCLUDE.findall(text)
    rule = rule_for(path, MAY_INCLUDE)
    for include in includes:
        target = include[1:-1]
        ours = include.startswith('"')
        if rule and ours:
            allowed = [rule[0]] + rule[1]
            if not any(target.startswith(folder + "/") for folder in allowed):
                found.append(f"{path}: {rule[0]} must not include {target}")
        panel = PANEL_HEADER.match(include)
        own = panel and pathlib.PurePath(path).stem == panel.group(1)
        if panel and not own and not path.startswith(MAY_INCLUDE_PANELS):
            found.append(f"{path}: only panels.cpp and main_window.cpp may include {target}")
        for folder, pattern, what in FORBIDDEN:
            allowed_here = any(path.startswith(p + "/") and line == include for p, line in ALLOWED_LINES)
            if path.startswith(folder + "/") and re.match(pattern, include) and not allowed_here:
                found.append(f"{path}: {folder} must not include {what}: {include}")
    limit = next((most for mark, most in LIMITS if path.startswith(mark) or path.endswith(mark)), None)
    lines = text.count("\n")
    if limit and lines > limit:
        found.append(f"{path}: {lines} lines, the limit is {limit}")
    licence = "GPL-3.0-or-later" if path.startswith(("app/", "tests/app/")) else "MIT"
    if not text.startswith(f"// SPDX-License-Identifier: {licence}\n"):
        found.append(f"{path}: the first line must be '// SPDX-License-Identifier: {licence}'")
    if path.endswith(".h") and "#pragma once" not in text[:200]:
        found.append(f"{path}: no #pragma once")
    return found


def self_test():
    head = "// SPDX-License-Identifier: MIT\n#pragma once\n"
    gpl = "// SPDX-License-Identifier: GPL-3.0-or-later\n"
    cases = [
        ("core/wire/a.h", head + '#include "core/log/packet.h"\n', 1),
        ("core/log/a.h", head + '#include "core/wire/header.h"\n', 0),
        ("core/log/a.h", head + "#include <QString>\n", 1),
        ("render/a.h", head + '#include "core/wire/header.h"\n', 1),
        ("app/gui/a.cpp", gpl + "#include <epoxy/gl.h>\n", 1),
        ("app/gui/panels/a.cpp", gpl + '#include "app/gui/panels/b.h"\n', 1),
        ("app/gui/panels/a.cpp", gpl + '#include "app/gui/panels/a.h"\n', 0),
        ("core/wire/a.h", head + "\n" * 300, 1),
        ("app/gui/a.cpp", "// SPDX-License-Identifier: MIT\n", 1),
        ("core/wire/a.h", "// SPDX-License-Identifier: MIT\n", 1),
    ]
    for path, text, expected in cases:
        found = breaches(path, text)
        assert len(found) == expected, (path, text[:80], found)
    print(f"{len(cases)} cases as expected")
    return 0


def main(arguments):
    if arguments == ["--self-test"]:
        return self_test()
    root = pathlib.Path(arguments[0])
    found = []
    for folder in ("core", "render", "app", "tests"):
        for file in sorted((root / folder).rglob("*")):
            if file.suffix in SOURCES:
                path = file.relative_to(root).as_posix()
                found += breaches(path, file.read_text(encoding="utf-8"))
    print("\n".join(found) if found else "every file keeps the rules")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
