#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs packaging/stage-demo, which has to leave nothing behind, and holds packaging/stage.md to what a probe publishes.

usage: stage_test.py SOURCE_DIR POSEWIRE_CLI
"""
import json
import os
import pathlib
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import time

SKIPPED = 77


def run_demo(demo, cli, folder):
    """The monitor lists the performers of all three probes; the folder for temporary files is empty at the end."""
    result = subprocess.run([demo, cli], env=dict(os.environ, TMPDIR=str(folder), DISPLAY="", WAYLAND_DISPLAY=""), capture_output=True, text=True, timeout=90, check=False)
    assert result.returncode == 0, result.stderr
    senders = set(re.findall(r"^(127\.0\.0\.1:\d+) \(udp\)", result.stdout, re.M)) or set(re.findall(r"STAGE-0\d", result.stdout))
    assert len(senders) == 3, (senders, result.stdout[-2000:], result.stderr)
    assert not list(folder.iterdir()), list(folder.iterdir())


def section(page, title):
    return re.search(rf"^### {title}\n(.*?)(?=^##|\Z)", page, re.M | re.S).group(1)


def table(page, title):
    """Words in backticks in the first column of a section's table."""
    rows = [line.split("|")[1] for line in section(page, title).splitlines() if line.startswith("|")]
    return set(re.findall(r"`([^`]+)`", "".join(rows)))


def wait_for_port(ports):
    for _ in range(100):
        for file in ports.glob("*.ports"):
            found = re.search(r'"nats://[^"]*:(\d+)"', file.read_text(encoding="utf-8"))
            if found:
                return int(found.group(1))
        time.sleep(0.1)
    raise AssertionError("the server does not start")


def messages(stream):
    """What a server of NATS sends: subject, headers, payload."""
    while line := stream.readline().decode():
        words = line.split()
        if words[:1] == ["MSG"]:
            yield words[1], "", stream.read(int(words[-1]) + 2)[:-2].decode()
        elif words[:1] == ["HMSG"]:
            whole = stream.read(int(words[-1]) + 2)[:-2]
            yield words[1], whole[:int(words[-2])].decode(), whole[int(words[-2]):]


def published(nats, cli, folder):
    """Members of a health message, names of a batch's headers, and the answer to a question for the time."""
    config = folder / "server.conf"
    config.write_text(f'listen: "127.0.0.1:-1"\njetstream {{ store_dir: "{folder}/streams", max_file: 100MB }}\n', encoding="utf-8")
    running = [subprocess.Popen([nats, "-c", config, "--ports_file_dir", folder], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)]
    try:
        port = wait_for_port(folder)
        server = ["--nats", f"nats://127.0.0.1:{port}", "--site", "TEST"]
        subprocess.run([cli, "stage", *server, "--keep", "1"], check=True, stdout=subprocess.DEVNULL)
        with socket.create_connection(("127.0.0.1", port), timeout=20) as connection:
            stream = connection.makefile("rb")
            connection.sendall(b'CONNECT {"verbose":false,"headers":true}\r\nSUB posewire.TEST.STAGE-A.* 1\r\nSUB _INBOX.time 2\r\n')
            probe = subprocess.Popen([cli, "probe", "--udp", "127.0.0.1:0", *server, "--name", "STAGE-A", "--spool", folder / "spool",
                                      "--verbose"], stderr=subprocess.PIPE, text=True)
            running.append(probe)
            place = re.search(r"listening on (\S+)", probe.stderr.readline()).group(1)
            running.append(subprocess.Popen([cli, "send", "--to", place, "--rate", "60"], stdout=subprocess.DEVNULL))
            health, headers, answer = set(), set(), ""
            for subject, head, payload in messages(stream):
                if subject.endswith(".health"):
                    health = set(json.loads(payload))
                    connection.sendall(b"PUB posewire.TEST.STAGE-A.clock _INBOX.time 0\r\n\r\n")
                elif subject.endswith(".batch"):
                    headers = set(re.findall(r"^([\w-]+):", head, re.M))
                elif subject == "_INBOX.time":
                    answer = payload
                if health and headers and answer:
                    return health, headers, int(answer)
        raise AssertionError("the server closed the connection")
    finally:
        for process in reversed(running):
            process.kill()
            process.wait()


def main(source, cli):
    nats = shutil.which("nats-server", path=os.environ.get("PATH", "") + ":/usr/sbin")
    if not nats:
        return SKIPPED
    page = (source / "packaging/stage.md").read_text(encoding="utf-8")
    with tempfile.TemporaryDirectory() as name:
        health, headers, now = published(nats, cli, pathlib.Path(name))
    assert health == table(page, "Health"), health ^ table(page, "Health")
    assert headers == table(page, "Batch"), headers ^ table(page, "Batch")
    assert abs(now - time.time_ns()) < 60e9, now
    with tempfile.TemporaryDirectory() as name:
        run_demo(source / "packaging/stage-demo", cli, pathlib.Path(name))
    return 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]), sys.argv[2]))
