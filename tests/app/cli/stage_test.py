#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Probes, servers of NATS that die, and what comes at the other end.

usage: stage_test.py POSEWIRE_CLI [POSEWIRE]
"""
import contextlib
import json
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import urllib.request

CLI = sys.argv[1]
SKIPPED = 77
PATIENCE = 60  # seconds
SITE = ["--site", "SITE"]


def free_port(kind=socket.SOCK_DGRAM):
    with socket.socket(socket.AF_INET, kind) as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


def until(condition, what):
    end = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < end, what
        time.sleep(0.05)


@contextlib.contextmanager
def running(*command, **options):
    """A program that is asked to end, with what it said by then in `said`."""
    log = tempfile.TemporaryFile("w+")
    program = subprocess.Popen([str(word) for word in command], text=True, stdout=subprocess.PIPE, stderr=log, **options)
    program.said = lambda: (log.seek(0), log.read())[1]
    try:
        yield program
    finally:
        program.send_signal(signal.SIGINT)
        try:
            program.out = program.communicate(timeout=PATIENCE)[0]
        except subprocess.TimeoutExpired:
            program.kill()
            raise


class Servers:
    """Servers of NATS with JetStream: one, or a cluster of three."""

    def __init__(self, folder, count, more=""):
        self.folder = folder
        self.names = [f"n{i}" for i in range(count)]
        self.ports = {name: free_port(socket.SOCK_STREAM) for name in self.names}
        routes = {name: free_port(socket.SOCK_STREAM) for name in self.names}
        self.programs = {}
        for name in self.names:
            config = f'server_name: {name}\nlisten: "127.0.0.1:{self.ports[name]}"\n{more}\n'
            config += f'jetstream {{ store_dir: "{folder}/{name}" }}\n'
            if count > 1:
                config += f'cluster {{ name: C, listen: "127.0.0.1:{routes[name]}", routes: [' + ", ".join(
                    f'"nats://127.0.0.1:{port}"' for port in routes.values()) + "] }\n"
            (folder / f"{name}.conf").write_text(config)
            self.start(name)

    def start(self, name):
        self.programs[name] = subprocess.Popen(["nats-server", "-c", self.folder / f"{name}.conf"],
                                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def kill(self, name):
        self.programs[name].kill()
        self.programs[name].wait()

    @property
    def options(self):
        return ["--nats", ",".join(f"nats://127.0.0.1:{port}" for port in self.ports.values()), *SITE]

    def stage(self, *more):
        return subprocess.run([CLI, "stage", *self.options, *more], capture_output=True, text=True)

    def make_stream(self, replicas):
        until(lambda: self.stage("--keep", "1", "--replicas", str(replicas)).returncode == 0, "there is no stream")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for program in self.programs.values():
            program.kill()
            program.wait()


def probe(servers, name, port, folder, *more):
    return running(CLI, "probe", *servers.options, "--name", name, "--udp", f"127.0.0.1:{port}", "--spool",
                   folder / f"spool-{name}", "--verbose", *more)


def sender(port, seconds, *more):
    return subprocess.Popen([CLI, "send", "--to", f"127.0.0.1:{port}", "--rate", "60", "--duration", str(seconds),
                             "--characters", "2", *more], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def sent_by(program):
    out, err = program.communicate(timeout=PATIENCE)
    return int(re.search(r"sent (\d+)", out + err)[1])


def monitor(servers, *more):
    return running(CLI, "monitor", *servers.options, "--json", *more)


def received(servers, since):
    """Datagrams by probe of all that the stream has."""
    return counted(*servers.options, "--since", since, "--until",
                   time.strftime("%Y-%m-%dT%H:%M:%S", time.localtime(time.time() + 2)))


def counted(*source):
    """Datagrams by probe, and the report."""
    out = subprocess.run([CLI, "monitor", *source, "--json"], capture_output=True, text=True, timeout=PATIENCE)
    if out.returncode == 2:
        return {}, {}  # the servers choose a leader
    report = json.loads(out.stdout)
    counts = {}
    for source in report["sources"]:
        counts[source["probe"]] = counts.get(source["probe"], 0) + source["datagrams"]
    return counts, report


def now():
    return time.strftime("%Y-%m-%dT%H:%M:%S")


def listening(*probes):
    until(lambda: all("listening" in one.said() for one in probes), "a probe does not listen")


def check_leader_dies(folder):
    """Nothing is lost, doubled or out of order; who reads it later reads the same."""
    since = now()
    with Servers(folder, 3) as servers:
        servers.make_stream(3)
        ports = {"A": free_port(), "B": free_port()}
        with probe(servers, "A", ports["A"], folder) as a, probe(servers, "B", ports["B"], folder) as b:
            listening(a, b)
            take = folder / "take.pcapng"
            with monitor(servers, "--since", since, "--record", take) as live:
                senders = {name: sender(port, 7, "--drop", "0.02") for name, port in ports.items()}
                time.sleep(2)
                until(lambda: "led by" in servers.stage().stdout, "no leader")
                servers.kill(re.search(r"led by (\w+)", servers.stage().stdout)[1])
                sent = {name: sent_by(program) for name, program in senders.items()}
                until(lambda: received(servers, since)[0] == sent, f"not all is kept: {sent}")
                until(lambda: counted(take)[0] == sent, f"not all came: {sent}")
            report = json.loads(live.out)
    assert {one["probe"]: one["datagrams"] for one in report["sources"]} == sent, (sent, report["sources"])
    streams = [stream for one in report["sources"] for character in one["characters"] for stream in character["streams"]]
    assert sum(one["duplicates"] + one["reordered"] + one["late"] for one in streams) == 0
    assert sum(one["lost"] for one in streams) > 0
    for cause in ("thisComputer", "sender"):
        assert sum(one["causes"][cause] for one in streams) == 0, cause


def check_probe_dies(folder):
    """What no server had stored is sent by the next probe; what nobody heard is that computer's loss."""
    since = now()
    with Servers(folder, 1) as servers:
        servers.make_stream(1)
        port = free_port()
        with probe(servers, "A", port, folder) as first:
            listening(first)
            program = sender(port, 6)
            time.sleep(1)
            servers.kill("n0")
            spool = folder / "spool-A"
            until(lambda: any(one.stat().st_size > 500_000 for one in spool.glob("history-*")), "no spool")
            first.kill()
            first.wait()
        with probe(servers, "A", port, folder) as second:
            listening(second)
            servers.start("n0")
            sent = sent_by(program)
            until(lambda: not list(spool.glob("history-*")), "the spool stays")
        counts, report = received(servers, since)
    assert 0.2 * sent < counts["A"] < sent, (sent, counts)  # a busy machine starts the second one late
    streams = [stream for one in report["sources"] for character in one["characters"] for stream in character["streams"]]
    assert sum(one["duplicates"] for one in streams) == 0
    lost = sum(one["lost"] for one in streams)
    assert lost > 0 and lost == sum(one["causes"]["thisComputer"] for one in streams), lost


def check_words(folder):
    """A clear sentence for each way in which servers refuse; no secret is printed."""
    (folder / "right").write_text("let-me-in\n")
    (folder / "wrong").write_text("open-sesame\n")
    accounts = '''authorization { users: [
        { user: all, password: let-me-in },
        { user: deaf, password: let-me-in, permissions: { publish: "nothing.>", subscribe: "_INBOX.>" } }] }'''
    with Servers(folder, 1, accounts) as servers:
        def said(*more):
            out = servers.stage(*more)
            assert out.returncode == 2 and "let-me-in" not in out.stderr and "sesame" not in out.stderr, out.stderr
            return out.stderr
        right, wrong = (["--nats-password-file", folder / name] for name in ("right", "wrong"))
        until(lambda: "does not know this user" in said("--nats-user", "all", *wrong), "the server does not start")
        assert "no stream of this site" in said("--nats-user", "all", *right)
        assert "does not allow" in said("--nats-user", "deaf", *right, "--keep", "1")
        url = ["--nats", f"nats://all:let-me-in@127.0.0.1:{servers.ports['n0']}", *SITE]
        out = subprocess.run([CLI, "stage", *url], capture_output=True, text=True)
        assert out.returncode == 2 and "--nats-password-file" in out.stderr, out.stderr
    out = subprocess.run([CLI, "stage", *servers.options], capture_output=True, text=True)
    assert out.returncode == 2 and "no server answers" in out.stderr, out.stderr


def check_twins(folder):
    with Servers(folder, 1) as servers:
        servers.make_stream(1)
        with probe(servers, "A", free_port(), folder) as first, probe(servers, "A", free_port(), folder) as second:
            until(lambda: "another probe of this name" in first.said() and "another probe" in second.said(), "no word")


def check_window(folder, window):
    """The window has what two probes of equal senders receive."""
    environment = dict(os.environ, QT_QPA_PLATFORM="offscreen", HOME=str(folder), XDG_CONFIG_HOME=str(folder))
    with Servers(folder, 1) as servers:
        servers.make_stream(1)
        ports = {"A": free_port(), "B": free_port()}
        with probe(servers, "A", ports["A"], folder) as a, probe(servers, "B", ports["B"], folder) as b:
            listening(a, b)
            with running(window, *servers.options, "--since", now(), "--no-tour", "--metrics", "127.0.0.1:0",
                         env=environment) as shown:
                until(lambda: "metrics are at" in shown.said(), "no window")
                address = re.search(r"metrics are at (\S+)", shown.said())[1]
                sent = sum(sent_by(program) for program in [sender(port, 1) for port in ports.values()])

                def datagrams():
                    text = urllib.request.urlopen(address).read().decode()
                    found = re.search(r"^posewire_datagrams_total (\S+)", text, re.M)
                    return int(float(found[1])) if found else 0  # before the first tick of the window there are none
                until(lambda: datagrams() == sent, f"not all {sent} are shown")


def main():
    if shutil.which("nats-server") is None:
        print("skipped: there is no nats-server")
        sys.exit(SKIPPED)
    for check in (check_words, check_twins, check_probe_dies, check_leader_dies):
        with tempfile.TemporaryDirectory(prefix="stage_test_") as folder:
            print(check.__name__, flush=True)
            check(pathlib.Path(folder))
    if len(sys.argv) > 2:
        with tempfile.TemporaryDirectory(prefix="stage_test_") as folder:
            print("check_window", flush=True)
            check_window(pathlib.Path(folder), sys.argv[2])


main()
