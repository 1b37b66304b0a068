#include "spool.hpp"

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "base/say.hpp"
#include "service/output.hpp"

namespace turnwright::service {
namespace {

[[noreturn]] void not_kept(const std::filesystem::path& file) {
  throw OutputError(say("{}: the lines of a batch cannot be kept: {}", file.string(),
                        std::strerror(errno)));
}

}  // namespace

Spool::Spool(const std::filesystem::path& beside) {
  std::string name = beside.string() + "-arriving-XXXXXX";
  descriptor_ = ::mkostemp(name.data(), O_CLOEXEC);
  file_ = name;
  if (descriptor_ < 0) not_kept(file_);
  ::unlink(name.c_str());
}

Spool::~Spool() { ::close(descriptor_); }

void Spool::write(std::string_view text) {
  while (!text.empty()) {
    const auto count = ::write(descriptor_, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) not_kept(file_);
    text.remove_prefix(static_cast<std::size_t>(count));
  }
}

BatchInput Spool::lines() const {
  const int own = ::fcntl(descriptor_, F_DUPFD_CLOEXEC, 0);
  if (own < 0) not_kept(file_);
  ::lseek(own, 0, SEEK_SET);
  return BatchInput(own, file_);
}

}  // namespace turnwright::service
