# SPDX-License-Identifier: GPL-3.0-or-later
"""What `posewire-cli query` prints, against numbers computed here from what `decode --json` says.

usage: query_test.py CLI SUPPORT_DIR
"""
import csv
import io
import json
import math
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

RATE = 60
BEGIN = 1_700_000_000_000_000_000
PELVIS, LEFT_HAND = 1, 15  # ids
KNEE = 15  # the place of jRightKnee


class Failure(Exception):
    pass


def expect(condition, *what):
    if not condition:
        raise Failure(" ".join(str(one) for one in what))


def near(found, wanted, what, limit=1e-9):
    expect(found is not None and abs(found - wanted) <= limit * max(1, abs(wanted)), what, found, wanted)


def datagram(kind: str, sample: int, items: int, payload: bytes, character=0, segments=0) -> bytes:
    code = sample * 1000 // RATE
    return (b"MXTP" + kind.encode() + struct.pack(">IBBIBBBBHH", sample, 0x80, items, code, character, segments, 0, 0, 0,
                                                  len(payload)) + payload)


def pose(sample: int, character: int) -> bytes:
    items = b""
    for segment in range(23):
        t = sample / RATE + segment + 5 * character
        turn = 0.7 * math.sin(t)
        items += struct.pack(">I7f", segment + 1, math.sin(t), 0.1 * t, 1 + 0.05 * segment, math.cos(turn), 0,
                             math.sin(turn), 0)
    return datagram("02", sample, 23, items, character, 23)


def joints(sample: int, character: int) -> bytes:
    degrees = math.remainder(7 * sample, 360)
    rows = b"".join(struct.pack(">II3f", 256 * 16 + 2, 256 * 17 + 1, 1, 2, degrees if place == KNEE else 0)
                    for place in range(22))
    return datagram("20", sample, 22, rows, character)


class Tests:
    def __init__(self, cli: str, writer, folder: Path):
        self.cli = cli
        self.take = folder / "take.pcapng"
        self.lost = {100, 101, 140}
        packets = []
        for sample in range(240):
            if sample in self.lost:
                continue
            for character in (0, 1):
                stamp = BEGIN + sample * 1_000_000_000 // RATE + (1_000 if sample else 0) + character * 100_000
                packets.append((stamp, writer.udp_packet(pose(sample, character))))
                packets.append((stamp + 50_000, writer.udp_packet(joints(sample, character))))
        self.take.write_bytes(writer.pcapng(packets))
        decoded = self.run("decode", "--json", self.take).stdout.splitlines()
        self.datagrams = [json.loads(line) for line in decoded]

    def run(self, *arguments, status=0) -> subprocess.CompletedProcess:
        done = subprocess.run([self.cli, *map(str, arguments)], capture_output=True, text=True, timeout=60, check=False)
        expect(done.returncode == status, arguments, "ended with", done.returncode, done.stderr)
        return done

    def query(self, *arguments) -> list:
        return [json.loads(line) for line in self.run("query", self.take, "--json", *arguments).stdout.splitlines()]

    def sent(self, kind: str, character: int) -> dict:
        """Datagrams by sample."""
        return {one["sample"]: one for one in self.datagrams if one["type"] == kind and one["character"] == character}

    @staticmethod
    def item(one: dict, segment: int) -> dict:
        return next(item for item in one["body"]["segments"] if item["id"] == segment)

    def test_values_are_those_of_the_datagrams(self):
        texts = ["position.z of \"Left Hand\"", "orientation.w of Pelvis",
                 "distance(position of Pelvis, position of LeftHand)",
                 "angle(orientation of Pelvis, orientation of LeftHand)", "20.rotation.z of RightKnee",
                 "position.x of Pelvis - 2.position.x of LeftHand + 1 cm"]
        head, *rows = self.query(*texts)
        expect([one["text"] for one in head["signals"]] == texts, head)
        expect([one["unit"] for one in head["signals"]] == ["m", "", "m", "°", "°", "m"], head)
        expect(len(rows) == 2 * (240 - len(self.lost)), len(rows))
        for row in rows:
            poses, angles = self.sent("02", row["character"]), self.sent("20", row["character"])
            one = poses[row["sample"]]
            pelvis, hand = self.item(one, PELVIS), self.item(one, LEFT_HAND)
            near(row["timeS"], (one["stampNs"] - self.datagrams[0]["stampNs"]) / 1e9, "time")
            found = row["values"]
            near(found[0], hand["position"][2], "height", 1e-7)  # decode writes numbers of 32 bits
            near(found[1], pelvis["orientation"][0], "w", 1e-7)
            near(found[2], math.dist(pelvis["position"], hand["position"]), "distance", 1e-6)
            dot = abs(sum(a * b for a, b in zip(pelvis["orientation"], hand["orientation"])))
            near(found[3], 2 * math.degrees(math.acos(min(1, dot))), "angle", 2e-3)
            near(found[4], angles[row["sample"]]["body"]["joints"][KNEE]["rotation"][2], "knee", 1e-6)
            near(found[5], pelvis["position"][0] - hand["position"][0] + 0.01, "difference", 1e-6)
        expect(all(a["timeS"] <= b["timeS"] for a, b in zip(rows, rows[1:])), "order")

    def test_derivatives_stop_at_gaps_and_turn_the_short_way(self):
        _, *rows = self.query("speed(2.position of LeftHand) where character == 1", "derivative(20.rotation.z of RightKnee)")
        poses = self.sent("02", 1)
        after_gap = {sample + 1 for sample in self.lost} - self.lost
        for row in rows:
            sample, (speed, turning) = row["sample"], row["values"]
            is_cut = sample == 0 or sample in after_gap
            expect((turning is None) == is_cut, "turning at", sample, turning)
            expect((speed is None) == (is_cut or row["character"] == 0), "speed at", sample, speed)
            if sample > 40 and turning is not None:  # the rate of the sender is known then
                near(turning, 7 * RATE, "turning", 1e-5)
            if sample > 40 and speed is not None:
                path = math.dist(*(self.item(poses[one], LEFT_HAND)["position"] for one in (sample, sample - 1)))
                near(speed, path * RATE, "speed", 1e-4)

    def test_csv_is_the_same_table(self):
        arguments = ("position.z of Pelvis", "2.jitter", "20.rotation.y of RightKnee")
        head, *rows = csv.reader(io.StringIO(self.run("query", self.take, *arguments).stdout))
        expect(head == ["time [s]", "sample", "character", "source", "position.z of Pelvis [m]", "2.jitter [s]",
                        "20.rotation.y of RightKnee [°]"], head)
        _, *wanted = self.query(*arguments)
        expect(len(rows) == len(wanted), len(rows))
        for row, other in zip(rows, wanted):
            expect([float(row[0]), int(row[1]), int(row[2]), row[3]] ==
                   [other["timeS"], other["sample"], other["character"], other["source"]], row, other)
            expect([float(one) if one else None for one in row[4:]] == other["values"], row, other)

    def test_spans_have_means_and_gaps_are_empty(self):
        every = 1 / 30  # two samples; those of 100 and 101 are lost, and one of 140 and 141
        _, *rows = self.query("position.x of LeftHand where character == 0", "20.rotation.z of RightKnee where character == 0",
                              "--every", every)
        poses, angles = self.sent("02", 0), self.sent("20", 0)
        expect(len(rows) == 120, len(rows))
        for i, row in enumerate(rows):
            near(row["timeS"], i * every, "time")
            samples = [one for one in (2 * i, 2 * i + 1) if one not in self.lost]
            place, angle = row["values"]
            if not samples:
                expect(place is None and angle is None and row["sample"] is None, row)
                continue
            near(place, sum(self.item(poses[one], LEFT_HAND)["position"][0] for one in samples) / len(samples), "mean", 1e-6)
            first, last = (angles[one]["body"]["joints"][KNEE]["rotation"][2] for one in (samples[0], samples[-1]))
            near(math.remainder(angle - first - math.remainder(last - first, 360) / 2, 360), 0, "angle", 1e-5)

    def test_ranges(self):
        _, *rows = self.query("position.x of Pelvis", "--since", 1, "--until", 2)
        expect(rows[0]["sample"] == 60 and rows[-1]["sample"] == 119, rows[0], rows[-1])
        self.run("query", self.take, "size", "--since", 2, "--until", 1, status=2)

    def test_wrong_texts_are_shown_with_their_place(self):
        done = self.run("query", self.take, "position.z + delta", status=2)
        expect(done.stdout == "", done.stdout)
        lines = done.stderr.splitlines()
        expect(lines[1].index("delta") == lines[2].index("^^^^^"), done.stderr)
        self.run("query", "/no/such/file", "size", status=2)
        self.run("query", self.take, status=2)

    def test_nothing_found_is_said(self):
        done = self.run("query", self.take, "position.z of Prop1")
        expect("no values of position.z of Prop1" in done.stderr, done.stderr)

    def test_broken_datagrams_are_a_fault(self):
        path = self.take.with_name("cut.bin")
        path.write_bytes(pose(0, 0) + pose(1, 0)[:-7])
        done = self.run("query", path, "position.z of Pelvis", status=1)
        expect(len(done.stdout.splitlines()) == 2, done.stdout)


def main() -> int:
    sys.path.insert(0, sys.argv[2])
    import capture_writer  # pylint: disable=import-outside-toplevel,import-error

    failed = 0
    with tempfile.TemporaryDirectory() as folder:
        tests = Tests(sys.argv[1], capture_writer, Path(folder))
        for name in (name for name in dir(Tests) if name.startswith("test_")):
            try:
                getattr(tests, name)()
                print("ok  ", name)
            except Failure as failure:
                failed += 1
                print("FAIL", name, failure)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
