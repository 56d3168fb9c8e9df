#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares `posewire-cli decode --json` and `encode` with the second encoder, field by field and bit by bit.

usage: second_encoder_test.py POSEWIRE_CLI SUPPORT_DIR [SEED…]
Prints what disagrees and exits 1 if anything does.
"""

import json
import pathlib
import struct
import subprocess
import sys
import tempfile

sys.path.insert(0, sys.argv[2])
import capture_writer  # noqa: E402
from second_encoder_cases import all_cases  # noqa: E402

FIRST_STAMP = 1_700_000_000_123_456_789
SOURCE, SOURCE_6 = ("192.0.2.1", 40001), ("2001:db8::1", 40002)


class Comparison:
    def __init__(self):
        self.fields = 0
        self.faults = []

    def equal(self, where: str, wanted, got):
        if isinstance(wanted, dict) and isinstance(got, dict):
            if list(wanted) != list(got) and set(wanted) != set(got):
                self.faults.append(f"{where}: wanted the keys {list(wanted)}, got {list(got)}")
            for key in set(wanted) & set(got):
                self.equal(f"{where}.{key}", wanted[key], got[key])
        elif isinstance(wanted, list) and isinstance(got, list) and len(wanted) == len(got):
            for number, pair in enumerate(zip(wanted, got)):
                self.equal(f"{where}[{number}]", *pair)
        else:
            self.fields += 1
            if not same(wanted, got):
                self.faults.append(f"{where}: wanted {wanted!r}, got {got!r}")


def same(wanted, got) -> bool:
    if isinstance(wanted, float) and isinstance(got, (int, float)):
        return struct.pack(">f", wanted) == struct.pack(">f", float(got))
    return type(wanted) is type(got) and wanted == got


def run(cli: str, *arguments: str) -> tuple[int, bytes]:
    done = subprocess.run([cli, *arguments], capture_output=True, timeout=240, check=False)
    return done.returncode, done.stdout


def decode(cli: str, path: pathlib.Path) -> list:
    _, output = run(cli, "decode", str(path), "--json")
    return [json.loads(line) for line in output.decode("utf-8").splitlines()]


def wanted_object(case, index: int, offset: int, stamp, source) -> dict:
    wanted = {"index": index, "offset": offset, "size": 24 + len(case.payload), "stampNs": stamp, "source": source}
    wanted.update(case.header.to_json())
    return wanted


def compare_object(comparison: Comparison, label: str, case, wanted: dict, got: dict):
    notices, body, error = got.pop("notices", None), got.pop("body", None), got.pop("error", None)
    if not case.well_formed:
        # What the values cannot bring back, the decoder gives as bytes beside them.
        comparison.equal(f"{label}: bytes", case.to_bytes().hex(), got.pop("bytes", case.to_bytes().hex()))
    comparison.equal(label, wanted, got)
    if error is not None:
        comparison.faults.append(f"{label}: error {error}")
        return
    comparison.equal(f"{label}: body", case.body, body)
    if case.plain and notices != []:
        comparison.faults.append(f"{label}: wanted no notices, got {notices}")


def check_capture(comparison, path: pathlib.Path, objects: list, cases: list, expectations: list):
    if len(objects) != len(cases):
        comparison.faults.append(f"{path.name}: {len(cases)} datagrams went in, {len(objects)} objects came out")
        return
    for case, wanted, got in zip(cases, expectations, objects):
        compare_object(comparison, f"{path.name}: {case.label}", case, wanted, got)


def raw_file(cases: list) -> tuple[bytes, list]:
    content, expectations = b"", []
    for index, case in enumerate(cases):
        expectations.append(wanted_object(case, index, len(content), None, None))
        content += case.to_bytes()
    return content, expectations


def captured(cases: list, source: tuple) -> tuple[list, list]:
    target = ("192.0.2.2", 9763) if "." in source[0] else ("2001:db8::2", 9763)
    packets, expectations = [], []
    address = f"{source[0]}:{source[1]}" if "." in source[0] else f"[{source[0]}]:{source[1]}"
    for index, case in enumerate(cases):
        stamp = FIRST_STAMP + index * 4_166_667
        packets.append((stamp, capture_writer.udp_packet(case.to_bytes(), source, target)))
        expectations.append(wanted_object(case, index, 0, stamp, address))
    return packets, expectations


def set_payload_offsets(content: bytes, cases: list, expectations: list):
    """In a capture, `offset` is that of the UDP payload in the file."""
    at = 0
    for case, wanted in zip(cases, expectations):
        at = content.index(case.to_bytes(), at)
        wanted["offset"] = at
        at += wanted["size"]


def check_captures(comparison, cli: str, folder: pathlib.Path, cases: list):
    for file, write, order, source in [("a.pcap", capture_writer.pcap, "<", SOURCE),
                                       ("b.pcap", capture_writer.pcap, ">", SOURCE_6),
                                       ("c.pcapng", capture_writer.pcapng, "<", SOURCE),
                                       ("d.pcapng", capture_writer.pcapng, ">", SOURCE_6)]:
        packets, expectations = captured(cases, source)
        content = write(packets, order=order)
        set_payload_offsets(content, cases, expectations)
        (folder / file).write_bytes(content)
        check_capture(comparison, folder / file, decode(cli, folder / file), cases, expectations)


def check_raw_file(comparison, cli: str, folder: pathlib.Path, cases: list):
    cases = [case for case in cases if not case.alone]
    content, expectations = raw_file(cases)
    (folder / "raw.bin").write_bytes(content)
    check_capture(comparison, folder / "raw.bin", decode(cli, folder / "raw.bin"), cases, expectations)


def check_skipped_bytes(comparison, cli: str, folder: pathlib.Path, cases: list):
    """Bytes that belong to no datagram are one object each time; the datagrams around them are found."""
    cases = [case for case in cases if case.header.payload_size == len(case.payload) > 0 and case.well_formed][::7]
    rubbish = [b"{\"type\":\"transport\"}", b"MXTQ" * 9, b"\0", b"MXT", b"MXTPxy" + bytes(40)]
    content, wanted = b"", []
    for index, case in enumerate(cases):
        wanted.append(wanted_object(case, 2 * index, len(content), None, None))
        content += case.to_bytes()
        between = rubbish[index % len(rubbish)]
        wanted.append({"index": 2 * index + 1, "offset": len(content), "size": len(between), "skipped": True})
        content += between
    (folder / "rubbish.bin").write_bytes(content)
    objects = decode(cli, folder / "rubbish.bin")
    comparison.equal("rubbish.bin: objects", len(wanted), len(objects))
    for want, got in zip(wanted, objects):
        got.pop("body", None)
        got.pop("notices", None)
        comparison.equal(f"rubbish.bin: object {want['index']}", want, got)


def check_round_trip(comparison, cli: str, folder: pathlib.Path, cases: list):
    packets, _ = captured(cases, SOURCE)
    (folder / "trip.pcapng").write_bytes(capture_writer.pcapng(packets))
    _, lines = run(cli, "decode", str(folder / "trip.pcapng"), "--json")
    (folder / "trip.jsonl").write_bytes(lines)
    status, _ = run(cli, "encode", str(folder / "trip.jsonl"), "-o", str(folder / "trip.bin"))
    back, at = (folder / "trip.bin").read_bytes() if status == 0 else b"", 0
    comparison.equal("encode: exit status", 0, status)
    for case in cases:
        sent = case.to_bytes()
        comparison.equal(f"encode: {case.label}", sent.hex(), back[at:at + len(sent)].hex())
        at += len(sent)
    comparison.equal("encode: size", at, len(back))


def main() -> int:
    cli, seeds = sys.argv[1], [int(seed) for seed in sys.argv[3:]] or [20120217]
    comparison, count = Comparison(), 0
    for seed in seeds:
        cases = all_cases(seed)
        count += len(cases)
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            check_raw_file(comparison, cli, folder, cases)
            check_captures(comparison, cli, folder, cases)
            check_skipped_bytes(comparison, cli, folder, cases)
            check_round_trip(comparison, cli, folder, cases)
    for fault in comparison.faults[:40]:
        print(fault[:2000])
    print(f"{count} datagrams, {comparison.fields} fields compared, {len(comparison.faults)} faults")
    return 1 if comparison.faults else 0


if __name__ == "__main__":
    sys.exit(main())
