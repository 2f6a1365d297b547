// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/files.h"

#include "io/command.h"
#include "text/text.h"

#include <boost/crc.hpp>

#include <array>
#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>

#include <unistd.h>

namespace calotte::tools {

void require_folder(const std::string& path) {
  const std::filesystem::path parent = std::filesystem::path(path).parent_path();
  const std::string folder = parent.empty() ? "." : parent.string();
  if (std::error_code error; std::filesystem::is_directory(path, error))
    fail_write(path, "it is a folder; give the name of a file");
  if (std::error_code error; !std::filesystem::is_directory(folder, error))
    fail_write(path, message("the folder {} does not exist; create it first", folder));
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    fail_write(path, message("the folder {}: {}; write elsewhere", folder,
                             std::generic_category().message(errno)));
}

void require_distinct(const std::string& output, const std::string& input) {
  std::error_code absent;
  if (input != "-" && std::filesystem::equivalent(output, input, absent))
    refuse(message("{} is both input and output; give the output another name", output));
}

namespace {

[[noreturn]] void fail_input(const std::string& path) {
  fail_read(path, message("{}; check its name and its permissions",
                          std::generic_category().message(errno)));
}

} // namespace

void require_input(const std::string& path) {
  if (::access(path.c_str(), R_OK) != 0)
    fail_input(path);
}

namespace {

/// Adds the files that inputs of rules name.
std::vector<std::string> with_named(const std::vector<std::string>& inputs) {
  std::vector<std::string> all = inputs;
  for (const std::string& input : inputs)
    if (has_rules(input))
      for (std::string& named : files_of_rules(input))
        all.push_back(std::move(named));
  return all;
}

} // namespace

void require_outputs(const std::vector<Output>& outputs, const std::vector<std::string>& given) {
  const std::vector<std::string> inputs = with_named(given);
  const auto normal = [](const Output& output) {
    return std::filesystem::path(output.path).lexically_normal();
  };
  for (auto output = outputs.begin(); output != outputs.end(); ++output) {
    if (output->path.empty())
      continue;
    require_folder(output->path);
    for (const std::string& input : inputs)
      require_distinct(output->path, input);
    for (auto other = outputs.begin(); other != output; ++other)
      if (normal(*other) == normal(*output))
        refuse(message("{} is both {} and {}; give the {} another name", output->path, other->what,
                       output->what, output->what));
  }
}

void require_space(const std::string& path, double bytes) {
  std::filesystem::path folder = std::filesystem::path(path).parent_path();
  std::error_code unknown;
  const auto space = std::filesystem::space(folder.empty() ? "." : folder, unknown);
  if (!unknown && static_cast<double>(space.available) < bytes)
    fail_write(path, message("it will have about {}, but the disk has {} left; make room or write "
                             "elsewhere",
                             data_size(bytes), data_size(static_cast<double>(space.available))));
}

std::string checksum_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  boost::crc_32_type checksum;
  std::int64_t size = 0;
  std::array<char, 1 << 16> bytes;
  while (in.read(bytes.data(), bytes.size()) || in.gcount() > 0) {
    checksum.process_bytes(bytes.data(), static_cast<std::size_t>(in.gcount()));
    size += in.gcount();
  }
  if (in.bad() || !in.eof())
    fail_input(path);
  return message("{} bytes with checksum {}", size, checksum.checksum());
}

} // namespace calotte::tools
