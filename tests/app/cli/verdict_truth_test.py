#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares what `posewire-cli monitor` says of a take, at each moment and at its end, with what the sender knows.

What is sent are bodies of the synthetic performer; what goes wrong with them is decided here, in a stretch of the take
with calm before and after it. The time is that of the capture: nothing waits.

usage: verdict_truth_test.py POSEWIRE_CLI FIRST_SEED LAST_SEED
Prints what disagrees and exits 1 if anything does.
"""

import json
import pathlib
import random
import re
import socket
import struct
import subprocess
import sys
import tempfile
from collections import defaultdict

from faulty_sender import (FIRST_STAMP, ITEM_SIZES, SAMPLED, FaultySender, Performance, Plan, distance, truth_of,
                           write_packets)

SECONDS = 30.0
BEGIN, END = 3.0, 11.0  # of what goes wrong
SOON = 0.25  # until then it must be said
MENTIONED = 9.0  # at least so long it stays said
FORGOTTEN = 16.5  # then all is good again
SILENT = 0.25
KINDS = ("drop", "duplicate", "reorder", "damage", "burst", "splits", "restart", "change", "pause", "outage")


class Bodies(Performance):
    """One pose of each performer, as the program itself sends it, in datagrams of our own."""

    def __init__(self, pick, splits, bodies):
        self.pick, self.splits, self.bodies = pick, splits, bodies

    def sampled(self, kind, sample, clock, character):
        head, body = self.bodies[character, kind][0][2]
        if kind == "25":
            text = f"{clock // 3600000 % 24:02}:{clock // 60000 % 60:02}:{clock // 1000 % 60:02}.{clock % 1000:03}"
            body = struct.pack(">i", len(text)) + text.encode()
        if kind in ("01", "02", "03", "05", "21", "22"):
            body = body[:7] + bytes([sample % 251]) + body[8:]  # nobody stands still to the last bit
        size = ITEM_SIZES.get(kind, len(body))
        items = [body[at:at + size] for at in range(0, len(body), size)]
        parts = self.pick.randint(2, 4) if self.splits and len(items) > 4 else 1
        cuts = sorted(self.pick.sample(range(1, len(items)), parts - 1))
        for part, (start, to) in enumerate(zip([0] + cuts, cuts + [len(items)])):
            last = part + 1 == parts
            content = b"".join(items[start:to])
            counts = bytearray(head[17:22]) + struct.pack(">H", len(content))
            front = b"MXTP" + kind.encode() + struct.pack(">IBBI", sample, part | (0x80 if last else 0),
                                                          min(255, to - start), clock)
            yield part, last, front + bytes([character]) + bytes(counts) + content

    def information(self, kind, character):
        for part, last, (head, body) in self.bodies[character, kind]:
            yield part, last, head + body


def record_bodies(cli):
    """What the performers send in a second: of each type of each one message."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as channel:
        channel.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 22)
        channel.bind(("127.0.0.1", 0))
        channel.settimeout(1.0)
        to = f"127.0.0.1:{channel.getsockname()[1]}"
        sender = subprocess.Popen([cli, "send", "--to", to, "--characters", "20", "--rate", "10", "--duration", "1",
                                   "--motion", "idle"], stdout=subprocess.DEVNULL)
        bodies = defaultdict(dict)
        try:
            while True:
                raw = channel.recv(65536)
                kind, counter, character = raw[4:6].decode(), raw[10], raw[16]
                bodies[character, kind][counter & 0x7F] = (counter & 0x7F, bool(counter & 0x80), (raw[:24], raw[24:]))
        except socket.timeout:
            sender.wait()
    return {key: [parts[number] for number in sorted(parts)] for key, parts in bodies.items()}


class Take(FaultySender):
    """Calm outside of the stretch in which it goes wrong, and where names and null poses are sent: how their parts
    are counted is another test."""

    def is_quiet(self, moment):
        return not BEGIN <= moment < END or super().is_quiet(moment)

    def go_wrong(self, datagrams):
        messages = [one for one in datagrams if one.kind not in SAMPLED]
        return messages + super().go_wrong([one for one in datagrams if one.kind in SAMPLED])


def draw_take(seed, bodies):
    pick = random.Random(seed)
    kinds = [KINDS[seed % len(KINDS)]] if seed % 3 else pick.sample(KINDS, pick.randint(2, 5))
    few = pick.random() < 0.4
    characters = pick.choice([1, 2, 4] if len(kinds) > 1 else [1, 2, 4, 20])
    types = tuple(pick.sample(["02", "05", "01"], 1) + pick.sample(["20", "21", "22", "23", "24", "25"], 2 if few else 4))
    rate = pick.choice([24.0, 60.0] if characters == 20 else [24.0, 60.0, 100.0, 240.0])
    plan = Plan(rate=rate, seconds=SECONDS, first=5000 if "restart" in kinds else pick.choice([0, 5000, 0xFFFFFFFF - 300]),
                drop=pick.choice([0.002, 0.02, 0.2]) if "drop" in kinds else 0.0,
                burst=0.002 if "burst" in kinds else 0.0, duplicate=0.02 if "duplicate" in kinds else 0.0,
                reorder=0.02 if "reorder" in kinds else 0.0, damage=0.01 if "damage" in kinds else 0.0,
                splits="splits" in kinds)
    middle = pick.uniform(BEGIN + 1, END - 3)
    if "restart" in kinds:
        plan.restart = (middle, pick.choice([1, 500_000]))
    if "change" in kinds:
        plan.change = (middle + 1, *pick.choice([(1, 2), (1, 4), (2, 1)]))
    if "pause" in kinds:
        plan.pause = (middle + 2.2, pick.uniform(0.02, 0.8))
    if "outage" in kinds:
        plan.outage = (middle - 1, pick.uniform(0.3, 1.6))
    take = Take(seed, SECONDS, characters, plan, types, Bodies(pick, plan.splits, bodies))
    return kinds, take


class Faults:
    """What a receiver can know of what went wrong, and when."""

    def __init__(self, take):
        self.take = take
        self.points = defaultdict(list)  # by character: when something could be known to have gone wrong
        self.late = defaultdict(list)  # by character: when a later sample came before one that came after all
        self.spans = defaultdict(list)  # by character: silences
        self.missing = []  # from when to when a sample is missing
        self.whole = []  # of all characters
        arrived = defaultdict(dict)  # by stream and run: sample to parts and their times
        heard = defaultdict(list)
        seen = set()
        for one in take.sent:
            if one.state in ("malformed", "foreign", "stray"):
                self.whole.append(one.time) if one.state == "foreign" or len(one.raw) < 24 else \
                    self.points[one.character].append(one.time)
            elif one.kind in SAMPLED:
                heard[one.character].append(one.time)
                stream = (one.character, one.kind, one.run)
                if (stream, one.sample, one.part) in seen:
                    self.points[one.character].append(one.time)
                seen.add((stream, one.sample, one.part))
                arrived[stream].setdefault(one.sample, {}).setdefault(one.part, one.time)
        needed = defaultdict(set)
        for one in take.good:
            if one.kind in SAMPLED:
                needed[(one.character, one.kind, one.run), one.sample].add(one.part)
        for stream, samples in arrived.items():
            self.add_stream(stream, samples, {s: parts for (of, s), parts in needed.items() if of == stream})
        for character, times in heard.items():
            for before, after in zip(times, times[1:]):
                if after - before > SILENT:
                    self.spans[character].append((before, after))
        if take.plan.restart:
            self.whole.append(take.plan.restart[0] + 3 / take.plan.rate)

    def add_stream(self, stream, samples, needed):
        """Of each sample that is not whole: when a later one came, and when the rest of it did."""
        base = next(iter(samples))
        places = [distance(sample, base) for sample in samples]
        later = float("inf")
        for place in range(max(places), min(places) - 1, -self.take.runs[stream[2]].step):
            sample = (base + place) & 0xFFFFFFFF
            parts = samples.get(sample, {})
            isWhole = len(parts) == len(needed.get(sample, {0}))
            whole = max(parts.values()) if isWhole else float("inf")
            known = later
            if not isWhole and parts:
                known = min(later, min(parts.values()) + 0.15)
            if known + 100 / self.take.plan.rate < whole < float("inf"):
                whole += 4 / self.take.plan.rate  # so far back it may be a restart: the next ones tell
            if whole > known:
                self.missing.append((known, whole))
                self.points[stream[0]].append(known if not isWhole else whole)
                if isWhole:
                    self.late[stream[0]].append(known)
            later = min([later] + list(parts.values()))

    def missing_at(self, moment):
        return sum(known <= moment < whole for known, whole in self.missing)

    def must_be_said(self, moment, character=None):
        """Why nothing is good at a moment; None where nothing is to be said."""
        characters = range(self.take.characters) if character is None else [character]
        for one in characters:
            for time in self.points[one]:
                if time + SOON < moment < time + MENTIONED:
                    return f"a fault at {time:.3f}"
            for begin, end in self.spans[one]:
                if begin + SOON < moment < end + MENTIONED:
                    return f"silence from {begin:.3f} to {end:.3f}"
        return next((f"a fault of all at {t:.3f}" for t in self.whole if t + SOON < moment < t + MENTIONED), None)

    def is_calm(self, moment, character):
        """Nothing went wrong with it for long, as far as a receiver could know."""
        last = self.points[character] + self.late[character] + self.whole
        last += [at for span in self.spans[character] for at in span]
        if self.take.plan.change:
            begin = self.take.plan.change[0]
            last += [begin, begin + 64 * 4 / self.take.plan.rate]
        early = min(last, default=1e9)
        return moment < early - SOON or moment > max(last, default=0) + FORGOTTEN


def monitor(cli, path, *more):
    done = subprocess.run([cli, "monitor", str(path), *more], capture_output=True, timeout=300, check=False)
    if done.returncode not in (0, 1):
        sys.exit(f"posewire-cli monitor failed: {done.stderr.decode()}")
    return done.stdout.decode()


def check_line(line, faults):
    moment = (line["timeNs"] - FIRST_STAMP) / 1e9
    state, text = line["verdict"]["state"], line["verdict"]["text"]
    at = f"{moment:.3f} s: {state} \"{text}\""
    why = faults.must_be_said(moment)
    if state == "good" and why:
        yield f"{at}, but there is {why}"
    missing = faults.missing_at(moment)
    if re.search(r"\blost\b", text) and not (missing or faults.missing_at(moment - 9)) and not faults.missing:
        yield f"{at}, but nothing was lost"
    for incident in line["incidents"]:
        if incident["state"] != "provisional" and incident["samples"] > missing:
            yield f"{at}: incident {incident['id']} ({incident['kind']}) has {incident['samples']}, missing {missing}"
    ids = [character["id"] for character in line["characters"]]
    if not set(ids) <= set(range(faults.take.characters)) or len(ids) > faults.take.characters:
        yield f"{at}: characters {ids}"
    for character in line["characters"]:
        number, how = character["id"], character["state"]
        why = faults.must_be_said(moment, number)
        if how == "good" and why:
            yield f"{at}: character {number} is good, but there is {why}"
        if how != "good" and moment > 1.0 and faults.is_calm(moment, number):
            yield f"{at}: character {number} is {how}, but nothing is wrong with it"


def check_report(report, take, faults):
    truth = truth_of(take.sent, take.runs)
    streams = [s for source in report["sources"] for c in source["characters"] for s in c["streams"]]
    sent = sum(s["lost"] + s["incomplete"] for c in truth["characters"] for s in c["streams"] if s["type"] in SAMPLED)
    lost = sum(s["lost"] + s["incomplete"] for s in streams)
    causes, told = defaultdict(int), defaultdict(int)
    for stream in streams:
        for cause, count in stream["causes"].items():
            causes[cause] += count
    for incident in report["incidents"]:
        if incident["state"] == "provisional":
            yield f"at the end something is provisional: {incident}"
        if incident["samples"]:
            told[incident["cause"]] += incident["samples"]
    causes = {cause: count for cause, count in causes.items() if count}
    if not sent == lost == sum(causes.values()):
        yield f"lost: sent {sent}, counted {lost}, causes {dict(causes)}"
    if causes != dict(told):
        yield f"causes {causes}, incidents {dict(told)}"
    if sent == 0 and any(i["kind"] in ("loss", "local") for i in report["incidents"]):
        yield f"nothing was lost, but there is {[i['text'] for i in report['incidents']]}"
    if sent == 0 and "lost" in report["verdict"]["text"]:
        yield f"nothing was lost, but: {report['verdict']['text']}"
    if causes.keys() - {"network", "unknown", "sender"}:
        yield f"causes {causes}: this computer lost nothing"
    kinds = {incident["kind"] for incident in report["incidents"]}
    isAny = sent or take.plan.restart or faults.whole or any(faults.points.values()) or any(faults.spans.values())
    if bool(kinds - {"step", "limit"}) != bool(isAny):
        yield f"{report['verdict']['text']}: incidents {kinds}"


def check(cli, seed, bodies, folder):
    kinds, take = draw_take(seed, bodies)
    path = pathlib.Path(folder) / "take.pcap"
    write_packets(path, [(datagram.time, datagram.raw, ("192.0.2.1", 40001)) for datagram in take.sent])
    faults = Faults(take)
    name = f"seed {seed} ({', '.join(kinds)}; {take.characters} × {','.join(take.types)} at {take.plan.rate:.0f})"
    lines = monitor(cli, path, "--json-lines", "--interval", "0.1").splitlines()
    found = []
    for text in lines:
        found += list(check_line(json.loads(text), faults))
    found += list(check_report(json.loads(monitor(cli, path, "--json")), take, faults))
    for one in found[:6]:
        print(f"{name}: {one}")
    if len(found) > 6:
        print(f"{name}: and {len(found) - 6} more")
    return len(lines), len(found)


def lines_of(cli, path, packets):
    write_packets(path, packets)
    for text in monitor(cli, path, "--json-lines", "--interval", "0.1").splitlines():
        line = json.loads(text)
        yield (line["timeNs"] - FIRST_STAMP) / 1e9, line


def calm_take(bodies):
    return Take(1, SECONDS, 2, Plan(60.0, SECONDS, 1, 0.0, 0.0, 0.0, 0.0, 0.0, False), ("02", "24"),
                Bodies(random.Random(1), False, bodies)).sent


def check_second_sender(cli, bodies, folder):
    """Another host sends the same characters for a while: both are flagged, each with the name of the other."""
    one, other = ("192.0.2.1", 40001), ("192.0.2.2", 40001)
    packets = [(d.time, d.raw, one) for d in calm_take(bodies)]
    packets += [(d.time + 0.001, d.raw, other) for d in calm_take(bodies) if 5 <= d.time < 9]
    for moment, line in lines_of(cli, pathlib.Path(folder) / "two.pcap", sorted(packets, key=lambda one: one[0])):
        text, states = line["verdict"]["text"], {(c["source"], c["id"]): c["state"] for c in line["characters"]}
        at = f"two senders, {moment:.3f} s: {text}"
        if 1 < moment < 5 and line["verdict"]["state"] != "good":
            yield f"{at}, but nothing is wrong yet"
        if 5 + SOON < moment < 9:
            if not ("192.0.2.1:40001" in text and "192.0.2.2:40001" in text) or line["verdict"]["state"] != "bad":
                yield f"{at}, but two send the same"
            if len(states) != 4 or set(states.values()) != {"bad"}:
                yield f"{at}: {states}"
        if moment > 9 + FORGOTTEN and any(state != "good" for (source, _), state in states.items()
                                          if source == "192.0.2.1:40001"):
            yield f"{at}: {states}"


def check_restarted_sender(cli, bodies, folder):
    """The same host goes on from another port, its counters begin anew: the characters are the same."""
    sent = calm_take(bodies)
    packets = [(d.time, d.raw, ("192.0.2.1", 40001)) for d in sent if d.time < 8]
    packets += [(d.time + 9, d.raw, ("192.0.2.1", 40002)) for d in sent if d.time < 21]
    for moment, line in lines_of(cli, pathlib.Path(folder) / "restarted.pcap", packets):
        state, text = line["verdict"]["state"], line["verdict"]["text"]
        at = f"restarted sender, {moment:.3f} s: {state} \"{text}\""
        if len(line["characters"]) > 2 or "lost" in text:
            yield at
        if state == "good" and 8 + SOON < moment < 9:
            yield f"{at}, but it is silent"
        if state != "good" and (1 < moment < 8 or moment > 9 + FORGOTTEN):
            yield f"{at}, but nothing is wrong"


def main():
    cli, first, last = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    bodies = record_bodies(cli)
    with tempfile.TemporaryDirectory() as folder:
        results = [check(cli, seed, bodies, folder) for seed in range(first, last + 1)]
        found = list(check_second_sender(cli, bodies, folder)) + list(check_restarted_sender(cli, bodies, folder))
    print(*found[:12], sep="\n")
    faults = sum(found for _, found in results) + len(found)
    print(f"{sum(lines for lines, _ in results)} moments of {len(results)} takes compared, {faults} disagree")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
