"""What `lancer export` writes, read: scene.json and plain OBJ files of triangles. README.md has the words of scene.json.
Standard library alone."""
import json
import math
import os
from array import array

# Of materials; what else there may be is not understood, and no peer may go past it.
MATERIAL_KEYS = {
    "name", "type", "base_color", "texture", "transmittance", "transmittance_texture", "roughness", "roughness_texture", "ior",
    "thin", "eta", "k", "specular", "metallic", "metallic_texture", "diffuse_roughness", "specular_weight", "anisotropy",
    "anisotropy_rotation", "transmission", "coat", "coat_color", "coat_roughness", "coat_ior", "coat_darkening", "fuzz",
    "fuzz_color", "fuzz_roughness", "film", "film_thickness", "film_ior", "sheet", "first", "second", "weight", "weight_texture", "emission",
    "emission_texture", "emission_both_sides", "opacity", "opacity_texture", "normal_texture", "bumps"}
NO_NORMAL = NO_UV = 0xFFFFFFFF


def load(folder):
    with open(os.path.join(folder, "scene.json"), encoding="utf-8") as file:
        scene = json.load(file)
    if scene["schema"] != "lancer.scene/2":
        raise SystemExit("peers: error: scene.json has the schema " + scene["schema"])
    return scene


class Mesh:
    """positions, normals: x y z, one after the other; uvs: u v; corners: three indices a triangle; normal_corners and
    uv_corners likewise, empty if the mesh has none; material: one index a triangle."""

    def __init__(self, path):
        self.positions, self.normals, self.uvs = array("d"), array("d"), array("d")
        self.corners, self.normal_corners, self.uv_corners = array("I"), array("I"), array("I")
        self.material = array("I")
        current = 0
        with open(path, encoding="ascii") as file:
            for line in file:
                words = line.split()
                if words[0] == "v":
                    self.positions.extend(map(float, words[1:4]))
                elif words[0] == "vt":
                    self.uvs.extend(map(float, words[1:3]))
                elif words[0] == "vn":
                    self.normals.extend(map(float, words[1:4]))
                elif words[0] == "usemtl":
                    current = int(words[1][1:])
                elif words[0] == "f":
                    self.material.append(current)
                    for word in words[1:4]:
                        index, uv, normal = (word.split("/") + ["", ""])[:3]
                        self.corners.append(int(index) - 1)
                        if self.normals:
                            self.normal_corners.append(int(normal) - 1 if normal else NO_NORMAL)
                        if self.uvs:
                            self.uv_corners.append(int(uv) - 1 if uv else NO_UV)

    def placed(self, t):
        """At a place, which is rows of 3x4 numbers. One that mirrors turns the winding round, so that each triangle
        keeps its sides."""
        mesh = Mesh.__new__(Mesh)
        p, n = self.positions, self.normals
        mesh.positions = array("d", (x for i in range(0, len(p), 3) for x in place(t, *p[i : i + 3])))
        mesh.normals = array("d", (x for i in range(0, len(n), 3) for x in place_normal(t, n[i : i + 3])))
        mesh.corners, mesh.normal_corners, mesh.uv_corners = (
            self.corners[:], self.normal_corners[:], self.uv_corners[:])
        mesh.uvs, mesh.material = self.uvs, self.material
        if determinant(t) < 0:
            for corners in (mesh.corners, mesh.normal_corners, mesh.uv_corners):
                corners[1::3], corners[2::3] = corners[2::3], corners[1::3]
        return mesh


def determinant(t):
    a, b, c = (row[:3] for row in t)
    return (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]))


def place(t, x, y, z):
    return [row[0] * x + row[1] * y + row[2] * z + row[3] for row in t]


def place_normal(t, n):
    """By the inverse transpose, up to a positive factor: the cofactors, times the sign of the determinant."""
    a, b, c = (row[:3] for row in t)
    sign = math.copysign(1, determinant(t))
    return normalize([sign * dot(row, n) for row in (cross(b, c), cross(c, a), cross(a, b))])


def placed(scene, folder):
    """Each mesh at each of its places: a Mesh in the units of the scene."""
    for entry in scene["meshes"]:
        original = Mesh(os.path.join(folder, entry["file"]))
        for t in entry["transforms"]:
            yield original if t == [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]] else original.placed(t)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def normalize(v):
    length = math.sqrt(dot(v, v))
    return [x / length for x in v]


def emits(material):
    return "emission" in material


def unknown(scene):
    """What this reader does not know, or no peer has likewise, each as the end of a sentence."""
    keys = {key for m in scene["materials"] for key in m} - MATERIAL_KEYS
    found = [f"'{key}' of materials" for key in sorted(keys)]
    if "spot" in kinds_of_lights(scene):
        found.append("lights of type spot")
    return found


def beyond_plain(scene):
    """What few renderers have, each as the end of a sentence: textures, holes, bumps, pictures of environments."""
    found = []
    if scene["textures"]:
        found.append("textures")
    if any("bumps" in m or "normal_texture" in m for m in scene["materials"]):
        found.append("bumps and maps of normals")
    if any("opacity" in m for m in scene["materials"]):
        found.append("materials that let rays through")
    if any("file" in light for light in scene["lights"]):
        found.append("environments that are pictures")
    return found


def kinds_of_lights(scene):
    return {light["type"] for light in scene["lights"]}


def has_normals(folder, scene):
    """Whether a mesh has vertex normals: they stand before the first triangle."""
    for entry in scene["meshes"]:
        with open(os.path.join(folder, entry["file"]), encoding="ascii") as file:
            for line in file:
                if line.startswith("vn"):
                    return True
                if line.startswith("f"):
                    break
    return False
