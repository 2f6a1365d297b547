// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/config_option.h"

#include "help/nearest_name.h"
#include "options/config_file.h"
#include "options/config_names.h"
#include "options/numbers.h"
#include "text/text.h"

#include <calotte/error.h>

#include <CLI/App.hpp>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

namespace calotte::tools {
namespace {

using Kind = ConfigValue::Kind;

// ---- The type of an option

bool is_flag(const CLI::Option& option) { return option.get_expected_min() == 0; }

/// The words of its type without those for its values: FLOAT, FILE, KM|FILE.
std::string type_of(const CLI::Option& option) {
  const std::string name = option.get_type_name();
  return name.substr(0, name.find(':'));
}

bool takes_file(const CLI::Option& option) { return type_of(option).ends_with("FILE"); }

/// Whether a command writes the file that the option names. Other files are read.
bool is_output(const CLI::Option& option) {
  return option.check_name("--output") || option.check_name("--report") ||
         option.check_name("--checkpoint");
}

/// True if a number is invalid as its value.
bool takes_text_alone(const CLI::Option& option) {
  const std::string name = option.get_type_name();
  return (takes_file(option) && !name.starts_with("KM|")) || name == "TEXT" ||
         name.starts_with("TEXT:{");
}

std::string kind_of(const CLI::Option& option) {
  const std::string type = type_of(option);
  if (type == "FLOAT")
    return "a number";
  if (type == "INT" || type == "UINT")
    return "an integer";
  return takes_text_alone(option) ? "text in quotes" : "a number or text in quotes";
}

/// Describes an error in the kinds and the number of values of an option; "" if there is none.
std::string mismatch(const CLI::Option& option, const std::vector<ConfigValue>& values) {
  const auto of_kind = [&](Kind kind) {
    return std::any_of(values.begin(), values.end(),
                       [&](const ConfigValue& value) { return value.kind == kind; });
  };
  if (is_flag(option))
    return values.size() == 1 && values[0].kind == Kind::truth ? "" : "takes true or false";
  if (of_kind(Kind::truth))
    return message("takes {}, not true or false", kind_of(option));
  if (of_kind(Kind::number) && takes_text_alone(option))
    return "takes text in quotes, not a number";
  if (values.size() > static_cast<std::size_t>(option.get_items_expected_max()))
    return message("takes one value, and the array has {}; keep one of them", values.size());
  return "";
}

/// Standard input, or a number of km, that an option accepts instead of a file.
bool is_no_file(const CLI::Option& option, const std::string& value) {
  return value == "-" || (type_of(option).starts_with("KM|") && measure_of(value));
}

/// \param folder base of relative names of files that are read.
void give(CLI::Option& option, const std::vector<ConfigValue>& values,
          const std::filesystem::path& folder) {
  for (const ConfigValue& value : values) {
    const bool file = takes_file(option) && !is_output(option) && !is_no_file(option, value.text);
    const bool region = type_of(option).starts_with("SHAPE|");
    option.add_result(region ? region_beside(folder, value.text)
                      : file ? (folder / value.text).string()
                             : value.text);
  }
  option.run_callback();
}

// ---- Names

/// The option of a name, unless the option is not allowed in files.
CLI::Option* option_of(CLI::App& command, const std::string& name) {
  CLI::Option* option = command.get_option_no_throw("--" + name);
  return option && option->get_configurable() ? option : nullptr;
}

const BorrowedName* borrowed_of(CLI::App& command, const std::string& key) {
  for (const BorrowedName& borrowed : borrowed_names())
    if (hyphenated(borrowed.name) == key && option_of(command, borrowed.option))
      return &borrowed;
  return nullptr;
}

std::vector<std::string> known_names(CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options({}))
    if (option->get_configurable())
      names.insert(names.end(), option->get_lnames().begin(), option->get_lnames().end());
  for (const BorrowedName& borrowed : borrowed_names())
    if (option_of(command, borrowed.option))
      names.push_back(borrowed.name);
  return names;
}

// ---- The file

/// Applies the settings of a file to a command's options.
class Application {
public:
  /// \param folder base of relative names of files that are read.
  Application(CLI::App& command, const std::string& path, std::filesystem::path folder,
              std::set<std::string> others = {})
      : command_(command), path_(path), folder_(std::move(folder)), others_(std::move(others)) {
    for (CLI::Option* option : command.get_options())
      if (!option->empty())
        given_.insert(option);
  }

  void apply(const ConfigSetting& setting) {
    const std::string key = hyphenated(setting.key);
    if (const BorrowedName* borrowed = borrowed_of(command_, key)) {
      apply(setting, translated(setting, *borrowed), *option_of(command_, borrowed->option));
    } else if (CLI::Option* option = option_of(command_, key)) {
      apply(setting, setting.values, *option);
    } else if (!others_.contains(key)) {
      refuse(setting, message("unknown option \"{}\"; {}", setting.key,
                              remedy_for(key, known_names(command_), "",
                                         message("calotte {} --help", command_.get_name()))));
    }
  }

private:
  [[noreturn]] void refuse(const ConfigSetting& setting, const std::string& problem) const {
    throw Error(ErrorCode::invalid_argument,
                message("{} line {}: {}", path_, setting.line, problem), setting.line);
  }

  std::vector<ConfigValue> translated(const ConfigSetting& setting,
                                      const BorrowedName& borrowed) const {
    std::vector<ConfigValue> values = setting.values;
    if (borrowed.values.empty())
      return values;
    for (ConfigValue& value : values) {
      const std::string ours = borrowed.ours(value.text);
      if (ours.empty())
        refuse(setting,
               message("{} {} is not one of {}", setting.key, value.text, borrowed.known()));
      value = {Kind::text, ours};
    }
    return values;
  }

  bool given(const CLI::Option* option) const { return given_.contains(option); }

  /// True if the command line has an option that this one excludes.
  bool excluded(const CLI::Option* option) const {
    const std::set<CLI::Option*> others = option->get_excludes();
    return std::any_of(others.begin(), others.end(), [&](auto* other) { return given(other); });
  }

  /// True if the command line has the option, or excludes it or an option that it needs.
  bool overruled(const CLI::Option& option) const {
    const std::set<CLI::Option*> needed = option.get_needs();
    return given(&option) || excluded(&option) ||
           std::any_of(needed.begin(), needed.end(),
                       [&](auto* other) { return !given(other) && excluded(other); });
  }

  void apply(const ConfigSetting& setting, const std::vector<ConfigValue>& values,
             CLI::Option& option) {
    const auto [earlier, fresh] = lines_.emplace(&option, setting.line);
    if (!fresh)
      refuse(setting, message("{} is given twice, also on line {}; leave one out",
                              option.get_lnames().front(), earlier->second));
    if (const std::string problem = mismatch(option, values); !problem.empty())
      refuse(setting, message("{} {}", setting.key, problem));
    if (overruled(option) || (is_flag(option) && values[0].text == "false"))
      return;
    try {
      give(option, values, folder_);
    } catch (const CLI::ParseError& error) {
      refuse(setting, error.what());
    }
  }

  CLI::App& command_;
  const std::string& path_;
  std::filesystem::path folder_;
  std::set<std::string> others_;                     ///< names without effect
  std::set<const CLI::Option*> given_;               ///< by the command line
  std::map<const CLI::Option*, std::int64_t> lines_; ///< of those that the file gives
};

} // namespace

std::shared_ptr<std::string> add_config(CLI::App& command, const std::set<std::string>& others) {
  auto path = std::make_shared<std::string>();
  command
      .add_option_function<std::string>(
          "--config",
          [&command, path, others](const std::string& file) {
            *path = file;
            Application application(command, file, std::filesystem::path(file).parent_path(),
                                    others);
            for (const ConfigSetting& setting : read_config(file))
              application.apply(setting);
          },
          "TOML file with options by their long names. The command line takes precedence. Files "
          "that are read are relative to the TOML file, files that are written to the current "
          "folder")
      ->type_name("FILE")
      ->configurable(false);
  return path;
}

std::string given_options(const CLI::App& command) {
  std::string lines;
  for (const CLI::Option* option : command.get_options())
    if (!option->empty() && option->get_configurable() && !option->get_lnames().empty())
      for (const std::string& value : option->results())
        lines += option->get_lnames().front() + "\t" + (is_flag(*option) ? "true" : value) + "\n";
  return lines;
}

void apply_options(CLI::App& command, const std::string& lines, const std::string& path) {
  std::vector<ConfigSetting> settings;
  std::istringstream in(lines);
  for (std::string line; std::getline(in, line);) {
    const std::size_t tab = line.find('\t');
    const std::string key = line.substr(0, tab);
    const CLI::Option* option = command.get_option_no_throw("--" + key);
    const Kind kind = option != nullptr && is_flag(*option) ? Kind::truth : Kind::text;
    if (settings.empty() || settings.back().key != key)
      settings.push_back({key, std::ssize(settings) + 1, {}});
    settings.back().values.push_back({kind, tab == std::string::npos ? "" : line.substr(tab + 1)});
  }
  Application application(command, path, {});
  for (const ConfigSetting& setting : settings)
    application.apply(setting);
}

} // namespace calotte::tools
