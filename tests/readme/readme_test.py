# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the examples of README.md as a user does: readme_test.py README BUILD SCRATCH SITE.

The scratch folder looks like a clone after tools/quickstart: build/release is the build tree, and
tools/examples is a copy. The blocks of other languages become the files that README names, then all sh
blocks run as one script that stops at the first failure. SITE is where the Python package is installed,
in place of README's environment; without it, its program is not run. Lines that start a script of tools/ are not run: the
script must exist and parse."""

import re
import shutil
import subprocess
import sys
from pathlib import Path

# A line of README that names the file whose content the next block is.
BLOCK = re.compile(r"(?:`(?P<file>[\w./]+)`:\n\n)?^```(?P<language>\w+)\n(?P<text>.*?)^```$", re.M | re.S)
SCRIPT = re.compile(r"^(tools/\w+)\b.*$", re.M)
INSTALLING = re.compile(r"^(python3 -m venv|env/bin/pip)\b.*$", re.M)
INSTALLED = re.compile(r"^env/bin/python\b", re.M)
ON_FAILURE = "trap 'echo \"README.md: this command failed: $BASH_COMMAND\" >&2' ERR\n"


def make_scratch(project, build, scratch):
    shutil.rmtree(scratch, ignore_errors=True)
    (scratch / "build").mkdir(parents=True)
    (scratch / "build/release").symlink_to(build)
    shutil.copytree(project / "tools/examples", scratch / "tools/examples")


def write_block(scratch, block):
    """Writes a block with the content of a file."""
    if block["file"] is None:
        sys.exit(f"README.md: no line before this block names its file:\n{block['text']}")
    file = scratch / block["file"]
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(block["text"])


def shell_of(project, site, text):
    """The text without the scripts of tools/, which are parsed here, and with the package in SITE."""
    for name in SCRIPT.findall(text):
        subprocess.run(["bash", "-n", project / name], check=True)
    python = f"PYTHONPATH={site} {sys.executable}" if (site / "calotte").is_dir() else "true"
    return INSTALLED.sub(python, INSTALLING.sub("", SCRIPT.sub("", text)))


def main(readme, build, scratch, site):
    project = readme.parent
    blocks = list(BLOCK.finditer(readme.read_text()))
    languages = {block["language"] for block in blocks}
    if languages != {"sh", "cpp", "cmake", "python"}:
        sys.exit(f"README.md: expected blocks of sh, cpp, cmake and python, found {sorted(languages)}")
    make_scratch(project, build, scratch)
    shell = ""
    for block in blocks:
        if block["language"] == "sh":
            shell += shell_of(project, site, block["text"])
        else:
            write_block(scratch, block)
    script = scratch / "examples.sh"
    script.write_text("set -euo pipefail\n" + ON_FAILURE + shell)
    result = subprocess.run(["bash", script], cwd=scratch, check=False)
    if result.returncode == 0:
        print(f"README.md: all {len(blocks)} blocks work")
    return result.returncode


if __name__ == "__main__":
    sys.exit(main(*(Path(argument).resolve() for argument in sys.argv[1:])))
