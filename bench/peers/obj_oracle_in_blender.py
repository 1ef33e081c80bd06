"""Runs inside of Blender, for obj_oracle: a scene with a material of each kind, written as OBJ, rendered by Cycles, and
compared with lancer's picture object by object.

    blender -b --factory-startup --python THIS -- write|render|compare FOLDER ORDER

ORDER is JSON: size, spp, threads, pbr, flat. Lengths are in metres, z is up, as in Blender. Blender 3.3 or later.
"""
import json
import math
import os
import sys
from array import array

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.dont_write_bytecode = True  # the source may not be ours to write to

import bpy  # noqa: E402
import mathutils  # noqa: E402
from cycles_in_blender import add_camera, render_one, set_up  # noqa: E402

CAMERA = {"position": (0, -14, 3.2), "target": (0, 1, 1.5), "up": (0, 0, 1), "fov_deg": 22}
SKY, LAMP = 0.4, (8.0, 7.6, 7.2)
RADIUS = 1.0
SPHERES = {"Diffuse": -5.0, "Gold": -2.5, "Chrome": 0.0, "Clear": 2.5, "Green": 5.0}  # x of each; they stand on the floor
WALL_Y, WALL_X, WALL_Z = 3.0, 6.5, 4.0
GLASS = ("Clear", "Green")
IOR = 1.45

# What is not said is as Blender has it: roughness 0.5, specular 0.5.
MATERIALS = {
    "Diffuse": {"Base Color": (0.6, 0.35, 0.25)},
    "Gold": {"Base Color": (1, 0.766, 0.336), "Metallic": 1, "Roughness": 0.2},
    "Chrome": {"Base Color": (0.8, 0.8, 0.8), "Metallic": 1, "Roughness": 0},
    "Clear": {"Base Color": (1, 1, 1), "Transmission": 1, "Roughness": 0, "IOR": IOR},
    "Green": {"Base Color": (0.3, 0.8, 0.4), "Transmission": 1, "Roughness": 0, "IOR": IOR},
    "Wall": {"Base Color": (0.7, 0.7, 0.7)},
    "Floor": {"Base Color": (0.5, 0.5, 0.5), "Specular": 0},
    "Lamp": {"Base Color": (0, 0, 0), "Specular": 0, "Emission": LAMP, "Emission Strength": 1},
}
# What Blender 4 calls the sockets.
RENAMED = {"Transmission": "Transmission Weight", "Specular": "Specular IOR Level", "Emission": "Emission Color"}


def socket(node, name):
    return node.inputs[name if name in node.inputs else RENAMED[name]]


def principled(name, values):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    node = next(n for n in made.node_tree.nodes if n.type == "BSDF_PRINCIPLED")
    # In Blender 3 the index counts for transmission alone, and 0.5 of "Specular" is a coat of index 1.5.
    socket(node, "IOR").default_value = 1.5
    socket(node, "Specular").default_value = 0.5
    for key, value in values.items():
        socket(node, key).default_value = (*value, 1) if isinstance(value, tuple) else value
    return made, node


def glass_of_keys(name, keys):
    """What the MTL says, as lancer means it: each of two surfaces lets the root of Kd through."""
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    tree = made.node_tree
    tree.nodes.clear()
    glass = tree.nodes.new("ShaderNodeBsdfGlass")
    glass.distribution = "GGX"
    glass.inputs["Roughness"].default_value = keys.get("Pr", [0])[0]
    glass.inputs["Color"].default_value = (*(math.sqrt(x) for x in keys["Kd"]), 1)
    glass.inputs["IOR"].default_value = keys["Ni"][0]
    tree.links.new(glass.outputs[0], tree.nodes.new("ShaderNodeOutputMaterial").inputs[0])
    return made


def normal_map(path, height):
    """Waves in two directions, of different lengths, so that a mirrored or turned map would be seen."""
    side, pixels = 128, array("f")
    for j in range(side):
        for i in range(side):
            u, v = (i + 0.5) / side, (j + 0.5) / side
            slope_u = (0.45 * math.sin(4 * math.pi * u) if u < 0.5 else 0) + 0.15 * math.sin(2 * math.pi * (3 * v + u))
            slope_v = 0.35 * math.cos(4 * math.pi * v) if v > 0.5 else 0
            slope_u, slope_v = height * slope_u, height * slope_v
            length = math.sqrt(slope_u**2 + slope_v**2 + 1)
            pixels.extend((0.5 - slope_u / length / 2, 0.5 - slope_v / length / 2, 0.5 + 0.5 / length, 1))
    image = bpy.data.images.new("wall_normal", side, side)
    image.colorspace_settings.name = "Non-Color"
    image.pixels.foreach_set(pixels)
    image.file_format = "PNG"
    image.filepath_raw = path
    image.save()


def add_normal_map(material, node, path):
    tree = material.node_tree
    picture = tree.nodes.new("ShaderNodeTexImage")
    picture.image = bpy.data.images.load(path)
    picture.image.colorspace_settings.name = "Non-Color"
    turn = tree.nodes.new("ShaderNodeNormalMap")
    tree.links.new(picture.outputs["Color"], turn.inputs["Color"])
    tree.links.new(turn.outputs["Normal"], node.inputs["Normal"])


def add_object(name, points, faces, uvs, material, smooth):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(points, [], faces)
    if uvs:
        layer = mesh.uv_layers.new()
        for i, uv in enumerate(uvs):
            layer.data[i].uv = uv
    mesh.polygons.foreach_set("use_smooth", [smooth] * len(faces))
    mesh.materials.append(material)
    bpy.context.scene.collection.objects.link(bpy.data.objects.new(name, mesh))


def add_sphere(name, x, material):
    rings, segments = 64, 128
    points = [(x, 0, 0.0)]
    for i in range(1, rings):
        a = math.pi * i / rings
        points += [(x + RADIUS * math.sin(a) * math.cos(2 * math.pi * j / segments),
                    RADIUS * math.sin(a) * math.sin(2 * math.pi * j / segments), RADIUS - RADIUS * math.cos(a))
                   for j in range(segments)]
    points.append((x, 0, 2 * RADIUS))
    at = lambda i, j: 1 + (i - 1) * segments + j % segments  # noqa: E731
    faces = [(0, at(1, j + 1), at(1, j)) for j in range(segments)]
    faces += [(at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j))
              for i in range(1, rings - 1) for j in range(segments)]
    faces += [(len(points) - 1, at(rings - 1, j), at(rings - 1, j + 1)) for j in range(segments)]
    add_object(name, points, faces, [], material, True)


def build(folder, glass_keys=None):
    """glass_keys: of each glass the keys of its MTL, which then say what it is made of."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (SKY, SKY, SKY, 1)
    made = {}
    for name, values in MATERIALS.items():
        if glass_keys and name in GLASS and "Tf" in glass_keys[name]:
            made[name] = glass_of_keys(name, glass_keys[name])
            continue
        if glass_keys and name in GLASS:  # nothing in the MTL says that it transmits
            values = {key: value for key, value in values.items() if key != "Transmission"}
        made[name], node = principled(name, values)
        if name == "Wall":
            add_normal_map(made[name], node, os.path.join(folder, "wall_normal.png"))
    for name, x in SPHERES.items():
        add_sphere(name, x, made[name])
    square = [(0, 1, 2, 3)]
    add_object("Wall", [(-WALL_X, WALL_Y, 0), (WALL_X, WALL_Y, 0), (WALL_X, WALL_Y, WALL_Z), (-WALL_X, WALL_Y, WALL_Z)],
               square, [(0, 0), (4, 0), (4, 4 * WALL_Z / (2 * WALL_X)), (0, 4 * WALL_Z / (2 * WALL_X))], made["Wall"], False)
    add_object("Floor", [(-15, -15, 0), (15, -15, 0), (15, 15, 0), (-15, 15, 0)], square, [], made["Floor"], False)
    add_object("Lamp", [(-4, -3, 7), (-4, 0, 7), (4, 0, 7), (4, -3, 7)], square, [], made["Lamp"], False)
    add_camera(scene, CAMERA)
    return scene


def keys_of_mtl(path):
    found = {}
    with open(path, encoding="utf-8") as file:
        for line in file:
            words = line.split()
            if len(words) == 2 and words[0] == "newmtl":
                found[words[1]] = current = {}
            elif len(words) > 1 and words[0][:4] in ("Kd", "Ks", "Tf", "Ni", "Pr", "Ns", "d", "illu"):
                current[words[0]] = [float(w) for w in words[1:]]
    return found


def write(folder, order):
    normal_map(os.path.join(folder, "wall_normal.png"), 0 if order["flat"] else 1)
    build(folder)
    bpy.ops.wm.obj_export(filepath=os.path.join(folder, "scene.obj"), export_pbr_extensions=order["pbr"],
                          path_mode="RELATIVE")
    to_y_up = lambda p: [p[0], p[2], -p[1]]  # noqa: E731
    with open(os.path.join(folder, "scene.toml"), "w", encoding="utf-8") as file:
        file.write(f'''version = 1

[camera]
position = {to_y_up(CAMERA["position"])}
target = {to_y_up(CAMERA["target"])}
fov = {CAMERA["fov_deg"]}

[[mesh]]
file = "scene.obj"

[[light]]
type = "environment"
radiance = {SKY}
''')


def render(folder, order):
    keys = keys_of_mtl(os.path.join(folder, "scene.mtl"))
    for name, glass_keys in (("blender", None), ("keys", keys)):
        scene = build(folder, glass_keys)
        set_up(scene, {"max_depth": 0}, {**order, "seed": 0})
        render_one(scene, order["spp"], os.path.join(folder, name + ".exr"))


def object_at(position, direction):
    """Of a ray of the camera: a sphere without its rim, the wall in a band above the spheres, or nothing."""
    free = True
    for name, x in SPHERES.items():
        to = mathutils.Vector((x, 0, RADIUS)) - position
        away = direction.cross(to).length / RADIUS
        if away < 0.97:
            return name
        free = free and away > 1.05
    hit = position + direction * ((WALL_Y - position.y) / direction.y)
    on_wall = abs(hit.x) < 0.95 * WALL_X and 1.5 < hit.z < 0.95 * WALL_Z
    return "Wall" if free and on_wall else None


def pixels_of_objects(size):
    """The indices of the pixels of each object; the first pixel is the lower left one, as in Blender's pictures."""
    position, target, up = (mathutils.Vector(CAMERA[key]) for key in ("position", "target", "up"))
    forward = (target - position).normalized()
    right = forward.cross(up).normalized()
    high = right.cross(forward)
    half = math.tan(math.radians(CAMERA["fov_deg"]) / 2)
    found = {name: [] for name in (*SPHERES, "Wall")}
    for i in range(size[0] * size[1]):
        x = ((i % size[0] + 0.5) * 2 - size[0]) / size[1] * half
        y = ((i // size[0] + 0.5) * 2 / size[1] - 1) * half
        name = object_at(position, (forward + x * right + y * high).normalized())
        if name:
            found[name].append(i)
    return found


def load_picture(path):
    image = bpy.data.images.load(path)
    image.colorspace_settings.name = "Non-Color"
    values = array("f", [0]) * len(image.pixels)
    image.pixels.foreach_get(values)
    return values


def side_by_side(folder, pictures, size):
    """One below the other, with the sRGB curve."""
    curve = lambda x: 12.92 * x if x < 0.0031308 else min(1, 1.055 * x ** (1 / 2.4) - 0.055)  # noqa: E731
    image = bpy.data.images.new("side_by_side", size[0], len(pictures) * size[1])
    image.colorspace_settings.name = "Non-Color"
    image.pixels.foreach_set(array("f", (curve(x) for picture in reversed(pictures) for x in picture)))
    image.file_format = "PNG"
    image.filepath_raw = os.path.join(folder, "side_by_side.png")
    image.save()


def compare(folder, order):
    pictures = {name: load_picture(os.path.join(folder, name + ".exr")) for name in ("lancer", "blender", "keys")}
    result = {}
    for name, pixels in pixels_of_objects(order["size"]).items():
        mean = {who: [sum(picture[4 * i + c] for i in pixels) / len(pixels) for c in range(3)]
                for who, picture in pictures.items()}
        ratio = lambda who: [a / b for a, b in zip(mean["lancer"], mean[who])]  # noqa: E731
        result[name] = {"pixels": len(pixels), "lancer": mean["lancer"], "blender": ratio("blender"), "keys": ratio("keys")}
    with open(os.path.join(folder, "result.json"), "w", encoding="utf-8") as file:
        json.dump(result, file, indent=1)
    side_by_side(folder, list(pictures.values()), order["size"])


def main():
    what, folder, order = sys.argv[sys.argv.index("--") + 1 :]
    {"write": write, "render": render, "compare": compare}[what](folder, json.loads(order))


if __name__ == "__main__":
    main()
