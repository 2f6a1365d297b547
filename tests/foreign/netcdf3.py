# SPDX-License-Identifier: GPL-3.0-or-later
"""Classic NetCDF files in a few lines, so that the tests need neither Calotte nor a package to make and
to read them. Only what meshes need: text, int32 and doubles; records are written, not read."""
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


class Header:
    """Counts take 8 bytes in CDF-5, and positions 4 in CDF-1."""

    def __init__(self, version):
        self.count_code, self.begin_code = (">q" if version == 5 else ">i"), (">i" if version == 1 else ">q")

    def count(self, number):
        return struct.pack(self.count_code, number)

    def begin(self, position):
        return struct.pack(self.begin_code, position)

    def name(self, name):
        data = name.encode()
        return self.count(len(data)) + padded(data)

    def list_of(self, tag, entries):
        return struct.pack(">i", tag if entries else 0) + self.count(len(entries)) + b"".join(entries)

    def attributes(self, attributes):
        entries = []
        for name, value in (attributes or {}).items():
            if isinstance(value, str):
                data = value.encode()
                entries.append((CHAR, len(data), padded(data)))
            elif isinstance(value, int):
                entries.append((INT, 1, struct.pack(">i", value)))
            else:
                entries.append((DOUBLE, 1, struct.pack(">d", value)))
            kind, size, data = entries[-1]
            entries[-1] = self.name(name) + struct.pack(">i", kind) + self.count(size) + data
        return self.list_of(12, entries)


def write(path, dimensions, variables, attributes=None, version=2, records=0):
    """dimensions: name -> size, None for that of the records. variables: name -> (dimension names, flat
    values, attributes). Integers are int32 if all values are, else doubles."""
    head, names = Header(version), list(dimensions)
    start = b"CDF" + bytes([version]) + head.count(records)
    start += head.list_of(10, [head.name(name) + head.count(dimensions[name] or 0) for name in names])
    start += head.attributes(attributes)
    entries, fixed, of_records = [], [], []
    for name, (dims, values, own) in variables.items():
        values = list(values)
        kind = INT if all(isinstance(v, int) for v in values) else DOUBLE
        size = SIZES[kind]
        for d in dims:
            size *= dimensions[d] or 1
        entry = head.name(name) + head.count(len(dims)) + b"".join(head.count(names.index(d)) for d in dims)
        entries.append(entry + head.attributes(own) + struct.pack(">i", kind) + head.count(size))
        data = big_endian(CODES[kind], values)
        (of_records if dims and dimensions[dims[0]] is None else fixed).append((len(entries) - 1, data, size))
    position = len(start) + 4 + len(head.count(0)) + sum(len(entry) + len(head.begin(0)) for entry in entries)
    begins = {}
    for k, data, _ in fixed:
        begins[k] = position
        position += len(padded(data))
    for k, _, size in of_records:
        begins[k] = position
        position += size
    start += head.list_of(11, [entry + head.begin(begins[k]) for k, entry in enumerate(entries)])
    with open(path, "wb") as out:
        out.write(start)
        for _, data, _ in fixed:
            out.write(padded(data))
        for record in range(records):
            for _, data, size in of_records:
                out.write(data[record * size:(record + 1) * size])


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
