// Loaded before the C library (LD_PRELOAD): what a program does to the disk goes wrong at
// the call that FAULT_AT counts, from 1.  FAULT says how: "kill" ends the process there
// and then, "short" ends it after half of a write, "full" and "broken" make the call fail
// (ENOSPC, EIO).  FAULT_COUNT names a file that gets the number of calls.
#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

std::atomic<long> calls{0};

template <class Call>
Call* next(Call*, const char* name) {
  return reinterpret_cast<Call*>(dlsym(RTLD_NEXT, name));
}

bool is(const char* fault) {
  const char* asked = std::getenv("FAULT");
  return asked && std::strcmp(asked, fault) == 0;
}

bool now() {
  const char* at = std::getenv("FAULT_AT");
  return ++calls == (at ? std::atol(at) : 0);
}

/// Whether the call fails; a killed process does not come back.
bool fails() {
  if (!now()) return false;
  if (is("kill") || is("short")) kill(getpid(), SIGKILL);
  errno = is("full") ? ENOSPC : EIO;
  return true;
}

struct Report {
  ~Report() {
    const char* file = std::getenv("FAULT_COUNT");
    if (!file) return;
    if (std::FILE* out = std::fopen(file, "w")) {
      std::fprintf(out, "%ld", calls.load());
      std::fclose(out);
    }
  }
} report;

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  std::va_list more;
  va_start(more, flags);
  const mode_t mode = flags & O_CREAT ? va_arg(more, mode_t) : 0;
  va_end(more);
  if ((flags & O_CREAT) && fails()) return -1;
  return next(&open, "open")(path, flags, mode);
}

ssize_t write(int descriptor, const void* bytes, size_t size) {
  const auto real = next(&write, "write");
  if (!now()) return real(descriptor, bytes, size);
  if (is("short")) real(descriptor, bytes, size / 2);
  if (is("kill") || is("short")) kill(getpid(), SIGKILL);
  errno = is("full") ? ENOSPC : EIO;
  return -1;
}

int fsync(int descriptor) { return fails() ? -1 : next(&fsync, "fsync")(descriptor); }

int rename(const char* from, const char* to) {
  return fails() ? -1 : next(&rename, "rename")(from, to);
}

int unlink(const char* path) { return fails() ? -1 : next(&unlink, "unlink")(path); }

int mkdir(const char* path, mode_t mode) {
  return fails() ? -1 : next(&mkdir, "mkdir")(path, mode);
}

}  // extern "C"
