# SPDX-License-Identifier: GPL-3.0-or-later
"""The datagrams of the second encoder: every type, revision and variant, ordinary and awkward."""

import itertools

from second_encoder import (BODY_SEGMENTS, JOINTS, NAMES, TRACKER_SEGMENTS, Case, Header, Values, centre, item_list,
                            metadata, null_pose, props, time_code)

# What the specification's revisions may send. E to K leave bytes 17 to 23 zero, L and M write the payload size, N the
# counts too.
REVISIONS = {
    "E": ["01", "02", "03", "04", "10", "11", "12"],
    "J": ["01", "02", "03", "05", "12", "13", "20", "21", "22", "23", "24", "25"],
    "K": ["01", "02", "03", "05", "12", "13", "20", "21", "22", "23", "24", "25"],
    "M": ["01", "02", "03", "05", "12", "13", "20", "21", "22", "23", "23 short", "24", "24 long", "25"],
    "N": ["01", "02", "03", "05", "12", "13", "20", "21", "22", "23", "23 short", "24", "24 long", "25"],
}
# Body segments, props and finger segments of a character; 23 + 4 + 40 is the largest.
CHARACTERS = [(23, 0, 0), (23, 1, 0), (23, 4, 0), (23, 0, 40), (23, 4, 40), (1, 0, 0), (8, 0, 0)]
LARGEST = 23 + 4 + 40


def announce(header: Header, revision: str, counts: tuple, payload: bytes) -> Header:
    if revision in "MN":
        header.payload_size = len(payload)
    if revision == "N":
        header.counts = counts
    return header


def identities(kind: str, counts: tuple, revision: str, values: Values) -> list:
    """The ids of one datagram's items, as a sender of that revision writes them."""
    total = sum(counts) if revision == "N" else counts[0] + counts[1]
    if kind == "03":
        base = 256 if values.random.random() < 0.5 else 100
        return [base * values.random.randint(1, 23) + values.random.randint(1, 14)
                for _ in range(values.random.randint(38, 46))]
    if kind == "04":
        return [values.random.randrange(1, 2 ** 32) for _ in range(values.random.randint(1, 12))]
    if kind == "20":
        return JOINTS[:values.random.choice([22, 26, 28])]
    if kind == "23":
        return TRACKER_SEGMENTS if values.random.random() < 0.5 else [1, 16, 17, 18, 20, 21, 22]
    if kind == "05":
        return list(range(1, 24))
    if kind == "10" or kind in ("01", "02") and revision == "E":
        return [21 if i == 21 else i for i in range(1, 24)] + list(range(24, 24 + counts[1]))
    return list(range(1, total + 1))


def numbered(header: Header, values: Values) -> Header:
    header.sample = values.random.choice([0, 1, 6681, 2 ** 31 - 1, 2 ** 31, 2 ** 32 - 1, values.random.getrandbits(32)])
    header.time_code = values.random.choice([0, 27837, 86399999, 2 ** 32 - 1, values.random.getrandbits(32)])
    header.character = values.random.choice([0, 0, 1, 3, 4, 255])
    return header


def body_of(layout: str, counts: tuple, revision: str, values: Values) -> tuple[int, bytes, dict]:
    """Returns the header's item count, the payload and the body."""
    kind = layout[:2]
    if kind == "11":
        names = [values.name().replace("\0", "") for _ in range(counts[1])]
        return (counts[1], *props(names, 24))
    if kind == "12":
        tags = [("name", values.name().replace("\n", "") or "Anna"), ("xmid", "1ab02"), ("color", "e96417"),
                ("count", "1"), ("timeOffset", "-3600000"), ("later", "a:b:c"), ("empty", "")]
        values.random.shuffle(tags)
        return (1, *metadata(tags[:values.random.randint(1, 7)], revision != "E"))
    if kind == "13":
        points = [(values.random.randint(1, 23), values.random.randint(1, 14), values.name(),
                   values.random.getrandbits(32)) for _ in range(values.random.randint(0, 20))]
        return (0, *null_pose(BODY_SEGMENTS[:counts[0]] + ["Sword"] * counts[1], points, values))
    if kind == "24":
        return (1, *centre(values, layout == "24 long"))
    if kind == "25":
        return (1, *time_code(values, None if revision in "JK" else 12))
    ids = identities(kind, counts, revision, values)
    return (len(ids), *item_list(layout, ids, values))


def of_revisions(values: Values) -> list:
    cases = []
    for (revision, layouts), mood in itertools.product(REVISIONS.items(), ["everyday", "awkward", "any bits"]):
        values.mood = mood
        for layout, counts in itertools.product(layouts, CHARACTERS):
            items, payload, body = body_of(layout, counts, revision, values)
            header = numbered(announce(Header(layout[:2], items), revision, counts, payload), values)
            if layout[:2] in ("12", "13"):
                header.sample = header.time_code = 0
            plain = mood == "everyday" and revision in "MN" and counts[0] == 23 and layout in ("01", "02", "21", "22")
            cases.append(Case(f"{layout} of {revision}, {counts}, {mood}", header, payload, body, plain=plain))
    return cases


def split_null_pose(values: Values) -> list:
    """Type 13 as it is really sent: segments in the first datagram, points in the following, the last one empty."""
    values.mood = "everyday"
    chunks = [[(number % 23 + 1, number % 14 + 1, NAMES[number % len(NAMES)], number * 0x01010101 % 2 ** 32)
               for number in range(start, min(start + 30, 127))] for start in range(0, 127, 30)]
    parts = [null_pose(BODY_SEGMENTS, [], values)] + [null_pose([], chunk, values) for chunk in chunks]
    parts.append(null_pose([], [], values))
    cases = []
    for revision in "KN":
        for number, (payload, body) in enumerate(parts):
            header = Header("13", 0, datagram=number, last=number == len(parts) - 1)
            announce(header, revision, (23, 0, 0), payload)
            cases.append(Case(f"13 of {revision}, part {number}", header, payload, body))
    return cases


def split_poses(values: Values) -> list:
    """A pose in several datagrams of one sample, up to the highest datagram index."""
    cases = []
    for number, last in [(0, False), (1, False), (2, True), (126, False), (127, True)]:
        payload, body = item_list("02", list(range(number + 1, number + 6)), values)
        header = Header("02", 5, sample=77, datagram=number, last=last, payload_size=len(payload), counts=(23, 0, 0))
        cases.append(Case(f"02 in parts, {number}", header, payload, body))
    return cases


def empty_and_full(values: Values) -> list:
    """Lists of no item, of one and of the most, in both kinds of header."""
    cases = []
    layouts = ["01", "02", "03", "05", "10", "20", "21", "22", "23", "23 short"]
    for layout, count, sized in itertools.product(layouts, [0, 1, 66, LARGEST, 255], [False, True]):
        ids = [(300 + i, 500 + i) if layout == "20" else 2 ** 32 - 1 - i for i in range(count)]
        payload, body = item_list(layout, ids, values)
        header = Header(layout[:2], count, payload_size=len(payload) if sized else 0)
        if layout == "23 short" and count == 0:
            continue  # it looks the same as the long form
        cases.append(Case(f"{layout} with {count} items, sized {sized}", header, payload, body))
    cases.append(Case("11 without props", Header("11", 0), b"", {"props": []}))
    cases.append(Case("12 without tags", Header("12", 1, payload_size=4), *metadata([], True)))
    cases.append(Case("13 without anything", Header("13", 0), *null_pose([], [], values)))
    return cases


def long_texts(values: Values) -> list:
    many = [(number * 257 % 65536, number * 769 % 32768, "点" * (number % 40), 2 ** 32 - 1 - number)
            for number in range(500)]
    wide = [("n" * 200, "v" * 5000), ("名", "前"), ("x", ":::"), ("dup", "1"), ("dup", "2"), (" spaced ", " kept ")]
    cases = []
    for sized in [False, True]:
        for label, kind, (payload, body) in [("13 of 500 points", "13", null_pose([], many, values)),
                                             ("13 of 67 names", "13", null_pose(["骨" * 100] * LARGEST, [], values)),
                                             ("12 of long tags", "12", metadata(wide, True))]:
            header = Header(kind, 1 if kind == "12" else 0, payload_size=len(payload) if sized else 0)
            cases.append(Case(f"{label}, sized {sized}", header, payload, body))
    return cases


def odd_but_legal(values: Values) -> list:
    """What real senders do and the text does not say, and bytes after the end of what the header announces."""
    values.mood = "everyday"
    cases = []
    for revision, prefix, items in itertools.product("KN", [None, 12], [0, 1]):
        payload, body = time_code(values, prefix)
        header = announce(Header("25", items), revision, (23, 0, 0), payload)
        cases.append(Case(f"25 of {revision}, prefix {prefix}, items {items}", header, payload, body))
    for revision, long, items in itertools.product("KN", [False, True], [0, 1]):
        payload, body = centre(values, long)
        header = announce(Header("24", items), revision, (23, 0, 0), payload)
        cases.append(Case(f"24 of {revision}, long {long}, items {items}", header, payload, body))
    payload, body = time_code(values, 0)
    cases.append(Case("25 that miscounts itself", Header("25", 1, payload_size=12), payload, body, False, True))
    payload, body = metadata([("name", "Bo"), ("color", "00ff00")], True, ends_with_newline=False)
    cases.append(Case("12 without the last newline", Header("12", 1, payload_size=len(payload)), payload, body, False))
    payload, body = metadata([("name", "Bo"), ("color", "00ff00")], False)
    cases.append(Case("12 without length in a late header", Header("12", 1, payload_size=len(payload)), payload, body))
    for layout in ["01", "02", "03", "05", "10", "20", "21", "22", "23"]:
        ids = [(1, 2)] * 3 if layout == "20" else [1, 2, 3]
        payload, body = item_list(layout, ids, values)
        header = Header(layout, 3, payload_size=len(payload))
        cases.append(Case(f"{layout} and bytes behind it", header, payload + b"more", body, False, True))
        header = Header(layout, 3)
        cases.append(Case(f"{layout} and bytes behind it, unsized", header, payload + b"more!", body, False, True))
    for size in [0, 1, 15, 17, 33]:
        header = Header("04", 1, payload_size=size)
        cases.append(Case(f"04 of {size} unpublished bytes", header, bytes(range(size)),
                          {"raw": bytes(range(size)).hex()}, alone=size == 0))
    cases.append(Case("a type nobody knows", Header("77", 3, payload_size=9), b"123456789",
                      {"raw": b"123456789".hex()}))
    return cases


def all_cases(seed: int) -> list:
    values = Values(seed)
    parts = [of_revisions, split_null_pose, split_poses, empty_and_full, long_texts, odd_but_legal]
    return [case for part in parts for case in part(values)]
