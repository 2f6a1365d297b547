// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

namespace calotte::fuzz {

/// Writes an input to a file in memory, in a folder for each process. \returns its path.
inline std::string scratch_file(const std::string& name, const std::uint8_t* data,
                                std::size_t size) {
  const std::string folder = "/dev/shm/calotte-fuzz-" + std::to_string(::getpid());
  std::filesystem::create_directory(folder);
  const std::string path = folder + "/" + name;
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  return path;
}

} // namespace calotte::fuzz
