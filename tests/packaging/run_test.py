#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""packaging/run on a computer without a display: a picture of the window, and the monitor's table in the terminal.

usage: run_test.py BUILD_FOLDER
The script runs in a tree of its own that has the programs of BUILD_FOLDER, so nothing is installed or built.
"""
import fcntl
import os
import pathlib
import pty
import re
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import termios
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
DEADLINE_S = 240  # of a busy computer


def free_port():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


def is_sent_to(port):
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as one:
        one.bind(("127.0.0.1", port))
        one.settimeout(0.5)
        try:
            return len(one.recv(65536)) > 0
        except TimeoutError:
            return False


class RunWithoutDisplay(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.tree = pathlib.Path(folder.name).resolve()
        (self.tree / "packaging").mkdir()
        (self.tree / "build").mkdir()
        (self.tree / "build/release").symlink_to(BUILD)
        for name in ("run", "progress"):
            shutil.copy(ROOT / "packaging" / name, self.tree / "packaging")
        for name in ("packaging/install-dependencies", "cmake"):
            (self.tree / name).write_text("#!/bin/sh\n")
            (self.tree / name).chmod(0o755)
        self.environment = {name: value for name, value in os.environ.items()
                            if name not in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM")}
        self.environment |= {"PATH": f"{self.tree}:{os.environ['PATH']}", "HOME": str(self.tree), "TERM": "xterm"}
        self.port = free_port()

    def start(self, *arguments, **places):
        process = subprocess.Popen([self.tree / "packaging/run", *arguments], env=self.environment,
                                   start_new_session=True, **places)
        self.addCleanup(lambda: process.poll() is None and os.killpg(process.pid, signal.SIGTERM))
        return process

    def run_to_end(self, *arguments):
        process = self.start(*arguments, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        text, _ = process.communicate(timeout=DEADLINE_S)
        return process.returncode, text.decode()

    def check_picture(self, text):
        named = re.search(r"A picture of the window: (\S+)", text)
        self.assertTrue(named, text)
        head = pathlib.Path(named[1]).read_bytes()[:24]
        self.assertEqual(head[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(struct.unpack(">II", head[16:]), (1600, 1000))

    def test_demo_ends_after_ten_seconds_if_its_output_is_no_terminal(self):
        start = time.monotonic()
        status, text = self.run_to_end("--demo=3", "--udp", f"127.0.0.1:{self.port}")
        self.assertEqual(status, 0, text)
        self.assertGreater(time.monotonic() - start, 10)
        self.check_picture(text)
        self.assertEqual(len(set(re.findall(r"^  \S.* \((\d)\)$", text, re.M))), 3, text)
        self.assertRegex(text, r"(?m)^1\d\.\d s   [1-9][\d\u202f]* datagrams ")
        self.assertFalse(is_sent_to(self.port))

    def test_demo_on_a_terminal_goes_on_until_ctrl_c(self):
        ours, theirs = pty.openpty()
        process = self.start("--demo", f"--udp=127.0.0.1:{self.port}", stdin=theirs, stdout=theirs, stderr=theirs,
                             preexec_fn=lambda: fcntl.ioctl(theirs, termios.TIOCSCTTY, 0))
        os.close(theirs)
        text = ""
        deadline = time.monotonic() + DEADLINE_S
        while not re.search(r"\x1b\[2K1\d\.\d s ", text):  # longer than without a terminal
            self.assertLess(time.monotonic(), deadline, text)
            text = (text + os.read(ours, 65536).decode(errors="replace")).replace("\r", "")
        self.check_picture(text)
        os.write(ours, b"\x03")
        self.assertEqual(process.wait(timeout=DEADLINE_S), 0)
        os.close(ours)
        self.assertFalse(is_sent_to(self.port))

    def test_other_options_are_those_of_the_monitor(self):
        status, text = self.run_to_end("--udp", f"127.0.0.1:{self.port}", "--duration", "0.2")
        self.assertEqual(status, 0, text)
        self.assertIn("No MXTP datagram so far", text)
        self.assertFalse((self.tree / "build/window.png").exists())
        status, text = self.run_to_end("--theme", "dark")
        self.assertEqual(status, 2, text)
        self.assertIn("--theme", text)
        status, text = self.run_to_end("--demo=none")
        self.assertEqual(status, 2, text)
        self.assertIn("--demo", text)


if __name__ == "__main__":
    unittest.main()
