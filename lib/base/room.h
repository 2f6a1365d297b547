// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// Vectors, arrays, memory, parallel loops, elementary functions and random numbers, independent of
/// the purpose of the library. Every other room uses them. Raw oneTBB loops are in parallel.h and
/// nowhere else.
///
/// In: numbers. Out: numbers, with the same bits for any number of threads and on every x86-64
/// machine.
namespace calotte::base_detail {}
