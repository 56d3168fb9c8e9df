# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of the dissector let it read."""

import pathlib
import random

import capture_writer
from second_encoder_cases import all_cases

STAMP = 1_700_000_000_000_000_000
GOLDENS = pathlib.Path(__file__).resolve().parents[1] / "golden"


def goldens() -> dict:
    """Bytes by name."""
    found = {}
    for path in sorted(GOLDENS.glob("*.hex")):
        lines = [line.split("#")[0] for line in path.read_text(encoding="utf-8").splitlines()]
        found[path.stem] = bytes.fromhex("".join(lines))
    assert len(found) > 40
    return found


def damaged(chance: random.Random, data: bytes) -> bytes:
    broken = bytearray(data)
    for _ in range(chance.randint(1, 3)):
        # The header and the first fields decide about the rest.
        at = chance.randrange(4, min(len(data), 40) if chance.random() < 0.7 else len(data))
        broken[at] = chance.choice([0, 1, 0x7f, 0x80, 0xff, chance.randrange(256)])
    return bytes(broken) + bytes(chance.choice([0, 0, 0, 1, 4]))


def sound_and_broken() -> list:
    """Datagrams of every type, revision and variant: whole, cut and damaged."""
    chance = random.Random(2)
    whole = [*goldens().values(), *(case.to_bytes() for case in list(all_cases(3))[::3])]
    cut = [data[:chance.randrange(4, len(data))] for data in whole]
    return whole + cut + [damaged(chance, data) for data in whole]


def as_udp(datagrams) -> list:
    return [(STAMP, capture_writer.udp_packet(data)) for data in datagrams]


def as_tcp(parts: list, target=("192.0.2.2", 9763)) -> list:
    packets, sequence = [capture_writer.tcp_packet(b"", 999, target=target, flags=capture_writer.SYN)], 1000
    for part in parts:
        packets.append(capture_writer.tcp_packet(part, sequence, target=target))
        sequence += len(part)
    return [(STAMP + number * 1000, packet) for number, packet in enumerate(packets)]
