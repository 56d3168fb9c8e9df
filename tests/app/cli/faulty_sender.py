#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A sender of MXTP datagrams with faults, and the truth about what it sent; shares nothing with the program.

Everything follows from a seed. The truth is worked out after the fact, from the list of all that really left and from
what only a sender knows: which run of the counter a datagram is of, and with which spacing that run was sent.

usage: faulty_sender.py SEED SECONDS FILE.pcap [HOST:PORT]   writes the capture, sends it too, prints the truth as JSON
"""

import json
import random
import socket
import struct
import sys
import time
from collections import defaultdict
from dataclasses import dataclass, replace

ITEM_SIZES = {"01": 28, "02": 32, "03": 16, "05": 32, "20": 20, "21": 40, "22": 44, "23": 68}
ITEM_COUNTS = {"01": 23, "02": 23, "03": 64, "05": 23, "20": 28, "21": 23, "22": 23, "23": 17}
SAMPLED = ["01", "02", "03", "05", "20", "21", "22", "23", "24", "25"]
TOGETHER = 0.250
LATE, DOUBT_FROM, DOUBT_TO = 0.050, 0.030, 0.085
FIRST_STAMP = 1_700_000_000 * 10**9


@dataclass
class Datagram:
    time: float
    raw: bytes
    kind: str
    character: int
    sample: int
    part: int = 0
    last: bool = True
    run: int = 0  # a stretch of samples with one spacing
    state: str = "good"  # or malformed, foreign, stray (counter damaged beyond belief)
    message: float = 0.0  # when all its parts should have left


@dataclass
class Run:
    step: int
    restart: bool  # else only the spacing changed


def header(kind, items, sample, part, last, clock, character, size):
    counter = part | (0x80 if last else 0)
    return b"MXTP" + kind.encode() + struct.pack(">IBBIBBBBHH", sample, counter, items, clock, character, 23, 0, 0, 0,
                                                 size)


def wire_string(text):
    return struct.pack(">i", len(text)) + text.encode()


class Performance:
    """Well-formed datagrams of one frame, in one or several parts."""

    def __init__(self, pick, splits):
        self.pick, self.splits = pick, splits
        self.noise = {kind: [self.item(kind, n) for n in range(ITEM_COUNTS[kind])] for kind in ITEM_SIZES}

    def item(self, kind, number):
        ids = 2 if kind == "20" else 1
        words = [struct.pack(">I", number + 1)] * ids
        return b"".join(words) + b"".join(struct.pack(">f", self.pick.uniform(-1, 1))
                                          for _ in range(ITEM_SIZES[kind] // 4 - ids))

    def sampled(self, kind, sample, clock, character):
        if kind == "24":
            bodies = [(1, struct.pack(">9f", *(self.pick.uniform(-1, 1) for _ in range(9))))]
        elif kind == "25":
            text = f"{clock // 3600000 % 24:02}:{clock // 60000 % 60:02}:{clock // 1000 % 60:02}.{clock % 1000:03}"
            bodies = [(1, wire_string(text))]
        else:
            items = self.noise[kind]
            parts = self.pick.randint(1, 5) if self.splits else 1
            cuts = sorted(self.pick.sample(range(1, len(items)), parts - 1))
            bodies = [(to - start, b"".join(items[start:to])) for start, to in zip([0] + cuts, cuts + [len(items)])]
        for part, (count, body) in enumerate(bodies):
            last = part + 1 == len(bodies)
            raw = header(kind, count, sample, part, last, clock, character, len(body)) + body
            yield part, last, raw

    @staticmethod
    def information(kind, character):
        if kind == "12":
            text = wire_string(f"name:Actor {character}\ncolor:2f72c4\n")
            yield 0, True, header("12", 1, 0, 0, True, 0, character, len(text)) + text
            return
        for part in range(4):
            names = [("Pelvis", 1.0), ("L5", 1.1)] if part == 0 else []
            body = struct.pack(">I", len(names)) + b"".join(wire_string(n) + struct.pack(">3f", 0, 0, z)
                                                             for n, z in names)
            points = range(0) if part == 0 else range(5)
            body += struct.pack(">I", len(points)) + b"".join(
                struct.pack(">HH", part, p) + wire_string("p") + struct.pack(">I3f", 0, 0, 0, 0) for p in points)
            yield part, part == 3, header("13", 0, 0, part, part == 3, 0, character, len(body)) + body


@dataclass
class Plan:
    """What goes wrong, and when; drawn from the seed."""
    rate: float
    seconds: float
    first: int
    drop: float
    burst: float
    duplicate: float
    reorder: float
    damage: float
    splits: bool
    restart: tuple = None  # time, counter
    change: tuple = None  # time, spacing before, spacing after
    pause: tuple = None  # start, length
    outage: tuple = None  # start, length: of what is sent then nothing arrives


def draw_plan(pick, seconds):
    def share():
        return pick.choice([0.0, 0.002, 0.01, 0.03, 0.06])

    plan = Plan(rate=pick.choice([60.0, 120.0, 240.0, 240.0]), seconds=seconds,
                first=pick.choice([0, 1, 5000, 0xFFFFFFFF - pick.randint(20, 400)]), drop=share(),
                burst=pick.choice([0.0, 0.0, 0.0005]), duplicate=share(), reorder=share(), damage=share() / 2,
                splits=pick.random() < 0.5)
    if pick.random() < 0.4:
        at = pick.uniform(0.5, 0.7) * seconds
        plan.restart = (at, (plan.first + int(at * plan.rate) + pick.choice([-110 - int(at * plan.rate), 50_000,
                                                                          -400_000])) & 0xFFFFFFFF)
    if pick.random() < 0.4:
        before, after = pick.choice([(1, 2), (2, 1), (1, 4), (2, 3), (4, 1)])
        plan.change = (pick.uniform(0.3, 0.45) * seconds, before, after)
    if plan.change and not lasts(plan):
        plan.change = None
    if pick.random() < 0.3:
        plan.pause = (pick.uniform(0.75, 0.8) * seconds, pick.uniform(0.02, 0.3))
    return plan


def lasts(plan):
    """A spacing counts as one only where it is the usual one of 64 samples."""
    at, before, after = plan.change
    end = plan.restart[0] if plan.restart else plan.seconds
    return at * plan.rate / before > 80 and (end - at) * plan.rate / after > 80


class FaultySender:
    """With a plan of its own, or one that the seed draws; `performance` makes the datagrams."""

    def __init__(self, seed, seconds, characters=4, plan=None, types=tuple(SAMPLED), performance=None):
        self.pick = random.Random(seed)
        self.plan = plan or draw_plan(self.pick, seconds)
        self.characters, self.types = characters, types
        self.performance = performance or Performance(self.pick, self.plan.splits)
        self.runs = [Run(self.plan.change[1] if self.plan.change else 1, False)]
        self.good = self.perform()
        self.sent = self.clear_up(self.go_wrong(self.good))

    def is_quiet(self, moment):
        """Around a change what belongs to which run would be anybody's guess, were something missing."""
        moments = [event[0] for event in (self.plan.restart, self.plan.change) if event]
        return any(abs(moment - at) < 16 * self.runs[-1].step * 2 / self.plan.rate for at in moments)

    def perform(self):
        plan, pick, datagrams = self.plan, self.pick, []
        performance = self.performance
        shift, run, next_index, due = 0, 0, 0, 0.0
        changed = restarted = False
        for index in range(int(plan.seconds * plan.rate)):
            moment = index / plan.rate
            if plan.change and not changed and moment >= plan.change[0]:
                changed, run = True, run + 1
                self.runs.append(Run(plan.change[2], False))
                next_index = max(index, next_index)
            if index % int(plan.rate) == 0:
                for character in range(self.characters):
                    for kind in ["12"] + (["13"] if index % (5 * int(plan.rate)) == 0 else []):
                        for part, last, raw in performance.information(kind, character):
                            datagrams.append(Datagram(moment, raw, kind, character, 0, part, last, 0, "good", moment))
            if index < next_index:
                continue
            next_index = index + self.runs[run].step
            if plan.restart and not restarted and moment >= plan.restart[0]:
                restarted, run = True, run + 1
                self.runs.append(Run(self.runs[-1].step, True))
                shift = plan.restart[1] - (plan.first + index)
            if plan.pause and plan.pause[0] <= moment < sum(plan.pause):
                continue
            sample = (plan.first + index + shift) & 0xFFFFFFFF
            for character in range(self.characters):
                for kind in self.types:
                    clock = 36_000_000 + round(moment * 1000)
                    for part, last, raw in performance.sampled(kind, sample, clock, character):
                        datagrams.append(Datagram(moment, raw, kind, character, sample, part, last, run, "good", moment))
        return datagrams

    def damaged(self, datagram):
        raw, kind = bytearray(datagram.raw), self.pick.randrange(5)
        if kind == 0:
            cut = self.pick.randrange(len(raw))
            return replace(datagram, raw=bytes(raw[:cut]), state="foreign" if cut < 4 else "malformed")
        if kind == 1:
            raw[self.pick.randrange(4)] ^= 0x20
            return replace(datagram, raw=bytes(raw), state="foreign")
        if kind == 2:
            raw[self.pick.randrange(4, 6)] = self.pick.choice(b"aX\0\xff")
            return replace(datagram, raw=bytes(raw), state="malformed")
        if kind == 3 and datagram.kind in SAMPLED and datagram.message > 0.3:
            raw[6:10] = struct.pack(">I", (datagram.sample + self.pick.randrange(1 << 24, 0xFE << 24)) & 0xFFFFFFFF)
            return replace(datagram, raw=bytes(raw), state="stray")
        if datagram.kind in ITEM_SIZES:
            raw[self.pick.randrange(33, len(raw))] ^= self.pick.randrange(1, 128)
        return replace(datagram, raw=bytes(raw))

    def hold(self, is_sampled):
        if not is_sampled:
            return self.pick.uniform(0.0, 0.06)
        kind = self.pick.random()
        if kind < 0.5:
            return self.pick.uniform(1, 6) / self.plan.rate
        if kind < 0.9:
            return self.pick.uniform(0.12, 0.4)
        return self.pick.uniform(105, 180) / self.plan.rate

    def go_wrong(self, datagrams):
        plan, pick, sent, left_of_burst = self.plan, self.pick, [], 0
        for datagram in datagrams:
            if plan.outage and plan.outage[0] <= datagram.time < sum(plan.outage):
                continue
            if self.is_quiet(datagram.time):
                left_of_burst = 0
                sent.append(datagram)
                continue
            if left_of_burst == 0 and pick.random() < plan.burst:
                left_of_burst = pick.randint(2, 400)
            if left_of_burst > 0 or pick.random() < plan.drop:
                left_of_burst = max(0, left_of_burst - 1)
                continue
            if pick.random() < plan.damage:
                datagram = self.damaged(datagram)
            is_sampled = datagram.kind in SAMPLED
            if pick.random() < plan.duplicate:
                sent.append(replace(datagram, time=datagram.time + pick.choice([0.0, self.hold(is_sampled)])))
            if pick.random() < plan.reorder:
                datagram = replace(datagram, time=datagram.time + self.hold(is_sampled))
            sent.append(datagram)
        if plan.restart and plan.restart[0] > 0:
            # What is still on its way when the counter restarts is told apart only where it is far from it.
            jump = abs(plan.restart[1] - plan.first)
            if jump < 20_000:
                restart = self.runs.index(next(run for run in self.runs if run.restart))
                new = min((d.time for d in sent if d.run == restart), default=plan.seconds)
                sent = [d for d in sent if d.kind not in SAMPLED or d.run >= restart or d.time < new]
        # Once a stream has ended, what comes from far behind and a counter that restarts there look the same.
        end = datagrams[-1].time
        return [d for d in sent if d.time <= end or (d.run + 1 == len(self.runs) and
                                                     (d.time - d.message) * plan.rate < 90)]

    def clear_up(self, sent):
        """Moves what would be late or not by a hair, until nothing is."""
        while True:
            sent.sort(key=lambda datagram: datagram.time)
            doubtful = [d for d, behind in lateness(sent, self.runs) if DOUBT_FROM < behind < DOUBT_TO]
            if not doubtful:
                return sent
            for datagram in doubtful:
                datagram.time += 0.08

    def truth(self):
        return truth_of(self.sent, self.runs)


def sequence_of(runs):
    """The runs between two restarts share their counter."""
    number, numbers = 0, []
    for run in runs:
        number += run.restart
        numbers.append(number)
    return numbers


def distance(to, origin):
    return (to - origin + 0x80000000) % 0x100000000 - 0x80000000


def lateness(sent, runs):
    """Every first arrival behind a later sample of its stream, with how long after that it came."""
    sequences = sequence_of(runs)
    seen, advances = set(), defaultdict(list)
    for datagram in sent:
        if datagram.state != "good" or datagram.kind not in SAMPLED:
            continue
        key = (datagram.character, datagram.kind, sequences[datagram.run])
        if (key, datagram.sample, datagram.part) in seen:
            continue
        seen.add((key, datagram.sample, datagram.part))
        line = advances[key]
        if not line or distance(datagram.sample, line[-1][0]) > 0:
            line.append((datagram.sample, datagram.time))
        elif datagram.sample != line[-1][0]:
            after = next(time for sample, time in line if distance(sample, datagram.sample) > 0)
            yield datagram, datagram.time - after


def stream_truth(kind, datagrams, runs):
    figures = {"type": kind, "datagrams": len(datagrams)}
    good = [datagram for datagram in datagrams if datagram.state == "good"]
    if kind not in SAMPLED:
        # A message is what comes within a quarter of a second without an index that repeats; the same part again is a
        # duplicate in that time.
        messages, began, duplicates, came = [], 0.0, 0, {}
        for datagram in good:
            if kind != "12" and datagram.time - came.get(datagram.raw, -1.0) <= TOGETHER:
                duplicates += 1
                continue
            came[datagram.raw] = datagram.time
            if not messages or datagram.part in messages[-1] or datagram.time - began > TOGETHER:
                messages.append(set())
                began = datagram.time
            messages[-1].add(datagram.part)
        whole = 1 if kind == "12" else 4
        return figures | {"incomplete": sum(len(parts) != whole for parts in messages), "duplicates": duplicates}
    arrivals, ends = defaultdict(set), {}
    duplicates, newest = 0, 0
    sequences = sequence_of(runs)
    for datagram in good:
        key = (datagram.run, datagram.sample)
        newest = max(newest, sequences[datagram.run])
        # A restart forgets the counters of before.
        duplicates += datagram.part in arrivals[key] and sequences[datagram.run] == newest
        arrivals[key].add(datagram.part)
        if datagram.last:
            ends[key] = datagram.part
    samples = sum(len(parts) == ends.get(key, -2) + 1 for key, parts in arrivals.items())
    behind = [seconds for _, seconds in lateness(good, runs)]
    lost, places = 0, {}
    for number, run in enumerate(runs):
        counters = [sample for owner, sample in arrivals if owner == number]
        if counters:
            offsets = [distance(sample, counters[0]) for sample in counters]
            lost += (max(offsets) - min(offsets)) // run.step + 1 - len(counters)
            places[number] = [(counters[0] + end) & 0xFFFFFFFF for end in (min(offsets), max(offsets))]
    figures |= {"samples": samples, "lost": lost, "duplicates": duplicates, "reordered": len(behind),
                "late": sum(seconds > LATE for seconds in behind), "incomplete": len(arrivals) - samples,
                "restarts": len({sequences[number] for number in places}) - 1, "step": runs[max(places)].step,
                "firstSample": places[min(places)][0], "lastSample": places[max(places)][1]}
    return figures


def truth_of(sent, runs):
    streams = defaultdict(list)
    for datagram in sent:
        if datagram.state in ("good", "stray"):
            streams[datagram.character, datagram.kind].append(datagram)
    characters = defaultdict(list)
    for (character, kind), datagrams in sorted(streams.items()):
        characters[character].append(stream_truth(kind, datagrams, runs))
    return {"foreignDatagrams": sum(d.state == "foreign" for d in sent),
            "malformed": sum(d.state == "malformed" for d in sent),
            "datagrams": sum(d.state in ("good", "stray") for d in sent),
            "characters": [{"id": number, "streams": all_streams} for number, all_streams in characters.items()]}


def write_capture(path, sent, source=("192.0.2.1", 40001), target=("192.0.2.9", 9763)):
    write_packets(path, [(datagram.time, datagram.raw, source) for datagram in sent], target)


def write_packets(path, packets, target=("192.0.2.9", 9763)):
    """A pcap with nanoseconds and bare IPv4 packets, each of a time, bytes and a source."""
    with open(path, "wb") as file:
        file.write(struct.pack("<IHHiIII", 0xA1B23C4D, 2, 4, 0, 0, 65535, 101))
        for time_s, raw, source in packets:
            udp = struct.pack(">HHHH", source[1], target[1], 8 + len(raw), 0) + raw
            packet = struct.pack(">BBHHHBBH4s4s", 0x45, 0, 20 + len(udp), 0, 0, 64, 17, 0, socket.inet_aton(source[0]),
                                 socket.inet_aton(target[0])) + udp
            stamp = FIRST_STAMP + round(time_s * 1e9)
            file.write(struct.pack("<IIII", stamp // 10**9, stamp % 10**9, len(packet), len(packet)) + packet)


def send(sent, host, port):
    """Returns the address that the datagrams come from."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as channel:
        channel.connect((host, port))
        start = time.monotonic()
        for datagram in sent:
            wait = start + datagram.time - time.monotonic()
            if wait > 0:
                time.sleep(wait)
            channel.send(datagram.raw)
        return channel.getsockname()


if __name__ == "__main__":
    sender = FaultySender(int(sys.argv[1]), float(sys.argv[2]))
    write_capture(sys.argv[3], sender.sent)
    if len(sys.argv) > 4:
        place, _, number = sys.argv[4].rpartition(":")
        send(sender.sent, place, int(number))
    print(json.dumps(sender.truth(), indent=1))
