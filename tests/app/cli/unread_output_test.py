# SPDX-License-Identifier: GPL-3.0-or-later
"""`posewire-cli monitor` where nobody reads what it shows, and where it is ended in every way there is."""

import fcntl
import json
import os
import re
import resource
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path


def pose(sample: int) -> bytes:
    item = struct.pack(">I3f4f", 1, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0)
    return b"MXTP02" + struct.pack(">IBBIBBBBHH", sample, 0x80, 1, sample * 4, 0, 1, 0, 0, 0, len(item)) + item


class Monitor:
    """The program on a port of its own."""

    def __init__(self, cli: str, *more: str, **options):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
            probe.bind(("127.0.0.1", 0))
            self.place = probe.getsockname()
        self.process = subprocess.Popen([cli, "monitor", "--udp", f"127.0.0.1:{self.place[1]}", *more],
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options)
        entry = f"0100007F:{self.place[1]:04X}"
        for _ in range(500):
            if entry in Path("/proc/net/udp").read_text():
                break
            time.sleep(0.02)
        self.sender = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.sent = 0

    def send(self, count: int, pause: float = 0.01) -> None:
        for _ in range(count):
            self.sender.sendto(pose(self.sent), self.place)
            self.sent += 1
            if self.sent % 300 == 0:
                time.sleep(pause)

    def end(self, number: int = signal.SIGINT, patience: float = 20) -> tuple[int, str, str]:
        self.process.send_signal(number)
        out, err = self.process.communicate(timeout=patience)
        return self.process.returncode, out, err


def looked_at(table: str) -> int:
    """Datagrams of the last table, and those that it says were dropped."""
    line = [line for line in table.splitlines() if " datagrams " in line][-1]
    numbers = [int(text.replace("\u202f", ""))
               for text in re.findall(r"([\d\u202f]+) datagrams|computer ([\d\u202f]+)", line) for text in text if text]
    return sum(numbers)


def check_blocked_table(cli: str, folder: Path) -> None:
    """A pipe that nobody reads holds 64 KiB: some 300 tables."""
    recording = folder / "blocked.pcapng"
    monitor = Monitor(cli, "--interval", "0.001", "--record", str(recording))
    monitor.send(200_000)
    time.sleep(0.5)
    monitor.process.send_signal(signal.SIGINT)
    time.sleep(0.2)  # the reader comes back just in time
    out, err = monitor.process.communicate(timeout=20)
    assert monitor.process.returncode == 0, err
    assert looked_at(out) == monitor.sent, (out[-2000:], err)
    assert "recorded " in err, err
    report = json.loads(subprocess.run([cli, "monitor", str(recording), "--json"], check=True, capture_output=True,
                                       text=True).stdout)
    source = report["sources"][0]
    assert source["datagrams"] + source["kernelDropped"] == monitor.sent, report


def check_blocked_lines(cli: str, _folder: Path) -> None:
    """Lines that nobody reads in time are left out, and what happened in them is told all the same."""
    monitor = Monitor(cli, "--json-lines", "--interval", "0.001")
    fcntl.fcntl(monitor.process.stdout, fcntl.F_SETPIPE_SZ, 4096)
    strangers = []
    for _ in range(5):  # one a second: before lines are left out, and after
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as stranger:
            stranger.sendto(b"not MXTP", monitor.place)
            strangers.append(stranger.getsockname()[1])
        for _ in range(100):
            monitor.send(1)
            time.sleep(0.01)
    monitor.process.send_signal(signal.SIGINT)
    out, err = monitor.process.communicate(timeout=20)
    assert monitor.process.returncode == 0, err
    assert re.search(r"\d lines? w\w+ left out", err), err
    lines = [json.loads(line) for line in out.splitlines()]
    told = {incident["source"] for line in lines for incident in line["incidents"] if incident["kind"] == "foreign"}
    assert told == {f"127.0.0.1:{port}" for port in strangers}, (told, strangers, err)
    assert [line["timeNs"] for line in lines] == sorted(line["timeNs"] for line in lines)


def check_nobody_ever_reads(cli: str, _folder: Path) -> None:
    monitor = Monitor(cli, "--interval", "0.001")
    monitor.send(100)
    time.sleep(2)
    begin = time.monotonic()
    monitor.process.send_signal(signal.SIGINT)
    monitor.process.wait(timeout=10)  # without a byte being read
    assert time.monotonic() - begin < 5


def check_reader_gone(cli: str, folder: Path) -> None:
    recording = folder / "gone.pcapng"
    monitor = Monitor(cli, "--interval", "0.05", "--record", str(recording))
    monitor.send(10)
    monitor.process.stdout.close()
    time.sleep(1)
    monitor.send(500)
    time.sleep(0.3)
    monitor.process.send_signal(signal.SIGTERM)
    err = monitor.process.stderr.read()
    assert monitor.process.wait(timeout=10) == 0, err
    assert err.count("nobody reads standard output any more") == 1, err
    assert f"recorded {monitor.sent} packets, {recording.stat().st_size} bytes to {recording}" in err, err


def check_every_end(cli: str, folder: Path) -> None:
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        recording, page = folder / f"{number}.pcapng", folder / f"{number}.html"
        monitor = Monitor(cli, "--json", "--record", str(recording), "--report", str(page))
        monitor.send(200)
        time.sleep(0.3)
        status, out, err = monitor.end(number)
        assert status == 0, (number, err)
        assert json.loads(out)["sources"][0]["datagrams"] == 200, number
        assert page.read_text().rstrip().endswith("</html>"), number
        data = recording.read_bytes()
        length = struct.unpack("<I", data[-4:])[0]
        assert data[-length:-length + 4] == struct.pack("<I", 5), "the block of statistics is there"
        assert not list(folder.glob(".posewire*")), number


def check_file_size(cli: str, folder: Path) -> None:
    """A file that may not grow: SIGXFSZ would end the program."""
    recording = folder / "limited.pcapng"
    monitor = Monitor(cli, "--json", "--record", str(recording),
                      preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000)))
    monitor.send(1000)
    time.sleep(0.5)
    status, out, err = monitor.end()
    assert status == 2, (status, err)
    assert json.loads(out)["sources"][0]["datagrams"] == 1000
    assert "ulimit -f" in err and "at most " in err, err


def check_files_without_end(cli: str, folder: Path) -> None:
    pipe = folder / "pipe"
    os.mkfifo(pipe)
    for name in (str(pipe), "/dev/zero"):
        for command in (["monitor", name, "--json"], ["decode", name], ["report", name, "-o", "-"],
                        ["encode", name], ["send", "--to", "127.0.0.1:9", "--file", name]):
            process = subprocess.Popen([cli, *command], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
            time.sleep(0.4)
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=10)


def check_files_of_nothing(cli: str, folder: Path) -> None:
    """A file that goes on and on without anything of ours is told long before its end, once."""
    nothing = folder / "nothing"
    with open(nothing, "wb") as file:
        file.truncate(100 << 20)
    for command in (["monitor", str(nothing), "--json"], ["decode", str(nothing)],
                    ["report", str(nothing), "-o", str(folder / "report.html")],
                    ["export", str(nothing), "-o", str(folder / "motion.csv")],
                    ["send", "--to", "127.0.0.1:9", "--file", str(nothing)]):
        done = subprocess.run([cli, *command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
        assert done.stderr.count("nothing of ours in its first 64 MB; still looking, Ctrl+C ends it") == 1, done.stderr
    with open(nothing, "r+b") as file:
        file.write(pose(0))
    done = subprocess.run([cli, "decode", str(nothing)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
    assert "still looking" not in done.stderr, done.stderr


def check_cancelled_output(cli: str, folder: Path) -> None:
    pipe, target = folder / "lines", folder / "target.bin"
    os.mkfifo(pipe)
    process = subprocess.Popen([cli, "encode", str(pipe), "-o", str(target)], stderr=subprocess.PIPE, text=True)
    time.sleep(0.4)
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=10)
    assert process.returncode == 2 and "interrupted" in err, err
    assert not target.exists() and not list(folder.glob(".posewire*"))


def check_interrupted_file(cli: str, folder: Path) -> None:
    """What is said about a file of which only the beginning was read names that."""
    pipe, report = folder / "endless", folder / "report.html"
    os.mkfifo(pipe)
    for command in (["monitor", str(pipe), "--json"], ["report", str(pipe), "-o", str(report)]):
        process = subprocess.Popen([cli, *command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        with open(pipe, "wb", buffering=0) as writer:
            for sample in range(100):
                writer.write(pose(sample))
            time.sleep(0.4)
            process.send_signal(signal.SIGINT)
            _, err = process.communicate(timeout=10)
        assert process.returncode == 0 and f"{pipe}: interrupted; this is about its first" in err, err
    assert "Not read to its end" in report.read_text()
    whole = folder / "whole"
    whole.write_bytes(b"".join(pose(sample) for sample in range(100)))
    told = subprocess.run([cli, "monitor", str(whole), "--json"], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, check=True)
    assert told.stderr == b"", told


def check_silent_pipe(cli: str, folder: Path) -> None:
    """A pipe in which nothing comes any more holds nobody up beyond the duration."""
    pipe = folder / "pipe"
    os.mkfifo(pipe)
    process = subprocess.Popen([cli, "monitor", str(pipe), "--json", "--duration", "1"], stdout=subprocess.PIPE, text=True)
    with open(pipe, "wb", buffering=0) as writer:
        writer.write(b"".join(pose(sample) for sample in range(20)))
        out, _ = process.communicate(timeout=10)
    assert process.returncode == 0 and json.loads(out)["sources"][0]["datagrams"] >= 19, out


def check_interrupted_truth(cli: str, folder: Path) -> None:
    """What was sent until Ctrl+C is in the truth."""
    truth = folder / "truth.json"
    sender = subprocess.Popen([cli, "send", "--to", "127.0.0.1:9", "--duration", "60", "--rate", "100", "--truth",
                               str(truth)], stdout=subprocess.PIPE, text=True)
    time.sleep(1.5)
    sender.send_signal(signal.SIGINT)
    out, _ = sender.communicate(timeout=10)
    written = json.loads(truth.read_text())
    sent = sum(stream["datagrams"] for source in written["sources"] for character in source["characters"]
               for stream in character["streams"])
    assert sender.returncode == 0 and f"sent {sent} datagrams" in out and sent > 0, (sender.returncode, out, sent)
    assert 0 < written["durationS"] < 10, written["durationS"]


def check_slow_recording(cli: str, folder: Path) -> None:
    """What takes its time to be written is waited for, and that is said."""
    pipe = folder / "slow.pcapng"
    os.mkfifo(pipe)
    reader = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
    monitor = Monitor(cli, "--json", "--record", str(pipe))
    monitor.send(6000)
    time.sleep(0.5)
    monitor.process.send_signal(signal.SIGINT)
    written = bytearray()
    ended = time.monotonic() + 2.5
    while time.monotonic() < ended:
        time.sleep(0.25)
        written += os.read(reader, 1 << 16)
    os.set_blocking(reader, True)
    while piece := os.read(reader, 1 << 20):
        written += piece
    os.close(reader)
    _, err = monitor.process.communicate(timeout=20)
    assert monitor.process.returncode == 0, (monitor.process.returncode, err)
    assert "still being written" in err and "recorded 6000 packets" in err, err
    assert written.count(b"MXTP02") == 6000


def main() -> int:
    cli = sys.argv[1]
    checks = [check_blocked_table, check_blocked_lines, check_nobody_ever_reads, check_reader_gone, check_every_end,
              check_file_size, check_files_without_end, check_files_of_nothing, check_cancelled_output,
              check_interrupted_file, check_silent_pipe, check_interrupted_truth, check_slow_recording]
    for check in checks:
        with tempfile.TemporaryDirectory() as name:
            check(cli, Path(name))
            print(check.__name__, "done", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
