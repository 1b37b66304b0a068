#include "progress_line.hpp"

#include <unistd.h>

#include <cstdio>
#include <utility>

namespace turnwright::app {
namespace {

using std::chrono::steady_clock;

std::string duration(double seconds) {
  const auto minutes = static_cast<long>(seconds / 60);
  if (minutes >= 120) return std::to_string(minutes / 60) + " h";
  if (minutes >= 2) return std::to_string(minutes) + " min";
  return std::to_string(static_cast<long>(seconds)) + " s";
}

}  // namespace

ProgressLine::ProgressLine(std::string what)
    : what_(std::move(what)),
      terminal_(::isatty(STDERR_FILENO) == 1),
      begun_(steady_clock::now()),
      told_(begun_) {}

ProgressLine::~ProgressLine() {
  if (terminal_) std::fputs("\r\033[K", stderr);
}

void ProgressLine::tell(std::int64_t found, std::int64_t done, std::int64_t all) {
  if (!terminal_) return;
  const auto time = steady_clock::now();
  if (time - told_ < std::chrono::milliseconds(200)) return;
  told_ = time;
  const double rate =
      static_cast<double>(done) / std::chrono::duration<double>(time - begun_).count();
  const auto gone = found + done;
  std::fprintf(stderr, "\r%lld of %lld %s, %.*f/s, %s left\033[K",
               static_cast<long long>(gone), static_cast<long long>(all), what_.c_str(),
               rate < 10 ? 2 : 0, rate,
               duration(static_cast<double>(all - gone) / rate).c_str());
}

}  // namespace turnwright::app
