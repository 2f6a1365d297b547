// SPDX-License-Identifier: GPL-3.0-or-later
// A library for LD_PRELOAD: makes the n-th call of one kind fail, as a system without memory or
// with a full disk does. It counts from the start of main() to its end. The environment says what
// fails:
//   CALOTTE_FAULT_KIND   malloc, mmap, open, read, write, short (a write of half the bytes), fsync,
//                        rename, shrink (a read, before which the file is cut to half its size) or
//                        clock (with CALOTTE_FAULT_ON: the time of day jumps by years, up and down,
//                        and the steady clock is a day ahead)
//   CALOTTE_FAULT_AT     number of the call that fails, from 1; 0 counts only
//   CALOTTE_FAULT_ON     set: all later calls fail, too; of malloc, those that need more memory
//                        than has been freed since
//   CALOTTE_FAULT_COUNT  file that receives the number of calls, at the end
// Calls within the C library itself are not seen: fopen() counts as an open. Allocations of the
// NetCDF library, and of HDF5, which it starts when it first opens a file, never fail: without
// memory both dereference null pointers (NetCDF 4.9: NC_var_shape; HDF5 1.10:
// H5TS_cancel_count_dec), call themselves without end (H5E_printf_stack) or abort (ncbytes.c).
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <dirent.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <link.h>
#include <malloc.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <time.h>
#include <unistd.h>

#define CALOTTE_SHIM extern "C" __attribute__((visibility("default")))

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void __libc_free(void*);
}

namespace {

enum Kind {
  none,
  memory,
  mapping,
  opening,
  reading,
  writing,
  shortened,
  syncing,
  renaming,
  shrinking,
  jumping
};

struct Fault {
  Kind kind = none;
  long at = 0;
  bool on = false;
};

Fault fault;                       // set before the first count
std::atomic<bool> running = false; // main() runs
std::atomic<long> calls = 0;
std::atomic<long> freed = 0; // bytes, since memory ran out
std::atomic<bool> exhausted = false;

thread_local bool in_netcdf = false; // opens a file

struct Code {
  std::uintptr_t begin = 0, end = 0;
};
std::array<Code, 8> spared = {}; // of HDF5 and the NetCDF library
std::size_t spared_count = 0;

int find_spared(dl_phdr_info* object, std::size_t, void*) {
  if (std::strstr(object->dlpi_name, "libhdf5") == nullptr &&
      std::strstr(object->dlpi_name, "libnetcdf") == nullptr)
    return 0;
  for (int k = 0; k < object->dlpi_phnum; ++k)
    if (const auto& part = object->dlpi_phdr[k];
        part.p_type == PT_LOAD && (part.p_flags & PF_X) != 0 && spared_count < spared.size()) {
      const std::uintptr_t begin = object->dlpi_addr + part.p_vaddr;
      spared[spared_count++] = {begin, begin + part.p_memsz};
    }
  return 0;
}

Kind kind_of(const char* word) {
  const char* const words[] = {"",      "malloc", "mmap",   "open",   "read", "write",
                               "short", "fsync",  "rename", "shrink", "clock"};
  for (int kind = memory; kind <= jumping; ++kind)
    if (std::strcmp(word, words[kind]) == 0)
      return static_cast<Kind>(kind);
  return none;
}

bool fails(Kind kind) {
  if (!running || kind != fault.kind)
    return false;
  const long call = ++calls;
  return fault.at > 0 && (fault.on ? call >= fault.at : call == fault.at);
}

/// \param caller where the allocation returns to.
bool allocation_fails(std::size_t size, void* caller) {
  if (fault.kind != memory || in_netcdf)
    return false;
  const auto place = reinterpret_cast<std::uintptr_t>(caller);
  for (const Code& code : spared)
    if (place >= code.begin && place < code.end)
      return false;
  if (!fails(memory))
    return false;
  if (!fault.on)
    return true;
  exhausted = true;
  const long bytes = static_cast<long>(size) + 32; // with the allocator's own
  for (long left = freed; left >= bytes;)
    if (freed.compare_exchange_weak(left, left - bytes))
      return false;
  return true;
}

void note_freed(void* data) {
  if (exhausted && data != nullptr)
    freed += static_cast<long>(::malloc_usable_size(data));
}

template <class T> T refuse(int error, T result) {
  errno = error;
  return result;
}

/// The function of that name in the library that would be called without this one.
template <class Function> Function* next(Function*, const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

#define CALOTTE_NEXT(function) (next(&::function, #function))

void end() {
  running = false;
  const char* file = std::getenv("CALOTTE_FAULT_COUNT");
  if (file == nullptr)
    return;
  char text[32];
  const int size = std::snprintf(text, sizeof text, "%ld\n", calls.load());
  const long descriptor = ::syscall(SYS_openat, AT_FDCWD, file, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  ::syscall(SYS_write, descriptor, text, static_cast<std::size_t>(size));
  ::syscall(SYS_close, descriptor);
}

using Main = int(int, char**, char**);
Main* program = nullptr;

int counted_main(int argc, char** argv, char** environment) {
  const char *kind = std::getenv("CALOTTE_FAULT_KIND"), *at = std::getenv("CALOTTE_FAULT_AT");
  fault.kind = kind != nullptr ? kind_of(kind) : none;
  fault.at = at != nullptr ? std::atol(at) : 0;
  fault.on = std::getenv("CALOTTE_FAULT_ON") != nullptr;
  ::dl_iterate_phdr(find_spared, nullptr);
  running = true;
  const int code = program(argc, argv, environment);
  end();
  return code;
}

/// Messages to standard error are always written: the test reads them.
bool write_fails(int descriptor) { return descriptor != STDERR_FILENO && fails(writing); }

std::size_t length_of_write(int descriptor, std::size_t size) {
  return size > 1 && descriptor != STDERR_FILENO && fails(shortened) ? size / 2 : size;
}

} // namespace

CALOTTE_SHIM int __libc_start_main(Main* main, int argc, char** argv, void (*init)(),
                                   void (*finish)(), void (*loader)(), void* stack) {
  using Start = int(Main*, int, char**, void (*)(), void (*)(), void (*)(), void*);
  program = main;
  const auto start = reinterpret_cast<Start*>(::dlsym(RTLD_NEXT, "__libc_start_main"));
  return start(counted_main, argc, argv, init, finish, loader, stack);
}

// ---- Memory

#define CALOTTE_CALLER __builtin_return_address(0)

CALOTTE_SHIM void* malloc(std::size_t size) {
  return allocation_fails(size, CALOTTE_CALLER) ? refuse(ENOMEM, nullptr) : __libc_malloc(size);
}
CALOTTE_SHIM void* calloc(std::size_t count, std::size_t size) {
  return allocation_fails(count * size, CALOTTE_CALLER) ? refuse(ENOMEM, nullptr)
                                                        : __libc_calloc(count, size);
}
CALOTTE_SHIM void* realloc(void* old, std::size_t size) {
  return allocation_fails(size, CALOTTE_CALLER) ? refuse(ENOMEM, nullptr)
                                                : __libc_realloc(old, size);
}
CALOTTE_SHIM void* memalign(std::size_t alignment, std::size_t size) {
  return allocation_fails(size, CALOTTE_CALLER) ? refuse(ENOMEM, nullptr)
                                                : __libc_memalign(alignment, size);
}
CALOTTE_SHIM void* aligned_alloc(std::size_t alignment, std::size_t size) {
  return memalign(alignment, size);
}
CALOTTE_SHIM int posix_memalign(void** result, std::size_t alignment, std::size_t size) {
  void* data = memalign(alignment, size);
  if (data == nullptr)
    return ENOMEM;
  *result = data;
  return 0;
}
CALOTTE_SHIM void free(void* data) {
  note_freed(data);
  __libc_free(data);
}

CALOTTE_SHIM void* mmap(void* place, std::size_t size, int protection, int flags, int file,
                        off_t offset) {
  return fails(mapping) ? refuse(ENOMEM, MAP_FAILED)
                        : CALOTTE_NEXT(mmap)(place, size, protection, flags, file, offset);
}
CALOTTE_SHIM void* mmap64(void* place, std::size_t size, int protection, int flags, int file,
                          off64_t offset) {
  return mmap(place, size, protection, flags, file, offset);
}

// ---- The NetCDF library

namespace {

template <class Function> int call_spared(Function* function, const char* path, int mode, int* id) {
  in_netcdf = true;
  const int code = function(path, mode, id);
  in_netcdf = false;
  return code;
}

} // namespace

extern "C" int nc_open(const char*, int, int*);
extern "C" int nc_create(const char*, int, int*);

CALOTTE_SHIM int nc_open(const char* path, int mode, int* id) {
  return call_spared(CALOTTE_NEXT(nc_open), path, mode, id);
}
CALOTTE_SHIM int nc_create(const char* path, int mode, int* id) {
  return call_spared(CALOTTE_NEXT(nc_create), path, mode, id);
}

// ---- Opening

namespace {

int open_at(int folder, const char* path, int flags, mode_t mode) {
  if (fails(opening))
    return refuse(EMFILE, -1);
  return static_cast<int>(::syscall(SYS_openat, folder, path, flags, mode));
}

} // namespace

#define CALOTTE_OPEN(folder)                                                                       \
  std::va_list more;                                                                               \
  va_start(more, flags);                                                                           \
  const mode_t mode = (flags & (O_CREAT | __O_TMPFILE)) != 0 ? va_arg(more, mode_t) : 0;           \
  va_end(more);                                                                                    \
  return open_at(folder, path, flags, mode)

CALOTTE_SHIM int open(const char* path, int flags, ...) { CALOTTE_OPEN(AT_FDCWD); }
CALOTTE_SHIM int open64(const char* path, int flags, ...) { CALOTTE_OPEN(AT_FDCWD); }
CALOTTE_SHIM int openat(int folder, const char* path, int flags, ...) { CALOTTE_OPEN(folder); }
CALOTTE_SHIM int openat64(int folder, const char* path, int flags, ...) { CALOTTE_OPEN(folder); }
CALOTTE_SHIM int __open_2(const char* path, int flags) { return open_at(AT_FDCWD, path, flags, 0); }
CALOTTE_SHIM int __open64_2(const char* path, int flags) {
  return open_at(AT_FDCWD, path, flags, 0);
}
CALOTTE_SHIM std::FILE* fopen(const char* path, const char* mode) {
  return fails(opening) ? refuse(EMFILE, nullptr) : CALOTTE_NEXT(fopen)(path, mode);
}
CALOTTE_SHIM std::FILE* fopen64(const char* path, const char* mode) {
  return fails(opening) ? refuse(EMFILE, nullptr) : CALOTTE_NEXT(fopen64)(path, mode);
}
CALOTTE_SHIM DIR* opendir(const char* path) {
  return fails(opening) ? refuse(EMFILE, nullptr) : CALOTTE_NEXT(opendir)(path);
}

// ---- Reading and writing

namespace {

bool read_fails(int file) {
  struct stat status = {};
  if (fault.kind == shrinking && file > STDERR_FILENO && ::fstat(file, &status) == 0 &&
      S_ISREG(status.st_mode) && fails(shrinking)) {
    char path[32];
    std::snprintf(path, sizeof path, "/proc/self/fd/%d", file);
    if (::truncate(path, status.st_size / 2) != 0)
      std::abort();
  }
  return fails(reading);
}

} // namespace

CALOTTE_SHIM ssize_t read(int file, void* data, std::size_t size) {
  return read_fails(file) ? refuse(EIO, ssize_t{-1}) : CALOTTE_NEXT(read)(file, data, size);
}
CALOTTE_SHIM ssize_t pread(int file, void* data, std::size_t size, off_t offset) {
  return read_fails(file) ? refuse(EIO, ssize_t{-1})
                          : CALOTTE_NEXT(pread)(file, data, size, offset);
}
CALOTTE_SHIM ssize_t pread64(int file, void* data, std::size_t size, off64_t offset) {
  return pread(file, data, size, offset);
}

CALOTTE_SHIM ssize_t write(int file, const void* data, std::size_t size) {
  if (write_fails(file))
    return refuse(ENOSPC, ssize_t{-1});
  return CALOTTE_NEXT(write)(file, data, length_of_write(file, size));
}
CALOTTE_SHIM ssize_t pwrite(int file, const void* data, std::size_t size, off_t offset) {
  if (write_fails(file))
    return refuse(ENOSPC, ssize_t{-1});
  return CALOTTE_NEXT(pwrite)(file, data, length_of_write(file, size), offset);
}
CALOTTE_SHIM ssize_t pwrite64(int file, const void* data, std::size_t size, off64_t offset) {
  return pwrite(file, data, size, offset);
}
CALOTTE_SHIM ssize_t writev(int file, const iovec* parts, int count) {
  return write_fails(file) ? refuse(ENOSPC, ssize_t{-1}) : CALOTTE_NEXT(writev)(file, parts, count);
}

// ---- Keeping

CALOTTE_SHIM int fsync(int file) {
  return fails(syncing) ? refuse(EIO, -1) : CALOTTE_NEXT(fsync)(file);
}
CALOTTE_SHIM int fdatasync(int file) {
  return fails(syncing) ? refuse(EIO, -1) : CALOTTE_NEXT(fdatasync)(file);
}
CALOTTE_SHIM int rename(const char* from, const char* to) {
  return fails(renaming) ? refuse(EACCES, -1) : CALOTTE_NEXT(rename)(from, to);
}

// ---- Time

CALOTTE_SHIM int clock_gettime(clockid_t clock, timespec* time) {
  const int result = CALOTTE_NEXT(clock_gettime)(clock, time);
  const bool jumps = fails(jumping);
  constexpr time_t day = 86400, years = 3650 * day;
  if (jumps && clock == CLOCK_REALTIME)
    time->tv_sec += calls % 2 == 0 ? years : -years;
  else if (jumps)
    time->tv_sec += day;
  return result;
}
