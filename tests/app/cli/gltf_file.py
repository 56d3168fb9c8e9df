# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads a .glb and skins its mesh as the glTF 2.0 specification has it (3.7.3): matrices, blended linearly.

It shares nothing with the writer. Metres, Y up.
"""
import json
import math
import struct


def turned(q, v):
    """A vector by a quaternion x y z w."""
    x, y, z, w = q
    tx, ty, tz = 2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])
    return (v[0] + w * tx + y * tz - z * ty, v[1] + w * ty + z * tx - x * tz, v[2] + w * tz + x * ty - y * tx)


def product(a, b):
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz)


class GltfFile:
    """Nodes, their keys and the first skinned mesh."""

    COMPONENTS = {5121: "B", 5125: "I", 5126: "f"}
    SIZES = {"SCALAR": 1, "VEC3": 3, "VEC4": 4, "MAT4": 16}

    def __init__(self, data: bytes):
        magic, version, size = struct.unpack_from("<4sII", data)
        length = struct.unpack_from("<I", data, 12)[0]
        if (magic, version, size) != (b"glTF", 2, len(data)):
            raise ValueError("not a glb file")
        self.document = json.loads(data[20:20 + length])
        self.binary = data[28 + length:]
        self.nodes = self.document["nodes"]
        self.parents = {child: i for i, node in enumerate(self.nodes) for child in node.get("children", [])}
        self.keys = {}
        for channel in self.document["animations"][0]["channels"]:
            sampler = self.document["animations"][0]["samplers"][channel["sampler"]]
            self.keys[channel["target"]["node"], channel["target"]["path"]] = self.values(sampler["output"])
        primitive = self.document["meshes"][0]["primitives"][0]
        attributes = primitive["attributes"]
        self.positions = self.values(attributes["POSITION"])
        self.joints = self.values(attributes["JOINTS_0"])
        self.weights = self.values(attributes["WEIGHTS_0"])
        indices = [index for index, in self.values(primitive["indices"])]
        self.triangles = list(zip(indices[::3], indices[1::3], indices[2::3]))
        self.skin = self.document["skins"][0]
        self.binds = self.values(self.skin["inverseBindMatrices"])

    def values(self, number: int) -> list:
        accessor = self.document["accessors"][number]
        view = self.document["bufferViews"][accessor["bufferView"]]
        size = self.SIZES[accessor["type"]]
        layout = f"<{size}{self.COMPONENTS[accessor['componentType']]}"
        step = struct.calcsize(layout)
        at = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        return list(struct.iter_unpack(layout, self.binary[at:at + step * accessor["count"]]))

    def node(self, name: str) -> int:
        return next(i for i, node in enumerate(self.nodes) if node.get("name") == name)

    def world(self, node: int, key) -> tuple:
        """Rotation and place of a node at a key; in the bind pose, when no key is given."""
        own = self.nodes[node]
        turn, place = own.get("rotation", (0, 0, 0, 1)), own.get("translation", (0, 0, 0))
        if key is not None:
            turn = self.keys.get((node, "rotation"), {key: turn})[key]
            place = self.keys.get((node, "translation"), {key: place})[key]
        if node not in self.parents:
            return turn, place
        parent_turn, parent_place = self.world(self.parents[node], key)
        return product(parent_turn, turn), tuple(a + b for a, b in zip(parent_place, turned(parent_turn, place)))

    def collapsed(self) -> list:
        """For each joint of the skin the place of the segment that it belongs to: of a body without joints between."""
        joints = self.skin["joints"]
        return [i if " " not in self.nodes[node]["name"] else joints.index(self.parents[node])
                for i, node in enumerate(joints)]

    def skinned(self, key: int, joint_of=None) -> list:
        worlds = [self.world(node, key) for node in self.skin["joints"]]
        if joint_of is not None:
            worlds = [worlds[i] for i in joint_of]
            binds = [self.binds[i] for i in joint_of]
        else:
            binds = self.binds
        shown = []
        for position, joints, weights in zip(self.positions, self.joints, self.weights):
            sums = [0.0, 0.0, 0.0]
            for joint, weight in zip(joints, weights):
                if weight > 0:
                    bind = binds[joint]
                    local = tuple(sum(bind[4 * column + row] * position[column] for column in range(3)) + bind[12 + row]
                                  for row in range(3))
                    turn, place = worlds[joint]
                    moved = turned(turn, local)
                    for axis in range(3):
                        sums[axis] += weight * (moved[axis] + place[axis])
            shown.append(tuple(sums))
        return shown

    def ring(self, centre, axis: int, reach: float) -> list:
        """The cut of the mesh at rest by a plane across an axis: pieces (edge, edge), an edge being two vertices and
        the share of the second. Only what is nearer to the centre than `reach`."""
        pieces = []
        for triangle in self.triangles:
            corners = [self.positions[i] for i in triangle]
            if max(math.dist(corner, centre) for corner in corners) > reach:
                continue
            cuts = []
            for a, b in ((0, 1), (1, 2), (2, 0)):
                from_plane, to_plane = corners[a][axis] - centre[axis], corners[b][axis] - centre[axis]
                if (from_plane < 0) != (to_plane < 0):
                    cuts.append((triangle[a], triangle[b], from_plane / (from_plane - to_plane)))
            if cuts:  # one edge comes from below the plane, one goes back: all pieces run the same way around
                comes = self.positions[cuts[0][0]][axis] < centre[axis]
                pieces.append(tuple(cuts) if comes else (cuts[1], cuts[0]))
        return pieces


def length_of(ring: list, positions: list) -> float:
    """How long a ring is around, in metres."""
    def at(cut):
        a, b, share = cut
        return [p + share * (q - p) for p, q in zip(positions[a], positions[b])]
    return sum(math.dist(at(a), at(b)) for a, b in ring)


def area_of(ring: list, positions: list) -> float:
    """The area of a ring as its plane sees it, in square metres."""
    total = [0.0, 0.0, 0.0]
    for piece in ring:
        ends = []
        for a, b, share in piece:
            ends.append([p + share * (q - p) for p, q in zip(positions[a], positions[b])])
        (ax, ay, az), (bx, by, bz) = ends
        total = [t + c for t, c in zip(total, (ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx))]
    return 0.5 * math.hypot(*total)
