"""Runs inside of Blender: the nodes of the exported materials. Each follows the formulas of src/materials; what differs is
named by cycles.py."""
import math
import os

import bpy

# The Metallic BSDF came with 4.3. With 4.0 smooth surfaces lost their name, and the Principled BSDF changed its inputs.
HAS_METALLIC, IS_4 = bpy.app.version >= (4, 3, 0), bpy.app.version >= (4, 0, 0)
COSINES, ROUGHNESSES = 256, 65  # of the pictures of coats and sheets


class Nodes:
    """The nodes of one tree. A value is a number, a colour as a tuple, or an output of another node."""

    def __init__(self, tree, folder, textures):
        self.tree, self.folder, self.textures, self.made = tree, folder, textures, {}

    def put(self, socket, value):
        if isinstance(value, bpy.types.NodeSocket):
            self.tree.links.new(value, socket)
        elif socket.type == "RGBA":
            socket.default_value = (*(value if isinstance(value, tuple) else (value,) * 3), 1)
        elif socket.type == "VECTOR":
            socket.default_value = value if isinstance(value, tuple) else (value,) * 3
        else:
            socket.default_value = value

    def add(self, kind, inputs=(), **properties):
        """inputs: by name, or by number where names are the same; None: left as it is."""
        node = self.tree.nodes.new("ShaderNode" + kind)
        for name, value in properties.items():
            setattr(node, name, value)
        for name, value in dict(inputs).items():
            if value is not None:
                self.put(node.inputs[name], value)
        return node

    def math(self, operation, *values):
        return self.add("Math", enumerate(values), operation=operation).outputs[0]

    def vector(self, operation, *values):
        node = self.add("VectorMath", enumerate(values), operation=operation)
        return node.outputs["Value" if operation == "DOT_PRODUCT" else "Vector"]

    def once(self, kind, output):
        if kind not in self.made:
            self.made[kind] = self.add(kind)
        return self.made[kind].outputs[output]

    def mixed(self, part, first, second):
        """Of shaders: `part` of the second. None is black."""
        return self.add("MixShader", {0: part, 1: first, 2: second}).outputs[0]

    def sum(self, first, second):
        return self.add("AddShader", {0: first, 1: second}).outputs[0]

    # Textures

    def picture(self, file, vector, wrap):
        image = bpy.data.images.load(os.path.join(self.folder, file), check_existing=True)
        image.colorspace_settings.name = "Non-Color"
        image.alpha_mode = "NONE"
        return self.add("TexImage", {"Vector": vector}, image=image, interpolation="Linear",
                        extension="REPEAT" if wrap == "repeat" else "EXTEND").outputs["Color"]

    def uv(self, texture):
        place = self.once("TexCoord", "UV")
        if texture["scale"] == [1, 1] and texture["offset"] == [0, 0]:
            return place
        return self.add("Mapping", {"Vector": place, "Scale": (*texture["scale"], 1),
                                    "Location": (*texture["offset"], 0)}, vector_type="POINT").outputs[0]

    def look_up(self, texture):
        """A colour."""
        place = self.uv(texture)
        if texture["type"] == "image":
            return self.picture(texture["file"], place, texture["wrap"])
        axes = self.add("SeparateXYZ", {0: place}).outputs
        u, v = axes["X"], axes["Y"]
        below = lambda x: self.math("LESS_THAN", x, texture["width"])
        if texture["type"] == "checker":
            # Half of the sum of two whole numbers is whole or not.
            cells = self.math("ADD", self.math("FLOOR", u), self.math("FLOOR", v))
            odd = self.math("GREATER_THAN", self.math("FRACT", self.math("MULTIPLY", cells, 0.5)), 0.25)
            return self.blend(odd, texture["even"], texture["odd"])
        if texture["type"] == "grid":
            inside = self.math("MAXIMUM", below(self.math("FRACT", u)), below(self.math("FRACT", v)))
            return self.blend(inside, texture["ground"], texture["band"])
        sides = u, self.math("SUBTRACT", 1.0, v), self.math("SUBTRACT", v, u)
        least = self.math("MINIMUM", self.math("MINIMUM", sides[0], sides[1]), sides[2])
        return self.blend(below(least), (0, 0, 0), (1, 1, 1))

    def blend(self, part, first, second):
        step = tuple(b - a for a, b in zip(first, second))
        return self.vector("ADD", tuple(first), self.vector("MULTIPLY", step, part))

    def color(self, m, key, map_key):
        value = tuple(m[key])
        if map_key not in m:
            return value
        found = self.look_up(self.textures[m[map_key]])
        return found if value == (1, 1, 1) else self.vector("MULTIPLY", found, value)

    def number(self, m, key, map_key):
        if map_key not in m:
            return m[key]
        found = self.add("SeparateXYZ", {0: self.look_up(self.textures[m[map_key]])}).outputs["X"]
        return found if m[key] == 1 else self.math("MULTIPLY", found, m[key])

    # What depends on the direction

    def cosine(self, normal):
        n = normal or self.once("NewGeometry", "Normal")
        return self.math("ABSOLUTE", self.vector("DOT_PRODUCT", self.once("NewGeometry", "Incoming"), n))

    def by_cosine(self, file, normal, roughness=None, row=0.5):
        """Of a table whose columns are cosines of the direction of view, and whose rows are roughnesses. Without one the
        row at this height."""
        between = lambda x, count: self.math("MULTIPLY_ADD", x, 1 - 1 / count, 0.5 / count)
        up = row if roughness is None else between(roughness, ROUGHNESSES)
        place = self.add("CombineXYZ", {"X": between(self.cosine(normal), COSINES), "Y": up}).outputs[0]
        return self.picture(file, place, "clamp")

    def index(self, ior):
        """So that nodes which look from the back into the body find the same surface from both sides."""
        back = self.once("NewGeometry", "Backfacing")
        return self.math("MULTIPLY_ADD", back, 1 / ior - ior, ior)

    def fresnel(self, ior, normal):
        return self.add("Fresnel", {"IOR": self.index(ior), "Normal": normal}).outputs[0]


def lambert(nodes, m, normal):
    return nodes.add("BsdfDiffuse", {"Color": nodes.color(m, "base_color", "texture"), "Normal": normal}).outputs[0]


def translucent(nodes, m, normal):
    """Two diffuse lobes. Where together they exceed 1 in some channel, both are divided by the largest sum."""
    reflected = nodes.color(m, "base_color", "texture")
    through = nodes.color(m, "transmittance", "transmittance_texture")
    if max(r + t for r, t in zip(m["base_color"], m["transmittance"])) > 1:
        axes = nodes.add("SeparateXYZ", {0: nodes.vector("ADD", reflected, through)}).outputs
        most = nodes.math("MAXIMUM", nodes.math("MAXIMUM", axes["X"], axes["Y"]), axes["Z"])
        most = nodes.math("MAXIMUM", most, 1.0)
        reflected, through = (nodes.vector("DIVIDE", color, most) for color in (reflected, through))
    return nodes.sum(nodes.add("BsdfDiffuse", {"Color": reflected, "Normal": normal}).outputs[0],
                     nodes.add("BsdfTranslucent", {"Color": through, "Normal": normal}).outputs[0])


def glossy(nodes, color, roughness, normal, distribution="GGX"):
    is_smooth = roughness == 0 and not IS_4
    return nodes.add("BsdfGlossy", {"Color": color, "Roughness": roughness, "Normal": normal},
                     distribution="SHARP" if is_smooth else distribution).outputs[0]


def mirror(nodes, m, normal):
    return glossy(nodes, nodes.color(m, "base_color", "texture"), 0, normal)


def metal(nodes, m, normal):
    roughness = nodes.number(m, "roughness", "roughness_texture")
    color = nodes.color(m, "base_color", "texture")
    if not HAS_METALLIC:
        f0 = nodes.vector("MULTIPLY", color, tuple(normal_reflectance(m))) if "eta" in m else color
        return nodes.add("BsdfPrincipled", {"Base Color": f0, "Metallic": 1, "Roughness": roughness, "Normal": normal},
                         distribution="MULTI_GGX").outputs[0]
    inputs = {"Roughness": roughness, "Normal": normal}
    if "eta" not in m:
        # An edge of reflectance 1 makes Schlick's curve of it.
        return nodes.add("BsdfMetallic", {"Base Color": color, "Edge Tint": (1, 1, 1), **inputs},
                         distribution="MULTI_GGX", fresnel_type="F82").outputs[0]
    made = nodes.add("BsdfMetallic", {"IOR": tuple(m["eta"]), "Extinction": tuple(m["k"]), **inputs},
                     distribution="MULTI_GGX", fresnel_type="PHYSICAL_CONDUCTOR").outputs[0]
    return made if m["base_color"] == [1, 1, 1] else nodes.mixed(m["base_color"][0], None, made)


def normal_reflectance(m):
    return [((n - 1) ** 2 + k * k) / ((n + 1) ** 2 + k * k) for n, k in zip(m["eta"], m["k"])]


def glass(nodes, m, normal):
    if m["thin"]:
        return sheet(nodes, m, normal)
    roughness = nodes.number(m, "roughness", "roughness_texture")
    is_smooth = roughness == 0 and not IS_4
    return nodes.add("BsdfGlass", {"Color": nodes.color(m, "base_color", "texture"), "Roughness": roughness,
                                   "IOR": m["ior"], "Normal": normal},
                     distribution="SHARP" if is_smooth else "MULTI_GGX").outputs[0]


def forward(nodes, m, color, normal):
    """What a sheet lets through, in a lobe around the direction that goes straight on if it is rough. Cycles has none: a
    narrow one is that of a boundary of an index near 1, a wide one that of a diffuse sheet."""
    if "sheet" not in m:
        return nodes.add("BsdfTransparent", {"Color": color}).outputs[0]
    color = nodes.vector("MULTIPLY", color, nodes.by_cosine(m["sheet"], normal, row=0.75))
    alpha = m["roughness"] ** 2 * min(1, 0.83 * abs(m["ior"] - 1))  # of a mirrored lobe: spread_of_sheet()
    if alpha > 0.15:
        return nodes.add("BsdfTranslucent", {"Color": color, "Normal": normal}).outputs[0]
    facets = 0.3  # their alpha; a slope m turns light by 2 m in a mirror, by (index - 1) m here
    return nodes.add("BsdfRefraction", {"Color": color, "Roughness": math.sqrt(facets), "Normal": normal,
                                        "IOR": nodes.index(1 + 2 * alpha / facets)}, distribution="GGX").outputs[0]


def sheet(nodes, m, normal):
    """Both faces of a pane, with all reflections between them: thin_sheet.h."""
    r = nodes.fresnel(m["ior"], normal)
    tint = nodes.color(m, "base_color", "texture")
    roughness = m["roughness"]
    if tint == (1, 1, 1) and roughness == 0:
        reflected = nodes.math("DIVIDE", nodes.math("MULTIPLY", r, 2.0), nodes.math("ADD", r, 1.0))
        return nodes.mixed(reflected, nodes.add("BsdfTransparent").outputs[0], glossy(nodes, (1, 1, 1), 0, normal))
    through = nodes.math("SUBTRACT", 1.0, r)
    once = nodes.vector("MULTIPLY", tint, through)  # through one face
    again = nodes.vector("MULTIPLY", tint, r)       # from one face to the other
    rest = nodes.vector("SUBTRACT", (1, 1, 1), nodes.vector("MULTIPLY", again, again))
    transmitted = nodes.vector("DIVIDE", nodes.vector("MULTIPLY", once, once), rest)
    reflected = nodes.vector("MULTIPLY", again, nodes.vector("ADD", (1, 1, 1), transmitted))
    if "sheet" in m:
        reflected = nodes.vector("MULTIPLY", reflected, nodes.by_cosine(m["sheet"], normal, row=0.25))
    return nodes.sum(forward(nodes, m, transmitted, normal), glossy(nodes, reflected, roughness, normal, "MULTI_GGX"))


def plastic(nodes, m, normal):
    """A base that gets what its coat lets through, below the coat."""
    roughness = nodes.number(m, "roughness", "roughness_texture")
    through = nodes.by_cosine(m["coat"], normal, roughness if "roughness_texture" in m else None)
    base = nodes.add("BsdfDiffuse", {"Color": nodes.vector("MULTIPLY", nodes.color(m, "base_color", "texture"), through),
                                     "Normal": normal}).outputs[0]
    # What all channels of the tint have in common is reflected as by the boundary itself.
    tint, common = m["specular"], min(m["specular"])
    if common > 1 - 1e-6:
        return nodes.sum(base, dielectric(nodes, m["ior"], roughness, normal))
    if common > 0:
        base = nodes.sum(base, nodes.mixed(common, None, dielectric(nodes, m["ior"], roughness, normal)))
    if not has_hue(tint):
        return base
    stopped = nodes.vector("SUBTRACT", (1, 1, 1), through)
    color = nodes.vector("MULTIPLY", tuple(x - common for x in tint), stopped)
    return nodes.sum(base, glossy(nodes, color, roughness, normal))


def has_hue(color):
    return max(color) - min(color) > 1e-6


def dielectric(nodes, ior, roughness, normal):
    """The reflection of a boundary alone: of the Principled BSDF all but the coat is black."""
    f0 = ((ior - 1) / (ior + 1)) ** 2
    inputs = {"Base Color": (0, 0, 0), "Metallic": 0, "Roughness": roughness, "Normal": normal}
    inputs.update({"IOR": ior, "Specular IOR Level": 0.5} if IS_4 else {"Specular": f0 / 0.08})
    return nodes.add("BsdfPrincipled", inputs, distribution="GGX").outputs[0]


def principled(nodes, m, normal):
    """The Principled BSDF. That of Blender 3 is an older model: its sheen lies on top without taking light away, its clear
    coat is a lobe of a quarter of the strength, and it has no film."""
    ior, n = m["ior"], "" if not IS_4 else " Weight"
    roughness = nodes.number(m, "roughness", "roughness_texture")
    if m["anisotropy"] > 0 and "roughness_texture" not in m:  # whose alphas are the squared roughness times and over a root
        aspect = 1 - m["anisotropy"]
        roughness = m["roughness"] / (0.5 * (aspect + 1 / max(aspect, 0.1))) ** 0.25
    inputs = {"Base Color": nodes.color(m, "base_color", "texture"), "Normal": normal, "IOR": ior,
              "Metallic": nodes.number(m, "metallic", "metallic_texture"),
              "Roughness": roughness,
              "Anisotropic": min(1, m["anisotropy"] / 0.9), "Anisotropic Rotation": m["anisotropy_rotation"],
              "Transmission" + n: m["transmission"],
              ("Coat" if IS_4 else "Clearcoat") + n: m["coat"] if IS_4 else min(1, 4 * m["coat"]),
              ("Coat" if IS_4 else "Clearcoat") + " Roughness": m["coat_roughness"], "Sheen" + n: m["fuzz"]}
    if IS_4:
        inputs.update({"Specular IOR Level": 0.5 * m["specular_weight"], "Coat IOR": m["coat_ior"],
                       "Coat Tint": tuple(m["coat_color"]), "Sheen Tint": tuple(m["fuzz_color"]),
                       "Sheen Roughness": m["fuzz_roughness"]})
    else:
        inputs["Specular"] = m["specular_weight"] * ((ior - 1) / (ior + 1)) ** 2 / 0.08
        inputs["Sheen Tint"] = 0
    return nodes.add("BsdfPrincipled", inputs, distribution="MULTI_GGX").outputs[0]


def mix(nodes, m, normal, materials):
    parts = (surface(nodes, materials[m[key]], normal, materials) for key in ("first", "second"))
    return nodes.mixed(nodes.number(m, "weight", "weight_texture"), *parts)


KINDS = {"lambert": lambert, "translucent": translucent, "mirror": mirror, "metal": metal, "glass": glass,
         "plastic": plastic, "principled": principled}


def surface(nodes, m, normal, materials):
    if m["type"] == "mix":
        return mix(nodes, m, normal, materials)
    return KINDS[m["type"]](nodes, m, normal)


def normal_of(nodes, m):
    """None where nothing tilts it."""
    if "bumps" in m:
        color = nodes.look_up(m["bumps"])
    elif "normal_texture" in m:
        color = nodes.look_up(nodes.textures[m["normal_texture"]])
    else:
        return None
    return nodes.add("NormalMap", {"Color": color}, space="TANGENT").outputs[0]


def emission(nodes, m):
    top = max(m["emission"])
    scaled = {"emission": [x / top for x in m["emission"]], **{k: v for k, v in m.items() if k == "emission_texture"}}
    strength = top
    if not m["emission_both_sides"]:
        strength = nodes.math("MULTIPLY_ADD", nodes.once("NewGeometry", "Backfacing"), -top, top)
    return nodes.add("Emission", {"Color": nodes.color(scaled, "emission", "emission_texture"),
                                  "Strength": strength}).outputs[0]


def is_black(m):
    return m["type"] == "lambert" and not any(m["base_color"])


def can_trust_normals():
    """Whether Cycles can leave alone what tilted normals reflect."""
    return "use_bump_map_correction" in bpy.data.materials.new("probe").cycles.bl_rna.properties


def make(m, exported, folder):
    """The Blender material of an exported one."""
    made = bpy.data.materials.new(m["name"])
    if can_trust_normals():
        made.cycles.use_bump_map_correction = False
    made.use_nodes = True
    tree = made.node_tree
    tree.nodes.clear()
    nodes = Nodes(tree, folder, exported["textures"])
    result = None
    if not is_black(m):
        result = surface(nodes, m, normal_of(nodes, m), exported["materials"])
    if "emission" in m:
        light = emission(nodes, m)
        result = nodes.sum(result, light) if result else light
        if hasattr(made.cycles, "emission_sampling"):
            made.cycles.emission_sampling = "FRONT_BACK" if m["emission_both_sides"] else "FRONT"
    if "opacity" in m:
        part = nodes.number(m, "opacity", "opacity_texture")
        result = nodes.mixed(part, nodes.add("BsdfTransparent").outputs[0], result)
    output = nodes.add("OutputMaterial")
    if result:
        tree.links.new(result, output.inputs["Surface"])
    return made
