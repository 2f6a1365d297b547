// SPDX-License-Identifier: GPL-3.0-or-later
#include "c/guard.h"

#include <calotte/error.h>

#include <tbb/task_arena.h>

#include <exception>
#include <new>

namespace calotte::c_detail {
namespace {

thread_local int threads = 0;

constexpr std::size_t before_message = offsetof(calotte_error, message);

bool has_message(const calotte_error& error) { return error.size > before_message; }

void set(calotte_error* error, const char* message, std::int64_t index) {
  if (error == nullptr)
    return;
  const std::size_t room = std::min(error->size - before_message, sizeof error->message);
  const std::size_t length = std::min(std::strlen(message), room - 1);
  error->index = index;
  std::memcpy(error->message, message, length);
  error->message[length] = '\0';
}

} // namespace

void set_threads(int count) { threads = std::max(count, 0); }

calotte_status guarded(calotte_error* error, const std::function<void()>& work) {
  if (error != nullptr && !has_message(*error))
    return CALOTTE_INVALID_ARGUMENT;
  try {
    if (threads == 0)
      work();
    else
      tbb::task_arena(threads).execute(work);
    return CALOTTE_OK;
  } catch (const Error& failure) {
    set(error, failure.what(), failure.index());
    return static_cast<calotte_status>(static_cast<int>(failure.code()) + 1);
  } catch (const std::bad_alloc&) {
    set(error, "not enough memory; give fewer points or use a larger machine", -1);
    return CALOTTE_NO_MEMORY;
  } catch (const std::exception& failure) {
    set(error, failure.what(), -1);
  } catch (...) {
    set(error, "an unknown exception; please report it", -1);
  }
  return CALOTTE_INTERNAL;
}

} // namespace calotte::c_detail
