"""Runs inside of Blender: builds the exported scene, renders every budget, prints a line RESULT {...} for each.

Settings that make it comparable: no clamp, no denoiser, no adaptive sampling, no light threshold, no filtered glossy,
both kinds of caustics, box filter of one pixel, 32-bit linear EXR.
"""
import json
import math
import os
import resource
import struct
import sys
import time
from array import array

begin = time.monotonic()
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import bpy  # noqa: E402
import mathutils  # noqa: E402
import scene as scenes  # noqa: E402


def normalized(c):
    top = max(c)
    return (*(x / top for x in c), 1), top


def material(m):
    made = bpy.data.materials.new(m["name"])
    made.use_nodes = True
    tree = made.node_tree
    tree.nodes.clear()
    node = {"lambert": "ShaderNodeBsdfDiffuse", "mirror": "ShaderNodeBsdfGlossy", "glass": "ShaderNodeBsdfGlass"}[m["type"]]
    surface = tree.nodes.new(node)
    surface.inputs["Color"].default_value = (*m["base_color"], 1)
    surface.inputs["Roughness"].default_value = 0
    if m["type"] != "lambert":
        surface.distribution = "SHARP"
    if m["type"] == "glass":
        surface.inputs["IOR"].default_value = m["ior"]
    result = surface.outputs[0]
    if scenes.emits(m):
        colour, strength = normalized(m["emission"])
        emission = tree.nodes.new("ShaderNodeEmission")
        emission.inputs["Color"].default_value = colour
        emission.inputs["Strength"].default_value = strength
        if not m["emission_both_sides"]:  # strength - strength * backfacing
            side = tree.nodes.new("ShaderNodeNewGeometry")
            only = tree.nodes.new("ShaderNodeMath")
            only.operation = "MULTIPLY_ADD"
            only.inputs[1].default_value, only.inputs[2].default_value = -strength, strength
            tree.links.new(side.outputs["Backfacing"], only.inputs[0])
            tree.links.new(only.outputs[0], emission.inputs["Strength"])
        result = emission.outputs[0]
        if any(m["base_color"]):
            both = tree.nodes.new("ShaderNodeAddShader")
            tree.links.new(surface.outputs[0], both.inputs[0])
            tree.links.new(emission.outputs[0], both.inputs[1])
            result = both.outputs[0]
    tree.links.new(result, tree.nodes.new("ShaderNodeOutputMaterial").inputs[0])
    return made


def add_mesh(scene, mesh, materials):
    count = len(mesh.material)
    data = bpy.data.meshes.new("mesh")
    data.vertices.add(len(mesh.positions) // 3)
    data.vertices.foreach_set("co", array("f", mesh.positions))
    data.loops.add(3 * count)
    data.loops.foreach_set("vertex_index", array("i", mesh.corners))
    data.polygons.add(count)
    data.polygons.foreach_set("loop_start", array("i", range(0, 3 * count, 3)))
    data.polygons.foreach_set("loop_total", array("i", [3]) * count)
    used = sorted(set(mesh.material))
    place = {m: i for i, m in enumerate(used)}
    for m in used:
        data.materials.append(materials[m])
    data.polygons.foreach_set("material_index", array("i", (place[m] for m in mesh.material)))
    if mesh.normals:
        data.polygons.foreach_set("use_smooth", [True] * count)
    data.update(calc_edges=True)
    if mesh.normals:
        n = mesh.normals
        # A normal of 0 asks for the face's own.
        data.use_auto_smooth = True
        data.normals_split_custom_set(
            [(0, 0, 0) if i == scenes.NO_NORMAL else tuple(n[3 * i : 3 * i + 3]) for i in mesh.normal_corners])
    scene.collection.objects.link(bpy.data.objects.new("mesh", data))


def add_light(scene, light):
    kind = light["type"]
    if kind == "environment":
        scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (*light["radiance"], 1)
        return
    colour, strength = normalized(light["intensity" if kind == "point" else "irradiance"])
    lamp = bpy.data.lights.new(kind, "POINT" if kind == "point" else "SUN")
    lamp.color = colour[:3]
    # Of a point in watts, which go out over the whole sphere.
    lamp.energy = strength * 4 * math.pi if kind == "point" else strength
    thing = bpy.data.objects.new(kind, lamp)
    if kind == "point":
        lamp.shadow_soft_size = 0
        thing.location = light["position"]
    else:
        lamp.angle = 0
        thing.rotation_euler = mathutils.Vector(light["direction"]).to_track_quat("-Z", "Y").to_euler()
    lamp.cycles.max_bounces = 1024
    scene.collection.objects.link(thing)


def add_camera(scene, camera):
    data = bpy.data.cameras.new("camera")
    data.sensor_fit = "VERTICAL"
    data.angle = math.radians(camera["fov_deg"])
    data.clip_start, data.clip_end = 1e-6, 1e30
    position, target, up = (mathutils.Vector(camera[key]) for key in ("position", "target", "up"))
    forward = (target - position).normalized()
    right = forward.cross(up).normalized()
    turned = mathutils.Matrix((right, right.cross(forward), -forward)).transposed().to_4x4()
    thing = bpy.data.objects.new("camera", data)
    thing.matrix_world = mathutils.Matrix.Translation(position) @ turned
    scene.collection.objects.link(thing)
    scene.camera = thing


def set_up(scene, exported, order):
    render, cycles = scene.render, scene.cycles
    render.engine = "CYCLES"
    render.resolution_x, render.resolution_y = order["size"]
    render.resolution_percentage = 100
    render.threads_mode, render.threads = "FIXED", order["threads"]
    render.use_persistent_data = True
    # Or Blender would dither, or say what it did not do, in what should be radiance.
    render.dither_intensity = 0
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_mode = "RGB"
    render.image_settings.color_depth = "32"
    render.image_settings.exr_codec = "ZIP"
    scene.view_settings.view_transform = "Raw"
    cycles.device = "CPU"
    cycles.seed = order["seed"]
    cycles.use_adaptive_sampling = cycles.use_denoising = cycles.use_auto_tile = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.light_sampling_threshold = cycles.blur_glossy = 0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    cycles.pixel_filter_type = "BOX"
    cycles.filter_width = 1.0
    most = min(exported["max_depth"] - 1, 1024) if exported["max_depth"] else 1024
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = cycles.transmission_bounces = most
    cycles.transparent_max_bounces = 1024


def header_text(path, key):
    """The value of a text in the header of an EXR file: NAME 0 string 0 SIZE VALUE."""
    with open(path, "rb") as file:
        head = file.read(1 << 16)
    mark = key.encode() + b"\0string\0"
    at = head.index(mark) + len(mark)
    (size,) = struct.unpack_from("<i", head, at)
    return head[at + 4 : at + 4 + size].decode()


def seconds(text):
    """Of "01:02.50" or "1:01:02.50"."""
    total = 0.0
    for part in text.split(":"):
        total = 60 * total + float(part)
    return total


def render_one(scene, spp, output):
    """Wall seconds of the render call, and CPU seconds of it."""
    scene.cycles.samples = spp
    scene.render.filepath = output
    before, wall = resource.getrusage(resource.RUSAGE_SELF), time.monotonic()
    bpy.ops.render.render()
    after, wall = resource.getrusage(resource.RUSAGE_SELF), time.monotonic() - wall
    bpy.data.images["Render Result"].save_render(output, scene=scene)
    return wall, (after.ru_utime + after.ru_stime) - (before.ru_utime + before.ru_stime)


def main():
    with open(sys.argv[sys.argv.index("--") + 1], encoding="utf-8") as file:
        order = json.load(file)
    exported = scenes.load(order["folder"])
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0, 0, 0, 1)
    materials = [material(m) for m in exported["materials"]]
    for mesh in scenes.placed(exported, order["folder"]):
        add_mesh(scene, mesh, materials)
    for light in exported["lights"]:
        add_light(scene, light)
    add_camera(scene, exported["camera"])
    set_up(scene, exported, order)
    render_one(scene, 1, order["warm"])
    load = time.monotonic() - begin
    for budget in order["budgets"]:
        wall, cpu = render_one(scene, budget["spp"], budget["output"])
        own = seconds(header_text(budget["output"], "cycles.ViewLayer.render_time"))
        figures = {"version": bpy.app.version_string, "spp": budget["spp"], "render_wall_s": own,
                   "render_cpu_s": round(cpu, 3), "load_s": round(load, 3), "call_wall_s": round(wall, 3)}
        print("RESULT " + json.dumps(figures), flush=True)


if __name__ == "__main__":
    main()
