# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the compiled part of the package with CMake, and the library with it where there is none.

The library is, in this order: the one that is installed in CALOTTE_PREFIX; in a clone, the one that
tools/quickstart built in build/release; one of the same version where CMake looks for packages; or
else it is built from its sources, which takes minutes of all cores: the first line says so.
"""
import contextlib
import importlib
import os
import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext
from setuptools.command.sdist import sdist

HERE = pathlib.Path(__file__).resolve().parent
BUNDLED = HERE / "library"  # in a source distribution
LIBRARY = BUNDLED if BUNDLED.is_dir() else HERE.parents[1]
PARTS = ["CMakeLists.txt", "README.md", "cmake", "include", "lib", "tools/draw/draw.h",
         "tools/draw/coastlines.h", "tools/draw/coastlines.cpp"]  # of the library, for one
BUILT = LIBRARY / "build/release"  # by tools/quickstart
SECONDS = {"package": 85, "library": 880}  # of one processor, in 2026
REMEDY = "on Debian 12 tools/setup --python of the source tree installs what a build needs"


def version():
    text = (LIBRARY / "include/calotte/version.h").read_text()
    return re.search(r'CALOTTE_VERSION "([^"]+)"', text).group(1)


def require_wheel():
    """Pip's own message, \"invalid command 'bdist_wheel'\", names neither the package nor a remedy."""
    if not {"bdist_wheel", "dist_info", "editable_wheel"} & set(sys.argv):
        return
    for module in ("setuptools.command.bdist_wheel", "wheel.bdist_wheel"):
        try:
            importlib.import_module(module)
            return
        except ImportError:
            pass
    sys.exit(f"calotte: {sys.executable} lacks the package wheel; leave --no-build-isolation out, "
             "so that pip fetches it, or install it for this interpreter, or make the environment "
             "with the one that tools/setup --python serves: /usr/bin/python3 -m venv "
             "--system-site-packages env")


def setting(name):
    """A value of the cache of build/release."""
    match = re.search(rf"^{name}:\w+=(.*)$", (BUILT / "CMakeCache.txt").read_text(), re.M)
    return match.group(1) if match else ""


def built_library(folder):
    """Installs the archive of build/release, brought up to date, in a folder; None without one."""
    if not (BUILT / "libcalotte.a").is_file() or setting("BUILD_SHARED_LIBS") in ("ON", "TRUE"):
        return None
    subprocess.run(["cmake", "--build", BUILT, "--target", "calotte"], check=True)
    subprocess.run(["cmake", "--install", BUILT, "--component", "development", "--prefix", folder],
                   check=True, stdout=subprocess.DEVNULL)
    return folder


def tell(text):
    """Says it in the output of the build, which pip shows after a failure and with --verbose, and on the terminal."""
    print(f"calotte: {text}", file=sys.stderr, flush=True)
    with contextlib.suppress(OSError), open("/dev/tty", "w", encoding="utf-8") as terminal:
        terminal.write(f"\ncalotte: {text}\n")


def minutes(seconds, jobs):
    return f"about {max(1, round(seconds / jobs / 60))} min on {jobs} processors"


def announce(jobs):
    """What the build compiles, and how long that takes."""
    if os.environ.get("CALOTTE_PREFIX") or (BUILT / "libcalotte.a").is_file():
        tell(f"compiles the package, {minutes(SECONDS['package'], jobs)}")
    else:
        tell(f"compiles the package and, unless CMake finds it installed, the library in C++, "
             f"{minutes(sum(SECONDS.values()), jobs)}; a wheel needs no compiler (tools/package --wheel)")


def require_programs():
    """Fails before any work where the build has no compiler or no CMake."""
    compilers = [os.environ.get("CXX", "").split(" ")[0], "c++", "g++", "clang++"]
    for program, found in (("cmake", shutil.which("cmake")),
                           ("C++ compiler", any(shutil.which(name) for name in compilers if name))):
        if not found:
            sys.exit(f"calotte: there is no {program}, and the package is compiled; {REMEDY}")


class CMakeBuild(build_ext):
    """One extension, made by CMakeLists.txt."""

    def build_extension(self, extension):
        jobs = self.parallel or os.cpu_count() or 1
        require_programs()
        announce(jobs)
        module = pathlib.Path(self.get_ext_fullpath(extension.name)).resolve()
        kept = os.environ.get("CALOTTE_BUILD")
        build = pathlib.Path(kept or self.build_temp).resolve()
        settings = ["-DCMAKE_BUILD_TYPE=Release", "-DCALOTTE_BATCHES=ON",
                    f"-DPython_EXECUTABLE={sys.executable}", f"-DCALOTTE_LIBRARY={LIBRARY}",
                    f"-DCALOTTE_MODULE_DIR={module.parent}"]
        prefix = os.environ.get("CALOTTE_PREFIX") or built_library(build.parent / "library")
        if prefix:
            settings.append(f"-DCALOTTE_PREFIX={pathlib.Path(prefix).resolve()}")
        try:  # that of the interpreter, if it has one
            import pybind11
            settings.append(f"-Dpybind11_DIR={pybind11.get_cmake_dir()}")
        except ImportError:
            pass
        if shutil.which("ninja"):
            settings.append("-GNinja")
        fresh = [] if kept else ["--fresh"]
        if subprocess.run(["cmake", *fresh, "-S", HERE, "-B", build, *settings]).returncode != 0:
            sys.exit(f"calotte: CMake does not find what the lines above name; {REMEDY}")
        if subprocess.run(["cmake", "--build", build, "--parallel", str(jobs)]).returncode != 0:
            sys.exit("calotte: the package does not compile; the first error is above, after the line FAILED")


class SourceDistribution(sdist):
    """Holds the library's sources, too."""

    def make_release_tree(self, base_dir, files):
        super().make_release_tree(base_dir, files)
        for part in PARTS:
            source, target = LIBRARY / part, pathlib.Path(base_dir) / "library" / part
            if source.is_dir():
                shutil.copytree(source, target)
            else:
                target.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy2(source, target)


require_wheel()
setup(version=version(), ext_modules=[Extension("calotte._calotte", sources=[])],
      cmdclass={"build_ext": CMakeBuild, "sdist": SourceDistribution})
