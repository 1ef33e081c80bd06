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
import cycles_materials  # noqa: E402
import mathutils  # noqa: E402
import scene as scenes  # noqa: E402

FINE, COARSE = 256, 96  # triangles of spheres around the equator; coarse are those that emit


def mesh_data(mesh, materials):
    """mesh: of scene.py, or anything with the same members."""
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
    corners = mesh.normal_corners
    smooth = [bool(mesh.normals)] * count
    if scenes.NO_NORMAL in corners:
        smooth = [scenes.NO_NORMAL not in corners[3 * t : 3 * t + 3] for t in range(count)]
    data.polygons.foreach_set("use_smooth", smooth)
    if mesh.uvs:
        flat = array("f", bytes(8 * len(mesh.uv_corners)))
        for k in range(2):
            axis = mesh.uvs[k::2]
            flat[k::2] = array("f", (0 if i == scenes.NO_UV else axis[i] for i in mesh.uv_corners))
        data.uv_layers.new().data.foreach_set("uv", flat)
    data.update(calc_edges=True)
    if any(smooth):
        if hasattr(data, "use_auto_smooth"):  # before 4.1
            data.use_auto_smooth = True
        # A normal of 0 asks for the face's own.
        normals = list(zip(*(mesh.normals[k::3] for k in range(3))))
        data.normals_split_custom_set([(0, 0, 0) if i == scenes.NO_NORMAL else normals[i] for i in corners])
    return data


def add_object(scene, data, matrix=None):
    """Returns whether the object stands as the matrix says: Blender's objects have no shear."""
    thing = bpy.data.objects.new("object", data)
    if matrix is not None:
        thing.matrix_world = matrix
        top = max(abs(x) for row in matrix for x in row)
        if any(abs(a - b) > 1e-6 * top for x, y in zip(thing.matrix_basis, matrix) for a, b in zip(x, y)):
            bpy.data.objects.remove(thing)
            return False
    scene.collection.objects.link(thing)
    return True


def add_meshes(scene, exported, folder, materials):
    for entry in exported["meshes"]:
        mesh = scenes.Mesh(os.path.join(folder, entry["file"]))
        data = mesh_data(mesh, materials)
        for t in entry["transforms"]:
            if not add_object(scene, data, mathutils.Matrix((*t, (0, 0, 0, 1)))):
                add_object(scene, mesh_data(mesh.placed(t), materials))


class Ball:
    """A unit sphere of triangles with the normals of the sphere and its longitude and latitude as uv, as a mesh of
    scene.py. equal_area: with corners a little outside, so that it has the area of the sphere."""

    def __init__(self, around, material, equal_area):
        rows = around // 2
        self.positions, self.uvs, self.corners = array("d"), array("d"), array("I")
        for j in range(rows + 1):
            polar = math.pi * j / rows
            for i in range(around + 1):
                turn = 2 * math.pi * i / around  # from -z over -x
                s = math.sin(polar)
                self.positions.extend((-math.sin(turn) * s, -math.cos(polar), -math.cos(turn) * s))
                self.uvs.extend((i / around, j / rows))
        for j in range(rows):
            for i in range(around):
                a, b = j * (around + 1) + i, (j + 1) * (around + 1) + i
                if j > 0:
                    self.corners.extend((a, a + 1, b + 1))
                if j + 1 < rows:
                    self.corners.extend((a, b + 1, b))
        self.normals = self.positions[:]
        self.normal_corners = self.uv_corners = self.corners
        self.material = array("I", [material]) * (len(self.corners) // 3)
        if equal_area:
            area = sum(self.area(t) for t in range(len(self.material)))
            factor = math.sqrt(4 * math.pi / area)
            self.positions = array("d", (factor * x for x in self.positions))

    def area(self, t):
        a, b, c = (self.positions[3 * i : 3 * i + 3] for i in self.corners[3 * t : 3 * t + 3])
        n = scenes.cross([x - y for x, y in zip(b, a)], [x - y for x, y in zip(c, a)])
        return 0.5 * math.sqrt(scenes.dot(n, n))


def add_spheres(scene, exported, folder, materials):
    """Those that are seen, and those that are lights, of a material of their own."""
    balls = {}

    def add(center, radius, key, emits, made):
        if key not in balls:
            balls[key] = mesh_data(Ball(COARSE if emits else FINE, 0, emits), [made])
        place = mathutils.Matrix.Translation(center) @ mathutils.Matrix.Scale(radius, 4)
        add_object(scene, balls[key], place)

    for sphere in exported["spheres"]:
        m = sphere["material"]
        add(sphere["center"], sphere["radius"], m, scenes.emits(exported["materials"][m]), materials[m])
    for i, light in enumerate(exported["lights"]):
        if light["type"] == "sphere":
            m = {"name": "light", "type": "lambert", "base_color": [0, 0, 0], "emission": light["radiance"],
                 "emission_both_sides": False}
            add(light["center"], light["radius"], ("light", i), True, cycles_materials.make(m, exported, folder))


class Ground:
    """A plane as a mesh of scene.py: squares around a middle, each four times as wide as the one within, so that
    triangles are large only far away. They end at 10^4 times the reach."""

    def __init__(self, plane, middle, reach):
        n, uv = mathutils.Vector(plane["normal"]), plane["uv"]
        middle = middle - n * n.dot(middle - mathutils.Vector(plane["point"]))
        right = n.orthogonal().normalized()
        up = n.cross(right)
        origin, u, v = (mathutils.Vector(uv[key]) for key in ("origin", "u", "v"))
        self.positions, self.uvs, self.corners = array("d"), array("d"), array("I", (0, 1, 2, 0, 2, 3))
        size, squares = reach / 16, 0
        while size < 4e4 * reach:
            for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                p = middle + size * (x * right + y * up)
                self.positions.extend(p)
                self.uvs.extend(((p - origin).dot(u), (p - origin).dot(v)))
            if squares:
                for i in range(4):
                    a, b = 4 * (squares - 1) + i, 4 * (squares - 1) + (i + 1) % 4
                    self.corners.extend((a, a + 4, b + 4, a, b + 4, b))
            size, squares = 4 * size, squares + 1
        self.normals, self.normal_corners, self.uv_corners = array("d"), array("I"), self.corners
        self.material = array("I", [plane["material"]]) * (len(self.corners) // 3)


def add_planes(scene, exported, materials):
    """After all else but lamps: they reach beyond it."""
    middle = mathutils.Vector(exported["camera"]["position"])
    corners = [thing.matrix_basis @ mathutils.Vector(p) for thing in scene.collection.objects for p in thing.bound_box]
    corners += [mathutils.Vector(plane["point"]) for plane in exported["planes"]]
    reach = max((p - middle).length for p in corners) if corners else 1
    for plane in exported["planes"]:
        add_object(scene, mesh_data(Ground(plane, middle, reach or 1), materials))


def add_environment(scene, light, folder):
    tree = scene.world.node_tree
    color = tree.nodes["Background"].inputs["Color"]
    if "file" not in light:
        color.default_value = (*light["radiance"], 1)
        return
    nodes = cycles_materials.Nodes(tree, folder, [])
    image = bpy.data.images.load(os.path.join(folder, light["file"]))
    image.colorspace_settings.name = "Non-Color"
    # Cycles' pictures have +x in their middle and +z at their upper edge, the exported ones +z and +y.
    turned = mathutils.Matrix(((0, 0, 1), (1, 0, 0), (0, 1, 0))) @ mathutils.Matrix(light["to_world"]).transposed()
    place = nodes.add("Mapping", {"Vector": nodes.once("TexCoord", "Generated"), "Rotation": tuple(turned.to_euler("XYZ"))},
                      vector_type="POINT").outputs[0]
    picture = nodes.add("TexEnvironment", {"Vector": place}, image=image, interpolation="Linear",
                        projection="EQUIRECTANGULAR")
    tree.links.new(picture.outputs["Color"], color)


def add_light(scene, light, folder):
    kind = light["type"]
    if kind == "sphere":
        return
    if kind == "environment":
        add_environment(scene, light, folder)
        return
    strength = max(light["intensity" if kind == "point" else "irradiance"])
    color = [x / strength for x in light["intensity" if kind == "point" else "irradiance"]]
    lamp = bpy.data.lights.new(kind, "POINT" if kind == "point" else "SUN")
    lamp.color = color
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


def set_lens(data, camera):
    """Cycles takes the radius of the lens for its focal length, in mm, over twice the f-number: the size of the sensor
    is chosen so that this number is 1, or the focal length 1 mm."""
    number = max(1.0, 1 / (2000 * camera["aperture"]))
    data.sensor_height = 2 * math.tan(math.radians(camera["fov_deg"]) / 2) * 2000 * camera["aperture"] * number
    data.dof.use_dof = True
    data.dof.focus_distance = camera["focus"]
    data.dof.aperture_fstop = number


def add_camera(scene, camera):
    data = bpy.data.cameras.new("camera")
    data.sensor_fit = "VERTICAL"
    if camera["type"] == "thin_lens" and camera["aperture"] > 0:
        set_lens(data, camera)
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
    materials = [cycles_materials.make(m, exported, order["folder"]) for m in exported["materials"]]
    add_meshes(scene, exported, order["folder"], materials)
    add_spheres(scene, exported, order["folder"], materials)
    add_planes(scene, exported, materials)
    for light in exported["lights"]:
        add_light(scene, light, order["folder"])
    add_camera(scene, exported["camera"])
    set_up(scene, exported, order)
    render_one(scene, 1, order["warm"])
    load = time.monotonic() - begin
    for budget in order["budgets"]:
        wall, cpu = render_one(scene, budget["spp"], budget["output"])
        own = seconds(header_text(budget["output"], "cycles.ViewLayer.render_time"))
        figures = {"version": bpy.app.version_string, "spp": budget["spp"], "render_wall_s": own,
                   "render_cpu_s": round(cpu, 3), "load_s": round(load, 3), "call_wall_s": round(wall, 3),
                   "trusts_normals": cycles_materials.can_trust_normals()}
        print("RESULT " + json.dumps(figures), flush=True)


if __name__ == "__main__":
    main()
