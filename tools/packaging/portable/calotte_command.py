# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the command that a wheel holds, without loading the package."""
import os
import pathlib
import sys


def main():
    program = pathlib.Path(__file__).parent / "calotte/bin/calotte"
    os.execv(program, [sys.argv[0], *sys.argv[1:]])
