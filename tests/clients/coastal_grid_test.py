# SPDX-License-Identifier: GPL-3.0-or-later
"""Grids of the sea for SCHISM, ADCIRC, SMS and Gmsh, by the rules that the manuals and the readers of these
programs state, from the files alone. Each rule is also broken, and must be found so.

coastal_grid_test.py CALOTTE"""
import collections
import json
import os
import subprocess
import sys
import tempfile

import numpy as np

CALOTTE = os.path.abspath(sys.argv[1])

Grid = collections.namedtuple("Grid", "lonlat depth triangles open land stated")


def words(line):
    """What a list-directed READ of Fortran takes: items up to a remark."""
    return line.replace(",", " ").split()


def read_grid(path):
    """A file of SCHISM or ADCIRC, as their list-directed READ statements do: line by line."""
    with open(path, encoding="ascii") as file:
        lines = iter(file.read().splitlines())
    title = next(lines)
    assert len(title) <= 24, "AGRID has 24 characters at most"
    elements, nodes = (int(word) for word in words(next(lines))[:2])
    rows = [words(next(lines)) for _ in range(nodes)]
    assert [int(row[0]) for row in rows] == list(range(1, nodes + 1)), "JN counts from 1"
    lonlat = np.array([[float(row[1]), float(row[2])] for row in rows])
    depth = np.array([float(row[3]) for row in rows])
    rows = [[int(word) for word in words(next(lines))[:5]] for _ in range(elements)]
    assert [row[0] for row in rows] == list(range(1, elements + 1)), "JE counts from 1"
    assert all(row[1] == 3 for row in rows), "NHY is 3"
    triangles = np.array([row[2:] for row in rows]) - 1
    lists, stated = [], []
    for _ in range(2):
        count, total = int(words(next(lines))[0]), int(words(next(lines))[0])
        part = []
        for _ in range(count):
            size, kind = (int(word) for word in words(next(lines))[:2])
            part.append((kind, [int(words(next(lines))[0]) - 1 for _ in range(size)]))
        lists.append(part)
        stated.append(total)
    assert not list(lines), "nothing follows"
    return Grid(lonlat, depth, triangles, lists[0], lists[1], stated)


def unit(lonlat):
    lon, lat = np.radians(lonlat).T
    return np.stack([np.cos(lat) * np.cos(lon), np.cos(lat) * np.sin(lon), np.sin(lat)], axis=1)


def outer_edges(triangles):
    """The edges of one triangle, with it to the left."""
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    known = set(map(tuple, edges))
    assert len(known) == len(edges), "two triangles lie on one side of an edge"
    return {(a, b) for a, b in known if (b, a) not in known}


def faults_of(grid, model):
    """The rules that a grid breaks."""
    faults = []

    def require(holds, rule):
        if not holds:
            faults.append(rule)

    x = unit(grid.lonlat)
    a, b, c = (x[grid.triangles[:, k]] for k in range(3))
    require((np.einsum("ij,ij->i", np.cross(a, b), c) > 0).all(), "elements are counter-clockwise")
    require((abs(grid.lonlat[:, 0]) <= 180).all() and (abs(grid.lonlat[:, 1]) <= 90).all(), "degrees")
    require(np.isfinite(grid.depth).all(), "depths are numbers")
    require(len(np.unique(grid.triangles)) == len(grid.lonlat), "no node hangs")  # SCHISM: "Hanging node"
    require([sum(len(nodes) for _, nodes in part) for part in (grid.open, grid.land)] == grid.stated,
            "NETA and NVEL are the numbers of nodes")
    outer = outer_edges(grid.triangles)
    starts = collections.Counter(start for start, _ in outer)
    listed = {node for part in (grid.open, grid.land) for _, nodes in part for node in nodes}
    # SCHISM, "Illegal bnd node": a listed node has one element from which the boundary goes on; "Incomplete
    # ball": all others are surrounded.
    require(all(starts[node] == 1 for node in listed), "a listed node has one boundary")
    require(set(starts) == listed, "all nodes of the boundary are listed, and no others")
    uses = collections.Counter()
    islands = {"schism": {1}, "adcirc": {21}}[model]
    mainland = {"schism": {0}, "adcirc": {20}}[model]
    for is_open, part in ((True, grid.open), (False, grid.land)):
        for kind, nodes in part:
            require(len(nodes) >= 2, "a list has two nodes")
            require(kind in ({0} if is_open else islands | mainland), "IBTYPE is one of those written")
            if is_open and model == "schism":
                require(nodes[0] != nodes[-1], "no open list is looped")  # "Looped open bnd"
            closes = not is_open and kind in islands
            if closes:
                require(nodes[0] != nodes[-1], "an island does not repeat its first node")
            if model == "schism" and not is_open and not closes:
                require(nodes[0] != nodes[-1], "the mainland is no closed list")
            chain = nodes + nodes[:1] if closes else nodes
            for edge in zip(chain[:-1], chain[1:]):
                require(edge in outer, "lists follow the outer edges, with land to the right")
                uses[edge] += 1
            if closes:
                # Seen along the list, the island is to the right: the area to the left is not the smaller one
                # for the islands of this test.
                ring = x[nodes]
                normal = np.cross(ring, np.roll(ring, -1, axis=0)).sum(axis=0)
                require(normal @ ring.mean(axis=0) < 0, "islands run clockwise")
    require(set(uses) == outer and all(count == 1 for count in uses.values()), "each outer edge is in one list")
    return sorted(set(faults))


def broken(grid):
    """Copies of a grid, each with the rule that it breaks."""
    land = [(kind, list(nodes)) for kind, nodes in grid.land]
    yield "NETA and NVEL are the numbers of nodes", grid._replace(stated=[grid.stated[0], grid.stated[1] + 1])
    yield "lists follow the outer edges, with land to the right", grid._replace(
        land=[*land[:-1], (land[-1][0], land[-1][1][::-1])])
    yield "each outer edge is in one list", grid._replace(land=land[:-1])
    yield "all nodes of the boundary are listed, and no others", grid._replace(land=land[:-1])
    yield "each outer edge is in one list", grid._replace(land=[*land, land[-1]])
    yield "no node hangs", grid._replace(lonlat=np.vstack([grid.lonlat, [0, 0]]), depth=np.append(grid.depth, 1))
    yield "elements are counter-clockwise", grid._replace(triangles=grid.triangles[:, ::-1])
    yield "depths are numbers", grid._replace(depth=np.append(grid.depth[:-1], np.nan))


def strings_of(path):
    """The nodes, triangles and strings of a .2dm file."""
    nodes, triangles, strings, current = {}, [], [], []
    with open(path, encoding="ascii") as file:
        assert next(file).split() == ["MESH2D"]
        for line in file:
            card, *rest = line.split()
            if card == "ND":
                nodes[int(rest[0])] = [float(word) for word in rest[1:4]]
            elif card == "E3T":
                triangles.append([int(word) - 1 for word in rest[1:4]])
            elif card == "NS":
                assert len(rest) <= 12, "ten ids a line, and the number of a string"
                for word in rest:
                    current.append(abs(int(word)) - 1)
                    if int(word) < 0:
                        strings.append(current)
                        current = []
                        break
    assert not current and sorted(nodes) == list(range(1, len(nodes) + 1))
    return np.array([nodes[k + 1] for k in range(len(nodes))]), np.array(triangles), strings


def gmsh_of(path):
    """The points, triangles, and lines by physical name, of a text of Gmsh 4.1."""
    with open(path, encoding="ascii") as file:
        lines = iter(file.read().splitlines())
    sections = {}
    for line in lines:
        name, part = line[1:], []
        for inner in lines:
            if inner == "$End" + name:
                break
            part.append(inner)
        sections[name] = part
    assert sections["MeshFormat"] == ["4.1 0 8"]
    names = {tuple(map(int, line.split()[:2])): line.split('"')[1] for line in sections["PhysicalNames"][1:]}
    points, curves, surfaces, volumes = map(int, sections["Entities"][0].split())
    assert (points, surfaces, volumes) == (0, 1, 0) and len(sections["Entities"]) == 1 + curves + surfaces
    group_of = {}
    for dimension, line in [(1, line) for line in sections["Entities"][1:1 + curves]] + [
            (2, sections["Entities"][-1])]:
        row = line.split()
        assert int(row[7]) == 1
        group_of[dimension, int(row[0])] = names[dimension, int(row[8])]
        assert len(row) == 10 + int(row[9])
    head, body = sections["Nodes"][0].split(), sections["Nodes"][2:]
    count = int(head[1])
    assert head == ["1", str(count), "1", str(count)]
    assert [int(tag) for tag in body[:count]] == list(range(1, count + 1))
    positions = np.array([[float(word) for word in line.split()] for line in body[count:]])
    blocks, total, first, last = map(int, sections["Elements"][0].split())
    assert (first, last) == (1, total)
    rest, tags, triangles, by_group = iter(sections["Elements"][1:]), [], None, collections.defaultdict(list)
    for _ in range(blocks):
        dimension, entity, kind, size = map(int, next(rest).split())
        rows = np.array([[int(word) for word in next(rest).split()] for _ in range(size)])
        tags += list(rows[:, 0])
        assert kind == {1: 1, 2: 2}[dimension]
        if dimension == 2:
            triangles = rows[:, 1:] - 1
        else:
            by_group[group_of[1, entity]] += [tuple(row) for row in rows[:, 1:] - 1]
    assert tags == list(range(1, total + 1)) and not list(rest)
    return positions, triangles, by_group


def require(holds, what, detail=""):
    if not holds:
        sys.exit(f"FAILED: {what} {detail}")


def main():
    with tempfile.TemporaryDirectory() as folder:
        def run(*arguments):
            done = subprocess.run([CALOTTE, *arguments], cwd=folder, capture_output=True, text=True, check=False)
            # 5: the mesh is written, and a few of its cells have other shapes than wanted.
            require(done.returncode in ((0, 5) if arguments[0] == "cvt" else (0,)), " ".join(arguments), done.stderr)
            return done.stdout

        def path(name):
            return os.path.join(folder, name)

        def ring(lon, lat, radius, count=40):
            turn = np.linspace(0, 2 * np.pi, count + 1)
            return [[lon + radius * np.cos(t) / np.cos(np.radians(lat)), lat + radius * np.sin(t)] for t in turn]

        # A sea over the date line with two islands.
        with open(path("sea.geojson"), "w", encoding="ascii") as file:
            json.dump({"type": "Polygon", "coordinates": [ring(178, 20, 18), ring(180, 26, 4)[::-1],
                                                         ring(172, 12, 3)[::-1]]}, file)
        run("cvt", "--region", "sea.geojson", "--cells", "1500", "--boundary", "generators", "-o", "sea.vtp")
        with open(path("open.geojson"), "w", encoding="ascii") as file:
            json.dump({"type": "LineString", "coordinates": ring(178, 20, 18)[:12]}, file)
        for model, name in (("schism", "hgrid.gr3"), ("adcirc", "fort.14")):
            for opening in ([], ["--open", "open.geojson"], ["--open", "box=150,10,175,50"],
                            ["--open", "circle=178,20,2500km"]):
                run("convert", "sea.vtp", name, "--depth", "250", *opening)
                require("passed" in run("check", name), f"check {name}")
                grid = read_grid(path(name))
                faults = faults_of(grid, model)
                require(not faults, f"{name} {opening}:", "; ".join(faults))
                require((grid.depth == 250).all(), "depths")
                require(bool(grid.open) == bool(opening), "open lists where they are asked for")
                require(len(grid.triangles) > 2000 and np.ptp(grid.lonlat[:, 0]) > 350, "the sea crosses the date line")
                if not opening:
                    kinds = [kind for kind, _ in grid.land]
                    require(kinds == {"schism": [0, 0, 1, 1], "adcirc": [20, 21, 21]}[model], "kinds of land", kinds)
                    for rule, copy in broken(grid):
                        require(rule in faults_of(copy, model), f"not found in {name}: {rule}")
            run("cvt", "--region", "sea.geojson", "--cells", "800", "--boundary", "generators", "--open",
                "open.geojson", "--depth", "10", "-o", name)
            require(not faults_of(read_grid(path(name)), model) and read_grid(path(name)).open, f"cvt -o {name}")

        run("convert", "fort.14", "sea.2dm")
        xyz, triangles, strings = strings_of(path("sea.2dm"))
        require((xyz[:, 2] == -10).all(), "heights of SMS")
        pairs = [pair for string in strings for pair in zip(string[:-1], string[1:])]
        require(sorted(pairs) == sorted(outer_edges(triangles)), "strings of SMS")
        run("convert", "fort.14", "sea.msh", "--format", "gmsh")
        positions, triangles, groups = gmsh_of(path("sea.msh"))
        require(np.allclose(np.linalg.norm(positions, axis=1), 1, atol=1e-15), "the unit sphere in Gmsh")
        require(sorted(sum(groups.values(), [])) == sorted(outer_edges(triangles)), "lines of Gmsh")
        require({"open", "island", "land"} == set(groups), "groups of Gmsh", set(groups))
        for name in ("sea.2dm", "sea.msh"):
            require("passed" in run("check", name), f"check {name}")
            require("800" in run("info", name), f"info {name}")

    print("the rules of SCHISM, ADCIRC, SMS and Gmsh hold; broken ones are found")


main()
