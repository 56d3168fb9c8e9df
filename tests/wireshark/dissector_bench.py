#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What reading a capture costs tshark: seconds of user CPU, for a list and for filters, without and with dissectors.

usage: dissector_bench.py POSEWIRE_CLI MXTP_LUA…
Several scripts, such as one from before a change, take turns, so that a busy machine is unfair to none of them.
"""

import pathlib
import resource
import socket
import statistics
import subprocess
import sys
import tempfile

SOURCE_DIR = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(SOURCE_DIR / "tests/support"), str(SOURCE_DIR / "tests/app/cli")]
import capture_writer  # noqa: E402
from datagrams import as_tcp, as_udp  # noqa: E402

PACKETS, ROUNDS = 10_000, 3
LOOKS = {"list": [], "one type": ["-Y", "mxtp.type == 2"], "an array": ["-Y", "mxtp.segment.position.x > 1"],
         "a name": ["-Y", 'mxtp.segment.name == "LeftHand"']}


def performance(cli: str) -> list:
    """Datagrams of all types, as the program sends them."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as receiver:
        receiver.bind(("127.0.0.1", 0))
        receiver.settimeout(5)
        target = f"127.0.0.1:{receiver.getsockname()[1]}"
        with subprocess.Popen([cli, "send", "--to", target, "--rate", "60"], stdout=subprocess.DEVNULL) as sender:
            received = [receiver.recv(65536) for _ in range(PACKETS)]
            sender.terminate()
    return received


def seconds(capture: pathlib.Path, arguments: list) -> float:
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    subprocess.run(["tshark", "-n", "-r", str(capture), *arguments], stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL, check=True)
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def main():
    cli, scripts = sys.argv[1], sys.argv[2:]
    datagrams = performance(cli)
    with tempfile.TemporaryDirectory() as folder:
        for transport, packets in [("UDP", as_udp(datagrams)), ("TCP", as_tcp(datagrams))]:
            capture = pathlib.Path(folder) / "capture.pcap"
            capture.write_bytes(capture_writer.pcap(packets))
            bare = statistics.median(seconds(capture, []) for _ in range(ROUNDS))
            print(f"{transport}, {PACKETS} packets, no dissector: {bare:.2f} s")
            for look, arguments in LOOKS.items():
                rounds = [[seconds(capture, ["-X", f"lua_script:{script}", *arguments]) for script in scripts]
                          for _ in range(ROUNDS)]
                for times in rounds:
                    ratio = f"  {times[0] / times[-1]:.1f} times" if len(times) > 1 else ""
                    print(f"{transport}, {look:8}: " + "  ".join(f"{time:.2f} s" for time in times) + ratio)


if __name__ == "__main__":
    main()
