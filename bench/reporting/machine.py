# SPDX-License-Identifier: GPL-3.0-or-later
"""The machine and the software versions of the samples."""

import os
import platform
import resource
import subprocess
import time
from pathlib import Path


def output_of(*command):
    """The standard output of a command; empty where it fails or is missing."""
    try:
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return ""


def threads():
    """That this process may run on."""
    return len(os.sched_getaffinity(0))


def busy_seconds():
    """Of all cores since the start, what a virtual machine's host took included."""
    fields = Path("/proc/stat").read_text().splitlines()[0].split()[1:9]
    user, nice, system, _idle, _waiting, irq, softirq, steal = map(int, fields)
    return (user + nice + system + irq + softirq + steal) / os.sysconf("SC_CLK_TCK")


def own_seconds():
    """CPU seconds of this process and of those that it waited for."""
    return sum(
        usage.ru_utime + usage.ru_stime
        for usage in map(resource.getrusage, (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    )


class Watch:
    """Measures from its construction."""

    def __init__(self):
        self.start = time.monotonic()
        self.before = busy_seconds() - own_seconds()

    def seconds(self):
        return time.monotonic() - self.start

    def others(self):
        """The part of all cores that others than this process and its children took."""
        taken = busy_seconds() - own_seconds() - self.before
        return max(0.0, taken / (os.cpu_count() * self.seconds()))


def commit():
    """Of the sources, with a + where they were changed; a published report is none of them."""
    short = output_of("git", "rev-parse", "--short=12", "HEAD") or "unknown"
    sources = (".", ":!bench/RESULTS.md", ":!bench/reporting/*.md")
    tracked = output_of("git", "status", "--porcelain", "--untracked-files=no", "--", *sources)
    return short + ("+" if tracked else "")


def processor():
    fields = dict(
        line.split(":", 1) for line in output_of("lscpu").splitlines() if ":" in line
    )
    wanted = ("Model name", "L2 cache", "L3 cache", "Hypervisor vendor")
    known = {name: fields[name].strip() for name in wanted if name in fields}
    caches = [f"{name[:2]} {known[name]}" for name in ("L2 cache", "L3 cache") if name in known]
    host = [f"virtual ({known['Hypervisor vendor']})"] if "Hypervisor vendor" in known else []
    return ", ".join([known.get("Model name", platform.machine()), *caches, *host])


def memory_gib():
    return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 2**30


def system():
    for line in Path("/etc/os-release").read_text().splitlines():
        if line.startswith("PRETTY_NAME="):
            return line.split("=", 1)[1].strip('"')
    return platform.system()


def describe():
    """By name, one line each."""
    return {
        "processor": processor(),
        "threads": str(threads()),
        "memory": f"{memory_gib():.0f} GiB",
        "system": f"{system()}, Linux {platform.release()}",
    }
