# SPDX-License-Identifier: GPL-3.0-or-later
"""What setup.py says where the interpreter of an environment lacks a package."""
import pathlib
import subprocess
import sys

SETUP = pathlib.Path(__file__).resolve().parents[2] / "tools/python/setup.py"
WITHOUT = """\
import runpy, sys
for name in ("setuptools.command.bdist_wheel", "wheel", "wheel.bdist_wheel"):
    sys.modules[name] = None
sys.argv = ["setup.py", *{words}]
runpy.run_path("{setup}", run_name="__main__")
"""


def test_a_missing_wheel_is_named_with_the_interpreter(tmp_path):
    for words in (["bdist_wheel"], ["dist_info"]):
        result = subprocess.run([sys.executable, "-c", WITHOUT.format(words=words, setup=SETUP)],
                                capture_output=True, text=True, cwd=tmp_path)
        assert result.returncode != 0
        assert result.stderr.strip().split("\n")[-1].startswith(
            f"calotte: {sys.executable} lacks the package wheel; ")
        assert "invalid command" not in result.stderr


def test_a_missing_compiler_is_told_before_any_work(tmp_path):
    for programs, text in (([], "there is no cmake"), (["cmake"], "there is no C++ compiler")):
        folder = tmp_path / "bin"
        folder.mkdir(exist_ok=True)
        for program in programs:
            (folder / program).write_text("#!/bin/sh\n")
            (folder / program).chmod(0o755)
        result = subprocess.run([sys.executable, SETUP, "build_ext", "--build-temp", tmp_path / "b", "--build-lib", tmp_path],
                                capture_output=True, text=True, cwd=tmp_path, env={"PATH": str(folder)})
        last = result.stderr.strip().split("\n")[-1]
        assert result.returncode != 0 and last.startswith(f"calotte: {text}, and the package is compiled; on Debian 12")
    assert not (tmp_path / "b").exists()
