// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// The version of these headers.
#define CALOTTE_VERSION_MAJOR 1
#define CALOTTE_VERSION_MINOR 0
#define CALOTTE_VERSION_PATCH 0
#define CALOTTE_VERSION "1.0.0"
