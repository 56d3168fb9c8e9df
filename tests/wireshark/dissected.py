# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs tshark with the dissector and turns what it says back into the objects of `posewire-cli decode --json`."""

import os
import pathlib
import struct
import subprocess
import xml.etree.ElementTree as ElementTree

HEADER_KEYS = ["sample", "items", "timeCode", "character", "bodySegments", "props", "fingerSegments", "payloadSize"]
COMPONENTS = {3: ["x", "y", "z"], 4: ["re", "i", "j", "k"],
              9: ["m11", "m12", "m13", "m21", "m22", "m23", "m31", "m32", "m33"]}


class Float:
    """A 32-bit float: its bits, and whether what tshark shows is that number."""

    def __init__(self, field):
        raw, shown = bytes.fromhex(field.get("value")), float(field.get("show"))
        self.value = struct.unpack(">f", raw)[0]
        if self.value == self.value:
            near = shown == self.value or abs(shown - self.value) <= 1e-5 * abs(self.value)
            assert near, f"{field.get('name')} shows {shown} for {self.value}"
        else:
            assert shown != shown, f"{field.get('name')} shows {shown} for NaN"

    def __eq__(self, other):
        if self.value != self.value:
            return other == "NaN"
        wanted = {"Infinity": float("inf"), "-Infinity": float("-inf")}.get(other, other)
        return isinstance(wanted, (int, float)) and struct.pack(">f", wanted) == struct.pack(">f", self.value)

    def __repr__(self):
        return f"Float({self.value!r})"


def run_tshark(script: pathlib.Path, capture: pathlib.Path, home: pathlib.Path, *arguments: str) -> subprocess.Popen:
    """In a home of its own, so that nobody's settings matter."""
    environment = dict(os.environ, HOME=str(home), XDG_CONFIG_HOME=str(home), LC_ALL="C.UTF-8")
    command = ["tshark", "-n", "-X", f"lua_script:{script}", "-r", str(capture), *arguments]
    return subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)


def protocols(script: pathlib.Path, capture: pathlib.Path, home: pathlib.Path):
    """Yields for each frame its mxtp trees."""
    with run_tshark(script, capture, home, "-o", "tcp.reassemble_out_of_order:TRUE", "-T", "pdml") as process:
        yield from trees_of(process)
    assert process.returncode == 0, f"tshark ended with {process.returncode}"


def trees_of(process: subprocess.Popen):
    parser = ElementTree.XMLPullParser()
    for line in process.stdout:
        parser.feed(line)
        for _, element in parser.read_events():
            if element.tag == "packet":
                fields = element.iter("field")
                trouble = [field.get("showname") for field in fields if field.get("name") == "_ws.lua.error"]
                assert not trouble, trouble
                yield [proto for proto in element.findall("proto") if proto.get("name") == "mxtp"]
                element.clear()


def children(element, name: str) -> list:
    return [field for field in element if field.get("name") == name]


def text_of(field) -> str:
    """Each byte that is not UTF-8 as a question mark, as in decode --json."""
    raw = bytearray.fromhex(field.get("value", ""))
    while True:
        try:
            return raw.decode("utf-8")
        except UnicodeDecodeError as error:
            raw[error.start] = ord("?")


def integer_of(field) -> int:
    return int(field.get("show"), 0)


def value_of(field):
    """A vector is a field of fields; what has digits to show is a number; everything else is text."""
    parts = [part for part in field if part.get("name").startswith(field.get("name") + ".")]
    if parts:
        assert [part.get("name").split(".")[-1] for part in parts] == COMPONENTS[len(parts)], field.get("name")
        return [Float(part) for part in parts]
    if field.get("name").split(".")[-1] in ("name", "value", "timeCode"):
        return text_of(field)
    return integer_of(field)


def item_of(element) -> dict:
    """Names that the dissector adds stand on the bytes of the ID or of the whole item, so they are told apart."""
    item, seen = {}, set()
    for field in element:
        key = field.get("name").split(".")[-1]
        place = (field.get("pos"), field.get("size"))
        is_added = key == "name" and (place in seen or place == (element.get("pos"), element.get("size")))
        if not is_added:
            item[key] = value_of(field)
        seen.add(place)
    return item


def list_of(element) -> list:
    """An item's field is named after one, the list's after many."""
    plural = element.get("name").split(".")[-1]
    return [item_of(field) for field in element if plural.startswith(field.get("name").split(".")[-1])]


def tags_of(element) -> list:
    return [[text_of(part) for part in tag] for tag in children(element, "mxtp.tag")]


def body_of(proto) -> dict:
    body = {}
    for field in proto:
        name = field.get("name")
        if name in ("mxtp.error", "mxtp.notice", "mxtp.length", "mxtp.rest", "_ws.lua.text") or name.endswith(".count"):
            continue
        if name == "mxtp.text":
            body["tags"] = tags_of(field)
        elif name == "mxtp.raw":
            body["raw"] = field.get("value")
        elif field.get("name") in ("mxtp.position", "mxtp.velocity", "mxtp.acceleration", "mxtp.body.timeCode"):
            body[name.split(".")[-1]] = value_of(field)
        else:
            body[name.split(".")[-1]] = list_of(field)
    return body


def header_of(proto) -> dict:
    """As far as the header goes."""
    header = {}
    for branch in children(proto, "_ws.lua.text"):
        for field in branch:
            key = field.get("name").split(".")[-1]
            if key == "id":
                header["type"] = text_of(field)[4:]
                assert integer_of(field[0]) == int(header["type"])
            elif key == "datagramCounter":
                header["datagram"], header["last"] = integer_of(field[0]), integer_of(field[1]) == 1
            elif key in HEADER_KEYS:
                header[key] = integer_of(field)
    return header


def remarks_of(proto, name: str) -> list:
    """Code, offset and sentence of each remark."""
    remarks = []
    for field in children(proto, name):
        code = field.get("show")
        expert = children(field, "_ws.expert")[0]
        sentence = children(expert, f"{name}.{code}")[0].get("showname")
        remarks.append((code, integer_of(children(field, f"{name}.offset")[0]), sentence))
    return remarks


def object_of(proto) -> dict:
    """What decode --json has for the datagram, as far as it is about the datagram and not the file."""
    dissected = {"size": int(proto.get("size")), **header_of(proto)}
    errors, notices = remarks_of(proto, "mxtp.error"), remarks_of(proto, "mxtp.notice")
    if errors:
        code, offset, sentence = errors[0]
        dissected["error"] = {"code": code, "offset": offset, "text": sentence}
    else:
        is_unknown = any(code in ("unknownType", "unknownLayout") for code, _, _ in notices)
        dissected["body"] = body_of(proto) or ({"raw": ""} if is_unknown else {})
    dissected["notices"] = [sentence for _, _, sentence in notices]
    return dissected
