# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks what packages and workflows say about the project: packaging_test.py PROJECT.

All name one version. Workflows parse. Presets, steps of tools/test and scripts that they name exist, and so do the
options of CMake that presets name. Links between Markdown files lead to files."""

import json
import re
import sys
from pathlib import Path

try:
    import yaml
except ImportError:
    print("skipped: python3-yaml is not installed; tools/setup --tests installs it")
    sys.exit(77)

faults = []


def require(condition, fault):
    if not condition:
        faults.append(fault)


def check_versions(project):
    version = re.search(r'CALOTTE_VERSION "(.+)"', (project / "include/calotte/version.h").read_text())[1]
    for file, text in {
            "CMakeLists.txt": f"project(calotte VERSION {version} ",
            "CITATION.cff": f"\nversion: {version}\n",
            ".github/CHANGELOG.md": f"\n## {version} (",
            "tools/manual/index.md": f"\ncalotte {version}\n"}.items():
        require(text in (project / file).read_text(), f"{file} does not name version {version}")
    for file in ["README.md", "tools/manual/install.md"]:
        named = set(re.findall(r"calotte[-:_](\d+\.\d+\.\d+)", (project / file).read_text()))
        require(named == {version}, f"{file} names packages of version {sorted(named)}")


def check_presets(project):
    options = set(re.findall(r"CALOTTE_\w+", "".join(
        (project / file).read_text() for file in
        ["CMakeLists.txt", "cmake/packaging.cmake", "cmake/debian.cmake", "tools/CMakeLists.txt"])))
    presets = json.loads((project / "CMakePresets.json").read_text())
    for preset in presets["configurePresets"]:
        for name in preset.get("cacheVariables", {}):
            require(not name.startswith("CALOTTE_") or name in options,
                    f"preset {preset['name']}: CMake has no option {name}")


def check_workflows(project):
    presets = {preset["name"] for preset in json.loads((project / "CMakePresets.json").read_text())["configurePresets"]}
    steps = re.search(r"^    ([\w |-]+)\) ;;$", (project / "tools/test").read_text(), re.M)[1].split(" | ")
    for file in sorted((project / ".github").glob("**/*.yml")):
        text = file.read_text()
        content = yaml.safe_load(text)
        if file.parent.name != "workflows":
            continue
        runs = [step["run"] for job in content["jobs"].values() for step in job["steps"] if "run" in step]
        for run in runs:
            for name in re.findall(r"--preset (\w+)", run):
                require(name in presets, f"{file.name}: no preset {name}")
            for name in re.findall(r"(?:^|&& )(tools/\w+)", run, re.M):
                require((project / name).exists(), f"{file.name}: no script {name}")
            for words in re.findall(r"tools/test ([a-z ]+)$", run, re.M):
                for name in words.split():
                    require(name in steps, f"{file.name}: tools/test has no step {name}")
        for uses in re.findall(r"uses: (\S+)", text):
            require(re.fullmatch(r"actions/[\w-]+@v\d+", uses), f"{file.name}: {uses} names no version")


def check_links(project):
    files = [*project.glob("*.md"), *project.glob(".github/*.md"), *project.glob("tools/**/*.md"), project / "lib/README.md"]
    for file in files:
        text = re.sub(r"```.*?```", "", file.read_text(), flags=re.S)  # a lambda in C++ is no link
        for link in re.findall(r"\]\(([^)#]+?)(?:#[^)]*)?\)", text):
            made = file.parent.name == "manual" and link.endswith(".png")  # by the page's examples
            require(made or "://" in link or (file.parent / link).exists(), f"{file.name}: {link} does not exist")


project = Path(sys.argv[1]).resolve()
for check in (check_versions, check_presets, check_workflows, check_links):
    check(project)
if faults:
    sys.exit("\n".join(faults))
print("versions, presets, workflows and links agree")
