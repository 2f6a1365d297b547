#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs in conda's build environment, in the sources: installs everything in $PREFIX.
set -euo pipefail
npm install --prefix d3 --no-save d3-scale@2 d3-format@1 # for the page of calotte view
cmake -S . -B build/conda -G Ninja ${CMAKE_ARGS:-} -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=ON \
  -DCALOTTE_BUILD_TESTS=OFF -DCALOTTE_NODE_PATH="$PWD/d3/node_modules" -DCMAKE_INSTALL_LIBDIR=lib \
  -DCMAKE_INSTALL_PREFIX="$PREFIX"
cmake --build build/conda --parallel "${CPU_COUNT:-2}"
cmake --install build/conda
CALOTTE_PREFIX=$PREFIX python -m pip install --no-build-isolation --no-deps ./tools/python
