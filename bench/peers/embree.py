"""Embree's example path tracer (`pathtracer`), one process for each budget.

Render seconds: of one more frame of the same samples, which its own --benchmark times after the picture; by then the
scene is loaded and the BVH built. CPU seconds: it says nothing of them. Load: the rest of the process' time, with the
first of the two frames taken off.
"""
import os
import re
from array import array

import exr
import scene as scenes
from job import Failed, Run, version_of

NAME, COMMAND, INSTALL = "Embree's path tracer", "pathtracer", "apt-get install embree-tools"
SEEDS, SQUARES, LENSES = False, False, False


def version():
    return version_of(["dpkg-query", "-W", "-f", "${Version}", "embree-tools"], r"([0-9]\S*)")


def problems(scene, folder, job):
    found = scenes.beyond_plain(scene)
    if scene["spheres"] or scene["planes"]:
        found.append("spheres and planes")
    others = {m["type"] for m in scene["materials"]} - {"lambert"}
    if others:
        found.append("materials of type " + ", ".join(sorted(others)))
    if scenes.has_normals(folder, scene):
        found.append("vertex normals, by a rule of its own")
    if "sphere" in scenes.kinds_of_lights(scene):
        found.append("spheres of light")
    if any(map(scenes.emits, scene["materials"])) and not job.throughput_only:
        found.append("meshes that emit; for its speed alone, --throughput-only puts a point light in place of each")
    return found


def stand_ins(scene, meshes):
    """A point light for each emitting material, in the middle of its triangles, of the same power: L A pi / (4 pi)."""
    sums = {}
    for mesh in meshes:
        for t, m in enumerate(mesh.material):
            if not scenes.emits(scene["materials"][m]):
                continue
            a, b, c = (mesh.positions[3 * i : 3 * i + 3] for i in mesh.corners[3 * t : 3 * t + 3])
            u, v = ([q - p for p, q in zip(a, x)] for x in (b, c))
            n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
            area = 0.5 * scenes.dot(n, n) ** 0.5
            entry = sums.setdefault(m, [0.0, [0.0] * 3, [0.0] * 3])
            entry[0] += area
            entry[1] = [s + area * sum(p) / 3 for s, p in zip(entry[1], zip(a, b, c))]
            entry[2] = [s + x / 2 for s, x in zip(entry[2], n)]
    lights = []
    for m, (area, middle, normal) in sums.items():
        step = 1e-3 * area**0.5  # off the surface, which would hide it
        normal = scenes.normalize(normal) if any(normal) else [0, 0, 0]
        position = [x / area + step * n for x, n in zip(middle, normal)]
        sides = 2 if scene["materials"][m]["emission_both_sides"] else 1
        lights.append(("--pointlight", position, [sides * 0.25 * area * x for x in scene["materials"][m]["emission"]]))
    return lights


def write_obj(path, scene, meshes):
    with open(os.path.join(os.path.dirname(path), "all.mtl"), "w", encoding="ascii") as file:
        for i, m in enumerate(scene["materials"]):
            file.write(f"newmtl m{i}\nKd {m['base_color'][0]} {m['base_color'][1]} {m['base_color'][2]}\nKs 0 0 0\nd 1\n")
    with open(path, "w", encoding="ascii") as file:
        file.write("mtllib all.mtl\n")
        start = 1
        for mesh in meshes:
            p, c = mesh.positions, mesh.corners
            file.writelines(f"v {p[i]} {p[i + 1]} {p[i + 2]}\n" for i in range(0, len(p), 3))
            current = None
            for t, m in enumerate(mesh.material):
                if m != current:
                    file.write(f"usemtl m{m}\n")
                    current = m
                file.write(f"f {c[3 * t] + start} {c[3 * t + 1] + start} {c[3 * t + 2] + start}\n")
            start += len(p) // 3


def to_exr(ppm, path):
    """Its 8 bits are radiance times 255, rounded down: the middle of what may have been there stands for it."""
    with open(ppm, "rb") as file:
        head = re.match(rb"P6\s+(\d+)\s+(\d+)\s+255\s", file.read(64))
        width, height = int(head.group(1)), int(head.group(2))
        file.seek(head.end())
        bytes_ = file.read(3 * width * height)
    steps = [0, *((x + 0.5) / 255 for x in range(1, 255)), 1]
    rows = (array("f", [steps[b] for b in bytes_[3 * width * y : 3 * width * (y + 1)]]) for y in range(height))
    exr.write(path, width, height, rows)


def arguments(name, *vectors):
    return [name] + [repr(float(x)) for v in vectors for x in v]


def render(scene, folder, job):
    meshes = list(scenes.placed(scene, folder))
    lights = stand_ins(scene, meshes) if job.throughput_only else []
    biases = ["picture of 8 bits, clamped at 1", "paths end below a throughput of 0.01"]
    if lights:
        biases.append("emitting meshes replaced by point lights: throughput only")
    for light in scene["lights"]:
        if light["type"] == "environment":
            lights.append(("--ambientlight", light["radiance"]))
            biases.append("the environment is counted twice")
        elif light["type"] == "point":
            lights.append(("--pointlight", light["position"], light["intensity"]))
        else:
            lights.append(("--directionallight", light["direction"], light["irradiance"]))
    write_obj(os.path.join(folder, "all.obj"), scene, meshes)
    del meshes
    camera, (width, height) = scene["camera"], job.size
    command = [COMMAND, "-i", "all.obj", "--threads", str(job.threads), "--size", str(width), str(height),
               "--fov", repr(camera["fov_deg"]), "--accumulate", "0", "-o", "picture.ppm"]
    for option, key in (("--vp", "position"), ("--vi", "target"), ("--vu", "up")):
        command += arguments(option, camera[key])
    for light in lights:
        command += arguments(*light)
    command += ["--max-path-length", str(scene["max_depth"] or 1024)]
    if not scene["max_depth"]:
        biases.append("max_path_length=1024")
    own_version = version()
    for spp in job.budgets:
        run = Run(command + ["--spp", str(spp), "--legacy", "--benchmark", "0", "1"], folder)
        rate = re.search(r"BENCHMARK_RENDER_AVG ([0-9.e+-]+)", run.text)
        if not rate or float(rate.group(1)) <= 0:
            raise Failed("pathtracer gave no BENCHMARK_RENDER_AVG:\n" + run.text[-2000:])
        seconds = 1 / float(rate.group(1))
        to_exr(os.path.join(folder, "picture.ppm"), job.path(spp))
        yield job.record("embree", own_version, spp, render_wall_s=round(seconds, 4), render_cpu_s=None,
                         load_s=round(max(0.0, run.wall_s - 2 * seconds), 3), peak_mb=round(run.peak_mb, 1), biases=biases)
