#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""An MVNX file with all that MVN writes, decoded, judged and sent as the stream that it was.

Usage: mvnx_test.py POSEWIRE-CLI
"""
import json
import pathlib
import random
import socket
import subprocess
import sys
import tempfile

PROGRAM = sys.argv[1]
RATE, FRAMES = 60, 90
SEGMENTS = ["Pelvis", "L5", "L3", "T12", "T8", "Neck", "Head", "RightShoulder", "RightUpperArm", "RightForeArm",
            "RightHand", "LeftShoulder", "LeftUpperArm", "LeftForeArm", "LeftHand", "RightUpperLeg", "RightLowerLeg",
            "RightFoot", "RightToe", "LeftUpperLeg", "LeftLowerLeg", "LeftFoot", "LeftToe"]
SENSORS = ["Pelvis", "T8", "Head"]
# Element, numbers of each item, items, type and field that hold it; the field is in the list of the type's items.
FIELDS = [("orientation", 4, 23, "02", "orientation"), ("position", 3, 23, "02", "position"),
          ("velocity", 3, 23, "21", "velocity"), ("acceleration", 3, 23, "21", "acceleration"),
          ("angularVelocity", 3, 23, "22", "angularVelocity"),
          ("angularAcceleration", 3, 23, "22", "angularAcceleration"),
          ("sensorFreeAcceleration", 3, len(SENSORS), "23", "freeAcceleration"),
          ("sensorMagneticField", 3, len(SENSORS), "23", "magneticField"),
          ("sensorOrientation", 4, len(SENSORS), "23", "orientation"),
          ("jointAngle", 3, 1, "20", "rotation")]


def check(condition, what):
    if not condition:
        sys.exit(f"mvnx_test: {what}")


def numbers(values):
    return " ".join(f"{value:.6f}" for value in values)


def frame(index, random_numbers):
    """The text of a frame, and its values by element."""
    values = {}
    for element, size, items, _, _ in FIELDS:
        values[element] = [random_numbers.uniform(-1, 1) for _ in range(size * items)]
    for first in range(0, 4 * 23, 4):  # a person stands
        values["orientation"][first:first + 4] = [1, 0, 0, 0]
    for place in range(23):
        values["position"][3 * place:3 * place + 3] = [0.001 * index, 0.1 * (place % 3), 0.02 + 0.07 * place]
    values["centerOfMass"] = [0.001 * index, 0, 1]
    text = "".join(f"<{element}>{numbers(all_of_it)}</{element}>\n" for element, all_of_it in values.items())
    return (f'<frame time="{round(1000 * index / RATE)}" index="{index}" tc="10:20:{index // RATE:02}:{index % RATE:02}" '
            f'ms="{1764000000000 + round(1000 * index / RATE)}" type="normal">\n{text}</frame>\n'), values


def take():
    """The text of a file, and the values of its frames."""
    dice = random.Random(1)
    frames = [frame(index, dice) for index in range(FRAMES)]
    points = "<points><point label=\"pHipOrigin\"><pos_b>0 0 0</pos_b></point></points>"
    segments = "".join(f'<segment label="{name}" id="{i + 1}">{points if i == 0 else "<points/>"}</segment>'
                       for i, name in enumerate(SEGMENTS))
    sensors = "".join(f'<sensor label="{name}"/>' for name in SENSORS)
    rest = numbers(value for i in range(23) for value in (0, 0.1 * (i % 3), 0.07 * i))
    still = numbers([1, 0, 0, 0] * 23)
    head = (f'<?xml version="1.0" encoding="UTF-8"?>\n<mvnx version="4"><mvn version="2019.0"/><subject label="Ada &amp; Co" '
            f'torsoColor="#2f72c4" frameRate="{RATE}" segmentCount="23" recDateMSecsSinceEpoch="1764000000000" '
            f'configuration="FullBody"><segments>{segments}</segments><sensors>{sensors}</sensors><joints>'
            f'<joint label="jL5S1"><connector1>Pelvis/jL5S1</connector1><connector2>L5/jL5S1</connector2></joint></joints>'
            f'<frames segmentCount="23" sensorCount="{len(SENSORS)}" jointCount="1">'
            f'<frame time="0" index="0" tc="" ms="0" type="identity"><orientation>{still}</orientation>'
            f'<position>{rest}</position></frame>\n')
    return head + "".join(text for text, _ in frames) + "</frames></subject></mvnx>\n", [values for _, values in frames]


def decoded(path, *options):
    done = subprocess.run([PROGRAM, "decode", path, "--json", *options], capture_output=True, text=True, check=False)
    return done, [json.loads(line) for line in done.stdout.splitlines()]


def values_of(datagram, field):
    """All numbers of a field, item by item; where it lies in its body depends on the type."""
    items = next(value for value in datagram["body"].values() if isinstance(value, list))
    return [number for item in items for number in item[field]]


def test_has_all_that_the_file_has(path, frames):
    done, datagrams = decoded(path)
    check(done.returncode == 0, f"decode ended with {done.returncode}: {done.stderr}")
    by_type = {}
    for datagram in datagrams:
        by_type.setdefault(datagram["type"], {})[datagram["sample"]] = datagram
    for kind in ("02", "20", "21", "22", "23", "24", "25"):
        check(len(by_type.get(kind, {})) == FRAMES, f"{len(by_type.get(kind, {}))} samples of type {kind}")
    check("12" in by_type and "13" in by_type, f"types {sorted(by_type)}")
    for index, values in enumerate(frames):
        for element, _, _, kind, field in FIELDS:
            is_from = values_of(by_type[kind][index], field)
            worst = max(abs(a - b) for a, b in zip(is_from, values[element], strict=True))
            check(worst < 2e-6, f"{element} of frame {index} is off by {worst}")
    text = json.dumps(by_type["25"][61]["body"])
    check("10:20:01.017" in text, f"time code {text}")


def test_is_good_and_named(path):
    done = subprocess.run([PROGRAM, "monitor", path, "--json"], capture_output=True, text=True, check=False)
    check("Ada & Co" in done.stdout, f"monitor: {done.stdout[:300]} {done.stderr}")


def test_is_sent_as_it_was(path):
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as receiver:
        receiver.bind(("127.0.0.1", 0))
        receiver.settimeout(20)
        sender = subprocess.Popen([PROGRAM, "send", "--file", path, "--to", f"127.0.0.1:{receiver.getsockname()[1]}"],
                                  stdout=subprocess.DEVNULL)
        samples = set()
        while len(samples) < FRAMES:
            bytes_of = receiver.recv(65536)
            if bytes_of[4:6] == b"02":
                samples.add(int.from_bytes(bytes_of[6:10], "big"))
        check(samples == set(range(FRAMES)), "samples")
        check(sender.wait(20) == 0, "send")


def test_is_read_up_to_its_damage(folder, text):
    cut = folder / "cut.mvnx"
    cut.write_text(text[:2 * len(text) // 3])
    done, datagrams = decoded(cut)
    check(done.returncode == 1 and "cut.mvnx" in done.stderr and datagrams, f"cut: {done.returncode} {done.stderr}")
    few = folder / "few.mvnx"
    few.write_text(text.replace("<jointAngle>", "<jointAngle>1 2 3 ", 1))
    done, _ = decoded(few)
    check(done.returncode == 1 and "line" in done.stderr, f"too many numbers: {done.returncode} {done.stderr}")
    bomb = folder / "bomb.mvnx"
    bomb.write_text('<!DOCTYPE mvnx [<!ENTITY a "aaaaaaaa"><!ENTITY b "&a;&a;&a;&a;">]>' + text)
    done, _ = decoded(bomb)
    check(done.returncode == 1, f"entities: {done.returncode}")
    long = folder / "long.mvnx"
    long.write_text('<mvnx version="4"><subject label="' + "a" * 50_000_000)
    done, _ = decoded(long)
    check(done.returncode == 1 and "long" in done.stderr, f"a long tag: {done.returncode}")


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        text, frames = take()
        path = folder / "take.mvnx"
        path.write_text(text)
        test_has_all_that_the_file_has(path, frames)
        test_is_good_and_named(path)
        test_is_sent_as_it_was(path)
        test_is_read_up_to_its_damage(folder, text)


if __name__ == "__main__":
    main()
