# SPDX-License-Identifier: GPL-3.0-or-later
# The public headers of what reads and writes files, without .h; all others are those of calotte::core.
set(calotte_io_headers calotte checkpoint cut field_grid mesh_file partition read rotate write write_grid write_region)
