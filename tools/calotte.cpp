// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"
#include "help/help.h"
#include "help/unknown_word.h"
#include "options/warning.h"
#include "run/exit_code.h"
#include "run/interruption.h"
#include "text/text.h"

#include <calotte/error.h>
#include <calotte/version.h>

#include <CLI/App.hpp>

#include <gmp.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace calotte::tools {
namespace {

constexpr const char* no_memory = "not enough memory; try fewer points";

/// Whether oneTBB could not start a thread: it throws a std::runtime_error that says so.
bool lacks_threads(const std::exception& error) {
  return std::string_view(error.what()).starts_with("pthread_create");
}

ExitCode exit_code(ErrorCode code) {
  switch (code) {
  case ErrorCode::file:
    return file_trouble;
  case ErrorCode::cancelled: // unexpected here: no command cancels its run
  case ErrorCode::internal:
    return internal_error;
  default:
    return bad_input;
  }
}

void run(CLI::App& app, int argc, char** argv) {
  set_main_help(app); // before the subcommands, which inherit its options
  app.set_version_flag("--version", std::string("calotte " CALOTTE_VERSION));
  app.require_subcommand(0, 1);
  add_delaunay(app);
  add_cvt(app);
  add_plan(app);
  add_points(app);
  add_check(app);
  add_info(app);
  add_draw(app);
  add_view(app);
  add_convert(app);
  add_cut(app);
  add_cull(app);
  add_coast(app);
  add_refine(app);
  add_coarsen(app);
  add_rotate(app);
  add_interpolate(app);
  add_partition(app);
  add_jigsaw(app);
  add_marche(app);
  add_version(app);
  add_help(app);
  app.parse(argc, argv);
  if (app.get_subcommands().empty()) // as calotte help
    std::cout << app.help();
}

/// Whether the command that was given has an option.
bool has_option(const CLI::App& app, const std::string& option) {
  return std::ranges::any_of(app.get_subcommands(), [&](const CLI::App* command) {
    return command->get_option_no_throw(option) != nullptr;
  });
}

/// The remedy where the file that cannot be read is a value without its option, or a unit that a
/// blank separates from its number; "" for other files.
std::string with_value(const CLI::App& app, const std::string& text) {
  constexpr std::string_view start = "cannot read ";
  const std::string name =
      text.starts_with(start) ? text.substr(start.size(), text.find(':') - start.size()) : "";
  for (const std::string_view unit : {"km", "m", "deg"})
    if (name == unit)
      return message("; a number and its unit are one word, such as 60{}", unit);
  const bool number = !name.empty() && name.find_first_not_of("0123456789") == name.npos;
  return number && has_option(app, "--cells") ? message("; a number of cells is --cells {}", name)
                                              : "";
}

/// A message of the library, with the option that is its remedy here.
std::string with_option(const CLI::App& app, const std::string& text) {
  static const std::vector<std::pair<std::string, std::string>> options{
      {"read them as longitude and latitude, or as places in a plane", " (--lonlat, --plane)"},
      {"give the points they refer to", " (--points FILE)"},
      {"as an option or as the file's \"outsideWidth\"", " (--outside-width)"},
      {"as an option or as the file's \"insideWidth\"", " (--inside-width)"},
      {"as an option or as the file's \"transition\"", " (--transition)"},
      {"as an option or as a property \"cellWidth\"", " (--inside-width)"},
      {"name one, or give a file with one", " (--raster-variable, or variable of a rule)"},
      {"if they are fractions of land or sea, say so", " (--raster-values)"},
      {"choose one index of each:", " --at"},
      {"or tell the sea by a field", " (--field)"},
      {"give the method conservative or nearest", " (--method)"},
      {"has the name of a coordinate; leave it out", " (--fields)"},
      {"give the mesh, too", " (--mesh FILE of draw, view, info and interpolate)"}};
  for (const auto& [remedy, option] : options)
    if (const std::size_t at = text.rfind(remedy); at != text.npos)
      return std::string(text).insert(at + remedy.size(), option);
  return text + with_value(app, text);
}

/// The message about a command line that cannot be read. A misspelt option comes first: the option
/// that it stands for may be the one that is missing.
std::string message_of(const CLI::App& app, const CLI::ParseError& error) {
  const bool extras = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
  if (extras || dynamic_cast<const CLI::RequiredError*>(&error) != nullptr)
    if (const std::string unknown = unknown_word(app); !unknown.empty())
      return unknown;
  return message("{}; see {}", error.what(), help_of(app));
}

/// Shows the help or the version, unless these belong to a command that is unknown.
ExitCode show(CLI::App& app, const CLI::Success& request) {
  if (app.get_subcommands().empty() && !app.remaining().empty()) {
    complain(unknown_word(app));
    return bad_input;
  }
  app.exit(request);
  return done;
}

/// Runs the command, and converts an exception to one line and an exit code.
ExitCode guarded_run(CLI::App& app, int argc, char** argv) {
  try {
    run(app, argc, argv);
    return done;
  } catch (const CLI::Success& request) { // --help, --version
    return show(app, request);
  } catch (const CLI::RuntimeError& finished) {
    return static_cast<ExitCode>(finished.get_exit_code());
  } catch (const CLI::ParseError& error) {
    complain(message_of(app, error));
    return bad_input;
  } catch (const Error& error) {
    const bool bug = error.code() == ErrorCode::internal;
    complain((bug ? "internal error, please report it: " : "") + with_option(app, error.what()));
    return exit_code(error.code());
  } catch (const std::bad_alloc&) {
    complain(no_memory);
    return internal_error;
  } catch (const std::exception& error) {
    if (lacks_threads(error)) {
      complain("the system starts no more threads; give fewer with --threads, or raise its limit");
      return internal_error;
    }
    complain("internal error, please report it: " + std::string(error.what()));
    return internal_error;
  }
}

/// Memory that is freed when there is none left: unwinding needs some, for instance to destroy JSON
/// values, and so does the message.
std::atomic<void*> reserve = nullptr;

[[noreturn]] void handle_no_memory() {
  std::free(reserve.exchange(nullptr));
  throw std::bad_alloc();
}

void keep_reserve() {
  reserve = std::malloc(std::size_t{1} << 20);
  std::set_new_handler(handle_no_memory);
}

/// Lets the C library keep freed memory for later blocks. cvt of 2.6 million cells otherwise
/// touches three times the pages that it holds at its peak, and the first touch of a page costs up
/// to 12 us on a virtual machine whose host takes free memory back. One heap for all threads wastes
/// the least. A library that others link must leave this to the process.
void keep_freed_memory() {
#ifdef __GLIBC__
  mallopt(M_ARENA_MAX, 1);
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, -1); // never
  mallopt(M_TOP_PAD, 64 << 20);
#endif
}

/// GMP ends the process where its own functions find no memory; these throw.
void let_gmp_throw() {
  mp_set_memory_functions([](std::size_t bytes) { return ::operator new(bytes); },
                          [](void* block, std::size_t before, std::size_t bytes) {
                            void* const larger = ::operator new(bytes);
                            std::memcpy(larger, block, std::min(before, bytes));
                            ::operator delete(block);
                            return larger;
                          },
                          [](void* block, std::size_t) { ::operator delete(block); });
}

std::terminate_handler terminate_otherwise = nullptr;

/// Memory can end in a function that may not throw: CLI11 finds options in such ones.
[[noreturn]] void terminate() {
  try {
    if (const std::exception_ptr error = std::current_exception())
      std::rethrow_exception(error);
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "calotte: %s\n", no_memory);
    std::_Exit(internal_error);
  } catch (...) { // a bug: as without this handler
  }
  terminate_otherwise();
  std::abort();
}

} // namespace
} // namespace calotte::tools

int main(int argc, char** argv) try {
  using namespace calotte::tools;
  // Makes a file larger than the limit an error like a full disk, instead of a fatal signal.
  std::signal(SIGXFSZ, SIG_IGN);
  keep_freed_memory();
  keep_reserve();
  let_gmp_throw();
  announce_end();
  terminate_otherwise = std::set_terminate(calotte::tools::terminate);
  std::ios::sync_with_stdio(false);
  CLI::App app(
      "Makes grids of the sphere and the plane: centroidal Voronoi tessellations (CVTs) and "
      "exact Delaunay triangulations.",
      "calotte");
  const ExitCode code = guarded_run(app, argc, argv);
  if (code == done && !std::cout.flush()) {
    complain("cannot write standard output; free disk space or redirect it");
    return file_trouble;
  }
  return code;
} catch (...) { // no memory even for a message
  return calotte::tools::internal_error;
}
