"""Small scenes, one for each kind of material and light that an exported scene can say: a ball in a closed room with a lamp
below its ceiling, or under a picture of a sky. Everything is generated. Standard library alone."""
import math
import os
import random
import struct
import zlib
from array import array

import exr

VIEW = """version = 1
[render]
size = [96, 96]
max_depth = {depth}
[camera]
position = [0.3, 1.9, 1.9]
target = [0, 1.3, 0]
fov = 56
"""
ROOM = """[[mesh]]
file = "room.obj"
material = "wall"
[material.wall]
base_color = 0.7
"""
LAMP = """[[mesh]]
file = "lamp.obj"
material = "lamp"
[material.lamp]
base_color = 0
emission = [5, 4.5, 4]
"""
BALL = '[[mesh]]\nfile = "ball.obj"\nmaterial = "x"\ntranslate = [0, 1.2, 0]\n'
SKY = '[[light]]\ntype = "environment"\nfile = "sky.exr"\nscale = [1.5, 1, 0.5]\nrotate = [20, 130, -35]\n'
GROUND = ('[[mesh]]\nfile = "ground.obj"\nmaterial = "ground"\n[material.ground]\nbase_color = [0.2, 0.4, 0.6]\n')


def in_room(material, ball=BALL, lamp=LAMP, depth=0, view=VIEW):
    return view.format(depth=depth) + ROOM + lamp + ball + "[material.x]\n" + material


def of(kind, **parameters):
    words = [f'type = "{kind}"']
    for key, value in parameters.items():
        words.append(f"{key} = " + (f'"{value}"' if isinstance(value, str) else str(value).lower()))
    return "\n".join(words) + "\n"


GOLD = [0.9, 0.65, 0.3]
PIECES = ('\n[texture.pieces]\nfile = "color.png"\nscale = [3, 2]\noffset = [0.1, 0.3]\n'
          '[texture.numbers]\nfile = "color.png"\nchannel = "g"\ngain = 0.8\nbias = 0.1\nwrap = "clamp"\n'
          '[texture.squares]\ntype = "checker"\neven = [0.9, 0.8, 0.2]\nodd = [0.1, 0.3, 0.5]\nscale = [9, 7]\noffset = 0.2\n'
          '[texture.lines]\ntype = "grid"\nwidth = 0.3\nscale = 8\n')
MATERIALS = {
    "lambert": of("lambert", base_color=[0.7, 0.5, 0.3]),
    "lambert_texture": of("lambert", base_color=[1, 0.8, 0.6], texture="pieces") + PIECES,
    "lambert_checker": of("lambert", texture="squares") + PIECES,
    "translucent": of("translucent", base_color=[0.2, 0.3, 0.5], transmittance=[0.7, 0.5, 0.2]),
    "translucent_texture": of("translucent", base_color=[0.3, 0.35, 0.5], texture="pieces", transmittance=[0.6, 0.5, 0.4],
                              transmittance_texture="squares") + PIECES,
    "translucent_normal_map": of("translucent", base_color=0.3, transmittance=0.5, normal_texture="normal.png"),
    "mirror": of("mirror", base_color=[0.9, 0.8, 0.7]),
    "metal_smooth": of("metal", base_color=GOLD),
    "metal_rough": of("metal", base_color=GOLD, roughness=0.5),
    "metal_index": of("metal", eta=[0.2, 0.92, 1.1], k=[3.9, 2.45, 2.14], roughness=0.3),
    "metal_texture": of("metal", texture="pieces", roughness_texture="numbers") + PIECES,
    "glass": of("glass", base_color=[0.9, 0.95, 1]),
    "glass_rough": of("glass", roughness=0.4),
    "glass_thin": of("glass", thin=True),
    "glass_thin_tinted": of("glass", thin=True, base_color=[0.9, 0.7, 0.5], ior=1.7),
    "glass_thin_frosted": of("glass", thin=True, roughness=0.4),
    "glass_thin_gauze": of("glass", thin=True, roughness=0.9, ior=1.8, base_color=[0.99, 0.96, 0.9]),
    "plastic_smooth": of("plastic", base_color=[0.7, 0.4, 0.2]),
    "plastic_rough": of("plastic", base_color=[0.7, 0.4, 0.2], roughness=0.5),
    "plastic_dim_coat": of("plastic", base_color=[0.7, 0.4, 0.2], roughness=0.3, ior=1.8, specular=0.5),
    "plastic_coloured_coat": of("plastic", base_color=[0.7, 0.4, 0.2], roughness=0.5, specular=[1, 0.5, 0.2]),
    "plastic_texture": of("plastic", texture="pieces", roughness_texture="numbers") + PIECES,
    "metallic_texture": of("plastic", base_color=GOLD, roughness=0.4, metallic_texture="numbers") + PIECES,
    "principled_half_metal": of("principled", base_color=GOLD, metallic=0.5, roughness=0.5, fuzz=1e-4),
    "principled_half_clear": of("principled", base_color=[0.7, 0.4, 0.2], transmittance=[0.8367, 0.6325, 0.4472],
                                transmission=0.5, roughness=0.4),  # Blender 4 tints by the root at each crossing
    "principled_coat": of("principled", base_color=[0.7, 0.4, 0.2], roughness=0.6, coat=0.25, coat_ior=1.5, coat_darkening=0),
    "principled_coat_rough": of("principled", base_color=GOLD, metallic=1, roughness=0.6, coat=0.25, coat_ior=1.5,
                                coat_roughness=0.4, coat_darkening=0),
    "principled_fuzz": of("principled", base_color=[0.2, 0.1, 0.4], roughness=0.7, fuzz=0.8),
    "principled_anisotropic": of("principled", base_color=GOLD, metallic=1, roughness=0.5, anisotropy=0.72),
    "mix": of("mix", first="gold", second="matt", weight=0.3) + "[material.gold]\n" + of("metal", base_color=GOLD)
           + "[material.matt]\n" + of("lambert", base_color=0.3),
    "mix_texture": of("mix", first="gold", second="matt", weight_texture="lines") + PIECES + "[material.gold]\n"
                   + of("mirror", base_color=GOLD) + "[material.matt]\n" + of("lambert", base_color=0.3),
    "opacity": of("lambert", base_color=[0.7, 0.5, 0.3], opacity=0.4),
    "opacity_texture": of("plastic", base_color=[0.7, 0.5, 0.3], opacity_texture="numbers") + PIECES,
    "normal_map": of("lambert", base_color=0.6, normal_texture="normal.png"),
    "normal_map_flat": of("lambert", base_color=0.6, normal_texture="flat.png"),
    "bumps": of("lambert", base_color=0.6, bump_texture="height.png", bump_scale=4),
    "bumps_metal": of("metal", base_color=GOLD, roughness=0.3, bump_texture="height.png", bump_scale=2),
    "emission_texture": of("lambert", base_color=0.5, emission=[1, 2, 3], emission_texture="pieces") + PIECES,
    "emission_both_sides": of("lambert", base_color=0, emission=[1, 2, 3], emission_sides="both", opacity=0.5),
}


def scenes():
    """The text of each scene, by name."""
    grey = of("lambert", base_color=[0.7, 0.5, 0.3])
    texture = MATERIALS["lambert_texture"]
    found = {name: in_room(material) for name, material in MATERIALS.items()}
    found["room"] = VIEW.format(depth=0) + ROOM + LAMP
    for name in ("plastic_rough", "metal_rough", "glass_thin_tinted", "glass_thin_frosted"):
        found[name + "_back"] = in_room(MATERIALS[name], BALL.replace("ball.obj", "back.obj"))
    found["ball_flat"] = in_room(grey, BALL.replace("ball.obj", "flat.obj"))
    found["ball_coarse"] = in_room(grey, BALL.replace("ball.obj", "coarse.obj"))
    found["glass_coarse"] = in_room(MATERIALS["glass"], BALL.replace("ball.obj", "coarse.obj"))
    found["sphere"] = in_room(texture, '[[sphere]]\ncenter = [0, 1.2, 0]\nmaterial = "x"\n')
    found["sphere_light"] = in_room(grey, lamp='[[light]]\ntype = "sphere"\ncenter = [0.5, 3, 0.8]\nradius = 0.4\n'
                                               "radiance = [12, 10, 8]\n")
    found["point_and_sun"] = (VIEW.format(depth=3) + GROUND + BALL + "[material.x]\n" + grey
                              + '[[light]]\ntype = "point"\nposition = [1, 3, 2]\nintensity = [3, 4, 5]\n'
                              '[[light]]\ntype = "directional"\ndirection = [1, -2, -1]\nirradiance = [2, 1, 3]\n')
    # Mirrored, sheared by a mesh turned within a scaled instance, and turned.
    found["instances"] = in_room(texture, '[[mesh]]\nname = "b"\nfile = "ball.obj"\nmaterial = "x"\nrotate = [0, 0, 40]\n'
                                 'scale = [0.5, 0.3, 0.4]\n[[instance]]\nmesh = "b"\nscale = [-1, 1, 1]\n'
                                 'translate = [-0.6, 1.2, 0]\n[[instance]]\nmesh = "b"\nscale = [1, 2, 1]\n'
                                 'translate = [0.6, 1.3, 0]\n[[instance]]\nmesh = "b"\nrotate = [30, 60, 0]\n'
                                 'translate = [0, 2.2, -0.5]\n')
    found["plane"] = (VIEW.format(depth=0) + SKY + BALL + "[material.x]\n" + grey + '[[plane]]\npoint = [0, 0.1, 0]\n'
                      'material = "tiles"\n[material.tiles]\ntexture = "squares"\n' + PIECES)
    found["lens"] = in_room(texture, view=VIEW + 'type = "thin_lens"\naperture = 0.2\nfocus = 1.0\n')
    found["sky_alone"] = VIEW.format(depth=0) + SKY + '[[sphere]]\ncenter = [0, -50, 0]\nradius = 0.01\n'
    found["sky"] = VIEW.format(depth=0) + SKY + GROUND + BALL + "[material.x]\n" + grey
    found["sky_plastic"] = VIEW.format(depth=0) + SKY + GROUND + BALL + "[material.x]\n" + MATERIALS["plastic_rough"]
    return found


def write_obj(path, points, faces, uvs=(), normals=()):
    """faces: of corners, which index points, uvs and normals alike."""
    with open(path, "w", encoding="ascii") as file:
        for key, table in (("v", points), ("vt", uvs), ("vn", normals)):
            file.writelines(key + "".join(f" {x:.9g}" for x in row) + "\n" for row in table)
        for face in faces:
            corners = (f"{i + 1}/{i + 1 if uvs else ''}/{i + 1 if normals else ''}".rstrip("/") for i in face)
            file.write("f " + " ".join(corners) + "\n")


def write_ball(path, around, smooth, inside_out=False):
    rows, points, uvs, faces = around // 2, [], [], []
    for j in range(rows + 1):
        polar = math.pi * j / rows
        for i in range(around + 1):
            turn = 2 * math.pi * i / around
            points.append((math.sin(turn) * math.sin(polar), -math.cos(polar), math.cos(turn) * math.sin(polar)))
            uvs.append((i / around, j / rows))
    for j in range(rows):
        for i in range(around):
            a, b = j * (around + 1) + i, (j + 1) * (around + 1) + i
            if j > 0:
                faces.append((a, a + 1, b + 1))
            if j + 1 < rows:
                faces.append((a, b + 1, b))
    if inside_out:
        faces = [face[::-1] for face in faces]
    normals = [[-x for x in p] for p in points] if inside_out else points
    write_obj(path, points, faces, uvs, normals if smooth else ())


def write_png(path, side, texel):
    """texel(u, v): three numbers in [0, 1], of the middle of a texel; v upwards."""
    rows = b""
    for y in range(side):
        row = (texel((x + 0.5) / side, 1 - (y + 0.5) / side) for x in range(side))
        rows += b"\0" + bytes(round(255 * min(1, max(0, c))) for color in row for c in color)
    chunk = lambda kind, data: (struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data)))
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", side, side, 8, 2, 0, 0, 0))
                   + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def height(u, v):
    return 0.5 + 0.25 * math.sin(2 * math.pi * 6 * u) + 0.25 * math.sin(2 * math.pi * 4 * v)


def normal(u, v):
    x, y = 0.5 * math.cos(2 * math.pi * 6 * u), 0.5 * math.sin(2 * math.pi * 4 * v)
    size = math.sqrt(x * x + y * y + 1)
    return 0.5 + 0.5 * x / size, 0.5 + 0.5 * y / size, 0.5 + 0.5 / size


def sky_row(y, width, rows):
    row = array("f")
    for x in range(width):
        u, v = (x + 0.5) / width, (y + 0.5) / rows
        sun = 40 * math.exp(-((u - 0.3) ** 2 + (v - 0.35) ** 2) / 0.002)
        row.extend((0.3 + sun + 0.2 * u, 0.4 + 0.9 * sun + 0.3 * (1 - v), 0.9 - 0.5 * v + 0.8 * sun))
    return row


def write_files(folder):
    """All that the scenes name."""
    path = lambda name: os.path.join(folder, name)
    a, b, h = -2.0, 2.0, 4.0
    corners = [(x, y, z) for x in (a, b) for y in (0.0, h) for z in (a, b)]
    write_obj(path("room.obj"), corners, [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)])
    write_obj(path("lamp.obj"), [(-1, 3.9, -1), (1, 3.9, -1), (1, 3.9, 1), (-1, 3.9, 1)], [(0, 1, 2, 3)])
    write_obj(path("ground.obj"), [(-9, 0, -9), (-9, 0, 9), (9, 0, 9), (9, 0, -9)], [(0, 1, 2, 3)])
    write_ball(path("ball.obj"), 128, True)
    write_ball(path("back.obj"), 128, True, True)
    write_ball(path("coarse.obj"), 20, True)
    write_ball(path("flat.obj"), 20, False)
    dice = random.Random(1)
    pieces = {}
    color = lambda u, v: pieces.setdefault((u, v), [dice.uniform(0.1, 0.95) for _ in range(3)])
    write_png(path("color.png"), 16, color)
    write_png(path("normal.png"), 256, normal)
    write_png(path("flat.png"), 8, lambda u, v: (0.5, 0.5, 1))
    write_png(path("height.png"), 256, lambda u, v: (height(u, v),) * 3)
    exr.write(path("sky.exr"), 128, 64, [sky_row(y, 128, 64) for y in range(64)])
