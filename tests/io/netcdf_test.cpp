// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/file_reader.h"
#include "io/command.h"
#include "io/netcdf/netcdf_header.h"
#include "io/netcdf/netcdf_reader.h"
#include "io/netcdf/netcdf_writer.h"
#include "support/files.h"
#include "support/full_disk.h"
#include "support/random.h"
#include "support/text.h"

#include <calotte/error.h>
#include <calotte/read.h>
#include <calotte/write.h>

#include <doctest/doctest.h>
#include <netcdf.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <limits>
#include <thread>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

namespace fs = std::filesystem;
using calotte::Error;
using calotte::ErrorCode;
using calotte::io_detail::NetcdfReader;
using calotte::io_detail::NetcdfType;
using calotte::io_detail::NetcdfWriter;
using calotte::test::code_of;
using calotte::test::error_of;
using calotte::test::has;
using calotte::test::Scratch;

namespace {

double value_at(std::int64_t i) { return i % 7 == 0 ? -0.0 : 1.0 / static_cast<double>(i); }

constexpr std::int64_t sample_rows = 50'001;

/// Variables of all types and shapes, more rows than a block holds, odd lengths that need padding.
void write_sample(const std::string& path) {
  NetcdfWriter file(path);
  const int n = file.dimension("n", sample_rows), three = file.dimension("three", 3);
  file.dimension("Time", 0);
  file.attribute({"title", std::string("a sample")});
  file.attribute({"radius", 6371229.0});
  file.attribute({"empty", std::string()});
  const int scalar =
      file.variable("scalar", NetcdfType::int32, {},
                    {{"cf_role", std::string("mesh_topology")}, {"start", std::int32_t{-1}}});
  const int bytes = file.variable("bytes", NetcdfType::int8, {n}, {{"fill", std::int8_t{-1}}});
  const int doubles = file.variable("doubles", NetcdfType::float64, {n},
                                    {{"units", std::string("m")}, {"factor", 0.1}});
  const int ids = file.variable("ids", NetcdfType::int32, {n, three});
  const int cube = file.variable("cube", NetcdfType::float64, {three, three, n});
  file.begin();
  file.put(scalar, NetcdfWriter::Fill<std::int32_t>([](auto, auto, auto* out) { *out = -77; }));
  file.put(bytes, NetcdfWriter::Fill<std::int8_t>([](auto begin, auto end, auto* out) {
             for (auto i = begin; i < end; ++i)
               *out++ = static_cast<std::int8_t>(i % 100 - 50);
           }));
  file.put(doubles, NetcdfWriter::Fill<double>([](auto begin, auto end, auto* out) {
             for (auto i = begin; i < end; ++i)
               *out++ = value_at(i);
           }));
  file.put(ids, NetcdfWriter::Fill<std::int32_t>([](auto begin, auto end, auto* out) {
             for (auto i = 3 * begin; i < 3 * end; ++i)
               *out++ = static_cast<std::int32_t>(3 * i - sample_rows);
           }));
  file.put(cube, NetcdfWriter::Fill<double>([](auto begin, auto end, auto* out) {
             for (auto i = 3 * sample_rows * begin; i < 3 * sample_rows * end; ++i)
               *out++ = value_at(i);
           }));
  file.commit();
}

/// What the C library makes of a file.
struct Opened {
  explicit Opened(const std::string& path) {
    REQUIRE(nc_open(path.c_str(), NC_NOWRITE, &id) == NC_NOERR);
  }
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;
  ~Opened() { nc_close(id); }
  int variable(const char* name) const {
    int v = -1;
    REQUIRE(nc_inq_varid(id, name, &v) == NC_NOERR);
    return v;
  }
  int id = -1;
};

/// The header that was read is the C library's.
void require_same_header(const NetcdfReader& file, const Opened& opened) {
  int dimensions = 0, variables = 0, attributes = 0, unlimited = -1;
  REQUIRE(nc_inq(opened.id, &dimensions, &variables, &attributes, &unlimited) == NC_NOERR);
  REQUIRE(std::ssize(file.dimensions()) == dimensions);
  REQUIRE(std::ssize(file.variables()) == variables);
  REQUIRE(std::ssize(file.attributes()) == attributes);
  char name[NC_MAX_NAME + 1] = "";
  for (int d = 0; d < dimensions; ++d) {
    const auto& dimension = file.dimensions()[static_cast<std::size_t>(d)];
    std::size_t size = 0;
    REQUIRE(nc_inq_dim(opened.id, d, name, &size) == NC_NOERR);
    REQUIRE(dimension.name == name);
    REQUIRE(dimension.size == static_cast<std::int64_t>(size));
    REQUIRE(dimension.unlimited == (d == unlimited));
  }
  for (int v = 0; v < variables; ++v) {
    const auto& variable = file.variables()[static_cast<std::size_t>(v)];
    nc_type type = NC_NAT;
    int rank = 0, of_variable = 0, ids[NC_MAX_VAR_DIMS];
    REQUIRE(nc_inq_var(opened.id, v, name, &type, &rank, ids, &of_variable) == NC_NOERR);
    REQUIRE(variable.name == name);
    REQUIRE(static_cast<int>(*variable.type) == type);
    REQUIRE(variable.dimensions == std::vector<int>(ids, ids + rank));
    REQUIRE(std::ssize(variable.attributes) == of_variable);
    REQUIRE(file.find(name) == v);
  }
}

/// A file as another program makes it: defined by `define`, whose return value is the format.
template <class Define> std::string foreign(const std::string& path, int format, Define define) {
  int id = -1;
  REQUIRE(nc_create(path.c_str(), NC_CLOBBER | format, &id) == NC_NOERR);
  define(id);
  REQUIRE(nc_close(id) == NC_NOERR);
  return path;
}

} // namespace

TEST_CASE("the C library reads what was written, bit for bit") {
  const Scratch scratch;
  write_sample(scratch / "a.nc");
  CHECK(scratch.files() == 1);
  CHECK(calotte::test::read_file(scratch / "a.nc").substr(0, 4) == std::string("CDF\2"));
  const Opened file(scratch / "a.nc");

  int number = 0;
  CHECK(nc_get_var_int(file.id, file.variable("scalar"), &number) == NC_NOERR);
  CHECK(number == -77);
  std::vector<signed char> bytes(sample_rows);
  CHECK(nc_get_var_schar(file.id, file.variable("bytes"), bytes.data()) == NC_NOERR);
  std::vector<double> doubles(sample_rows), cube(9 * sample_rows);
  CHECK(nc_get_var_double(file.id, file.variable("doubles"), doubles.data()) == NC_NOERR);
  CHECK(nc_get_var_double(file.id, file.variable("cube"), cube.data()) == NC_NOERR);
  std::vector<int> ids(3 * sample_rows);
  CHECK(nc_get_var_int(file.id, file.variable("ids"), ids.data()) == NC_NOERR);
  bool right = true;
  const auto same = [](double a, double b) { return a == b && std::signbit(a) == std::signbit(b); };
  for (std::int64_t i = 0; i < 9 * sample_rows; ++i) {
    const auto k = static_cast<std::size_t>(i);
    right = right && same(cube[k], value_at(i));
    if (i < sample_rows)
      right = right && bytes[k] == i % 100 - 50 && same(doubles[k], value_at(i));
    if (i < 3 * sample_rows)
      right = right && ids[k] == 3 * i - sample_rows;
  }
  CHECK(right);

  int unlimited = -1;
  char name[NC_MAX_NAME + 1] = "";
  CHECK(nc_inq_unlimdim(file.id, &unlimited) == NC_NOERR);
  CHECK(nc_inq_dimname(file.id, unlimited, name) == NC_NOERR);
  CHECK(std::string(name) == "Time");
}

TEST_CASE("the reader tells names, shapes, attributes and values") {
  const Scratch scratch;
  write_sample(scratch / "a.nc");
  const NetcdfReader file(scratch / "a.nc");
  CHECK(file.variable_names() ==
        std::vector<std::string>{"scalar", "bytes", "doubles", "ids", "cube"});
  CHECK(file.has_variable("ids"));
  CHECK(!file.has_variable("id"));
  CHECK(file.shape_of("scalar").empty());
  CHECK(file.shape_of("ids") == std::vector<std::int64_t>{sample_rows, 3});
  CHECK(file.dimensions_of("ids") == std::vector<std::string>{"n", "three"});
  CHECK(file.dimension("n") == sample_rows);
  CHECK(file.dimension("Time") == 0);
  CHECK(file.dimension("m") == -1);
  CHECK(file.text("", "title") == "a sample");
  CHECK(file.text("", "empty").empty());
  CHECK(file.text("", "radius").empty());
  CHECK(file.text("doubles", "units") == "m");
  CHECK(file.text("doubles", "unit").empty());
  CHECK(file.text("nothing", "units").empty());
  CHECK(file.number("", "radius", 1) == 6371229.0);
  CHECK(file.number("doubles", "factor", 1) == 0.1);
  CHECK(file.number("scalar", "start", 1) == -1);
  CHECK(file.number("bytes", "fill", 1) == -1);
  CHECK(file.number("doubles", "units", 5) == 5);
  CHECK(file.number("doubles", "nothing", 5) == 5);

  CHECK(file.ints("scalar", {}) == std::vector<std::int32_t>{-77});
  CHECK(file.ints("bytes", {sample_rows})[99] == 49);
  CHECK(file.ints("ids", {-1, 3})[1] == 3 - sample_rows);
  CHECK(file.doubles("ids", {sample_rows, 3})[2] == 6 - sample_rows);
  CHECK(file.doubles("doubles", {-1})[3] == value_at(3));
}

TEST_CASE("the same bytes for any number of threads") {
  const Scratch scratch;
  for (const int threads : {1, 2, 5})
    tbb::task_arena(threads).execute([&] { write_sample(scratch / std::to_string(threads)); });
  CHECK(calotte::test::read_file(scratch / "1") == calotte::test::read_file(scratch / "2"));
  CHECK(calotte::test::read_file(scratch / "1") == calotte::test::read_file(scratch / "5"));
}

TEST_CASE("files are written and read from several threads at a time") {
  const Scratch scratch;
  write_sample(scratch / "expected");
  const std::string expected = calotte::test::read_file(scratch / "expected");
  std::atomic<int> right = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&, i] {
      const std::string path = scratch / std::to_string(i);
      for (int round = 0; round < 2; ++round) {
        write_sample(path);
        const bool found = NetcdfReader(path).ints("ids", {-1, 3}).size() == 3 * sample_rows;
        right += found && calotte::test::read_file(path) == expected ? 1 : 0;
      }
    });
  for (std::thread& thread : threads)
    thread.join();
  CHECK(right == 8);
}

TEST_CASE("CDF-5 if a variable takes 4 GiB") {
  using calotte::io_detail::needs_cdf5;
  constexpr std::int64_t limit = (std::int64_t{1} << 32) - 4;
  CHECK(!needs_cdf5({}));
  CHECK(!needs_cdf5({limit - 1, limit - 4, 0}));
  CHECK(needs_cdf5({8, limit, 8}));
  CHECK(needs_cdf5({std::int64_t{1} << 40}));

  // What begin() leaves beside the target, whose values are holes.
  const Scratch scratch;
  for (const bool wide : {false, true}) {
    // begin() reserves the space: 4 GiB, which a small disk has.
    const std::int64_t size = wide ? std::int64_t{1} << 32 : (std::int64_t{1} << 29) - 1;
    const auto type = wide ? NetcdfType::int8 : NetcdfType::float64;
    NetcdfWriter file(scratch / "a.nc");
    const int n = file.dimension("n", size);
    file.variable("first", type, {n});
    const int scalar = file.variable("last", NetcdfType::int32, {});
    file.begin();
    file.put(scalar, NetcdfWriter::Fill<std::int32_t>([](auto, auto, auto* out) { *out = 42; }));
    REQUIRE(scratch.files() == 1);
    const std::string part = fs::directory_iterator(scratch.folder)->path();
    CHECK(static_cast<std::int64_t>(fs::file_size(part)) >
          calotte::io_detail::size_of(type) * size);
    std::ifstream in(part, std::ios::binary);
    std::string magic(4, ' ');
    in.read(magic.data(), 4);
    CHECK(magic == (wide ? "CDF\5" : "CDF\2"));
    const NetcdfReader reader(part);
    CHECK(reader.shape_of("first") == std::vector<std::int64_t>{size});
    CHECK(reader.ints("last", {}) == std::vector<std::int32_t>{42});
  }
  CHECK(scratch.files() == 0);
}

TEST_CASE("a disk that fills up keeps the old file and removes the new one") {
  const Scratch scratch;
  for (const rlim_t bytes : {rlim_t{100}, rlim_t{2000}, rlim_t{1'000'000}}) {
    calotte::write_file(scratch / "a.nc", "old");
    std::string message;
    {
      const calotte::test::FullDisk full(bytes);
      try {
        write_sample(scratch / "a.nc");
      } catch (const Error& error) {
        message = error.what();
      }
    }
    CHECK(message ==
          "cannot write " + (scratch / "a.nc") + ": File too large; make room or write elsewhere");
    CHECK(scratch.files() == 1);
    CHECK(calotte::test::read_file(scratch / "a.nc") == "old");
  }
}

TEST_CASE("a place that no such file can take is refused") {
  const Scratch scratch;
  const auto message = [](const std::string& path) {
    const Error error = error_of([&] { write_sample(path); });
    CHECK(error.code() == ErrorCode::file);
    return std::string(error.what());
  };
  REQUIRE(::mkfifo((scratch / "pipe").c_str(), 0600) == 0);
  for (const std::string& path : {scratch / "pipe", std::string("/dev/null")})
    CHECK(message(path) ==
          "cannot write " + path +
              ": it is not a regular file, and the format is not written from front "
              "to back; give the name of a file");
  CHECK(message(scratch / "") ==
        "cannot write " + (scratch / "") + ": it is a folder; give the name of a file");
  CHECK(message(scratch / "none/a.nc") ==
        "cannot write " + (scratch / "none/a.nc") + ": its folder does not exist; create it first");
}

TEST_CASE("a write that fails midway leaves nothing") {
  const Scratch scratch;
  CHECK_THROWS_WITH(
      [&] {
        NetcdfWriter file(scratch / "a.nc");
        const int v = file.variable("v", NetcdfType::float64, {file.dimension("n", 1'000'000)});
        file.begin();
        file.put(v, NetcdfWriter::Fill<double>([](auto, auto end, auto*) {
                   if (end == 1'000'000)
                     throw std::runtime_error("stop");
                 }));
      }(),
      "stop");
  CHECK(scratch.files() == 0);
  CHECK(code_of([&] {
          NetcdfWriter file(scratch / "a.nc");
          file.variable("v", NetcdfType::float64, {});
          file.begin();
          file.commit();
        }) == ErrorCode::internal);
  CHECK(scratch.files() == 0);
}

TEST_CASE("a name that looks like an address is a file's") {
  const Scratch scratch;
  fs::create_directories(scratch.folder / "http:" / "x");
  const fs::path before = fs::current_path();
  fs::current_path(scratch.folder);
  for (const std::string name : {"http://x/a.nc", " a.nc", "a b#mode=zarr.nc"}) {
    write_sample(name);
    CHECK(NetcdfReader(name).ints("scalar", {}).front() == -77);
  }
  fs::current_path(before);
}

TEST_CASE("missing, invalid and truncated NetCDF files are refused") {
  const Scratch scratch;
  const auto message = [](const std::string& path, ErrorCode code) {
    const Error error = error_of([&] { NetcdfReader reader(path); });
    CHECK(error.code() == code);
    return std::string(error.what());
  };
  CHECK(message(scratch / "none", ErrorCode::file) ==
        "cannot read " + (scratch / "none") +
            ": No such file or directory; check its name and its permissions");
  CHECK(message(scratch.folder, ErrorCode::file) ==
        "cannot read " + scratch.folder.string() + ": it is a folder; give the name of a file");
  calotte::write_file(scratch / "text", "1 2 3\n4 5 6\n");
  CHECK(message(scratch / "text", ErrorCode::parse) ==
        (scratch / "text") +
            ": it is not a NetCDF file, or is cut short; give another or make it again");
  calotte::write_file(scratch / "empty", "");
  CHECK(has(message(scratch / "empty", ErrorCode::parse), "not a NetCDF file"));

  write_sample(scratch / "a.nc");
  const std::string whole = calotte::test::read_file(scratch / "a.nc");
  calotte::write_file(scratch / "cut", whole.substr(0, whole.size() - 1));
  CHECK(message(scratch / "cut", ErrorCode::parse) ==
        (scratch / "cut") + ": it is cut short: cube is incomplete; make it again");
  calotte::test::Random random(3);
  for (int i = 0; i < 200; ++i) {
    // All lengths within the header, then any.
    const std::size_t length =
        i < 150 ? static_cast<std::size_t>(6 * i)
                : static_cast<std::size_t>(random.integer(0, static_cast<int>(whole.size()) - 1));
    CAPTURE(length);
    std::ofstream(scratch / "cut", std::ios::binary) << whole.substr(0, length);
    message(scratch / "cut", ErrorCode::parse);
  }
}

TEST_CASE("damaged headers are read or refused; what is read, the C library reads, too") {
  const Scratch scratch;
  write_sample(scratch / "a.nc");
  const std::string whole = calotte::test::read_file(scratch / "a.nc");
  const auto header = static_cast<int>(
      calotte::io_detail::classic_header(calotte::io_detail::FileReader(scratch / "a.nc")).bytes);
  calotte::test::Random random(7);
  int refused = 0;
  for (int i = 0; i < 1000; ++i) {
    std::string damaged = whole;
    for (int changes = random.integer(1, 3); changes > 0; --changes) {
      const auto at = static_cast<std::size_t>(random.integer(4, header - 1));
      damaged[at] = static_cast<char>(i % 3 == 0 ? random.integer(0, 12) : random.integer(0, 255));
    }
    std::ofstream(scratch / "b.nc", std::ios::binary) << damaged;
    try {
      const NetcdfReader file(scratch / "b.nc");
      if (file.has_variable("cube"))
        CHECK(file.shape_of("cube").size() <= 8);
      require_same_header(file, Opened(scratch / "b.nc"));
    } catch (const Error& error) {
      CHECK(error.code() == ErrorCode::parse);
      ++refused;
    }
  }
  CHECK(refused > 300);
}

TEST_CASE("names that occur twice or are no UTF-8, and types that there are not, are damage") {
  const Scratch scratch;
  const std::string path = foreign(scratch / "a.nc", 0, [](int id) {
    int first, second, v;
    nc_def_dim(id, "aaaa", 3, &first);
    nc_def_dim(id, "bbbb", 4, &second);
    nc_def_var(id, "vvvv", NC_DOUBLE, 1, &first, &v);
  });
  const std::string whole = calotte::test::read_file(path);
  const auto message = [&](const std::string& from, const std::string& to) {
    std::string damaged = whole;
    damaged.replace(damaged.find(from), from.size(), to);
    std::ofstream(scratch / "b.nc", std::ios::binary) << damaged;
    const Error error = error_of([&] { NetcdfReader reader(scratch / "b.nc"); });
    return std::string(error.what());
  };
  CHECK(has(message("bbbb", "aaaa"), "ends a name that occurs twice"));
  CHECK(has(message("bbbb", "b\xffzz"), "letter that names do not have"));
  CHECK(has(message("bbbb", "bb/b"), "letter that names do not have"));
  const std::string type_of_double("\0\0\0\6", 4), no_type("\0\0\0\7", 4);
  CHECK(has(message(type_of_double, no_type), "follows a type that there is not"));
}

TEST_CASE("a record of nearly 2^63 bytes is refused") {
  const Scratch scratch;
  const auto word = [](std::uint64_t value, int bytes) {
    std::string text;
    while (bytes-- > 0)
      text += static_cast<char>(value >> static_cast<unsigned>(8 * bytes) & 0xffU);
    return text;
  };
  const std::string name = word(1, 8) + std::string("t\0\0\0", 4), none = word(0, 4) + word(0, 8),
                    other = word(1, 8) + std::string("x\0\0\0", 4);
  std::ofstream(scratch / "a.nc", std::ios::binary)
      << "CDF\5" << word(1, 8)                                                          // a record
      << word(10, 4) << word(2, 8) << name << word(0, 8) << other << word(INT64_MAX, 8) // t and x
      << none << word(11, 4) << word(1, 8) << name << word(2, 8) << word(0, 8)
      << word(1, 8) // t(t, x)
      << none << word(1, 4) << word(0, 8) << word(160, 8) << std::string(64, '\0');
  const Error error = error_of([&] { NetcdfReader reader(scratch / "a.nc"); });
  CHECK(has(error.what(), "t is incomplete"));
}

TEST_CASE("files that others wrote: every classic format, padded headers, records") {
  const Scratch scratch;
  for (const int format : {0, NC_64BIT_OFFSET, NC_64BIT_DATA})
    for (const bool records : {false, true})
      for (const std::size_t free_bytes : {std::size_t{0}, std::size_t{1000}}) {
        CAPTURE(format);
        CAPTURE(records);
        const std::string path = foreign(scratch / "a.nc", format, [&](int id) {
          int n, time, v, w;
          nc_def_dim(id, "n", 5, &n);
          nc_def_dim(id, "Time", NC_UNLIMITED, &time);
          const int shape[] = {time, n};
          nc_def_var(id, "v", NC_SHORT, 1, &n, &v);
          nc_put_att_text(id, v, "name", 5, "short");
          nc_def_var(id, "w", NC_FLOAT, records ? 2 : 1, records ? shape : &n, &w);
          nc__enddef(id, free_bytes, 4, 0, 4);
          const short shorts[] = {1, 2, -3, 4, 5};
          nc_put_var_short(id, v, shorts);
          const std::vector<float> floats(15, 2);
          const std::size_t start[] = {0, 0}, count[] = {3, 5};
          nc_put_vara_float(id, w, start, records ? count : count + 1, floats.data());
        });
        {
          const NetcdfReader file(path);
          CHECK(file.ints("v", {5})[2] == -3);
          CHECK(file.ints("w", file.shape_of("w")).back() == 2);
          CHECK(file.dimension("Time") == (records ? 3 : 0));
        }
        const std::string whole = calotte::test::read_file(path);
        for (std::size_t cut = 1; cut < 70; cut += 3) {
          std::ofstream(scratch / "cut", std::ios::binary) << whole.substr(0, whole.size() - cut);
          error_of([&] { NetcdfReader reader(scratch / "cut"); });
        }
      }
}

TEST_CASE("values of every type, alone, in records and beside others, are the C library's") {
  const Scratch scratch;
  constexpr std::size_t records = 40, width = 300;
  for (const int format : {0, NC_64BIT_DATA, NC_NETCDF4})
    for (const bool several : {false, true}) {
      CAPTURE(format);
      CAPTURE(several);
      const int types = format == 0 ? NC_DOUBLE : NC_UINT64;
      const std::string path = foreign(scratch / "a.nc", format, [&](int id) {
        int n, time, v;
        nc_def_dim(id, "n", width, &n);
        nc_def_dim(id, "Time", NC_UNLIMITED, &time);
        const int shape[] = {time, n};
        std::vector<std::string> names;
        for (int type = NC_BYTE; type <= types; ++type)
          if (type != NC_CHAR && (several || type == NC_SHORT)) {
            nc_def_var(id, ("r" + std::to_string(type)).c_str(), type, 2, shape, &v);
            nc_def_var(id, ("f" + std::to_string(type)).c_str(), type, 1, &n, &v);
          }
        nc_enddef(id);
        int variables = 0;
        nc_inq_nvars(id, &variables);
        std::vector<double> values(records * width);
        for (std::size_t i = 0; i < values.size(); ++i)
          values[i] = static_cast<double>(i % 101);
        const std::size_t start[] = {0, 0}, count[] = {records, width};
        for (v = 0; v < variables; ++v)
          REQUIRE(nc_put_vara_double(id, v, start, v % 2 == 0 ? count : count + 1, values.data()) ==
                  NC_NOERR);
      });
      const NetcdfReader file(path);
      const Opened opened(path);
      require_same_header(file, opened);
      for (const std::string& name : file.variable_names()) {
        CAPTURE(name);
        const std::vector<std::int64_t> shape = file.shape_of(name);
        const int v = opened.variable(name.c_str());
        std::vector<double> doubles(shape.size() == 2 ? records * width : width);
        std::vector<std::int32_t> ints(doubles.size());
        REQUIRE(nc_get_var_double(opened.id, v, doubles.data()) == NC_NOERR);
        REQUIRE(nc_get_var_int(opened.id, v, ints.data()) == NC_NOERR);
        CHECK(file.doubles(name, shape) == doubles);
        CHECK(file.ints(name, shape) == ints);
        std::vector<double> sample_rows(doubles.end() - doubles.size() / 4, doubles.end()),
            read(sample_rows);
        std::fill(read.begin(), read.end(), -1);
        file.rows(name, shape[0] - shape[0] / 4, shape[0] / 4, read.data());
        CHECK(read == sample_rows);
        // From within a record to within another, as a subset takes them.
        const std::int64_t size =
            calotte::io_detail::size_of(*file.variables()[static_cast<std::size_t>(v)].type);
        std::string whole(doubles.size() * static_cast<std::size_t>(size), ' '),
            values(whole.size(), ' ');
        const std::size_t last = shape.size() - 1;
        const std::int64_t all = file.product(v, 0, last + 1), slab = shape[last];
        for (std::int64_t row = 0; row < all / slab; ++row)
          file.stored_rows(v, last, row * slab, slab, values.data() + row * slab * size);
        file.stored_rows(v, 0, 0, shape[0], whole.data());
        CHECK(whole == values);
      }
    }
}

TEST_CASE("variables that overlap are damage") {
  const Scratch scratch;
  const std::string path = foreign(scratch / "a.nc", NC_64BIT_OFFSET, [](int id) {
    int n, v;
    nc_def_dim(id, "n", 3, &n);
    nc_def_var(id, "first", NC_DOUBLE, 1, &n, &v);
    nc_def_var(id, "second", NC_DOUBLE, 1, &n, &v);
    nc_enddef(id);
    const double values[] = {1, 2, 3};
    nc_put_var_double(id, v, values);
  });
  std::string bytes = calotte::test::read_file(path);
  const auto header = static_cast<std::size_t>(
      calotte::io_detail::classic_header(calotte::io_detail::FileReader(path)).bytes);
  bytes[header - 1] = static_cast<char>(bytes[header - 1] - 8); // the offset of the second
  calotte::write_file(path, bytes);
  const Error error = error_of([&] { NetcdfReader reader(path); });
  CHECK(error.code() == ErrorCode::parse);
  CHECK(error.what() ==
        path + ": its header is damaged: second begins within another variable; make it again");
  int id = -1;
  CHECK(nc_open(path.c_str(), NC_NOWRITE, &id) != NC_NOERR);
}

TEST_CASE("a pipe is no file that is read at any offset") {
  const Scratch scratch;
  const std::string path = scratch / "pipe.nc";
  REQUIRE(::mkfifo(path.c_str(), 0600) == 0);
  const int held = ::open(path.c_str(), O_RDWR | O_CLOEXEC); // else a reader waits for a writer
  REQUIRE(held >= 0);
  const Error error = error_of([&] { NetcdfReader reader(path); });
  ::close(held);
  CHECK(error.code() == ErrorCode::file);
  CHECK(has(error.what(), "it is a pipe"));
}

TEST_CASE("NetCDF-4 files are read") {
  const Scratch scratch;
  const std::string path = foreign(scratch / "a.nc", NC_NETCDF4, [](int id) {
    int n, v;
    nc_def_dim(id, "n", 3, &n);
    nc_def_var(id, "v", NC_INT64, 1, &n, &v);
    const char* text = "degrees";
    nc_put_att_string(id, v, "units", 1, &text);
    const long long values[] = {1, 2, 3};
    nc_put_var_longlong(id, v, values);
  });
  const NetcdfReader file(path);
  CHECK(file.ints("v", {3}) == std::vector<std::int32_t>{1, 2, 3});
  CHECK(file.text("v", "units") == "degrees");
}

TEST_CASE("a variable that is not as it should be is named") {
  const Scratch scratch;
  const std::string path = foreign(scratch / "a.nc", NC_64BIT_DATA, [](int id) {
    int n, large, fraction, text;
    nc_def_dim(id, "n", 3, &n);
    nc_def_var(id, "large", NC_INT64, 1, &n, &large);
    nc_def_var(id, "fraction", NC_DOUBLE, 1, &n, &fraction);
    nc_def_var(id, "text", NC_CHAR, 1, &n, &text);
    nc_enddef(id);
    const long long numbers[] = {1, 1LL << 31, 3};
    const double fractions[] = {1, 2.5, 3};
    nc_put_var_longlong(id, large, numbers);
    nc_put_var_double(id, fraction, fractions);
    nc_put_var_text(id, text, "abc");
  });
  const NetcdfReader file(path);
  const auto message = [&](const std::string& name, const std::vector<std::int64_t>& shape) {
    const Error error = error_of([&] { file.ints(name, shape); });
    CHECK(error.code() == ErrorCode::parse);
    return std::string(error.what());
  };
  CHECK(message("none", {3}) == path + ": it has no variable none; give a file that has");
  CHECK(has(message("large", {3, -1}), "large has the shape (3) instead of (3, any); make the"));
  CHECK(has(message("large", {4}), "large has the shape (3) instead of (4)"));
  CHECK(has(message("large", {3}), "large has a number out of range; make the file again"));
  CHECK(has(message("fraction", {3}), "fraction has a number that is not a 32-bit integer"));
  CHECK(has(message("text", {3}), "text is text, not numbers"));
}

TEST_CASE("a file is read on after its name is removed or given to another file") {
  const Scratch scratch;
  const std::string path = scratch / "a.nc";
  write_sample(path);
  const NetcdfReader file(path);
  fs::remove(path);
  CHECK(file.doubles("doubles", {sample_rows}).size() == sample_rows);
  calotte::write_file(path, "shorter");
  CHECK(file.ints("ids", {sample_rows, 3}).size() == 3 * sample_rows);
}

TEST_CASE("a file that is cut while it is read is refused") {
  const Scratch scratch;
  const std::string path = scratch / "a.nc";
  write_sample(path);
  const std::string whole = calotte::test::read_file(path);
  for (const std::size_t size : {whole.size() - 1, whole.size() / 2, std::size_t{0}}) {
    CAPTURE(size);
    calotte::write_file(path, whole);
    const NetcdfReader file(path);
    REQUIRE(file.doubles("doubles", {sample_rows}).size() == sample_rows);
    fs::resize_file(path, size);
    const auto check_refused = [&](const auto& read) {
      const Error error = error_of(read);
      CHECK(error.code() == ErrorCode::file);
      CHECK(error.what() ==
            "cannot read " + path + ": it became shorter; check which program writes it");
    };
    std::vector<double> values(3 * 3 * sample_rows);
    check_refused([&] { file.doubles("cube", {3, 3, sample_rows}); });
    check_refused([&] { file.ints("ids", {sample_rows, 3}); });
    check_refused([&] { file.rows("cube", 2, 1, values.data()); });
  }
}
