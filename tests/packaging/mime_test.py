#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds a database of MIME types from ours alone and asks it for files of each kind, by name and by content. What the
desktop file opens must be declared by us or known to every desktop.

usage: mime_test.py DESKTOP_FOLDER GOLDEN_FOLDER
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77
KNOWN_TO_EVERY_DESKTOP = {"application/vnd.tcpdump.pcap"}


def type_of(path, data_home):
    environment = dict(os.environ, XDG_DATA_HOME=str(data_home), XDG_DATA_DIRS=str(data_home), LC_ALL="C.UTF-8")
    text = subprocess.run(["gio", "info", "-a", "standard::content-type", str(path)], check=True, capture_output=True,
                          text=True, env=environment).stdout
    return re.search(r"standard::content-type: (\S+)", text).group(1)


def main(desktop, golden):
    if not shutil.which("update-mime-database") or not shutil.which("gio"):
        return SKIPPED
    opened = set(re.search(r"^MimeType=(.*);$", (desktop / "org.posewire.posewire.desktop").read_text(), re.M).group(1).split(";"))
    declared = set(re.findall(r'<mime-type type="([^"]+)"', (desktop / "posewire.xml").read_text()))
    assert opened == declared | KNOWN_TO_EVERY_DESKTOP, (opened, declared)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        packages = folder / "mime" / "packages"
        packages.mkdir(parents=True)
        shutil.copy(desktop / "posewire.xml", packages)
        subprocess.run(["update-mime-database", str(folder / "mime")], check=True)
        for hexadecimal in sorted(golden.glob("*.hex")):
            digits = re.sub(r"#.*|\s", "", hexadecimal.read_text(encoding="utf-8"))
            datagram = folder / "datagram"
            datagram.write_bytes(bytes.fromhex(digits))
            found = type_of(datagram, folder)
            unknown = hexadecimal.name.startswith("77")
            assert (found == "application/x-mxtp") != unknown, (hexadecimal.name, found)
        capture = folder / "capture"
        for order in ("big", "little"):
            section = b"\x0a\x0d\x0d\x0a" + (28).to_bytes(4, order) + (0x1A2B3C4D).to_bytes(4, order) + bytes(16)
            capture.write_bytes(section)
            assert type_of(capture, folder) == "application/x-pcapng", order
        capture.rename(folder / "take.pcapng")
        assert type_of(folder / "take.pcapng", folder) == "application/x-pcapng"
    return 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])))
