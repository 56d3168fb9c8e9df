# SPDX-License-Identifier: GPL-3.0-or-later
"""What `posewire-cli export` writes as C3D, MVNX and arrays of NumPy, of datagrams made here, read by others.

usage: motion_files_test.py CLI SUPPORT_DIR

The C3D reader below follows the format's public description (c3d.org) and shares nothing with the writer; MVNX is read
as XML by Python's own parser, arrays by NumPy (skipped if it is not installed) and, as an archive, by Python's own.
"""
import csv
import json
import math
import os
import struct
import subprocess
import sys
import tempfile
import zipfile
import xml.etree.ElementTree as ElementTree
from pathlib import Path

RATE = 60
START = 1_700_000_000_000_000_000
BODY = ["Pelvis", "L5", "L3", "T12", "T8", "Neck", "Head", "RightShoulder", "RightUpperArm", "RightForeArm", "RightHand",
        "LeftShoulder", "LeftUpperArm", "LeftForeArm", "LeftHand", "RightUpperLeg", "RightLowerLeg", "RightFoot",
        "RightToe", "LeftUpperLeg", "LeftLowerLeg", "LeftFoot", "LeftToe"]
NAME = 'Anna <b> & "Co" \'\x1b'
HOSTILE = [b"]]><!--", b"&lt;!ENTITY x 'y'>", b"\xff\xfe not UTF-8 \xed\xa0\x80", b"\x00\x01\x7f\xc2\x9b", b"x" * 60_000,
           "\ufffe\uffff\u202e".encode(), b"../../etc/passwd", b"=cmd|' /C calc'!A0"]
MARKERS = [(256 * 1 + 13, "pSacrum"), (256 * 7 + 2, "pTopOfHead"), (256 * 19 + 2, "pRightToe"), (60001, "P60001")]


try:
    import numpy
except ImportError:
    numpy = None


class Skipped(Exception):
    """A program that the test needs is missing."""


class Failure(Exception):
    """What was read is not what was sent."""


def expect(condition, *what):
    if not condition:
        raise Failure(*what)


def datagram(kind: str, sample: int, items: int, payload: bytes, counts=(0, 0, 0)) -> bytes:
    return b"MXTP" + kind.encode() + struct.pack(">IBBIBBBBHH", sample, 0x80, items, round(sample * 1000 / RATE), 0,
                                                 *counts, 0, len(payload)) + payload


def turn_of(sample: int, segment: int) -> tuple:
    half = 0.01 * sample + 0.05 * segment
    return (math.cos(half), 0.0, math.sin(half), 0.0)


def place_of(sample: int, segment: int) -> tuple:
    """Metres, Z up."""
    return (0.01 * sample, 0.02 * segment, 0.9 + 0.03 * segment)


def marker_of(sample: int, marker: int) -> tuple:
    """Metres, Z up."""
    return (0.1 * marker + 0.01 * sample, -0.5, 0.6 + 0.2 * marker)


def pose(sample: int, segments=len(BODY)) -> bytes:
    items = b"".join(struct.pack(">I7f", i + 1, *place_of(sample, i), *turn_of(sample, i)) for i in range(segments))
    return datagram("02", sample, segments, items, (segments, 0, 0))


def points(sample: int, count=len(MARKERS)) -> bytes:
    """Centimetres and Y up, as sent: X to Z, Y to X, Z to Y."""
    items = b""
    for i, (identity, _) in enumerate(MARKERS[:count]):
        x, y, z = marker_of(sample, i)
        items += struct.pack(">I3f", identity, 100 * y, 100 * z, 100 * x)
    return datagram("03", sample, count, items)


def text(value) -> bytes:
    raw = value if isinstance(value, bytes) else value.encode()
    return struct.pack(">i", len(raw)) + raw


def null_pose() -> bytes:
    payload = struct.pack(">I", len(BODY))
    for i, name in enumerate(BODY):
        payload += text(name) + struct.pack(">3f", *place_of(0, i))
    payload += struct.pack(">IHH", 2, 1, 13) + text("pSacrum") + struct.pack(">I3f", 0, -0.125, 0.0, 0.5)
    payload += struct.pack(">HH", 1, 2) + text("<hostile & 'point'>") + struct.pack(">I3f", 0, 0.25, 0.5, 1.0)
    return datagram("13", 0, 0, payload)


def metadata(name=NAME.encode()) -> bytes:
    return datagram("12", 0, 0, text(b"name:" + name + b"\n"))


class C3d:
    """A C3D file in Intel order with points as floats."""

    def __init__(self, data: bytes):
        block, magic, self.used, analog, self.first, last, _, scale, data_start, _, self.rate = struct.unpack_from(
            "<BBHHHHHfHHf", data)
        expect(magic == 0x50 and analog == 0 and scale < 0, "header", magic, analog, scale)
        self.parameters = self.read_parameters(data, (block - 1) * 512)
        start = self.value("POINT", "DATA_START")
        expect(start == data_start, "two places of the data", start, data_start)
        low, high = (number & 0xFFFF for number in self.value("TRIAL", "ACTUAL_END_FIELD"))
        self.frames = low + (high << 16)
        expect(last == min(self.frames, 65535), "frames", last, self.frames)
        expect(self.value("POINT", "FRAMES") & 0xFFFF == last, "POINT:FRAMES")
        expect(self.value("POINT", "USED") == self.used and self.value("ANALOG", "USED") == 0, "USED")
        expect(abs(self.value("POINT", "RATE") - self.rate) < 1e-6 and self.value("POINT", "SCALE") == scale, "RATE")
        size = 16 * self.used
        points = (start - 1) * 512
        expect(len(data) == points + self.frames * size, "size", len(data), points, self.frames, size)
        # The fourth number is a word of 16 bits: cameras that saw the point, and a residual; 0 of computed points.
        expect(not any(data[152:302]), "header: what is reserved")
        self.points = [[struct.unpack_from("<4f", data, points + frame * size + 16 * i) for i in range(self.used)]
                       for frame in range(self.frames)]

    def value(self, group: str, name: str):
        return self.parameters[group][name]

    @staticmethod
    def read_parameters(data: bytes, at: int) -> dict:
        expect(data[at + 3] == 84, "not in Intel order")
        end = at + 512 * data[at + 2]
        at += 4
        groups, items = {}, []
        while at < end:
            length, group = struct.unpack_from("<bb", data, at)
            if length == 0:
                break
            length = abs(length)
            name = data[at + 2:at + 2 + length].decode("ascii")
            offset_at = at + 2 + length
            offset = struct.unpack_from("<H", data, offset_at)[0]
            if group < 0:
                groups[-group] = name
            else:
                items.append((group, name, offset_at + 2))
            at = offset_at + offset
        parameters = {name: {} for name in groups.values()}
        for group, name, place in items:
            parameters[groups[group]][name] = C3d.read_value(data, place)
        return parameters

    @staticmethod
    def read_value(data: bytes, at: int):
        kind, dimensions = struct.unpack_from("<bB", data, at)
        sizes = list(data[at + 2:at + 2 + dimensions])
        at += 2 + dimensions
        count = math.prod(sizes)
        if kind == -1:
            raw = data[at:at + count].decode("utf-8")
            encoded = data[at:at + count]
            if dimensions < 2:
                return raw
            return [encoded[i * sizes[0]:(i + 1) * sizes[0]].decode("utf-8").rstrip() for i in range(sizes[1])]
        values = struct.unpack_from(f"<{count}{ {2: 'h', 4: 'f'}[kind] }", data, at)
        return values if dimensions else values[0]


class Tests:
    """Each method is a case; `self.folder` is empty before."""

    def __init__(self, cli: str, writer, folder: Path):
        self.cli, self.writer, self.folder = cli, writer, folder

    def export(self, frames, suffix: str) -> Path:
        """`frames`: lists of datagrams, one for each sample; or all of them back to back."""
        if isinstance(frames, bytes):
            return self.run_export(frames, suffix)
        packets = [(START + i * 1_000_000_000 // RATE, self.writer.udp_packet(one))
                   for i, frame in enumerate(frames) for one in frame]
        return self.run_export(self.writer.pcapng(packets), suffix)

    def run_export(self, content: bytes, suffix: str) -> Path:
        source, target = self.folder / "in", self.folder / f"out.{suffix}"
        source.write_bytes(content)
        done = subprocess.run([self.cli, "export", str(source), "-o", str(target), "--force"], capture_output=True,
                              text=True, check=False)
        expect(done.returncode == 0, done.stderr)
        return target

    def c3d(self, frames) -> C3d:
        return C3d(self.export(frames, "c3d").read_bytes())

    def test_c3d_holds_segment_origins(self):
        file = self.c3d([[pose(i)] for i in range(90)])
        expect(file.value("POINT", "LABELS") == BODY, file.value("POINT", "LABELS"))
        expect(file.value("POINT", "UNITS") == "mm" and file.rate == RATE and file.first == 1, "units", file.rate)
        expect(file.frames == 90, file.frames)
        for sample, points_of in enumerate(file.points):
            for segment, (x, y, z, residual) in enumerate(points_of):
                expect(residual == 0, "residual", residual)
                expect(math.dist((x, y, z), [1000 * v for v in place_of(sample, segment)]) < 0.001, sample, segment)

    def test_c3d_marks_what_is_missing(self):
        file = self.c3d([[pose(i)] for i in range(60) if i not in (20, 21, 40)])
        missing = [i for i, points_of in enumerate(file.points) if all(p[3] == -1 for p in points_of)]
        expect(missing == [20, 21, 40] and file.frames == 60, missing, file.frames)
        expect(file.points[20][0] == (0, 0, 0, -1), file.points[20][0])
        expect(abs(file.points[41][0][0] - 410) < 0.001, file.points[41][0])

    def test_c3d_prefers_markers(self):
        file = self.c3d([[pose(i), points(i, 3 if i == 10 else 4)] for i in range(30)])
        expect(file.value("POINT", "LABELS") == [name for _, name in MARKERS], file.value("POINT", "LABELS"))
        for sample, points_of in enumerate(file.points):
            for marker, (x, y, z, residual) in enumerate(points_of):
                if sample == 10 and marker == 3:
                    expect((x, y, z, residual) == (0, 0, 0, -1), "a point that was not sent")
                else:
                    expect(math.dist((x, y, z), [1000 * v for v in marker_of(sample, marker)]) < 0.001, sample, marker)

    def test_c3d_counts_beyond_sixteen_bits(self):
        file = self.c3d(b"".join(pose(i, 1) for i in range(66_000)))
        expect(file.frames == 66_000 and file.value("POINT", "LONG_FRAMES") == 66_000, file.frames)

    def test_c3d_splits_long_lists_of_labels(self):
        ids = [60001 + i for i in range(300)]
        frames = [[datagram("03", sample, len(part), b"".join(struct.pack(">I3f", one, 100, 200, 300) for one in part))]
                  for sample, part in enumerate((ids[:200], ids[200:]))]
        file = self.c3d(frames)
        labels = file.value("POINT", "LABELS") + file.value("POINT", "LABELS2")
        expect(labels == [f"P{one}" for one in ids] and len(file.value("POINT", "LABELS")) == 255, len(labels))
        expect([sum(point[3] == 0 for point in frame) for frame in file.points] == [200, 100], "what was sent")

    def test_a_single_frame_has_a_rate(self):
        expect(self.c3d([[pose(0)]]).rate == RATE, "C3D")
        expect(self.mvnx([[pose(0)]]).get("frameRate") == str(RATE), "MVNX")

    def test_c3d_names_its_subject(self):
        file = self.c3d([[metadata(), pose(0)]] + [[pose(i)] for i in range(1, 9)])
        name = file.value("SUBJECTS", "NAMES")
        expect(name == [NAME.replace("\x1b", "\u241b")], name)

    def mvnx(self, frames: list):
        root = ElementTree.parse(self.export(frames, "mvnx")).getroot()
        space = "{http://www.xsens.com/mvn/mvnx}"
        expect(root.tag == space + "mvnx" and root.get("version") == "4", root.tag)
        for element in root.iter():
            expect(element.tag.startswith(space), element.tag)
            element.tag = element.tag[len(space):]
            expect(all(element.attrib.values()), "an empty attribute", element.tag, element.attrib)
            expect(len(element) or element.attrib or (element.text or "").strip(), "an empty element", element.tag)
        expect([child.tag for child in root] == ["mvn", "comment", "subject", "securityCode"], list(root))
        return root.find("subject")

    def test_mvnx_has_the_parts_of_the_schema(self):
        subject = self.mvnx([[null_pose(), metadata(), pose(0)]] + [[pose(i)] for i in range(1, 50)])
        expect([child.tag for child in subject] == ["comment", "segments", "joints", "frames"], list(subject))
        expect(subject.get("userScenario") and subject.get("originalFilename"), subject.attrib)
        expect(subject.get("configuration") == "FullBody", subject.attrib)
        expect(subject.get("label") == NAME.replace("\x1b", "\u241b"), subject.get("label"))
        expect(subject.get("frameRate") == str(RATE) and subject.get("segmentCount") == "23", subject.attrib)
        expect(subject.get("recDate") == "Tue Nov 14 22:13:20.000 2023", subject.get("recDate"))
        expect(subject.get("recDateMSecsSinceEpoch") == str(START // 1_000_000), subject.attrib)
        segments = subject.findall("segments/segment")
        expect([one.get("label") for one in segments] == BODY, "labels")
        expect([one.get("id") for one in segments] == [str(i + 1) for i in range(23)], "ids")
        labels = [one.get("label") for one in segments[0].findall("points/point")]
        expect(labels == ["pSacrum", "hostilepoint"], labels)
        expect(segments[0].find("points/point/pos_b").text == "-0.125000 0.000000 0.500000", "pos_b")
        joints = subject.findall("joints/joint")
        expect(len(joints) == 22 and joints[0].get("label") == "jL5S1", joints)
        knee = next(one for one in joints if one.get("label") == "jRightKnee")
        expect(knee.find("connector1").text == "RightUpperLeg/jRightKnee", knee.find("connector1").text)
        expect(knee.find("connector2").text == "RightLowerLeg/jRightKnee", knee.find("connector2").text)
        self.check_frames(subject.find("frames"), list(range(50)))

    @staticmethod
    def check_frames(frames, samples: list):
        expect(frames.get("segmentCount") == "23" and frames.get("jointCount") == "22", frames.attrib)
        types = [(one.get("type"), int(one.get("index"))) for one in frames[:3]]
        expect(types == [("identity", -3), ("tpose", -2), ("tpose-isb", -1)], types)
        tpose = [float(v) for v in frames.find("frame[@type='identity']/position").text.split()]
        expect(math.dist(tpose[66:69], place_of(0, 22)) < 1e-5, tpose)
        normal = frames.findall("frame[@type='normal']")
        expect([int(one.get("index")) for one in normal] == samples, "indices")
        for sample, frame in zip(samples, normal):
            expect(abs(int(frame.get("time")) - sample * 1000 / RATE) <= 1, frame.get("time"))
            expect(int(frame.get("ms")) == (START + sample * 1_000_000_000 // RATE) // 1_000_000, frame.get("ms"))
            milliseconds = round(sample * 1000 / RATE)
            code = f"00:00:{milliseconds // 1000:02}:{int(milliseconds % 1000 * RATE / 1000 + 1e-6):02}"
            expect(frame.get("tc") == code, frame.get("tc"), code)
            position = [float(v) for v in frame.find("position").text.split()]
            orientation = [float(v) for v in frame.find("orientation").text.split()]
            angles = [float(v) for v in frame.find("jointAngle").text.split()]
            expect((len(position), len(orientation), len(angles)) == (69, 92, 66), "counts")
            for segment in range(23):
                expect(math.dist(position[3 * segment:3 * segment + 3], place_of(sample, segment)) < 2e-6, sample)
                expect(math.dist(orientation[4 * segment:4 * segment + 4], turn_of(sample, segment)) < 2e-6, sample)
            # All turn about Y, each by 0.1 rad more than the one before: all of it is flexion, or its opposite.
            expect(abs(abs(angles[2]) - math.degrees(0.1)) < 1e-3, angles[:3])
            expect(abs(angles[0]) < 1e-3 and abs(angles[1]) < 1e-3, angles[:3])

    def test_hostile_names_are_text(self):
        for name in HOSTILE:
            frames = [[metadata(name), null_pose(), pose(0)]] + [[pose(i)] for i in range(1, 5)]
            subject = self.mvnx(frames)
            expect(subject.get("label") and len(subject.get("label").encode()) <= 256, name[:20])
            expect(self.c3d(frames).value("SUBJECTS", "USED") == 1, name[:20])
            self.export(frames, "bvh")
        expect(sorted(one.name for one in self.folder.iterdir()) == ["in", "out.bvh", "out.c3d", "out.mvnx"], "files")

    def test_type_25_goes_with_its_sample(self):
        """Type 25 comes behind the pose, once behind the next one, once not at all, and once with no time in it. The
        counter jumps, without type 25, and begins again, and the times go on."""
        def clock(sample: int, behind: int) -> bytes:
            return datagram("25", sample, 1, text("no time:" if sample == 9 else codes[sample + behind]))
        codes = [f"23:59:{48 + i // 60:02}.{round(i % 60 * 1000 / 60):03}" for i in range(120)]
        frames = [[pose(i), clock(i, 0)] for i in range(60)]
        frames[8].append(frames[7].pop())
        del frames[5][1]
        wanted = [None if i in (5, 9) else code for i, code in enumerate(codes)]
        ahead = [[pose(20_000 + i)] for i in range(30)]
        again = [[pose(i), clock(i, 60)] for i in range(60) if i != 9]
        lines = self.export(frames + ahead + again, "jsonl").read_text().splitlines()
        found = [(one["run"], one["sample"], one.get("timeOfDay"))
                 for one in map(json.loads, lines) if one["segments"] is not None]
        runs = [(1, i, wanted[i]) for i in range(60)] + [(2, 20_000 + i, None) for i in range(30)]
        runs += [(3, i, wanted[60 + i]) for i in range(60) if i != 9]
        expect(found == runs, found)
        with open(self.export(frames, "csv"), encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        expect([row["time of day"] or None for row in rows] == wanted[:60], rows[:10])
        expect(list(rows[0])[-1] == "time of day", list(rows[0])[-3:])  # no column moves
        tags = [one.get("tc") for one in self.mvnx(frames).findall("frames/frame[@type='normal']")]
        expect(tags[5] == "00:00:00:04" and tags[7] == "23:59:48:07" and tags[59] == "23:59:48:58", tags)
        arrays = self.numpy(frames)
        expect(arrays["time_of_day_ms"].tolist() == [
            -1 if code is None else 86_388_000 + int(code[-3:]) for code in wanted[:60]], arrays["time_of_day_ms"])

    def test_without_type_25_there_is_no_time_of_day(self):
        frames = [[pose(i)] for i in range(10)]
        expect("time of day" not in self.export(frames, "csv").read_text(), "CSV")
        expect("timeOfDay" not in self.export(frames, "jsonl").read_text(), "JSON Lines")
        with zipfile.ZipFile(self.export(frames, "npz")) as archive:
            expect("time_of_day_ms.npy" not in archive.namelist(), archive.namelist())

    def test_mvnx_leaves_out_what_is_missing(self):
        kept = [i for i in range(40) if i not in (7, 8)]
        subject = self.mvnx([[null_pose()]] + [[pose(i)] for i in range(40) if i in kept])
        indices = [int(one.get("index")) for one in subject.findall("frames/frame[@type='normal']")]
        expect(indices == kept, indices)

    def test_mvnx_says_that_a_null_pose_was_not_sent(self):
        subject = self.mvnx([[pose(i)] for i in range(5)])
        expect("assumed" in subject.find("comment").text, subject.find("comment").text)

    def test_mvnx_comes_back_as_it_was(self):
        first = self.export([[null_pose(), metadata(), pose(0)]] + [[pose(i)] for i in range(1, 50)], "mvnx")
        again = self.run_export(first.read_bytes(), "again.mvnx")
        def numbers(path):
            return [[float(v) for v in one.text.split()] for one in ElementTree.parse(path).iter()
                    if one.tag.endswith(("}position", "}orientation", "}pos_b"))]
        before, after = numbers(first), numbers(again)
        expect(len(before) == len(after), len(before), len(after))
        expect(all(math.dist(a, b) < 1e-5 for a, b in zip(before, after)), "numbers")

    def numpy(self, frames):
        if numpy is None:
            raise Skipped("python3-numpy is not installed")
        path = self.export(frames, "npz")
        with zipfile.ZipFile(path) as archive:
            expect(archive.testzip() is None, "a wrong checksum")
        return numpy.load(path, allow_pickle=False)

    def test_numpy_holds_what_was_sent(self):
        arrays = self.numpy([[pose(i)] for i in range(40)])
        expect(list(arrays["names"]) == BODY, arrays["names"])
        places = numpy.float32([[place_of(i, segment) for segment in range(len(BODY))] for i in range(40)])
        turns = numpy.float32([[turn_of(i, segment) for segment in range(len(BODY))] for i in range(40)])
        expect(numpy.array_equal(arrays["position"], places), "positions")
        expect(numpy.abs(arrays["orientation"] - turns).max() < 1e-6, "orientations")
        expect(list(arrays["provenance_names"]) == ["", "assumed", "solved", "sent"], arrays["provenance_names"])
        expect((arrays["provenance"] == 3).all() and arrays["provenance"].shape == (40, 23), "provenance")
        expect((arrays["sample"] == range(40)).all() and (arrays["run"] == 1).all(), "counters")
        expect(numpy.abs(arrays["time"] - numpy.arange(40) / RATE).max() < 1e-9, arrays["time"])
        expect((arrays["time_code_ms"] == [round(i * 1000 / RATE) for i in range(40)]).all(), "time codes")
        expect(arrays["received_ns"][0] == START and (arrays["type"] == 2).all(), arrays["received_ns"])

    def test_numpy_has_rows_of_nan_for_what_is_missing(self):
        arrays = self.numpy([[pose(i)] for i in range(40) if i not in (7, 8)])
        missing = numpy.isin(numpy.arange(40), (7, 8))
        for name in ("position", "orientation"):
            expect((numpy.isnan(arrays[name]).all(axis=(1, 2)) == missing).all(), name)
            expect((numpy.isnan(arrays[name]).any(axis=(1, 2)) == missing).all(), name)
        expect(((arrays["provenance"] == 0).all(axis=1) == missing).all(), "provenance")
        expect(((arrays["time_code_ms"] == -1) == missing).all() and ((arrays["received_ns"] == -1) == missing).all(),
               "times")
        expect((arrays["sample"] == range(40)).all(), arrays["sample"])

    def test_numpy_of_many_pieces(self):
        count = 3000
        arrays = self.numpy([[pose(i)] for i in range(count)])
        expected = numpy.float32([place_of(i, 22) for i in range(count)])
        expect(numpy.array_equal(arrays["position"][:, 22], expected), "positions beyond the first piece")


def main() -> int:
    system = "/usr/bin/python3"  # it has what the distribution packages
    if numpy is None and os.path.exists(system) and os.path.realpath(sys.executable) != os.path.realpath(system):
        return subprocess.run([system, *sys.argv], check=False).returncode
    sys.path.insert(0, sys.argv[2])
    import capture_writer  # pylint: disable=import-outside-toplevel
    failures = 0
    for name in [name for name in dir(Tests) if name.startswith("test_")]:
        with tempfile.TemporaryDirectory() as folder:
            try:
                getattr(Tests(sys.argv[1], capture_writer, Path(folder)), name)()
                print("ok     ", name)
            except Skipped as reason:
                print("skipped", name, reason)
            except Failure as failure:
                failures += 1
                print("FAILED ", name, failure)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
