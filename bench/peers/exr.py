"""A picture of floats as an OpenEXR file without compression, by the published layout: https://openexr.com, "OpenEXR File
Layout". Standard library alone."""
import struct
import sys
from array import array


def write(path, width, height, rows):
    """rows: height arrays ('f') of width times R G B, from the top."""
    box = struct.pack("<4i", 0, 0, width - 1, height - 1)
    channels = b"".join(name + b"\0" + struct.pack("<i4x2i", 2, 1, 1) for name in (b"B", b"G", b"R")) + b"\0"
    header = struct.pack("<ii", 20000630, 2)
    for name, kind, value in (
        (b"channels", b"chlist", channels), (b"compression", b"compression", b"\0"), (b"dataWindow", b"box2i", box),
        (b"displayWindow", b"box2i", box), (b"lineOrder", b"lineOrder", b"\0"),
        (b"pixelAspectRatio", b"float", struct.pack("<f", 1)), (b"screenWindowCenter", b"v2f", struct.pack("<2f", 0, 0)),
        (b"screenWindowWidth", b"float", struct.pack("<f", 1))):
        header += name + b"\0" + kind + b"\0" + struct.pack("<i", len(value)) + value
    header += b"\0"
    line = 8 + 12 * width
    first = len(header) + 8 * height
    with open(path, "wb") as file:
        file.write(header)
        file.write(struct.pack(f"<{height}Q", *(first + y * line for y in range(height))))
        for y, row in enumerate(rows):
            planes = array("f", row[2::3] + row[1::3] + row[0::3])
            if sys.byteorder == "big":
                planes.byteswap()
            file.write(struct.pack("<ii", y, 12 * width) + planes.tobytes())
