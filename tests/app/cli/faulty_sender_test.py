#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares what `posewire-cli monitor --json` counts with what a sender with its own faults knows, count by count.

usage: faulty_sender_test.py POSEWIRE_CLI FIRST_SEED LAST_SEED [SECONDS]
Prints what disagrees and exits 1 if anything does.
"""

import json
import pathlib
import subprocess
import sys
import tempfile

from faulty_sender import FaultySender, write_capture


def monitor(cli, path):
    done = subprocess.run([cli, "monitor", str(path), "--json"], capture_output=True, timeout=120, check=False)
    if done.returncode not in (0, 1):
        sys.exit(f"posewire-cli monitor failed: {done.stderr.decode()}")
    return json.loads(done.stdout)


def disagreements(truth, report):
    """Yields what the truth says that the report does not."""
    source = report["sources"][0] if len(report["sources"]) == 1 else {"characters": []}
    if truth["foreignDatagrams"] != report["foreignDatagrams"]:
        yield f"foreign: sent {truth['foreignDatagrams']}, counted {report['foreignDatagrams']}"
    for name in ("malformed", "datagrams"):
        if truth[name] != source.get(name):
            yield f"{name}: sent {truth[name]}, counted {source.get(name)}"
    counted = {(c["id"], s["type"]): s for c in source["characters"] for s in c["streams"]}
    sent = {(c["id"], s["type"]): s for c in truth["characters"] for s in c["streams"]}
    if set(counted) != set(sent):
        yield f"streams: sent {sorted(sent)}, counted {sorted(counted)}"
    for key in set(counted) & set(sent):
        for name, value in sent[key].items():
            if counted[key][name] != value:
                yield f"character {key[0]}, type {key[1]}, {name}: sent {value}, counted {counted[key][name]}"


def main():
    cli, first, last = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    seconds = float(sys.argv[4]) if len(sys.argv) > 4 else 3.0
    figures, faults = 0, 0
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "faulty.pcap"
        for seed in range(first, last + 1):
            sender = FaultySender(seed, seconds)
            write_capture(path, sender.sent)
            truth = sender.truth()
            figures += 3 + sum(len(s) - 1 for c in truth["characters"] for s in c["streams"])
            for disagreement in disagreements(truth, monitor(cli, path)):
                faults += 1
                print(f"seed {seed}: {disagreement}")
                if faults > 200:
                    sys.exit("too many disagreements")
    print(f"{figures} figures of {last - first + 1} senders compared, {faults} disagree")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
