#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Holds the source tree to its rules: who may include whom, no circle of folders, how long a file may be, how it begins.

usage: check_layout.py SOURCE_DIR | check_layout.py --self-test
Prints one line for each breach and exits 1 if there is one.
"""
import pathlib
import re
import sys

# A folder may include from itself and from the folders named here; "/*" is a folder without those in it. The first rule
# that matches a file counts.
MAY_INCLUDE = [
    ("core/wire", []),
    ("core/log", ["core/wire"]),
    ("core/words", ["core/model/*"]),
    ("core/model/body", ["core/wire", "core/log", "core/words", "core/model/*"]),
    ("core/model/accounting", ["core/wire", "core/log", "core/words", "core/model/*"]),
    ("core/model/session", ["core/wire", "core/log", "core/words", "core/model"]),
    ("core/model", ["core/wire", "core/log", "core/words"]),
    ("core/performer", ["core/wire", "core/log", "core/model/body"]),
    ("core/feed", ["core/wire", "core/log", "core/model", "core/field", "core/filter"]),
    ("core/export", ["core/wire", "core/log", "core/words", "core/model", "core/feed"]),
    ("core/field", ["core/wire", "core/log", "core/model"]),
    ("core/filter", ["core/wire", "core/field", "core/model/body"]),
    ("render", []),
    ("packaging/help", ["core/export", "app/gui/help", "app/gui/window"]),
    ("packaging/manual", ["app/cli", "app/gui/base", "app/usage"]),
    ("app/usage", []),
    ("app/system", []),
    ("app/net", ["core", "app/system"]),
    ("app/mvnx", ["core"]),
    ("app/figure", ["core", "render/mesh"]),
    ("app/import", ["render/mesh", "app/system"]),
    ("app/outlets", ["core", "app/net"]),
    ("app/stage", ["core", "app/net", "app/usage"]),
    ("app/cli", ["core", "app/mvnx", "app/net", "app/outlets", "app/stage", "app/figure", "app/system", "app/usage"]),
    ("app/gui/theme", []),
    ("app/gui/help", ["core", "app/gui/theme"]),
    ("app/gui/base", ["core", "app/net", "app/stage", "app/usage", "app/gui/theme"]),
    ("app/gui/models", ["core", "app/stage", "app/gui/base", "app/gui/theme"]),
    ("app/gui/plots", ["app/gui/theme"]),
    ("app/gui/panels", ["core", "app/gui/base", "app/gui/theme", "app/gui/models", "app/gui/plots", "app/gui/driver"]),
    ("app/gui/driver", ["core", "app/mvnx", "app/net", "app/outlets", "app/stage", "app/system", "app/gui/base"]),
    ("app/gui/viewport", ["core", "render", "app/net", "app/system", "app/gui/base", "app/gui/theme", "app/gui/models"]),
    ("app/gui/inputs", ["core", "app/net", "app/outlets", "app/gui/base", "app/gui/theme", "app/gui/models", "app/gui/panels", "app/gui/driver"]),
    ("app/gui", ["core", "app/net", "app/outlets", "app/figure", "app/system", "app/usage"]),
]
# What a folder must not include, although the table above would let it, or although it is no file of ours.
FORBIDDEN = [
    ("core", r"<Q[A-Z]|<Qt|<epoxy|<GL/|<glm|<sys/socket|<netinet|<iostream|<cstdio>", "Qt, OpenGL, sockets or printing"),
    ("render", r"<Q[A-Z]|<Qt|<Eigen|<sys/socket", "Qt, Eigen or sockets"),
    ("app", r"<epoxy|<GL/", "OpenGL entry points"),
    ("app/gui/panels", r"<qcustomplot", "the plotting library: app/gui/plots does"),
    ("app/cli", r"<QWidget|<QApplication|<QtWidgets|<sys/socket", "widgets or sockets"),
    ("app/gui", r"<sys/socket|<netinet|<QUdpSocket|<QTcpS", "sockets"),
]
# What only one system has is called in a unit that says so by its name, with a twin for the others beside it.
OF_A_SYSTEM = re.compile(r"<(unistd|fcntl|io|poll|signal|pthread|windows|winsock2|psapi|shellapi|iphlpapi|mstcpip|ws2tcpip|ifaddrs|"
                         r"sys/\w+|netinet/\w+|arpa/\w+|net/if|linux/\w+)\.h>")
SAYS_ITS_SYSTEM = re.compile(r"_(posix|linux|windows)\.cpp$")
LINUX_TWINS_OF_QT = ("app/net/kernel_socket.cpp", "app/net/kernel_socket.h", "app/net/recvmmsg_loop.cpp")
# Core may format text with snprintf; printing is what the rule is about.
ALLOWED_LINES = {("core/model", "<cstdio>")}
# What a sender wrote is plain text wherever it is shown: what would let Qt guess otherwise has one place. A tooltip is a
# literal of ours or comes through toolTipText().
PLAIN_TEXT = [
    (r"\bnew QLabel\b|\bQLabel \w+[;({]|\w\(new QLabel", "a label is made by plainLabel() or richLabel()"),
    (r"\bsetTextFormat\(|Qt::(Rich|Auto)Text\b|\bconvertFromPlainText\(|\bmightBeRichText\(",
     "plainLabel(), richLabel() and toolTipText() choose the format of a text"),
    (r"\bQMessageBox::(about|critical|information|question|warning)\(|\bQMessageBox \w+[;({]|\bnew QMessageBox\b",
     "a message is a MessageBox"),
    (r'\bsetToolTip\((?!\s*(\{\}|toolTipText\(|tr\((\s*"(\\.|[^"\\])*")+\s*\))\s*\)|\s*toolTipText\()',
     "a tooltip comes through toolTipText()"),
    (r"\bQToolTip::showText\((?![^;]*\btoolTipText\()", "a tooltip comes through toolTipText()"),
    (r"\bset(WhatsThis|StatusTip)\(", "nothing is shown there"),
]
PLAIN_TEXT_PLACES = ("app/gui/theme/widgets.cpp", "app/gui/theme/theme.cpp")
# HTML and Markdown of ours, with the names in it escaped.
MARKUP = re.compile(r"\b(setHtml|setMarkdown|insertHtml|appendHtml)\(|\brichLabel\(")
MARKUP_PLACES = PLAIN_TEXT_PLACES + ("app/gui/theme/widgets.h", "app/gui/panels/inspector_panel.cpp",
                                     "app/gui/panels/nullpose_panel.cpp", "app/gui/inputs/inputs_dialog.cpp",
                                     "app/gui/viewport/pose_banner.cpp", "app/gui/viewport/segment_card.cpp",
                                     "app/gui/window/preferences.cpp",
                                     # Texts of the program itself: the guide and the reference.
                                     "app/gui/help/help_pages.cpp", "app/gui/help/help_window.cpp")
PANEL_HEADER = re.compile(r'"app/gui/panels/(\w+_panel)\.h"')
MAY_INCLUDE_PANELS = ("app/gui/panels/panels.cpp", "app/gui/window/main_window.cpp", "tests/")
LIMITS = [("tests/", 600), (".h", 300), (".cpp", 500)]
SOURCES = (".h", ".cpp")
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<][^">]+[">])', re.M)


def is_in(target, folder):
    if folder.endswith("/*"):
        return str(pathlib.PurePosixPath(target).parent) == folder[:-2]
    return target.startswith(folder + "/")


def rule_for(path, rules):
    return next((rule for rule in rules if path.startswith(rule[0] + "/")), None)


def breaches(path, text):
    """All breaches of one file; `path` is relative to the source folder, with slashes."""
    found = []
    includes = INCLUDE.findall(text)
    rule = rule_for(path, MAY_INCLUDE)
    for include in includes:
        target = include[1:-1]
        ours = include.startswith('"') and "/" in target  # without a folder: generated by the build
        if rule and ours:
            allowed = [rule[0]] + rule[1]
            if not any(is_in(target, folder) for folder in allowed):
                found.append(f"{path}: {rule[0]} must not include {target}")
        panel = PANEL_HEADER.match(include)
        # A panel may be written in several files: packets_panel.cpp, packets_menu.cpp, …
        own = panel and pathlib.PurePath(path).stem.startswith(panel.group(1).removesuffix("panel"))
        if panel and not own and not path.startswith(MAY_INCLUDE_PANELS):
            found.append(f"{path}: only panels.cpp and main_window.cpp may include {target}")
        if path.startswith(("core/", "app/")) and OF_A_SYSTEM.match(include) and path not in LINUX_TWINS_OF_QT \
                and not SAYS_ITS_SYSTEM.search(path):
            found.append(f"{path}: only a unit named after a system may include {include}")
        for folder, pattern, what in FORBIDDEN:
            allowed_here = any(path.startswith(p + "/") and line == include for p, line in ALLOWED_LINES)
            if path.startswith(folder + "/") and re.match(pattern, include) and not allowed_here:
                found.append(f"{path}: {folder} must not include {what}: {include}")
    if path.startswith("app/") and path not in PLAIN_TEXT_PLACES:
        found += [f"{path}: {why}: {match.group()}" for pattern, why in PLAIN_TEXT for match in re.finditer(pattern, text)]
    if path.startswith("app/") and path not in MARKUP_PLACES and (markup := MARKUP.search(text)):
        found.append(f"{path}: this file writes no HTML: {markup.group()}")
    limit = next((most for mark, most in LIMITS if path.startswith(mark) or path.endswith(mark)), None)
    lines = text.count("\n")
    if limit and lines > limit:
        found.append(f"{path}: {lines} lines, the limit is {limit}")
    uses_app = any(include.startswith('"app/') for include in includes)
    licence = "GPL-3.0-or-later" if path.startswith(("app/", "tests/app/")) or uses_app else "MIT"
    if not text.startswith(f"// SPDX-License-Identifier: {licence}\n"):
        found.append(f"{path}: the first line must be '// SPDX-License-Identifier: {licence}'")
    if path.endswith(".h") and "#pragma once" not in text[:200]:
        found.append(f"{path}: no #pragma once")
    return found


def cycles(texts):
    """The folders that include each other, directly or by way of others; `texts` by path."""
    uses = {}
    for path, text in texts.items():
        folder = str(pathlib.PurePosixPath(path).parent)
        targets = {str(pathlib.PurePosixPath(include[1:-1]).parent) for include in INCLUDE.findall(text)
                   if include.startswith('"') and "/" in include}
        uses.setdefault(folder, set()).update(targets - {folder})
    # What is used by no other of those that are left is in no circle, nor what uses no other of them.
    while ends := [folder for folder in uses
                   if not uses[folder] & uses.keys() or not any(folder in other for other in uses.values())]:
        for folder in ends:
            del uses[folder]
    return [f"folders in a circle: {', '.join(sorted(uses))}"] if uses else []


def self_test():
    head = "// SPDX-License-Identifier: MIT\n#pragma once\n"
    gpl = "// SPDX-License-Identifier: GPL-3.0-or-later\n"
    cases = [
        ("core/wire/a.h", head + '#include "core/log/packet.h"\n', 1),
        ("core/log/a.h", head + '#include "core/wire/header.h"\n', 0),
        ("core/log/a.h", head + "#include <QString>\n", 1),
        ("core/field/a.h", head + '#include "core/model/body/segments.h"\n', 0),
        ("core/model/session/a.h", head + '#include "core/filter/filter.h"\n', 1),
        ("core/model/body/a.h", head + '#include "core/model/accounting/stream.h"\n', 1),
        ("core/model/accounting/a.h", head + '#include "core/model/body/segments.h"\n', 1),
        ("core/model/session/a.h", head + '#include "core/model/body/segments.h"\n', 0),
        ("render/a.h", head + '#include "core/wire/header.h"\n', 1),
        ("app/gui/a.cpp", gpl + "#include <epoxy/gl.h>\n", 1),
        ("app/gui/a.cpp", gpl + "#include <unistd.h>\n", 1),
        ("core/log/a.cpp", head.replace("#pragma once\n", "") + "#include <sys/mman.h>\n", 1),
        ("core/log/a_linux.cpp", head.replace("#pragma once\n", "") + "#include <sys/mman.h>\n", 0),
        ("app/gui/panels/a.cpp", gpl + '#include "app/gui/base/commands.h"\n', 0),
        ("app/gui/panels/a.cpp", gpl + '#include "app/gui/window/main_window.h"\n', 1),
        ("app/gui/panels/a_panel.cpp", gpl + '#include "app/gui/panels/b_panel.h"\n', 1),
        ("app/gui/panels/a_panel.cpp", gpl + '#include "app/gui/panels/a_panel.h"\n', 0),
        ("app/gui/panels/a_menu.cpp", gpl + '#include "app/gui/panels/a_panel.h"\n', 0),
        ("app/gui/panels/a_panel.cpp", gpl + '#include "app/gui/panels/table_view.h"\n', 0),
        ("tests/bench/a.cpp", gpl + '#include "app/net/udp_receiver.h"\n', 0),
        ("core/wire/a.h", head + "\n" * 300, 1),
        ("app/gui/a.cpp", "// SPDX-License-Identifier: MIT\n", 1),
        ("core/wire/a.h", "// SPDX-License-Identifier: MIT\n", 1),
        ("app/gui/a.cpp", gpl + "auto* label = new QLabel(text, this);\n", 1),
        ("app/gui/a.cpp", gpl + "    : m_label(new QLabel(this)) {\n", 1),
        ("app/gui/a.cpp", gpl + "QLabel label(name);\n", 1),
        ("app/gui/a.h", gpl + "#pragma once\nclass QLabel;\nQLabel* m_label;\nvoid colour(QLabel& label);\n", 0),
        ("app/gui/theme/widgets.cpp", gpl + "auto* label = new QLabel(parent);\n", 0),
        ("app/gui/a.cpp", gpl + "label->setTextFormat(Qt::RichText);\n", 2),
        ("app/gui/a.cpp", gpl + "QMessageBox::warning(this, title, problem);\n", 1),
        ("app/gui/a.cpp", gpl + "button->setToolTip(name);\n", 1),
        ("app/gui/a.cpp", gpl + 'button->setToolTip(tr("Of %1").arg(name));\n', 1),
        ("app/gui/a.cpp", gpl + 'button->setToolTip(\n    tr("One \\"word\\" "\n       "and two"));\n', 0),
        ("app/gui/a.cpp", gpl + "button->setToolTip({});\nbutton->setToolTip(toolTipText(name));\n", 0),
        ("app/gui/a.cpp", gpl + "QToolTip::showText(at, name, this);\n", 1),
        ("app/gui/a.cpp", gpl + "QToolTip::showText(at, toolTipText(name), this);\n", 0),
        ("app/gui/a.cpp", gpl + "browser->setHtml(name);\n", 1),
    ]
    for path, text, expected in cases:
        found = breaches(path, text)
        assert len(found) == expected, (path, text[:80], found)
    files = {"app/gui/a/x.h": '#include "app/gui/b/x.h"\n', "app/gui/b/x.h": '#include "app/gui/b/y.h"\n',
             "app/gui/b/y.cpp": '#include "app/gui/c/x.h"\n', "app/net/x.h": '#include "app/gui/a/x.h"\n'}
    assert cycles(files) == [], cycles(files)
    files["app/gui/c/x.h"] = '#include "app/gui/a/x.h"\n'
    assert cycles(files) == ["folders in a circle: app/gui/a, app/gui/b, app/gui/c"], cycles(files)
    print(f"{len(cases) + 2} cases as expected")
    return 0


def main(arguments):
    if arguments == ["--self-test"]:
        return self_test()
    root = pathlib.Path(arguments[0])
    found = []
    acyclic = {}
    for folder in ("core", "render", "app", "packaging/help", "tests"):
        for file in sorted((root / folder).rglob("*")):
            if file.suffix in SOURCES:
                path = file.relative_to(root).as_posix()
                text = file.read_text(encoding="utf-8")
                found += breaches(path, text)
                if folder in ("core", "app"):
                    acyclic[path] = text
    found += cycles(acyclic)
    print("\n".join(found) if found else "every file keeps the rules")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
