# SPDX-License-Identifier: GPL-3.0-or-later
"""The window writes only in the folders that XDG names, and tells what it does where it is asked to."""

import os
import re
import signal
import socket
import subprocess
import sys
import tempfile
from pathlib import Path

LINE = re.compile(r"^\d\d:\d\d:\d\d\.\d{3} (posewire\.[a-z]+): (.+)$")


def start(program: str, folder: Path, *more: str) -> subprocess.Popen:
    for name in ("home", "config", "cache", "data", "run"):
        (folder / name).mkdir(mode=0o700, exist_ok=True)
    environment = {**os.environ, "QT_QPA_PLATFORM": "offscreen", "HOME": str(folder / "home"),
                   "XDG_CONFIG_HOME": str(folder / "config"), "XDG_CACHE_HOME": str(folder / "cache"),
                   "XDG_DATA_HOME": str(folder / "data"), "XDG_RUNTIME_DIR": str(folder / "run")}
    environment.pop("QT_LOGGING_RULES", None)
    return subprocess.Popen([program, *more], env=environment, cwd=folder / "run", stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, text=True)


def free_port() -> int:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def written(folder: Path) -> set:
    return {str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file()}


def told(window: subprocess.Popen) -> dict:
    """What was told up to the end, by category; the window is ended once it has drawn."""
    lines: dict = {}
    for line in window.stderr:
        found = LINE.match(line.rstrip("\n"))
        assert found, line
        lines.setdefault(found.group(1), []).append(found.group(2))
        if found.group(2).startswith("first picture"):
            window.send_signal(signal.SIGTERM)
    assert window.wait(timeout=30) == 0
    return lines


def check_verbose(program: str, folder: Path) -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as taken:
        taken.bind(("127.0.0.1", 0))
        port = taken.getsockname()[1]
        window = start(program, folder, "--verbose", "--no-tour", "--udp", f"127.0.0.1:{free_port()}", "--udp",
                       f"127.0.0.1:{port}")
        lines = told(window)
    assert set(lines) == {"posewire.inputs", "posewire.files", "posewire.settings", "posewire.drawing"}, lines
    inputs = lines["posewire.inputs"]
    assert inputs[0] == "listening to everyone", inputs
    assert sum(line.endswith("is open") for line in inputs) == 1, inputs
    assert sum(f"port {port}" in line and "in use" in line for line in inputs) == 1, inputs
    settings = folder / "config" / "Posewire" / "posewire" / "settings.json"
    assert lines["posewire.settings"] == [f"none in {settings}", f"written to {settings}"], lines
    assert lines["posewire.files"][0].startswith(f"history in {folder / 'cache' / 'Posewire' / 'posewire'}"), lines


def check_folders(program: str, folder: Path) -> None:
    check_verbose(program, folder)
    files = written(folder)
    assert "config/Posewire/posewire/settings.json" in files, files
    others = {path for path in files if not path.startswith(("config/Posewire/posewire/", "cache/"))}
    assert not others, others
    caches = {Path(path).parts[1] for path in files if path.startswith("cache/")}
    assert {name for name in caches if not name.startswith("mesa_shader_cache")} <= {"Posewire", "fontconfig"}, caches


def check_silence(program: str, folder: Path) -> None:
    window = start(program, folder, "--udp", f"127.0.0.1:{free_port()}", "--screenshot",
                   str(folder / "p.png"), "--after", "0")
    _, err = window.communicate(timeout=60)
    assert window.returncode == 0 and err == "", err


def main() -> int:
    for check in (check_folders, check_silence):
        with tempfile.TemporaryDirectory() as name:
            check(sys.argv[1], Path(name))
            print(check.__name__, "done", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
