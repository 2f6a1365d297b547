// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/message.h"
#include "cvt/state.h"
#include "io/bytes/binary.h"
#include "io/bytes/file.h"
#include "io/bytes/file_error.h"
#include "io/formats/formats.h"

#include <calotte/checkpoint.h>
#include <calotte/error.h>
#include <calotte/read.h>
#include <calotte/write.h>

#include <boost/crc.hpp>

#include <algorithm>
#include <type_traits>

// The format: a head with the name of the format, its version and the byte order; the
// configuration; the command; the fields of State in a fixed order, each array after its length as
// Int64; and the CRC-32 of all that.

namespace calotte {
namespace {

using namespace io_detail;
using base_detail::CompactField;
using cvt_detail::State;

constexpr std::string_view checkpoint_format = "calotte checkpoint ";

std::string checkpoint_head() {
  std::string line(checkpoint_format);
  line += "15, ";
  line += little_endian ? "little" : "big";
  line += "-endian\n";
  return line;
}

/// Visits the fields of an iteration, for writing and for reading.
template <class Iteration, class Visit> void visit_iteration(Iteration& i, const Visit& visit) {
  visit(i.cells), visit(i.spacing), visit(i.rule), visit(i.linear_density), visit(i.l2),
      visit(i.linf), visit(i.gradient), visit(i.energy), visit(i.shape_excess),
      visit(i.off_centroid), visit(i.largest_offset);
  visit(i.accepted), visit(i.flips), visit(i.rebuilt), visit(i.seconds);
  visit(i.seconds_exchange), visit(i.seconds_repair), visit(i.seconds_moments);
  visit(i.seconds_solver);
}

template <class Region, class Visit> void visit_region(Region& r, const Visit& visit) {
  visit(r.sites), visit(r.seconds);
}

template <class Action, class Visit> void visit_action(Action& a, const Visit& visit) {
  visit(a.kind), visit(a.cells), visit(a.times), visit(a.norm), visit(a.tolerance),
      visit(a.max_iterations);
}

template <class Done, class Visit> void visit_done(Done& d, const Visit& visit) {
  visit(d.times), visit(d.iterations), visit(d.cells);
}

template <class State, class Visit> void visit_scalars(State& s, const Visit& visit) {
  visit(s.fixed);
  visit(s.cursor.action), visit(s.cursor.times), visit(s.cursor.idle), visit(s.cursor.glides);
  visit(s.polish.penalty), visit(s.polish.demanded_spacing), visit(s.polish.descended);
  visit(s.memory.since_laplacian), visit(s.memory.flipped), visit(s.memory.stride),
      visit(s.memory.iterations), visit(s.memory.since_restart), visit(s.memory.final_rule),
      visit(s.memory.stuck);
  visit(s.report.converged), visit(s.report.residual), visit(s.report.seconds);
}

/// What follows an array's length: points, ids, or a list of points.
template <class State, class Visit> void visit_arrays(State& s, const Visit& visit) {
  visit(s.points), visit(s.id), visit(s.site_of_input);
  visit(s.memory.steps), visit(s.memory.changes), visit(s.memory.curvatures);
  visit(s.memory.laplacian_at);
}

// ---- Writing

/// Writes an array after its length.
struct Put {
  Writer* out;
  void operator()(const Points3& points) const {
    out->raw(std::int64_t{points.cols()}).text(bytes_of(points.data(), points.size()));
  }
  template <class T> void operator()(const std::vector<T>& values) const {
    out->raw(std::ssize(values)).text(bytes_of(values.data(), std::ssize(values)));
  }
  void operator()(const std::vector<CompactField>& list) const {
    out->raw(std::ssize(list));
    for (const CompactField& field : list)
      out->raw(field.scale)
          .raw(std::int64_t{field.values.cols()})
          .text(bytes_of(field.values.data(), field.values.size()));
  }
};

void put_checkpoint(const Sink& sink, const State& state, const std::string& configuration,
                    const std::string& command) {
  Writer out(sink);
  const auto raw = [&](const auto& value) { out.raw(value); };
  out.text(checkpoint_head());
  out.raw(std::ssize(configuration)).text(configuration);
  out.raw(std::ssize(command)).text(command);
  visit_arrays(state, Put{&out});
  visit_scalars(state, raw);
  out.raw(std::ssize(state.report.actions));
  for (const CvtAction& action : state.report.actions)
    visit_action(action, raw);
  out.raw(std::ssize(state.report.done));
  for (const CvtDone& done : state.report.done)
    visit_done(done, raw);
  out.raw(std::ssize(state.report.iterations));
  for (const CvtIteration& iteration : state.report.iterations)
    visit_iteration(iteration, raw);
  out.raw(std::ssize(state.report.regions));
  for (const CvtRegion& region : state.report.regions)
    visit_region(region, raw);
  out.flush();
}

// ---- Reading

/// Reads the next value of its own type.
struct Take {
  Bytes* bytes;
  template <class T> void operator()(T& value) const {
    if constexpr (std::is_same_v<T, bool>)
      value = *bytes->take(1).data() != 0;
    else
      value = load<T>(bytes->take(sizeof value).data());
  }
};

std::int64_t take_count(Bytes& bytes) {
  constexpr std::int64_t most = std::int64_t{1} << 40;
  std::int64_t count = 0;
  Take{&bytes}(count);
  if (count < 0 || count > most)
    bytes.fail("a length is out of range; use another checkpoint or start anew");
  return count;
}

/// Reads an array and its length.
struct TakeArray {
  Bytes* bytes;
  void operator()(Points3& points) const { take_columns(points); }
  template <class T> void operator()(std::vector<T>& values) const {
    const std::int64_t count = take_count(*bytes);
    const std::string_view raw = bytes->take(static_cast<std::int64_t>(sizeof(T)) * count);
    values.resize(static_cast<std::size_t>(count));
    std::copy(raw.begin(), raw.end(), reinterpret_cast<char*>(values.data()));
  }
  void operator()(std::vector<CompactField>& list) const {
    for (std::int64_t k = take_count(*bytes); k > 0; --k) {
      CompactField& field = list.emplace_back();
      Take{bytes}(field.scale);
      take_columns(field.values);
    }
  }

private:
  /// Reads a matrix of three rows and, before it, the number of its columns.
  template <class Matrix> void take_columns(Matrix& matrix) const {
    const std::int64_t count = take_count(*bytes);
    const std::string_view raw =
        bytes->take(static_cast<std::int64_t>(3 * sizeof(typename Matrix::Scalar)) * count);
    matrix.resize(3, count);
    std::copy(raw.begin(), raw.end(), reinterpret_cast<char*>(matrix.data()));
  }
};

State take_state(Bytes& bytes) {
  State state;
  visit_arrays(state, TakeArray{&bytes});
  const Take take{&bytes};
  visit_scalars(state, take);
  for (std::int64_t k = take_count(bytes); k > 0; --k)
    visit_action(state.report.actions.emplace_back(), take);
  for (std::int64_t k = take_count(bytes); k > 0; --k)
    visit_done(state.report.done.emplace_back(), take);
  for (std::int64_t k = take_count(bytes); k > 0; --k)
    visit_iteration(state.report.iterations.emplace_back(), take);
  for (std::int64_t k = take_count(bytes); k > 0; --k)
    visit_region(state.report.regions.emplace_back(), take);
  bytes.finish();
  return state;
}

/// The content after the head. \throws Error parse.
std::string_view skip_head(const std::string& path, std::string_view content) {
  const Bytes bytes(content, path);
  const std::string expected = checkpoint_head();
  const std::string_view start = content.substr(0, expected.size());
  if (start != expected) {
    if (expected.starts_with(start))
      bytes.fail("the checkpoint is cut short; use another or start anew");
    if (start.starts_with(checkpoint_format))
      bytes.fail("a checkpoint of another version of calotte or kind of machine; finish the run "
                 "there or start anew");
    bytes.fail("not a checkpoint; give the file that a run wrote as its checkpoint");
  }
  return content.substr(expected.size());
}

/// The content between head and checksum. \throws Error parse.
std::string_view find_body(const std::string& path, std::string_view content) {
  const std::string_view body = skip_head(path, content);
  boost::crc_32_type checksum;
  constexpr std::size_t size = sizeof checksum.checksum();
  const std::size_t checked = body.size() < size ? 0 : content.size() - size;
  checksum.process_bytes(content.data(), checked);
  if (checked == 0 ||
      load<decltype(checksum.checksum())>(content.data() + checked) != checksum.checksum())
    Bytes(content, path).fail("the checkpoint is cut short or damaged; use another or start anew");
  return body.substr(0, body.size() - size);
}

/// Removes the next line from the text and returns it.
std::string take_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  const std::string line(text.substr(0, end));
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return line.empty() ? "nothing more" : message("\"{}\"", line);
}

void require_same(const std::string& path, std::string_view theirs, std::string_view ours) {
  if (theirs == ours)
    return;
  std::string their_line, our_line;
  do {
    their_line = take_line(theirs);
    our_line = take_line(ours);
  } while (their_line == our_line && !(theirs.empty() && ours.empty()));
  refuse_path(path,
              "a checkpoint of another configuration: it has {} where this run has {}; give the "
              "same options or start anew",
              their_line, our_line);
}

} // namespace

void write_checkpoint(const std::string& path, const CvtState& state,
                      const std::string& configuration, const std::string& command) {
  OutputFile file(path);
  boost::crc_32_type checksum;
  const auto sink = [&](std::string_view bytes) {
    checksum.process_bytes(bytes.data(), bytes.size());
    file.append(bytes);
  };
  put_checkpoint(sink, State::of(state), configuration, command);
  const auto sum = checksum.checksum();
  file.append({reinterpret_cast<const char*>(&sum), sizeof sum});
  file.commit();
}

CvtState read_checkpoint(const std::string& path, const std::string& configuration) {
  std::ifstream in = open_input(path);
  const std::string content = read_all(in, path);
  Bytes bytes(find_body(path, content), path);
  const std::int64_t words = take_count(bytes);
  require_same(path, bytes.take(words), configuration);
  bytes.take(take_count(bytes)); // the command
  return State::wrapped(take_state(bytes));
}

std::string read_checkpoint_command(const std::string& path) {
  constexpr std::size_t most = std::size_t{1} << 20;
  std::ifstream in = open_input(path);
  std::string start(most, '\0');
  read_some(in, start.data(), std::ssize(start), path);
  start.resize(static_cast<std::size_t>(in.gcount()));
  Bytes bytes(start.size() < most ? find_body(path, start) : skip_head(path, start), path);
  bytes.take(take_count(bytes)); // the configuration
  return std::string(bytes.take(take_count(bytes)));
}

} // namespace calotte
