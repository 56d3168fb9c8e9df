# SPDX-License-Identifier: GPL-3.0-or-later
"""What `posewire-cli monitor --record` writes, read by somebody else: tshark and capinfos."""

import json
import shutil
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

SKIPPED = 77


def pose(sample: int) -> bytes:
    item = struct.pack(">I3f4f", 1, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0)
    return b"MXTP02" + struct.pack(">IBBIBBBBHH", sample, 0x80, 1, sample * 4, 0, 1, 0, 0, 0, len(item)) + item


def run(*command: str) -> str:
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def recorded(cli: str, folder: Path, writer) -> Path:
    start = 1_700_000_000_123_456_789
    packets = [(start, writer.udp_packet(pose(0))),
               (start + 4_000_001, writer.udp_packet(pose(1), ("fe80::1", 40001), ("fe80::2", 9763))),
               (start + 8_000_002, writer.tcp_packet(pose(2) + pose(3), 1000))]
    source, target = folder / "in.pcapng", folder / "out.pcapng"
    source.write_bytes(writer.pcapng(packets))
    report = json.loads(run(cli, "monitor", str(source), "--json", "--record", str(target)))
    assert [s["transport"] for s in report["sources"]] == ["udp", "udp", "tcp"], report
    assert json.loads(run(cli, "monitor", str(target), "--json")) == report
    return target


def check_packets(file: Path) -> None:
    fields = ["frame.time_epoch", "ip.src", "ipv6.src", "udp.srcport", "udp.dstport", "udp.checksum.status",
              "ip.checksum.status", "frame.comment"]
    wanted = [option for field in fields for option in ("-e", field)]
    lines = run("tshark", "-r", str(file), "-o", "udp.check_checksum:TRUE", "-o", "ip.check_checksum:TRUE", "-T",
                "fields", "-E", "separator=|", *wanted).splitlines()
    good = "1"
    tcp = "Posewire: TCP"
    assert lines == [
        f"1700000000.123456789|192.0.2.1||40001|9763|{good}|{good}|",
        f"1700000000.127456790||fe80::1|40001|9763|{good}||",
        f"1700000000.131456791|192.0.2.1||40001|9763|{good}|{good}|{tcp}",
        f"1700000000.131456791|192.0.2.1||40001|9763|{good}|{good}|{tcp}",
    ], lines
    assert run("tshark", "-r", str(file), "-Y", "_ws.malformed") == ""


def check_file(file: Path) -> None:
    text = run("capinfos", str(file))
    for words in ("pcapng", "nanoseconds (9)", "Number of packets:   4", "Posewire", "Number of interfaces in file: 1",
                  "Number of stat entries = 1"):
        assert words in text, (words, text)


def check_damaged(file: Path, folder: Path, cli: str) -> None:
    whole = file.read_bytes()
    cut = folder / "cut.pcapng"
    for size in range(len(whole) - 120, len(whole)):
        cut.write_bytes(whole[:size])
        monitored = subprocess.run((cli, "monitor", str(cut), "--json"), capture_output=True, text=True)
        report = json.loads(monitored.stdout)
        assert sum(source["datagrams"] for source in report["sources"]) in (3, 4), size
        is_told = f"is cut off: it ends at byte {size}," in monitored.stderr
        assert monitored.returncode == is_told, (size, monitored)
        assert is_told or size == len(whole) - 88, "but for the whole file without its statistics"


def main() -> int:
    cli, support = sys.argv[1:3]
    sys.path.insert(0, support)
    import capture_writer

    if shutil.which("tshark") is None or shutil.which("capinfos") is None:
        print("SKIPPED: tshark and capinfos are not installed; nobody else has read the recording")
        return SKIPPED
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        file = recorded(cli, folder, capture_writer)
        check_packets(file)
        check_file(file)
        check_damaged(file, folder, cli)
    return 0


if __name__ == "__main__":
    sys.exit(main())
