#include "progress_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "turnwright/base/language.hpp"

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

ProgressLine::ProgressLine(const char* line)
    : line_(line),
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
  const auto told = fmt::format(fmt::runtime(translated(line_)), gone, all,
                                fmt::format("{:.{}f}", rate, rate < 10 ? 2 : 0),
                                duration(static_cast<double>(all - gone) / rate));
  std::fputs(("\r" + told + "\033[K").c_str(), stderr);
}

}  // namespace turnwright::app
