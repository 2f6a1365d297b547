#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Small files that promise large contents, long lines and deep nesting, for every reader.

    hostile_test.py CALOTTE [WORD]

Each is refused with exit code 2 and one line, with at most 64 MiB of memory beyond the file's and what the program
takes without a file. Prints memory and processor time of each; the time is bounded loosely, for slow machines. WORD
selects the cases whose name holds it. HDF5 files are made with ncgen; without it they are skipped."""
import base64
import concurrent.futures
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import threading
import zlib

CALOTTE = os.path.abspath(sys.argv[1])
ONLY = sys.argv[2] if len(sys.argv) > 2 else ""
MEMORY, SECONDS, KILLED_AFTER = 64, 10, 300  # MiB; of the processor; of the clock
HUGE, DEEP, MANY = 1 << 40, 10**5, 10**6
LINE = 1 << 30
POINTS = "0 0 1\n1 0 0\n0 1 0\n"
INFO = ["info", "@"]
START = ["cvt", "--cells", "100", "-o", "x.vtp"]
REGION, DOMAIN, CONFIG = [*START, "--region", "@"], [*START, "--domain", "@"], ["cvt", "--config", "@"]
RESUME, WIDTHS, DELAUNAY = ["cvt", "-o", "x.vtp", "--resume", "@"], ["plan", "--cell-width", "@"], \
    ["delaunay", "@", "-o", "x.vtp"]
PLY = "property double x\nproperty double y\nproperty double z\n"
LIST = "property list uchar int vertex_indices\n"


def text_cases():
    yield "points.off", INFO, f"OFF\n{HUGE} 4 0\n{POINTS}"
    yield "faces.off", INFO, f"OFF\n3 {HUGE} 0\n{POINTS}3 0 1 2\n"
    yield "corners.off", INFO, f"OFF\n3 1 0\n{POINTS}{HUGE} 0 1 2\n"
    columns = " ".join(["1"] * MANY) + "\n"
    yield "columns.off", INFO, f"OFF\n3 1 0\n{POINTS}3 {columns}"
    yield "columns.txt", DELAUNAY, columns
    yield "columns.pts", REGION, "name\npoint\n" + columns
    for form in ("ascii", "binary_little_endian"):
        head = f"ply\nformat {form} 1.0\n"
        yield f"points-{form}.ply", INFO, f"{head}element vertex {HUGE}\n{PLY}element face 2\n{LIST}end_header\n"
        yield f"some-{form}.ply", INFO, f"{head}element vertex 1000000000\n{PLY}element face 2\n{LIST}end_header\n"
        yield f"faces-{form}.ply", INFO, f"{head}element vertex 0\n{PLY}element face {HUGE}\n{LIST}end_header\n"
        many = "".join(f"property double a{k}\n" for k in range(MANY))
        yield f"columns-{form}.ply", INFO, f"{head}element vertex 3\n{many}element face 2\n{LIST}end_header\n"
    yield "list.ply", INFO, ("ply\nformat binary_little_endian 1.0\nelement vertex 0\n" + PLY + "element face 1\n"
                             "property list uint int vertex_indices\nend_header\n").encode() + b"\xff" * 4
    for form in ("ASCII", "BINARY"):
        head = f"# vtk DataFile Version 3.0\nt\n{form}\nDATASET POLYDATA\nPOINTS "
        yield f"points-{form}.vtk", INFO, f"{head}{HUGE} double\n{POINTS}"
        yield f"some-{form}.vtk", INFO, f"{head}2000000000 double\n{POINTS}"
        yield f"cells-{form}.vtk", INFO, f"{head}0 double\nPOLYGONS {HUGE} {4 * HUGE}\n3 0 1 2\n"
        yield f"data-{form}.vtk", INFO, f"{head}0 double\nPOINT_DATA {HUGE}\nSCALARS a double {MANY}\n"
    yield "points.msh", INFO, f"MSHID=3;EUCLIDEAN-MESH\nNDIMS=3\nPOINT={HUGE}\n0;0;1;0\n"
    yield "dimensions.msh", INFO, f"MSHID=3;EUCLIDEAN-MESH\nNDIMS={HUGE}\nPOINT=3\n0;0;1;0\n"
    yield "grid.msh", WIDTHS, f"MSHID=3;ELLIPSOID-GRID\nRADII=1;1;1\nNDIMS=2\nCOORD=1;{HUGE}\n0\n"
    collection = '{"type":"FeatureCollection","features":['
    yield "open.geojson", INFO, "[" * DEEP
    yield "names.geojson", INFO, '{"a":' * DEEP
    yield "features.geojson", INFO, collection + "[" * DEEP + "]" * DEEP + "]}"
    rings = '"geometry":{"type":"Polygon","coordinates":' + "[" * DEEP + "]" * DEEP + "}"
    yield "rings.geojson", INFO, collection + '{"type":"Feature",' + rings + "}]}"
    for name, command in (("region", REGION), ("widths", WIDTHS), ("domain", DOMAIN)):
        yield f"{name}.geojson", command, "{" + rings + "}"
        yield f"{name}-open.geojson", command, "[" * MANY
    yield "collections.geojson", REGION, '{"type":"GeometryCollection","geometries":[' * DEEP + "]}" * DEEP
    yield "arrays.toml", CONFIG, "a = " + "[" * DEEP + "]" * DEEP + "\n"
    yield "tables.toml", CONFIG, "[" + ".".join("a" * DEEP) + "]\nb = 1\n"
    yield "keys.toml", CONFIG, ".".join("a" * DEEP) + " = 1\n"
    yield "inline.toml", CONFIG, "a = " + ("{" + ".".join("a" * 31) + " = ") * 250 + "1" + "}" * 250 + "\n"
    yield "values.toml", CONFIG, "cells = [" + "1," * MANY + "]\n"
    yield "lines.toml", CONFIG, "".join(f"a{k} = 1\n" for k in range(MANY))


def vtp(points, cells, data="", array="ascii", values=POINTS, head=""):
    return (f'<VTKFile type="PolyData" {head}><PolyData><Piece NumberOfPoints="{points}" NumberOfPolys="{cells}">'
            f'<Points><DataArray type="Float64" NumberOfComponents="3" format="{array}">{values}</DataArray></Points>'
            '<Polys><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2</DataArray><DataArray type="Int64" '
            f'Name="offsets" format="ascii">3</DataArray></Polys>{data}</Piece></PolyData></VTKFile>')


def xml_cases():
    yield "points.vtp", INFO, vtp(HUGE, 1)
    yield "some.vtp", INFO, vtp(2 * 10**9, 1)
    yield "cells.vtp", INFO, vtp(3, HUGE)
    yield "components.vtp", INFO, vtp(3, 1, f'<PointData><DataArray type="Float64" Name="a" '
                                      f'NumberOfComponents="{HUGE}" format="ascii">1</DataArray></PointData>')
    array = '<DataArray type="Float64" Name="a" format="ascii">1 2 3</DataArray>'
    yield "arrays.vtp", INFO, vtp(3, 1, "<PointData>" + array * MANY + "</PointData>")
    yield "deep.vtp", INFO, "<VTKFile>" + "<a>" * MANY
    yield "attributes.vtp", INFO, "<VTKFile " + " ".join(f'a{k}="1"' for k in range(MANY)) + ">"
    compressed = 'compressor="vtkZLibDataCompressor" header_type="UInt64" byte_order="LittleEndian"'
    block = base64.b64encode(struct.pack("<QQQQ", HUGE, HUGE, HUGE, 10)).decode()
    yield "blocks.vtp", INFO, vtp(3, 1, array="binary", values=block, head=compressed)
    packed = zlib.compress(b"\0" * (1 << 28), 9)
    bomb = base64.b64encode(struct.pack("<QQQQ", 1, 1 << 28, 0, len(packed))).decode()
    yield "bomb.vtp", INFO, vtp(3, 1, array="binary", values=bomb + base64.b64encode(packed).decode(), head=compressed)


def classic(dimensions, variables):
    """A CDF-5 header without values; variables of names, dimension ids and a type."""
    def name(word):
        return struct.pack(">q", len(word)) + word.encode() + b"\0" * (-len(word) % 4)
    parts = [b"CDF\x05", struct.pack(">qIq", 0, 10, len(dimensions))]
    parts += [name(word) + struct.pack(">q", size) for word, size in dimensions]
    parts.append(struct.pack(">IqIq", 0, 0, 11, len(variables)))
    parts += [name(word) + struct.pack(f">{len(ids) + 1}q", len(ids), *ids) + struct.pack(">IqIqq", 0, 0, kind, 1 << 30,
                                                                                      4096)
              for word, ids, kind in variables]
    return b"".join(parts)


def binary_cases():
    mesh = [(word, [0], 6) for word in ("xCell", "yCell", "zCell")] + [("cellsOnVertex", [1, 2], 4)]
    yield "cells.nc", INFO, classic([("nCells", HUGE), ("nVertices", HUGE), ("vertexDegree", 3)], mesh)
    yield "overflow.nc", INFO, classic([("nCells", 1 << 62), ("nVertices", 1 << 62), ("vertexDegree", 1 << 62)], mesh)
    yield "dimensions.nc", INFO, classic([(f"d{k}", 1) for k in range(MANY)], [])
    yield "variables.nc", INFO, classic([("a", 1)], [(f"v{k}", [0], 6) for k in range(MANY)])
    yield "count.nc", INFO, b"CDF\x05" + struct.pack(">qIq", 0, 10, HUGE)
    yield "attribute.nc", INFO, (b"CDF\x05" + struct.pack(">qIqIqq", 0, 0, 0, 12, 1, 1) + b"a\0\0\0" +
                                 struct.pack(">Iq", 2, HUGE))
    for place in range(2):
        body = b"calotte checkpoint 8, little-endian\n" + struct.pack(f"<{place + 1}q", *[0] * place, HUGE)
        yield f"length{place}.checkpoint", RESUME, body + struct.pack("<I", zlib.crc32(body))


def line_cases(folder):
    """Files of one long line, which are one file in truth."""
    line = os.path.join(folder, "line")
    with open(line, "wb") as file:
        for _ in range(LINE >> 20):
            file.write(b"1" * (1 << 20))
    for name, command in {"line.txt": DELAUNAY, "line.off": INFO, "line.ply": INFO, "line.vtk": INFO, "line.vtp": INFO,
                          "line.msh": INFO, "line.geojson": INFO, "line.nc": INFO, "line.pts": REGION,
                          "region-line.geojson": REGION, "widths-line.geojson": WIDTHS, "widths-line.msh": WIDTHS,
                          "widths-line.nc": WIDTHS, "domain-line.txt": DOMAIN, "domain-line.geojson": DOMAIN,
                          "line.toml": CONFIG, "line.checkpoint": RESUME}.items():
        if ONLY in name:
            os.link(line, os.path.join(folder, name))
            yield name, command


def hdf5_cases(folder):
    """Files of values that are not stored."""
    if not shutil.which("ncgen"):
        print("no ncgen: HDF5 is skipped; tools/setup --clients")
        return
    for name, size in (("huge-hdf5.nc", HUGE), ("some-hdf5.nc", 1 << 29)):
        doubles = "\n".join(f"double {word}(nCells);" for word in ("xCell", "yCell", "zCell"))
        text = (f"netcdf a {{ dimensions: nCells = {size}LL; nVertices = {size}LL; vertexDegree = 3; variables: {doubles}\n"
                "int cellsOnVertex(nVertices, vertexDegree); }")
        with open(os.path.join(folder, "a.cdl"), "w", encoding="ascii") as file:
            file.write(text)
        subprocess.run(["ncgen", "-x", "-k", "nc4", "-o", name, "a.cdl"], cwd=folder, check=True)
        yield name, INFO


def measure(arguments, folder):
    """Exit code or minus the signal, processor seconds, MiB of memory at most, and output."""
    with subprocess.Popen([CALOTTE, *arguments], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT) as process:
        timer = threading.Timer(KILLED_AFTER, process.kill)
        timer.start()
        output = process.stdout.read().decode(errors="replace")
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        timer.cancel()
    return process.returncode, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024, output


def write_cases(folder):
    """Writes the files; returns their names and commands."""
    written = []
    for source in (text_cases, xml_cases, binary_cases):
        for name, command, content in source():
            if ONLY in name:
                with open(os.path.join(folder, name), "wb") as file:
                    file.write(content if isinstance(content, bytes) else content.encode())
                written.append((name, command))
    return [*written, *hdf5_cases(folder), *line_cases(folder)]


def main():
    faults, count, most = [], 0, (0, 0)
    with tempfile.TemporaryDirectory() as folder:
        with concurrent.futures.ProcessPoolExecutor(1) as maker:  # a process starts with its parent's peak of memory
            cases = maker.submit(write_cases, folder).result()
        _, _, base, _ = measure(["--version"], folder)
        for name, command in cases:
            size = os.path.getsize(os.path.join(folder, name)) / 2**20
            code, seconds, memory, output = measure([name if word == "@" else word for word in command], folder)
            beyond = max(0, memory - base - size)
            print(f"{name}: {size:.1f} MiB, exit code {code}, {seconds:.2f} s, {beyond:.1f} MiB beyond it: "
                  f"{output.strip()[:150]}", flush=True)
            refusal = [line for line in output.splitlines() if not line.startswith("calotte: warning: ")]
            if code != 2 or len(refusal) != 1 or beyond > MEMORY or seconds > SECONDS:
                faults.append(name)
            count, most = count + 1, (max(most[0], seconds), max(most[1], beyond))
    print(f"{count} hostile files, at most {most[0]:.2f} s of the processor and {most[1]:.0f} MiB; "
          f"not refused as they should be: {' '.join(faults) or 'none'}")
    sys.exit(bool(faults))


main()
