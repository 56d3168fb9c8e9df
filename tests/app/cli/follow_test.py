#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads what `follow` sends: by the program that the guide shows, by a Unix socket, by standard output, and beside a
receiver that never reads.

usage: follow_test.py POSEWIRE_CLI GUIDE_PAGE
"""
import json
import os
import pathlib
import re
import signal
import socket
import subprocess
import sys
import tempfile

CHARACTERS = 2
LINES = 60


def free_port():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


class Following:
    """posewire-cli follow, with performers that send to it."""

    def __init__(self, cli, *options):
        port = free_port()
        self.program = subprocess.Popen([cli, "follow", "--udp", f"127.0.0.1:{port}", *options], text=True,
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.place = ""
        if options:
            self.place = re.search(r"to (\S+)", self.program.stderr.readline()).group(1)
        self.sender = subprocess.Popen([cli, "send", "--to", f"127.0.0.1:{port}", "--characters", str(CHARACTERS),
                                        "--rate", "60", "--types", "02,12,13"], stdout=subprocess.DEVNULL)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.sender.kill()
        self.sender.wait()
        self.program.send_signal(signal.SIGINT)
        self.program.communicate(timeout=20)
        assert self.program.returncode == 0, self.program.returncode

    def port(self):
        return int(self.place.rpartition(":")[2])


def check(poses):
    """In order, each once, of upright people."""
    newest = {}
    for name, sample, height in poses:
        assert newest.get(name, sample - 1) == sample - 1, (name, sample, newest[name])
        assert 1.2 < height < 2.1, height
        newest[name] = sample
    assert len(newest) >= CHARACTERS, newest


def told(line):
    pose = json.loads(line)
    head = next(each for each in pose["segments"] if each["name"] == "Head")
    assert head["from"] == "sent" and abs(sum(part * part for part in head["orientation"]) - 1) < 1e-5
    return f'{pose["source"]} {pose["id"]}', pose["sample"], head["position"][2]


def by_the_guide(cli, page):
    code = re.search(r"```python\n(.*?)```", page.read_text(encoding="utf-8"), re.S).group(1)
    assert len([line for line in code.splitlines() if line.strip()]) <= 10
    with Following(cli, "--to", "127.0.0.1:0") as following:
        reader = subprocess.Popen([sys.executable, "-u", "-c", code.replace("9800", str(following.port()))], text=True,
                                  stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        lines = [reader.stdout.readline() for _ in range(LINES)]
        reader.kill()
        reader.communicate()
    poses = [re.fullmatch(r"(.+) (\d+): head at (\S+) (\S+) (\S+) m\n", line).groups() for line in lines]
    assert {name for name, *_ in poses} >= {"Mira Lindqvist", "Jonas Adeyemi"}, poses
    check([(name, int(sample), float(z)) for name, sample, _, _, z in poses if not name.startswith("Character")])


def by_a_unix_socket(cli):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "poses")
        with Following(cli, "--to", "unix:" + path), socket.socket(socket.AF_UNIX) as connection:
            assert os.stat(path).st_mode & 0o077 == 0
            connection.connect(path)
            with connection.makefile(encoding="utf-8") as lines:
                check([told(lines.readline()) for _ in range(LINES)])
        assert not os.path.exists(path)


def beside_one_that_never_reads(cli):
    with Following(cli, "--to", "127.0.0.1:0") as following:
        with socket.create_connection(("127.0.0.1", following.port())), \
             socket.create_connection(("127.0.0.1", following.port())) as connection, \
             connection.makefile(encoding="utf-8") as lines:
            check([told(lines.readline()) for _ in range(5 * LINES)])


def by_standard_output(cli):
    with Following(cli) as following:
        check([told(following.program.stdout.readline()) for _ in range(LINES)])


def main(cli, page):
    by_the_guide(cli, page)
    by_a_unix_socket(cli)
    beside_one_that_never_reads(cli)
    by_standard_output(cli)
    with tempfile.NamedTemporaryFile() as file:
        refused = subprocess.run([cli, "follow", "--to", "unix:" + file.name, "--duration", "1", "--udp", "127.0.0.1:0"],
                                 capture_output=True, text=True, timeout=20, check=False)
        assert refused.returncode == 2 and file.name in refused.stderr, refused
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], pathlib.Path(sys.argv[2])))
