#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Two readers, one truth: tshark with the dissector against `posewire-cli decode --json`, every field.

usage: dissector_test.py POSEWIRE_CLI MXTP_LUA SOURCE_DIR [TEST…]
Prints what disagrees and exits 1 if anything does; exits 77 where there is no tshark.
"""

import json
import pathlib
import random
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

CLI, SCRIPT, SOURCE_DIR = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
sys.path[:0] = [str(SOURCE_DIR / "tests/support"), str(SOURCE_DIR / "tests/app/cli")]
import capture_writer  # noqa: E402
import dissected  # noqa: E402
from datagrams import STAMP, as_tcp, as_udp, damaged, goldens  # noqa: E402
from second_encoder_cases import all_cases  # noqa: E402

def decode(path: pathlib.Path) -> list:
    done = subprocess.run([CLI, "decode", str(path), "--json"], capture_output=True, timeout=240, check=False)
    return [json.loads(line) for line in done.stdout.decode("utf-8").splitlines()]


def difference(where: str, wanted, got) -> str | None:
    """The first place where they disagree."""
    if isinstance(wanted, dict) and isinstance(got, dict):
        if set(wanted) != set(got):
            return f"{where}: {sorted(wanted)} against {sorted(got)}"
        pairs = [(f"{where}.{key}", wanted[key], got[key]) for key in wanted]
    elif isinstance(wanted, list) and isinstance(got, list):
        if len(wanted) != len(got):
            return f"{where}: {len(wanted)} against {len(got)}"
        pairs = [(f"{where}[{i}]", *pair) for i, pair in enumerate(zip(wanted, got))]
    else:
        return None if got == wanted else f"{where}: {wanted!r} against {got!r}"
    return next((found for found in (difference(*pair) for pair in pairs) if found), None)


def about_datagram(decoded: dict) -> dict:
    wanted = {key: value for key, value in decoded.items()
              if key not in ("index", "offset", "stampNs", "source", "bytes")}
    if "error" in wanted:
        wanted["error"] = {key: wanted["error"][key] for key in ("code", "offset", "text")}
    return wanted


def about(decoded: dict) -> dict:
    return {"skipped": decoded["size"]} if "skipped" in decoded else about_datagram(decoded)


def tells_its_end(datagram: bytes) -> bool:
    """Older senders leave the payload size out; then some types end only where the next datagram begins."""
    is_sized = datagram[22:24] != b"\0\0"
    return is_sized or datagram[4:6] not in (b"04", b"12", b"23", b"24", b"77")


def pieces(data: bytes, seed: int, longest: int) -> list:
    """The stream cut anywhere."""
    chance, cut, at = random.Random(seed), [], 0
    while at < len(data):
        size = chance.randint(1, longest)
        cut.append(data[at:at + size])
        at += size
    return cut


def pose_of(ids: list, counts=(0, 0, 0), counter=0x80) -> bytes:
    """Type 02 with these IDs."""
    body = b"".join(struct.pack(">I7f", segment, 0, 0, 0, 1, 0, 0, 0) for segment in ids)
    return b"MXTP02" + struct.pack(">IBBIBBBBHH", 1, counter, len(ids), 0, 0, *counts, 0, len(body)) + body


class Dissector(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def dissect(self, packets: list) -> list:
        path = self.folder / "capture.pcap"
        path.write_bytes(capture_writer.pcap(packets))
        return list(dissected.protocols(SCRIPT, path, self.folder))

    def compare_udp(self, datagrams: list):
        """`datagrams`: pairs of a label and bytes."""
        frames = self.dissect(as_udp(data for _, data in datagrams))
        decoded = decode(self.folder / "capture.pcap")
        self.assertEqual(len(datagrams), len(decoded))
        self.assertEqual(len(datagrams), len(frames))
        faults = []
        for (label, data), wanted, trees in zip(datagrams, decoded, frames):
            got = dissected.object_of(trees[0]) if len(trees) == 1 else None
            fault = difference(label, about_datagram(wanted), got)
            if fault:
                faults.append(f"{fault}   {data[:80].hex()}")
        self.assertFalse(faults, "\n".join([f"{len(faults)} of {len(datagrams)}"] + faults[:12]))

    def compare_tcp(self, data: bytes, packets: list):
        (self.folder / "raw.bin").write_bytes(data)
        got = []
        wanted = [about(decoded) for decoded in decode(self.folder / "raw.bin")]
        for trees in self.dissect(packets):
            for tree in trees:
                skipped = dissected.children(tree, "mxtp.skipped")
                got.append({"skipped": int(skipped[0].get("size"))} if skipped else dissected.object_of(tree))
        captured = decode(self.folder / "capture.pcap")
        self.assertEqual({"192.0.2.1:40001"}, {one["source"] for one in captured if "skipped" not in one})
        self.assertIsNone(difference("capture", wanted, [about(one) for one in captured]))
        datagrams = [[entry for entry in entries if "skipped" not in entry] for entries in (wanted, got)]
        self.assertIsNone(difference("stream", *datagrams))
        self.assertEqual(sum(w.get("skipped", 0) for w in wanted), sum(g.get("skipped", 0) for g in got))

    def test_agrees_on_every_golden(self):
        self.compare_udp(list(goldens().items()))

    def test_reads_every_datagram_of_a_packet(self):
        joined = pose_of(range(1, 24)) + pose_of(range(1, 6)) + pose_of(range(1, 24))
        trees = self.dissect(as_udp([joined]))[0]
        decoded = decode(self.folder / "capture.pcap")
        self.assertEqual([23, 5, 23], [one["items"] for one in decoded])
        self.assertEqual(["3 datagrams in one packet"], decoded[0]["notices"])
        for wanted, tree in zip(decoded, trees, strict=True):
            wanted["notices"] = []
            self.assertIsNone(difference("joined", about_datagram(wanted), dissected.object_of(tree)))

    def test_agrees_on_truncations(self):
        self.compare_udp([(f"{name} cut to {size}", data[:size]) for name, data in goldens().items()
                          for size in range(4, len(data)) if size < 160 or size % 11 == 0 or size > len(data) - 20])

    def test_agrees_on_damaged_bytes(self):
        chance, cases = random.Random(1), []
        for name, data in goldens().items():
            for number in range(60):
                cases.append((f"{name}, damage {number}", damaged(chance, data)))
        self.compare_udp(cases)

    def test_agrees_on_what_a_second_encoder_sends(self):
        self.compare_udp([(case.label, case.to_bytes()) for case in all_cases(5)])

    def test_puts_streams_together(self):
        data = b"".join(golden for golden in goldens().values() if tells_its_end(golden))
        for longest in [7, 400, 1460, 20000]:
            with self.subTest(longest=longest):
                self.compare_tcp(data, as_tcp(pieces(data, longest, longest)))

    def test_reads_streams_whose_segments_hold_whole_datagrams(self):
        datagrams = list(goldens().values())
        for size in [1, 3, len(datagrams)]:
            with self.subTest(datagrams_in_a_segment=size):
                segments = [b"".join(datagrams[at:at + size]) for at in range(0, len(datagrams), size)]
                self.compare_tcp(b"".join(datagrams), as_tcp(segments))

    def test_puts_out_of_order_and_repeated_segments_together(self):
        data = b"".join(golden for golden in goldens().values() if tells_its_end(golden))
        packets = as_tcp(pieces(data, 3, 900))
        packets[5], packets[6] = packets[6], packets[5]
        packets.insert(9, packets[8])
        self.compare_tcp(data, packets)

    def test_reads_what_follows_a_gap_in_a_stream(self):
        pose = goldens()["02_quaternion_counted"]
        packets = as_tcp(pieces(pose * 6, 4, 400))
        del packets[6]
        path = self.folder / "gap.pcap"
        path.write_bytes(capture_writer.pcap(packets))
        read = [one for one in decode(path) if "body" in one]
        trees = [tree for trees in self.dissect(packets) for tree in trees]
        dissected_poses = [tree for tree in trees if "body" in dissected.object_of(tree)]
        self.assertIn(len(read), (4, 5))
        self.assertGreaterEqual(len(read), len(dissected_poses))

    def test_finds_datagrams_among_rubbish_in_a_stream(self):
        pose = goldens()["02_quaternion_counted"]
        data = pose + b"rubbish MX MXTP" + pose + bytes(50) + pose
        self.compare_tcp(data, as_tcp(pieces(data, 2, 500)))

    def test_recognizes_datagrams_on_other_ports(self):
        pose, target = goldens()["02_quaternion_counted"], ("192.0.2.2", 20001)
        frames = self.dissect([(STAMP, capture_writer.udp_packet(pose, target=target))])
        self.assertEqual([1], [len(trees) for trees in frames])
        self.assertEqual(2, sum(len(trees) for trees in self.dissect(as_tcp([pose, pose], target))))

    def test_waits_for_the_rest_of_the_first_datagram_on_other_ports(self):
        pose, target = goldens()["02_quaternion_counted"], ("192.0.2.2", 20001)
        trees = [tree for trees in self.dissect(as_tcp([pose[:100], pose[100:] + pose], target)) for tree in trees]
        decoded = about_datagram(decode(self.folder / "capture.pcap")[0])
        self.assertIsNone(difference("stream", [decoded] * 2, [dissected.object_of(tree) for tree in trees]))

    def names_in(self, *datagrams: bytes) -> list:
        """The segment names that a filter finds, for each datagram."""
        lines = self.read_fields(list(datagrams), "mxtp", "mxtp.segment.name")
        return [line.split(",") for line in lines]

    def test_names_props_by_their_place(self):
        for first_id in (24, 25):
            for revision in "EJK":
                with self.subTest(revision=revision, first_id=first_id):
                    feet = [21, 23, 24] if revision == "E" else [21, 22, 23]
                    names = self.names_in(pose_of([*range(1, 21), *feet, *range(first_id, first_id + 4)]))[0]
                    self.assertEqual(["LeftLowerLeg", "LeftFoot", "LeftToe", "Prop1", "Prop2", "Prop3", "Prop4"],
                                     names[20:])
        names = self.names_in(pose_of([1, 2, 3, 24, 25], counts=(3, 2, 0)), pose_of([1, 2, 3, 4, 5], counts=(3, 2, 0)))
        self.assertEqual([["Pelvis", "L5", "L3", "Prop1", "Prop2"]] * 2, names)

    def test_names_the_segments_of_parts_by_their_ids(self):
        names = self.names_in(pose_of([21, 22, 23, 25, 26, 27, 28], counter=0x81))
        self.assertEqual([["LeftLowerLeg", "LeftFoot", "LeftToe", "Prop1", "Prop2", "Prop3", "Prop4"]], names)

    def test_takes_tags_in_places_of_props_for_tags(self):
        def pose(digits, last_ids, turn):
            ids = [*range(1, 24), *last_ids]
            items = b"".join(struct.pack(f">I3f{len(turn)}f", one, 1, 2, 3, *turn) for one in ids)
            return b"MXTP" + digits + struct.pack(">IBBI8x", 1, 0x80, len(ids), 0) + items
        cases = [(b"02", [24, 25, 1234, 0], (1, 0, 0, 0)), (b"02", [24, 1234], (0, 1, 0, 0)),
                 (b"02", [24, 25, 26, 27, 68], (1, 0, 0, 0)), (b"02", [70, 24, 25], (1, 0, 0, 0)),
                 (b"01", [24, 99], (0, 0, 0)), (b"01", [24, 99], (0, 0, 1))]
        self.compare_udp([(str(case), pose(*case)) for case in cases])

    def test_names_points_before_tags(self):
        ids = [269, 513, 1025, 5001, 5002]
        body = b"".join(struct.pack(">Ifff", point, 0, 0, 0) for point in ids)
        lines = self.read_fields([b"MXTP03" + struct.pack(">IBBI6xH", 1, 0x80, len(ids), 0, len(body)) + body], "mxtp",
                                 "mxtp.point.name")
        self.assertEqual("pSacrum,jL5S1,jL1T12", lines[0])

    def test_time_codes_that_are_no_text_stay_xml(self):
        code = b"MXTP25" + struct.pack(">IBBI6xHi", 1, 0x80, 1, 0, 16, 12) + b"12:34:\xff\x00.789"
        self.compare_udp([("type 25", code)])
        self.assertIn("12:34:??.789", self.read_fields([code], "mxtp", "_ws.col.Info")[0])

    def test_writes_no_control_character_of_a_sender(self):
        text = "name:\x1b]0;title\x07\x9b31m\ncolor:#\x1b[2J".encode("utf-8")
        tags = b"MXTP12" + struct.pack(">IBBI6xHi", 0, 0x80, 1, 0, len(text) + 4, len(text)) + text
        name = "Pel\x1b[31mvis\x7f".encode("utf-8")
        body = struct.pack(">Ii", 1, len(name)) + name + struct.pack(">3fI", 0, 0, 1, 0)
        pose = b"MXTP13" + struct.pack(">IBBI6xH", 0, 0x80, 1, 0, len(body)) + body
        path = self.folder / "capture.pcap"
        path.write_bytes(capture_writer.pcap(as_udp([tags, pose])))
        process = dissected.run_tshark(SCRIPT, path, self.folder, "-V")
        output, _ = process.communicate(timeout=60)
        shown = output.decode("utf-8")
        self.assertRegex(shown, r"Pel.*31mvis")
        self.assertEqual([], [line for line in shown.splitlines() if re.search("[\x00-\x1f\x7f-\x9f]", line)])

    def test_leaves_other_datagrams_alone(self):
        frames = self.dissect(as_udp([b"{}", b"", b"MXT", b"\0" * 99]))
        self.assertEqual([0, 0, 0, 0], [len(trees) for trees in frames])

    def test_puts_ip_fragments_together(self):
        gloves = goldens()["02_quaternion_gloves"]
        fragments = capture_writer.udp_fragments(gloves, 1480, 77)
        frames = self.dissect([(STAMP, fragment) for fragment in fragments])
        got = dissected.object_of(frames[-1][0])
        self.assertEqual(67, len(got["body"]["segments"]))
        self.assertIsNone(difference("fragments", [about_datagram(one) for one in decode(self.folder / "capture.pcap")],
                                     [got]))

    def read_fields(self, datagrams: list, wanted_filter: str, *fields: str) -> list:
        path = self.folder / "fields.pcap"
        path.write_bytes(capture_writer.pcap(as_udp(datagrams)))
        arguments = [word for field in fields for word in ("-e", field)]
        process = dissected.run_tshark(SCRIPT, path, self.folder, "-Y", wanted_filter, "-T", "fields", *arguments)
        output, _ = process.communicate(timeout=60)
        self.assertEqual(0, process.returncode, wanted_filter)
        return output.decode("utf-8").splitlines()

    def test_describes_a_datagram_in_one_line(self):
        found = goldens()
        lines = self.read_fields([found["02_quaternion_counted"], found["13_null_pose_segments"], b"MXTP02" + bytes(9)],
                                 "mxtp", "_ws.col.Protocol", "_ws.col.Info")
        self.assertEqual("MXTP\t02 Pose, quaternion, character 3, sample 16909060, 23 segments", lines[0].strip())
        self.assertRegex(lines[1], r"^MXTP\t13 Null pose, character 3, sample 0, datagram 0, 3 segments, 0 points")
        self.assertRegex(lines[2], r"^MXTP\t02 Pose, quaternion, .*\[headerTruncated\]")

    def test_every_field_is_used(self):
        names = sorted(set(re.findall(r'(?:filter|name_filter|item_filter) = "([^"]+)"', SCRIPT.read_text("utf-8"))))
        self.assertGreater(len(names), 50)
        lines = self.read_fields(list(goldens().values()), "mxtp", "frame.number", *names)
        rows = [line.split("\t") for line in lines]
        self.assertEqual([], [name for i, name in enumerate(names, 1) if not any(row[i] for row in rows)])

    def test_filters_by_name_value_and_fault(self):
        found = goldens()
        pose = found["02_quaternion_counted"]
        datagrams = [pose, found["12_metadata_counted"], pose[:100]]
        for wanted, frames in [('mxtp.segment.name == "LeftHand"', ["1"]), ("mxtp.type == 12", ["2"]),
                               ('mxtp.tag.name == "color"', ["2"]), ("mxtp.error", ["3"]),
                               ("mxtp.error.payloadTruncated", ["3"]), ("mxtp.sample == 16909060", ["1", "3"]),
                               ("mxtp.segment.position.x > -1e9 && mxtp.last == 1", ["1", "3"])]:
            self.assertEqual(frames, self.read_fields(datagrams, wanted, "frame.number"), wanted)



if __name__ == "__main__":
    if shutil.which("tshark") is None:
        print("SKIPPED: there is no tshark; packaging/install-dependencies installs it")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1] + sys.argv[4:], verbosity=2)
