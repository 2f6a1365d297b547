#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests the pages of `calotte view` in Chromium.

    view_test.py CALOTTE

CALOTTE is the path of the command. Exit code 77, which skips the test, where Chromium or its driver is not
installed, unless the environment variable CALOTTE_CLIENTS is "required". The environment variable
CALOTTE_SCREENSHOTS names a folder for pictures of the pages.
"""

import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

SKIPPED = 77
X8 = "tanh:lon=270,lat=30,beta=30deg,alpha=0.20,gamma=x8"
PRECISION = 2e-5  # of the page's numbers
HOSTILE = "a<img src=x onerror=alert(1)>"  # the name of a field

try:
    import netCDF4
    import numpy
    from browser import Browser
except ImportError:
    Browser = None


def check(truth, message):
    if not truth:
        sys.exit(f"FAILED: {message}")


def check_close(value, expected, message, precision=PRECISION):
    check(abs(value - expected) <= precision * max(abs(expected), 1e-6), f"{message}: {value}, not {expected}")


class Command:
    def __init__(self, path):
        self.path = path

    def __call__(self, *arguments):
        result = subprocess.run([self.path, *arguments], capture_output=True, text=True, check=False)
        check(result.returncode == 0, f"calotte {' '.join(arguments)}: {result.stderr}")
        return result.stdout

    def refusal(self, *arguments):
        """The message of a command that fails."""
        result = subprocess.run([self.path, *arguments], capture_output=True, text=True, check=False)
        check(result.returncode == 2 and result.stderr.count("\n") == 1,
              f"calotte {' '.join(arguments)}: {result.returncode} {result.stderr}")
        return result.stderr


def numbers_of_cell(calotte, mesh, cell, *options):
    """What `calotte info --cell` prints, by its first column."""
    table = {}
    for line in calotte("info", mesh, "--cell", str(cell), *options).splitlines():
        table[line[:28].strip()] = line[28:].split()[0]
    return table


# ---- Meshes


def foreign_mpas(path, source):
    """An MPAS file as another program would write it: fields, some of them of an odd kind, and no attributes of ours."""
    shutil.copy(source, path)
    with netCDF4.Dataset(path, "a") as data:
        for name in data.ncattrs():
            if name not in ("on_a_sphere", "is_periodic", "sphere_radius"):
                data.delncattr(name)
        cells, edges = len(data.dimensions["nCells"]), len(data.dimensions["nEdges"])
        temperature = data.createVariable("temperature", "f4", ("nCells",))
        temperature.units = "K"
        values = 280 + 20 * numpy.cos(2 * data["latCell"][:])
        values[::7] = math.nan
        temperature[:] = values
        data.createVariable("constant", "f8", ("nCells",))[:] = 3.5
        data.createVariable("codes", "i4", ("nCells",))[:] = 100001 + numpy.arange(cells) % 3
        data.createVariable("great", "f8", ("nCells",))[:] = numpy.linspace(1e299, 1e300, cells)
        data.createVariable("nothing", "f8", ("nCells",))[:] = math.nan
        data.createVariable("wind", "f8", ("nEdges",))[:] = numpy.arange(edges)
        data.createVariable(HOSTILE, "f8", ("nCells",))[:] = numpy.arange(cells)


def make_meshes(calotte):
    calotte("cvt", "--cells", "40962", "--density", X8, "--sphere-radius", "earth", "-o", "x8.nc")
    calotte("cvt", "--cells", "2562", "--sphere-radius", "earth", "-o", "uniform.nc", "--start", "random", "--stop",
            "tolerance", "--report", "uniform.json", "--keep-every", "20")
    calotte("cvt", "--region", "circle=-105,40,1000km", "--cell-width", "60km", "--limited-area", "-o", "area.nc")
    calotte("cvt", "--cells", "1000", "--rectangle", "0,0,2,1", "-o", "plane.nc")
    calotte("cvt", "--cells", "100", "--periodic", "2,1", "-o", "box.nc")
    foreign_mpas("foreign.nc", "uniform.nc")
    calotte("points", "random", "12", "-o", "twelve.txt")
    calotte("delaunay", "twelve.txt", "-o", "twelve.ply")
    calotte("points", "random", "3000", "-o", "random.txt")
    calotte("delaunay", "random.txt", "-o", "random.vtp")


# ---- Pages


class Pages:
    def __init__(self, calotte, browser):
        self.calotte, self.browser, self.turns = calotte, browser, 0

    def open(self, name, *arguments):
        page = f"{name}.html"
        self.calotte("view", *arguments, "-o", page)
        self.browser.open(page)
        self.check_quiet(name)
        if folder := os.environ.get("CALOTTE_SCREENSHOTS"):
            self.browser.screenshot(pathlib.Path(folder) / f"{name}.png")
        return page

    def check_quiet(self, name):
        """No message in the console, no request, no error that the page shows."""
        check(not (messages := self.browser.console()), f"{name}: the console has {messages}")
        check(not (urls := self.browser.requests()), f"{name}: the page asks for {urls}")
        check(not (errors := self.browser.run("calotte.errors")), f"{name}: the page shows {errors}")

    def check_picture(self, name):
        """The picture has colours, and turning changes it."""
        before = self.browser.run("calotte.pixels()")
        check(before["colours"] > 5, f"{name}: the picture has {before['colours']} colours")
        self.turns += 1
        self.browser.run("(calotte.turn(arguments[0], -40, 2), calotte.frame())", 37 * self.turns)
        after = self.browser.run("calotte.pixels()")
        check(before["checksum"] != after["checksum"], f"{name}: turning does not change the picture")

    def check_cell(self, mesh, cell, *options):
        """The numbers of a picked cell are those of calotte info."""
        picked = self.browser.run("calotte.pick(arguments[0])", cell)
        expected = numbers_of_cell(self.calotte, mesh, cell, *options)
        check(picked["cell"] == cell and int(expected["cell"]) == cell, f"{mesh}: picked {picked['cell']}")
        labels = {"spacing": "spacing", "area": "area", "quality": "cell quality", "sigma": "sigma",
                  "degree": "neighbours", "angle": "largest angle", "off_centroid": "distance to the centroid",
                  "dc_h_least": "least dc/h", "dc_h_greatest": "greatest dc/h"}
        compared = 0
        for name, label in labels.items():
            if label in expected and expected[label] != "no":
                check_close(picked["values"][name], float(expected[label]), f"{mesh}, cell {cell}: {name}", 1e-3)
                compared += 1
        check(compared >= 6, f"{mesh}: {compared} numbers compared")
        place = ("lon", "longitude", "lat", "latitude") if "longitude" in expected else ("x", "x", "y", "y")
        for of_page, of_info in (place[:2], place[2:]):
            check(abs(picked[of_page] - float(expected[of_info])) < 1e-3, f"{mesh}: {of_page} {picked[of_page]}")

    def check_measures(self, mesh, *options):
        """The extreme cells are those of calotte info, and all cells are in the histogram."""
        self.calotte("info", mesh, "--report", "info.json", *options)
        info = json.loads(pathlib.Path("info.json").read_text())
        worst = self.browser.run("calotte.worst('quality')")
        check(len(worst) == 10, f"{mesh}: {len(worst)} worst cells")
        value = self.browser.run("calotte.pick(arguments[0])", worst[0])["values"]["quality"]
        check_close(value, info["cell_quality"]["min"], f"{mesh}: the worst quality")
        return info


def test_grid(pages):
    pages.open("x8", "x8.nc")
    check(pathlib.Path("x8.html").stat().st_size <= 4e6, "x8: the page exceeds 4 MB")
    pages.check_picture("x8")
    for cell in (0, 12345, 40961):
        pages.check_cell("x8.nc", cell)
    info = pages.check_measures("x8.nc")
    degrees = {int(item.split(":")[0]): int(item.split(":")[1])
               for item in pages.calotte("info", "x8.nc").split("cells         ")[-1].splitlines()[0].split(", ")}
    for degree, count in degrees.items():
        marked = pages.browser.run("calotte.brush('degree', arguments[0] - 0.5, arguments[0] + 0.5)", degree)
        check(marked == count, f"x8: {marked} cells with {degree} neighbours are marked, not {count}")
    check(pages.browser.run("calotte.brush('spacing', 0, 1e9)") == info["cells"], "x8: brushing misses cells")
    before = pages.browser.run("(calotte.frame(), calotte.pixels())")["checksum"]
    pages.browser.run("(calotte.measure('quality'), calotte.frame())")
    check(pages.browser.run("calotte.pixels()")["checksum"] != before, "x8: a measure does not change the colours")
    pages.browser.run("(calotte.shapes('triangles'), calotte.measure('triangle_angle'), calotte.frame())")
    pages.check_picture("x8 triangles")
    pages.check_quiet("x8")


def test_limited_area(pages):
    pages.open("area", "area.nc")
    pages.check_picture("area")
    pages.check_cell("area.nc", 100)
    counts = netCDF4.Dataset("area.nc")["bdyMaskCell"][:]
    for mask in range(8):
        marked = pages.browser.run("calotte.brush('region', arguments[0] - 0.5, arguments[0] + 0.5)", mask)
        check(marked == int((counts == mask).sum()), f"area: {marked} cells of mask {mask}")


def test_plane(pages):
    pages.open("plane", "plane.nc", "--plane", "--rectangle", "0,0,2,1")
    pages.check_picture("plane")
    pages.check_cell("plane.nc", 500, "--plane", "--rectangle", "0,0,2,1")
    pages.check_measures("plane.nc", "--plane", "--rectangle", "0,0,2,1")


def test_periodic(pages):
    pages.open("box", "box.nc", "--plane")
    pages.check_picture("box")
    for cell in (0, 17, 99):
        picked = pages.browser.run("calotte.pick(arguments[0])", cell)
        check(len(picked["neighbours"]) == picked["values"]["degree"], f"box: cell {cell} has {picked['neighbours']}")


def test_foreign(pages):
    pages.open("foreign", "foreign.nc")
    pages.check_picture("foreign")
    pages.check_cell("foreign.nc", 7)
    for field in ("temperature", "constant", "nothing", "codes", "great", HOSTILE):
        pages.browser.run("(calotte.measure(arguments[0]), calotte.frame())", f"field:{field}")
        pages.check_quiet(f"foreign, {field}")
    marked = pages.browser.run("calotte.brush('field:temperature', 0, 1000)")
    check(marked == 2562 - len(range(0, 2562, 7)), f"foreign: {marked} cells with a temperature are marked")
    check(pages.browser.run("calotte.brush('field:codes', 100002, 100002)") == 2562 // 3, "foreign: codes are not exact")
    check(0 < pages.browser.run("calotte.brush('field:great', 5e299, 1e300)") < 2562, "foreign: great values")
    check(pages.browser.run("document.querySelectorAll('img').length") == 0, "foreign: a name became markup")
    message = pages.calotte.refusal("view", "foreign.nc", "--field", "wind", "-o", "wind.html")
    check("it is a field at edges" in message, f"foreign: {message}")


def test_small_and_random(pages):
    for mesh in ("twelve.ply", "random.vtp"):
        pages.open(mesh, mesh)
        pages.check_picture(mesh)
        pages.check_cell(mesh, 5)


def test_polygon_of_many_sides(pages):
    ring = [[30 * math.cos(2 * math.pi * k / 700), 30 * math.sin(2 * math.pi * k / 700)] for k in range(701)]
    feature = {"type": "Feature", "properties": {"v": 1.5}, "geometry": {"type": "Polygon", "coordinates": [ring]}}
    pathlib.Path("ring.geojson").write_text(json.dumps({"type": "FeatureCollection", "features": [feature]}))
    pages.open("ring", "ring.geojson")
    before = pages.browser.run("calotte.pixels()")["checksum"]
    pages.browser.asynchronous("calotte.measure('degree')")
    check(pages.browser.run("calotte.pixels()")["checksum"] != before, "ring: a cell of 700 sides is not drawn")


def test_two_and_states(pages):
    pages.open("two", "x8.nc", "uniform.nc")
    pages.check_picture("two")
    other = pages.browser.run("calotte.pixels(1)")
    check(other["colours"] > 5, "two: the second picture is empty")
    pages.open("states", "uniform.nc", "--history", "uniform.json")
    first = pages.browser.run("calotte.pixels()")["checksum"]
    pages.browser.asynchronous("calotte.showState(0)")
    pages.browser.run("calotte.frame()")
    check(pages.browser.run("calotte.pixels()")["checksum"] != first, "states: a state does not change the picture")
    pages.check_quiet("states")


def test_finding(pages):
    """Cells and places as the page prints them."""
    pages.open("find", "uniform.nc")
    for text in ("1764", "1\u202f764", " 1 764 "):
        pages.browser.run("(document.getElementById('find').value = arguments[0], "
                          "document.getElementById('find-form').requestSubmit())", text)
        answer = pages.browser.run("document.getElementById('find-answer').textContent")
        check(bool(answer) == (text == " 1 764 "), f"find: {text!r}: {answer}")
    cells = []
    for text in ("-105 -40", "\u2212105, \u221240", "105.00° W, 40.00° S", "105W 40S"):
        pages.browser.run("(document.getElementById('find').value = arguments[0], "
                          "document.getElementById('find-form').requestSubmit())", text)
        cells.append(pages.browser.asynchronous("calotte.picked()")["cell"])
    check(len(set(cells)) == 1, f"find: {cells}")
    bad = {"W": "Enter two", "--5": "“-”", "5 W E": "Enter two", "°": "“°”", "40 50 60": "Enter two",
           "91, 200": "Latitudes", "10N 20N": "Both",
           "-74W 40N": "minus sign", "10 70'N 3E": "Minutes", "lat 3W lon 4": "no W",
           "10, 400": "Longitudes", "<b>1,2": "“<”", "": "Enter two", "x" * 5000: "“x”", "5e3 1": "Enter two"}
    for text, words in bad.items():
        answer, _ = find(pages.browser, text)
        check(words in answer and "\n" not in answer and len(answer) < 90, f"find: {text[:20]!r}: {answer}")


def find(browser, text):
    """Enters a text in the field; the answer, and the place that is picked."""
    browser.run("calotte.clear()")
    browser.run("(document.getElementById('find').value = arguments[0], "
                "document.getElementById('find-form').requestSubmit())", text)
    picked = browser.asynchronous("calotte.idle().then(calotte.picked)")
    return browser.run("document.getElementById('find-answer').textContent"), picked


def test_places(pages):
    """Places as people paste them."""
    pages.open("places", "uniform.nc")
    new_york = ["40.7128° N, 74.0060° W", "40°42'46\"N 74°00'22\"W", "40°42′46″N 74°00′22″W", "40.7N,74W", "74W 40.7N",
                "lat 40.7 lon -74", "lon=-74, lat=40.7", "N40.7 W74",
                "Latitude: 40.7° Longitude: -74.0°", "40 42 46 N 74 0 22 W",
                "40:42:46N 074:00:22W", "40.7128 north, 74.006 west", "40º42'46''N, 74º00'22''W", "40.7° N −74.0°",
                "40.7128, -74.0060", "40.7128 -74.0060", "40.7 ; 286", "(40.7128, -74.0060)", "40°42'46\", -74°00'22\""]
    for text in new_york:
        answer, picked = find(pages.browser, text)
        check(picked and abs(picked["lon"] + 74) < 3 and abs(picked["lat"] - 40.7) < 3, f"places: {text!r}: {picked}")
        lettered = any(letter.isalpha() for letter in text)
        check(("Latitude first: 74.0" in answer or "Latitude first: 286" in answer) if not lettered else not answer,
              f"places: {text!r}: {answer}")
    for text, first in (("-33.86, 151.21", "Latitude first: 151.21° E, 33.86° S"),
                        ("151.21, -33.86", "Longitude first, as a latitude is at most 90: 151.21° E, 33.86° S"),
                        ("151.21E 33.86S", ""), ("33.86S 151.21E", "")):
        answer, picked = find(pages.browser, text)
        check(abs(picked["lon"] - 151.21) < 3 and abs(picked["lat"] + 33.86) < 3, f"places: {text!r}: {picked}")
        check(answer.startswith(first) if first else not answer, f"places: {text!r}: {answer}")
    label = pages.browser.run("document.getElementById('find-label').textContent")
    check(label == "lat, lon or cell", f"places: the label is {label}")
    pages.check_quiet("places")
    pages.open("point", "plane.nc", "--plane", "--rectangle", "0,0,2,1")
    answer, picked = find(pages.browser, "1.5, 2.5e-1")
    check(abs(picked["x"] - 1.5) < 0.1 and abs(picked["y"] - 0.25) < 0.1, f"places: {picked}")
    check(find(pages.browser, "1.5N 2")[0] == "Enter x and y or one cell index.", "places: a letter in a plane")


def wait_for(truth, message):
    """Waits up to ten seconds."""
    for _ in range(100):
        if value := truth():
            return value
        time.sleep(0.1)
    return check(False, message)


STATE = """(() => {
const value = (id) => document.getElementById(id).value, on = (id) => document.getElementById(id).checked;
return [value('measure'), value('filter'), value('palette'), on('logarithmic'), on('fit'), on('coast'),
on('shapes-triangles'), document.getElementById('marks-text').textContent,
document.querySelector('#picked tbody')?.textContent ?? '']; })()"""


def test_link(pages):
    """The address holds the view, and opens it again; what is wrong in it is ignored."""
    browser = pages.browser
    page = pages.open("link", "uniform.nc")
    check(browser.run("location.hash") == "", "link: the address changes before the reader does anything")
    first = browser.run(STATE)
    opened = browser.asynchronous("calotte.pixels()")["checksum"]
    browser.asynchronous("calotte.measure('quality')")
    browser.run("['logarithmic', 'coast', 'fit'].forEach(id => document.getElementById(id).click())")
    browser.run("(document.getElementById('palette').value = 'magma', "
                "document.getElementById('palette').dispatchEvent(new Event('change')))")
    browser.asynchronous("calotte.brush('spacing', 440, 480)")
    browser.asynchronous("calotte.filter('marked')")
    browser.asynchronous("calotte.shapes('triangles')")
    browser.run("calotte.turn(12.5, -33.25, 3)")
    browser.asynchronous("calotte.pick(777)")
    wait_for(lambda: {"at=12.5,-33.25,3", "cell=777"} <= set(browser.run("location.hash").split("&")),
             "link: the address does not have the place")
    address = browser.run("location.hash")
    browser.asynchronous("calotte.idle()")
    shown, picture = browser.run(STATE), browser.asynchronous("calotte.pixels()")["checksum"]
    check(shown != first and "marked" in shown[1], f"link: {shown}")
    browser.driver.get("about:blank")
    browser.open(page, address)
    wait_for(lambda: browser.run(STATE) == shown, f"link: {address} does not open {shown}")
    check(browser.asynchronous("calotte.pixels()")["checksum"] == picture, f"link: {address} opens another picture")
    browser.run("location.hash = ''")
    wait_for(lambda: browser.run(STATE) == first, f"link: an empty address does not show {first}")
    for bad in ("#", "#x", "#at=1,2", "#at=,,", "#at=NaN,0,1", "#at=1,2,-3", "#mark=quality,2,1",
                "#measure=nothing&shapes=squares&show=some&cell=99999999", "#mark=quality", "#show=marked",
                "#mark=nothing,1,2&mark=quality,0,1", "#cell=-1&state=9",
                "#mark=" + "a" * 10000, "#%", "#measure=<b>&palette=<b>&log=2&fit=x"):
        browser.driver.get("about:blank")
        browser.open(page, bad)
        check(browser.run(STATE) == first, f"link: {bad[:60]} shows {browser.run(STATE)}")
        check(browser.asynchronous("calotte.pixels()")["checksum"] == opened, f"link: {bad[:60]} shows another picture")
        pages.check_quiet(f"link {bad[:60]}")
    page = pages.open("linked", "plane.nc", "--plane", "--rectangle", "0,0,2,1")
    browser.run("calotte.turn(0.5, 0.25, 4)")
    wait_for(lambda: "at=0.5,0.25,4" in browser.run("location.hash"), "link: not of a plane")


def test_saving(pages):
    """The picture, and the marked cells with positions and measures."""
    browser = pages.browser
    pages.open("save", "x8.nc")
    browser.save_to(".")
    browser.run("document.getElementById('save-picture').click()")
    picture = pathlib.Path("x8.png")
    wait_for(picture.exists, "save: no picture")
    check(picture.read_bytes()[:8] == b"\x89PNG\r\n\x1a\n", "save: not a PNG")
    tall = int.from_bytes(picture.read_bytes()[20:24], "big")
    canvas = browser.run("document.getElementById('canvas').height")
    check(tall == 62 + canvas, f"save: the picture is {tall} pixels tall, the canvas {canvas}")
    check(browser.run("document.getElementById('marks-save').hidden"), "save: nothing is marked")
    count = browser.asynchronous("calotte.brush('degree', 4.5, 5.5)")
    browser.run("document.getElementById('marks-save').click()")
    table = pathlib.Path("x8-cells.csv")
    wait_for(table.exists, "save: no table")
    head, *rows = [line.split(",") for line in table.read_text().splitlines()]
    check(head[:4] == ["cell", "longitude", "latitude", "spacing (km)"], f"save: {head}")
    data = netCDF4.Dataset("x8.nc")
    ids = [int(row[0]) for row in rows]
    check(ids == list(numpy.flatnonzero(data["nEdgesOnCell"][:] == 5)) and len(ids) == count, f"save: {len(ids)} cells")
    longitudes = numpy.degrees(data["lonCell"][ids])
    difference = (numpy.array([float(row[1]) for row in rows]) - longitudes + 180) % 360 - 180
    check(abs(difference).max() < 1e-4, f"save: longitudes are {abs(difference).max()} away")
    latitudes = numpy.array([float(row[2]) for row in rows])
    check(abs(latitudes - numpy.degrees(data["latCell"][ids])).max() < 1e-4, "save: latitudes")
    check(all(row[head.index("neighbours")] == "5" for row in rows), "save: neighbours")
    pages.check_quiet("save")
    pages.open("names", "foreign.nc")
    check("a<img src=x onerror=alert(1)>" in browser.asynchronous("calotte.csv()").splitlines()[0], "save: names")


def test_fit(pages):
    """The colours span what is in sight, and follow it."""
    browser = pages.browser
    pages.open("fit", "x8.nc")

    def ticks():
        return browser.run("[...document.querySelectorAll('#histogram .tick text')].map(e => Number(e.textContent))")

    check(max(ticks()) >= 200, f"fit: {ticks()}")
    browser.run("calotte.turn(-90, 35, 20)")
    browser.run("document.getElementById('fit').click()")
    wait_for(lambda: max(ticks()) < 60, "fit: the colours span more than is in sight")
    browser.run("calotte.turn(90, -30, 20)")
    wait_for(lambda: min(ticks()) > 200, "fit: the colours do not follow")
    browser.run("document.getElementById('fit').click()")
    wait_for(lambda: min(ticks()) < 60, "fit: it does not end")
    pages.check_quiet("fit")


def test_keys(pages):
    """A list of all keys, by a button and by a key; each key that the page knows is in it."""
    browser = pages.browser
    pages.open("list", "uniform.nc")
    shown = "document.getElementById('keys').open"
    browser.run("document.getElementById('keys-open').click()")
    check(browser.run(shown), "keys: the button shows no list")
    if folder := os.environ.get("CALOTTE_SCREENSHOTS"):
        browser.screenshot(pathlib.Path(folder) / "keys.png")
    text = browser.run("document.getElementById('keys-list').textContent")
    for key in ("arrow", "+", "-", "0", "n", "p", "Esc", "Shift", "?", "Wheel", "Drag", "Double"):
        check(key in text, f"keys: {key} is not in {text}")
    browser.press("\ue00c")  # Escape
    check(not browser.run(shown), "keys: Escape does not end the list")
    browser.press("?")
    check(browser.run(shown), "keys: ? shows no list")
    pages.check_quiet("list")


def test_narrow(pages):
    """On a telephone nothing is wider than the screen, and all controls are there."""
    browser = pages.browser
    browser.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                   {"width": 390, "height": 844, "deviceScaleFactor": 2, "mobile": True})
    try:
        pages.open("narrow", "x8.nc", "--most-cells", "4000")
        check(browser.run("document.documentElement.scrollWidth") <= 390, "narrow: the page is wider than the screen")
        find(browser, "-33.86, 151.21")
        outside = browser.run("[...document.querySelectorAll('button, input, select, #find-answer')].filter(e => {"
                              "const {left, right} = e.getBoundingClientRect(); return right > 390.5 || left < 0; })"
                              ".map(e => e.id)")
        check(not outside, f"narrow: outside are {outside}")
    finally:
        browser.driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})


def test_part(pages):
    """A page of a part of the cells shows true cells, with their true neighbours, or dots."""
    pages.open("whole", "x8.nc")
    worst = {name: pages.browser.asynchronous("calotte.worst(arguments[0])", name)
             for name in ("quality", "angle", "dc_h_least", "spacing")}
    pages.open("part", "x8.nc", "--most-cells", "4000", "--view", "-90,30")
    for name, ids in worst.items():
        check(pages.browser.asynchronous("calotte.worst(arguments[0])", name) == ids, f"part: other worst by {name}")
    data = netCDF4.Dataset("x8.nc")
    sides, around = data["nEdgesOnCell"][:], data["cellsOnCell"][:] - 1
    seen, next_ones, whole = set(), [], 0
    pages.browser.run("(calotte.turn(-90, 30, 20), calotte.clickAt(-90, 30))")
    next_ones = [pages.browser.asynchronous("calotte.idle().then(calotte.picked)")["cell"], *worst["quality"]]
    while next_ones and len(seen) < 300:
        cell = next_ones.pop(0)
        if cell in seen:
            continue
        seen.add(cell)
        found = pages.browser.asynchronous("calotte.pick(arguments[0])", cell)["neighbours"]
        if found:
            whole += 1
            check(sorted(found) == sorted(around[cell][:sides[cell]]), f"part: cell {cell} has neighbours {found}")
        next_ones += found
    check(whole > 200, f"part: {whole} cells of {len(seen)} have neighbours")
    pages.browser.run("calotte.turn(90, -30, 20)")
    colours = pages.browser.asynchronous("calotte.coloursAt(arguments[0])",
                                         [[90 + x / 4, -30 + y / 4] for x in range(-8, 8) for y in range(-8, 8)])
    globe = max(colours, key=colours.count)
    check(colours.count(globe) > 128, "part: cells without shapes cover the globe")
    for name in ("obtuse", "all"):
        pages.browser.asynchronous("calotte.filter(arguments[0])", name)
    check(pages.browser.run("[...document.getElementById('filter').options].find(o => o.value === 'pairs').disabled"),
          "part: pairs of neighbours are looked for")
    pages.browser.asynchronous("calotte.shapes('triangles')")
    pages.browser.run("calotte.turn(-90, 30, 2)")
    pages.check_picture("part, triangles")
    answer, picked = find(pages.browser, "10.5, -30")
    check("--view -30,10.5 has them" in answer and not picked["neighbours"], f"part: {answer} {picked}")
    pages.check_quiet("part")


def test_far_ocean(pages):
    """Cells smaller than a pixel, drawn as squares, do not cover land."""
    land = [[x, -40] for x in range(-40, 40, 2)] + [[40, y] for y in range(-40, 40, 2)]
    land += [[-x, -y] for x, y in land]
    pathlib.Path("land.geojson").write_text(json.dumps({"type": "Polygon", "coordinates": [land + land[:1]]}))
    pages.calotte("points", "fibonacci", "200000", "-o", "fibonacci.txt")
    pages.calotte("delaunay", "fibonacci.txt", "-o", "fibonacci.nc")
    pages.calotte("cull", "fibonacci.nc", "--land", "land.geojson", "-o", "sea.nc")
    pages.open("sea", "sea.nc", "--no-coastlines")
    inner = 38.5  # two cells and a pixel from the coast
    places = [[sign * x, turn * y] for sign in (-1, 1) for turn in (-1, 1) for k in range(150)
              for x, y in ((k / 4, inner), (inner, k / 4))]
    for zoom in (0.5, 1):
        pages.browser.run("calotte.turn(0, 0, arguments[0])", zoom)
        colours = pages.browser.asynchronous("calotte.coloursAt(arguments[0])", [[0, 0], [60, 0], *places])
        check(colours[0] != colours[1], f"sea: land and sea have the colour {colours[0]}")
        covered = [place for place, colour in zip(places, colours[2:]) if colour != colours[0]]
        check(not covered, f"sea: cells cover land at {covered}, zoom {zoom}")
        seen = pages.browser.asynchronous("calotte.coloursAt(arguments[0])",
                                          [[48, y] for y in range(-40, 41, 5)])
        check(colours[0] not in seen, f"sea: gaps between the cells, zoom {zoom}")


def test_triangles_beside_polygons(pages):
    """A mesh without triangles beside one that has them, in all measures and filters."""
    pages.open("beside", "random.vtp", "ring.geojson")
    for measure in pages.browser.run("[...document.getElementById('measure').options].map(o => o.value)"):
        for name in ("obtuse", "pairs", "all"):
            pages.browser.asynchronous("calotte.measure(arguments[0])", measure)
            pages.browser.asynchronous("calotte.filter(arguments[0])", name)
        pages.check_quiet(f"beside, {measure}")


def test_plan(pages):
    pages.open("plan", "--plan", "--cells", "40962", "--density", X8)
    pages.check_picture("plan")


def test_keyboard_and_table(pages):
    """Keys turn the globe; a screen reader finds a table of the numbers, labels and messages."""
    pages.open("keys", "uniform.nc")
    before = pages.browser.run("calotte.pixels()")["checksum"]
    pages.browser.run("document.querySelector('canvas').dispatchEvent("
                      "new KeyboardEvent('keydown', {key: 'ArrowLeft', bubbles: true}))")
    pages.browser.run("calotte.frame()")
    check(pages.browser.run("calotte.pixels()")["checksum"] != before, "keys: an arrow does not turn the globe")
    rows = pages.browser.run("document.querySelectorAll('table tbody tr').length")
    check(rows >= 9, f"keys: the tables have {rows} rows")
    check(pages.browser.run("document.querySelector('[aria-live]') !== null"), "keys: no live region")
    unlabelled = pages.browser.run(
        "[...document.querySelectorAll('input, select, button, canvas')].filter(e => !(e.labels?.length "
        "|| e.getAttribute('aria-label') || e.getAttribute('aria-labelledby') || e.textContent.trim() || e.title))"
        ".map(e => e.outerHTML)")
    check(not unlabelled, f"keys: without a label: {unlabelled}")


def main(path):
    calotte = Command(os.path.abspath(path))
    missing = Browser is None or not (os.path.exists("/usr/bin/chromium") and os.path.exists("/usr/bin/chromedriver"))
    if missing:
        print("chromium, chromium-driver, python3-selenium or python3-netcdf4 is not installed")
        sys.exit(1 if os.environ.get("CALOTTE_CLIENTS") == "required" else SKIPPED)
    tests = [test_grid, test_limited_area, test_plane, test_periodic, test_foreign, test_small_and_random,
             test_polygon_of_many_sides, test_two_and_states, test_finding, test_places, test_link, test_saving,
             test_fit, test_keys, test_narrow, test_part, test_far_ocean, test_triangles_beside_polygons, test_plan,
             test_keyboard_and_table]
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        make_meshes(calotte)
        with Browser() as browser:
            for test in tests:
                test(Pages(calotte, browser))
                print(f"{test.__name__}: passed", flush=True)


if __name__ == "__main__":
    main(sys.argv[1])
