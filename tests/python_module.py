"""The Python module by itself: shapes, meshes in memory, exceptions, threads. That the library has the bits of the
program is tested by tests/app/api_test.cpp."""

import os
import pathlib
import signal
import sys
import tempfile
import threading
import time

try:
    import numpy
except ImportError:
    print("numpy is not installed")
    sys.exit(77)
import lancer

ROOM = """[camera]
position = [0.4, 0.5, 4]
target = [0.3, 0.3, 0]
[render]
spp = 20
size = [24, 16]
[[light]]
type = "environment"
radiance = [0.5, 0.6, 0.9]
[material.red]
type = "plastic"
base_color = [0.8, 0.1, 0.1]
"""
MESH = '[[mesh]]\nfile = "t.obj"\nmaterial = "red"\n'


def raises(kind, text, call):
    try:
        call()
    except kind as error:
        assert text in str(error), error
        return
    raise AssertionError(f"no {kind.__name__} with {text!r}")


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "t.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        (folder / "both.toml").write_text(ROOM + MESH)
        from_file = lancer.render(folder / "both.toml")["color"]
        assert from_file.shape == (16, 24, 3) and from_file.dtype == numpy.float32
        assert from_file.std() > 0.01

        scene = lancer.Scene.from_text(ROOM)
        scene.add_mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], material="red")
        assert (scene.render()["color"] == from_file).all()
        assert scene.size == (24, 16)
        layers = scene.render(layers=("color", "depth", "albedo"), spp=4, size=(12, 8), seed=3)
        assert layers["depth"].shape == (8, 12) and layers["albedo"].shape == (8, 12, 3)

        told = []
        lancer.render(folder / "both.toml", progress=told.append)
        assert told and told == sorted(told) and told[-1] > 0.9
        raises(lancer.Cancelled, "", lambda: lancer.render(folder / "both.toml", progress=lambda done: True))

        # Ctrl-C, long before the end.
        threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        begin = time.monotonic()
        raises(KeyboardInterrupt, "", lambda: lancer.render(folder / "both.toml", spp=10**6, size=(640, 480)))
        assert time.monotonic() - begin < 60

        def fails(done):
            raise KeyboardInterrupt("by hand")

        raises(KeyboardInterrupt, "by hand", lambda: lancer.render(folder / "both.toml", progress=fails))
        raises(lancer.Error, "none.toml", lambda: lancer.render(folder / "none.toml"))
        raises(lancer.Error, "unknown key 'sp'", lambda: lancer.render(folder / "both.toml", sp=3))
        raises(ValueError, "no layer 'colour'", lambda: lancer.render(folder / "both.toml", layers=("colour",)))
        raises(ValueError, "n x 3", lambda: scene.add_mesh([[0, 0]], [[0, 1, 2]]))
        raises(ValueError, "does not exist", lambda: scene.add_mesh([[0, 0, 0]], [[0, 1, 2]]))

        # Scenes do not know each other: several threads may render several.
        pictures = [None] * 3

        def draw(i):
            pictures[i] = lancer.render(folder / "both.toml", threads=1)["color"]

        threads = [threading.Thread(target=draw, args=(i,)) for i in range(3)]
        for t in threads:
            t.start()
        for t in threads:
            t.join()
        assert all((p == from_file).all() for p in pictures)
    assert lancer.version().count(".") == 2


main()
