#include "input.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "document/json/parse.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::service {
namespace {

constexpr std::size_t kBuffer = 1 << 18;
constexpr std::size_t kLongest = document::ParseLimits{}.bytes + 1;

[[noreturn]] void unreadable(const std::filesystem::path& file, const std::string& got) {
  throw InputError(file.string(),
                   {{"", got, tr("a file with one request a line"), "file"}});
}

}  // namespace

BatchInput::BatchInput(const std::filesystem::path& file)
    : file_(file), buffer_(kBuffer) {
  struct stat about {};
  if (::stat(file.c_str(), &about) == 0 && !S_ISREG(about.st_mode))
    unreadable(file, tr("no regular file"));  // a pipe could not be read a second time
  descriptor_ = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor_ < 0) unreadable(file, tr("nothing readable"));
}

BatchInput::BatchInput(int descriptor, std::filesystem::path file)
    : file_(std::move(file)), descriptor_(descriptor), buffer_(kBuffer) {
  if (descriptor_ < 0) unreadable(file_, tr("nothing readable"));
}

BatchInput::~BatchInput() { ::close(descriptor_); }

bool BatchInput::fill() {
  ssize_t count = 0;
  do count = ::read(descriptor_, buffer_.data(), buffer_.size());
  while (count < 0 && errno == EINTR);
  if (count < 0) unreadable(file_, std::strerror(errno));
  begin_ = 0;
  end_ = static_cast<std::size_t>(count);
  return count > 0;
}

bool BatchInput::read(Sha256* digest, std::string* text) {
  if (text) text->clear();
  for (bool begun = false;; begun = true) {
    if (begin_ == end_ && !fill()) return begun;
    const char* from = buffer_.data() + begin_;
    const auto* end = static_cast<const char*>(std::memchr(from, '\n', end_ - begin_));
    const std::size_t size = end ? static_cast<std::size_t>(end - from) : end_ - begin_;
    if (text) text->append(from, std::min(size, kLongest - text->size()));
    const std::size_t taken = size + (end ? 1 : 0);
    if (digest) digest->update({from, taken});
    begin_ += taken;
    position_ += static_cast<std::int64_t>(taken);
    if (end) return true;
  }
}

void BatchInput::seek(std::int64_t position) {
  if (::lseek(descriptor_, position, SEEK_SET) != position)
    unreadable(file_, std::strerror(errno));
  begin_ = end_ = 0;
  position_ = position;
}

BatchInput::Contents BatchInput::contents() {
  Contents all;
  Sha256 digest;
  seek(0);
  while (next(digest)) ++all.lines;
  all.bytes = position_;
  all.sha256 = digest.hex();
  seek(0);
  return all;
}

}  // namespace turnwright::service
