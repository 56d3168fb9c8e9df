#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""posewire-import reads hostile files: each ends in a character, in a sentence or in a crash, within 30 s and 1 GB, and
no file outside its folder is opened. Files of ../shared/cases/characters.py are read too, if that is there.

usage: hostile_files_test.py PROGRAM SOURCE_FOLDER
"""
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

MOST_SECONDS = 32
MOST_KIB = 1 << 20
# Files that have to be refused with a sentence, or read in spite of what they name, whatever the importer does.
READ = {"base.glb"} | {f"tex_{kind}.glb" for kind in ("etc", "dots", "abs", "proc", "zero", "http", "unc", "link", "big", "fifo")}
REFUSED = {"a.bvh", "a.md5mesh", "a.ply", "a.stl", "a.x", "bomb.zae", "bomb.3mf", "loop.glb", "selfloop.glb", "count.glb",
           "buf_etc.gltf", "buf_dots.gltf", "buf_zero.gltf", "buf_fifo.gltf", "trunc1.glb", "fifo.png", "l.png"}


def read(program, path):
    """Returns status, standard output, standard error, seconds and the peak of memory in KiB."""
    began = time.monotonic()
    child = subprocess.Popen([program, path], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    out, error = child.stdout.read(), child.stderr.read()
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    return child.returncode, out, error, time.monotonic() - began, usage.ru_maxrss


def check(program, path):
    status, out, error, seconds, kib = read(program, path)
    told = f"{path.name}: status {status}, {seconds:.1f} s, {kib} KiB, {len(out)} bytes {out[:80]!r} {error!r}"
    print(told)
    assert seconds <= MOST_SECONDS and kib <= MOST_KIB, told
    assert re.fullmatch(rb"(no )?Landlock[ 0-9]*, (no )?seccomp\n|none\n", error) or error.count(b"\n") <= 4, told
    if status == 0:
        assert out.startswith(b"PWCHAR\0\2"), told
    elif status in (1, 2):
        assert 0 < len(out) < 500 and out.decode().isprintable(), told
    else:
        assert status in (-signal.SIGSEGV, -signal.SIGABRT, -signal.SIGBUS), told
    assert path.name not in READ or status == 0, told
    assert path.name not in REFUSED or status == 1, told
    return status


def check_folder(program, folder):
    files = sorted(path for path in folder.iterdir() if not path.is_dir())
    statuses = [check(program, path) for path in files]
    assert 0 in statuses and 1 in statuses and min(statuses) < 0, "the files are not as hostile as they were"


def check_opened(program, folder):
    """Once the confinement is written, every file that is looked at lies in the folder of the character."""
    for name in ("base.glb", "tex_etc.glb", "tex_dots.glb", "tex_link.glb", "tex_big.glb", "buf_proc.gltf"):
        run = subprocess.run(["strace", "-f", "-e", "trace=file,network,write", "-s", "400", program, folder / name], capture_output=True,
                             text=True, errors="replace")
        if "ptrace" in run.stderr and "not permitted" in run.stderr:
            return
        confined = run.stderr.split("write(2,", 1)[1]
        places = {pathlib.Path(place) for place in re.findall(r'^[^"\n]*\("([^"]+)"|AT_FDCWD, "([^"]+)"', confined, re.M)
                  for place in place if place}
        assert folder / name in places, confined
        for place in places:
            assert place.is_relative_to(folder) or folder.is_relative_to(place), (name, place)
        assert "socket(" not in confined, name


def main(program, source):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name).resolve()
        generator = pathlib.Path(source) / "tests/support/hostile_characters.py"
        subprocess.run([sys.executable, generator, folder / "ours"], check=True)
        check_folder(program, folder / "ours")
        if shutil.which("strace"):
            check_opened(program, folder / "ours")
        shared = pathlib.Path(source).parent / "shared/cases/characters.py"
        if shared.is_file():
            subprocess.run([sys.executable, shared, pathlib.Path(source) / "resources/mannequin_low.glb", folder / "shared"],
                           check=True)
            check_folder(program, folder / "shared")
        else:
            print(f"without {shared}")


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2])
