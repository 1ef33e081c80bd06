"""POV-Ray, for scenes as Whitted's integrator sees them; one process for each budget.

Render seconds and CPU seconds: its own "Trace Time" and the CPU seconds that it gives behind it; parsing and its bounding
volumes stand in other lines. Load: the rest of the process' time.
"""
import math
import os
import re
import shutil

import scene as scenes
from job import Failed, Refused, Run, version_of

NAME, COMMAND, INSTALL = "POV-Ray", "povray", "apt-get install povray"
SEEDS, SQUARES, LENSES = False, True, False


def version():
    return version_of([COMMAND, "--version"], r"POV-Ray ([0-9.]*[0-9])")


def problems(scene, folder, job):
    found = scenes.beyond_plain(scene)
    materials = scene["materials"]
    others = {m["type"] for m in materials} - {"lambert", "mirror", "glass"}
    if others:
        found.append("materials of type " + ", ".join(sorted(others)))
    if any(m["type"] == "glass" and (m["thin"] or m["roughness"] > 0) for m in materials):
        found.append("glass that is thin or rough")
    if scene["integrator"] != "whitted":
        found.append(f"what '{scene['integrator']}' renders: it follows no diffuse light; say integrator = \"whitted\"")
    if any(map(scenes.emits, materials)) or scenes.kinds_of_lights(scene) & {"sphere", "environment"}:
        found.append("light of surfaces, spheres and environments without approximations")
    if any(m["type"] == "glass" and (m["base_color"] != [1, 1, 1] or m["ior"] < 1) for m in materials):
        found.append("glass that is tinted or thinner than what is around it")
    return found


def vector(v):
    return "<" + ",".join(repr(float(x)) for x in v) + ">"


def texture(m):
    finish = "ambient 0 emission 0 specular 0 phong 0 "
    if m["type"] == "lambert":
        return f"texture {{ pigment {{ rgb {vector(m['base_color'])} }} finish {{ {finish} diffuse 1 }} }}"
    if m["type"] == "mirror":
        return (f"texture {{ pigment {{ rgb 0 }} finish {{ {finish} diffuse 0 reflection {{ rgb {vector(m['base_color'])} "
                "} } }")
    return (f"texture {{ pigment {{ rgbt <1,1,1,1> }} finish {{ {finish} diffuse 0 conserve_energy "
            "reflection { 0, 1 fresnel on } } }")


def inside(m):
    return f"interior {{ ior {float(m['ior'])!r} }}" if m["type"] == "glass" else ""


def mesh_text(file, mesh, materials):
    """One mesh2 for each material, as an interior belongs to a whole object."""
    for used in sorted(set(mesh.material)):
        triangles = [t for t, m in enumerate(mesh.material) if m == used]
        corner = lambda table, t: "<" + ",".join(map(str, table[3 * t : 3 * t + 3])) + ">"
        p, n = mesh.positions, mesh.normals
        file.write(f"mesh2 {{ vertex_vectors {{ {len(p) // 3}")
        file.writelines("," + vector(p[i : i + 3]) for i in range(0, len(p), 3))
        file.write("}\n")
        if n:
            file.write(f"normal_vectors {{ {len(n) // 3}")
            file.writelines("," + vector(n[i : i + 3]) for i in range(0, len(n), 3))
            file.write("}\n")
        file.write(f"face_indices {{ {len(triangles)}")
        file.writelines("," + corner(mesh.corners, t) for t in triangles)
        file.write("}\n")
        if n:
            file.write(f"normal_indices {{ {len(triangles)}")
            file.writelines("," + corner(mesh.normal_corners, t) for t in triangles)
            file.write("}\n")
        file.write(f"{texture(materials[used])} {inside(materials[used])} }}\n")


def write_pov(path, scene, folder, job, biases):
    camera, materials = scene["camera"], scene["materials"]
    forward = [b - a for a, b in zip(camera["position"], camera["target"])]
    distance = math.sqrt(scenes.dot(forward, forward))
    forward, up = scenes.normalize(forward), camera["up"]
    right = scenes.normalize(scenes.cross(forward, up))
    up = scenes.cross(right, forward)
    ahead = 0.5 / math.tan(math.radians(camera["fov_deg"]) / 2)
    aspect = job.size[0] / job.size[1]
    depth = scene["max_depth"] or 256
    with open(path, "w", encoding="ascii") as file:
        file.write(f"#version 3.7;\nglobal_settings {{ assumed_gamma 1 max_trace_level {depth} adc_bailout 0 }}\n")
        file.write(f"camera {{ location {vector(camera['position'])} direction {vector([ahead * x for x in forward])} "
                   f"up {vector(up)} right {vector([aspect * x for x in right])} }}\n")
        for light in scene["lights"]:
            if light["type"] == "point":
                # It fades by 2 / (1 + (d / fade_distance)^2): far beyond that distance with the square. Its diffuse
                # surfaces have no 1 / pi.
                fade = 1e-4 * distance
                colour = [x / (2 * math.pi * fade * fade) for x in light["intensity"]]
                file.write(f"light_source {{ {vector(light['position'])} rgb {vector(colour)} fade_distance {fade!r} "
                           "fade_power 2 }\n")
            else:
                colour = [x / math.pi for x in light["irradiance"]]
                away = [c - 1e5 * distance * x for c, x in zip(camera["target"], light["direction"])]
                file.write(f"light_source {{ {vector(away)} rgb {vector(colour)} parallel point_at "
                           f"{vector(camera['target'])} }}\n")
        for s in scene["spheres"]:
            m = materials[s["material"]]
            file.write(f"sphere {{ {vector(s['center'])}, {float(s['radius'])!r} {texture(m)} {inside(m)} }}\n")
        for p in scene["planes"]:
            m = materials[p["material"]]
            file.write(f"plane {{ {vector(p['normal'])}, {scenes.dot(p['normal'], p['point'])!r} {texture(m)} {inside(m)} }}\n")
        for mesh in scenes.placed(scene, folder):
            if scenes.NO_NORMAL in mesh.normal_corners:
                raise Refused(f"{NAME} cannot render a mesh of which only some corners have normals")
            mesh_text(file, mesh, materials)
    if any(m["type"] == "glass" for m in materials):
        biases.append("shadow rays lose nothing in glass")
    if depth != scene["max_depth"]:
        biases.append("max_trace_level=256")


def render(scene, folder, job):
    biases = ["picture of 16-bit floats"]
    write_pov(os.path.join(folder, "scene.pov"), scene, folder, job, biases)
    own_version = version()
    for spp in job.budgets:
        side = math.isqrt(spp)
        # Method 1 with threshold 0 takes side x side jittered samples in every pixel; gamma 1 keeps their mean linear.
        samples = ["+AM1", "+A0.0", f"+R{side}", "+J1.0"] if side > 1 else ["-A"]
        run = Run([COMMAND, "+Iscene.pov", "+Opicture.exr", "+FE", f"+W{job.size[0]}", f"+H{job.size[1]}", "-D", "-P",
                   f"+WT{job.threads}", "File_Gamma=1.0", "Antialias_Gamma=1.0", *samples], folder)
        found = re.search(r"Trace Time:.*?\(([0-9.]+) seconds\)(?:\s+using [0-9]+ thread\(s\) with ([0-9.]+) CPU-seconds)?",
                          run.text, re.S)
        if not found:
            raise Failed("povray gave no Trace Time:\n" + run.text[-2000:])
        seconds = float(found.group(1))
        shutil.move(os.path.join(folder, "picture.exr"), job.path(spp))
        yield job.record("povray", own_version, spp, render_wall_s=seconds,
                         render_cpu_s=float(found.group(2)) if found.group(2) else None,
                         load_s=round(max(0.0, run.wall_s - seconds), 3), peak_mb=round(run.peak_mb, 1), biases=biases)
