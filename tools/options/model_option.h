// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "help/cli_forward.h"

#include <calotte/write.h>

#include <optional>
#include <string>

namespace calotte::tools {

/// Adds --for.
/// \param word receives the word of the model.
CLI::Option* add_model(CLI::App& command, std::optional<std::string>& word);

/// Adds --for to a command that compares a grid with the demands of a model.
CLI::Option* add_demanding_model(CLI::App& command, std::optional<std::string>& word);

/// Whether the demands of a model on grids are known, see gates().
bool has_demands(const ModelNeeds& model);

/// The model of a word; null without one.
const ModelNeeds* model_of(const std::optional<std::string>& word);

/// The radius of a file for a model.
/// \param given value of --sphere-radius, which stays.
/// \returns nothing without a radius and without a model.
/// \throws Error invalid_argument, for a radius that the model cannot use.
std::optional<double> radius_for(const ModelNeeds* model, std::optional<double> given);

/// A line on the models that an MPAS file of the sphere suits; "" for other formats.
/// \param options with which it was written; their format is not by_name.
std::string suited_models(const std::string& path, const WriteOptions& options);

} // namespace calotte::tools
