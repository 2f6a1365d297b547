#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes a Python wheel of a folder that tools/package --portable made.

    wheel.py FOLDER INTERPRETER OUTPUT

The wheel holds the package, its compiled part for the interpreter, and the command with its
libraries. These get names of their own: a process has one library of a name, and another package's
oneTBB may be older.
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import bundle
from bundle import run

HERE = pathlib.Path(__file__).resolve().parent
PROJECT = HERE.parents[2]


def compiled_part(folder, interpreter, suffix, build):
    """Builds the module, whose name ends with the suffix, with the folder's library. Returns its path."""
    archives = PROJECT / "build/portable/libraries/lib"
    modules = build / "module"
    shutil.rmtree(modules, ignore_errors=True)
    settings = {"CMAKE_BUILD_TYPE": "Release", "CALOTTE_BATCHES": "ON", "CALOTTE_PREFIX": folder,
                "CALOTTE_LIBRARY": PROJECT, "CALOTTE_MODULE_DIR": modules,
                "Python_EXECUTABLE": interpreter,
                "CMAKE_CXX_STANDARD_LIBRARIES": archives / "libolder_systems.a",
                "CMAKE_MODULE_LINKER_FLAGS": "-Wl,--exclude-libs,ALL"}
    found = subprocess.run([interpreter, "-m", "pybind11", "--cmakedir"], text=True,
                           capture_output=True)
    if found.returncode == 0:
        settings["pybind11_DIR"] = found.stdout.strip()
    run("cmake", "-G", "Ninja", "-S", PROJECT / "tools/python", "-B", build, "-Wno-dev",
        *(f"-D{name}={value}" for name, value in settings.items()))
    subprocess.run(["cmake", "--build", build], check=True)
    return modules / f"_calotte{suffix}"


def rename_libraries(libraries, binaries):
    names = {path.name: re.sub(r"^(\w+)", r"\1-calotte", path.name) for path in libraries}
    for path in libraries:
        run("patchelf", "--set-soname", names[path.name], path)
    for binary in binaries:
        for old, new in names.items():
            run("patchelf", "--replace-needed", old, new, binary)
    for path in libraries:
        path.rename(path.with_name(names[path.name]))


def metadata(version):
    project = (PROJECT / "tools/python/pyproject.toml").read_text()

    def value(key):
        return re.search(rf'^{key} = "(.*)"$', project, re.M)[1]
    return "\n".join(["Metadata-Version: 2.1", "Name: calotte", f"Version: {version}",
                      f"Summary: {value('description')}", "License: GPL-3.0-or-later",
                      f"Requires-Python: {value('requires-python')}", "Requires-Dist: numpy",
                      "Description-Content-Type: text/markdown", "",
                      (PROJECT / "tools/python/README.md").read_text()])


def main(folder, interpreter, output):
    interpreter, tag, suffix = run(
        interpreter, "-c", "import sys, sysconfig; print(sys.executable, 'cp%d%d' % "
        "sys.version_info[:2], sysconfig.get_config_var('EXT_SUFFIX'), sep='\\n')").splitlines()
    version, machine = re.fullmatch(r"calotte-(.*)-linux-(\w+)", folder.name).groups()
    module = compiled_part(folder.resolve(), interpreter, suffix, output.resolve() / f"python-{tag}")
    with tempfile.TemporaryDirectory() as temporary:
        root = pathlib.Path(temporary)
        package = root / "calotte"
        shutil.copytree(PROJECT / "tools/python/calotte", package,
                        ignore=shutil.ignore_patterns("__pycache__", "*.so"))
        shutil.copy(HERE / "calotte_command.py", root)
        for name in ("bin", "libexec"):
            shutil.copytree(folder / name, package / name)
        (package / "lib").mkdir()
        needed = {name for binary in bundle.binaries(folder) for name in bundle.needed(binary)}
        libraries = [pathlib.Path(shutil.copy(path, package / "lib"))
                     for path in (folder / "lib").glob("*.so.*") if path.name in needed]
        shutil.copy(module, package)
        module = package / module.name
        run("strip", "--strip-unneeded", module)
        run("patchelf", "--force-rpath", "--set-rpath", "$ORIGIN/lib", module)
        rename_libraries(libraries, [*libraries, package / "bin/calotte", module])
        bundle.check_symbols(package)

        info = root / f"calotte-{version}.dist-info"
        shutil.copytree(folder / "share/doc/calotte/licences", info / "licenses")
        shutil.copy(PROJECT / "LICENSE", info / "licenses")
        (info / "METADATA").write_text(metadata(version))
        (info / "entry_points.txt").write_text("[console_scripts]\n"
                                               "calotte = calotte_command:main\n")
        (info / "WHEEL").write_text("Wheel-Version: 1.0\nGenerator: calotte\n"
                                    "Root-Is-Purelib: false\n"
                                    f"Tag: {tag}-{tag}-manylinux_2_34_{machine}\n")
        run("/usr/bin/python3", "-m", "wheel", "pack", root, "--dest-dir", output)
    name = f"calotte-{version}-{tag}-{tag}-manylinux_2_34_{machine}.whl"
    print(f"wheel: {output / name}, {(output / name).stat().st_size} bytes")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]), sys.argv[2], pathlib.Path(sys.argv[3]))
