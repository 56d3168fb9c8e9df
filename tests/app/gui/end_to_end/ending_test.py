# SPDX-License-Identifier: GPL-3.0-or-later
"""The window, ended by signals: it keeps its settings; and what it writes replaces nothing unasked."""

import json
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path


def start(program: str, folder: Path, *more: str) -> subprocess.Popen:
    environment = {**os.environ, "QT_QPA_PLATFORM": "offscreen", "XDG_RUNTIME_DIR": str(folder)}
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        place = f"127.0.0.1:{probe.getsockname()[1]}"
    return subprocess.Popen([program, "--settings", str(folder / "settings.json"), "--udp", place, "--no-tour",
                             *more],
                            env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def check_signals(program: str, folder: Path) -> None:
    for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
        settings = folder / "settings.json"
        settings.unlink(missing_ok=True)
        window = start(program, folder, "--startup-time")
        assert "window on screen" in window.stdout.readline()
        time.sleep(0.5)
        window.send_signal(number)
        window.communicate(timeout=30)
        assert window.returncode == 0, number
        assert json.loads(settings.read_text())["docks"], number


def check_screenshot(program: str, folder: Path) -> None:
    picture, take = folder / "p.png", folder / "take.png"
    picture.write_text("precious")
    take.write_text("MXTP")
    (folder / "settings.json").write_text("MXTP")
    for arguments, words in ((["--screenshot", str(picture)], "exists already"),
                             (["--screenshot", str(take), str(take), "--force"], "is an input as well"),
                             ([str(folder / "settings.json"), "--screenshot", str(folder / "new.png")],
                              "is an input as well")):
        window = start(program, folder, *arguments)
        _, err = window.communicate(timeout=30)
        assert window.returncode == 2 and words in err, (arguments, err)
    assert picture.read_text() == "precious" and take.read_text() == "MXTP"
    window = start(program, folder, "--screenshot", str(picture), "--force", "--after", "0.5")
    _, err = window.communicate(timeout=60)
    assert window.returncode == 0 and picture.read_bytes().startswith(b"\x89PNG"), err
    again = start(program, folder, "--screenshot", str(picture), "--after", "0.5")  # an earlier picture may go
    _, err = again.communicate(timeout=60)
    assert again.returncode == 0, err


def check_display(program: str, folder: Path) -> None:
    environment = {name: value for name, value in os.environ.items()
                   if name not in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM")}
    window = subprocess.run([program, "--settings", str(folder / "settings.json")], env=environment,
                            capture_output=True, text=True, timeout=30, check=False)
    assert window.returncode == 2 and window.stderr.count("\n") == 1, (window.returncode, window.stderr)


def check_crash(program: str, folder: Path) -> None:
    """Whatever ends the program, the next one begins with the settings of this one."""
    settings = folder / "settings.json"
    window = start(program, folder, "--startup-time", "--layout", "Inspect")
    assert "window on screen" in window.stdout.readline()
    end = time.monotonic() + 20
    while not settings.exists() and time.monotonic() < end:
        time.sleep(0.1)
    window.kill()
    window.communicate(timeout=30)
    assert json.loads(settings.read_text())["layout"] == "Inspect"


def main() -> int:
    for check in (check_signals, check_screenshot, check_display, check_crash):
        with tempfile.TemporaryDirectory() as name:
            check(sys.argv[1], Path(name))
            print(check.__name__, "done", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
