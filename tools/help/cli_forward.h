// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// What headers say of CLI11, which takes most of the time to compile a file that includes it.
namespace CLI {

class App;
class Option;
class Validator;

} // namespace CLI
