// SPDX-License-Identifier: GPL-3.0-or-later
#include "bytes.h"
#include "io/command.h"
#include "scratch_file.h"

#include <calotte/checkpoint.h>
#include <calotte/error.h>
#include <calotte/generators.h>
#include <calotte/grid.h>
#include <calotte/read.h>
#include <calotte/write.h>

#include <cstring>

using namespace calotte;

namespace {

Recipe recipe() { return {.start = {.points = random_sphere(30)}, .stop = {.max_iterations = 4}}; }

/// A checkpoint of a run, whose bytes the input changes: its checksum makes others dull.
std::string sample() {
  const std::string path = fuzz::scratch_file("sample", nullptr, 0);
  make_grid(recipe(), {.progress = [&](const Progress& now) {
              write_checkpoint(path, now.run->state, "run");
              return ProgressReply::stop;
            }});
  return read_file(path);
}

} // namespace

/// Checkpoints: refused, or a state that a run continues.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string whole = sample();
  fuzz::Bytes bytes(data, size);
  std::string text = whole;
  if (bytes.integer(0, 1) == 0)
    text.assign(reinterpret_cast<const char*>(data), size);
  else
    for (int changes = bytes.integer(1, 8); changes > 0; --changes)
      text[(bytes.byte() | static_cast<unsigned>(bytes.byte()) << 8U) % text.size()] =
          static_cast<char>(bytes.byte());
  const std::string path = fuzz::scratch_file(
      "checkpoint", reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  try {
    read_checkpoint_command(path);
    make_grid(recipe(), {.state = read_checkpoint(path, "run")});
  } catch (const Error& error) {
    fuzz::require(error.code() != ErrorCode::internal);
  }
  return 0;
}
