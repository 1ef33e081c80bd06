"""Blender Cycles, on the CPU, in one process for all budgets.

Render seconds: what Cycles itself counts from its first sample on, after synchronisation and the build of its BVH: the
"render_time" that it writes into the header of the picture, in steps of 10 ms. CPU seconds: of the process, over the
whole render call, which with its data kept from a first picture of one sample adds only what little is synchronised
again; writing the picture is not in it. Load: everything before that, the first picture included.
"""
import json
import os

import scene as scenes
from job import Failed, Run, version_of

NAME, COMMAND, PACKAGE = "cycles", "blender", "blender"
SEEDS, SQUARES = True, False


def version():
    return version_of([COMMAND, "--version"], r"Blender ([0-9.]+)")


def problems(scene, folder, job):
    found = []
    if scene["spheres"]:
        found.append("spheres that are not meshes")
    if scene["planes"]:
        found.append("infinite planes")
    if "sphere" in scenes.kinds_of_lights(scene):
        found.append("spheres of light")
    return found


def render(scene, folder, job):
    order = {
        "folder": folder,
        "budgets": [{"spp": spp, "output": os.path.abspath(job.path(spp))} for spp in job.budgets],
        "seed": job.seed,
        "threads": job.threads,
        "size": job.size,
        "warm": os.path.join(folder, "warm.exr"),
    }
    path = os.path.join(folder, "order.json")
    with open(path, "w", encoding="utf-8") as file:
        json.dump(order, file)
    script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "cycles_in_blender.py")
    # An error in the script must end Blender, which otherwise goes on.
    run = Run([COMMAND, "-b", "--factory-startup", "--python-exit-code", "1", "--python", script, "--", path], folder)
    found = [json.loads(line[7:]) for line in run.text.splitlines() if line.startswith("RESULT ")]
    if len(found) != len(job.budgets):
        raise Failed("blender rendered nothing:\n" + "\n".join(run.text.splitlines()[-15:]))
    biases = []
    if scenes.has_normals(folder, scene):
        biases.append("shading normals bent by Cycles' own rule")
    if scene["max_depth"] == 0 or scene["max_depth"] > 1025:
        biases.append("max_bounces=1024")
    for figures in found:
        yield job.record("cycles", figures.pop("version"), figures.pop("spp"), **figures, peak_mb=round(run.peak_mb, 1),
                         biases=biases)
