# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs in Blender: blender -b --factory-startup --python blender_reader.py -- FILE RATE FRAMES RESULT

Writes as JSON what Blender shows of a .glb or .bvh at each of FRAMES frames: `joints`, the head of each bone by name, and
of the first mesh `vertices`; all in Blender's world, metres, Z up, -Y forward.
"""
import json
import sys

import bpy
import numpy
from io_anim_bvh import import_bvh

path, rate, frames, result = sys.argv[sys.argv.index("--") + 1:]
for thing in list(bpy.data.objects):
    bpy.data.objects.remove(thing)
if not hasattr(numpy, "bool"):  # Blender 3.4 calls it so, numpy since 1.24 does not
    numpy.bool = bool
scene = bpy.context.scene
scene.render.fps = int(rate)
if path.endswith(".glb"):
    bpy.ops.import_scene.gltf(filepath=path)
    FIRST = 0
else:
    # Blender 3.4 opens the file in a mode that Python 3.11 has no more.
    import_bvh.open = lambda name, mode: open(name, mode.replace("U", ""), encoding="utf-8")
    bpy.ops.import_anim.bvh(filepath=path, global_scale=0.01)
    FIRST = 1
armature = next(one for one in bpy.data.objects if one.type == "ARMATURE")
meshes = [one for one in bpy.data.objects if one.type == "MESH" and one.parent == armature]
shown = []
for frame in range(int(frames)):
    scene.frame_set(FIRST + frame)
    joints = {bone.name: list(armature.matrix_world @ bone.head) for bone in armature.pose.bones}
    vertices = []
    if meshes:
        body = meshes[0].evaluated_get(bpy.context.evaluated_depsgraph_get())
        vertices = [list(body.matrix_world @ vertex.co) for vertex in body.to_mesh().vertices]
        body.to_mesh_clear()
    shown.append({"joints": joints, "vertices": vertices})
with open(result, "w", encoding="utf-8") as file:
    json.dump(shown, file)
