#include "output.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <system_error>

namespace turnwright::app {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, int error) {
  throw OutputError(file.string() + ": cannot be written: " + std::strerror(error));
}

/// An open file, closed when it goes out of scope.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }

 private:
  int fd_;
};

/// 0, or the error number.
int write_all(int fd, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const auto count = ::write(fd, text.data() + done, text.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    done += static_cast<std::size_t>(count);
  }
  return 0;
}

int write_straight(const fs::path& file, const std::string& text) {
  const Descriptor out(::open(file.c_str(), O_WRONLY | O_CLOEXEC));
  return out.get() < 0 ? errno : write_all(out.get(), text);
}

int write_beside(const fs::path& temporary, mode_t mode, const std::string& text) {
  const Descriptor out(
      ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, mode));
  if (out.get() < 0) return errno;
  if (const int error = write_all(out.get(), text)) return error;
  return ::fsync(out.get()) == 0 ? 0 : errno;
}

}  // namespace

void write_file(const fs::path& file, const std::string& text) {
  std::error_code unresolved;
  fs::path target = fs::weakly_canonical(file, unresolved);
  if (unresolved) target = file;

  struct stat old {};
  const bool exists = ::stat(target.c_str(), &old) == 0;
  if (exists && !S_ISREG(old.st_mode)) {
    if (const int error = write_straight(target, text)) fail(file, error);
    return;
  }
  const auto temporary = target.parent_path() / ('.' + target.filename().string() + '.' +
                                                 std::to_string(::getpid()));
  const mode_t mode = exists ? old.st_mode & 07777 : 0666;
  int error = write_beside(temporary, mode, text);
  if (error == 0 && std::rename(temporary.c_str(), target.c_str()) != 0) error = errno;
  if (error != 0) {
    ::unlink(temporary.c_str());
    fail(file, error);
  }
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error && !fs::is_directory(folder, error) && !error)
    error = std::make_error_code(std::errc::not_a_directory);
  if (error) fail(folder, error.value());
}

void print(const std::string& text) {
  errno = 0;
  std::cout << text << std::flush;
  if (!std::cout)
    throw OutputError(std::string("standard output cannot be written: ") +
                      std::strerror(errno));
}

}  // namespace turnwright::app
