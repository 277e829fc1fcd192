"""Reads a particle file (FORMAT.md) with NumPy: header, arrays = read("final.mpts")."""
import struct
import sys

import numpy as np

ELEMENTS = ["<u8", "<f4", "<f8", "<u4", "<u8", "u1", "u1"]


def read(path):
    """The header as a dictionary and the arrays by name: blocks as (nz, ny, nx) booleans."""
    data = np.memmap(path, np.uint8, "r")
    magic, version, _, length, _ = struct.unpack_from("<8sIIQQ", data)
    if (magic, version, length) != (b"\x89MPTS\r\n\x1a", 1, data.size):
        raise ValueError(f"{path} is not a whole particle file of version 1")
    place = 32

    def take(form):
        nonlocal place
        values = struct.unpack_from("<" + form, data, place)
        place += struct.calcsize("<" + form)
        return values[0] if len(values) == 1 else values

    def text():
        return take(f"{take('Q')}s").decode()

    def many(*fields):
        return [tuple(field() for field in fields) for _ in range(take("Q"))]

    def number(form):
        return lambda: take(form)

    names = "kind voxel_m normal box_min_m box_max_m time_s step".split()
    header = dict(zip(names, map(take, "I d B 3d 3d d Q".split())))
    header["blocks"] = many(text, *map(number, "I 3Q 3d d Q".split()))
    header["particles"] = take("Q")
    header["attributes"] = dict(many(text, text))
    header["provenance"] = many(text, text, lambda: many(text), lambda: many(text, number("Q")))
    arrays = {}
    for i, (name, element, components, rows, offset, _) in enumerate(many(text, *map(number, "IIQQQ"))):
        values = np.ndarray((rows, components), ELEMENTS[element], data, offset)
        if element == 0:
            nx, ny, nz = header["blocks"][i][2]
            bits = np.unpackbits(values.view(np.uint8), axis=1, count=nx, bitorder="little")
            values = bits.reshape(nz, ny, nx).astype(bool)
        arrays[name] = values
    return header, arrays


if __name__ == "__main__":
    head, columns = read(sys.argv[1])
    print(head)
    for title, values in columns.items():
        print(title, values.dtype, values.shape, float(values.sum(dtype=np.float64)))
