#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A dissector generated with a further message type shows its fields in tshark.

usage: dissected_test.py GENERATOR SOURCE_DIR
Exits 77 where there is no tshark.
"""

import pathlib
import shutil
import subprocess
import sys
import tempfile

GENERATOR, SOURCE_DIR = sys.argv[1], pathlib.Path(sys.argv[2])
sys.path[:0] = [str(SOURCE_DIR / "tests/support"), str(SOURCE_DIR / "tests/wireshark")]
import capture_writer  # noqa: E402
import dissected  # noqa: E402

WANTED = {"mxtp.station": "258", "mxtp.reading.id": "1,22", "mxtp.reading.temperature.value": "22.5,-5",
          "mxtp.reading.level": "-2,3", "mxtp.reading.wind.x": "1,0"}


def main() -> int:
    if shutil.which("tshark") is None:
        return 77
    text = (SOURCE_DIR / "tests/extension/26_probes.hex").read_text(encoding="utf-8")
    probes = bytes.fromhex("".join(line.split("#")[0] for line in text.splitlines()))
    with tempfile.TemporaryDirectory() as folder:
        home = pathlib.Path(folder)
        script, capture = home / "mxtp.lua", home / "probes.pcap"
        template = SOURCE_DIR / "packaging/wireshark/mxtp.template.lua"
        subprocess.run([GENERATOR, str(template), str(script)], check=True)
        capture.write_bytes(capture_writer.pcap([(1_700_000_000_000_000_000, capture_writer.udp_packet(probes))]))
        fields = [argument for name in WANTED for argument in ("-e", name)]
        with dissected.run_tshark(script, capture, home, "-T", "fields", *fields,
                                  "-Y", "mxtp.type == 26 && mxtp.reading.temperature.value > 22") as process:
            found = process.stdout.read().decode("utf-8").rstrip("\n").split("\t")
        if found != list(WANTED.values()):
            print(f"{found} instead of {list(WANTED.values())}")
            return 1
    return 0


sys.exit(main())
