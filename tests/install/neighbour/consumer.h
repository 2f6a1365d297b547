// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// A program that uses Calotte and the neighbour.
/// \returns the number of wrong results.
int count_faults();
