"""Within Blender: imports one mesh into an empty scene and prints the seconds by the clock, CPU seconds and triangles.
See `loaders`."""
import sys
import time

import bpy

try:
    import numpy

    if not hasattr(numpy, "bool"):  # Debian 12's importer of glTF is older than its numpy
        numpy.bool = bool
except ImportError:
    pass  # only that importer needs it

path = sys.argv[sys.argv.index("--") + 1]
bpy.ops.wm.read_factory_settings(use_empty=True)
# Newer importers, in C++, are of the window manager; older ones are scripts.
IMPORTERS = {
    "obj": [(bpy.ops.wm, "obj_import"), (bpy.ops.import_scene, "obj")],
    "ply": [(bpy.ops.wm, "ply_import"), (bpy.ops.import_mesh, "ply")],
    "glb": [(bpy.ops.import_scene, "gltf")],
}
if path.endswith(".glb"):
    bpy.ops.preferences.addon_enable(module="io_scene_gltf2")
by = next(getattr(group, name) for group, name in IMPORTERS[path[-3:]] if name in dir(group))
wall, cpu = time.perf_counter(), time.process_time()
by(filepath=path)
wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
triangles = sum(len(p.vertices) - 2 for m in bpy.data.meshes for p in m.polygons)
print("LOADED %.6f %.6f %d" % (wall, cpu, triangles))
