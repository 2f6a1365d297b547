# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the benchmark programs and writes their report; see bench/report."""
