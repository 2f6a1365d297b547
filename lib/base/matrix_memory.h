// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/memory.h"

#include <cstddef>
#include <cstdint>

namespace calotte::base_detail {

/// prefer_huge_pages() for the values of an Eigen matrix.
template <class Matrix> void prefer_huge_pages(Matrix& matrix) {
  prefer_huge_pages(matrix.data(),
                    static_cast<std::size_t>(matrix.size()) * sizeof(typename Matrix::Scalar));
}

/// Resizes an Eigen matrix without initialising it, as Array does, so that the thread that first
/// writes a page also faults it in.
template <class Matrix> void make_room(Matrix& matrix, std::int64_t rows, std::int64_t columns) {
  matrix.resize(rows, columns);
  prefer_huge_pages(matrix);
}

/// Empties an Eigen matrix and frees its memory.
template <class Matrix> void release(Matrix& matrix) { matrix = Matrix(); }

} // namespace calotte::base_detail
