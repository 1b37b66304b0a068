#include "output.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <iostream>
#include <iterator>
#include <list>
#include <random>
#include <set>
#include <system_error>

#include "base/say.hpp"
#include "turnwright/base/errors.hpp"

namespace turnwright::service {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, int error) {
  throw OutputError(
      say("{}: cannot be written: {}", file.string(), std::strerror(error)));
}

bool write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const auto count = ::write(descriptor, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return false;
    text.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

// Different for any two writers on any machine; never part of a result.
fs::path unfinished_name(const fs::path& folder, const fs::path& target) {
  std::random_device random;
  std::array<char, 17> suffix{};
  std::snprintf(suffix.data(), suffix.size(), "%08x%08x", random(), random());
  return folder / ('.' + target.filename().string() + '.' + suffix.data());
}

// A new file's name is on the disk once its folder has been flushed.
bool flush_folder(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool good = ::fsync(descriptor) == 0 || errno == EINVAL;
  ::close(descriptor);
  return good;
}

// The target of a link.
fs::path resolved(const fs::path& file) {
  std::error_code unresolved;
  const auto target = fs::weakly_canonical(file, unresolved);
  return unresolved ? file : target;
}

void remove_file(const fs::path& file) {
  std::error_code error;
  fs::remove(file, error);
  if (error)
    throw OutputError(say("{}: cannot be removed: {}", file.string(), error.message()));
}

}  // namespace

NewFile::NewFile(fs::path file, const fs::path& scratch)
    : file_(std::move(file)), target_(resolved(file_)) {
  temporary_ =
      unfinished_name(scratch.empty() ? target_.parent_path() : scratch, target_);
  struct stat old {};
  const bool exists = ::stat(target_.c_str(), &old) == 0;
  const mode_t mode = exists ? old.st_mode & 07777 : 0666;
  descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
  check(descriptor_ >= 0);
}

NewFile::~NewFile() {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void NewFile::write(std::string_view text) { check(write_all(descriptor_, text)); }

void NewFile::flush() { check(::fsync(descriptor_) == 0); }

void NewFile::publish() {
  flush();
  check(std::rename(temporary_.c_str(), target_.c_str()) == 0);
  temporary_.clear();
  const auto folder = target_.parent_path();
  check(flush_folder(folder.empty() ? "." : folder));
}

void NewFile::check(bool good) const {
  if (!good) fail(file_, errno);
}

void write_file(const fs::path& file, std::string_view text) {
  struct stat old {};
  if (::stat(file.c_str(), &old) != 0 || S_ISREG(old.st_mode)) {
    NewFile out(file);
    out.write(text);
    return out.publish();
  }
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CLOEXEC);
  const bool good = descriptor >= 0 && write_all(descriptor, text);
  const int error = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (!good) fail(file, error);
}

std::vector<std::string> replace_files(
    const fs::path& folder, const std::vector<NamedText>& files,
    const std::function<bool(std::string_view)>& ours) {
  std::list<NewFile> fresh;
  std::set<std::string> left, names;
  for (const auto& file : files) {
    names.insert(file.name);
    auto& out = fresh.emplace_back(folder / file.name);
    out.write(file.text);
    out.flush();
  }
  for (const auto& entry : fs::directory_iterator(folder))
    if (const auto name = entry.path().filename().string();
        !entry.is_directory() && ours(name))
      left.insert(name);
  std::vector<std::string> gone;
  std::set_difference(left.begin(), left.end(), names.begin(), names.end(),
                      std::back_inserter(gone));
  for (const auto& name : left) remove_file(resolved(folder / name));
  for (const auto& name : gone) remove_file(folder / name);  // of a link, the link too
  for (auto& file : fresh) file.publish();
  return gone;
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error && !fs::is_directory(folder, error) && !error)
    error = std::make_error_code(std::errc::not_a_directory);
  if (error) fail(folder, error.value());
}

void print(const std::string& text, std::string (*style)(std::string_view)) {
  std::string shown;
  for (std::string_view rest = text; !rest.empty();) {
    const auto end = std::min(rest.find('\n'), rest.size());
    const auto line = visible(rest.substr(0, end));
    shown += style ? style(line) : line;
    if (end < rest.size()) shown += '\n';
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  errno = 0;
  std::cout << shown << std::flush;
  if (!std::cout)
    throw OutputError(say("standard output cannot be written: {}", std::strerror(errno)));
}

}  // namespace turnwright::service
