// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/mesh.h>
#include <calotte/remap.h>

#include <Eigen/Core>

/// A library of another project: it uses Eigen for itself, and takes and returns Calotte's types.
/// It is compiled for AVX2.
namespace neighbour {

/// False where the processor lacks AVX2, or the compiler does not make code for it.
bool can_run();

/// Whether Eigen's vectors have another memory in this library than in files without AVX2.
bool aligns_otherwise();

/// The points with more columns, which repeat the first ones.
calotte::Points3 extended(calotte::Points3 points, Eigen::Index more);
Eigen::Matrix3Xd extended(Eigen::Matrix3Xd points, Eigen::Index more);

/// Allocates values, or replaces those of another library by more.
void append(calotte::DoubleVector& values, double value);
void append(Eigen::VectorXd& values, double value);

/// 1, 2, ... n.
calotte::DoubleVector ascending(Eigen::Index n);

/// Frees the matrices.
double sum(calotte::Mesh mesh);
Eigen::VectorXd product(calotte::Weights weights, Eigen::VectorXd values);

/// The largest error of solutions of n equations, by Eigen's dense and sparse factors.
double error_of_solutions(Eigen::Index n);

} // namespace neighbour
