#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Holds packaging/formats.md to what the program writes: each key that is written is on the page, in the section of its
format, and each word of the page's first columns and lists is written.

usage: formats_test.py FORMATS_MD POSEWIRE_CLI SOURCE_DIR
"""
import json
import pathlib
import re
import socket
import struct
import subprocess
import sys
import tempfile
import urllib.request

# Values and options, not keys.
WORDS = {"none", "good", "warning", "bad", "provisional", "ongoing", "over", "encode", "--sender", "--verbose", "MXTP", "sent", "solved", "assumed",
         "tcp", "(lastSample - firstSample) / step + 1 = samples + incomplete + lost"}
NOT_PROMISED = "memory"


def sections(page):
    """Words in backticks by the title of their section."""
    parts = re.split(r"^## (.+)$", page, flags=re.M)[1:]
    return {title: set(re.findall(r"`([^`]+)`", "\n".join(line for line in text.splitlines() if line.startswith("|"))))
            for title, text in zip(parts[::2], parts[1::2])}


def keys(value):
    if isinstance(value, dict):
        found = set(value)
        for key, inner in value.items():
            found |= keys(inner) if key != NOT_PROMISED else set()
        return found
    if isinstance(value, list):
        return set().union(*(keys(inner) for inner in value)) if value else set()
    return set()


def pose(sample):
    item = struct.pack(">I3f4f", 1, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0)
    return b"MXTP02" + struct.pack(">IBBIBBBBHH", sample, 0x80, 1, sample * 4, 0, 1, 0, 0, 0, len(item)) + item


def capture(folder, writer):
    """A stream with a gap, a sample that was lost for a while, a datagram twice, one that is cut, and one of something else."""
    samples = [sample for sample in range(400) if sample != 100 and not 200 <= sample < 205]
    samples.insert(175, 100)
    payloads = [pose(sample) for sample in samples]
    payloads[300:300] = [payloads[299], pose(1)[:30], b"something else"]
    packets = [(1_700_000_000_000_000_000 + place * 4_000_000, writer.udp_packet(payload))
               for place, payload in enumerate(payloads)]
    path = folder / "take.pcapng"
    path.write_bytes(writer.pcapng(packets))
    return path


def golden_datagrams(golden, folder):
    """One of each type and form, with bytes of no datagram among them."""
    path = folder / "all.mxtp"
    datagrams = [bytes.fromhex(re.sub(r"#.*|\s", "", file.read_text(encoding="utf-8"))) for file in sorted(golden.glob("*.hex"))]
    path.write_bytes(datagrams[0] + b"no datagram at all" + b"".join(datagrams[1:]))
    return path


def output(*command):
    result = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    assert result.returncode in (0, 1), (command, result.stderr)
    return result.stdout


def lines(text):
    return [json.loads(line) for line in text.splitlines()]


def compare(title, promised, written):
    promised = promised[title] - WORDS - {NOT_PROMISED}
    assert written - {NOT_PROMISED} <= promised, (title, "not on the page:", sorted(written - promised))
    assert promised <= written, (title, "on the page, not written:", sorted(promised - written))


def followed(cli):
    """Poses of a performer, as other programs get them."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as free:
        free.bind(("127.0.0.1", 0))
        port = str(free.getsockname()[1])
    sending = subprocess.Popen([cli, "send", "--to", "127.0.0.1:" + port, "--rate", "60"], stdout=subprocess.DEVNULL)
    try:
        return lines(output(cli, "follow", "--udp", "127.0.0.1:" + port, "--duration", "1"))
    finally:
        sending.kill()
        sending.wait()


def scraped(cli):
    """Names and labels of what a running monitor serves, with the values of labels that have only some."""
    monitoring = subprocess.Popen([cli, "monitor", "--udp", "127.0.0.1:0", "--metrics", "127.0.0.1:0", "--json"], text=True,
                                  stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    try:
        told = [monitoring.stderr.readline() for _ in range(2)]
        port = re.search(r"listening on (127\.0\.0\.1:\d+)", told[0]).group(1)
        output(cli, "send", "--to", port, "--rate", "60", "--duration", "2", "--drop", "0.05")
        with urllib.request.urlopen(re.search(r"metrics are at (\S+)", told[1]).group(1), timeout=10) as answer:
            text = answer.read().decode("utf-8")
    finally:
        monitoring.kill()
        monitoring.communicate()
    series = [line for line in text.splitlines() if not line.startswith(("#", "exposer_"))]
    labels = set(re.findall(r'(\w+)="([^"]*)"', "\n".join(series)))
    named = {value for label, value in labels if label in ("cause", "severity", "state", "transport")}
    return {line.split("{")[0].split()[0] for line in series} | {label for label, _ in labels} | named - WORDS


def main(page, cli, source):
    sys.path.insert(0, str(source / "tests" / "support"))
    import capture_writer  # pylint: disable=import-outside-toplevel,import-error

    promised = sections(page.read_text(encoding="utf-8"))
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        take, truth = capture(folder, capture_writer), folder / "truth.json"
        decoded = lines(output(cli, "decode", "--json", str(golden_datagrams(source / "tests" / "golden", folder))))
        decoded += lines(output(cli, "decode", "--json", str(take)))
        report = json.loads(output(cli, "monitor", str(take), "--json", "--verbose", "--max-loss", "0.1"))
        queried = lines(output(cli, "query", str(take), "position.z of Pelvis", "--json"))
        told = lines(output(cli, "monitor", str(take), "--json-lines"))
        output(cli, "send", "--to", "127.0.0.1:9", "--duration", "0.1", "--drop", "0.5", "--fault", "frozen",
               "--truth", str(truth))
        sent = json.loads(truth.read_text(encoding="utf-8"))
    compare("decode --json", promised, keys(decoded))
    compare("query", promised, keys(queried))
    compare("monitor --json", promised, keys(report))
    lines_only = {"monitor --json-lines": promised["monitor --json-lines"] | keys(report["verdict"]) | keys(report["incidents"])}
    compare("monitor --json-lines", lines_only, keys(told))
    compare("follow", promised, keys(followed(cli)))
    compare("monitor --metrics", promised, scraped(cli))
    truth_only = {"send --truth": promised["send --truth"] | (keys(sent) & promised["monitor --json"])}
    compare("send --truth", truth_only, keys(sent))
    return 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]), sys.argv[2], pathlib.Path(sys.argv[3])))
