// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// The interface for C and for the languages that call C: plain data, error codes and opaque
/// meshes around the functions of the other rooms. It makes no choices: a recipe of C is one of
/// C++.
///
/// In: structs of the caller that begin with their size, and pointers to its numbers. Out: a code,
/// a message, numbers and pointers into a mesh.
namespace calotte::c_detail {}
