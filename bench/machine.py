# SPDX-License-Identifier: GPL-3.0-or-later
"""The machine and the commit of measurements, and what else ran meanwhile."""

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


def commit():
    """Of the sources, with a + where they were changed; published results are none of them."""
    changed = output_of("git", "status", "--porcelain", "--untracked-files=no", "--", ".", ":!bench/RESULTS.md")
    return output_of("git", "rev-parse", "--short=12", "HEAD") + ("+" if changed else "")


def processor():
    fields = dict(line.split(":", 1) for line in output_of("lscpu").splitlines() if ":" in line)
    wanted = ("Model name", "L2 cache", "L3 cache", "Hypervisor vendor")
    return ", ".join(fields[name].strip() for name in wanted if name in fields) or platform.machine()


def seconds_of_others():
    """CPU seconds since the start, what a virtual machine's host took included, of all but this process and its
    children."""
    user, nice, system, _, _, irq, softirq, steal = map(int, Path("/proc/stat").read_text().split()[1:9])
    busy = (user + nice + system + irq + softirq + steal) / os.sysconf("SC_CLK_TCK")
    used = map(resource.getrusage, (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return busy - sum(usage.ru_utime + usage.ru_stime for usage in used)


class Watch:
    """Measures from its construction."""

    def __init__(self):
        self.start, self.before = time.monotonic(), seconds_of_others()

    def seconds(self):
        return time.monotonic() - self.start

    def others(self):
        """The share of all cores that others took."""
        return max(0.0, (seconds_of_others() - self.before) / (os.cpu_count() * self.seconds()))
