"""Blender Cycles, on the CPU, in one process for all budgets.

Render seconds: what Cycles itself counts from its first sample on, after synchronisation and the build of its BVH: the
"render_time" that it writes into the header of the picture, in steps of 10 ms. CPU seconds: of the process, over the
whole render call, which with its data kept from a first picture of one sample adds only what little is synchronised
again; writing the picture is not in it. Load: everything before that, the first picture included.

LANCER_CYCLES is the command that starts Blender (blender). It may start it in another root, such as the one that
`chroot` makes: nothing outside of its working folder is read or written. LANCER_CYCLES2 is that of a second Blender, the
peer cycles2.
"""
import json
import os
import re
import shlex
import shutil

import scene as scenes
from job import Failed, Run, version_of

SCRIPTS = ("cycles_in_blender.py", "cycles_materials.py", "scene.py")


def problems(scene, folder, job):
    found = []
    for m in scene["materials"]:
        if m["type"] == "glass" and m["thin"] and "roughness_texture" in m:
            found.append(f"sheets of glass with a texture of roughness ('{m['name']}')")
        if "eta" in m and len(set(m["base_color"])) > 1:
            found.append(f"tinted metal with an index of refraction ('{m['name']}')")
        if "eta" in m and "texture" in m:
            found.append(f"textured metal with an index of refraction ('{m['name']}')")
    return found


def is_rough(m):
    return m.get("roughness", 0) > 0


def differences(scene, folder, blender, trusts_normals):
    """What Cycles means otherwise, each with what it was measured to do: README.md, "Materials"."""
    materials = scene["materials"]
    number = tuple(int(x) for x in re.findall(r"\d+", blender)[:2])
    kinds = {m["type"] for m in materials}
    found = []
    if scenes.has_normals(folder, scene):
        found.append("shading normals bent by Cycles' own rule")
    if not trusts_normals and any("bumps" in m or "normal_texture" in m for m in materials):
        found.append("light on surfaces whose normals a map turns is dimmed towards the shadow terminator")
    if "plastic" in kinds:
        found.append("the base of plastic spreads by Lambert's law what its coat lets through")
    if any(m["type"] == "plastic" and is_rough(m) and max(m["specular"]) - min(m["specular"]) > 1e-6 for m in materials):
        found.append("the hue of rough coats has the Fresnel curve of the surface, not of its facets")
    if number < (4, 0) and any(map(is_rough, materials)):
        found.append("masking and shadowing of facets are independent")
    if number < (4, 0) and any(m["type"] == "glass" and is_rough(m) for m in materials):
        found.append("rough glass reflects by Fresnel's law of the surface, not of its facets")
    if number < (4, 3) and "metal" in kinds:
        found.append("metal has the Fresnel curve of the Principled BSDF")
    if "principled" in kinds:
        found.append("layers of the Principled BSDF are those of Blender's own model")
    if any(m.get("thin") and is_rough(m) for m in materials):
        found.append("rough sheets of glass spread what they let through by another lobe")
    if scene["planes"]:
        found.append("planes end at 10^4 times the reach of the scene")
    if scene["max_depth"] and any(m.get("thin") for m in materials):
        found.append("thin glass is no vertex of a path")
    if any(t["type"] == "image" for t in scene["textures"]):
        found.append("textures are not filtered")
    if scene["max_depth"] == 0 or scene["max_depth"] > 1025:
        found.append("max_bounces=1024")
    return found


class Cycles:
    """One Blender. name: cycles or cycles2."""

    SEEDS, SQUARES, LENSES = True, False, True
    problems = staticmethod(problems)

    def __init__(self, name):
        self.NAME, variable = name, "LANCER_" + name.upper()
        self.call = shlex.split(os.environ.get(variable, "")) or (["blender"] if name == "cycles" else [""])
        self.COMMAND = self.call[0]
        if os.sep in self.COMMAND:  # Blender is started in another folder
            self.call[0] = os.path.abspath(self.COMMAND)
        self.INSTALL = "apt-get install blender" if self.COMMAND else f"set {variable} to the command of another Blender"

    def version(self):
        return version_of([*self.call, "--version"], r"Blender ([0-9.]+)")

    def render(self, scene, folder, job):
        names = {spp: f"picture_{spp}.exr" for spp in job.budgets}
        order = {
            "folder": folder,
            "budgets": [{"spp": spp, "output": os.path.join(folder, names[spp])} for spp in job.budgets],
            "seed": job.seed,
            "threads": job.threads,
            "size": job.size,
            "warm": os.path.join(folder, "warm.exr"),
        }
        path = os.path.join(folder, "order.json")
        with open(path, "w", encoding="utf-8") as file:
            json.dump(order, file)
        for script in SCRIPTS:
            shutil.copy(os.path.join(os.path.dirname(os.path.abspath(__file__)), script), folder)
        # An error in the script must end Blender, which otherwise goes on.
        run = Run([*self.call, "-b", "--factory-startup", "--python-exit-code", "1", "--python",
                   os.path.join(folder, SCRIPTS[0]), "--", path], folder)
        found = [json.loads(line[7:]) for line in run.text.splitlines() if line.startswith("RESULT ")]
        if len(found) != len(job.budgets):
            raise Failed("blender rendered nothing:\n" + "\n".join(run.text.splitlines()[-15:]))
        biases = differences(scene, folder, found[0]["version"], all([f.pop("trusts_normals") for f in found]))
        for figures in found:
            shutil.move(os.path.join(folder, names[figures["spp"]]), job.path(figures["spp"]))
            yield job.record(self.NAME, figures.pop("version"), figures.pop("spp"), **figures, peak_mb=round(run.peak_mb, 1),
                             biases=biases)
