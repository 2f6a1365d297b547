# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the library and the compiled part of the package with CMake.

With CALOTTE_PREFIX in the environment the build uses the library that is installed there.
"""
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
PARTS = ["CMakeLists.txt", "README.md", "cmake", "include", "lib"]  # of the library, for one


def version():
    text = (LIBRARY / "include/calotte/version.h").read_text()
    return re.search(r'CALOTTE_VERSION "([^"]+)"', text).group(1)


class CMakeBuild(build_ext):
    """One extension, made by CMakeLists.txt."""

    def build_extension(self, extension):
        module = pathlib.Path(self.get_ext_fullpath(extension.name)).resolve()
        build = pathlib.Path(self.build_temp).resolve()
        settings = ["-DCMAKE_BUILD_TYPE=Release", f"-DPython_EXECUTABLE={sys.executable}",
                    f"-DCALOTTE_LIBRARY={LIBRARY}", f"-DCALOTTE_MODULE_DIR={module.parent}"]
        prefix = os.environ.get("CALOTTE_PREFIX")
        if prefix:
            settings.append(f"-DCALOTTE_PREFIX={pathlib.Path(prefix).resolve()}")
        if shutil.which("ninja"):
            settings.append("-GNinja")
        subprocess.run(["cmake", "-S", HERE, "-B", build, *settings], check=True)
        jobs = self.parallel or os.cpu_count() or 1
        subprocess.run(["cmake", "--build", build, "--parallel", str(jobs)], check=True)


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


setup(version=version(), ext_modules=[Extension("calotte._calotte", sources=[])],
      cmdclass={"build_ext": CMakeBuild, "sdist": SourceDistribution})
