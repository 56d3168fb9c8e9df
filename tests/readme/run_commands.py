#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs every command of the README, as it stands there.

usage: run_commands.py SOURCE_DIR

`packaging/run` is started under an X server of its own and must put its window on the screen; `packaging/test` is what
runs this script, so it is only checked to be what continuous integration runs. All others must end with status 0.
"""
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time

WINDOW_DEADLINE_S = 900  # it builds first


def commands(readme):
    blocks = re.findall(r"```sh\n(.*?)```", readme, re.S)
    return [line for block in blocks for line in block.splitlines() if line.strip()]


def run_monitor(root, command):
    """The window must appear on a bare X server. Returns a text where it does not."""
    with tempfile.TemporaryDirectory() as home:
        cache = os.environ.get("CCACHE_DIR", str(pathlib.Path.home() / ".cache" / "ccache"))
        environment = dict(os.environ, HOME=home, XDG_RUNTIME_DIR=home, CCACHE_DIR=cache)
        environment.pop("QT_QPA_PLATFORM", None)
        inner = f'{command} & wait_for=$!; while kill -0 $wait_for 2>/dev/null; do sleep 0.5; ' \
                'xdotool search --onlyvisible --name Posewire >/dev/null 2>&1 && { sleep 3; ' \
                'kill -0 $wait_for && echo WINDOW; kill $wait_for; wait $wait_for; exit 0; }; done; exit 1'
        xvfb = ["xvfb-run", "-a", "-s", "-screen 0 1600x1000x24", "bash", "-c", inner]
        process = subprocess.Popen(xvfb, cwd=root, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                   text=True, start_new_session=True)
        try:
            output, _ = process.communicate(timeout=WINDOW_DEADLINE_S)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            return f"no window after {WINDOW_DEADLINE_S} s"
        return None if "WINDOW" in output else "no window; it printed:\n" + output[-2000:]


def run_plain(root, command):
    result = subprocess.run(["bash", "-c", command], cwd=root, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                            text=True, timeout=120, check=False)
    return None if result.returncode == 0 else f"status {result.returncode}; it printed:\n" + result.stdout[-2000:]


def check_test_command(root, command):
    script = (root / ".ci" / "run").read_text(encoding="utf-8")
    runs = os.access(root / command, os.X_OK) and re.search(rf"^exec {re.escape(command)}$", script, re.M)
    return None if runs else ".ci/run does not run it"


def main(root):
    failures = 0
    found = commands((root / "README.md").read_text(encoding="utf-8"))
    for command in found:
        start = time.monotonic()
        runner = {"packaging/run": run_monitor, "packaging/test": check_test_command}.get(command, run_plain)
        problem = runner(root, command)
        failures += problem is not None
        print(f"{'FAILED' if problem else 'ok':6} {time.monotonic() - start:6.1f} s  {command}", flush=True)
        if problem:
            print(problem)
    if len(found) < 3:
        print("the README has fewer commands than expected: has its form changed?")
        return 1
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve()))
