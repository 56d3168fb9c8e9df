# SPDX-License-Identifier: GPL-3.0-or-later
"""The figure that `posewire-cli export` writes as glTF and BVH, in other programs.

usage: figure_files_test.py CLI SUPPORT_DIR

A reader and skinner of its own (gltf_file.py) measures it in extreme poses. Khronos' validator (npm gltf-validator, found by
node: NODE_PATH) and Blender look at it, too, when they are there; else their cases are skipped.
"""
import json
import math
import os
import shutil
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

from gltf_file import GltfFile, area_of, length_of, product, turned
from motion_files_test import BODY, RATE, Failure, Tests, datagram, expect, text

PARENTS = [-1, 0, 1, 2, 3, 4, 5, 4, 7, 8, 9, 4, 11, 12, 13, 0, 15, 16, 17, 0, 19, 20, 21]
FINGERS = ["Carpus"] + [finger + bone for finger in ("First", "Second", "Third", "Fourth", "Fifth")
                        for bone in ("MC", "PP", "MP", "DP") if finger + bone != "FirstMP"]
NAMES = BODY + [side + name for side in ("Left", "Right") for name in FINGERS]
X, Y, Z = (1, 0, 0), (0, 1, 0), (0, 0, 1)


def origins() -> list:
    """Of a body of 1.75 m in the null pose, metres, Z up."""
    right = {"RightShoulder": (0, -0.028, 1.4196), "RightUpperArm": (0, -0.165, 1.4196),
             "RightForeArm": (0, -0.45, 1.4196), "RightHand": (0, -0.685, 1.4196), "RightUpperLeg": (0, -0.084, 0.9275),
             "RightLowerLeg": (0, -0.084, 0.499), "RightFoot": (0, -0.084, 0.08), "RightToe": (0.148, -0.084, 0.015)}
    centre = dict(zip(BODY, [(0, 0, z) for z in (0.9275, 1.0275, 1.1383, 1.2394, 1.3404, 1.4817, 1.5758)]))
    left = {name.replace("Right", "Left"): (x, -y, z) for name, (x, y, z) in right.items()}
    body = {**centre, **right, **left}
    places = [body[name] for name in BODY]
    for sign in (1, -1):
        for name in FINGERS:
            bone = {"MC": 0.02, "PP": 0.088, "MP": 0.132, "DP": 0.159}.get(name[-2:], 0)
            across = {"First": 0.03, "Second": 0.02, "Third": 0.005, "Fourth": -0.01, "Fifth": -0.025}.get(name[:-2], 0)
            places.append((across, sign * (0.685 + bone * (0.6 if name.startswith("First") else 1)), 1.4196))
    return places


ORIGINS = origins()


def parent_of(segment: int) -> int:
    """In NAMES."""
    if segment < len(BODY):
        return PARENTS[segment]
    finger = (segment - len(BODY)) % len(FINGERS)
    hand = segment - finger
    if finger == 0:
        return BODY.index("LeftHand" if hand == len(BODY) else "RightHand")
    return hand if FINGERS[finger].endswith("MC") else segment - 1


def turn(axis: tuple, degrees: float) -> tuple:
    half = math.radians(degrees) / 2
    return tuple(math.sin(half) * part for part in axis) + (math.cos(half),)


def posed(turns: dict, count: int) -> list:
    """Where segments are, and how turned (x y z w), by turns against their parents."""
    segments = []
    for i in range(count):
        own = turns.get(NAMES[i], (0, 0, 0, 1))
        parent = parent_of(i)
        if parent < 0:
            segments.append((ORIGINS[i], own))
            continue
        place, rotation = segments[parent]
        offset = turned(rotation, [a - b for a, b in zip(ORIGINS[i], ORIGINS[parent])])
        segments.append((tuple(a + b for a, b in zip(place, offset)), product(rotation, own)))
    return segments


def take(poses: list, count=len(BODY)) -> list:
    """Datagrams of each frame; the first has the null pose, too."""
    null = struct.pack(">I", count)
    for name, place in zip(NAMES[:count], ORIGINS):
        null += text(name) + struct.pack(">3f", *place)
    frames = []
    for sample, turns in enumerate(poses):
        items = b"".join(struct.pack(">I7f", i + 1, *place, rotation[3], *rotation[:3])
                         for i, (place, rotation) in enumerate(posed(turns, count)))
        frames.append([datagram("02", sample, count, items, (len(BODY), 0, count - len(BODY)))])
    frames[0].insert(0, datagram("13", 0, 0, null + struct.pack(">I", 0)))
    return frames


def y_up(place) -> tuple:
    return (place[1], place[2], place[0])


FIST = {side + name: turn(X, (-1 if side == "Left" else 1) * 70) for side in ("Left", "Right") for name in FINGERS
        if name[-2:] in ("PP", "MP", "DP") and not name.startswith("First")}
POSES = [{}, {"RightForeArm": turn(Z, 125)}, {"RightLowerLeg": turn(Y, 110)}, {"RightForeArm": turn(Y, 90)},
         {"RightHand": turn(X, 70)}, {"RightUpperArm": turn(Y, 80), "RightUpperLeg": turn(Y, -90), "Head": turn(Z, 60)}]
# Segment, axis across the ring in the file, where rings are from its origin, how near to it they are, pose: metres.
RINGS = [("RightForeArm", 0, (-0.03, -0.02, -0.01, 0.001, 0.01, 0.02, 0.03), 0.12, 1),
         ("RightLowerLeg", 1, (-0.03, -0.02, -0.01, 0.001, 0.01, 0.02, 0.03), 0.16, 2),
         ("RightHand", 0, (0.001, 0.02, 0.05, 0.11, 0.17, 0.2), 0.3, 3),
         ("RightHand", 0, (-0.02, -0.01, 0.001, 0.01, 0.02), 0.09, 4)]


def least_of_rings(file: GltfFile, shown: list, only=None) -> float:
    """The least share of its girth that a ring keeps; `shown`: vertices in each pose. By its area it may be 1 % less:
    where a joint bends it is flatter."""
    least = math.inf
    for segment, axis, places, reach, pose in RINGS if only is None else [RINGS[only]]:
        for place in places:
            centre = list(y_up(ORIGINS[BODY.index(segment)]))
            centre[axis] += place
            ring = file.ring(centre, axis, reach)
            expect(0.1 < length_of(ring, file.positions) < 0.6, "no ring", segment, place)
            for measure, power, flattening in ((length_of, 1, 0), (area_of, 0.5, 0.01)):
                share = (measure(ring, shown[pose]) / measure(ring, file.positions)) ** power
                least = min(least, share + flattening)
    return least


class FigureTests:
    """Each method is a case; `self.folder` is empty before. What a case cannot do it returns as text."""

    def __init__(self, cli: str, writer, folder: Path):
        self.folder, self.tests = folder, Tests(cli, writer, folder)

    def glb(self, poses: list, count=len(BODY)) -> GltfFile:
        return GltfFile(self.tests.export(take(poses, count), "glb").read_bytes())

    def test_rings_hold_when_joints_bend(self):
        file = self.glb(POSES)
        least = least_of_rings(file, [file.skinned(key) for key in range(len(POSES))])
        expect(least > 0.95, least)
        old = file.skinned(1, file.collapsed())
        expect(least_of_rings(file, [old] * len(POSES), 0) < 0.87, "the measure sees nothing of a pinched elbow")

    def test_segments_are_where_they_were_sent(self):
        file = self.glb([FIST, *POSES], len(NAMES))
        for key, turns in enumerate([FIST, *POSES]):
            for name, (place, _) in zip(NAMES, posed(turns, len(NAMES))):
                off = math.dist(file.world(file.node(name), key)[1], y_up(place))
                expect(off < 1e-5, name, key, off)

    def test_fingers_move_the_mesh(self):
        file = self.glb([{}, FIST], len(NAMES))
        rest, fist = file.skinned(0), file.skinned(1)
        for name in ("LeftSecondDP", "RightThirdDP", "RightFifthDP"):
            joint = file.skin["joints"].index(file.node(name))
            tip = [i for i, (joints, weights) in enumerate(zip(file.joints, file.weights))
                   if weights[joints.index(joint) if joint in joints else 0] > 0.9 and joint in joints]
            expect(len(tip) > 5, name, len(tip))
            expect(min(math.dist(rest[i], fist[i]) for i in tip) > 0.04, name)

    def test_hands_rest_without_fingers(self):
        file = self.glb(POSES)
        expect(not any(node["name"].endswith("DP") for node in file.nodes), "fingers")
        wrist = y_up(ORIGINS[BODY.index("LeftHand")])
        lowest = min(place[1] for place in file.positions if place[0] > wrist[0] + 0.06)
        expect(lowest < wrist[1] - 0.04, "fingers are straight", lowest)

    def test_khronos_validates_it(self):
        script = ("const v = require('gltf-validator'); v.validateBytes(new Uint8Array(require('fs').readFileSync("
                  "process.argv[1]))).then(r => console.log(JSON.stringify(r.issues)));")
        if shutil.which("node") is None or subprocess.run(["node", "-e", "require('gltf-validator')"], check=False,
                                                          capture_output=True).returncode != 0:
            return "node has no gltf-validator"
        for count in (len(BODY), len(NAMES)):
            path = self.tests.export(take(POSES, count), "glb")
            done = subprocess.run(["node", "-e", script, str(path)], capture_output=True, text=True, check=True)
            issues = json.loads(done.stdout)
            expect(issues["numErrors"] == 0 and issues["numWarnings"] == 0, issues["messages"][:5])
        return None

    def blender(self, path: Path, frames: int) -> list:
        result = self.folder / "result.json"
        program = Path(shutil.which("blender"))
        # Blender takes the library of the Python that it finds first: its system's own.
        environment = {**os.environ, "PATH": f"{program.parent}{os.pathsep}{os.environ['PATH']}"}
        done = subprocess.run([str(program), "-b", "--factory-startup", "--python-exit-code", "1", "--python",
                               str(Path(__file__).with_name("blender_reader.py")), "--", str(path), str(RATE),
                               str(frames), str(result)], capture_output=True, text=True, check=False, env=environment)
        expect(done.returncode == 0, done.stdout[-2000:], done.stderr[-2000:])
        return json.loads(result.read_text(encoding="utf-8"))

    @staticmethod
    def check_joints(shown: list, poses: list, tolerance: float):
        for frame, turns in zip(shown, poses):
            for name, (place, _) in zip(NAMES, posed(turns, len(NAMES))):
                off = math.dist(frame["joints"][name], (place[1], -place[0], place[2]))
                expect(off < tolerance, name, off)

    def test_blender_reads_both(self):
        if shutil.which("blender") is None:
            return "there is no blender"
        poses = [*POSES, FIST]
        frames = take(poses, len(NAMES))
        self.check_joints(self.blender(self.tests.export(frames, "bvh"), len(poses)), poses, 2e-3)
        path = self.tests.export(frames, "glb")
        file = GltfFile(path.read_bytes())
        shown = self.blender(path, len(poses))
        self.check_joints(shown, poses, 1e-5)
        vertices = [[(x, z, -y) for x, y, z in frame["vertices"]] for frame in shown]
        for key, drawn in enumerate(vertices):
            off = max(math.dist(a, b) for a, b in zip(drawn, file.skinned(key)))
            expect(len(drawn) == len(file.positions) and off < 1e-4, "skin", key, off)
        expect(least_of_rings(file, vertices) > 0.95, "rings")
        return None


def main() -> int:
    sys.path.insert(0, sys.argv[2])
    import capture_writer  # pylint: disable=import-outside-toplevel
    failures = 0
    for name in [name for name in dir(FigureTests) if name.startswith("test_")]:
        with tempfile.TemporaryDirectory() as folder:
            try:
                skipped = getattr(FigureTests(sys.argv[1], capture_writer, Path(folder)), name)()
                print("skipped" if skipped else "ok     ", name, skipped or "")
            except Failure as failure:
                failures += 1
                print("FAILED ", name, failure)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
