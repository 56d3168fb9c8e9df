#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A second encoder of MXTP datagrams, written from the published specification alone.

It shares no table and no line with the program, so that both can only agree by both being right. Every datagram
comes with the object that `posewire-cli decode --json` owes for it; the values are random but follow from a seed.
"""

import random
import struct
from dataclasses import dataclass

BODY_SEGMENTS = [
    "Pelvis", "L5", "L3", "T12", "T8", "Neck", "Head", "RightShoulder", "RightUpperArm", "RightForeArm", "RightHand",
    "LeftShoulder", "LeftUpperArm", "LeftForeArm", "LeftHand", "RightUpperLeg", "RightLowerLeg", "RightFoot",
    "RightToe", "LeftUpperLeg", "LeftLowerLeg", "LeftFoot", "LeftToe"]
TRACKER_SEGMENTS = [1, 5, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 20, 21, 22]
JOINTS = [(0x102, 0x201), (0x202, 0x301), (0x302, 0x401), (0x402, 0x501), (0x502, 0x601), (0x602, 0x701),
          (0x503, 0x801), (0x802, 0x901), (0x902, 0xA01), (0xA02, 0xB01), (0x504, 0xC01), (0xC02, 0xD01),
          (0xD02, 0xE01), (0xE02, 0xF01), (0x103, 0x1001), (0x1002, 0x1101), (0x1102, 0x1201), (0x1202, 0x1301),
          (0x104, 0x1401), (0x1402, 0x1501), (0x1502, 0x1601), (0x1602, 0x1701), (0x500, 0x700), (0x500, 0xD00),
          (0x500, 0x900), (0x100, 0x500), (0x100, 0x100), (0x100, 0x500)]
NAMES = ["Pelvis", "Prop1 Sword", "", "Schulter rechts", "骨盆", "Ребро", "naïve café", "🦴 bone", "a" * 127, "x" * 300,
         "quote\" back\\slash", "tab\tand / slash", "\u0001control", "é", "\U0010ffff"]
HARD_FLOATS = [0x00000000, 0x80000000, 0x00000001, 0x807FFFFF, 0x00800000, 0x7F7FFFFF, 0xFF7FFFFF, 0x7F800000,
               0xFF800000, 0x7FC00000, 0x3F800000, 0x3DCCCCCD, 0x4B7FFFFF, 0x4B800001, 0x33D6BF95, 0x5F000000]


@dataclass
class Header:
    """The 24 bytes before the payload. `counts` and `announces_size` are what distinguishes the revisions."""
    kind: str
    items: int
    sample: int = 0
    datagram: int = 0
    last: bool = True
    time_code: int = 0
    character: int = 0
    counts: tuple = (0, 0, 0)
    payload_size: int = 0

    def to_bytes(self) -> bytes:
        counter = self.datagram | (0x80 if self.last else 0)
        return b"MXTP" + self.kind.encode("ascii") + struct.pack(
            ">IBBIBBBBHH", self.sample, counter, self.items, self.time_code, self.character, *self.counts, 0,
            self.payload_size)

    def to_json(self) -> dict:
        return {"type": self.kind, "sample": self.sample, "datagram": self.datagram, "last": self.last,
                "items": self.items, "timeCode": self.time_code, "character": self.character,
                "bodySegments": self.counts[0], "props": self.counts[1], "fingerSegments": self.counts[2],
                "payloadSize": self.payload_size}


@dataclass
class Case:
    """One datagram: its bytes and the object that describes them.

    `well_formed`: its values hold all of its bytes. `alone`: its end cannot be told from its bytes, so it only goes into
    captures, which know where a datagram ends. `plain`: nothing is odd about it, so it must come without notices.
    """
    label: str
    header: Header
    payload: bytes
    body: dict
    well_formed: bool = True
    alone: bool = False
    plain: bool = False

    def to_bytes(self) -> bytes:
        return self.header.to_bytes() + self.payload


class Values:
    """Random values of one seed. `mood` chooses between everyday numbers, awkward ones and any bit pattern."""

    def __init__(self, seed: int):
        self.random = random.Random(seed)
        self.mood = "everyday"

    def number(self) -> tuple[bytes, object]:
        """Returns a float as its wire bytes and as its JSON value."""
        if self.mood == "everyday":
            raw = struct.pack(">f", self.random.uniform(-20.0, 20.0))
        elif self.mood == "awkward":
            raw = struct.pack(">I", self.random.choice(HARD_FLOATS))
        else:
            raw = struct.pack(">I", self.random.getrandbits(32))
            if raw[0] & 0x7F == 0x7F and raw[1] & 0x80:
                raw = b"\x42\xf6\xe9\x79"  # in JSON all NaNs are the same
        return raw, json_number(raw)

    def numbers(self, count: int) -> tuple[bytes, list]:
        pairs = [self.number() for _ in range(count)]
        return b"".join(raw for raw, _ in pairs), [value for _, value in pairs]

    def quaternion(self) -> tuple[bytes, list]:
        """Normalised in the everyday mood, as the specification promises."""
        if self.mood != "everyday":
            return self.numbers(4)
        parts = [self.random.gauss(0.0, 1.0) for _ in range(4)]
        norm = sum(part * part for part in parts) ** 0.5
        raw = struct.pack(">4f", *(part / norm for part in parts))
        return raw, list(struct.unpack(">4f", raw))

    def name(self) -> str:
        return self.random.choice(NAMES)


def json_number(raw: bytes) -> object:
    value = struct.unpack(">f", raw)[0]
    if value != value:
        return "NaN"
    if value in (float("inf"), float("-inf")):
        return "Infinity" if value > 0 else "-Infinity"
    return value


def wire_string(text: str) -> bytes:
    raw = text.encode("utf-8")
    return struct.pack(">i", len(raw)) + raw


# One row a type with items of a fixed size: the list's name and the item's parts; "q" is a quaternion, "id" 32 bits.
ITEMS = {
    "01": ("segments", [("id", "id"), ("position", 3), ("rotation", 3)]),
    "02": ("segments", [("id", "id"), ("position", 3), ("orientation", "q")]),
    "03": ("points", [("id", "id"), ("position", 3)]),
    "04": ("points", [("id", "id"), ("position", 3)]),
    "05": ("segments", [("id", "id"), ("position", 3), ("orientation", "q")]),
    "10": ("segments", [("id", "id"), ("offset", 3), ("matrix", 9)]),
    "20": ("joints", [("parent", "id"), ("child", "id"), ("rotation", 3)]),
    "21": ("segments", [("id", "id"), ("position", 3), ("velocity", 3), ("acceleration", 3)]),
    "22": ("segments", [("id", "id"), ("orientation", "q"), ("angularVelocity", 3), ("angularAcceleration", 3)]),
    "23": ("trackers", [("id", "id"), ("orientation", "q"), ("freeAcceleration", 3), ("acceleration", 3),
                        ("angularVelocity", 3), ("magneticField", 3)]),
    "23 short": ("trackers", [("id", "id"), ("orientation", "q"), ("freeAcceleration", 3), ("magneticField", 3)]),
}


def item_list(layout: str, ids: list, values: Values) -> tuple[bytes, dict]:
    name, parts = ITEMS[layout]
    payload, items = b"", []
    for identity in ids:
        numbers = list(identity) if isinstance(identity, tuple) else [identity]
        item = {}
        for part, shape in parts:
            if shape == "id":
                item[part] = numbers.pop(0)
                payload += struct.pack(">I", item[part])
                continue
            raw, item[part] = values.quaternion() if shape == "q" else values.numbers(shape)
            payload += raw
        items.append(item)
    return payload, {name: items}


def null_pose(names: list, points: list, values: Values) -> tuple[bytes, dict]:
    payload, segments, described = struct.pack(">I", len(names)), [], []
    for name in names:
        raw, position = values.numbers(3)
        payload += wire_string(name) + raw
        segments.append({"name": name, "position": position})
    payload += struct.pack(">I", len(points))
    for segment, point, name, flags in points:
        raw, position = values.numbers(3)
        payload += struct.pack(">HH", segment, point) + wire_string(name) + struct.pack(">I", flags) + raw
        described.append({"segment": segment, "point": point, "name": name, "flags": flags, "position": position})
    return payload, {"segments": segments, "points": described}


def metadata(tags: list, prefixed: bool, ends_with_newline: bool = True) -> tuple[bytes, dict]:
    text = "".join(f"{tag}:{value}\n" for tag, value in tags)
    if not ends_with_newline:
        text = text[:-1]
    payload = wire_string(text) if prefixed else text.encode("utf-8")
    return payload, {"tags": [list(tag) for tag in tags]}


def props(names: list, first: int) -> tuple[bytes, dict]:
    payload, described = b"", []
    for number, name in enumerate(names):
        payload += struct.pack(">I", first + number) + name.encode("utf-8") + b"\0"
        described.append({"id": first + number, "name": name})
    return payload, {"props": described}


def centre(values: Values, complete: bool) -> tuple[bytes, dict]:
    payload, body = b"", {}
    for part in ["position", "velocity", "acceleration"] if complete else ["position"]:
        raw, body[part] = values.numbers(3)
        payload += raw
    return payload, body


def time_code(values: Values, prefix: int | None) -> tuple[bytes, dict]:
    pick = values.random.randrange
    text = f"{pick(24):02}:{pick(60):02}:{pick(60):02}.{pick(1000):03}"
    raw = text.encode("ascii")
    return (raw if prefix is None else struct.pack(">i", prefix) + raw), {"timeCode": text}
