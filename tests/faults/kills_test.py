#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A run of calotte cvt with checkpoints that is killed at random moments, and outputs into a folder that cannot be
written.

    kills_test.py CALOTTE

Each killed run resumes from its checkpoint to the same bits, and the resumed run leaves no temporary file.
CALOTTE_KILLS is the number of kills; default: 20. Prints a line of counts."""
import os
import random
import signal
import subprocess
import sys
import tempfile
import time

CALOTTE = os.path.abspath(sys.argv[1])
KILLS = int(os.environ.get("CALOTTE_KILLS", "20"))
RUN = ["cvt", "--cells", "2562", "--start", "random", "--method", "lloyd", "--iterations", "25", "--threads", "2"]
KEPT = ["--checkpoint", "c", "--checkpoint-every", "1", "-o", "g.nc"]
OUTPUTS = {"c", "g.nc", "g.graph.info"}


def check(truth, message):
    if not truth:
        sys.exit(f"FAILED: {message}")


def run(arguments, folder, **more):
    environment = dict(os.environ, CALOTTE_LOG_AFTER="1e9")
    return subprocess.run([CALOTTE, *arguments], cwd=folder, env=environment, capture_output=True, text=True,
                          check=False, **more)


def mesh(folder):
    with open(os.path.join(folder, "g.nc"), "rb") as file:
        return file.read()


def whole_run():
    """The mesh, and the seconds that the run takes."""
    with tempfile.TemporaryDirectory() as folder:
        begin = time.monotonic()
        result = run([*RUN, *KEPT], folder)
        check(result.returncode == 0, result.stderr)
        return mesh(folder), time.monotonic() - begin


def kill_and_resume(folder, seconds, good):
    """Kills a run after those seconds and resumes it; returns what was found in the folder: "no checkpoint", "done"
    (it ended before), "checkpoint" or "checkpoint, leftovers"."""
    with subprocess.Popen([CALOTTE, *RUN, *KEPT], cwd=folder, stdout=subprocess.DEVNULL,
                          stderr=subprocess.DEVNULL) as process:
        time.sleep(seconds)
        process.send_signal(signal.SIGKILL)
        ended = process.wait() == 0
    found = set(os.listdir(folder))
    leftovers = found - OUTPUTS
    check(all(".part" in name for name in leftovers), f"after {seconds} s: {leftovers}")
    if "g.nc" in found:
        check(mesh(folder) == good, f"killed after {seconds} s, the run leaves another mesh")
    again = ["cvt", "--resume", "c", *KEPT] if "c" in found else [*RUN, *KEPT]
    result = run(again, folder)
    check(result.returncode == 0, f"killed after {seconds} s, the run is not resumed: {result.stderr}")
    check(mesh(folder) == good, f"killed after {seconds} s, the run resumes to another mesh")
    check(set(os.listdir(folder)) <= OUTPUTS, f"the resumed run leaves {os.listdir(folder)}")
    if ended:
        return "done"
    return "no checkpoint" if "c" not in found else "checkpoint, leftovers" if leftovers else "checkpoint"


def check_kills():
    good, seconds = whole_run()
    moments, counts = random.Random(1), {}
    for _ in range(KILLS):
        with tempfile.TemporaryDirectory() as folder:
            found = kill_and_resume(folder, moments.uniform(0, seconds), good)
            counts[found] = counts.get(found, 0) + 1
    print(f"{KILLS} kills within {seconds:.2f} s, resumed to the same bits; found: " +
          ", ".join(f"{name} {count}" for name, count in sorted(counts.items())))


def check_read_only():
    """Nobody, as whom the superuser runs this, cannot write to the folder."""
    with tempfile.TemporaryDirectory() as top:
        os.chmod(top, 0o755)
        folder = os.path.join(top, "locked")
        os.mkdir(folder)
        check(run(["points", "random", "100", "-o", "p.txt"], folder).returncode == 0, "points")
        check(run(["delaunay", "p.txt", "-o", "m.nc"], folder).returncode == 0, "delaunay")
        before = sorted(os.listdir(folder))
        os.chmod(folder, 0o555)
        user = {"user": 65534} if os.geteuid() == 0 else {}
        for arguments in [["delaunay", "p.txt", "-o", "o.vtp"], ["delaunay", "p.txt", "-o", "m.nc"],
                          ["convert", "m.nc", "o.geojson"], ["convert", "m.nc", "SaveVertices"],
                          ["cvt", "--cells", "42", "--iterations", "1", "-o", "o.nc"]]:
            result = run(arguments, folder, **user)
            check(result.returncode == 3 and result.stderr.startswith("calotte: cannot write ") and
                  result.stderr.count("\n") == 1, f"{arguments}: {result.returncode} {result.stderr}")
            check(sorted(os.listdir(folder)) == before, f"{arguments} changes the folder: {os.listdir(folder)}")
        os.chmod(folder, 0o755)
        print("a folder that cannot be written: 5 commands end with exit code 3")


check_kills()
check_read_only()
