// SPDX-License-Identifier: GPL-3.0-or-later
#include "config_option.h"

#include <calotte/error.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <set>
#include <system_error>
#include <vector>

namespace calotte::tools {
namespace {

std::vector<CLI::ConfigItem> read_items(const std::string& path) {
  if (std::error_code error; std::filesystem::is_directory(path, error))
    throw Error(ErrorCode::file,
                "cannot read " + path + ": it is a folder; give the name of a file");
  std::ifstream in(path);
  if (!in)
    throw Error(ErrorCode::file, "cannot read " + path + ": " +
                                     std::generic_category().message(errno) +
                                     "; check its name and its permissions");
  return CLI::ConfigTOML().from_config(in);
}

/// Gives an option what the file says of it, unless the command line did.
void apply(CLI::Option& option, const CLI::ConfigItem& item) {
  if (!option.empty())
    return;
  if (option.get_expected_min() == 0) // a flag
    option.add_result(option.get_flag_value(item.name, CLI::ConfigTOML().to_flag(item)));
  else
    option.add_result(item.inputs);
  option.run_callback();
}

void apply_file(CLI::App& command, const std::string& path) {
  std::set<std::string> seen;
  const auto refuse = [&](const std::string& problem) {
    throw Error(ErrorCode::bad_option, path + ": " + problem);
  };
  for (const CLI::ConfigItem& item : read_items(path)) {
    if (!item.parents.empty())
      refuse("there are no sections, but [" + item.parents.front() + "] is one; leave it out");
    CLI::Option* option = command.get_option_no_throw("--" + item.name);
    if (option == nullptr || !option->get_configurable())
      refuse("unknown option \"" + item.name + "\"; see calotte " + command.get_name() + " --help");
    if (!seen.insert(item.name).second)
      refuse(item.name + " is given twice; leave one of them out");
    try {
      apply(*option, item);
    } catch (const CLI::ParseError& error) {
      refuse(std::string(error.what()));
    }
  }
}

} // namespace

std::shared_ptr<std::string> add_config(CLI::App& command) {
  auto path = std::make_shared<std::string>();
  command
      .add_option_function<std::string>(
          "--config",
          [&command, path](const std::string& file) {
            *path = file;
            apply_file(command, file);
          },
          "a TOML file of these options, key = value a line; the command line wins")
      ->configurable(false);
  return path;
}

} // namespace calotte::tools
