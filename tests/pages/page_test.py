# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the examples of README.md or of a page of the manual: page_test.py PROJECT PAGE BUILD SCRATCH SITE.

The scratch folder looks like a clone after tools/quickstart: build/release is the build tree, and
tools/examples is a copy. The blocks become one script, which stops at the first failure. First it writes the
files, as a page may show a file after the command that reads it:

- sh: the commands as they are;
- console: commands after "$ ", each of which must print the lines that follow it. Its exit code is free;
- text: nothing;
- of other languages: the file that the line before the block names.

SITE is where the Python package is installed, in place of README's environment; without it, its program
is not run. Lines that start a script of tools/ are not run: the script must exist and parse."""

import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

# A line that names the file whose content the next block is, and a block.
BLOCK = re.compile(r"(?:`(?P<file>[\w./]+)`:\n\n)?^```(?P<language>\w+)\n(?P<text>.*?)^```$", re.M | re.S)
SCRIPT = re.compile(r"^(tools/\w+)\b.*$", re.M)
INSTALLING = re.compile(r"^((?:/usr/bin/)?python3 -m venv|env/bin/pip)\b.*$", re.M)
INSTALLED = re.compile(r"^env/bin/python\b", re.M)
FILES = {"c", "cpp", "cmake", "python", "toml", "json", "ini"}
START = """set -euo pipefail
export PATH=$PWD/build/release/tools:$PATH COLUMNS=80
trap 'echo "{page}: this command failed: $BASH_COMMAND" >&2' ERR
prints() {{ # EXPECTED COMMAND: runs the command, which must print the text
  local printed
  printed=$(eval "$2" 2>&1) || true
  [[ $printed == "$1" ]] || {{ printf '{page}: %s\\nprints\\n%s\\ninstead of\\n%s\\n' "$2" "$printed" "$1" >&2; exit 1; }}
}}
"""


def make_scratch(project, build, scratch):
    shutil.rmtree(scratch, ignore_errors=True)
    (scratch / "build").mkdir(parents=True)
    (scratch / "build/release").symlink_to(build)
    shutil.copytree(project / "tools/examples", scratch / "tools/examples")


def file_of(page, block):
    """Shell that writes a block to its file."""
    if block["file"] is None:
        sys.exit(f"{page}: no line before this block names its file:\n{block['text']}")
    file = shlex.quote(block["file"])
    return f"mkdir -p $(dirname {file})\nprintf %s {shlex.quote(block['text'])} >{file}\n"


def console_of(page, text):
    """Shell that runs the commands of a block and compares what they print."""
    parts = re.split(r"^\$ ", text, flags=re.M)
    if parts[0] or len(parts) < 2:
        sys.exit(f"{page}: a console block begins with \"$ \":\n{text}")
    shell = ""
    for part in parts[1:]:
        command, _, printed = part.partition("\n")
        shell += f"prints {shlex.quote(printed.rstrip())} {shlex.quote(command)}\n"
    return shell


def shell_of(project, site, text):
    """The text without the scripts of tools/, which are parsed here, and with the package in SITE."""
    for name in SCRIPT.findall(text):
        subprocess.run(["bash", "-n", project / name], check=True)
    python = f"PYTHONPATH={site} {sys.executable}" if (site / "calotte").is_dir() else "true"
    return INSTALLED.sub(python, INSTALLING.sub("", SCRIPT.sub("", text)))


def main(project, page, build, scratch, site):
    blocks = list(BLOCK.finditer(page.read_text()))
    make_scratch(project, build, scratch)
    files, shell = "", ""
    for block in blocks:
        language = block["language"]
        if language == "sh":
            shell += shell_of(project, site, block["text"])
        elif language == "console":
            shell += console_of(page.name, block["text"])
        elif language in FILES:
            files += file_of(page.name, block)
        elif language != "text":
            sys.exit(f"{page.name}: a block of the unknown language {language}")
    script = scratch / "examples.sh"
    script.write_text(START.format(page=page.name) + files + shell)
    result = subprocess.run(["bash", script], cwd=scratch, check=False)
    if result.returncode == 0:
        print(f"{page.name}: all {len(blocks)} blocks work")
    return result.returncode


if __name__ == "__main__":
    sys.exit(main(*(Path(argument).resolve() for argument in sys.argv[1:])))
