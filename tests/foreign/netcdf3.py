# SPDX-License-Identifier: GPL-3.0-or-later
"""Classic NetCDF files (CDF-2) in a few lines, so that the tests need neither Calotte nor a package
to make and to read them. Only what meshes need: fixed dimensions, text, int32 and doubles."""
import array
import struct
import sys

CHAR, INT, DOUBLE = 2, 4, 6
CODES = {CHAR: "b", INT: "i", DOUBLE: "d"}
SIZES = {CHAR: 1, INT: 4, DOUBLE: 8}


def padded(data):
    return data + b"\0" * (-len(data) % 4)


def big_endian(code, values):
    data = array.array(code, values)
    if sys.byteorder == "little":
        data.byteswap()
    return data.tobytes()


def name_bytes(name):
    data = name.encode()
    return struct.pack(">i", len(data)) + padded(data)


def attribute_list(attributes):
    if not attributes:
        return struct.pack(">ii", 0, 0)
    out = struct.pack(">ii", 12, len(attributes))
    for name, value in attributes.items():
        out += name_bytes(name)
        if isinstance(value, str):
            data = value.encode()
            out += struct.pack(">ii", CHAR, len(data)) + padded(data)
        elif isinstance(value, int):
            out += struct.pack(">iii", INT, 1, value)
        else:
            out += struct.pack(">iid", DOUBLE, 1, value)
    return out


def write(path, dimensions, variables, attributes=None):
    """dimensions: name -> size. variables: name -> (dimension names, flat values, attributes).
    Integers are int32 if all values are, else doubles."""
    names = list(dimensions)
    head = b"CDF\2" + struct.pack(">i", 0)
    head += struct.pack(">ii", 10 if names else 0, len(names))
    for name in names:
        head += name_bytes(name) + struct.pack(">i", dimensions[name])
    head += attribute_list(attributes)
    head += struct.pack(">ii", 11 if variables else 0, len(variables))
    entries, blobs = [], []
    for name, (dims, values, own) in variables.items():
        values = list(values)
        kind = INT if all(isinstance(v, int) for v in values) else DOUBLE
        entry = name_bytes(name) + struct.pack(">i", len(dims))
        entry += b"".join(struct.pack(">i", names.index(d)) for d in dims)
        entry += attribute_list(own)
        blob = padded(big_endian(CODES[kind], values))
        entries.append(entry + struct.pack(">ii", kind, len(blob)))
        blobs.append(blob)
    begin = len(head) + sum(len(entry) + 8 for entry in entries)
    with open(path, "wb") as out:
        out.write(head)
        for entry, blob in zip(entries, blobs):
            out.write(entry + struct.pack(">q", begin))
            begin += len(blob)
        for blob in blobs:
            out.write(blob)


class File:
    """All of a classic file: dimensions, attributes and variables (name -> (dims, values))."""

    def __init__(self, path):
        with open(path, "rb") as file:
            self.data = file.read()
        assert self.data[:3] == b"CDF" and self.data[3] in (1, 2, 5), path
        self.wide = self.data[3] == 5
        self.place = 4
        self.count()  # records
        self.dimensions = {}
        self.take(">i")
        for _ in range(self.count()):
            name = self.name()
            self.dimensions[name] = self.count()
        self.attributes = self.attribute_list()
        self.variables = {}
        self.take(">i")
        sizes = list(self.dimensions.items())
        for _ in range(self.count()):
            name = self.name()
            dims = [sizes[self.count()] for _ in range(self.count())]
            self.attribute_list()
            kind = self.take(">i")
            self.count()
            begin = self.take(">i") if self.data[3] == 1 else self.take(">q")
            number = 1
            for _, size in dims:
                number *= size
            code = CODES[kind]
            values = array.array(code, self.data[begin:begin + number * SIZES[kind]])
            if sys.byteorder == "little":
                values.byteswap()
            self.variables[name] = ([d for d, _ in dims], values)

    def take(self, form):
        size = struct.calcsize(form)
        value = struct.unpack_from(form, self.data, self.place)[0]
        self.place += size
        return value

    def count(self):
        return self.take(">q" if self.wide else ">i")

    def name(self):
        size = self.count()
        text = self.data[self.place:self.place + size].decode()
        self.place += size + -size % 4
        return text

    def attribute_list(self):
        self.take(">i")
        out = {}
        for _ in range(self.count()):
            name = self.name()
            kind, size = self.take(">i"), self.count()
            raw = self.data[self.place:self.place + size * {1: 1, 2: 1, 3: 2, 4: 4, 5: 4, 6: 8}[kind]]
            self.place += len(raw) + -len(raw) % 4
            if kind == CHAR:
                out[name] = raw.decode()
            elif kind in (INT, DOUBLE):
                values = array.array(CODES[kind], raw)
                if sys.byteorder == "little":
                    values.byteswap()
                out[name] = values[0] if len(values) == 1 else list(values)
        return out

    def values(self, name):
        return self.variables[name][1]
