#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes a folder that was installed run by itself on other systems, wherever it is moved.

    bundle.py FOLDER PACKAGES

Copies into FOLDER/lib the shared libraries that its programs and libraries need, but for those of
the C and C++ compilers, and lets each find the others relative to itself. Puts into
FOLDER/share/doc/calotte/licences what holds for these libraries and for the Debian packages that
the file PACKAGES lists. Fails where anything needs a newer system than README.md promises.
"""
import pathlib
import re
import shutil
import subprocess
import sys

# The rules of manylinux_2_34 (PEP 600): what a system must bring, and how new it may be.
SYSTEM = re.compile(r"(libc|libm|libdl|librt|libpthread|libstdc\+\+|libgcc_s|ld-linux[-\w]*)\.so\.\d+")
NEWEST = {"GLIBC": (2, 34), "GLIBCXX": (3, 4, 29), "CXXABI": (1, 3, 13), "GCC": (7, 0, 0)}


def run(*command):
    return subprocess.run([str(word) for word in command], check=True, text=True, stdout=subprocess.PIPE).stdout


def binaries(folder):
    """The programs and shared libraries in a folder, but for links."""
    for path in sorted(folder.rglob("*")):
        if path.is_file() and not path.is_symlink() and path.open("rb").read(4) == b"\x7fELF":
            yield path


def needed(binary):
    return re.findall(r"NEEDED\s+(\S+)", run("objdump", "-p", binary))


def find(name):
    """The library that the linker of this system takes for a name."""
    path = pathlib.Path(run("gcc", f"-print-file-name={name}").strip())
    if not path.is_absolute():
        sys.exit(f"bundle: there is no library {name}")
    return path.resolve()


def copy_libraries(folder):
    """Copies what is missing. Returns where the copies come from."""
    sources = []
    pending = list(binaries(folder))
    while pending:
        for name in needed(pending.pop()):
            if SYSTEM.fullmatch(name) or (folder / "lib" / name).exists():
                continue
            sources.append(find(name))
            shutil.copy(sources[-1], folder / "lib" / name)
            pending.append(folder / "lib" / name)
    return sources


def relocate(folder):
    """Lets each binary find the libraries of the folder before those of LD_LIBRARY_PATH."""
    for binary in binaries(folder):
        binary.chmod(0o755)
        run("strip", "--strip-unneeded", binary)
        to_lib = pathlib.Path("$ORIGIN") / ("" if binary.parent.name == "lib" else "../lib")
        run("patchelf", "--force-rpath", "--set-rpath", to_lib, binary)


def check_symbols(folder):
    """Fails where a binary needs what neither the folder nor an older system has."""
    inside = {path.name for path in folder.rglob("*.so*")}
    too_new = []
    for binary in binaries(folder):
        too_new += [f"{binary.name}: the library {name}" for name in needed(binary)
                    if not SYSTEM.fullmatch(name) and name not in inside]
        for library, version, symbol in re.findall(r"\(?([A-Z]+)_([0-9.]+)\)?\s+(\S+)$",
                                                   run("objdump", "-T", binary), re.M):
            numbers = tuple(map(int, version.split(".")))
            if library in NEWEST and numbers > NEWEST[library]:
                too_new.append(f"{binary.name}: {symbol} of {library}_{version}")
    if too_new:
        sys.exit("bundle: not on other systems:\n" + "\n".join(too_new))


def copy_licences(folder, packages):
    licences = folder / "share/doc/calotte/licences"
    licences.mkdir(parents=True, exist_ok=True)
    for package in packages:
        shutil.copy(f"/usr/share/doc/{package}/copyright", licences / package)
    sources = run("dpkg-query", "--show", "--showformat=${source:Package} ${source:Version}\n",
                  *packages)
    (licences / "SOURCES").write_text("The sources of what is inside are these packages of Debian 12.\n\n"
                                      + "".join(sorted(set(sources.splitlines(True)))))
    for text in pathlib.Path("/usr/share/common-licenses").iterdir():  # to which these refer
        shutil.copy(text, licences)


def package_of(path):
    """The Debian package of a file, without its architecture."""
    return run("dpkg", "--search", path).split(":")[0]


def main(folder, packages):
    sources = copy_libraries(folder)
    relocate(folder)
    check_symbols(folder)
    copy_licences(folder, packages + [package_of(source) for source in sources])
    for binary in binaries(folder):
        print(f"bundle: {binary.relative_to(folder)}, {binary.stat().st_size / 1e6:.1f} MB")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]).read_text().split())
