// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// The interface for C and for the languages that call C: plain data, error codes and opaque
/// meshes around the functions of the other rooms.
///
/// In: pointers to numbers of the caller. Out: a code, a message and pointers into a mesh.
namespace calotte::c_detail {}
