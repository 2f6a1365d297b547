// SPDX-License-Identifier: GPL-3.0-or-later
#include "bytes.h"
#include "options/config_file.h"
#include "scratch_file.h"

#include <calotte/error.h>

/// TOML files with options of the command: each setting has a key and values.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace calotte;
  const std::string path = fuzz::scratch_file("config.toml", data, size);
  try {
    std::int64_t line = 1;
    for (const tools::ConfigSetting& setting : tools::read_config(path)) {
      fuzz::require(setting.line >= line && !setting.values.empty());
      line = setting.line;
    }
  } catch (const Error& error) {
    fuzz::require(error.code() != ErrorCode::internal);
  }
  return 0;
}
