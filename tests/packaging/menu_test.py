#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Lets the portable folder's add-to-menu enter a program whose folder has an awkward name, starts it as a desktop does, and takes it out.

usage: menu_test.py SOURCE_DIR   (skipped without `gio`)
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

AWKWARD = 'a "folder" of $HOME, all `mine` \\ yours'


def main(source):
    if not shutil.which("gio"):
        print("gio is not installed")
        return 77
    with tempfile.TemporaryDirectory() as name:
        place = pathlib.Path(name)
        folder, data, started = place / AWKWARD, place / "data", place / "started"
        for file, target in (("packaging/portable-menu", "add-to-menu"), ("resources/icons/posewire.svg", "share/icons/hicolor/scalable/apps/posewire.svg"),
                             ("packaging/desktop/org.posewire.posewire.desktop", "share/applications/org.posewire.posewire.desktop"),
                             ("packaging/desktop/posewire.xml", "share/mime/packages/posewire.xml")):
            (folder / target).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source / file, folder / target)
        program = folder / "posewire"
        program.write_text(f'#!/bin/sh\necho "$@" >"{started}.part" && mv "{started}.part" "{started}"\n', encoding="utf-8")
        program.chmod(0o755)
        environment = dict(os.environ, XDG_DATA_HOME=str(data))

        subprocess.run([folder / "add-to-menu"], env=environment, check=True)
        entry = data / "applications/org.posewire.posewire.desktop"
        assert (data / "icons/hicolor/scalable/apps/posewire.svg").is_file() and (data / "mime/packages/posewire.xml").is_file()
        if shutil.which("desktop-file-validate"):
            subprocess.run(["desktop-file-validate", entry], check=True)
        subprocess.run(["gio", "launch", entry, "/some take.pcapng"], env=environment, check=True)
        deadline = time.monotonic() + 20
        while not started.exists() and time.monotonic() < deadline:
            time.sleep(0.02)
        assert started.read_text(encoding="utf-8") == "/some take.pcapng\n"

        subprocess.run([folder / "add-to-menu", "--remove"], env=environment, check=True)
        left = [path for path in data.rglob("*posewire*") if path.is_file()]
        assert not left, left
        assert subprocess.run([folder / "add-to-menu", "--elsewhere"], env=environment, stderr=subprocess.DEVNULL, check=False).returncode == 2
    return 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
