"""lancer as a Python module: scenes and meshes in, numpy arrays out, with the bits of `lancer render`.

    import lancer
    picture = lancer.render("room.toml", spp=64)["color"]        # height x width x 3, float32, linear
    layers = lancer.render("room.toml", layers=("color", "albedo", "depth"), size=(320, 180))

    scene = lancer.Scene.from_text('[[light]]\\ntype = "environment"\\nradiance = 1\\n')
    scene.add_mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    picture = scene.render(spp=16)["color"]

It loads liblancer.so.1 by ctypes: the one that LANCER_LIBRARY names, one beside this file or in the build folder of a
source tree, else the installed one. A render releases Python's lock, so that other Python threads go on.
"""

import ctypes
import os
import pathlib
import threading

import numpy

__all__ = ["Cancelled", "Error", "Scene", "render", "version"]

_API_VERSION = 1
_CANCELLED = 130


class Error(RuntimeError):
    """What went wrong, and `code`: one of the exit codes of the program."""

    def __init__(self, code, text):
        super().__init__(text)
        self.code = code


class Cancelled(Error):
    """progress() returned something true."""


class _Mesh(ctypes.Structure):
    _fields_ = [("name", ctypes.c_char_p), ("material", ctypes.c_char_p),
                ("positions", ctypes.c_void_p), ("vertices", ctypes.c_size_t),
                ("triangles", ctypes.c_void_p), ("triangle_count", ctypes.c_size_t),
                ("normals", ctypes.c_void_p), ("uvs", ctypes.c_void_p)]


class _Layer(ctypes.Structure):
    _fields_ = [("name", ctypes.c_char_p), ("values", ctypes.c_void_p), ("count", ctypes.c_size_t)]


_PROGRESS = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.c_double)


def _load():
    here = pathlib.Path(__file__).resolve().parent
    places = [os.environ.get("LANCER_LIBRARY"), here / "liblancer.so.1", here.parent / "build/release/liblancer.so.1",
              *here.parents[1].glob("liblancer.so.1"), *here.parents[1].glob("*/liblancer.so.1"), "liblancer.so.1"]
    tried = []
    for place in places:
        if not place or (isinstance(place, pathlib.Path) and not place.exists()):
            continue
        try:
            library = ctypes.CDLL(str(place))
        except OSError as error:
            tried.append(str(error))
            continue
        _declare(library)
        if library.lancer_api_version() != _API_VERSION:
            raise ImportError(f"{place} has version {library.lancer_api_version()} of the interface, not {_API_VERSION}")
        return library
    raise ImportError("liblancer.so.1 cannot be loaded; LANCER_LIBRARY may name it. " + "; ".join(tried))


def _declare(library):
    scene, text = ctypes.c_void_p, ctypes.c_char_p
    for name, result, arguments in (
            ("version", text, []), ("api_version", ctypes.c_int, []), ("error", text, []),
            ("scene_open", scene, [text]), ("scene_from_text", scene, [text, text]), ("scene_free", None, [scene]),
            ("scene_define", ctypes.c_int, [scene, text]),
            ("scene_add_mesh", ctypes.c_int, [scene, ctypes.POINTER(_Mesh)]),
            ("scene_size", ctypes.c_int, [scene, ctypes.POINTER(ctypes.c_uint32), ctypes.POINTER(ctypes.c_uint32)]),
            ("scene_warnings", text, [scene]), ("layer_channels", ctypes.c_size_t, [text]),
            ("scene_render", ctypes.c_int,
             [scene, ctypes.POINTER(_Layer), ctypes.c_size_t, ctypes.c_uint, _PROGRESS, ctypes.c_void_p])):
        function = getattr(library, "lancer_" + name)
        function.restype, function.argtypes = result, arguments


_library = _load()


def version():
    """The version of the library."""
    return _library.lancer_version().decode()


def _check(code, text=None):
    """text: of a call of another thread, as each thread has an error of its own."""
    if code:
        text = _library.lancer_error().decode() if text is None else text
        raise Cancelled(code, text or "cancelled") if code == _CANCELLED else Error(code, text)


def _bytes(text):
    return None if text is None else os.fsencode(text)


def _array(values, kind, columns, what):
    array = numpy.ascontiguousarray(values, dtype=kind)
    if array.ndim != 2 or array.shape[1] != columns or len(array) == 0:
        raise ValueError(f"{what} must be an array of n x {columns} numbers, not {array.shape}")
    return array


class Scene:
    """A scene file (.toml) or a mesh (.obj, .ply), as on the command line; it is read when it is first rendered."""

    def __init__(self, file):
        self._handle = _library.lancer_scene_open(_bytes(file))

    @classmethod
    def from_text(cls, toml, folder=None):
        """What a scene file would hold; folder: where the files are that it names."""
        scene = cls.__new__(cls)
        scene._handle = _library.lancer_scene_from_text(toml.encode(), _bytes(folder))
        return scene

    def __del__(self):
        if getattr(self, "_handle", None):
            _library.lancer_scene_free(self._handle)

    def define(self, **values):
        """Puts values over the scene file: define(render__spp=64) is `-D render.spp=64`. Returns the scene."""
        for key, value in values.items():
            _check(_library.lancer_scene_define(self._handle, f"{key.replace('__', '.')}={_toml(value)}".encode()))
        return self

    def add_mesh(self, positions, triangles, normals=None, uvs=None, material=None, name=None):
        """Adds triangles: positions n x 3, triangles m x 3 indices, and of each vertex normals n x 3 and uvs n x 2.
        material: the name of one in the scene or of a preset. Returns the scene."""
        positions = _array(positions, numpy.float64, 3, "positions")
        indices = _array(triangles, numpy.int64, 3, "triangles")
        if indices.min() < 0 or indices.max() >= len(positions):
            raise ValueError("triangles have a vertex that does not exist")
        indices = indices.astype(numpy.uint32)
        arrays = {"normals": (normals, 3), "uvs": (uvs, 2)}
        held = {key: None if values is None else _array(values, numpy.float32, columns, key)
                for key, (values, columns) in arrays.items()}
        for key, array in held.items():
            if array is not None and len(array) != len(positions):
                raise ValueError(f"{key} must be as many as positions")
        mesh = _Mesh(_bytes(name), _bytes(material), positions.ctypes.data, len(positions), indices.ctypes.data,
                     len(indices), *(None if a is None else a.ctypes.data for a in held.values()))
        _check(_library.lancer_scene_add_mesh(self._handle, ctypes.byref(mesh)))
        return self

    @property
    def size(self):
        """Width and height of the picture."""
        width, height = ctypes.c_uint32(), ctypes.c_uint32()
        _check(_library.lancer_scene_size(self._handle, ctypes.byref(width), ctypes.byref(height)))
        return width.value, height.value

    @property
    def warnings(self):
        """What is doubtful in the scene, a line each."""
        return _library.lancer_scene_warnings(self._handle).decode().splitlines()

    def render(self, layers=("color",), threads=0, progress=None, **settings):
        """A dict of float32 arrays, height x width or height x width x channels, rows from the top. settings: keys of
        [render], as spp=64 or size=(320, 180). progress(done): called with the part that is done, by threads of the
        render; that is cancelled if it returns something true or raises something, and by Ctrl-C."""
        self.define(**{f"render__{key}": value for key, value in settings.items()})
        width, height = self.size
        arrays, wanted = {}, (_Layer * len(layers))()
        for place, name in zip(wanted, layers):
            channels = _library.lancer_layer_channels(name.encode())
            if channels == 0:
                hint = ": layers is a tuple of names" if isinstance(layers, str) else ""
                raise ValueError(f"there is no layer {name!r}{hint}; docs/library.md lists them")
            shape = (height, width) if channels == 1 else (height, width, channels)
            arrays[name] = numpy.zeros(shape, numpy.float32)
            place.name, place.values, place.count = name.encode(), arrays[name].ctypes.data, arrays[name].size
        raised, ended = [], []
        is_over = threading.Event()

        def report(_, done):
            try:
                return 1 if is_over.is_set() or (progress and progress(done)) else 0
            except BaseException as error:  # it must not cross the library
                raised.append(error)
                return 1

        def call():
            code = _library.lancer_scene_render(self._handle, wanted, len(layers), threads, _PROGRESS(report), None)
            ended.append((code, _library.lancer_error().decode()))

        # On a thread of its own: Python hears of Ctrl-C in the first one alone, and not inside of a call.
        thread = threading.Thread(target=call)
        thread.start()
        try:
            while thread.is_alive():
                thread.join(0.05)
        except BaseException:
            is_over.set()
            thread.join()
            raise
        if raised:
            raise raised[0]
        _check(*ended[0])
        return arrays


def _toml(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'
    if isinstance(value, (list, tuple, numpy.ndarray)):
        return "[" + ", ".join(_toml(v) for v in value) + "]"
    if isinstance(value, (int, numpy.integer)):
        return str(int(value))
    return repr(float(value))


def render(scene, **options):
    """Renders a file, or a Scene: see Scene.render()."""
    return (scene if isinstance(scene, Scene) else Scene(scene)).render(**options)
