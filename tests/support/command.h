// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "support/text.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include <sys/wait.h>
#include <unistd.h>

/// Runs the command as a user does: in a shell, in a temporary folder. CALOTTE_COMMAND is its path.
namespace calotte::test {

inline std::string contents(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

struct Outcome {
  int code; ///< the exit code, or minus the number of the signal that ended it
  std::string out, err;
};

/// A temporary folder, removed at the end of the test, in which the command runs.
class Bench {
public:
  Bench() {
    std::string name = std::filesystem::temp_directory_path() / "calotte-command-XXXXXX";
    scratch_ = ::mkdtemp(name.data());
    std::filesystem::create_directory(folder());
  }
  ~Bench() { std::filesystem::remove_all(scratch_); }
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  std::filesystem::path folder() const { return scratch_ / "work"; }

  std::string path(const std::string& name) const { return folder() / name; }

  void file(const std::string& name, const std::string& text) const {
    std::ofstream(folder() / name, std::ios::binary) << text;
  }

  std::string file(const std::string& name) const { return contents(folder() / name); }

  /// Starts the command and returns its process id.
  /// \param arguments in the shell's syntax, redirections included.
  /// \param before a command for the shell, ended by a semicolon.
  pid_t start(const std::string& arguments, const std::string& before = "") const {
    // On a busy machine any run may last long enough for a log.
    const std::string line = "cd '" + folder().string() + "' && { export CALOTTE_LOG_AFTER=1e9; " +
                             before + " exec '" + CALOTTE_COMMAND "' " + arguments + "; } >'" +
                             (scratch_ / "out").string() + "' 2>'" + (scratch_ / "err").string() +
                             "'";
    const pid_t process = ::fork();
    if (process == 0) {
      ::execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
      ::_exit(127);
    }
    return process;
  }

  /// What it has written to standard error so far.
  std::string err() const { return contents(scratch_ / "err"); }

  /// Waits for its end.
  Outcome finish(pid_t process) const {
    int status = 0;
    REQUIRE(::waitpid(process, &status, 0) == process);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), contents(scratch_ / "out"),
            err()};
  }

  Outcome run(const std::string& arguments, const std::string& before = "") const {
    return finish(start(arguments, before));
  }

  std::set<std::string> names() const {
    std::set<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(folder()))
      found.insert(entry.path().filename());
    return found;
  }

private:
  std::filesystem::path scratch_;
};

inline bool one_line(const std::string& text) {
  return !text.empty() && std::count(text.begin(), text.end(), '\n') == 1 && text.back() == '\n';
}

/// The argument of --density for cells that are `contrast` times wider far from its bump.
inline std::string bump_density(int contrast) {
  return "tanh:lon=270,lat=30,beta=30deg,alpha=0.20,gamma=x" + std::to_string(contrast);
}

/// Runs the command and checks that it succeeds.
inline Outcome check_success(const Bench& bench, const std::string& arguments) {
  CAPTURE(arguments);
  Outcome outcome = bench.run(arguments);
  CAPTURE(outcome.err);
  CHECK(outcome.code == 0);
  return outcome;
}

/// Checks commands that are refused: each ends with its code and one line with its text on standard
/// error, prints nothing else and leaves no new file.
/// \param shared the first arguments of all.
/// \param table lines "arguments | exit code | text", where the text is the part of the message
/// that
///   tells what is wrong, and the remedy.
/// \param before a command for the shell, ended by a semicolon.
inline void check_refusals(const Bench& bench, const std::string& shared, const std::string& table,
                           const std::string& before = "") {
  std::istringstream rows(table);
  for (std::string row; std::getline(rows, row);) {
    if (row.empty())
      continue;
    CAPTURE(shared);
    CAPTURE(row);
    const std::size_t code = row.find("| "), text = row.find(" | ", code + 2);
    REQUIRE(text != std::string::npos);
    const auto names = bench.names();
    const Outcome outcome = bench.run(shared + " " + row.substr(0, code), before);
    CAPTURE(outcome.err);
    CHECK(outcome.code == std::stoi(row.substr(code + 2)));
    CHECK(one_line(outcome.err));
    CHECK(outcome.err.starts_with("calotte: "));
    CHECK(has(outcome.err, row.substr(text + 3)));
    CHECK(outcome.out.empty());
    CHECK(bench.names() == names);
  }
}

} // namespace calotte::test
