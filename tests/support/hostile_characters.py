#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes hostile and odd character files into a folder, each about as small as its kind of attack can be. Without
--small those that only large files carry out are that large (25 MB together).

usage: hostile_characters.py [--small] FOLDER
"""
import copy
import io
import json
import os
import pathlib
import struct
import sys
import zipfile


def glb(document, binary):
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    binary += b"\0" * (-len(binary) % 4)
    return (b"glTF" + struct.pack("<II", 2, 28 + len(text) + len(binary)) + struct.pack("<I", len(text)) + b"JSON" + text +
            struct.pack("<I", len(binary)) + b"BIN\0" + binary)


def triangle():
    """A triangle with a skin of two bones, as a glTF document and its buffer."""
    parts = [("POSITION", 5126, "VEC3", 3, struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)),
             ("TEXCOORD_0", 5126, "VEC2", 3, struct.pack("<6f", 0, 0, 1, 0, 0, 1)),
             ("JOINTS_0", 5121, "VEC4", 3, bytes([0, 1, 0, 0] * 3)),
             ("WEIGHTS_0", 5126, "VEC4", 3, struct.pack("<12f", *[1, 0, 0, 0] * 3)),
             ("indices", 5123, "SCALAR", 3, struct.pack("<4H", 0, 1, 2, 0)),
             ("inverse", 5126, "MAT4", 2, struct.pack("<32f", *[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1,
                                                                1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1]))]
    binary, views, accessors = b"", [], []
    for _, kind, shape, count, data in parts:
        views.append({"buffer": 0, "byteOffset": len(binary), "byteLength": len(data)})
        accessors.append({"bufferView": len(accessors), "componentType": kind, "type": shape, "count": count})
        binary += data
    accessors[0].update(min=[0, 0, 0], max=[1, 1, 0])
    return {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 2]}],
            "nodes": [{"name": "Hips", "children": [1]}, {"name": "Spine", "translation": [0, 1, 0]},
                      {"name": "Body", "mesh": 0, "skin": 0}],
            "skins": [{"joints": [0, 1], "inverseBindMatrices": 5}],
            "meshes": [{"primitives": [{"attributes": {part[0]: i for i, part in enumerate(parts[:4])}, "indices": 4}]}],
            "accessors": accessors, "bufferViews": views, "buffers": [{"byteLength": len(binary)}]}, binary


OUTSIDE = {"etc": "file:///etc/passwd", "dots": "../../../../../etc/passwd", "abs": "/etc/passwd", "proc": "/proc/self/environ",
           "zero": "/dev/zero", "http": "http://127.0.0.1:9/x.png", "unc": "\\\\evil\\share\\x.png", "link": "l.png",
           "big": "big.png", "fifo": "fifo.png"}


def of_gltf(small):
    """Names and contents of files that are glTF."""
    base, binary = triangle()

    def changed(change):
        document = copy.deepcopy(base)
        change(document)
        return glb(document, binary)

    def each(key, **values):
        return lambda document: [entry.update(values) for entry in document[key]]

    def chain(depth, children):
        def change(document):
            first = len(document["nodes"])
            document["nodes"] += [{"children": [first + i + 1] * children} if i < depth - 1 else {} for i in range(depth)]
            document["scenes"][0]["nodes"].append(first)
        return change

    def textured(address):
        def change(document):
            document.update(images=[{"uri": address}], textures=[{"source": 0}],
                            materials=[{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}])
            document["meshes"][0]["primitives"][0]["material"] = 0
        return change

    def instances(count):
        def change(document):
            first = len(document["nodes"])
            document["nodes"] += [{"mesh": 0, "skin": 0}] * count
            document["scenes"][0]["nodes"] += range(first, first + count)
        return change

    def repeated(count):
        return lambda document: document["meshes"][0].update(primitives=document["meshes"][0]["primitives"] * count)

    yield "base.glb", changed(lambda document: None)
    for name, address in OUTSIDE.items():
        yield f"tex_{name}.glb", changed(textured(address))
        document = copy.deepcopy(base)
        document["buffers"][0]["uri"] = address
        yield f"buf_{name}.gltf", json.dumps(document, separators=(",", ":")).encode()
    yield "count.glb", changed(each("accessors", count=2**31 - 1))
    yield "count_nobv.glb", changed(lambda document: [(entry.update(count=10**8), entry.pop("bufferView"))
                                                      for entry in document["accessors"]])
    yield "off.glb", changed(each("accessors", byteOffset=2**32 - 4))
    yield "stride.glb", changed(each("bufferViews", byteStride=2**31))
    yield "loop.glb", changed(lambda document: document["nodes"][1].update(children=[0]))
    yield "selfloop.glb", changed(lambda document: document["nodes"][0].update(children=[0]))
    yield "expo.glb", changed(chain(30, 2))
    yield "expo20.glb", changed(chain(20, 2))
    yield "deep.glb", changed(chain(600 if small else 100_000, 1))
    yield "deepjson.gltf", (b'{"a":' + b"[" * 5_000 + b"]" * 5_000 + b"}") if small else \
        (b'{"a":' + b"[" * 2_000_000 + b"]" * 2_000_000 + b"}")
    yield "inst.glb", changed(instances(300 if small else 20_000))
    yield "prims.glb", changed(repeated(60 if small else 40_000))
    whole = changed(lambda document: None)
    for size in (1, 10, 20, 100, len(whole) // 2, len(whole) - 1):
        yield f"trunc{size}.glb", whole[:size]


def of_collada(small):
    head = '<?xml version="1.0"?>'
    entities = "".join('<!ENTITY l%d "%s">' % (i, f"&l{i - 1};" * 10 if i else "lol") for i in range(12))
    yield "xxe.dae", (f'{head}<!DOCTYPE a [<!ENTITY x SYSTEM "file:///etc/passwd">{entities}]>'
                      '<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset>'
                      "<title>&l11;&x;</title></asset></COLLADA>")
    depth = 800 if small else 200_000
    scene = f'{head}<COLLADA version="1.4.1"><library_visual_scenes><visual_scene id="s">%s</visual_scene>' \
            '</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>'
    yield "deep.dae", scene % ('<node id="n">' * depth + "</node>" * depth)
    yield "inst.dae", scene % ('<node id="a"><instance_node url="#b"/></node><node id="b"><instance_node url="#a"/></node>')


def of_others(small):
    """Formats that are not offered, and archives."""
    for name, inner in (("bomb.zae", "model.dae"), ("bomb.3mf", "3D/3dmodel.model"), ("bomb.dae", "model.dae")):
        packed = io.BytesIO()
        with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
            archive.writestr("manifest.xml", "<dae_root>model.dae</dae_root>")
            with archive.open(inner, "w", force_zip64=True) as file:
                for _ in range(1 if small else 64):
                    file.write(b" " * (1 << 20))
        yield name, packed.getvalue()
    yield "head.fbx", b"Kaydara FBX Binary  \0\x1a\0" + struct.pack("<I", 7400) + b"\xff" * 64
    yield "text.fbx", b"; FBX 7.4.0 project file\nObjects: {\n" + b"Model: {\n" * (200 if small else 200_000)
    yield "a.md5mesh", b"MD5Version 10\nnumJoints 2147483647\nnumMeshes 2147483647\n"
    yield "a.x", b"xof 0303txt 0032\n" + b"Frame A {" * (100 if small else 100_000)
    yield "a.bvh", b"HIERARCHY\nROOT a\n{\n" + b"JOINT b\n{\n" * (100 if small else 200_000)
    yield "a.ply", b"ply\nformat ascii 1.0\nelement vertex 4294967295\nproperty float x\nend_header\n"
    yield "a.stl", b"\0" * 80 + struct.pack("<I", 2**32 - 1)


def write(folder, small):
    folder.mkdir(parents=True, exist_ok=True)
    for files in (of_gltf, of_collada, of_others):
        for name, content in files(small):
            (folder / name).write_bytes(content.encode() if isinstance(content, str) else content)
    if not small:
        (folder / "l.png").symlink_to("/etc/passwd")
        os.mkfifo(folder / "fifo.png")
        with open(folder / "big.png", "wb") as file:
            file.truncate(200 << 20)


if __name__ == "__main__":
    write(pathlib.Path(sys.argv[-1]), "--small" in sys.argv)
