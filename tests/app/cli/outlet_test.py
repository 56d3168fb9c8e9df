#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads what `outlet` sends, by readers of others, and compares it with the lines of `follow`.

usage: outlet_test.py POSEWIRE_CLI [ROS_READER]
"""
import contextlib
import json
import math
import os
import pathlib
import signal
import socket
import subprocess
import sys
import threading
import time

POSES = 60
CLOSE = 1e-4
AHEAD = 500_000_000  # ns
PATIENCE = 60  # seconds
BUNDLE = 1472  # bytes, at most
DOMAIN = "87"  # of ROS
# DDS without multicast and beyond this computer.
LOOPBACK = ('<CycloneDDS><Domain><General><Interfaces><NetworkInterface name="lo"/></Interfaces><AllowMulticast>false'
            '</AllowMulticast></General><Discovery><ParticipantIndex>auto</ParticipantIndex><Peers><Peer address='
            '"127.0.0.1"/></Peers></Discovery></Domain></CycloneDDS>')


def free_port():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


@contextlib.contextmanager
def running(command, **options):
    with subprocess.Popen(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE, **options) as program:
        try:
            yield program
        finally:
            program.send_signal(signal.SIGINT)
            try:
                program.communicate(timeout=20)
            except subprocess.TimeoutExpired:
                program.kill()


def close(one, other):
    return len(one) == len(other) and all(abs(float(a) - float(b)) < CLOSE for a, b in zip(one, other))


def turned(q, v):
    """A vector turned by a quaternion w x y z."""
    w, x, y, z = q
    t = [2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])]
    return [v[0] + w * t[0] + y * t[2] - z * t[1], v[1] + w * t[1] + z * t[0] - x * t[2],
            v[2] + w * t[2] + x * t[1] - y * t[0]]


def product(a, b):
    return [a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3], a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
            a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1], a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]]


def osc_poses(bundles):
    """Of /posewire: (ID, sample), {segment: numbers}, which fills with the bundles of its time."""
    own = {}
    for bundle in bundles:
        assert bundle["bytes"] <= BUNDLE, bundle["bytes"]
        assert abs(bundle["time"] - time.time()) < 60, bundle["time"]
        for address, types, *values in bundle["messages"]:
            _, root, name, kind, *segment = address.split("/")
            assert root == "posewire", address
            if kind == "pose":
                assert types == "iiiss" and values[3] == "02", values
                own[name] = bundle["time"], {}
                yield (values[0], values[1]), own[name][1]
            elif name in own and own[name][0] == bundle["time"]:
                assert types == "fffffff", types
                own[name][1][segment[0]] = values


def vmc_poses(bundles):
    """One set of bones after the other: {bone: (position, orientation w x y z)}, Unity's, relative to the parent."""
    begun, bones = None, {}
    for bundle in bundles:
        for address, types, *values in bundle["messages"]:
            if address == "/VMC/Ext/OK":
                assert values == [1, 3, 0, 1], values
                begun, bones = bundle["time"], {}
            elif bundle["time"] == begun and address == "/VMC/Ext/Bone/Pos":
                assert types == "sfffffff", types
                name, *numbers = values
                bones[name] = (numbers[:3], [numbers[6], *numbers[3:6]])
            elif bundle["time"] == begun and address == "/VMC/Ext/Blend/Apply":
                yield bones


def world_of(bones, chain):
    """Where the last bone of a chain is, Z up as MVN has it: x ahead, y to the left."""
    place, turn = [0, 0, 0], [1, 0, 0, 0]
    for bone in chain:
        position, orientation = bones[bone]
        place = [a + b for a, b in zip(place, turned(turn, position))]
        turn = product(turn, orientation)
    return [place[2], -place[0], place[1], turn[0], -turn[3], turn[1], -turn[2]]


def told(segment):
    return segment["position"] + segment["orientation"]


class Lines:
    """Poses of `follow` by ID and sample, read as they come, so that it waits for no reader."""

    def __init__(self, program):
        self.poses, self.received, self.came = {}, 0, threading.Condition()
        self.thread = threading.Thread(target=self.read, args=[program.stdout], daemon=True)
        self.thread.start()

    def read(self, lines):
        for line in map(json.loads, lines):
            with self.came:
                self.poses[line["id"], line["sample"]] = {each["name"]: told(each) for each in line["segments"]}
                self.received = line["receivedNs"]
                self.came.notify()

    def wait_beyond(self, when):
        with self.came:
            assert self.came.wait_for(lambda: self.received > when, PATIENCE), "no line of follow"


class Stage:
    """Performers who send both to an outlet and to `follow`."""

    def __init__(self, cli, *outlet, reader=()):
        self.cli, self.outlet, self.reader = cli, outlet, reader

    def run(self, count, poses):
        """Some of poses(lines of the reader), made of what the outlet sent, and the poses of follow by ID and sample."""
        ports = [free_port(), free_port()]
        perl = ["perl", str(pathlib.Path(__file__).with_name("osc_reader.pl"))]
        with contextlib.ExitStack() as all_of_them:
            reading = all_of_them.enter_context(running(self.reader or perl))
            to = DOMAIN if self.reader else "127.0.0.1:" + reading.stdout.readline().strip()
            follow = all_of_them.enter_context(running([self.cli, "follow", "--udp", f"127.0.0.1:{ports[0]}"]))
            outlet = all_of_them.enter_context(
                running([self.cli, "outlet", *self.outlet, "--udp", f"127.0.0.1:{ports[1]}", "--to", to],
                        env=dict(os.environ, CYCLONEDDS_URI=LOOPBACK)))
            assert to in outlet.stderr.readline()
            all_of_them.enter_context(
                running([self.cli, "send", *(f"--to=127.0.0.1:{port}" for port in ports), "--rate", "30", "--characters",
                         "2", "--fingers", "--types", "02,12,13"]))
            lines = Lines(follow)
            came = poses(json.loads(line) for line in reading.stdout)
            lines.wait_beyond(0)
            since = time.time_ns()
            while next(came) and time.time_ns() - since < AHEAD: # what the outlet sent before follow had begun
                pass
            got = [next(came) for _ in range(count)]
            lines.wait_beyond(time.time_ns())
            reading.kill()
            follow.send_signal(signal.SIGINT)
            lines.thread.join()
            return got, lines.poses


def nearly_all(poses, are_whole):
    """Those that are whole: a pose is several datagrams, of which a busy computer may drop one."""
    whole = list(filter(are_whole, poses))
    assert len(whole) > 0.9 * len(poses), (len(whole), len(poses))
    return whole


def by_osc(cli):
    came, sent = Stage(cli, "osc").run(2 * POSES + 1, osc_poses)
    whole = nearly_all(came[:-1], lambda pose: len(pose[1]) == 63)
    got = [(key, segments) for key, segments in whole if key in sent]
    assert len(got) > POSES and {key[0] for key, _ in got} == {0, 1}, [key for key, _ in whole]
    for key, segments in got:
        for name, numbers in segments.items():
            assert close(numbers, sent[key][name]), (key, name, numbers, sent[key][name])


def by_vmc(cli):
    came, sent = Stage(cli, "vmc", "--character", "1").run(POSES, vmc_poses)
    got = nearly_all(came, lambda bones: len(bones) == 52)
    spine = ["Hips", "Spine", "Chest", "UpperChest"]
    chains = {"Pelvis": spine[:1], "Head": [*spine, "Neck", "Head"],
              "RightHand": [*spine, "RightShoulder", "RightUpperArm", "RightLowerArm", "RightHand"],
              "LeftToe": ["Hips", "LeftUpperLeg", "LeftLowerLeg", "LeftFoot", "LeftToes"],
              "LeftFourthDP": [*spine, "LeftShoulder", "LeftUpperArm", "LeftLowerArm", "LeftHand", "LeftRingProximal",
                               "LeftRingIntermediate", "LeftRingDistal"]}
    for bones in got:
        hips = world_of(bones, ["Hips"])
        twin = min((pose for key, pose in sent.items() if key[0] == 1),
                   key=lambda pose: sum(abs(a - b) for a, b in zip(hips, pose["Pelvis"])))
        for name, chain in chains.items():
            mine = world_of(bones, chain)
            assert same(mine, twin[name]), (name, mine, twin[name])


def ros_poses(lines):
    """{(name, time): ({segment: numbers in the world}, {joint: angles})}, of those of which both have come."""
    transforms, joints = {}, {}
    for line in lines:
        if "tf" in line:
            frames = {"world": ([0, 0, 0], [1, 0, 0, 0])}
            for each in line["tf"]:
                place, turn = frames[each["frame"]]
                x, y, z, qx, qy, qz, qw = each["transform"]
                frames[each["child"]] = ([a + b for a, b in zip(place, turned(turn, [x, y, z]))],
                                         product(turn, [qw, qx, qy, qz]))
            name = line["tf"][0]["child"].split("/")[0]
            key = name, *line["tf"][0]["stamp"]
            transforms[key] = {frame.split("/")[1]: place + turn for frame, (place, turn) in frames.items() if "/" in frame}
        else:
            assert line["others"] == 0 and len(line["joints"]) == 66, line
            name = next(iter(line["joints"])).split("/")[0]
            key = name, *line["stamp"]
            joints[key] = {joint.split("/")[1]: angle for joint, angle in line["joints"].items()}
        if key in transforms and key in joints:
            yield key, (transforms.pop(key), joints.pop(key))


def about(axis, angle):
    return [math.cos(angle / 2), *(math.sin(angle / 2) if place == axis else 0 for place in range(3))]


def same(mine, theirs):
    """Places and turns, of which each has two signs."""
    return close(mine[:3], theirs[:3]) and (close(mine[3:], theirs[3:]) or close(mine[3:], [-part for part in theirs[3:]]))


def by_ros(cli, reader):
    got, sent = Stage(cli, "ros2", reader=[reader, DOMAIN]).run(POSES, ros_poses)
    for key, (segments, joints) in got:
        twin = min(sent.values(), key=lambda pose: sum(abs(a - b) for a, b in zip(segments["Pelvis"], pose["Pelvis"])))
        assert len(segments) == 63, (key, len(segments))
        for name, numbers in segments.items():
            assert same(numbers, twin[name]), (key, name, numbers, twin[name])
        knee = [1, 0, 0, 0]
        for axis in range(3):
            knee = product(knee, about(axis, joints["jRightKnee_rot" + "xyz"[axis]]))
        shank = product(twin["RightUpperLeg"][3:], knee)
        assert same([0, 0, 0, *shank], [0, 0, 0, *twin["RightLowerLeg"][3:]]), (key, shank, twin["RightLowerLeg"])
    assert len({key[0] for key, _ in got}) > 1, [key for key, _ in got]


def by_datagrams(cli):
    port = free_port()
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as receiver:
        receiver.bind(("127.0.0.1", 0))
        receiver.settimeout(20)
        to = f"127.0.0.1:{receiver.getsockname()[1]}"
        with running([cli, "outlet", "datagrams", "--udp", f"127.0.0.1:{port}", "--to", to]) as outlet:
            assert to in outlet.stderr.readline()
            with running([cli, "send", "--to", f"127.0.0.1:{port}", "--rate", "60", "--types", "02"]):
                for _ in range(POSES):
                    assert receiver.recv(65536).startswith(b"MXTP02")


def refusals(cli):
    port = free_port()
    place = f"127.0.0.1:{port}"
    for arguments, named in ((["nothing"], "nothing"), (["datagrams"], "--to"), (["osc", "--to", "nowhere:x"], "nowhere:x"),
                             (["osc", "--to", "-"], "--to"), (["ros2", "--to", "233"], "233"), (["datagrams", "--to", place], place)):
        refused = subprocess.run([cli, "outlet", *arguments, "--udp", place, "--duration", "1"], capture_output=True,
                                 text=True, timeout=20, check=False)
        assert refused.returncode == 2 and named in refused.stderr, (arguments, refused)
    alone = subprocess.run([cli, "outlet", "osc", "--udp", place, "--to", f"127.0.0.1:{free_port()}", "--duration", "0.5"],
                           capture_output=True, text=True, timeout=20, check=False)
    assert alone.returncode == 0, alone


def main(cli, ros_reader=""):
    refusals(cli)
    by_datagrams(cli)
    if ros_reader:
        by_ros(cli, ros_reader)
    else:
        print("Fast DDS (libfastrtps-dev) is not here: ROS 2 was not read")
    if subprocess.run(["perl", "-MProtocol::OSC", "-e1"], stderr=subprocess.DEVNULL, check=False).returncode != 0:
        print("Protocol::OSC (libprotocol-osc-perl) is not here: OSC and VMC were not read")
        return 0
    by_osc(cli)
    by_vmc(cli)
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
