"""Within Blender: a wavy sphere of many triangles, the map of its normals baked for a coarse one, and both as OBJ
files, into the folder that is named behind `--`. See `baked`."""
import math
import os
import sys

import bpy

WAVE = 0.02  # of the radius
folder = sys.argv[sys.argv.index("--") + 1]


def sphere(segments):
    bpy.ops.mesh.primitive_uv_sphere_add(segments=segments, ring_count=segments // 2)
    bpy.ops.object.shade_smooth()
    return bpy.context.object


def write(thing, name):
    bpy.ops.object.select_all(action="DESELECT")
    thing.select_set(True)
    bpy.ops.wm.obj_export(filepath=os.path.join(folder, name), export_selected_objects=True, export_materials=False,
                          forward_axis="Y", up_axis="Z")


bpy.ops.wm.read_factory_settings(use_empty=True)
fine, coarse = sphere(512), sphere(24)
for vertex in fine.data.vertices:
    x, y, z = vertex.co
    vertex.co *= 1 + WAVE * (math.sin(9 * x) * math.sin(8 * y + 1) * math.sin(9 * z + 2) +
                             0.5 * math.sin(21 * x + 17 * y) * math.sin(19 * z))
# The upper half lies in the left of the map; the lower one in its right, turned and mirrored.
uv = coarse.data.uv_layers.active.data
for face in coarse.data.polygons:
    is_lower = sum(coarse.data.vertices[i].co.z for i in face.vertices) < 0
    for corner in face.loop_indices:
        u, v = uv[corner].uv
        uv[corner].uv = (0.98 - 0.9 * v, 0.02 + 0.96 * u) if is_lower else (0.02 + 0.46 * u, 1.92 * v - 0.94)

baked = bpy.data.images.new("baked", 1024, 1024, float_buffer=True, is_data=True)
material = bpy.data.materials.new("baked")
material.use_nodes = True
node = material.node_tree.nodes.new("ShaderNodeTexImage")
node.image = baked
material.node_tree.nodes.active = node
coarse.data.materials.append(material)
cycles = bpy.context.scene.cycles
bpy.context.scene.render.engine = "CYCLES"
cycles.samples, cycles.use_denoising = 16, False  # Debian's Blender would denoise to nothing
fine.select_set(True)
coarse.select_set(True)
bpy.context.view_layer.objects.active = coarse
bpy.ops.object.bake(type="NORMAL", normal_space="TANGENT", use_selected_to_active=True, cage_extrusion=0.15)
baked.filepath_raw, baked.file_format = os.path.join(folder, "baked.exr"), "OPEN_EXR"
baked.save()
write(coarse, "coarse.obj")
write(fine, "fine.obj")
