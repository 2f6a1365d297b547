// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/file.h"
#include "io/bytes/text.h"
#include "io/mpas/room.h"

#include <calotte/write.h>

#include <cstdint>

namespace calotte {

void write_parts(const std::string& path, const Ids& part) {
  io_detail::OutputFile file(path);
  io_detail::Writer out([&](std::string_view bytes) { file.append(bytes); });
  for (const std::int32_t id : part)
    out.number(std::int64_t{id}).text("\n");
  out.flush();
  file.commit();
}

} // namespace calotte
